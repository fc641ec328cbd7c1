//! Measures the errors of the library's integers against f64 and writes docs/accuracy.md and docs/texture-error.svg:
//!
//! ```text
//! cargo run --release -p pinhole-accuracy -- --help
//! ```

mod figures;
mod functions;
#[path = "../../../tools/bench/report/grouped.rs"]
mod grouped;
mod page;
mod population;
mod sweep;
mod textures;

// Private modules of the library, which are measured directly.
#[allow(dead_code, unreachable_pub, unused_imports, clippy::wrong_self_convention)]
#[path = "../../../src/math/mod.rs"]
mod math;
#[allow(dead_code, unreachable_pub)]
#[path = "../../../src/space.rs"]
mod space;

use pinhole_apps_support::command;
use pinhole_apps_support::generated::Generated;
use std::process::ExitCode;
use support::{bridge, oracle};

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, String> {
        let about = "Measures the errors of the library's integers against f64, and writes a page of tables and a plot";
        let file = Generated::arguments("-p pinhole-accuracy", about, "docs/accuracy.md")?;
        let (page, plot) = match page::page() {
            Ok(pages) => pages,
            Err(bound) => {
                command::complain(bound);
                return Ok(ExitCode::from(1));
            }
        };
        let plot = file.beside(textures::PLOT).finish_page(&plot)?;
        let page = file.finish_page(&page)?;
        Ok(if plot == ExitCode::SUCCESS { page } else { plot })
    })
}
