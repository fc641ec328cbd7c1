//! Set-up of gradients: from the values at a triangle's corners to the change per column and per row.
//!
//! With corners a, b, c and differences from a, the changes of a value z are
//!
//! ```text
//!     ∂z/∂x = (dz₁·dy₂ − dz₂·dy₁) / den,   ∂z/∂y = (dx₁·dz₂ − dx₂·dz₁) / den,   den = dx₁·dy₂ − dx₂·dy₁
//! ```
//!
//! (Pineda, *A parallel algorithm for polygon rasterization*, 1988, section 3.4.)
//!
//! The number format depends on the triangle alone, so that every core computes the same bits:
//!
//! | domain | numerators | division |
//! |---|---|---|
//! | depth, corners within 32 px, [near](GradientSetup::through_tiny) | differences less two bits, exact products | reciprocal, upper word |
//! | corners within 128 px | differences scaled to 31-bit products | reciprocal, upper word |
//! | corners within 512 px, or differences too large | 64-bit products cut to 31 bits | reciprocal, upper word |
//! | steep within 512 px | 31 bits | reciprocal, 64-bit product |
//! | steeper, or beyond 512 px | 64-bit products | long division by the reciprocal, 29 bits a step |

use super::{Gradient, ScreenPoint, Triangle};
use crate::math::hints::keep_rolled;
use crate::math::num::{leading_zeros, mul_high, mul_wide, reciprocal_of_positive};

/// The part of gradient set-up that all values over one triangle share: the reciprocal of its area.
///
/// Per pixel, in 2⁻⁸ of the corners' unit, a gradient changes by `v · 2¹⁶ / den`, where v is the numerator for x or y. This is
/// computed as `v·2ᵏ · mantissa >> (shift + k)`. Differences of values are scaled by 2ᵏ, so that numerators have 31 bits and
/// only the upper word of the product counts.
pub(crate) struct GradientSetup<'t> {
    pub(crate) triangle: &'t Triangle<'t>,
    /// The reciprocal of the area with its sign turned: 2¹⁶/den = mantissa · 2^−shift.
    pub(crate) mantissa: i32,
    /// The right shift that belongs to `mantissa`. For triangles beyond 512 pixels it is far below [`MIN_SHIFT`], so that every
    /// gradient counts as steep.
    pub(crate) shift: i32,
    pub(crate) extent: Extent,
    /// The area's magnitude, cut to 31 bits beyond 128 pixels.
    area: i32,
}

/// With a smaller shift the gradient is steep: the upper word of the product has too few bits of the step.
const MIN_SHIFT: i32 = 34;

/// The bits of the largest difference between corners, in sub-pixels.
#[derive(Clone, Copy)]
pub(crate) struct Extent(u32);

impl Extent {
    #[inline(always)]
    pub(crate) fn of(Triangle { corners: [a, b, c], .. }: &Triangle<'_>) -> Self {
        Self(magnitude(b.x - a.x) | magnitude(b.y - a.y) | magnitude(c.x - a.x) | magnitude(c.y - a.y))
    }

    /// Whether all differences from the first corner lie in −32 … 32 pixels, 32 excluded.
    #[inline(always)]
    pub(crate) fn is_tiny(self) -> bool {
        self.0 >> 13 == 0
    }

    /// Whether all differences from the first corner lie in −128 … 128 pixels, 128 excluded.
    #[inline(always)]
    fn is_small(self) -> bool {
        self.0 >> 15 == 0
    }

    /// Whether a difference from the first corner is 512 pixels or more.
    #[inline(always)]
    pub(crate) fn is_large(self) -> bool {
        self.0 >> 17 != 0
    }

    /// 32 less the bits of the largest difference between corners; −64 beyond 128 pixels.
    #[inline(always)]
    fn headroom(self) -> i32 {
        if self.is_small() {
            leading_zeros(self.0)
        } else {
            -64
        }
    }
}

/// The numerators of a gradient times 2ᵏ, of at most 31 bits.
#[derive(Clone, Copy)]
pub(crate) struct Numerators {
    pub(crate) x: i32,
    /// The numerator for y with its sign turned, which saves a negation on every core.
    pub(crate) minus_y: i32,
    k: i32,
}

