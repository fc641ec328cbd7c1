//! Measures on emulated cores, and writes or compares the data in `docs/data`. `tools/bench/run` starts it.

mod cells;
mod chips;
mod core;
mod cycles;
mod data;
mod elf;
mod footprint;
mod growth;
mod record;
mod way;

/// Cycles from instructions: timing tables of the Cortex-M cores and of an ESP32-C3, and how long flash takes.
mod timing {
    pub(crate) mod decode;
    pub(crate) mod flash;
    pub(crate) mod pipeline;
    pub(crate) mod program;
    pub(crate) mod riscv;
    #[cfg(test)]
    mod tests;
}

use data::{Set, Strictness};
use serde_json::Value;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error + Send + Sync>>;

const M0: &str = "thumbv6m-none-eabi";
const M3: &str = "thumbv7m-none-eabi";
const RV32: &str = "riscv32imc-unknown-none-elf";

const CELL: &[&str] = &["scene", "variant", "core"];
const CELLS: Set = Set { name: "cells", command: "speed", keys: CELL };
const CYCLES: Set = Set { name: "cycles", command: "cycles", keys: CELL };
const GROWTH: Set = Set { name: "growth", command: "growth", keys: &["way", "core"] };
const CHIPS: Set = Set { name: "chips", command: "chips", keys: &["chip"] };
const FRAMES: Set = Set { name: "frames", command: "chips", keys: &["chip", "scene", "variant", "rows"] };
const FOOTPRINT: Set = Set { name: "footprint", command: "footprint", keys: &["image", "target", "level"] };
const WAY: Set = Set { name: "way", command: "way", keys: CELL };

/// Rows for one file or more.
type Measured = Vec<(Set, Vec<Value>)>;

/// What the words of the command line measure.
type Measure = fn(&mut Vec<String>) -> Result<Measured>;
const MEASURES: [(&str, Measure); 7] = [
    ("speed", |failures| Ok(vec![(CELLS, cells::rows(&[], failures)?)])),
    // The cells in bands alone, with what they are compared with.
    ("bands", |failures| {
        let mut rows = cells::rows(&BANDS.split(' ').collect::<Vec<_>>(), failures)?;
        rows.extend(cells::rows(&TWO_CORES, failures)?);
        by_two_cores()?;
        Ok(vec![(CELLS, rows)])
    }),
    ("cycles", |failures| Ok(vec![(CYCLES, cycles::rows(&cycles::STATED, failures)?)])),
    ("growth", |_| Ok(vec![(GROWTH, growth::rows()?)])),
    ("chips", |failures| Ok([CHIPS, FRAMES].into_iter().zip(chips::rows(failures)?).collect())),
    ("way", |failures| Ok(vec![(WAY, way::rows(failures)?)])),
    ("footprint", |failures| Ok(vec![(FOOTPRINT, footprint::measure(&footprint::BUILDS, failures)?)])),
];

/// Cells in bands, and in one piece.
const BANDS: &str = "S3 S4 M3 full full-z bands8 bands8-z bands16 active8 active8-z";
/// Bands by two cores, and by one.
const TWO_CORES: [&str; 6] = ["S3", "S4", "M0", "M3", "bands16-z", "cores16-z"];
/// Cells that may not become slower, and textures by each accuracy of `docs/accuracy.md`, whose costs must be those of the page.
const GUARDED: [&str; 7] = ["S1", "S2", "S3", "plain", "z", "M0", "M3"];
const TEXTURES: [&str; 8] = ["X1", "X2", "X3", "X4", "plain", "eighth", "sixteenth", "M3"];

const USAGE: &str = "\
tools/bench/run [--check] speed | bands | cycles | growth | chips | way | footprint ...
tools/bench/run guard [--rebase]
tools/bench/run cells [--write] [SCENE...] [VARIANT...] [M0 | M3 | M4F | RV32]
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
            FOOTPRINT.write(footprint::measure(footprint::M3_AT_3, &mut failures)?)?;
        }
        ["cells", "--write", names @ ..] => CELLS.write(cells::rows(names, &mut failures)?)?,
        ["cells", names @ ..] => {
            let rows = cells::rows(names, &mut failures)?;
            CELLS.check_pictures(&rows, &mut failures)?;
        }
        ["cycles", names @ ..] if !names.is_empty() => {
            for row in cycles::rows(names, &mut failures)? {
                println!("{}", serde_json::to_string(&row)?);
            }
        }
        ["images", images @ ..] => cycles::print_images(images)?,
        ["floats", images @ ..] => {
            for image in images {
                footprint::without_floats(image, Path::new(image), &mut failures)?;
            }
        }
        ["--check", names @ ..] => {
            for (set, rows) in measured(names, &mut failures)? {
                set.check(&rows, Strictness::Change, &mut failures)?;
            }
        }
        names => {
            for (set, rows) in measured(names, &mut failures)? {
                set.write(rows)?;
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

/// Runs the firmware that fails if the picture of two cores differs from that of one, with the code for an M0 and for an M3 on two
/// Cortex-M33.
fn by_two_cores() -> Result<()> {
    for core in core::CORES.into_iter().filter(|core| ["M0", "M3"].contains(&core.name)) {
        core.build().cargo("build", &["--package=cores".into()])?;
        core::run("two-M33", &core.build().image("two_cores"))?;
    }
    Ok(())
}

fn measured(names: &[&str], failures: &mut Vec<String>) -> Result<Measured> {
    let known = |name: &&str| MEASURES.iter().find(|(known, _)| known == name).map(|measure| measure.1);
    let measures: Option<Vec<Measure>> = names.iter().map(known).collect();
    let mut all = Vec::new();
    for measure in measures.filter(|measures| !measures.is_empty()).ok_or(USAGE)? {
        all.extend(measure(failures)?);
    }
    Ok(all)
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
