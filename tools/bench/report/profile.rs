//! The instructions of a cell by stages. An instruction belongs to the stage for which its code was written. Code that is inlined
//! there from elsewhere, and called functions that belong to no stage, such as a division, count for the stage that runs.

use crate::cells::{self, Cell, Choice};
use crate::core::Core;
use crate::provenance::{self, Frame};
use crate::side_by_side::side_by_side;
use crate::stages::{Stage, STAGES};
use crate::{cross, elf, trace, Result};
use bench::cells::CELLS;
use std::path::Path;

/// A cell, and its instructions by [`STAGES`].
pub(crate) struct Profile {
    pub(crate) cell: Cell,
    stages: [u64; STAGES.len()],
}

/// How far apart the clock's count and the log's may be. The clock takes off what it costs to call nothing, which is a little
/// more than what calls the frame.
pub(crate) const APART: u64 = 4;

impl Profile {
    pub(crate) fn of(&self, stage: Stage) -> u64 {
        STAGES.iter().zip(self.stages).filter(|of| *of.0 == stage).map(|of| of.1).sum()
    }

    /// The difference from the clock's count.
    pub(crate) fn apart(&self) -> u64 {
        self.sum().abs_diff(self.cell.instructions)
    }

    fn sum(&self) -> u64 {
        self.stages.iter().sum()
    }
}

/// Measures all cells on the cores that have targets.
pub(crate) fn measure(failures: &mut Vec<String>) -> Result<Vec<Profile>> {
    let mut names: Vec<String> = ["plain", "z", "M0", "M3", "M4F"].map(String::from).to_vec();
    names.extend(CELLS.iter().map(|cell| cell.0.to_string()));
    let mut cells = Vec::new();
    cells::measure(&Choice::new(names)?, failures, |cell| cells.push(cell))?;
    let stages = side_by_side(&cells, |cell| {
        stages(cell.core, &cell.core.build().image(&cells::bin(cell.scene, cell.variant)))
    })?;
    let mut profiles = Vec::new();
    for (cell, stages) in cells.into_iter().zip(stages) {
        let profile = Profile { stages, cell };
        let (cell, sum) = (&profile.cell, profile.sum());
        eprintln!(
            "profiled: {} {} {}: {sum} of {}",
            cell.scene, cell.variant, cell.core.name, cell.instructions
        );
        if profile.apart() > APART {
            failures.push(format!("{cell}: {sum} instructions in the log"));
        }
        // A loop with a name that no rule has counts for another stage.
        if profile.of(Stage::Pixels) + profile.of(Stage::LinePixels) == 0 {
            failures.push(format!("{cell}: no instruction is for a pixel"));
        }
        profiles.push(profile);
    }
    Ok(profiles)
}

/// The purpose of an instruction.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Of(Stage),
    /// The purpose of the code that runs: a stage, or the clock.
    Any,
    /// Counting itself, which is not counted.
    Clock,
}

impl Place {
    fn of(frames: &[Frame]) -> Self {
        if frames.iter().any(|frame| frame.file.starts_with("bench/board/")) {
            return Self::Clock;
        }
        Stage::of(frames).map_or(Self::Any, Self::Of)
    }
}

/// An address without a file in the debug information counts for the address before it in the same function.
fn by_place(places: &[Vec<Frame>]) -> Vec<Place> {
    let mut before = (String::new(), Place::Any);
    let known = places.iter().map(|place| {
        let function = place.last().map(|frame| frame.function.clone()).unwrap_or_default();
        let known = match Place::of(&ours(place.clone())) {
            Place::Any if function == before.0 => before.1,
            known => known,
        };
        before = (function, known);
        known
    });
    known.collect()
}

fn stages(core: Core, image: &Path) -> Result<[u64; STAGES.len()]> {
    let places = provenance::frames(image)?;
    let code = elf::sizes(image)?.code;
    let (mut stages, mut running) = ([0; STAGES.len()], None);
    let of_stages = by_place(&places);
    trace::frame(core, image, &places, |block| {
        for at in block {
            running = match of_stages.get((at.wrapping_sub(code.start) / provenance::STEP) as usize) {
                Some(Place::Of(stage)) => Some(*stage),
                Some(Place::Clock) => None,
                Some(Place::Any) | None => running,
            };
            if let Some(stage) = STAGES.iter().position(|stage| Some(*stage) == running) {
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
