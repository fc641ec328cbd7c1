//! Integer building blocks, and the little of f64 that set-up needs and `core` lacks.

/// `a · b`, exact. A Cortex-M0 multiplies 32 × 32 bits to the low 32 only: there, from four 16-bit products.
#[inline(always)]
pub(crate) fn mul_wide(a: i32, b: i32) -> i64 {
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    {
        let (ah, al, bh, bl) = (a >> 16, a & 0xffff, b >> 16, b & 0xffff);
        let low = (al as u32).wrapping_mul(bl as u32);
        let (left, right) = (ah.wrapping_mul(bl), al.wrapping_mul(bh)); // within ±2³¹
        let middle = (low >> 16) + (left as u32 & 0xffff) + (right as u32 & 0xffff); // below 2¹⁸
        let high = ah * bh + (left >> 16) + (right >> 16) + (middle >> 16) as i32;
        i64::from(high) << 32 | i64::from(middle << 16 | (low & 0xffff))
    }
    #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
    {
        i64::from(a) * i64::from(b)
    }
}

/// `⌊a · b / 2³²⌋`.
#[inline(always)]
pub(crate) fn mul_high(a: i32, b: i32) -> i32 {
    (mul_wide(a, b) >> 32) as i32
}

/// `⌊a · b / 2¹⁶⌋` for 0 ≤ b ≤ 2¹⁶.
#[inline(always)]
pub(crate) fn mul_middle(a: i32, b: i32) -> i32 {
    if cfg!(all(target_arch = "arm", not(target_has_atomic = "32"))) {
        let low = (a as u32 & 0xffff) * b as u32; // below 2³²
        (a >> 16) * b + (low >> 16) as i32
    } else {
        ((i64::from(a) * i64::from(b)) >> 16) as i32
    }
}

/// Whether `|v| < limit`, for a limit of at least 0.
#[inline(always)]
pub(crate) fn within(v: i32, limit: i32) -> bool {
    (v.wrapping_add(limit) as u32) < (limit as u32) << 1
}

/// The nearest integer; saturates.
pub(crate) fn nearest(v: f64) -> i64 {
    (if v < 0.0 { v - 0.5 } else { v + 0.5 }) as i64
}

/// The nearest integer of 32 bits; saturates.
pub(crate) fn nearest32(v: f64) -> i32 {
    nearest(v).clamp(i32::MIN.into(), i32::MAX.into()) as i32
}

/// 2^e.
pub(crate) fn exp2(e: i32) -> f64 {
    f64::from_bits(((1023 + e) as u64) << 52)
}

/// The least e with `|v| < 2^e`.
pub(crate) fn log2_above(v: f64) -> i32 {
    ((v.to_bits() >> 52) & 0x7ff) as i32 - 1022
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// |a| + |b| + |c|.
pub(crate) fn sum_of(row: [f64; 3]) -> f64 {
    row[0].abs() + row[1].abs() + row[2].abs()
}
