//! Measures the errors of the library's integers against f64, and writes docs/accuracy.md and docs/texture-error.svg.

mod figures;
mod functions;
mod page;
mod population;
mod sweep;
mod textures;

use clap::{ArgMatches, Command};
use pinhole_apps_support::command::complain;
use pinhole_apps_support::generated::Generated;
use std::process::ExitCode;

const PROGRAM: &str = "-p pinhole-measure -- accuracy";

pub(crate) fn command() -> Command {
    let about = "Measures the errors of the library's integers against f64, and writes a page of tables";
    Generated::command("accuracy", about, "docs/accuracy.md")
}

pub(crate) fn run(given: &mut ArgMatches) -> Result<ExitCode, String> {
    let file = Generated::from(PROGRAM, given);
    let (page, plot) = match page::page() {
        Ok(pages) => pages,
        Err(bound) => {
            complain(bound);
            return Ok(ExitCode::from(1));
        }
    };
    let plot = file.beside(textures::PLOT).finish_page(&plot)?;
    let page = file.finish_page(&page)?;
    Ok(if plot == ExitCode::SUCCESS { page } else { plot })
}
