//! What the methods cost, from the counts that `tools/bench/run guard` compares with measured ones.

use super::methods::METHODS;

const CELLS: &str = include_str!("../../../../../docs/data/cells.json");
/// The variant of each of the [`METHODS`] there.
const VARIANTS: [&str; METHODS.len()] = ["plain", "eighth", "sixteenth", "each", "every16"];

/// Instructions of a frame of a scene on an M3, in the order of [`METHODS`].
pub(crate) fn of_scene(cell: &str) -> Result<[f64; METHODS.len()], String> {
    let mut costs = [0.0; METHODS.len()];
    for (cost, variant) in costs.iter_mut().zip(VARIANTS) {
        let key = format!("{{\"scene\":\"{cell}\",\"variant\":\"{variant}\",\"core\":\"M3\",");
        let row = CELLS.lines().find(|line| line.starts_with(&key));
        let count =
            row.and_then(|row| row.split_once("\"instructions\":")?.1.split([',', '}']).next()?.parse().ok());
        *cost = count.ok_or_else(|| {
            format!("docs/data/cells.json: has no row {key}: run tools/bench/run guard --rebase")
        })?;
    }
    Ok(costs)
}
