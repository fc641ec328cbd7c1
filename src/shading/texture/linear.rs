//! Texture coordinates that are linear on the screen.

use super::line::packed;
use super::mapping::FRACTION;
use crate::math::num::{leading_zeros, mul_high, reciprocal_of_positive};
use crate::math::unrolled::map3;
use crate::raster::{Gradient, GradientSetup, Triangle};

/// The least value, and the largest minus the least: less than 2²⁴.
#[inline(always)]
pub(super) fn range(&[a, b, c]: &[i32; 3]) -> (i32, i32) {
    let least = a.min(b).min(c);
    (least, a.max(b).max(c) - least)
}

/// Whether coordinates may be interpolated linearly over a triangle, given the differences of the coordinate, below 2²⁴, and of w
/// over it, and the least w: they are then off by less than |Δu|·|Δw|/(4·w).
///
/// The product is compared in units of 2²⁸, rounded down, with w, also rounded down: `false` where that leaves a doubt.
#[inline(always)]
pub(super) fn is_linear(du: u32, dw: u32, w: i32, tolerance: u32) -> bool {
    let product = (u64::from(du << 4) * u64::from(dw)) >> 32;
    (product as u32) < (w as u32) >> (tolerance & 31)
}

/// By how much the corners' coordinates are moved inwards, so that interpolated coordinates stay between the corners' in spite of
/// the error of [`GradientSetup::through`]. In units of its values, this error is less than ((w + h)/2 + 34 + 1552)/256 at w
/// columns and h rows from the first corner, and w + h is at most 1026 in triangles of up to 512 pixels.
const MARGIN: i32 = 9;

/// [`MARGIN`] for triangles of up to 2¹⁴ columns and rows, which have no error of 1552/256.
const LARGE_MARGIN: i32 = 71;

/// The bits of the values that a gradient is set up from, chosen so that the numerators of the set-up have 32 bits.
const VALUE_BITS: i32 = 17;

/// [`VALUE_BITS`] for triangles beyond 512 pixels, whose set-up has 64 bits in any case.
const LARGE_VALUE_BITS: i32 = 24;

/// The gradients of u and v.
#[inline(never)] // less frequent than packed ones: code size counts
pub(super) fn linear_gradients(
    triangle: &Triangle<'_>,
    [u, v]: &[[i32; 3]; 2],
    [u_range, v_range]: &[(i32, i32); 2],
    [u_unit, v_unit]: [u8; 2],
    is_wide: bool,
) -> [Gradient; 2] {
    let setup = GradientSetup::called(triangle);
    [
        linear_gradient(&setup, u, u_range, u_unit.into(), is_wide),
        linear_gradient(&setup, v, v_range, v_unit.into(), is_wide),
    ]
}

/// The gradient of one coordinate.
#[inline(never)]
fn linear_gradient(
    setup: &GradientSetup<'_>,
    coords: &[i32; 3],
    &(least, extent): &(i32, i32),
    unit: i32,
    is_wide: bool,
) -> Gradient {
    let (bits, margin) = match setup.extent.is_large() {
        true => (LARGE_VALUE_BITS, LARGE_MARGIN),
        false => (VALUE_BITS, MARGIN),
    };
    // The finer the unit, the smaller are the margin and the error of the gradient against the extent. An extent that has more
    // bits keeps them.
    let finer = (unit - 16).min(15).min(leading_zeros(extent as u32) - (32 - bits)).max(0);
    let up = (unit - 16 - finer) & 31; // 0 … 16
    let margin = if is_wide { margin } else { margin + (PACKED_MARGIN << 7 >> up) };
    let (low, high) = inside(extent << finer, margin);
    let value = |coord: i32| ((coord - least) << finer).max(low).min(high);
    // In 2^−(FRACTION + 8 + finer) units.
    let Gradient { origin, right, down } = setup.through(&map3(*coords, value));
    Gradient { origin: origin << up, right: right << up, down: down << up }.add_bias(phase(least, unit))
}

/// The range into which the values of corners, 0 to `extent`, are moved, so that errors up to `margin` do not leave 0 to
/// `extent`.
#[inline(always)]
fn inside(extent: i32, margin: i32) -> (i32, i32) {
    (margin.min(extent >> 1), (extent - margin).max(extent >> 1))
}

/// A coordinate in 2⁻³² of the side, from 2^−[`FRACTION`] of a unit of 2^`unit` of 2⁻³² of the side.
#[inline(always)]
fn phase(coord: i32, unit: i32) -> u32 {
    (coord as u32) << ((unit - FRACTION as i32) & 31)
}

/// [`MARGIN`] for the error of [packed](packed) coordinates: 18·2⁻¹⁶ of a side, and one more unit, in 2⁻¹⁷.
const PACKED_MARGIN: i32 = 37;