impl Numerators {
    #[inline(always)]
    fn new(triangle: &Triangle<'_>, headroom: i32, values: &[i32; 3]) -> Self {
        Self::in_32_bits(triangle, headroom, values)
            .unwrap_or_else(|| numerators_in_64_bits(triangle, values))
    }

    /// `None` if the products would not fit 32 bits.
    #[inline(always)]
    fn in_32_bits(triangle: &Triangle<'_>, headroom: i32, values: &[i32; 3]) -> Option<Self> {
        let (dz1, dz2) = differences(values);
        // room = 2 + k, with k so that the bits of the extent, the bits of dz and k are 30 in all.
        let room = headroom + leading_zeros(magnitude(dz1) | magnitude(dz2)) - 32;
        if room < 0 {
            return None;
        }
        // Less than 32, as the extent is not 0.
        let scale = |dz: i32| (dz << (room & 31)) >> 2;
        // Each product is at most 2³⁰, and not both reach it.
        Some(Self::of_scaled(triangle, scale(dz1), scale(dz2), room - 2))
    }

    /// The numerators of differences that are scaled by 2ᵏ.
    #[inline(always)]
    pub(crate) fn of_scaled(
        Triangle { corners: [a, b, c], .. }: &Triangle<'_>,
        dz1: i32,
        dz2: i32,
        k: i32,
    ) -> Self {
        Self {
            x: (dz1 * (c.y - a.y)).wrapping_add(dz2 * (b.y - a.y)),
            minus_y: (dz1 * (c.x - a.x)).wrapping_add(dz2 * (b.x - a.x)),
            k,
        }
    }
}

/// The differences second − first and first − third value: 24 bits and a sign.
#[inline(always)]
pub(crate) fn differences(&[za, zb, zc]: &[i32; 3]) -> (i32, i32) {
    (zb - za, za - zc)
}

impl<'t> GradientSetup<'t> {
    #[inline(always)]
    pub(crate) fn new(triangle: &'t Triangle<'t>) -> Self {
        Self::with_extent(triangle, Extent::of(triangle))
    }

    /// [`new`](Self::new) as a function, where code size matters more than speed.
    #[inline(never)]
    pub(crate) fn called(triangle: &'t Triangle<'t>) -> Self {
        Self::new(triangle)
    }

    /// Set-up for a triangle whose extent is known.
    #[inline(always)]
    pub(crate) fn with_extent(triangle: &'t Triangle<'t>, extent: Extent) -> Self {
        let sign = (triangle.area >> 63) as i32;
        // |area| < 2³¹ within 128 pixels: a difference of two products of at most 2³⁰, which do not both reach it with opposite signs.
        let (area, cut) = match extent.is_small() {
            true => ((triangle.area as i32 ^ sign).wrapping_sub(sign), 0),
            false => cut_area(triangle, extent),
        };
        debug_assert!(area > 0, "{triangle:?}");
        let r = reciprocal_of_positive(area); // 1/area = mantissa · 2^(shift − 61)
        Self {
            triangle,
            mantissa: (r.mantissa ^ !sign).wrapping_sub(!sign),
            shift: 61 - 16 - r.shift as i32 + cut,
            extent,
            area,
        }
    }

    /// Set-up for a triangle within 32 pixels; `None` for a larger one.
    #[inline(always)]
    pub(crate) fn of_tiny(triangle: &'t Triangle<'t>, extent: Extent) -> Option<Self> {
        extent.is_tiny().then(|| Self::with_extent(triangle, extent))
    }

    /// Set-up for a triangle within 128 pixels; `None` for a larger one.
    #[inline(always)]
    pub(crate) fn of_small(triangle: &'t Triangle<'t>, extent: Extent) -> Option<Self> {
        extent.is_small().then(|| Self::with_extent(triangle, extent))
    }

