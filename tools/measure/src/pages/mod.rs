//! Writes the parts of the documentation that repeat other files: the tables of measured figures in the pages, from `docs/data`, and
//! the pictures of the crate's documentation.
//!
//! In a page, a table stands between `<!-- table: NAME -->` and `<!-- end of table -->`; the text around it is written by hand.

mod pictures;
mod tables;

use clap::{Arg, ArgAction, ArgMatches, Command};
use pinhole_apps_support::{command, files};
use std::path::Path;
use std::process::ExitCode;

/// The pages with tables.
const PAGES: [&str; 8] = [
    "README.md",
    "ARCHITECTURE.md",
    "docs/accuracy.md",
    "docs/speed.md",
    "docs/growth.md",
    "docs/footprint.md",
    "docs/bands.md",
    "src/book/budget.md",
];
const PICTURES: &str = "src/book/pictures.md";
const BEGIN: &str = "<!-- table: ";
const END: &str = "<!-- end of table -->\n";

pub(crate) fn command() -> Command {
    let check = Arg::new("check").long("check").action(ArgAction::SetTrue);
    Command::new("pages")
        .about("Writes the tables of pages from docs/data, and the pictures of the crate's documentation")
        .arg(check.help("Write nothing; exit with code 1 if a file is out of date"))
}

pub(crate) fn run(given: &ArgMatches) -> Result<ExitCode, String> {
    let check = given.get_flag("check");
    let mut current = true;
    let mut compare = |path: &str, text: String| -> Result<(), String> {
        if !check {
            return files::write(&[(&*root().join(path), text)]);
        }
        if read(path)? != text {
            command::complain(format_args!(
                "{path}: out of date: run cargo run --release -p pinhole-measure -- pages"
            ));
            current = false;
        }
        Ok(())
    };
    let tables = tables::Tables::read()?;
    for path in PAGES {
        compare(path, with_tables(path, &tables)?)?;
    }
    compare(PICTURES, pictures::definitions()?)?;
    Ok(if current { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

/// A page with its tables made anew.
fn with_tables(path: &str, tables: &tables::Tables) -> Result<String, String> {
    let old = read(path)?;
    let (mut text, mut rest) = (String::new(), old.as_str());
    while let Some((before, after)) = rest.split_once(BEGIN) {
        let (name, after) = after.split_once(" -->\n").ok_or(format!("{path}: a table without a name"))?;
        let (_, after) = after.split_once(END).ok_or(format!("{path}: {name} has no end"))?;
        let table = tables.table(name).map_err(|e| format!("{path}: table {name}: {e}"))?;
        text += &[before, BEGIN, name, " -->\n", &table, END].concat();
        rest = after;
    }
    Ok(text + rest)
}

/// The root of the project.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// The text of a file of the project.
fn read(path: &str) -> Result<String, String> {
    std::fs::read_to_string(root().join(path)).map_err(|e| format!("{path}: {e}"))
}
