//! Projections given as a 4 × 4 matrix.

use super::{Projection, ProjectionError};
use crate::math::float::{coefficients, mantissa_and_exponent, row_from_f64};

/// `a·s + b·t`. Constant indices need no bounds checks, even where the function is not inlined.
fn sum(a: &[f64; 4], s: f64, b: &[f64; 4], t: f64) -> [f64; 4] {
    [a[0] * s + b[0] * t, a[1] * s + b[1] * t, a[2] * s + b[2] * t, a[3] * s + b[3] * t]
}

impl Projection {
    /// The projection of a row-major matrix for column vectors, from view to clip space: visible points must have w > 0 and −w
    /// ≤ x, y, z ≤ w, with the near plane at z = −w. A positive factor of the whole matrix changes nothing.
    ///
    /// The rows x, y, w and (z + w)/2 are stored: each row's coefficients are rounded to 30 bits of its
    /// largest, and its constant to the larger of 2⁻⁴² of the matrix's largest coefficient and 2⁻⁵⁸ of its largest constant.
    ///
    /// # Errors
    ///
    /// [`ProjectionError::Matrix`] if a number is NaN or infinite, or all are zero.
    ///
    /// ```
    /// use pinhole::{space::View, Point3, Projection, ProjectionError};
    /// // A reverse perspective, in which distant objects are larger: w = 1 + z/8.
    /// let reverse =
    ///     [[0.5, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0], [0.0, 0.0, -0.25, -1.0], [0.0, 0.0, 0.125, 1.0]];
    /// let lens = Projection::from_matrix(&reverse)?;
    /// let across = |z| lens.apply(Point3::<View>::from_ints(1, 0, z)).ndc().map(|ndc| ndc.x().to_f32());
    /// assert_eq!((across(0), across(-4)), (Some(0.5), Some(1.0)));
    /// assert_eq!(lens.to_matrix(), reverse.map(|row| row.map(|c| 0.5 * c))); // the same for any positive factor
    /// # Ok::<(), ProjectionError>(())
    /// ```
    pub fn from_matrix(matrix: &[[f64; 4]; 4]) -> Result<Self, ProjectionError> {
        // The exponents of the largest coefficient and of the largest constant.
        let (mut linear, mut constant) = (None, None);
        for (i, &v) in matrix.iter().flatten().enumerate() {
            let (m, e) = mantissa_and_exponent(v).ok_or(ProjectionError::Matrix)?;
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
        let [x, y, z, w] = matrix;
        // d = (z + w)/2 in f64, exact or nearly so, so that it is rounded to 30 bits only once.
        let d = sum(z, 0.5, w, 0.5);
        let all =
            (row_from_f64(x, shift), row_from_f64(y, shift), row_from_f64(&d, shift), row_from_f64(w, shift));
        let (Some(x), Some(y), Some(d), Some(w)) = all else { return Err(ProjectionError::Matrix) };
        Ok(Self { rows: [x, y, d, w] })
    }

    /// The row-major matrix that the camera uses, scaled by a power of two so that the largest number of its last row is ½ to 1. Exact but
    /// for the row z, which is computed from (z + w)/2 and rounded to 53 bits. [`from_matrix`](Self::from_matrix) reads it back.
    pub fn to_matrix(&self) -> [[f64; 4]; 4] {
        let [x, y, d, w] = &self.rows;
        let largest = coefficients(w, 0).into_iter().fold(0.0f64, |a, b| a.max(b.abs()));
        let shift = match mantissa_and_exponent(largest) {
            Some((m, e)) if m != 0 => -(e + 64 - m.leading_zeros() as i32),
            _ => 0,
        };
        let [x, y, d, w] = [x, y, d, w].map(|row| coefficients(row, shift));
        [x, y, sum(&d, 2.0, &w, -1.0), w]
    }
}
