//! Depth, or a channel of colour, over a triangle: the plane through its corners' values, stepped in
//! 32 bits.
//!
//! At the centre of a covered pixel the plane lies between the values of the corners, so only its value
//! modulo 2²⁴ units has to be carried: all sums here wrap, and no gradient is too steep.
//!
//! With corners a, b, c and differences from a, the plane climbs by
//!
//! ```text
//!     ∂z/∂x = (dz₁·dy₂ − dz₂·dy₁) / den,   ∂z/∂y = (dx₁·dz₂ − dx₂·dz₁) / den,   den = dx₁·dy₂ − dx₂·dy₁
//! ```
//!
//! (Pineda, *A parallel algorithm for polygon rasterization*, 1988, section 3.4.)

use super::Triangle;
use crate::math::num::{mul_wide, reciprocal};
use core::hint::black_box;

/// What varies linearly over a triangle on the screen, for the centres of the pixels that it covers:
/// depth, or a channel of colour. Values are 24 bits at the corners, 32 bits at the pixels.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Plane {
    /// At pixel (0, 0), in 2⁻⁸ of the corners' unit, wrapping, as are the steps.
    pub(super) origin: u32,
    right: u32,
    down: u32,
}

impl Plane {
    /// At the centre of a covered pixel.
    #[inline(always)]
    pub fn at(&self, x: i32, y: i32) -> u32 {
        self.origin
            .wrapping_add(self.right.wrapping_mul(x as u32))
            .wrapping_add(self.down.wrapping_mul(y as u32))
    }

    /// From a pixel to the one below, to be added wrapping.
    #[inline(always)]
    pub(crate) fn down(&self) -> u32 {
        self.down
    }

    /// From a pixel to its right neighbour, to be added wrapping.
    #[inline(always)]
    pub fn step(&self) -> u32 {
        self.right
    }
}

/// What all planes over a triangle share.
pub(crate) struct Planes<'t> {
    triangle: &'t Triangle,
    /// `den`: the area's magnitude.
    area: u64,
    /// The reciprocal of the area's upper 31 bits, and its exponent: see [`quick`](Self::quick).
    mantissa: i32,
    exponent: i32,
    /// Bits of the largest difference between corners.
    extent: i32,
}

impl<'t> Planes<'t> {
    /// Over a triangle.
    #[inline(never)]
    pub(crate) fn new(triangle: &'t Triangle) -> Self {
        let area = triangle.area.unsigned_abs();
        // area = m·2^down with 31 bits, or fewer where it has fewer.
        let down = (33 - area.leading_zeros() as i32).max(0); // ≤ 16
        let r = reciprocal((area >> (down & 31)) as i32); // 1/m = mantissa · 2^(shift − 61)
        Self {
            triangle,
            area,
            mantissa: r.mantissa,
            exponent: r.shift as i32 - down - 21,
            extent: 32 - triangle.extent().leading_zeros() as i32,
        }
    }

    /// Whether all edges are shorter than 512 pixels.
    #[inline(always)]
    pub(super) fn is_small(&self) -> bool {
        self.extent <= 17
    }

