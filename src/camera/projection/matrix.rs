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
    /// Each row's coefficients are rounded to 30 bits of its largest and its constant to 2⁻³³ of
    /// the matrix's largest, times 2⁻¹⁰.
    ///
    /// # Errors
    ///
    /// [`ProjectionError::Matrix`] for NaN and infinities, and where all is zero or a row's
    /// coefficients lie more than 2³⁰ apart from the rest.
    pub fn from_matrix(matrix: &[[f64; 4]; 4]) -> Result<Self, ProjectionError> {
        // The largest number's exponent: half the constants' 2³⁰ is left for points to move in.
        let mut largest = None;
        for &v in matrix.iter().flatten() {
            let (m, e) = parts(v).ok_or(ProjectionError::Matrix)?;
            if m != 0 {
                largest = largest.max(Some(e + 64 - m.unsigned_abs().leading_zeros() as i32));
            }
        }
        let largest = largest.ok_or(ProjectionError::Matrix)?;
        // Numbers between 2⁻¹⁰ and 2²⁰ stay as they are.
        let shift = if largest > 20 { 20 - largest } else { (-10 - largest).max(0) };
        let [x, y, z, w] = matrix.each_ref().map(|r| row(r, shift));
        let all = (x, y, z, w);
        let (Some(x), Some(y), Some(z), Some(w)) = all else { return Err(ProjectionError::Matrix) };
        // d = (z + w)/2.
        let half = (1 << 30, -31);
        let d = z.combined(half, &w, half);
        Ok(Self { rows: [x, y, d, w] })
    }
}
