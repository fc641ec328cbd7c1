//! Projections given as a 4 × 4 matrix.

use super::Projection;
use crate::camera::CameraError;
use crate::math::float::{coefficients, mantissa_and_exponent, row_from_f64};

/// `a·s + b·t`. Constant indices need no bounds checks, even where the function is not inlined.
fn sum(a: &[f64; 4], s: f64, b: &[f64; 4], t: f64) -> [f64; 4] {
    [a[0] * s + b[0] * t, a[1] * s + b[1] * t, a[2] * s + b[2] * t, a[3] * s + b[3] * t]
}

/// The names of a matrix's rows.
const NAMES: [char; 4] = ['x', 'y', 'z', 'w'];

/// How many times the largest number of the other rows a number may be, 2³²: more than in any matrix of another constructor.
const LARGEST_RATIO: f64 = 4_294_967_296.0;

/// The largest magnitude of four numbers or fewer.
fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}

/// The exponent e of a finite number with 2^(e − 1) ≤ `v` < 2^e; `None` of 0.
fn exponent(v: f64) -> Option<i32> {
    let (m, e) = mantissa_and_exponent(v).filter(|&(m, _)| m != 0)?;
    Some(e + 64 - m.unsigned_abs().leading_zeros() as i32)
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
    /// [`CameraError::Matrix`] names a row that has a number that is NaN, infinite or more than 2³² times the largest of the
    /// other rows, or row w if all its numbers are 0.
    ///
    /// ```
    /// use pinhole::{space::View, Point3, Projection};
    /// // A reverse perspective, in which distant objects are larger: w = 1 + z/8.
    /// let reverse =
    ///     [[0.5, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0], [0.0, 0.0, -0.25, -1.0], [0.0, 0.0, 0.125, 1.0]];
    /// let lens = Projection::from_matrix(&reverse)?;
    /// let across = |z| lens.apply(Point3::<View>::from_ints(1, 0, z)).map(|ndc| f64::from(ndc.x()));
    /// assert_eq!((across(0), across(-4)), (Some(0.5), Some(1.0)));
    /// assert_eq!(lens.to_matrix(), reverse.map(|row| row.map(|c| 0.5 * c))); // the same for any positive factor
    /// # Ok::<(), pinhole::camera::CameraError>(())
    /// ```
    pub fn from_matrix(matrix: &[[f64; 4]; 4]) -> Result<Self, CameraError> {
        let rows = || matrix.iter().zip(NAMES);
        for (row, name) in rows() {
            let others = rows().filter(|&(_, other)| other != name);
            let others = others.fold(0.0, |most: f64, (other, _)| most.max(largest(other)));
            let is_in_range = largest(row) <= others * LARGEST_RATIO && (name != 'w' || largest(row) > 0.0);
            if !is_in_range || !row.iter().all(|v| v.is_finite()) {
                return Err(CameraError::Matrix { row: name });
            }
        }
        let linear = exponent(largest(&matrix.map(|[a, b, c, _]| largest(&[a, b, c]))));
        let constant = exponent(largest(&matrix.map(|[.., constant]| constant)));
        // Coefficients up to 2¹⁰ take points up to 2¹⁷ away to 2²⁹, constants are below 2²⁶: their
        // sums stay below 2³⁰, and as many bits as can be lie above the constants' 2⁻³³.
        let shift = match (linear, constant) {
            (None, None) => 0, // never: row w is not 0
            (Some(m), None) => 10 - m,
            (None, Some(c)) => 26 - c,
            (Some(m), Some(c)) => (10 - m).min(26 - c),
        };
        let [x, y, z, w] = matrix;
        // d = (z + w)/2 in f64, exact or nearly so, so that it is rounded to 30 bits only once.
        let d = sum(z, 0.5, w, 0.5);
        let stored = |row, name| row_from_f64(row, shift).ok_or(CameraError::Matrix { row: name });
        Ok(Self { rows: [stored(x, 'x')?, stored(y, 'y')?, stored(&d, 'z')?, stored(w, 'w')?] })
    }

    /// The row-major matrix that the camera uses, scaled by a power of two so that the largest number of its last row is ½ to 1. Exact but
    /// for the row z, which is computed from (z + w)/2 and rounded to 53 bits. [`from_matrix`](Self::from_matrix) reads it back.
    pub fn to_matrix(&self) -> [[f64; 4]; 4] {
        let [x, y, d, w] = &self.rows;
        let shift = exponent(largest(&coefficients(w, 0))).map_or(0, |exponent| -exponent);
        let [x, y, d, w] = [x, y, d, w].map(|row| coefficients(row, shift));
        [x, y, sum(&d, 2.0, &w, -1.0), w]
    }
}
