//! Lines, into memory for a whole frame.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::frames::{self, Memory};
use bench::measure::{measure, Named};
use bench::{board, firmware, scene};

const SCENES: &[Named] = &[("S1", &scene::CUBE)];

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = board::Clock::new()?;
    measure("wireframe", "full", SCENES, &mut clock, &mut |scene, light, display| {
        frames::wireframe(scene, light, memory, display)
    })
});
