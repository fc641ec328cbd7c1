//! Scenes drawn in bands of 240, 16 and 8 rows, one firmware for each way to draw; `band_empty` only clears.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{self, Memory};
use bench::measure::{measure, Named};
use bench::{board, firmware, position, scene};

const EMPTY: &[Named] = &[("empty", &scene::CUBE)];
const EDGES: &[Named] = &[("S1", &scene::CUBE)];
const FACES: &[Named] = &[("S2", &scene::CUBE), ("S3", &scene::TORUS), ("S4", &scene::ICO)];

/// The firmware that is built.
const IMAGE: usize =
    position(env!("CARGO_BIN_NAME"), &["band_empty", "band_wireframe", "band_solid", "band_depth"]);

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = board::Clock::new()?;
    for (how, rows) in [("band240", 240), ("band16", 16), ("band8", 8)] {
        match IMAGE {
            0 => {
                measure("solid", how, EMPTY, &mut clock, &mut |_, _, display| {
                    bands::empty(memory.rows(rows)?, display)
                })?;
                measure("depth", how, EMPTY, &mut clock, &mut |_, _, display| {
                    bands::empty_depth(memory.rows(rows)?, display)
                })?;
            }
            1 => measure("wireframe", how, EDGES, &mut clock, &mut |scene, light, display| {
                bands::wireframe(scene, light, memory.rows(rows)?, display)
            })?,
            2 => measure("solid", how, FACES, &mut clock, &mut |scene, light, display| {
                bands::solid(scene, light, memory.rows(rows)?, display)
            })?,
            _ => measure("depth", how, FACES, &mut clock, &mut |scene, light, display| {
                bands::depth(scene, light, memory.rows(rows)?, display)
            })?,
        }
    }
    Some(())
});
