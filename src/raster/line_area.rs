//! The areas that an anti-aliased line covers of the pixels of a column.
//!
//! A line of slope m ≤ 1 is √(1 + m²) high in a column, which is 1 wide. Let its middle, in the middle of the column, lie in a
//! pixel at f of its height, 0 ≤ f < 1. In this column the line reaches up to h = (√(1 + m²) + m)/2 above its middle, so x = h −
//! f above the pixel. Its part above the pixel is a triangle of area x²/2m while x < m; beyond, the area is x − m/2, because the
//! upper edge rises by m. The part below the pixel has the areas for x = h − (1 − f), and the pixel itself has the rest. h is at
//! most 1.21, so the line may also cover a triangle of the pixel after the next one, of area (x − 1)²/2m, at most 0.0215: where x
//! > 1, which takes m > 3/4.

use crate::math::num::reciprocal;

/// 1 in areas, lengths and slopes: 2⁻¹⁶.
const ONE: i32 = 1 << 16;

/// The number of pixels of a column that a line may cover. In the order of their rows, the line's middle lies in the one with
/// index 2.
pub(crate) const PIXELS: usize = 5;

/// The slope of a line, prepared for the areas of its columns: all in 2⁻¹⁶ except `inverse`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineArea {
    /// √(1 + m²): 65536 … 92682.
    pub(crate) height: i32,
    /// h less ½: 32767 … 79108. Fractions have ½ added.
    reach: i32,
    /// m, or 0 if it is below 2⁻¹⁰: then triangles have less than 2⁻¹³ pixel.
    pub(crate) slope: i32,
    /// 1/m in 2⁻¹⁵: at most 2²⁵. It is not used if m is 0.
    inverse: u32,
}

impl LineArea {
    /// The preparation for a slope of 0 … 2²⁹ − 1 in 2⁻²⁹.
    #[inline(always)]
    pub(crate) fn new(slope: u32) -> Self {
        let inverse = inverse_of_slope(slope);
        let m = if slope < 1 << 19 { 0 } else { slope >> 13 };
        let height = height(m);
        Self { height, reach: (height + m as i32 - 1) >> 1, slope: m as i32, inverse }
    }

    /// How far the line reaches beyond the pixel in which its middle lies at this fraction of its height, in 2⁻³²: upwards and
    /// downwards, −32768 … 79108.
    #[inline(always)]
    pub(crate) fn beyond(&self, fraction: u32) -> [i32; 2] {
        // With ½ added, a fraction and its complement are f and 1 − f.
        let f = (fraction >> 16) as i32;
        [self.reach - f, self.reach - (ONE - 1) + f]
    }

    /// For a line that reaches `x`, above 0, beyond a border between two pixels: the area beyond the border, and the part of this
    /// area that is more than a pixel beyond it.
    #[inline(always)]
    pub(crate) fn area(&self, x: i32) -> (i32, i32) {
        if x < self.slope {
            (self.triangle(x), 0)
        } else {
            (x - (self.slope >> 1), if x > ONE { self.triangle(x - ONE) } else { 0 })
        }
    }

    /// x²/2m, for x of 0 … m.
    #[inline(always)]
    pub(crate) fn triangle(&self, x: i32) -> i32 {
        triangle(x, self.inverse)
    }

    /// The areas of the pixels of a column, in the order of their rows. `fraction`: where the middle lies in its pixel, in 2⁻³².
    #[inline(always)]
    pub(crate) fn column(&self, fraction: u32) -> [i32; PIXELS] {
        let [(before, far_before), (after, far_after)] =
            self.beyond(fraction).map(|x| if x > 0 { self.area(x) } else { (0, 0) });
        let middle = self.height - before - after;
        [far_before, before - far_before, middle, after - far_after, far_after]
    }
}

/// 1/m in 2⁻¹⁵, at most 2²⁵, of a slope m of 2¹⁹ … 2²⁹ − 1 in 2⁻²⁹.
#[inline(always)]
pub(crate) fn inverse_of_slope(slope: u32) -> u32 {
    // 1/slope = mantissa · 2^(shift − 61) in 2²⁹: this is 2⁴⁴/slope. `shift` is at most 11 if the slope is at least 2¹⁹.
    let r = reciprocal(slope as i32);
    r.mantissa as u32 >> (17 - r.shift.min(17))
}

