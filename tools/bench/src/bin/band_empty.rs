//! What a frame in bands costs before anything is drawn.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{self, Memory};
use bench::measure::{measure, Named};
use bench::{board, firmware, scene};

const SCENES: &[Named] = &[("empty", &scene::CUBE)];

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = board::Clock::new()?;
    for (how, rows) in [("band240", 240), ("band16", 16), ("band8", 8)] {
        measure("solid", how, SCENES, &mut clock, &mut |_, _, display| {
            bands::empty(memory.rows(rows)?, display)
        })?;
        measure("depth", how, SCENES, &mut clock, &mut |_, _, display| {
            bands::empty_depth(memory.rows(rows)?, display)
        })?;
    }
    Some(())
});
