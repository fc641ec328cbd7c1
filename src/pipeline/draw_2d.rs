//! Drawing in 2D: single triangles and lines.

use super::anti_aliased;
use super::drawable::{ShaderFor, StrokeFor};
use super::fill::{fill, line, scissor_of};
use crate::color::{Access, InkKind};
use crate::fast::solid_fill;
use crate::raster::{self, Pixel, Scissor, ScreenPoint, Triangle};
use crate::surface::Surface;
use embedded_graphics_core::geometry::Point;

/// Fills the pixels that a triangle covers by the rules of [`raster`](crate::raster), clipped to the target. `corners` are in
/// the target's coordinates, in 1/256 pixel; either winding is drawn.
///
/// # Errors
///
/// The target's error, at the first span that it refuses.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor};
/// use pinhole::{draw::fill_triangle, raster::ScreenPoint};
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let mut display = MockDisplay::new();
/// fill_triangle([corner(0, 0), corner(4, 0), corner(0, 4)], BinaryColor::On, &mut display)?;
/// display.assert_pattern(&["###", "## ", "#  "]); // the slanted edge passes through centres, and is a right edge
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[inline(always)]
pub fn fill_triangle<T: Surface, S: ShaderFor<T>>(
    corners: [ScreenPoint; 3],
    shader: S,
    target: &mut T,
) -> Result<(), T::Error> {
    const {
        assert!(
            !(S::NEEDS_DEPTH || S::NEEDS_W),
            "this shader needs depth or w, which corners in 2D do not have"
        )
    };
    let area = raster::area(&corners);
    if area == 0 {
        return Ok(()); // R6
    }
    if S::Ink::IS_OPAQUE
        && let Some(color) = shader.solid().and_then(InkKind::own)
        && solid_fill::triangle_2d(corners, area, color, target)
    {
        return Ok(());
    }
    // The viewport is the guard band and not the target, so that gradients, and so colours, are equal in all bands.
    let triangle = Triangle::new(corners, area, &Scissor::GUARD_BAND);
    fill(&triangle, &shader, &scissor_of(target), false, target)
}

/// Draws a line, both ends included, by the rules of [`raster`](crate::raster), clipped to the target. Ends are pixels in the
/// target's coordinates; columns and rows beyond −32768 … 32767 count as the nearest of these.
///
/// # Errors
///
/// The target's error, at the first span that it refuses.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::Point};
/// use pinhole::draw::draw_line;
/// let mut display = MockDisplay::new();
/// draw_line(Point::zero(), Point::new(5, 2), BinaryColor::On, &mut display)?;
/// display.assert_pattern(&["##    ", "  ##  ", "    ##"]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[inline(always)]
pub fn draw_line<T: Surface, K: StrokeFor<T>>(
    from: Point,
    to: Point,
    stroke: K,
    target: &mut T,
) -> Result<(), T::Error> {
    let (scissor, from, to) = (scissor_of(target), Pixel::from(from), Pixel::from(to));
    if <K::Access as Access>::READS {
        anti_aliased::line_between_pixels([from, to], &scissor, stroke, target);
        return Ok(());
    }
    line(target, from, to, &scissor, stroke.color())
}
