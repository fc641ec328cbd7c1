//! Lines, in bands.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{self, Memory};
use bench::measure::{measure, Named};
use bench::{board, firmware, scene};

const SCENES: &[Named] = &[("S1", &scene::CUBE)];

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = board::Clock::new()?;
    for (how, rows) in [("band240", 240), ("band16", 16), ("band8", 8)] {
        measure("wireframe", how, SCENES, &mut clock, &mut |scene, light, display| {
            bands::wireframe(scene, light, memory.rows(rows)?, display)
        })?;
    }
    Some(())
});
