//! Measures on emulated cores, and writes or compares the data in `docs/data`. `tools/bench/run` starts it.

mod cells;
mod chips;
mod core;
mod cross;
mod cycles;
mod data;
mod elf;
mod esp32c3;
mod footprint;
mod growth;
mod images;
mod provenance;
mod record;
mod rivals;
mod side_by_side;
mod timing;
mod two_cores;

use data::{Set, Strictness};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const M0: &str = "thumbv6m-none-eabi";
const M3: &str = "thumbv7m-none-eabi";
const RV32: &str = "riscv32imc-unknown-none-elf";

const CELL: &[&str] = &["scene", "variant", "core"];
const CELLS: Set = Set { name: "cells", keys: CELL, measure: |failures| cells::rows(&[], failures) };
const FOOTPRINT: Set =
    Set { name: "footprint", keys: &["image", "target", "level"], measure: footprint::rows };
const SETS: [Set; 9] = [
    CELLS,
    // The cells in bands alone, with what they are compared with.
    Set { measure: |failures| cells::rows(&BANDS, failures), ..CELLS },
    Set { name: "cycles", keys: CELL, measure: cycles::rows },
    Set { name: "growth", keys: &["way", "core"], measure: growth::rows },
    Set { name: "chips", keys: &["chip"], measure: chips::cycles },
    Set { name: "frames", keys: &["chip", "scene", "variant", "rows"], measure: chips::frames },
    Set { name: "cores", keys: CELL, measure: two_cores::rows },
    Set { name: "rivals", keys: &["library", "scene", "variant", "core"], measure: rivals::rows },
    FOOTPRINT,
];
/// The names of [`SETS`] on the command line.
const NAMES: [&str; 9] =
    ["speed", "bands", "cycles", "growth", "chips", "frames", "cores", "rivals", "footprint"];

/// Cells in bands, and in one piece.
const BANDS: [&str; 7] = ["M3", "full", "full-z", "bands8", "bands8-z", "bands16", "bands16-z"];
/// Cells that may not become slower, and textures by each method of `docs/accuracy.md`, whose costs must be those of the page.
const GUARDED: [&str; 7] = ["S1", "S2", "S3", "plain", "z", "M0", "M3"];
const TEXTURES: [&str; 10] =
    ["X1", "X2", "X3", "X4", "plain", "eighth", "sixteenth", "each", "every16", "M3"];

const USAGE: &str = "\
tools/bench/run [--check] speed | bands | cycles | growth | chips | frames | cores | rivals | footprint ...
tools/bench/run guard [--rebase]
tools/bench/run cells [SCENE...] [VARIANT...] [M0 | M3 | M4F | RV32]
tools/bench/run cycles SCENE... [VARIANT...] [M0 | M0+ | M3 | M4 | M33]
tools/bench/run images IMAGE...
tools/bench/run floats IMAGE...";

/// Runs what the command line asks for; returns the checks that failed.
fn run(arguments: &[&str]) -> Result<Vec<String>> {
    let mut failures = Vec::new();
    match arguments {
        ["guard"] => guard(&mut failures)?,
        ["guard", "--rebase"] => {
            let mut rows = cells::rows(&GUARDED, &mut failures)?;
            rows.extend(cells::rows(&TEXTURES, &mut failures)?);
            CELLS.write(rows)?;
        }
        ["cells", names @ ..] => {
            let rows = cells::rows(names, &mut failures)?;
            CELLS.check_pictures(&rows, &mut failures)?;
        }
        ["cycles", names @ ..] if !names.is_empty() => {
            for row in cycles::measure(names, &mut failures)? {
                println!("{}", serde_json::to_string(&row)?);
            }
        }
        ["images", images @ ..] => images::print(images)?,
        ["floats", images @ ..] => {
            for image in images {
                footprint::without_floats(image, Path::new(image), &mut failures)?;
            }
        }
        ["--check", names @ ..] => {
            for set in named(names)? {
                set.check(&(set.measure)(&mut failures)?, Strictness::Change, &mut failures)?;
            }
        }
        names => {
            for set in named(names)? {
                set.write((set.measure)(&mut failures)?)?;
            }
        }
    }
    Ok(failures)
}

/// S1 to S3 on M0 and M3 and textures, and the images for an M3 at opt-level 3, compared with the data.
fn guard(failures: &mut Vec<String>) -> Result<()> {
    let rows = cells::rows(&GUARDED, failures)?;
    CELLS.check(&rows, Strictness::Growth, failures)?;
    let rows = cells::rows(&TEXTURES, failures)?;
    CELLS.check(&rows, Strictness::Change, failures)?;
    let rows = footprint::measure(footprint::M3_AT_3, failures)?;
    FOOTPRINT.check(&rows, Strictness::Growth, failures)
}

fn named(names: &[&str]) -> Result<Vec<Set>> {
    if names.is_empty() {
        return Err(USAGE.into());
    }
    let set = |name: &&str| NAMES.iter().position(|known| known == name).map(|at| SETS[at]);
    names.iter().map(|name| set(name).ok_or(USAGE.into())).collect()
}

fn main() -> ExitCode {
    let (arguments, start): (Vec<String>, _) = (std::env::args().skip(1).collect(), Instant::now());
    let done = run(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
    eprintln!("It took {} s.", start.elapsed().as_secs());
    match done {
        Ok(failures) if failures.is_empty() => ExitCode::SUCCESS,
        Ok(failures) => {
            failures.iter().for_each(|failure| eprintln!("bench: {failure}"));
            ExitCode::from(1)
        }
        Err(error) => {
            eprintln!("bench: {error}");
            ExitCode::from(2)
        }
    }
}
