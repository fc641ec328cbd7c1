//! Lit faces with depth, both for a whole frame.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::frames::{self, Memory};
use bench::measure::{measure, Named};
use bench::{board, firmware, scene};

const SCENES: &[Named] = &[("S2", &scene::CUBE), ("S3", &scene::TORUS), ("S4", &scene::ICO)];

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = board::Clock::new()?;
    measure("depth", "full", SCENES, &mut clock, &mut |scene, light, display| {
        frames::depth(scene, light, memory, display)
    })
});