    /// The gradient through values 0 … 2²⁴ − 1 at the corners.
    ///
    /// **Error.** In 2⁻⁸ of the corners' unit, a pixel w columns and h rows from the first corner's pixel, and not farther than
    /// the corners, is off by less than `(w + h)·½` for the rounding of the steps, 34 for the rounding of the origin, and, except
    /// for slivers and beyond 512 pixels, 2¹⁰·⁶ for the following errors.
    ///
    /// No step is larger than 2²⁸. Within 128 pixels the reciprocal has a relative error of 2⁻²⁸, at most 2⁸. Differences of
    /// values may lose two bits, as if corners had been up to 4 units lower: 2¹⁰. Within 512 pixels area and numerator are
    /// truncated to 31 bits, a relative error of 2⁻³⁰ each, in all less than 2⁻²⁷·⁴ of the step: 2⁹·⁶ for x and for y.
    // No inline hint: LLVM inlines it in firmware that calls it once.
    pub(crate) fn through(&self, values: &[i32; 3]) -> Gradient {
        let numerators = Numerators::new(self.triangle, self.extent.headroom(), values);
        match self.slope(&numerators, values) {
            Some(slope) => slope.gradient(),
            // A copy, so that the common case keeps `self` in registers.
            None => Self { ..*self }.steep(values, &numerators),
        }
    }

    /// The gradient of depth over most triangles of a fine mesh, with steps that are rounded down, in plain 64-bit
    /// arithmetic; its 32-bit twin is `fast/tiny_gradient.rs`. `None` outside of its [domain](Self::is_near), where
    /// [`through`](Self::through) defines the gradient. The error is within that of [`through`](Self::through).
    ///
    /// With E the largest difference between corners and |den| ≥ 32·(E + 1), no step reaches 2³¹. **Error.** Differences of
    /// values lose two bits, up to 3 units: 768 for the value. A step is rounded down to a multiple of 2^(34 − shift), which
    /// is less than 2²⁰/|den|, or to an integer: over (E + 1)/256 pixels each way, 2⁸ or w + h, which is at most 64. The
    /// distance to the pixel centre is multiplied by steps less 8 bits: 2⁸. The reciprocal adds 1: 1281 in all, less than
    /// 2¹⁰·⁶.
    pub(crate) fn through_tiny(&self, values: &[i32; 3]) -> Option<Gradient> {
        let (dz1, dz2) = differences(values);
        if !self.extent.is_tiny() || !self.is_near(dz1, dz2) {
            return None;
        }
        let Triangle { corners: [a, b, c], .. } = self.triangle;
        let numerator =
            |d1: i32, d2: i32| i64::from(dz1 >> 2) * i64::from(d1) + i64::from(dz2 >> 2) * i64::from(d2);
        let step = |numerator: i64| {
            let high = (numerator * i64::from(self.mantissa)) >> 32;
            // 34 − shift is −7 … 10, as 2⁹ ≤ |den| < 2²⁷.
            match 34 - self.shift {
                left @ 0.. => high << left,
                right => high >> -right,
            }
        };
        let right = step(numerator(c.y - a.y, b.y - a.y));
        let down = step(-numerator(c.x - a.x, b.x - a.x));
        let [value, ..] = *values;
        let (dx, dy) = (i64::from(to_centre(a.x)), i64::from(to_centre(a.y)));
        let value = (i64::from(value) << 8) + (right >> 8) * dx + (down >> 8) * dy;
        Some(Slope::new(a, value as i32, right as i32, down as i32).gradient())
    }

    /// Whether a triangle of at most 32 × 32 pixels is in the domain of [`through_tiny`](Self::through_tiny), given the
    /// differences of the values at its corners, in their own unit. It must not be thin: |den| ≥ 32·(E + 1), with twice the
    /// area as den and the largest difference of the corners' coordinates as E, in sub-pixels. And the values must be less than
    /// 2¹⁹ − 4 apart: a quarter of a difference is then less than 2¹⁷, and 32 bits are enough.
    #[inline(always)]
    pub(crate) fn is_near(&self, dz1: i32, dz2: i32) -> bool {
        let bits = magnitude(dz1) | magnitude(dz2);
        debug_assert!(self.extent.is_tiny());
        (bits + 4) >> 19 == 0 && (self.area >> 5) as u32 > self.extent.0
    }

