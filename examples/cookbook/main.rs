//! The programs of the book's cookbook, each with its display and its input, and their pictures:
//!
//! ```text
//! cargo run --release --example cookbook -- --help
//! ```

mod book;
mod scenes;

use clap::{value_parser, Arg, ArgAction, Command};
use pinhole_apps_support::{command, files};
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, Box<dyn Error>> {
        let out = command::option("out", "DIR", "The folder for the pictures", "docs/cookbook");
        let check = Arg::new("check").long("check").action(ArgAction::SetTrue);
        let command = Command::new("cookbook")
            .about("Runs the programs of the cookbook, and writes a picture of each")
            .arg(out.value_parser(value_parser!(PathBuf)))
            .arg(check.help("Write nothing; exit with code 1 if a picture is out of date"));
        let mut given = command::matches(command)?;
        let (out, check) = (given.remove_one::<PathBuf>("out").unwrap_or_default(), given.get_flag("check"));
        let pictures = scenes::all()?;
        let pictures: Vec<_> =
            pictures.into_iter().map(|(name, png)| (out.join(name).with_extension("png"), png)).collect();
        if !check {
            command::folder(&out)?;
            let list: Vec<_> = pictures.iter().map(|(file, png)| (&**file, png)).collect();
            files::write(&list)?;
        }
        let mut current = true;
        for (file, png) in &pictures {
            let name = file.display();
            if !check {
                command::say(name)?;
            } else if std::fs::read(file).map_err(|e| format!("{name}: cannot be read: {e}"))? != *png {
                command::complain(format_args!(
                    "{name}: out of date: run cargo run --release --example cookbook -- --out {}",
                    out.display()
                ));
                current = false;
            }
        }
        Ok(if current { ExitCode::SUCCESS } else { ExitCode::from(1) })
    })
}
