//! The programs of the book's cookbook, each with its display and its input, and their pictures:
//!
//! ```text
//! cargo run --release --example cookbook -- --help
//! ```

mod book;
mod scenes;

use pinhole_apps_support::command;
use pinhole_apps_support::generated::Generated;
use std::error::Error;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, Box<dyn Error>> {
        let about = "Runs the programs of the cookbook, and writes a picture of each into a folder";
        let folder = Generated::arguments("--example cookbook", about, "docs/cookbook")?;
        let mut code = ExitCode::SUCCESS;
        for (name, png) in scenes::all()? {
            let finished = folder.within(&format!("{name}.png")).finish(&png)?;
            code = if finished == ExitCode::SUCCESS { code } else { finished };
        }
        Ok(code)
    })
}
