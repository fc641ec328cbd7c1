//! Ordered dithering.

use super::gouraud::Rounding;
use super::levels::{add_bias, align, integer_parts, levels};
use super::Flat;
use crate::color::Color;

/// A shader with ordered dithering, which shows more shades than the target has: each pixel is rounded down or up by a
/// threshold, one of 64 in an 8 × 8 pattern: of [`Flat`], [`Gouraud`](crate::shading::Gouraud), [`Lit`](crate::shading::Lit) and [`PerspectiveGouraud`](crate::shading::PerspectiveGouraud). (Bayer,
/// *An optimum method for two-level rendition of continuous-tone pictures*, 1973; Foley et al., *Computer Graphics*, 2nd ed.,
/// section 13.1.2.)
///
/// **The pattern** depends only on the pixel's coordinates in the frame. So it does not move with objects, and it continues
/// across bands and edges. Its thresholds are 1/128, 3/128 … 127/128.
///
/// **Error.** The mean over any 8 × 8 pixels is within 1/128 + 2⁻¹⁶ level of the colour, in every channel. Colours that the
/// target can show exactly, such as black and white, are not dithered.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::{BinaryColor, Rgb888}, prelude::*, primitives::Rectangle};
/// use pinhole::{draw::fill_triangle, raster::ScreenPoint, shading::{Dithered, Flat}};
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let grey = Flat::from(Rgb888::new(51, 51, 51)); // a fifth of white: 12.8 of 64
/// let mut display = MockDisplay::<BinaryColor>::new();
/// let mut square = display.clipped(&Rectangle::new(Point::zero(), Size::new(8, 8)));
/// fill_triangle([corner(0, 0), corner(0, 16), corner(16, 0)], Dithered(grey), &mut square)?;
/// display.assert_pattern(&[
///     "........",
///     "..#...#.",
///     "........",
///     "#.#.#.#.",
///     "........",
///     "#.#...#.",
///     "........",
///     "#.#.#.#.",
/// ]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Dithered<S>(
    /// The shader.
    pub S,
);

impl Flat {
    /// The nearest colour of the target.
    #[inline]
    pub(crate) fn nearest<C: Color>(&self) -> C {
        C::from_channels(integer_parts::<C>(add_bias::<C>(levels::<C>(*self).map(align), 1 << 23)))
    }
}

/// The Bayer matrix as thresholds in 1/128: twice each rank, plus 1.
pub(super) const PATTERN: [[u8; 8]; 8] = {
    let mut pattern = [[0; 8]; 8];
    let mut y = 0;
    while y < 8 {
        let mut x = 0;
        while x < 8 {
            // The 2 × 2 matrix is 0 2 / 3 1, applied recursively: the lowest bits of x and y have the most weight.
            let (mut rank, mut bit) = (0, 0);
            while bit < 3 {
                let pair = ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
                rank |= pair << (4 - 2 * bit);
                bit += 1;
            }
            pattern[y][x] = 2 * rank as u8 + 1;
            x += 1;
        }
        y += 1;
    }
    pattern
};

/// Rounds a level down or up by the pattern.
pub(crate) struct Bayer {
    row: &'static [u8; 8],
    x: usize,
}

impl Rounding for Bayer {
    const FIRST: u32 = 0;

    #[inline(always)]
    fn from(x: i32, y: i32) -> Self {
        let [first, ..] = &PATTERN;
        // The mask keeps the index inside the pattern; `get` has no panic path, whether or not LLVM sees that.
        Self { row: PATTERN.get(y as usize & 7).unwrap_or(first), x: x as usize }
    }

    #[inline(always)]
    fn next(&mut self) -> u32 {
        let threshold = self.row.get(self.x & 7).copied().unwrap_or(0);
        self.x = self.x.wrapping_add(1);
        u32::from(threshold) << 17 // from 1/128 to 2⁻²⁴
    }
}
