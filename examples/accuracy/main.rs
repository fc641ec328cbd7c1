//! Measures how far the library's numbers lie from f64's and writes docs/accuracy.md:
//!
//! ```text
//! cargo run --release --example accuracy -- --help
//! ```

use support::bridge;
#[path = "../common/command.rs"]
mod command;
mod figures;
#[path = "../common/files.rs"]
mod files;
mod functions;
#[path = "../common/generated.rs"]
mod generated;
#[path = "../../tools/bench/report/grouped.rs"]
mod grouped;
use support::oracle;
mod page;
mod population;
mod sweep;

// The library's private numbers, as they are.
#[allow(dead_code, unreachable_pub, unused_imports)]
#[path = "../../src/math/mod.rs"]
mod math;
#[allow(dead_code, unreachable_pub)]
#[path = "../../src/space.rs"]
mod space;

use generated::Generated;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::run(|| {
        let about = "Measures the library's numbers against f64: a page of tables";
        let file = Generated::arguments("accuracy", about, "docs/accuracy.md")?;
        let page = match page::page() {
            Ok(page) => page,
            Err(bound) => {
                command::complain(bound);
                return Ok(ExitCode::from(1));
            }
        };
        file.finish_page(&page)
    })
}
