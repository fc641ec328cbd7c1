//! The cost of a vertex, a face, a row and a pixel, fitted to some cases, and tested by predicting others.

use crate::core::{run, CORES};
use crate::Result;
use bench::growth::{ways, Case, Way, CASES, WAYS};
use pinhole_apps_support::work::{terms, Work};
use serde_json::{json, Value};

/// A case drawn in a way: how many it has of what each constant is for, and the instructions that it took.
struct Drawn {
    case: &'static Case,
    counts: Vec<f64>,
    instructions: u64,
}

/// A row for each way to draw and core: the constants, and the errors in percent of the frames that they predict, those of the fit
/// and others; and for each core the instructions of placing an object and of turning its light, which come on top.
pub(crate) fn rows() -> Result<Vec<Value>> {
    let works = works()?;
    let mut rows = Vec::new();
    for core in CORES {
        core.build().cargo("build", &["--bin=growth".into()])?;
        let printed = run(core.name, &core.build().image("growth"))?;
        // In the same order.
        let counts = printed.lines().map(|line| line.parse::<u64>());
        let mut counts = counts.collect::<std::result::Result<Vec<_>, _>>()?;
        let (light, place) = (counts.pop().unwrap_or_default(), counts.pop().unwrap_or_default());
        if counts.len() != works.len() {
            return Err(format!("growth on {}: {} cases", core.name, counts.len()).into());
        }
        rows.push(json!({"way": "placing", "core": core.name, "constants": [place, light],
            "names": ["Affine::rotation_y and Camera::place", "Lambert::new"]}));
        for (name, kinds, _) in WAYS {
            let of_ways = works.iter().zip(&counts).filter(|((_, way, _), _)| kinds.contains(&way.kind));
            let (names, counts): (Vec<_>, Vec<_>) = terms(name).into_iter().unzip();
            let drawn = of_ways.map(|(&(case, _, work), &instructions)| {
                let counts = counts.iter().map(|count| f64::from(count(&work))).collect();
                Drawn { case, counts, instructions }
            });
            let drawn: Vec<_> = drawn.collect();
            let constants = constants(&drawn).map_err(|error| format!("{name} on {}: {error}", core.name))?;
            if let Some(at) = constants.iter().position(|constant| *constant < 0.0) {
                return Err(format!("{name} on {}: less than nothing for a {}", core.name, names[at]).into());
            }
            let errors = |is_fitted: bool| {
                let chosen = drawn.iter().filter(|one| one.case.fitted == is_fitted && !one.case.points);
                let estimate = |one: &Drawn| dot(&one.counts, &constants);
                let errors = chosen.map(|one| 100.0 * (estimate(one) / one.instructions as f64 - 1.0));
                let errors: Vec<f64> = errors.collect();
                let mean = errors.iter().sum::<f64>() / errors.len() as f64;
                let largest = errors.iter().fold(0.0, |largest: f64, error| largest.max(error.abs()));
                [mean, largest].map(|error| (10.0 * error).round() / 10.0)
            };
            let shown: Vec<f64> = constants.iter().map(|constant| rounded(*constant)).collect();
            rows.push(json!({"way": name, "core": core.name, "names": names, "constants": shown,
                "mean_and_largest_error_in_the_fit": errors(true),
                "mean_and_largest_error_elsewhere": errors(false)}));
        }
    }
    Ok(rows)
}

/// To three digits or a whole number.
fn rounded(constant: f64) -> f64 {
    match constant.abs() < 20.0 {
        true => crate::chips::rounded(constant),
        false => constant.round(),
    }
}

/// The work of every case and way, in the firmware's order.
fn works() -> Result<Vec<(&'static Case, Way, Work)>> {
    let all = CASES.iter().flat_map(|case| ways().map(move |way| (case, way)));
    all.map(|(case, way)| {
        let work = case.work(way).ok_or_else(|| format!("{} cannot be drawn", case.name))?;
        Ok((case, way, work))
    })
    .collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Least squares of the relative errors: the constants for which `case · constants` is nearest to 1 over all cases, each divided by
/// its instructions. The normal equations, by Gauss and Jordan.
fn constants(drawn: &[Drawn]) -> Result<Vec<f64>> {
    let part = |drawn: &Drawn| -> Vec<f64> {
        drawn.counts.iter().map(|count| count / drawn.instructions as f64).collect()
    };
    let cases: Vec<_> = drawn.iter().filter(|drawn| drawn.case.fitted).map(part).collect();
    let count = cases.first().ok_or("no cases")?.len();
    let mut rows = vec![vec![0.0; count + 1]; count];
    for case in &cases {
        for (row, factor) in rows.iter_mut().zip(case) {
            for (sum, value) in row.iter_mut().zip(case.iter().chain(&[1.0])) {
                *sum += factor * value;
            }
        }
    }
    for column in 0..count {
        let by_size = |&a: &usize, &b: &usize| rows[a][column].abs().total_cmp(&rows[b][column].abs());
        let pivot = (column..count).max_by(by_size).unwrap_or(column);
        rows.swap(column, pivot);
        let pivot = rows[column].clone();
        if pivot[column] == 0.0 {
            return Err("the cases do not tell all constants apart".into());
        }
        for (other, row) in rows.iter_mut().enumerate() {
            let factor = row[column] / pivot[column];
            if other != column {
                row.iter_mut().zip(&pivot).for_each(|(value, above)| *value -= factor * above);
            }
        }
    }
    Ok((0..count).map(|at| rows[at][count] / rows[at][at]).collect())
}
