//! Cycles of the cells, and of images that are built elsewhere: each is run once and recorded, then timed by the tables of the cores and
//! chips that run its code.

use crate::cells::{self, Cell};
use crate::chips::{chips, Estimate};
use crate::core::{side_by_side, Core, CORES};
use crate::record::{record, Frame, APART};
use crate::timing::pipeline::Pipeline;
use crate::{Result, RV32};
use serde_json::{json, Value};
use std::path::Path;

/// The cores with timing tables: the name of each, of the emulated core whose images it runs, and the table.
const TIMED_CORES: [(&str, &str, Pipeline); 5] = [
    ("M0", "M0", Pipeline::M0),
    ("M0+", "M0", Pipeline::M0Plus),
    ("M3", "M3", Pipeline::M3),
    ("M4", "M4F", Pipeline::M4),
    ("M33", "M4F", Pipeline::M33),
];

/// The cells whose cycles are in the data.
pub(crate) const STATED: [&str; 12] =
    ["S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8", "plain", "z", "wire", "bands16-z"];

/// The cells that these names choose, each with its frame.
pub(crate) fn recorded(names: &[&str], failures: &mut Vec<String>) -> Result<Vec<(Cell, Frame)>> {
    let cells = cells::measure(names, failures)?;
    let frames = side_by_side(&cells, |cell: &Cell| record(cell.core, &cell.image))?;
    let recorded: Vec<_> = cells.into_iter().zip(frames).collect();
    for (cell, frame) in &recorded {
        let instructions = frame.run.len() as u64;
        // The clock subtracts its own cost.
        if instructions.abs_diff(cell.instructions) > APART {
            failures.push(format!("{cell}: {instructions} instructions in the log"));
        }
    }
    Ok(recorded)
}

/// The cycles, without wait states, of the cells that these scenes, variants and cores choose; all of a kind if none is named.
pub(crate) fn rows(names: &[&str], failures: &mut Vec<String>) -> Result<Vec<Value>> {
    let is_core = |name: &str| TIMED_CORES.iter().any(|core| core.0 == name);
    let named: Vec<&str> = names.iter().copied().filter(|name| is_core(name)).collect();
    let cores: Vec<_> =
        TIMED_CORES.into_iter().filter(|core| named.is_empty() || named.contains(&core.0)).collect();
    let cells = names.iter().copied().filter(|name| !is_core(name));
    let chosen: Vec<_> = cells.chain(cores.iter().map(|core| core.1)).collect();
    let mut rows = Vec::new();
    for (cell, frame) in recorded(&chosen, failures)? {
        rows.extend(cores.iter().filter(|core| core.1 == cell.core.name).map(|(core, _, pipeline)| {
            json!({"scene": cell.scene, "variant": cell.variant, "core": core,
                "instructions": cell.instructions, "cycles": frame.cycles(*pipeline, None).cycles})
        }));
    }
    Ok(rows)
}

/// Prints a line `image;chip;instructions;cycles` for the first frame of each image, on each chip; of an ESP32-C3, whose rules are not all
/// known, the least, the likely and the most cycles.
pub(crate) fn print_images(images: &[&str]) -> Result<()> {
    let lines = side_by_side(images, |image| of_image(Path::new(image)))?;
    lines.iter().flatten().for_each(|line| println!("{line}"));
    Ok(())
}

fn of_image(image: &Path) -> Result<Vec<String>> {
    let name = image.display();
    let is_for = |core: &Core| image.components().any(|part| part.as_os_str() == core.target);
    let core = CORES.into_iter().find(is_for).ok_or_else(|| format!("{name}: no folder of a target"))?;
    let frame = record(core, image)?;
    let instructions = frame.run.len();
    if core.target == RV32 {
        let mut estimate = Estimate::default();
        estimate.add(&frame);
        let cycles = estimate.in_flash().map(|cycles| cycles.to_string()).join(";");
        return Ok(vec![format!("{name};ESP32-C3, code in flash;{instructions};{cycles}")]);
    }
    let chips = chips()?;
    let lines = chips.iter().filter(|(chip, _)| chip.image == core.name).map(|(chip, _)| {
        let cycles = frame.cycles(chip.pipeline, chip.flash).cycles;
        format!("{name};{};{instructions};{cycles}", chip.chip)
    });
    Ok(lines.collect())
}
