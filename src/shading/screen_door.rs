//! Transparency that leaves out pixels by a pattern.

use super::dither::PATTERN;
use super::{CornerValues, FastPath, Shader, SpanShader};
use crate::color::InkKind;
use crate::raster::{Span, Triangle};
use embedded_graphics_core::pixelcolor::PixelColor;

/// A shader with screen-door transparency: of any 8 × 8 pixels of the target, a given number is drawn, and what is behind shows
/// through the others. It works on every target, needs no order of the faces, and stores the depth of the drawn pixels alone.
/// (Akenine-Möller et al., *Real-Time Rendering*, 4th ed., section 5.5.)
///
/// **The pattern** is that of [`Dithered`](crate::shading::Dithered) (Bayer 1973) and depends only on the pixel's coordinates in the
/// frame: it does not move with objects, and it continues across bands. The pixels of a lower coverage are among those of every
/// higher one, so of two faces with equal coverage, one behind the other, only the nearer is seen.
///
/// **On displays** each run of drawn pixels is a window of its own, and most runs are one pixel wide: draw into a
/// [`Band`](crate::bands::Band) or a [`Picture`](crate::target::Picture), and send that.
///
/// **With [`Dithered`](crate::shading::Dithered)** both patterns have equal thresholds, so the shades of a dithered face with a screen
/// door are up to one level too bright: the drawn pixels are those with low thresholds.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor};
/// use pinhole::{draw::fill_triangle, raster::ScreenPoint, shading::ScreenDoor};
/// let mut display = MockDisplay::new();
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let half = ScreenDoor::new(BinaryColor::On, 32); // 32 of 64 pixels
/// fill_triangle([corner(0, 0), corner(12, 0), corner(0, 6)], half, &mut display)?;
/// display.assert_pattern(&[
///     "# # # # # #",
///     " # # # #   ",
///     "# # # #    ",
///     " # #       ",
///     "# #        ",
///     "           ",
/// ]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScreenDoor<S> {
    shader: S,
    /// 0 … 64.
    coverage: u8,
}

impl<S> ScreenDoor<S> {
    /// A shader of which `coverage` of 64 pixels are drawn: 0 … 64 (more counts as 64).
    pub const fn new(shader: S, coverage: u8) -> Self {
        Self { shader, coverage: if coverage < 64 { coverage } else { 64 } }
    }
}

impl<S: Shader> Shader for ScreenDoor<S> {
    type Varying = S::Varying;
    const NEEDS_DEPTH: bool = S::NEEDS_DEPTH;
    const NEEDS_W: bool = S::NEEDS_W;

    fn sub_face(&self, corners: [S::Varying; 3]) -> Self {
        Self { shader: self.shader.sub_face(corners), ..*self }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { shader: self.shader.with_corners(corners), ..*self }
    }
}

impl<C: PixelColor, S: SpanShader<C>> SpanShader<C> for ScreenDoor<S> {
    type Ink = <S::Ink as InkKind<C>>::Optional;
    /// The inner shader's, and the rows of the pattern.
    type Setup = (S::Setup, &'static [u8; 8]);
    type FastPath = Self;
    const WRITES_DEPTH: bool = S::WRITES_DEPTH;

    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup {
        let [none, ..] = &ROWS;
        let rows = ROWS.get(usize::from(self.coverage)).unwrap_or(none); // coverage is at most 64
        (self.shader.set_up(triangle), rows)
    }

    #[inline(always)]
    fn span(setup: &Self::Setup, span: Span) -> impl Iterator<Item = Self::Ink> {
        Self::runs(setup, span).flat_map(|(width, run)| run.take(width as usize))
    }
}

impl<C: PixelColor, S: SpanShader<C>> FastPath<C, Self> for ScreenDoor<S> {
    #[inline(always)]
    fn runs(
        (own, rows): &(S::Setup, &'static [u8; 8]),
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = <S::Ink as InkKind<C>>::Optional>)> {
        let [first, ..] = *rows;
        // The mask keeps the index inside the pattern.
        let row = rows.get(span.y as usize & 7).unwrap_or(first);
        let row = u32::from(*row) * 0x0101_0101; // four times the 8 columns
        let mut x = span.x;
        S::FastPath::runs(own, span).map(move |(width, run)| {
            let mut columns = row.rotate_right(x as u32 & 31);
            x = x.wrapping_add(width); // at most the end of the span
            let inks = run.map(move |ink| {
                let is_drawn = columns & 1 != 0;
                columns = columns.rotate_right(1);
                ink.only_if(is_drawn)
            });
            (width, inks)
        })
    }
}

/// For each coverage the rows of the pattern: column x is drawn if bit x is set.
const ROWS: [[u8; 8]; 65] = {
    let mut rows = [[0; 8]; 65];
    let mut coverage = 0;
    while coverage <= 64 {
        let mut y = 0;
        while y < 8 {
            let mut x = 0;
            while x < 8 {
                // Thresholds are 1, 3 … 127.
                if (PATTERN[y][x] as usize) < 2 * coverage {
                    rows[coverage][y] |= 1 << x;
                }
                x += 1;
            }
            y += 1;
        }
        coverage += 1;
    }
    rows
};
