//! Triangles and lines by themselves, for drawing in 2D.

use super::fill::fill;
use crate::raster::{self, Pixel, Scissor, ScreenPoint, Triangle};
use crate::shading::SpanShader;
use crate::surface::Target;

/// Fills a triangle, as the rules of [`raster`](crate::raster) say which pixels are its own, clipped to the
/// target. Corners are in the target's coordinates, in 1/256 pixel.
///
/// # Errors
///
/// The target's own, at the first span that it refuses.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor};
/// use pinhole::{fill_triangle, raster::ScreenPoint};
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let mut display = MockDisplay::new();
/// fill_triangle([corner(0, 0), corner(4, 0), corner(0, 4)], BinaryColor::On, &mut display)?;
/// display.assert_pattern(&["###", "## ", "#  "]); // the slanted edge passes through centres, and is a right edge
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[inline(always)]
pub fn fill_triangle<T: Target, I: SpanShader<T::Color>>(
    corners: [ScreenPoint; 3],
    ink: I,
    target: &mut T,
) -> Result<(), T::Error> {
    match (raster::area(&corners), ink.solid_color()) {
        (0, _) => Ok(()), // R6
        (area, Some(colour)) => target.plain_triangle(corners, area, colour),
        (area, None) => {
            // The same viewport for a band as for all of the picture: so are the colours.
            let triangle = Triangle::new(corners, area, &Scissor::GUARD_BAND);
            fill(&triangle, &ink, &target.reach(), target)
        }
    }
}

/// Draws a line, both ends included, as the rules of [`raster`](crate::raster) say which pixels are its own,
/// clipped to the target. Ends are pixels in the target's coordinates.
///
/// # Errors
///
/// The target's own, at the first span that it refuses.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor};
/// use pinhole::{draw_line, raster::Pixel};
/// let mut display = MockDisplay::new();
/// draw_line(Pixel { x: 0, y: 0 }, Pixel { x: 5, y: 2 }, BinaryColor::On, &mut display)?;
/// display.assert_pattern(&["##    ", "  ##  ", "    ##"]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[inline(always)]
pub fn draw_line<T: Target>(
    from: Pixel,
    to: Pixel,
    colour: T::Color,
    target: &mut T,
) -> Result<(), T::Error> {
    let all = target.reach();
    target.line(from, to, &all, colour)
}
