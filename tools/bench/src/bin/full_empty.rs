//! What a frame costs before anything is drawn.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::frames::{self, Memory};
use bench::measure::{measure, Named};
use bench::{board, firmware, scene};

const SCENES: &[Named] = &[("empty", &scene::CUBE)];

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = board::Clock::new()?;
    measure("solid", "full", SCENES, &mut clock, &mut |_, _, display| {
        frames::empty(memory, display)
    })?;
    measure("depth", "full", SCENES, &mut clock, &mut |_, _, display| {
        frames::empty_depth(memory, display)
    })
});
