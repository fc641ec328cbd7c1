//! What the scenes draw, counted: whether they are those that `scenes.json` and its readers speak of.

use crate::lists::{LINES, SCREEN, TRIANGLES};
use crate::scene::{Model, Scene, CUBE, LINE, SIZE};
use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::raster::{Pixel as End, ScreenPoint};
use pinhole::{draw_line, fill_triangle};

/// Counts what is drawn on it.
struct Tally {
    size: Size,
    pixels: u32,
}

impl OriginDimensions for Tally {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Tally {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, _: I) -> Result<(), Infallible> {
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: Rgb565) -> Result<(), Infallible> {
        self.pixels += area.size.width * area.size.height;
        Ok(())
    }
}

impl Tally {
    const NEW: Self = Self { size: Size::new(SIZE, SIZE), pixels: 0 };
}

/// The faces of a scene that are drawn, and the pixels that they cover together.
pub fn covered(model: &'static Model) -> Option<[u32; 2]> {
    let scene = Scene::new(model)?;
    let light = scene.light()?;
    let mut tally = Tally::NEW;
    let Ok(statistics) = scene.place().solid(scene.shade(&light), &mut [], &mut tally);
    Some([statistics.drawn, tally.pixels])
}

/// The pixels that are written in S1, S5, S6 and S7, again where they were already.
pub fn written() -> Option<[u32; 4]> {
    let mut tallies = [(); 4].map(|()| Tally::NEW);
    let [cube, screen, lines, triangles] = &mut tallies;
    let Ok(_) = Scene::new(&CUBE)?.place().wireframe(LINE, &mut [], cube);
    let corners = |&[ax, ay, bx, by, cx, cy]: &[i16; 6]| {
        let at = |x: i16, y: i16| ScreenPoint::from_subpixels(i32::from(x) << 8, i32::from(y) << 8);
        Some([at(ax, ay)?, at(bx, by)?, at(cx, cy)?])
    };
    let Ok(()) = fill_triangle(corners(&SCREEN)?, LINE, screen);
    for &[x0, y0, x1, y1] in &LINES {
        let Ok(()) = draw_line(End { x: x0, y: y0 }, End { x: x1, y: y1 }, LINE, lines);
    }
    for triangle in &TRIANGLES {
        let Ok(()) = fill_triangle(corners(triangle)?, LINE, triangles);
    }
    Some(tallies.map(|tally| tally.pixels))
}
