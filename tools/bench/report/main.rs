//! Measures what bands cost, in instructions and RAM, and what each feature takes of flash and stack; writes
//! `docs/bands.md` and `docs/footprint.md`. `tools/bench/run` starts it.

mod bands;
mod bands_page;
mod cells;
mod core;
mod cross;
mod elf;
mod footprint;
mod footprint_page;
mod page;
mod profile;
mod provenance;

use cells::Choice;
use cross::Build;
use std::process::ExitCode;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const M0: &str = "thumbv6m-none-eabi";
const M3: &str = "thumbv7m-none-eabi";

/// What is asked for on the command line.
enum Mode {
    /// Write the page.
    Write,
    /// Compare it.
    Check,
    /// Take today's sizes for the limits.
    Rebase,
    /// Say where the instructions of a frame go, and nothing else.
    Profile,
    /// Print cells, and nothing else.
    Cells(Choice),
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mode = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => Ok(Mode::Write),
        ["--check"] => Ok(Mode::Check),
        ["--rebase"] => Ok(Mode::Rebase),
        ["--profile"] => Ok(Mode::Profile),
        ["cells", ..] => Choice::new(arguments[1..].to_vec()).map(Mode::Cells),
        _ => {
            Err("tools/bench/run [--check | --rebase | --profile | cells [S1 ...] [plain | z] [M0 ...]]"
                .into())
        }
    };
    match mode.and_then(run) {
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

/// What does not hold.
fn run(mode: Mode) -> Result<Vec<String>> {
    let m3 = Build { target: M3, level: "3" };
    let mut failures = Vec::new();
    match &mode {
        Mode::Profile => {
            print!("{}", profile::text(&m3.run("profile")?.0)?);
            return Ok(failures);
        }
        Mode::Cells(choice) => {
            cells::measure(choice, &mut failures, |cell| println!("{cell}"))?;
            return Ok(failures);
        }
        Mode::Write | Mode::Check | Mode::Rebase => {}
    }
    let compiler = cross::compiler()?;
    bands::compare_scenes(&mut failures);
    let host = bands::host()?;
    // Both at once, for two cores.
    m3.cargo("build", &[bands::bins(), footprint::bins()].concat())?;
    let speed = bands::measure(m3, &host, &mut failures)?;
    let footprint = footprint::measure(matches!(mode, Mode::Rebase), &mut failures)?;
    for (page, text) in [
        ("docs/bands.md", bands_page::text(&compiler, &speed)),
        ("docs/footprint.md", footprint_page::text(&compiler, &footprint)),
    ] {
        println!("{text}");
        let path = cross::root().join(page);
        if matches!(mode, Mode::Check) {
            let old = std::fs::read_to_string(&path).map_err(|error| format!("{page}: {error}"))?;
            page::compare(page, &old, &text, &compiler, &mut failures);
        } else {
            std::fs::write(&path, text)?;
        }
    }
    Ok(failures)
}
