//! What the methods cost, from the counts that `tools/bench/run guard` compares with measured ones.

use super::methods::METHODS;

const BASELINE: &str = include_str!("../../../../bench/baseline.txt");
/// The variant of each of the [`METHODS`] there.
const VARIANTS: [&str; METHODS.len()] = ["plain", "eighth", "sixteenth", "each", "every16"];

/// Instructions of a frame of a scene on an M3, in the order of [`METHODS`].
pub(crate) fn of_scene(cell: &str) -> Result<[f64; METHODS.len()], String> {
    let mut costs = [0.0; METHODS.len()];
    for (cost, variant) in costs.iter_mut().zip(VARIANTS) {
        let key = format!("{cell} {variant} M3 ");
        let count = BASELINE.lines().find_map(|line| line.strip_prefix(&key)?.parse().ok());
        *cost = count.ok_or_else(|| {
            format!("tools/bench/baseline.txt: has no line `{key}`: run tools/bench/run guard --rebase")
        })?;
    }
    Ok(costs)
}
