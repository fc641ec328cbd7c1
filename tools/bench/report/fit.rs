//! Least squares.

/// The constants for which `case · constants` is nearest to 1 over all cases: the normal equations, by Gauss and Jordan.
/// `None` where the cases do not tell all constants apart.
pub(crate) fn fit(cases: &[Vec<f64>]) -> Option<Vec<f64>> {
    let count = cases.first()?.len();
    let mut rows = vec![vec![0.0; count + 1]; count];
    for case in cases {
        for (row, factor) in rows.iter_mut().zip(case) {
            for (sum, value) in row.iter_mut().zip(case.iter().chain(&[1.0])) {
                *sum += factor * value;
            }
        }
    }
    for column in 0..count {
        let pivot =
            (column..count).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))?;
        rows.swap(column, pivot);
        let pivot = rows[column].clone();
        if pivot[column] == 0.0 {
            return None;
        }
        for (other, row) in rows.iter_mut().enumerate() {
            let factor = row[column] / pivot[column];
            if other != column {
                row.iter_mut().zip(&pivot).for_each(|(value, above)| *value -= factor * above);
            }
        }
    }
    Some((0..count).map(|at| rows[at][count] / rows[at][at]).collect())
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
