//! Checks whether a change has made S1, S2 or S3 slower on M0 or M3: `baseline.txt` has their counts at the time when it was
//! written. The targets stay, however often the baseline is written again. The baseline also has the instructions of textures by each
//! method of `docs/accuracy.md`, which `tools/measure` reads from it: for these, a count fails if it is too high or too low. Sizes of
//! images for an M3 are compared with their limits.

use crate::cells::{self, Cell, Choice};
use crate::page::BUILT;
use crate::{cross, footprint, targets, Result};
use std::fmt::Write;

const BASELINE: &str = "tools/bench/baseline.txt";
const GUARDED: &[&str] = &["S1", "S2", "S3", "plain", "z", "M0", "M3"];
const METHODS: &[&str] = &["X1", "X2", "X3", "X4", "plain", "eighth", "sixteenth", "each", "every16", "M3"];
/// The percentage by which a cell may grow, and by which one of [`METHODS`] may shrink.
const MORE: f64 = 2.0;

/// Prints the guarded cells and their changes. A cell that grew too much fails, if the compiler is the same; a cell beyond 1.12
/// times its target fails in any case.
pub(crate) fn check(failures: &mut Vec<String>) -> Result<()> {
    let path = cross::root().join(BASELINE);
    let baseline = std::fs::read_to_string(path).map_err(|error| format!("{BASELINE}: {error}"))?;
    let compiler = cross::compiler()?;
    let same = baseline.contains(&built(&compiler));
    for (cell, is_method) in measure(failures)? {
        let key = key(&cell);
        let line = baseline.lines().find_map(|line| line.strip_prefix(&key));
        let Some(before) = line.and_then(|count| count.parse::<u64>().ok()) else {
            failures.push(format!("{key}: not in {BASELINE}"));
            continue;
        };
        let change = (cell.instructions as f64 / before as f64 - 1.0) * 100.0;
        eprintln!("{key}{before} -> {}: {change:+.1} %", cell.instructions);
        if same && (change > MORE || is_method && change < -MORE) {
            failures.push(format!("{key}{} instructions, {change:+.1} % of {before}", cell.instructions));
        }
    }
    if !same {
        eprintln!("{BASELINE} is another compiler's than {compiler}: no change of this fails.");
    }
    footprint::measure(footprint::M3_AT_3, false, failures)?;
    Ok(())
}

/// Writes today's counts as the baseline, but also fails if one is beyond 1.12 times its target.
pub(crate) fn rebase(failures: &mut Vec<String>) -> Result<()> {
    let mut text = format!(
        "# Instructions a frame; the check fails at {MORE} % more, and for X1 to X4 also at {MORE} % less. `tools/bench/run guard --rebase` writes this.\n{}\n",
        built(&cross::compiler()?)
    );
    for (cell, _) in measure(failures)? {
        writeln!(text, "{}{}", key(&cell), cell.instructions)?;
    }
    Ok(std::fs::write(cross::root().join(BASELINE), text)?)
}

/// The cells, and whether each is one of [`METHODS`].
fn measure(failures: &mut Vec<String>) -> Result<Vec<(Cell, bool)>> {
    let mut all = Vec::new();
    for (names, is_method) in [(GUARDED, false), (METHODS, true)] {
        let mut cells = Vec::new();
        let names = names.iter().copied().map(String::from).collect();
        cells::measure(&Choice::new(names)?, failures, |cell| {
            println!("{cell}");
            cells.push(cell);
        })?;
        targets::limit(&cells, &targets::targets()?, failures);
        all.extend(cells.into_iter().map(|cell| (cell, is_method)));
    }
    Ok(all)
}

fn built(compiler: &str) -> String {
    format!("# {BUILT}{compiler}.")
}

fn key(Cell { scene, variant, core, .. }: &Cell) -> String {
    format!("{scene} {variant} {} ", core.name)
}
