//! What a frame costs before anything is drawn, with depth.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::frames::{self, Memory};
use bench::measure::{measure, Named};
use bench::{board, firmware, scene};

const SCENES: &[Named] = &[("empty", &scene::CUBE)];

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = board::Clock::new()?;
    measure("depth", "full", SCENES, &mut clock, &mut |scene, light, display| {
        frames::empty_depth(scene, light, memory, display);
        Some(())
    })
});
