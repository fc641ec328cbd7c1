//! Other libraries on the scenes that they can draw, counted in the same run: the firmwares of `rivals/`.

use crate::core::{Core, CORES};
use crate::cross::BENCH;
use crate::Result;
use bench::cells::{CELLS, USER_CELLS};

/// The instructions of one library.
pub(crate) struct Rival {
    pub(crate) name: &'static str,
    pub(crate) scene: String,
    pub(crate) variant: String,
    pub(crate) core: Core,
    pub(crate) instructions: u64,
}

/// The libraries, by their firmware.
const RIVALS: [(&str, &str); 2] = [("3DG", "gfx"), ("EG", "graphics")];

/// Measures the rivals on the cores of the table.
pub(crate) fn measure(failures: &mut Vec<String>) -> Result<Vec<Rival>> {
    let mut rivals = Vec::new();
    for core in CORES.into_iter().filter(|core| core.name != "RV32") {
        core.build().cargo_in(&format!("{BENCH}/rivals"), "build", &[])?;
        for (name, bin) in RIVALS {
            for line in core.run(&core.build().image(bin))?.lines() {
                let fields: Vec<&str> = line.split(',').collect();
                let [scene, variant, instructions, drawn] = fields[..] else {
                    return Err(format!("{name}: {line}").into());
                };
                eprintln!("{name}: {scene},{variant},{},{instructions}", core.name);
                compare(name, scene, variant, drawn.parse()?, failures);
                let (scene, variant, instructions) =
                    (scene.to_string(), variant.to_string(), instructions.parse()?);
                rivals.push(Rival { name, scene, variant, core, instructions });
            }
        }
    }
    Ok(rivals)
}

/// Whether a rival draws the same scene: as many pixels as we, but for 8 %: it rounds corners to pixels, and fills
/// pixels on edges too that belong to no triangle here, which for S7's small ones makes 6 %. Of near objects 3DG leaves out
/// up to 15 %, as the page says.
fn compare(name: &str, scene: &str, variant: &str, drawn: usize, failures: &mut Vec<String>) {
    let ours = CELLS.iter().chain(USER_CELLS).find(|cell| (cell.0, cell.1) == (scene, variant));
    let ours = ours.and_then(|cell| cell.2()).map_or(0, |counted| counted.drawn);
    let percent = if scene.starts_with('C') { 15 } else { 8 };
    if ours.abs_diff(drawn) * 100 > ours * percent {
        failures.push(format!("{name} draws {drawn} pixels of {scene},{variant}, where there are {ours}"));
    }
}
