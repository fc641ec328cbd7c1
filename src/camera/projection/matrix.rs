//! Any projective matrix, as it is.

use super::{Projection, ProjectionError};
use crate::math::num::scale;
use crate::math::Row;

/// The parts of a finite float: `mantissa · 2^exponent`, exact, with at most 53 bits.
fn parts(v: f64) -> Option<(i64, i32)> {
    if !v.is_finite() {
        return None;
    }
    let bits = v.to_bits();
    let field = (bits >> 52 & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    // Subnormal numbers lack the leading one and share the exponent of field 1.
    let (mantissa, exponent) =
        if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    Some((if v < 0.0 { -mantissa } else { mantissa }, exponent))
}

/// A row of the matrix over view coordinates, all of it times 2^`shift`.
fn row(matrix_row: &[f64; 4], shift: i32) -> Option<Row> {
    let [x, y, z, constant] = *matrix_row;
    let linear = [parts(x)?, parts(y)?, parts(z)?];
    let exponent = linear.iter().filter(|(m, _)| *m != 0).map(|&(_, e)| e).max().unwrap_or(0);
    let (m, e) = parts(constant)?;
    // 53 bits moved up by at most 8 keep 61.
    let linear = linear.map(|(m, e)| scale(m, (e - exponent).max(-63)));
    Some(Row::new(linear, exponent + shift, scale(m, (e + 32 + shift).clamp(-63, 63))))
}

impl Projection {
    /// A matrix from view to clip space, row by row, for column vectors: visible points must have
    /// w > 0 and −w ≤ x, y, z ≤ w, near at z = −w. It stands for itself times any positive factor.
    ///
    /// Each row's coefficients are rounded to 30 bits of its largest, and its constant to 2⁻⁴³ of the
    /// matrix's largest coefficient or 2⁻⁵⁹ of its largest constant, whichever is more.
    ///
    /// # Errors
    ///
    /// [`ProjectionError::Matrix`] for NaN and infinities, and where all is zero.
    pub fn from_matrix(matrix: &[[f64; 4]; 4]) -> Result<Self, ProjectionError> {
        // The exponents of the largest coefficient and of the largest constant.
        let (mut linear, mut constant) = (None, None);
        for (i, &v) in matrix.iter().flatten().enumerate() {
            let (m, e) = parts(v).ok_or(ProjectionError::Matrix)?;
            if m != 0 {
                let largest = if i % 4 == 3 { &mut constant } else { &mut linear };
                *largest = (*largest).max(Some(e + 64 - m.unsigned_abs().leading_zeros() as i32));
            }
        }
        // Coefficients up to 2¹⁰ take points up to 2¹⁷ away to 2²⁹, constants are below 2²⁶: their
        // sums stay below 2³⁰, and as many bits as can be lie above the constants' 2⁻³³.
        let shift = match (linear, constant) {
            (None, None) => return Err(ProjectionError::Matrix),
            (Some(m), None) => 10 - m,
            (None, Some(c)) => 26 - c,
            (Some(m), Some(c)) => (10 - m).min(26 - c),
        };
        let [x, y, z, w] = matrix.each_ref().map(|r| row(r, shift));
        let all = (x, y, z, w);
        let (Some(x), Some(y), Some(z), Some(w)) = all else { return Err(ProjectionError::Matrix) };
        // d = (z + w)/2.
        let half = (1 << 30, -31);
        let d = z.combined(half, &w, half);
        Ok(Self { rows: [x, y, d, w] })
    }
}
