//! What other programs judge the library by: numbers of a picture, and coverage of the rasteriser; errors of its arithmetic; and the
//! pages with what was measured.
//!
//! ```text
//! cargo run --release -p pinhole-measure -- render SCENE --ids IDS --depth DEPTH --used USED.json
//! cargo run --release -p pinhole-measure -- coverage IN.json OUT
//! cargo run --release -p pinhole-measure -- accuracy --check
//! cargo run --release -p pinhole-measure -- smooth --check
//! cargo run --release -p pinhole-measure -- pages --check
//! ```

mod accuracy;
mod coverage;
mod pages;
mod render;
mod smooth;

use clap::Command;
use pinhole_apps_support::command;
use std::process::ExitCode;
use support::{bridge, oracle};

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, String> {
        let program = Command::new("pinhole-measure")
            .about("Measures what the library draws")
            .subcommand_required(true)
            .subcommands([
                render::command(),
                coverage::command(),
                accuracy::command(),
                smooth::command(),
                pages::command(),
            ]);
        match command::matches(program)?.remove_subcommand() {
            Some((name, given)) if name == "render" => render::run(given),
            Some((name, given)) if name == "coverage" => coverage::run(given),
            Some((name, mut given)) if name == "smooth" => smooth::run(&mut given),
            Some((name, given)) if name == "pages" => pages::run(&given),
            Some((_, mut given)) => accuracy::run(&mut given),
            None => Ok(ExitCode::from(2)), // the parser has refused it
        }
    })
}