    /// Through values 0 … 2²⁴ − 1 at the corners.
    ///
    /// **Error.** In 2⁻⁸ of the corners' unit, a pixel w columns and h rows from the corner's pixel, and
    /// not more than they span from it, is off by less than `(w + h)·½` for the rounding of the steps, 1
    /// for that of the origin, and, by the quick way, 2¹⁰·⁶ for the reciprocal: see [`quick`](Self::quick).
    #[inline(never)]
    pub(crate) fn through(&self, &[za, zb, zc]: &[i32; 3]) -> Plane {
        let Triangle { corners: [a, b, c], area, viewport } = self.triangle;
        // |dx|, |dy| ≤ 2²², |dz| < 2²⁴, turned so that they go with den's magnitude.
        let turn = |dz: i32| if *area < 0 { dz } else { -dz };
        let (dz1, dz2) = (turn(zb - za), turn(zc - za));
        // Below 2⁴⁷ each.
        let across = mul_wide(dz1, c.y - a.y) - mul_wide(dz2, b.y - a.y);
        let along = mul_wide(dz2, b.x - a.x) - mul_wide(dz1, c.x - a.x);
        // Steps per sub-pixel: 24 bits of the values, and 40 more.
        let (mut column, mut row) = (a.x >> 8, a.y >> 8);
        let gradient = self.quick(across, along).unwrap_or_else(|| {
            // From a pixel near those that are asked for: the error grows with the way. Not nearer
            // than the viewport, so that every band computes the same.
            column = column.clamp(viewport.left, viewport.right.max(viewport.left));
            row = row.clamp(viewport.top, viewport.bottom.max(viewport.top));
            (quotient(across, self.area), quotient(along, self.area))
        });
        // To that pixel's centre: up to 2²³ sub-pixels.
        let (x, y) = (256 * column + 128 - a.x, 256 * row + 128 - a.y);
        let at = ((za as u64) << 40)
            .wrapping_add((gradient.0 as u64).wrapping_mul(i64::from(x) as u64))
            .wrapping_add((gradient.1 as u64).wrapping_mul(i64::from(y) as u64));
        // A pixel is 256 sub-pixels; from 24.40 to 24.8, to nearest.
        let step = |g: i64| (g.wrapping_add(1 << 23) >> 24) as u32;
        let (right, down) = (step(gradient.0), step(gradient.1));
        let origin = ((at >> 32) as u32)
            .wrapping_sub(right.wrapping_mul(column as u32))
            .wrapping_sub(down.wrapping_mul(row as u32));
        Plane { origin, right, down }
    }

    /// Both gradients of a triangle within 512 pixels by a reciprocal, in 2⁻⁴⁰, or `None` where they are too
    /// steep for it.
    ///
    /// The reciprocal of the area is off by 2⁻²⁸ of itself, and the area and the numerator, cut to 31
    /// bits, by 2⁻³⁰ each: together less than 2⁻²⁷·⁴. Gradient times extent, at most 2²¹ steps for x and
    /// for y, makes that 2⁻⁵·⁴ steps.
    #[inline(always)]
    fn quick(&self, across: i64, along: i64) -> Option<(i64, i64)> {
        if !self.is_small() {
            return None;
        }
        let by_area = |v: i64| {
            let cut = (33 - v.unsigned_abs().leading_zeros() as i32).max(0); // ≤ 16
                                                                             // v/area · 2⁴⁰ = (v >> cut) · mantissa · 2^(cut − down + shift − 21): |product| < 2⁶².
            let product = mul_wide((v >> (cut & 31)) as i32, self.mantissa);
            // Shifted by 21 + 17 at most, as area < 2⁴⁵; not to the left: that is too steep.
            let right = -(cut + self.exponent);
            (right >= 0).then(|| product >> (right & 63))
        };
        let (x, y) = (by_area(across)?, by_area(along)?);
        // Bits of the steepest beyond 32. Of the gradient's 40 are fractions and 8 of the extent's, and 2²¹ may be
        // reached: 69 in all.
        let high = |g: i64| ((g >> 32) ^ (g >> 63)) as u32;
        let bits = 32 - (high(x) | high(y)).leading_zeros() as i32;
        (bits + self.extent <= 69 - 32).then_some((x, y))
    }
}

/// `⌊v · 2⁴⁰ / area⌋` modulo 2⁶⁴ for |v| < 2⁴⁷ and 0 < area < 2⁴⁶, by long division: 87 steps, for
/// slivers and for triangles beyond 512 pixels.
#[cold]
#[inline(never)]
fn quotient(v: i64, area: u64) -> i64 {
    let mut digits = v.unsigned_abs() << 17;
    let (mut quotient, mut rest) = (0u64, 0u64);
    for _ in 0..87 {
        black_box(()); // not unrolled
        rest = (rest << 1) | (digits >> 63); // rest < 2·area
        (digits, quotient) = (digits << 1, quotient << 1);
        if rest >= area {
            rest = rest.wrapping_sub(area);
            quotient |= 1;
        }
    }
    let quotient = quotient as i64;
    if v < 0 {
        quotient.wrapping_neg().wrapping_sub(i64::from(rest > 0))
    } else {
        quotient
    }
}
