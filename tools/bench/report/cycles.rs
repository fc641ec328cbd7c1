//! Cycles of the cells: each image is run once and recorded, then timed by the tables of each core that runs its code.

use crate::cells::{self, Cell, Choice};
use crate::data::{row, Row};
use crate::record::{record, APART};
use crate::side_by_side::side_by_side;
use crate::timing::pipeline::Pipeline;
use crate::{provenance, Result};
use serde_json::json;

/// The cores with timing tables: the name of each, of the emulated core whose images it runs, and the table.
const TIMED_CORES: [(&str, &str, Pipeline); 5] = [
    ("M0", "M0", Pipeline::M0),
    ("M0+", "M0", Pipeline::M0Plus),
    ("M3", "M3", Pipeline::M3),
    ("M4", "M4F", Pipeline::M4),
    ("M33", "M4F", Pipeline::M33),
];

/// The cells whose cycles are in the data.
const STATED: [&str; 12] =
    ["S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8", "plain", "z", "wire", "bands16-z"];

/// The rows of [`STATED`].
pub(crate) fn rows(failures: &mut Vec<String>) -> Result<Vec<Row>> {
    measure(&STATED, failures)
}

/// The cycles, without wait states, of the cells that these scenes, variants and cores choose; all of a kind if none is named.
pub(crate) fn measure(names: &[&str], failures: &mut Vec<String>) -> Result<Vec<Row>> {
    let is_core = |name: &str| TIMED_CORES.iter().any(|core| core.0 == name);
    let named: Vec<&str> = names.iter().copied().filter(|name| is_core(name)).collect();
    let cores: Vec<_> =
        TIMED_CORES.into_iter().filter(|core| named.is_empty() || named.contains(&core.0)).collect();
    let cells = names.iter().copied().filter(|name| !is_core(name));
    let choice = Choice::new(&cells.chain(cores.iter().map(|core| core.1)).collect::<Vec<_>>())?;
    let mut cells = Vec::new();
    cells::measure(&choice, failures, |cell| cells.push(cell))?;
    let timed = side_by_side(&cells, |cell: &Cell| {
        let image = cell.image();
        let recorded = record(cell.core, &image, &provenance::frames(&image)?, 1)?;
        let frame = recorded.frames.first().ok_or("a frame is missing")?;
        let cores = cores.iter().filter(|core| core.1 == cell.core.name);
        let cycles = |core: &(&'static str, _, Pipeline)| {
            (core.0, recorded.program.cycles(&frame.run, frame.end, core.2, None, None).cycles)
        };
        Ok((frame.run.len() as u64, cores.map(cycles).collect::<Vec<_>>()))
    })?;
    let mut rows = Vec::new();
    for (cell, (instructions, cycles)) in cells.iter().zip(timed) {
        // The clock subtracts its own cost.
        if instructions.abs_diff(cell.instructions) > APART {
            failures.push(format!("{cell}: {instructions} instructions in the log"));
        }
        rows.extend(cycles.into_iter().map(|(core, cycles)| {
            row([
                ("scene", json!(cell.scene)),
                ("variant", json!(cell.variant())),
                ("core", json!(core)),
                ("instructions", json!(cell.instructions)),
                ("cycles", json!(cycles)),
            ])
        }));
    }
    Ok(rows)
}
