//! What a vertex, a face, a row and a pixel take: constants with which a sum over all of them comes nearest to the
//! counted instructions, by least squares of the relative errors.

use crate::Result;
use std::fmt::Write;

/// What the columns of the firmware's lines count, behind the scene and the instructions.
const NAMES: [&str; N] =
    ["draw", "vertex", "culled face", "drawn face", "row", "tested pixel", "written pixel"];
const N: usize = 7;

pub(crate) fn text(lines: &str) -> Result<String> {
    let (mut cases, mut text) = (Vec::new(), String::new());
    for line in lines.lines() {
        let numbers =
            line.split(',').skip(1).map(str::parse).collect::<std::result::Result<Vec<f64>, _>>()?;
        let [instructions, vertices, culled, drawn, rows, tested, _runs, written] = numbers[..] else {
            return Err(format!("not a case: {line}").into());
        };
        let counts: [f64; N] = [1.0, vertices, culled, drawn, rows, tested, written];
        cases.push(counts.map(|count| count / instructions));
    }
    let constants = fit(&cases).ok_or("the cases do not tell all constants apart")?;
    for (name, constant) in NAMES.iter().zip(constants) {
        writeln!(text, "{constant:8.1} instructions a {name}")?;
    }
    let errors = cases.iter().map(|case| (dot(case, &constants) - 1.0).abs());
    let (sum, most) = errors.fold((0.0, 0.0f64), |(sum, most), error| (sum + error, most.max(error)));
    let mean = 100.0 * sum / cases.len() as f64;
    writeln!(text, "{} cases, error {mean:.1} % on average, {:.1} % at most", cases.len(), 100.0 * most)?;
    Ok(text)
}

fn dot(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The constants for which `case · constants` is nearest to 1 over all cases: the normal equations, by Gauss and Jordan.
fn fit(cases: &[[f64; N]]) -> Option<[f64; N]> {
    let mut rows = [[0.0; N + 1]; N];
    for case in cases {
        for (row, factor) in rows.iter_mut().zip(case) {
            for (sum, value) in row.iter_mut().zip(case.iter().chain(&[1.0])) {
                *sum += factor * value;
            }
        }
    }
    for column in 0..N {
        let pivot = (column..N).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))?;
        rows.swap(column, pivot);
        let pivot = rows[column];
        if pivot[column] == 0.0 {
            return None;
        }
        for (other, row) in rows.iter_mut().enumerate() {
            let factor = row[column] / pivot[column];
            if other != column {
                row.iter_mut().zip(pivot).for_each(|(value, above)| *value -= factor * above);
            }
        }
    }
    let mut constants = [0.0; N];
    for (at, constant) in constants.iter_mut().enumerate() {
        *constant = rows[at][N] / rows[at][at];
    }
    Some(constants)
}
