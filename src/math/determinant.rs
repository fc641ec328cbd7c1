//! The determinant of two vectors of the screen: twice a triangle's area.

use super::num::{mul_wide, CORTEX_M0};

/// `x2·y1 − x1·y2` for components below 2²³ in magnitude.
#[inline(always)]
pub(crate) fn determinant((x1, y1): (i32, i32), (x2, y2): (i32, i32)) -> i64 {
    // A Cortex-M0 has no instruction for 64-bit products. Components in −2¹⁵ … 2¹⁵ − 1 have products of at most 2³⁰ in
    // magnitude, and the two products do not reach 2³⁰ with opposite signs.
    if CORTEX_M0 {
        let biased = |v: i32| (v + (1 << 15)) as u32;
        if (biased(x1) | biased(y1) | biased(x2) | biased(y2)) >> 16 == 0 {
            return (x2 * y1).wrapping_sub(x1 * y2).into();
        }
    }
    // A sum instead of a difference: most cores multiply and add in one instruction.
    mul_wide(x2, y1) + mul_wide(-x1, y2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn determinants_are_exact() {
        let random = &mut Random(21);
        for i in 0..100_000 {
            let reach = [1 << 15, 300, 1 << 22, (1 << 23) - 1][i % 4];
            let mut vector = || (random.within(reach), random.within(reach));
            let (a, b) = (vector(), vector());
            let exact = i64::from(b.0) * i64::from(a.1) - i64::from(a.0) * i64::from(b.1);
            assert_eq!(determinant(a, b), exact, "{a:?} {b:?}");
        }
        for x in [-1 << 15, (1 << 15) - 1] {
            for y in [-1 << 15, (1 << 15) - 1] {
                let exact = i64::from(x) * i64::from(y) - i64::from(y) * i64::from(x);
                assert_eq!(determinant((y, y), (x, x)), exact);
                assert_eq!(determinant((x, y), (x, y)), 0);
            }
        }
    }
}