/// x²/2m, for x of 0 … m in 2⁻¹⁶ and 1/m in 2⁻¹⁵.
#[inline(always)]
pub(crate) fn triangle(x: i32, inverse: u32) -> i32 {
    // x/m ≤ 1, in 2⁻¹⁵; its product with x, halved, is in 2⁻³²: below 2³¹, as the one before.
    let width = (x as u32).wrapping_mul(inverse) >> 16;
    ((x as u32).wrapping_mul(width) >> 16) as i32
}

/// The part of a pixel that `area`, 0 … 2¹⁶ in 2⁻¹⁶, leaves uncovered, in 2^−`bits`, `bits` 1 … 15: rounded to nearest, and down
/// where two are equally near.
#[inline(always)]
pub(crate) const fn rest(area: i32, bits: u32) -> u32 {
    (unrounded_rest(area, bits) >> (16 - bits)) as u32
}

/// [`rest`] before it is rounded down. It is not negative: areas may be above 1 by 2⁻¹³, from rounding, which is less than half of 2^−bits.
#[inline(always)]
pub(crate) const fn unrounded_rest(area: i32, bits: u32) -> i32 {
    ONE + (ONE >> (bits + 1)) - 1 - area
}

/// 2^`bits` less [`rest`]: this area in 2^−`bits`, rounded to nearest, and up where two are equally near.
#[inline(always)]
pub(crate) const fn share(area: i32, bits: u32) -> u32 {
    ((area + (ONE >> (bits + 1))) >> (16 - bits)) as u32
}

/// √(1 + m²) in 2⁻¹⁶ for m in 2⁻¹⁶, at most 1: a polynomial of m², within 2⁻¹⁴.
#[inline(always)]
fn height(m: u32) -> i32 {
    let s = ((m * (m >> 1)) >> 16) as i32; // m² in 2⁻¹⁵: m·m/2 ≤ 2³¹

    // Interpolated at the Chebyshev nodes of 0 … 1, in 2⁻¹⁶; no factor has more than 16 bits.
    let sum = [2919, -7833, 32726].into_iter().fold(-668, |sum, term| term + ((s * sum) >> 15));
    ONE + ((s * sum) >> 15)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The fast path of a line that is drawn upside down takes the complement of a position in place of the position.
    #[test]
    fn the_complement_of_a_position_has_the_areas_in_reverse_order() {
        for slope in (0..1 << 29).step_by(1_234_567).chain([(1 << 29) - 1]) {
            let area = LineArea::new(slope);
            for fraction in (0..1 << 31).step_by(7_654_321).chain([(1 << 31) - 1]) {
                let mut mirrored = area.column(!fraction);
                mirrored.reverse();
                assert_eq!(area.column(fraction), mirrored);
            }
        }
    }

    #[test]
    fn an_area_is_rounded_to_the_nearest_share() {
        for bits in [5, 8] {
            let unit = ONE >> bits;
            for area in 0..=ONE {
                let rest = rest(area, bits) as i32;
                assert!((0..=1 << bits).contains(&rest));
                assert!(2 * (ONE - area - rest * unit).abs() <= unit);
                assert_eq!(share(area, bits) as i32, (1 << bits) - rest);
            }
            assert_eq!(rest(ONE + 8, bits), 0);
        }
    }

    /// A pixel that a line covers in full is stored, not mixed.
    #[test]
    fn level_and_diagonal_lines_through_centers() {
        for fraction in [(1 << 31) - 1, 1 << 31] {
            assert_eq!(LineArea::new(0).column(fraction).map(|area| rest(area, 8)), [256, 256, 0, 256, 256]);
            // The middle: √2 minus two triangles of (√2/2)²/2 above and below it. Each of its neighbours: ¼.
            let diagonal = LineArea::new((1 << 29) - 1).column(fraction);
            assert_eq!(diagonal.map(|area| rest(area, 8)), [256, 192, 22, 192, 256]);
        }
    }
}
