//! Lines of one colour in one call each, pixel by pixel, into targets where a call costs more than a pixel.
//!
//! - **Plain twin**: `pipeline::fill::line`, which passes each span of `raster::line` to `Surface::fill`.
//! - **Domain**: lines of at most [`LONGEST`] pixels inside the scissor, on a target whose [`LEAST_RUN`](Surface::LEAST_RUN) is
//!   more than 1; except flat lines with `LEAST_RUN` pixels per run or more.
//! - **Gain**: S6 into a DrawTarget in memory takes 29 % of the instructions on an M3, 14 for a pixel.
//! - **Test**: `tests/raster/lines.rs`.
//!
//! A tall line is drawn from top to bottom and a wide one from left to right, so that a driver that gathers adjacent pixels into
//! windows finds them in the order of a window.

use super::line_slope::{slope, HALF, LONGEST};
use crate::math::hints::keep_rolled;
use crate::raster::{LineSetup, Pixel, Scissor};
use crate::surface::Surface;
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::Pixel as ColoredPixel;

/// Draws a line in one call of [`Surface::draw_pixels`], if it is in the domain; otherwise draws nothing and returns `None`. The
/// scissor lies in the target.
#[inline(always)]
pub(crate) fn line_by_pixels<T: Surface>(
    from: Pixel,
    to: Pixel,
    scissor: &Scissor,
    color: T::Color,
    target: &mut T,
) -> Option<Result<(), T::Error>> {
    if cfg!(pinhole_plain) || T::LEAST_RUN <= 1 {
        return None; // the compiler knows, so such a target links no code of this file
    }
    line(from, to, scissor, color, target)
}

#[inline(never)] // one copy for all callers
fn line<T: Surface>(
    from: Pixel,
    to: Pixel,
    scissor: &Scissor,
    color: T::Color,
    target: &mut T,
) -> Option<Result<(), T::Error>> {
    let setup = LineSetup::new(from, to);
    let LineSetup { x, y, tall, up, length, rise, end: (end_x, end_y), .. } = setup;
    // Whether length + 1 pixels in rise + 1 runs are `LEAST_RUN` a run or more. The product is below 2³².
    let is_flat = !tall && (rise as u32 + 1) * u32::from(T::LEAST_RUN) <= length as u32 + 1;
    if is_flat || length > LONGEST || !setup.lies_in(scissor) {
        return None;
    }
    let slope = slope(&setup);
    let (forward, back) = (u64::from(slope), u64::from(slope).wrapping_neg());
    Some(if tall {
        let (x, step, y, end) = match up {
            false => (fixed(x, HALF), forward, y, end_y),
            // From the larger end: the sum after all steps, of which only the fraction is not exact.
            true => (fixed(end_x, slope.wrapping_mul(length as u32).wrapping_add(HALF)), back, end_y, y),
        };
        draw(target, LinePixels::<_, true> { aside: x, step, along: y, end: end + 1, color })
    } else {
        // Upwards, the row is y − ⌊f⌋ = ⌊y + 1 − 2⁻³² − f⌋ for a sum f in 2⁻³².
        let (y, step) = match up {
            false => (fixed(y, HALF), forward),
            true => (fixed(y, !HALF), back),
        };
        draw(target, LinePixels::<_, false> { aside: y, step, along: x, end: end_x + 1, color })
    })
}

#[inline(never)] // its loop needs all registers
fn draw<T: Surface>(
    target: &mut T,
    pixels: impl Iterator<Item = ColoredPixel<T::Color>>,
) -> Result<(), T::Error> {
    target.draw_pixels(pixels)
}

/// The number `integer` + `fraction`·2⁻³², in 32.32.
#[inline(always)]
const fn fixed(integer: i32, fraction: u32) -> u64 {
    (integer as u32 as u64) << 32 | fraction as u64
}

/// The pixels of a line: of a tall one from top to bottom, one per row, otherwise from left to right, one per column.
struct LinePixels<C, const TALL: bool> {
    /// The column of the next pixel of a tall line, otherwise its row, and its change per pixel, in 32.32.
    aside: u64,
    step: u64,
    /// The row of the next pixel of a tall line, otherwise its column, and that behind the last one.
    along: i32,
    end: i32,
    color: C,
}

impl<C: PixelColor, const TALL: bool> Iterator for LinePixels<C, TALL> {
    type Item = ColoredPixel<C>;

    #[inline(always)]
    fn next(&mut self) -> Option<ColoredPixel<C>> {
        if self.along == self.end {
            return None;
        }
        let aside = (self.aside >> 32) as i32;
        let at = if TALL { Point::new(aside, self.along) } else { Point::new(self.along, aside) };
        self.aside = self.aside.wrapping_add(self.step);
        self.along += 1;
        keep_rolled();
        Some(ColoredPixel(at, self.color))
    }
}