    /// [`through`](Self::through) if the numerators are exact in 32 bits and the gradient is not steep: then a pixel is off
    /// by less than `(w + h)·½ + 35`. `None` otherwise.
    #[inline(always)]
    pub(crate) fn through_exactly(&self, values: &[i32; 3]) -> Option<Gradient> {
        let numerators =
            Numerators::in_32_bits(self.triangle, self.extent.headroom(), values).filter(|n| n.k >= 0)?;
        Some(self.slope(&numerators, values)?.gradient())
    }

    /// The gradient relative to the first corner's pixel, with the error of [`through`](Self::through); `None` if it is
    /// steep.
    #[inline(always)]
    pub(crate) fn slope_through(&self, values: &[i32; 3]) -> Option<Slope> {
        self.slope(&Numerators::new(self.triangle, self.extent.headroom(), values), values)
    }

    #[inline(always)]
    fn slope(&self, Numerators { x, minus_y, k }: &Numerators, [value, ..]: &[i32; 3]) -> Option<Slope> {
        let Triangle { corners: [a, ..], .. } = self.triangle;
        let shift = self.shift + k;
        if shift < MIN_SHIFT {
            return None;
        }
        // The upper word, shifted by the rest, at most 60 − 32, and rounded to nearest.
        let step = |v: i32, by: i32| ((mul_high(v, by) >> ((shift - 33) & 31)) + 1) >> 1;
        let (right, down) = (step(*x, self.mantissa), step(*minus_y, -self.mantissa)); // ≤ 2²⁸

        let at = ((right >> 5) * to_centre(a.x) + (down >> 5) * to_centre(a.y)) >> 3; // two products of 2³⁰
        Some(Slope::new(a, (value << 8).wrapping_add(at), right, down))
    }

    /// The gradient if it is steep. It is computed relative to an anchor, because the error grows with the distance from there:
    /// the pixel of the viewport that is nearest to the first corner. The viewport is that of the frame, so all bands get equal
    /// bits.
    #[cold]
    #[inline(never)]
    fn steep(&self, values: &[i32; 3], &Numerators { x, minus_y, k }: &Numerators) -> Gradient {
        let shift = self.shift + k;
        let Triangle { corners, area, viewport } = self.triangle;
        // Per sub-pixel: 24 bits of the values, and 40 more. The products lie below 2⁶²: a step is at most
        // 2^(62 − shift), and 2⁻²⁸ of it times the extent, 2^(24 − headroom) pixels, less than 2⁹ for x and for y.
        let (right, down) = if shift >= 49 - self.extent.headroom() && shift >= 24 {
            let by_reciprocal = |v: i32| mul_wide(v, self.mantissa) >> ((shift - 24) & 63);
            (by_reciprocal(x), -by_reciprocal(minus_y))
        } else {
            // Signs turned so that den's magnitude is the divisor.
            let turn = |dz: i32| if *area < 0 { dz } else { -dz };
            let (dz1, dz2) = differences(values);
            let (x, minus_y) = wide_numerators(corners, turn(dz1), turn(dz2));
            let divide = |v: i64| divide_long(v, area.unsigned_abs(), self.mantissa.abs());
            (divide(x), divide(-minus_y))
        };
        // The anchor, here because the divisions above need the registers.
        let [a, ..] = corners;
        let column = (a.x >> 8).clamp(viewport.left, viewport.right.max(viewport.left));
        let row = (a.y >> 8).clamp(viewport.top, viewport.bottom.max(viewport.top));
        // From the corner to the anchor's centre: up to 2²³ sub-pixels.
        let (dx, dy) = (256 * column + 128 - a.x, 256 * row + 128 - a.y);
        let [value, ..] = *values;
        let at = ((value as u64) << 40)
            .wrapping_add((right as u64).wrapping_mul(i64::from(dx) as u64))
            .wrapping_add((down as u64).wrapping_mul(i64::from(dy) as u64));
        // A pixel is 256 sub-pixels; from 24.40 to 24.8, to nearest.
        let step = |g: i64| (g.wrapping_add(1 << 23) >> 24) as i32;
        Slope { at: (at >> 32) as i32, right: step(right), down: step(down), pixel: (column, row) }.gradient()
    }
}