/// The gradient of both coordinates in one [word](packed), over a triangle of less than 32 × 32 pixels and at least one, and with
/// coordinates of less than one side.
///
/// **Error.** The word is packed in the middle of the pixels, at most 16 columns and 16 rows from each, so that steps add up to
/// (32 + 1)·½ of 2⁻¹⁶ of a side. Corners are rounded to 2⁻¹⁷ of a side, which is ½ of 2⁻¹⁶. Steps are too small by less than 2⁻³²
/// of a side per sub-pixel, and the triangle has 2 · 2¹³ sub-pixels; the reciprocal adds 2⁻²⁹ of 2¹⁷/|den| sides per sub-pixel,
/// with twice the area as den, at least 2¹⁷: both together are less than ½.
#[inline(always)]
pub(super) fn packed_gradient(
    triangle: &Triangle<'_>,
    [u, v]: &[[i32; 3]; 2],
    &[u_range, v_range]: &[(i32, i32); 2],
    [u_unit, v_unit]: [u8; 2],
) -> Option<Gradient> {
    let [a, b, c] = &triangle.corners;
    let (left, right) = (a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
    let (top, bottom) = (a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y));
    let (area, sign) = (triangle.area as i32, triangle.area as i32 >> 31);
    let den = (area ^ sign).wrapping_sub(sign); // below 2²⁶ in such a box
    if ((right - left) | (bottom - top)) >> 13 != 0 || den < 1 << 17 {
        return None;
    }
    // 1/den = mantissa · 2^(shift − 61), shift 5 … 13.
    let r = reciprocal_of_positive(den);
    // A covered pixel's centre is half a pixel from its column's begin: ±(width/2 + ½) is less than 16.5 pixels.
    let (x, y) = ((left + right) >> 9, (top + bottom) >> 9);
    let corner = Corner {
        second: [b.x - a.x, b.y - a.y],
        third: [c.x - a.x, c.y - a.y],
        middle: [(x << 8) + 128 - a.x, (y << 8) + 128 - a.y],
        // The area's sign is turned: see `GradientSetup`.
        mantissa: (r.mantissa ^ !sign).wrapping_sub(!sign),
        shift: 14 - r.shift,
    };
    let (u, u_right, u_down) = corner.slope(u, u_range, u_unit)?;
    let (v, v_right, v_down) = corner.slope(v, v_range, v_unit)?;
    let (right, down) = (packed([u_right, v_right]), packed([u_down, v_down]));
    let origin =
        packed([u, v]).wrapping_sub(right.wrapping_mul(x as u32)).wrapping_sub(down.wrapping_mul(y as u32));
    Some(Gradient { origin, right, down })
}

/// A triangle relative to its first corner.
#[derive(Clone, Copy)]
struct Corner {
    /// From the first corner to the other two, in sub-pixels: below 2¹³.
    second: [i32; 2],
    third: [i32; 2],
    /// From the first corner to the centre of the pixel in the middle.
    middle: [i32; 2],
    /// 1/den = mantissa · 2^(−47 − shift).
    mantissa: i32,
    shift: u32,
}

impl Corner {
    /// A coordinate in the middle, and its changes from a pixel to its right neighbour and to the pixel below, in 2⁻³² of the
    /// side.
    #[inline(never)] // code size
    fn slope(
        &self,
        &[ua, ub, uc]: &[i32; 3],
        (least, extent): (i32, i32),
        unit: u8,
    ) -> Option<(u32, u32, u32)> {
        let unit = i32::from(unit);
        if extent >> ((40 - unit) & 31) != 0 {
            return None;
        }
        // In 2⁻¹⁷ of the side: below 2¹⁷.
        let scaled = |coord: i32| (coord << ((unit - 16) & 31)) >> 7;
        let (low, high) = inside(scaled(extent), PACKED_MARGIN);
        let value = |coord: i32| scaled(coord - least).max(low).min(high);
        let (a, b, c) = (value(ua), value(ub), value(uc));
        let ([bx, by], [cx, cy], [x, y]) = (self.second, self.third, self.middle);
        // Two products below 2³⁰, so the sums are below 2³¹.
        let (d1, d2) = (b - a, a - c);
        let (across, up) = (d1 * cy + d2 * by, d1 * cx + d2 * bx);
        // Per sub-pixel.
        let step = |numerator: i32| mul_high(numerator, self.mantissa) >> (self.shift & 31);
        let (right, down) = (step(across), step(-up));
        let at = (a << 15).wrapping_add(right.wrapping_mul(x)).wrapping_add(down.wrapping_mul(y)) as u32;
        Some((at.wrapping_add(phase(least, unit)), (right as u32) << 8, (down as u32) << 8))
    }
}
