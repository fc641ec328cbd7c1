//! Lit faces without depth, in bands.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{self, Memory};
use bench::measure::{measure, Named};
use bench::{board, firmware, scene};

const SCENES: &[Named] = &[("S2", &scene::CUBE), ("S3", &scene::TORUS), ("S4", &scene::ICO)];

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = board::Clock::new()?;
    for (how, rows) in [("band240", 240), ("band16", 16), ("band8", 8)] {
        measure("solid", how, SCENES, &mut clock, &mut |scene, light, display| {
            bands::solid(scene, light, memory.rows(rows)?, display)
        })?;
    }
    Some(())
});
