//! Frames to be timed, a firmware for each height of bands, and one for whole pictures.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::timed::{self, Memory, IMAGES};
use bench::{board, firmware, position};

/// The firmware that is built.
const IMAGE: usize = position(env!("CARGO_BIN_NAME"), &[IMAGES[0].0, IMAGES[1].0, IMAGES[2].0]);

firmware!(memory: Memory = Memory::NEW, {
    timed::print(IMAGES[IMAGE].1, memory, &mut board::Clock::new()?)
});
