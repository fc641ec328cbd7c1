//! Gouraud shading: colours interpolated linearly over a triangle.

use super::levels::{add_bias, each, fraction_bits, integer_parts, levels, weighted_mean};
use super::Flat;
use crate::color::Color;
use crate::raster::{Gradient, GradientSetup, Span, Triangle};
use core::marker::PhantomData;

/// Gouraud shading: a colour at each corner of a face, in the order of the face's vertices, interpolated linearly on the
/// screen. (Gouraud, *Continuous shading of curved surfaces*, 1971; Foley et al., *Computer Graphics*, 2nd ed., section
/// 16.2.4.)
///
/// **Error.** Each channel of a pixel is the exact value at the pixel's centre, rounded to the nearest level of the target: off
/// by at most ½ + 2⁻⁹ level, for any triangle in the guard band, however fast its colour changes.
///
/// **Clipped faces.** If the near plane, the far plane or the guard band clips a face, the colours at the new corners are
/// interpolated in space and rounded to 1/256 of a step of `Rgb888`, which adds at most 2⁻⁹ level to the error. On each
/// sub-face, colours are linear on the screen. So a clipped face has slightly different colours than it had before it reached
/// the plane, but no colour jumps by more than 1/255 as a corner passes the plane (`tests/shading/levels.rs`); the more of
/// the face is clipped, the closer its colours are to perspective-correct ones.
///
/// **Perspective.** Colours that are linear on the screen are not linear on a face in perspective: where w at one corner is r times that
/// at another, they are off by up to (√r − 1)/(√r + 1) of their range, which is 1/6 at r = 2, and 153 of 255 levels at r = 16, as on a
/// floor that reaches close to the eye. [`in_perspective`](Self::in_perspective) is exact to ¼ level more than rounding.
///
/// For one colour with a light level at each corner, [`Gouraud::lit`] is faster, and
/// [`ShadeTable::lit`](crate::shading::ShadeTable::lit) is the fastest.
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
/// use pinhole::shading::Gouraud;
/// let rainbow = Gouraud::new([Rgb888::RED, Rgb888::GREEN, Rgb888::BLUE]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Gouraud(pub(super) [Flat; 3]);

impl Gouraud {
    /// The shader of a face, from one colour per corner: `Rgb888` or [`Flat`], stored exactly.
    pub fn new(corners: [impl Into<Flat>; 3]) -> Self {
        Self(corners.map(Into::into))
    }

    /// The shader of a sub-face, given the barycentric weights of its corners, in 2⁻³⁰.
    #[must_use]
    pub(crate) fn with_weights(&self, corners: [[i32; 3]; 3]) -> Self {
        Self(corners.map(|weights| {
            Flat([0, 1, 2].map(|channel| {
                let values = self.0.map(|Flat(color)| color.get(channel).copied().map_or(0, i32::from));
                weighted_mean(values, weights, 255 * 256) as u16
            }))
        }))
    }

    /// The gradients of the channels' levels over a triangle, with [`fraction_bits`](super::levels::fraction_bits) fractional bits: within
    /// 2⁻¹⁰ + 2⁻¹³ level of the exact levels.
    ///
    /// [`GradientSetup::through`] is off by less than `(w + h)/2 + 34 + 2¹⁰·⁶` units of the last of at least 24 fractional bits, w
    /// columns and h rows from its corner, w + h ≤ 2¹⁵, and its corners are off by 2⁻¹⁷ level. So adding the bias (½ to round,
    /// 1/128 to 127/128 to dither) keeps every sum within 0 … 2³²: a channel that is full at all corners is full in between.
    #[inline(always)]
    pub(super) fn gradients<C: Color>(&self, triangle: &Triangle<'_>) -> [Gradient; 3] {
        let [[a, d, g], [b, e, h], [c, f, i]] = self.0.map(levels::<C>);
        let setup = GradientSetup::new(triangle);
        each::<C, _, _>([[a, b, c], [d, e, f], [g, h, i]], |values, _| setup.through(&values))
    }
}

/// How levels are rounded to integers: a bias in 2⁻²⁴, added before the fraction is dropped.
pub(crate) trait Rounding {
    /// The bias that is common to all pixels.
    const FIRST: u32;

