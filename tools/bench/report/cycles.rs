//! Cycles of the cells and of whole frames: each image is run once and recorded, then timed by the tables of each core that runs
//! its code.

use crate::cells::{self, Cell, Choice};
use crate::core::{Core, CORES};
use crate::side_by_side::side_by_side;
use crate::timing::pipeline::Pipeline;
use crate::timing::program::{Executed, Program};
use crate::{provenance, trace, Result};
use bench::cells::CELLS;
use std::fmt;

/// A core with a timing table, and the core whose images it runs.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct TimedCore {
    pub(crate) name: &'static str,
    /// The name of the emulated core.
    pub(crate) image: &'static str,
    pub(crate) pipeline: Pipeline,
}

pub(crate) const TIMED_CORES: [TimedCore; 5] = [
    TimedCore { name: "M0", image: "M0", pipeline: Pipeline::M0 },
    TimedCore { name: "M0+", image: "M0", pipeline: Pipeline::M0Plus },
    TimedCore { name: "M3", image: "M3", pipeline: Pipeline::M3 },
    TimedCore { name: "M4", image: "M4F", pipeline: Pipeline::M4 },
    TimedCore { name: "M33", image: "M4F", pipeline: Pipeline::M33 },
];

/// A cell on a core, without wait states.
pub(crate) struct CellCycles {
    pub(crate) scene: &'static str,
    /// The variant, with its opt-level.
    pub(crate) variant: String,
    pub(crate) core: TimedCore,
    pub(crate) instructions: u64,
    pub(crate) cycles: u64,
}

impl CellCycles {
    pub(crate) fn per_instruction(&self) -> f64 {
        self.cycles as f64 / self.instructions as f64
    }
}

impl fmt::Display for CellCycles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scene, variant, core, instructions, cycles } = self;
        write!(f, "{scene},{variant},{},{instructions},{cycles},{:.3}", core.name, self.per_instruction())
    }
}

/// The scenes, variants and cores of [`TIMED_CORES`] that the command line names; all of them if it names none.
pub(crate) struct Asked {
    choice: Choice,
    cores: Vec<TimedCore>,
}

impl Asked {
    pub(crate) fn new(names: &[String]) -> Result<Self> {
        let named = |core: &TimedCore| names.iter().any(|name| name == core.name);
        let mut cores: Vec<TimedCore> = TIMED_CORES.into_iter().filter(named).collect();
        if cores.is_empty() {
            cores = TIMED_CORES.to_vec();
        }
        let is_core = |name: &&String| TIMED_CORES.iter().any(|core| core.name == *name);
        let cells = names.iter().filter(|name| !is_core(name)).cloned();
        let images = cores.iter().map(|core| core.image.to_string());
        Ok(Self { choice: Choice::new(cells.chain(images).collect())?, cores })
    }
}

/// Measures cells, then times them, and prints a line for each and every core.
pub(crate) fn print(asked: &Asked, failures: &mut Vec<String>) -> Result<()> {
    let mut cells = Vec::new();
    cells::measure(&asked.choice, failures, |cell| cells.push(cell))?;
    for timed in time(&cells.iter().collect::<Vec<_>>(), &asked.cores, failures)? {
        println!("{timed}");
    }
    Ok(())
}

/// Whether a cell is on the page: cells that have targets, and some of what users draw.
pub(crate) fn is_on_page(cell: &Cell) -> bool {
    let some = ["C1", "T1", "F50"].contains(&cell.scene) && ["plain", "z"].contains(&cell.variant);
    let target = CELLS.iter().any(|known| (known.0, known.1) == (cell.scene, cell.variant));
    cell.level == cells::FAST && cell.core.name != "RV32" && (target || some)
}

/// The cycles of cells that have been built, on those of `cores` that run their images.
pub(crate) fn time(
    cells: &[&Cell],
    cores: &[TimedCore],
    failures: &mut Vec<String>,
) -> Result<Vec<CellCycles>> {
    let timed = side_by_side(cells, |cell| {
        let image = cells::kept(cell);
        let cores = cores.iter().filter(|core| core.image == cell.core.name).copied();
        of_image(cell.core, &image, cores.collect())
    })?;
    let mut all = Vec::new();
    for (cell, (instructions, cycles)) in cells.iter().zip(timed) {
        // The clock subtracts its own cost.
        if instructions.abs_diff(cell.instructions) > crate::profile::APART && !cycles.is_empty() {
            failures.push(format!("{cell}: {instructions} instructions in the log"));
        }
        all.extend(cycles.into_iter().map(|(core, cycles)| CellCycles {
            scene: cell.scene,
            variant: cells::named(cell.variant, cell.level),
            core,
            instructions: cell.instructions,
            cycles,
        }));
    }
    Ok(all)
}

/// The instructions of an image's frame, and its cycles on some cores.
fn of_image(
    core: Core,
    image: &std::path::Path,
    cores: Vec<TimedCore>,
) -> Result<(u64, Vec<(TimedCore, u64)>)> {
    if cores.is_empty() {
        return Ok((0, Vec::new()));
    }
    let (program, places) = (Program::of(image)?, provenance::frames(image)?);
    let mut run = Vec::new();
    trace::frame(core, image, &places, |block| {
        run.extend(block.iter().map(|at| Executed::at(*at as u32))); // code ends far below 2³²
    })?;
    let (run, end) = trace::counted(&run, trace::clock_code(image, &places)?)?;
    let timed =
        cores.into_iter().map(|core| (core, program.cycles(run, end, core.pipeline, None, None).cycles));
    Ok((run.len() as u64, timed.collect()))
}

/// The emulated core of this name.
pub(crate) fn emulated(name: &str) -> Result<Core> {
    Ok(CORES.into_iter().find(|core| core.name == name).ok_or_else(|| format!("no core {name}"))?)
}