/// A gradient relative to a pixel near the triangle, where its values do not wrap yet and can be scaled.
#[derive(Clone, Copy)]
pub(crate) struct Slope {
    /// The value at `pixel` in 2⁻⁸ of the corners' unit, as are the steps. Except for
    /// [tiny triangles](GradientSetup::through_tiny) it does not wrap and is within 2²⁹ of the corner's value.
    at: i32,
    right: i32,
    down: i32,
    pixel: (i32, i32),
}

/// The distance from a coordinate to the centre of its pixel: −127 … 128 sub-pixels.
#[inline(always)]
pub(crate) fn to_centre(p: i32) -> i32 {
    128 - (p & 255)
}

impl Slope {
    /// A slope relative to the pixel of a corner.
    #[inline(always)]
    pub(crate) fn new(corner: &ScreenPoint, at: i32, right: i32, down: i32) -> Self {
        Self { at, right, down, pixel: (corner.x >> 8, corner.y >> 8) }
    }

    /// The gradient, relative to pixel (0, 0).
    #[inline(always)]
    pub(crate) fn gradient(&self) -> Gradient {
        let Self { at, right, down, pixel: (column, row) } = *self;
        let origin = at.wrapping_sub(right.wrapping_mul(column)).wrapping_sub(down.wrapping_mul(row));
        Gradient { origin: origin as u32, right: right as u32, down: down as u32 }
    }

    /// The gradient of the values times `factor / 2^cut`, modulo 2³²: for values up to 2²²·⁵ at the corners, `factor` below 2¹⁶
    /// and `cut` from 1 to 16. The value at the corner's pixel and the steps are rounded down.
    #[inline(always)]
    pub(crate) fn times(&self, factor: i32, cut: u32) -> Gradient {
        let times = |v: i32| {
            // Two products: |high| ≤ 2¹⁵, 0 ≤ low < 2¹⁶.
            let (high, low) = (v >> 16, v & 0xffff);
            let low = (low as u32).wrapping_mul(factor as u32) >> cut;
            (high * factor).wrapping_shl(16 - cut).wrapping_add(low as i32)
        };
        Self { at: times(self.at), right: times(self.right), down: times(self.down), ..*self }.gradient()
    }
}

/// A number whose highest bit is that of |v|, or of |v| − 1 for negative v.
#[inline(always)]
fn magnitude(v: i32) -> u32 {
    (v ^ (v >> 31)) as u32
}

/// The magnitude of an area beyond 128 pixels cut to 31 bits, and how many bits were cut; beyond 512 pixels −64, so that
/// every gradient counts as steep.
#[inline(never)]
fn cut_area(triangle: &Triangle<'_>, extent: Extent) -> (i32, i32) {
    let area = triangle.area.unsigned_abs();
    let cut = (33 - area.leading_zeros() as i32).max(0); // ≤ 15
    ((area >> (cut & 31)) as i32, if extent.is_large() { -64 } else { cut })
}

/// Both numerators exactly; the numerator for y has its sign turned.
#[inline(never)] // on a Cortex-M0 its products are long
fn wide_numerators([a, b, c]: &[ScreenPoint; 3], dz1: i32, dz2: i32) -> (i64, i64) {
    // |dx|, |dy| ≤ 2²², |dz| < 2²⁴: below 2⁴⁷ each.
    let x = mul_wide(dz1, c.y - a.y) + mul_wide(dz2, b.y - a.y);
    let minus_y = mul_wide(dz1, c.x - a.x) + mul_wide(dz2, b.x - a.x);
    (x, minus_y)
}

/// The numerators from 64-bit products, cut to 31 bits.
#[inline(never)]
fn numerators_in_64_bits(triangle: &Triangle<'_>, values: &[i32; 3]) -> Numerators {
    let (dz1, dz2) = differences(values);
    let (x, minus_y) = wide_numerators(&triangle.corners, dz1, dz2);
    let high = |v: i64| (v ^ (v >> 63)) as u64;
    let cut = (33 - (high(x) | high(minus_y)).leading_zeros() as i32).max(0); // ≤ 16
    let shift = cut & 31;
    Numerators { x: (x >> shift) as i32, minus_y: (minus_y >> shift) as i32, k: -cut }
}