    /// The biases of a span that starts at pixel (x, y).
    fn from(x: i32, y: i32) -> Self;

    /// The bias of the next pixel, in addition to [`FIRST`](Self::FIRST).
    fn next(&mut self) -> u32;
}

/// Rounds to the nearest level.
pub(crate) struct Nearest;

impl Rounding for Nearest {
    const FIRST: u32 = 1 << 23;

    #[inline(always)]
    fn from(_: i32, _: i32) -> Self {
        Self
    }

    #[inline(always)]
    fn next(&mut self) -> u32 {
        0
    }
}

/// The upper bits of saturating levels that are the sign and a guard bit: levels from −512 to 511 of 255 do not wrap.
pub(crate) const SATURATING_BITS: u32 = 2;

/// The colours of a span from left to right: an endless iterator. Levels are unsigned numbers between 0 and the largest; if
/// `SATURATING`, they are signed numbers of two fractional bits less, of which each is shown as the nearest in this range.
pub(crate) struct SpanColors<C, R, const SATURATING: bool = false> {
    levels: [u32; 3],
    steps: [u32; 3],
    rounding: R,
    color: PhantomData<C>,
}

impl<C: Color, R: Rounding, const SATURATING: bool> SpanColors<C, R, SATURATING> {
    /// The fractional bits that levels have less.
    const LESS: u32 = if SATURATING { SATURATING_BITS } else { 0 };

    /// The colours of a span that starts at the covered pixel (x, y), from the gradients of its channels.
    #[inline(always)]
    pub(super) fn along(gradients: &[Gradient; 3], Span { x, y, .. }: Span) -> Self {
        Self::new(gradients.map(|g| g.at(x, y)), gradients.map(|g| g.step()), (x, y))
    }

    #[inline(always)]
    pub(super) fn new(levels: [u32; 3], steps: [u32; 3], (x, y): (i32, i32)) -> Self {
        let levels = add_bias::<C>(levels, R::FIRST >> Self::LESS);
        Self { levels, steps, rounding: R::from(x, y), color: PhantomData }
    }
}

impl<C: Color, R: Rounding, const SATURATING: bool> Iterator for SpanColors<C, R, SATURATING> {
    type Item = C;

    #[inline(always)]
    fn next(&mut self) -> Option<C> {
        let levels = add_bias::<C>(self.levels, self.rounding.next() >> Self::LESS);
        let levels = match SATURATING {
            true => each::<C, _, _>(levels, |level, max| {
                let level = level as i32 >> (fraction_bits(max) - SATURATING_BITS);
                level.max(0).min(max.into()) as u8
            }),
            false => integer_parts::<C>(levels),
        };
        let ([r, g, b], [x, y, z]) = (self.levels, self.steps);
        self.levels = each::<C, _, _>([(r, x), (g, y), (b, z)], |(level, step), _| level.wrapping_add(step));
        Some(C::from_channels(levels))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::raster::random_triangles::Triangles;
    use embedded_graphics_core::pixelcolor::Gray8;

    #[test]
    fn levels_over_a_triangle_stay_within_the_bound() {
        let random = &mut Random(5);
        // In 2⁻⁸ levels: 255 of them are 65280.
        let mut worst = |viewport, cases, reach| {
            let triangles = Triangles { reach, viewport, cases, most: 65_280 };
            triangles.worst(random, (16, 0), |triangle, colors| {
                Gouraud(colors.map(|c| Flat([c as u16; 3]))).gradients::<Gray8>(triangle)[0]
            })
        };
        let small = [600, 20_000, 65_000].map(|reach| worst(600, 30_000, reach)).into_iter().max().unwrap();
        let large = [300_000, 2_000_000].map(|reach| worst(8192, 1_000, reach)).into_iter().max().unwrap();
        // In 2⁻²⁴, as `GradientSetup::through` documents: small, 1024 rows and columns by ½ and 34 for the origin; the reciprocal may
        // add 1552, but 400 is asserted, as no case comes near. Large, 2¹⁵ rows and columns by ½.
        assert!(small <= 512 + 34 + 400 && large <= (1 << 14) + 34 + 1552, "{small} {large}");
        assert!(small > 473 && large > 9000, "{small} {large}");
    }
}
