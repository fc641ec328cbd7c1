//! Two-dimensional calls onto targets as large as numbers go. That no scene panics, with all arguments extreme at once and overflow
//! checks, is shown by `fuzz/targets/scene`.

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::draw::{draw_line, fill_triangle};
use pinhole::raster::ScreenPoint;
use std::convert::Infallible;

/// A target of the largest size that `embedded-graphics` can express, at any position.
struct Endless {
    area: Rectangle,
    runs: u32,
}

impl Dimensions for Endless {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl DrawTarget for Endless {
    type Color = Gray8;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = embedded_graphics_core::Pixel<Gray8>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        self.runs += u32::from(pixels.into_iter().count() > 0);
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: Gray8) -> Result<(), Infallible> {
        let Rectangle { top_left: Point { x, y }, size } = *area;
        assert!(x >= self.area.top_left.x && y >= self.area.top_left.y && size.width * size.height > 0);
        self.runs += 1;
        Ok(())
    }
}

/// 2D calls have no viewport: only the bounds of the target clip them.
#[test]
fn targets_of_the_largest_size_do_not_panic() {
    let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(256 * x, 256 * y).unwrap();
    let triangles = [[(0, 0), (4, 0), (0, 4)], [(-8192, -8192), (8192, -8192), (-8192, 8192)]];
    // The slanted edges pass through centres, and are right edges: of the first one rows 0 to 2 are covered. Of the second
    // pixels x ≤ −y − 2: rows −8192 to 8190, from (−9, −9) on rows −9 to 7.
    for (from, rows) in [(i32::MIN, [3, 16_383]), (0, [3, 0]), (-9, [3, 17]), (i32::MAX, [0, 0])] {
        let area = Rectangle::new(Point::new(from, from), Size::new(u32::MAX, u32::MAX));
        for (triangle, rows) in triangles.iter().zip(rows) {
            let mut target = Endless { area, runs: 0 };
            let Ok(()) = fill_triangle(triangle.map(|(x, y)| corner(x, y)), Gray8::WHITE, &mut target);
            assert_eq!(target.runs, rows, "from {from}");
        }
        let mut target = Endless { area, runs: 0 };
        let ends = [-9, i32::MAX].map(|x| Point::new(x, 3));
        let Ok(()) = draw_line(ends[0], ends[1], Gray8::WHITE, &mut target);
        assert_eq!(target.runs, u32::from(from < i32::MAX), "from {from}");
    }
}
