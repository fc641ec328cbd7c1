//! Depth over a triangle: the plane through its corners, stepped in 16.16.
//!
//! At the centre of a covered pixel the plane lies between the depths of the corners, so only its
//! value modulo 2¹⁶ steps has to be carried: all sums here wrap, and no gradient is too steep.
//!
//! With corners a, b, c and differences from a, the plane climbs by
//!
//! ```text
//!     ∂z/∂x = (dz₁·dy₂ − dz₂·dy₁) / den,   ∂z/∂y = (dx₁·dz₂ − dx₂·dz₁) / den,   den = dx₁·dy₂ − dx₂·dy₁
//! ```
//!
//! (Pineda, *A parallel algorithm for polygon rasterization*, 1988, section 3.4.)

use super::{Scissor, ScreenPoint};
use crate::math::num::{mul_wide, reciprocal};

/// The largest depth of a corner in 16.8. Less than 65534½, so that what rounding adds, which is
/// less than ¼ step, never reaches 65535.
pub(crate) const FARTHEST: i32 = 65_534 * 256 + 64;

/// A triangle's depth, for the centres of the pixels that it covers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DepthPlane {
    /// At pixel (0, 0), and the half that rounds: 16.16, wrapping, as are the steps.
    origin: u32,
    right: u32,
    down: u32,
}

impl DepthPlane {
    /// Through corners with depths in 16.8, 0 … [`FARTHEST`]. Their area is not zero; pixels
    /// outside the scissor are not asked for.
    ///
    /// **Error.** A pixel w columns and h rows from the corner's pixel, and not more than they span
    /// from it, is off by less than `(w + h)·2⁻¹⁷` for the rounding of the steps, 2⁻¹⁶ for that of the
    /// origin, and, by the quick way, 2⁻⁵·⁴ for the reciprocal: see [`quick`]. Scissors up to 8192
    /// pixels wide and high leave it below ⅛, and below ¼ in any case.
    #[inline]
    pub(crate) fn new(corners: [ScreenPoint; 3], depths: [i32; 3], scissor: &Scissor) -> Self {
        let ([a, b, c], [za, zb, zc]) = (corners, depths);
        let area = super::area(&corners);
        // |dx|, |dy| ≤ 2²², |dz| < 2²⁴.
        let (dx1, dy1, dz1) = (b.x - a.x, b.y - a.y, zb - za);
        let (dx2, dy2, dz2) = (c.x - a.x, c.y - a.y, zc - za);
        // Below 2⁴⁷ each; over `den = −area`.
        let across = mul_wide(dz2, dy1) - mul_wide(dz1, dy2);
        let along = mul_wide(dx2, dz1) - mul_wide(dx1, dz2);
        let (across, along) = if area < 0 { (-across, -along) } else { (across, along) };
        let area = area.unsigned_abs();
        let extent = (dx1.abs() | dx2.abs() | dy1.abs() | dy2.abs()).unsigned_abs();
        // Steps per sub-pixel: 24 bits of the depth in 16.8, and 40 more.
        let (column, row, gradient) = match quick(across, along, area, extent) {
            Some(gradient) => (a.x >> 8, a.y >> 8, gradient),
            None => {
                // From a pixel near those that are asked for: the error grows with the way.
                let column = (a.x >> 8).clamp(scissor.left, scissor.right.max(scissor.left));
                let row = (a.y >> 8).clamp(scissor.top, scissor.bottom.max(scissor.top));
                (column, row, (quotient(across, area), quotient(along, area)))
            }
        };
        // To that pixel's centre: up to 2²³ sub-pixels.
        let (x, y) = (256 * column + 128 - a.x, 256 * row + 128 - a.y);
        let at = ((za as u64) << 40)
            .wrapping_add((gradient.0 as u64).wrapping_mul(i64::from(x) as u64))
            .wrapping_add((gradient.1 as u64).wrapping_mul(i64::from(y) as u64))
            .wrapping_add(1 << 63); // half a step
                                    // A pixel is 256 sub-pixels; from 16.48 to 16.16, to nearest.
        let step = |g: i64| (((g << 8).wrapping_add(1 << 31)) >> 32) as u32;
        let (right, down) = (step(gradient.0), step(gradient.1));
        let origin = ((at >> 32) as u32)
            .wrapping_sub(right.wrapping_mul(column as u32))
            .wrapping_sub(down.wrapping_mul(row as u32));
        Self { origin, right, down }
    }

    /// At the centre of a covered pixel, 16.16: the integer part is the depth.
    #[inline(always)]
    pub(crate) fn at(&self, x: i32, y: i32) -> u32 {
        self.origin
            .wrapping_add(self.right.wrapping_mul(x as u32))
            .wrapping_add(self.down.wrapping_mul(y as u32))
    }

    /// From a pixel to its right neighbour.
    #[inline(always)]
    pub(crate) fn step(&self) -> u32 {
        self.right
    }
}

/// Both gradients by a reciprocal, in 2⁻⁴⁰, or `None` where they are too steep for it.
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
    (bits <= 69 && extent < 1 << 17).then_some((x, y))
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
