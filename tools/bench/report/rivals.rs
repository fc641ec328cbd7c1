//! Other libraries on the scenes that they can draw: the firmwares of `rivals/`.

use crate::core::CORES;
use crate::data::{row, Row};
use crate::Result;
use bench::cells::CELLS;
use serde_json::json;

/// The libraries, and the firmware of each.
const RIVALS: [(&str, &str); 2] = [("embedded-3dgfx", "gfx"), ("embedded-graphics", "graphics")];

/// The libraries on the Cortex-M cores.
pub(crate) fn rows(failures: &mut Vec<String>) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for core in CORES.into_iter().filter(|core| core.name != "RV32") {
        core.build().cargo("build", &["--package=rivals".into()])?;
        for (library, bin) in RIVALS {
            for line in core.run(&core.build().image(bin))?.lines() {
                let fields: Vec<&str> = line.split(',').collect();
                let [scene, variant, instructions, drawn] = fields[..] else {
                    return Err(format!("{library}: {line}").into());
                };
                compare(library, scene, variant, drawn.parse()?, failures);
                rows.push(row([
                    ("library", json!(library)),
                    ("scene", json!(scene)),
                    ("variant", json!(variant)),
                    ("core", json!(core.name)),
                    ("instructions", json!(instructions.parse::<u64>()?)),
                ]));
            }
        }
    }
    Ok(rows)
}

/// Whether a rival draws the same scene: as many pixels as we, but for 8 %: it rounds corners to pixels, and fills
/// pixels on edges too that belong to no triangle here, which for S7's small ones makes 6 %. Of near objects embedded-3dgfx leaves out
/// up to 15 %.
fn compare(library: &str, scene: &str, variant: &str, drawn: usize, failures: &mut Vec<String>) {
    let ours = CELLS.iter().find(|cell| (cell.0, cell.1) == (scene, variant));
    let ours = ours.and_then(|cell| cell.2()).map_or(0, |counted| counted.drawn);
    let percent = if scene.starts_with('C') { 15 } else { 8 };
    if ours.abs_diff(drawn) * 100 > ours * percent {
        failures.push(format!("{library} draws {drawn} pixels of {scene},{variant}, where there are {ours}"));
    }
}
