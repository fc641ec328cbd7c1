//! Measures how far the library's numbers lie from f64's and writes docs/accuracy.md:
//!
//! ```text
//! cargo run --release --example accuracy -- --help
//! ```

#[path = "../../tests/bridge/mod.rs"]
mod bridge;
mod figures;
mod functions;
#[path = "../../tests/oracle/mod.rs"]
mod oracle;
mod page;
mod population;
mod sweep;

// The library's private numbers, as they are.
#[allow(dead_code)]
#[path = "../../src/math/num.rs"]
mod num;
#[allow(dead_code, unreachable_pub)]
#[path = "../../src/math/quaternion.rs"]
mod quaternion;
#[allow(dead_code)]
#[path = "../../src/math/unit.rs"]
mod unit;

use clap::{value_parser, Arg, ArgAction, Command};
use pinhole::{NumberError, Scalar}; // for `quaternion`
use std::path::PathBuf;
use std::process::ExitCode;

struct Arguments {
    out: PathBuf,
    check: bool,
}

fn arguments() -> Result<Arguments, clap::Error> {
    let mut given = Command::new("accuracy")
        .about("Measures the library's numbers against f64: a page of tables")
        .arg(
            Arg::new("out")
                .long("out")
                .value_name("FILE")
                .help("The page")
                .default_value("docs/accuracy.md")
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(
            Arg::new("check")
                .long("check")
                .help("Write nothing; exit code 1 if the file is not what would be written")
                .action(ArgAction::SetTrue),
        )
        .try_get_matches()?;
    Ok(Arguments { out: given.remove_one("out").unwrap_or_default(), check: given.get_flag("check") })
}

fn main() -> ExitCode {
    let arguments = match arguments() {
        Ok(arguments) => arguments,
        Err(help) if help.exit_code() == 0 => help.exit(),
        Err(error) => return refuse(error.to_string().lines().next().unwrap_or_default()),
    };
    let page = match page::page() {
        Ok(page) => page,
        Err(bound) => {
            eprintln!("{bound}");
            return ExitCode::from(1);
        }
    };
    let out = arguments.out.display();
    if arguments.check {
        return match std::fs::read_to_string(&arguments.out) {
            Ok(file) if file == page => ExitCode::SUCCESS,
            Ok(file) => {
                let first = file.lines().zip(page.lines()).find(|(old, new)| old != new);
                if let Some((old, new)) = first {
                    eprintln!("- {old}\n+ {new}");
                }
                eprintln!("{out}: not current: run cargo run --release --example accuracy -- --out {out}");
                ExitCode::from(1)
            }
            Err(error) => refuse(&format!("{out}: cannot be read: {error}")),
        };
    }
    print!("{page}");
    match std::fs::write(&arguments.out, page) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => refuse(&format!("{out}: cannot be written: {error}")),
    }
}

/// One line that says what is wrong with what the user gave.
fn refuse(problem: &str) -> ExitCode {
    eprintln!("{problem}");
    ExitCode::from(2)
}
