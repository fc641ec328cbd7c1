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
    /// Through corners with values 0 … 2²⁴ − 1.
    ///
    /// **Error.** In 2⁻⁸ of the corners' unit, a pixel w columns and h rows from the corner's pixel, and
    /// not more than they span from it, is off by less than `(w + h)·½` for the rounding of the steps, 1
    /// for that of the origin, and, by the quick way, 2¹⁰·⁶ for the reciprocal: see [`quick`].
    #[inline]
    pub(crate) fn new(triangle: &Triangle, [za, zb, zc]: [i32; 3]) -> Self {
        let Triangle { corners: [a, b, c], area, viewport } = triangle;
        // |dx|, |dy| ≤ 2²², |dz| < 2²⁴.
        let (dx1, dy1) = (b.x - a.x, b.y - a.y);
        let (dx2, dy2) = (c.x - a.x, c.y - a.y);
        let (dz1, dz2) = (zb - za, zc - za);
        // Below 2⁴⁷ each; over `den = −area`.
        let across = mul_wide(dz2, dy1) - mul_wide(dz1, dy2);
        let along = mul_wide(dx2, dz1) - mul_wide(dx1, dz2);
        let (across, along) = if *area < 0 { (-across, -along) } else { (across, along) };
        let area = area.unsigned_abs();
        // Steps per sub-pixel: 24 bits of the values, and 40 more.
        let quick = if triangle.is_small() { quick(across, along, area, triangle.extent()) } else { None };
        let (column, row, gradient) = match quick {
            Some(gradient) => (a.x >> 8, a.y >> 8, gradient),
            None => {
                // From a pixel near those that are asked for: the error grows with the way. Not nearer
                // than the viewport, so that every band computes the same.
                let column = (a.x >> 8).clamp(viewport.left, viewport.right.max(viewport.left));
                let row = (a.y >> 8).clamp(viewport.top, viewport.bottom.max(viewport.top));
                (column, row, (quotient(across, area), quotient(along, area)))
            }
        };
        // To that pixel's centre: up to 2²³ sub-pixels.
        let (x, y) = (256 * column + 128 - a.x, 256 * row + 128 - a.y);
        let at = ((za as u64) << 40)
            .wrapping_add((gradient.0 as u64).wrapping_mul(i64::from(x) as u64))
            .wrapping_add((gradient.1 as u64).wrapping_mul(i64::from(y) as u64));
        // A pixel is 256 sub-pixels; from 24.40 to 24.8, to nearest.
        let step = |g: i64| (((g << 8).wrapping_add(1 << 31)) >> 32) as u32;
        let (right, down) = (step(gradient.0), step(gradient.1));
        let origin = ((at >> 32) as u32)
            .wrapping_sub(right.wrapping_mul(column as u32))
            .wrapping_sub(down.wrapping_mul(row as u32));
        Self { origin, right, down }
    }

    /// At the centre of a covered pixel.
    #[inline(always)]
    pub fn at(&self, x: i32, y: i32) -> u32 {
        self.origin
            .wrapping_add(self.right.wrapping_mul(x as u32))
            .wrapping_add(self.down.wrapping_mul(y as u32))
    }

    /// From a pixel to its right neighbour, to be added wrapping.
    #[inline(always)]
    pub fn step(&self) -> u32 {
        self.right
    }
}

/// Both gradients of a triangle within 512 pixels by a reciprocal, in 2⁻⁴⁰, or `None` where they are too steep for it.
///
/// The reciprocal of the area is off by 2⁻²⁸ of itself, and the area and the numerator, cut to 31
/// bits, by 2⁻³⁰ each: together less than 2⁻²⁷·⁴. Gradient times extent, below 2²¹ steps for x and
/// for y, makes that 2⁻⁵·⁴ steps.
#[inline]
fn quick(across: i64, along: i64, area: u64, extent: u32) -> Option<(i64, i64)> {
    // area = m·2^down with 31 bits, or fewer where it has fewer.
    let down = (33 - area.leading_zeros() as i32).max(0);
    let r = reciprocal((area >> down) as i32); // 1/m = mantissa · 2^(shift − 61)
    let by_area = |v: i64| {
        let cut = (33 - v.unsigned_abs().leading_zeros() as i32).max(0);
        // v/area · 2⁴⁰ = (v >> cut) · mantissa · 2^(cut − down + shift − 21): |product| < 2⁶².
        let left = cut - down + r.shift as i32 - 21;
        let product = mul_wide((v >> cut) as i32, r.mantissa);
        // At least 2⁻⁶¹: shifted by 21 + 17 at most, as area < 2⁴⁵.
        (left <= 0).then(|| product >> (-left).min(63))
    };
    let (x, y) = (by_area(across)?, by_area(along)?);
    let steepest = x.unsigned_abs() | y.unsigned_abs();
    // In bits: 40 of the gradient's and 8 of the extent's are fractions, and 2²¹ may be reached.
    let bits = (64 - steepest.leading_zeros()) + (32 - extent.leading_zeros());
    (bits <= 69).then_some((x, y))
}

/// `⌊v · 2⁴⁰ / area⌋` modulo 2⁶⁴ for |v| < 2⁴⁷ and 0 < area < 2⁴⁶, by long division: 87 steps, for
/// slivers and for triangles beyond 512 pixels.
#[cold]
fn quotient(v: i64, area: u64) -> i64 {
    let magnitude = v.unsigned_abs();
    let (mut quotient, mut rest) = (0u64, 0u64);
    for bit in (-40..47).rev() {
        let digit = if bit >= 0 { (magnitude >> bit) & 1 } else { 0 };
        rest = (rest << 1) | digit; // rest < 2·area
        quotient = quotient.wrapping_shl(1);
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
