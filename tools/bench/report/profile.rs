//! Where a cell's instructions go: each is of the stage that it was written for. What is inlined there from elsewhere, and
//! what is called and belongs to no stage, as a division, is of the stage that runs.

use crate::cells::{self, Cell, Choice};
use crate::core::Core;
use crate::provenance::{self, Frame};
use crate::stages::{Stage, STAGES};
use crate::{cross, elf, trace, Result};
use std::path::Path;

/// A cell, and its instructions by [`STAGES`].
pub(crate) struct Profile {
    pub(crate) cell: Cell,
    stages: [u64; STAGES.len()],
}

/// How far apart the clock's count and the log's may be: what calls and ends the frame is in both or in neither, but for the
/// instruction that reads the clock.
const APART: u64 = 4;

impl Profile {
    pub(crate) fn of(&self, stage: Stage) -> u64 {
        STAGES.iter().zip(self.stages).filter(|of| *of.0 == stage).map(|of| of.1).sum()
    }

    fn sum(&self) -> u64 {
        self.stages.iter().sum()
    }
}

/// Of all cells on the cores that have targets.
pub(crate) fn measure(failures: &mut Vec<String>) -> Result<Vec<Profile>> {
    let cores = ["M0", "M3", "M4F"].map(String::from).to_vec();
    let mut cells = Vec::new();
    cells::measure(&Choice::new(cores)?, failures, |cell| cells.push(cell))?;
    let mut profiles = Vec::new();
    for cell in cells {
        let image = cell.core.build().image(&cells::bin(cell.scene, cell.variant));
        let profile = Profile { stages: stages(cell.core, &image)?, cell };
        let (cell, sum) = (&profile.cell, profile.sum());
        eprintln!(
            "profiled: {} {} {}: {sum} of {}",
            cell.scene, cell.variant, cell.core.name, cell.instructions
        );
        if sum.abs_diff(cell.instructions) > APART {
            failures.push(format!("{cell}: {sum} instructions in the log"));
        }
        profiles.push(profile);
    }
    Ok(profiles)
}

fn stages(core: Core, image: &Path) -> Result<[u64; STAGES.len()]> {
    let places = provenance::frames(image)?;
    let (clock, code) = (trace::clock(image, &places)?, elf::sizes(image)?.code);
    let places: Vec<Option<Stage>> = places.into_iter().map(|place| Stage::of(&ours(place))).collect();
    let (mut stages, mut running) = ([0; STAGES.len()], Stage::Other);
    trace::frame(core, image, clock, |block| {
        for at in block {
            let place = at.wrapping_sub(code.start) / provenance::STEP;
            running = places.get(place as usize).copied().flatten().unwrap_or(running);
            if let Some(stage) = STAGES.iter().position(|stage| *stage == running) {
                stages[stage] += 1;
            }
        }
    })?;
    Ok(stages)
}

/// Functions of the library, and of the cells under `bench/`.
fn ours(place: Vec<Frame>) -> Vec<Frame> {
    let (library, bench) = (cross::root().join("src"), Path::new(cross::BENCH).join("src"));
    let known = |frame: Frame| match frame.file.starts_with(cross::BENCH) {
        true => frame.within(&bench).map(|frame| Frame { file: format!("bench/{}", frame.file), ..frame }),
        false => frame.within(&library),
    };
    place.into_iter().filter_map(known).collect()
}