/// `⌊v · 2⁴⁰ / area⌋` modulo 2⁶⁴ for |v| < 2⁴⁷ and 0 < area < 2⁴⁶, 29 bits at a time: for slivers and for triangles beyond 512 pixels.
/// `mantissa` is that of the [reciprocal](crate::math::num::reciprocal) of the area's upper 31 bits.
///
/// With the area shifted to 2⁶⁰ ≤ a < 2⁶¹, and a remainder ρ < a, the next n ≤ 29 bits are ⌊ρ · 2ⁿ / a⌋. They are estimated as the
/// upper 31 bits of ρ times the mantissa. The mantissa has a relative error of 2⁻²⁹, and the bits dropped from a and from ρ
/// add 2⁻³⁰ each, ρ's only downwards: the estimate is less than 1.6 too large, and with the final rounding less than 2.6 too small.
/// Two less, or 0, is never too large, and less than 4.6 too small: what is left of ρ · 2ⁿ is below 4.6·a < 2⁶⁴.
///
/// A negative v begins with the quotient −1 and the remainder a + v, so that the result is rounded down.
#[cold]
#[inline(never)] // code size
fn divide_long(v: i64, area: u64, mantissa: i32) -> i64 {
    let up = area.leading_zeros().wrapping_sub(3) & 63; // 15 … 60
    let a = area << up;
    let mut quotient = (v >> 63) as u64;
    let mut remainder = ((v << 13) as u64).wrapping_add(a & quotient); // |v · 2¹³| < 2⁶⁰
    let mut left = up + 40 - 13; // 42 … 87
    while left != 0 {
        let n = left.min(29);
        let estimate = mul_high((remainder >> 30) as i32, mantissa) >> (29 - n);
        let mut digits = (estimate - 2).max(0) as u32; // at most 2²⁹
        remainder = (remainder << n).wrapping_sub(a.wrapping_mul(digits.into()));
        while remainder >= a {
            keep_rolled();
            (remainder, digits) = (remainder.wrapping_sub(a), digits.wrapping_add(1));
        }
        quotient = (quotient << n).wrapping_add(digits.into());
        left -= n;
    }
    quotient as i64
}

impl Triangle<'_> {
    /// The gradient of a value given at each corner, 0 … 2²⁴ − 1 in the corners' order, for custom shaders. Larger values
    /// count as 2²⁴ − 1.
    pub fn gradient(&self, values: [u32; 3]) -> Gradient {
        GradientSetup::new(self).through(&values.map(|value| value.min((1 << 24) - 1) as i32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::mixed;

    /// Against 128-bit division: areas and numerators of all lengths, multiples of the area and their neighbours, and the ends of
    /// both ranges.
    #[test]
    fn long_division_is_exact() {
        let check = |v: i64, area: i64| {
            let (area, cut) = (area as u64, (33 - area.leading_zeros() as i32).max(0));
            let mantissa = reciprocal_of_positive((area >> cut) as i32).mantissa;
            for v in [v, -v] {
                let exact = (i128::from(v) << 40).div_euclid(area.into());
                assert_eq!(divide_long(v, area, mantissa), exact as i64, "{v} {area}");
            }
        };
        let ends = |bits: u32| [(1 << bits) - 1, 1 << (bits - 1), (1 << (bits - 1)) + 1];
        for (bits, other) in (1..=46).flat_map(|bits| (1..=47).map(move |other| (bits, other))) {
            for (area, v) in ends(bits).into_iter().flat_map(|area| ends(other).map(|v| (area, v))) {
                check(v, area);
            }
        }
        let mut state = 7;
        let mut random = |bits: u32| (mixed(&mut state) >> (64 - bits)) as i64;
        let largest = (1 << 47) - 1;
        for i in 0..500_000 {
            let area = random(1 + i % 46).max(1);
            check(random(1 + i / 46 % 47), area);
            // Multiples of the area, and their neighbours.
            let most = largest / area;
            for times in [most, random(47) % (most + 1), random(4).min(most)] {
                check(times * area, area);
                check((times * area + 1).min(largest), area);
                check((times * area - 1).max(0), area);
            }
        }
    }
}
