//! Scenes drawn into memory for a whole frame, one firmware for each way to draw; `full_empty` only clears.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::frames::{self, Memory};
use bench::measure::{measure, Named};
use bench::{board, firmware, position, scene};

const EMPTY: &[Named] = &[("empty", &scene::CUBE)];
const EDGES: &[Named] = &[("S1", &scene::CUBE)];
const FACES: &[Named] = &[("S2", &scene::CUBE), ("S3", &scene::TORUS), ("S4", &scene::ICO)];

/// The firmware that is built.
const IMAGE: usize =
    position(env!("CARGO_BIN_NAME"), &["full_empty", "full_wireframe", "full_solid", "full_depth"]);

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = board::Clock::new()?;
    match IMAGE {
        0 => {
            measure("solid", "full", EMPTY, &mut clock, &mut |_, _, display| frames::empty(memory, display))?;
            measure("depth", "full", EMPTY, &mut clock, &mut |_, _, display| {
                frames::empty_depth(memory, display)
            })
        }
        1 => measure("wireframe", "full", EDGES, &mut clock, &mut |scene, light, display| {
            frames::wireframe(scene, light, memory, display)
        }),
        2 => measure("solid", "full", FACES, &mut clock, &mut |scene, light, display| {
            frames::solid(scene, light, memory, display)
        }),
        _ => measure("depth", "full", FACES, &mut clock, &mut |scene, light, display| {
            frames::depth(scene, light, memory, display)
        }),
    }
});
