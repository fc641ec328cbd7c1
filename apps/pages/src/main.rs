//! Generates the parts of the documentation that repeat other files: the README's table, the book's tables of constants and
//! its figure, and the pictures of the crate's documentation. Run it after a page or picture in `docs` has changed:
//!
//! ```text
//! cargo run --release -p pinhole-pages -- --help
//! ```

mod constants;
mod figure;
#[path = "../../../tools/bench/report/grouped.rs"]
mod grouped;
mod page;
mod pictures;
mod readme;

use clap::{Arg, ArgAction, Command};
use pinhole_apps_support::{command, files};
use std::path::Path;
use std::process::ExitCode;

/// A file and the function that generates it.
type Part = (&'static str, fn() -> Result<String, String>);

const PARTS: [Part; 4] = [
    ("README.md", readme::with_table),
    ("src/book/constants.md", constants::tables),
    ("src/book/pictures.md", pictures::definitions),
    ("src/book/coordinates.svg", figure::svg),
];

fn main() -> ExitCode {
    command::run(|| {
        let check = Arg::new("check").long("check").action(ArgAction::SetTrue);
        let command = Command::new("pages")
            .about("Writes the parts of the documentation that repeat other files")
            .arg(check.help("Write nothing; exit with code 1 if a file is out of date"));
        let check = command::matches(command)?.get_flag("check");
        let mut current = true;
        for (path, content) in PARTS {
            let content = content()?;
            let file = root().join(path);
            if !check {
                files::write(&[(&*file, content)])?;
                command::say(path)?;
            } else if read(path).as_ref() != Ok(&content) {
                command::complain(format_args!(
                    "{path}: out of date: run cargo run --release -p pinhole-pages"
                ));
                current = false;
            }
        }
        Ok::<_, String>(if current { ExitCode::SUCCESS } else { ExitCode::from(1) })
    })
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Reads a text file of the repository.
fn read(path: &str) -> Result<String, String> {
    std::fs::read_to_string(root().join(path)).map_err(|e| format!("{path}: cannot be read: {e}"))
}
