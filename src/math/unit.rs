//! Directions of length one, by block scaling: right for tiny and huge vectors alike.

use super::num::{excess, fraction, scale, sqrt};

/// Scales the three numbers by one power of two so that the largest has 31 bits. `None` for zero.
fn block(v: [i64; 3]) -> Option<[i64; 3]> {
    let largest = v[0].unsigned_abs().max(v[1].unsigned_abs()).max(v[2].unsigned_abs());
    if largest == 0 {
        return None;
    }
    // Rounding may carry to 2³¹ exactly, which the users below allow for.
    let shift = -excess(largest, 31);
    Some(v.map(|c| scale(c, shift)))
}

/// `v / |v|` in 2⁻³⁰, each component within 1.5·2⁻³⁰: ½ for each of its own block scaling, the
/// rounding of the length, and that of the quotient. `None` for the zero vector.
/// Wants |v| components below 2⁶².
pub(crate) fn normalise(v: [i64; 3]) -> Option<[i32; 3]> {
    let v = block(v)?;
    let square = v.iter().map(|c| c.unsigned_abs().pow(2)).sum(); // ≤ 3·2⁶²
    let length = u64::from(sqrt(square)); // 2³⁰ … 2³¹·⁸
    Some(v.map(|c| {
        // |c| ≤ length up to rounding, so 31 bits and a rounding bit: ≤ 2³¹ before, ≤ 2³⁰ after.
        let q = (fraction(c.unsigned_abs(), length, 31) + 1) >> 1;
        let q = q.min(1 << 30) as i32;
        if c < 0 {
            -q
        } else {
            q
        }
    }))
}

/// `a × b` up to a positive factor, from block-scaled factors: exact for components of 31 bits.
/// Zero where either is zero.
pub(crate) fn cross(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    let (Some(a), Some(b)) = (block(a), block(b)) else {
        return [0; 3];
    };
    // Products ≤ 2⁶², so a difference could reach 2⁶³: halved, it stays below 2⁶².
    let halved = |i: usize, j: usize| a[i] * b[j] / 2 - a[j] * b[i] / 2;
    [halved(1, 2), halved(2, 0), halved(0, 1)]
}

/// `⌈·⌋` of `a × b` for unit vectors in 2⁻³⁰, again in 2⁻³⁰: rounded to nearest.
pub(crate) fn cross_units(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    let part = |i: usize, j: usize| {
        let p = i64::from(a[i]) * i64::from(b[j]) - i64::from(a[j]) * i64::from(b[i]); // ≤ 2⁶¹
        scale(p, -30) as i32 // units: at most 2³⁰
    };
    [part(1, 2), part(2, 0), part(0, 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn e4_tiny_and_huge_vectors_have_length_one() {
        for v in [[1, 0, 0], [0, -1, 1], [1, 2, -2], [1 << 40, 1, -(1 << 39)], [i64::MAX / 4; 3]] {
            let unit = normalise(v).unwrap();
            let length = v.iter().map(|&c| (c as f64).powi(2)).sum::<f64>().sqrt();
            for (u, c) in unit.iter().zip(v) {
                assert!((f64::from(*u) - c as f64 / length * 1_073_741_824.0).abs() <= 1.0, "{v:?}");
            }
        }
        assert_eq!(normalise([0; 3]), None);
        assert_eq!(normalise([0, 0, -7]), Some([0, 0, -(1 << 30)]));
    }
}
