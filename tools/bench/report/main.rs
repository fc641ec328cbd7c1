//! Measures instructions of frames and of their stages, instructions and RAM of drawing in bands, instructions of two cores, and
//! each feature's flash and stack; writes `docs/speed.md`, `docs/profile.md`, `docs/growth.md`, `docs/bands.md`, `docs/cores.md` and
//! `docs/footprint.md`. `tools/bench/run` starts it.

mod bands;
mod bands_page;
mod cells;
mod chips;
mod core;
mod cross;
mod cycles;
mod cycles_page;
mod elf;
mod esp32c3;
mod fit;
mod footprint;
mod footprint_page;
mod grouped;
mod growth;
mod growth_page;
mod guard;
mod images;
mod log;
mod page;
mod pages;
mod profile;
mod profile_page;
mod prototype;
mod provenance;
mod registers;
mod rivals;
mod scenes;
mod side_by_side;
mod speed_page;
mod stages;
mod targets;
mod timing;
mod trace;
mod two_cores;
mod user_page;
mod validate;

use cells::Choice;
use pages::{Page, PAGES};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const M0: &str = "thumbv6m-none-eabi";
const M3: &str = "thumbv7m-none-eabi";
const RV32: &str = "riscv32imc-unknown-none-elf";

const USAGE: &str = "\
tools/bench/run [--check | --rebase] [speed | profile | growth | bands | cores | footprint ...]
tools/bench/run guard [--rebase]
tools/bench/run cells [SCENE...] [VARIANT...] [M0 | M3 | M4F | RV32]
tools/bench/run cycles [SCENE...] [VARIANT...] [M0 | M0+ | M3 | M4 | M33]
tools/bench/run chips
tools/bench/run validate
tools/bench/run floats IMAGE...
tools/bench/run images IMAGE...";

/// The task that the command line names.
enum Task {
    /// Write pages.
    Write { pages: Vec<Page>, rebase: bool },
    /// Compare them.
    Check { pages: Vec<Page> },
    /// Compare a few cells with the baseline, or make that anew.
    Guard { rebase: bool },
    /// Print cells.
    Cells(Choice),
    /// Print cycles of cells.
    Cycles(cycles::Asked),
    /// Print the tables of frames per second and of cycles per instruction.
    Chips,
    /// Compare the timing tables with published cycles.
    Validate,
    /// Look for routines for floating point in any images.
    Floats(Vec<String>),
    /// Print the cycles of any images that use the clock.
    Images(Vec<String>),
}

impl Task {
    fn new(arguments: &[String]) -> Result<Self> {
        let (first, rest) = arguments.split_first().map_or(("", arguments), |(first, rest)| (first, rest));
        Ok(match first {
            "cells" => Self::Cells(Choice::new(rest.to_vec())?),
            "cycles" => Self::Cycles(cycles::Asked::new(rest)?),
            "floats" => Self::Floats(rest.to_vec()),
            "images" => Self::Images(rest.to_vec()),
            "chips" if rest.is_empty() => Self::Chips,
            "validate" if rest.is_empty() => Self::Validate,
            "guard" if rest.is_empty() => Self::Guard { rebase: false },
            "guard" if rest == ["--rebase"] => Self::Guard { rebase: true },
            "--check" => Self::Check { pages: named(rest)? },
            "--rebase" => Self::Write { pages: named(rest)?, rebase: true },
            _ => Self::Write { pages: named(arguments)?, rebase: false },
        })
    }

    /// Runs the task; returns the checks that failed.
    fn run(self) -> Result<Vec<String>> {
        let mut failures = Vec::new();
        match self {
            Self::Write { pages, rebase } => write(&pages, rebase, &mut failures)?,
            Self::Check { pages } => check(&pages, &mut failures)?,
            Self::Guard { rebase: false } => guard::check(&mut failures)?,
            Self::Guard { rebase: true } => guard::rebase(&mut failures)?,
            Self::Floats(images) => {
                for image in &images {
                    footprint::without_floats(image, Path::new(image), &mut failures)?;
                }
            }
            Self::Images(images) => images::print(&images)?,
            Self::Cycles(asked) => cycles::print(&asked, &mut failures)?,
            Self::Chips => {
                let frames = chips::measured(&mut failures)?;
                println!(
                    "{}{}",
                    cycles_page::frames_per_second(frames),
                    cycles_page::per_instruction(frames, &esp32c3::measure()?)
                );
            }
            Self::Validate => validate::run(&mut failures)?,
            Self::Cells(choice) => cells::measure(&choice, &mut failures, |cell| println!("{cell}"))?,
        }
        Ok(failures)
    }
}

/// The named pages, or all if none is named.
fn named(names: &[String]) -> Result<Vec<Page>> {
    if names.is_empty() {
        return Ok(PAGES.to_vec());
    }
    let page = |name: &String| PAGES.into_iter().find(|page| page.name() == name).ok_or(USAGE.into());
    names.iter().map(page).collect()
}

fn write(pages: &[Page], rebase: bool, failures: &mut Vec<String>) -> Result<()> {
    let compiler = cross::compiler()?;
    for page in pages {
        let text = page.text(&compiler, rebase, failures)?;
        std::fs::write(cross::root().join(page.file()), text)?;
        eprintln!("written: {}", page.file());
    }
    Ok(())
}

fn check(pages: &[Page], failures: &mut Vec<String>) -> Result<()> {
    let compiler = cross::compiler()?;
    for page in pages {
        let (file, text) = (page.file(), page.text(&compiler, false, failures)?);
        let old = std::fs::read_to_string(cross::root().join(&file));
        page::compare(&file, &old.map_err(|error| format!("{file}: {error}"))?, &text, &compiler, failures);
    }
    Ok(())
}

fn main() -> ExitCode {
    let (arguments, start): (Vec<String>, _) = (std::env::args().skip(1).collect(), Instant::now());
    let done = Task::new(&arguments).and_then(Task::run);
    let seconds = start.elapsed().as_secs();
    eprintln!("It took {} min {} s.", seconds / 60, seconds % 60);
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
