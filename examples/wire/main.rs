//! Counts what goes over the wire to a display and writes docs/wire.md:
//!
//! ```text
//! cargo run --release --example wire -- --help
//! ```

#[path = "../common/command.rs"]
mod command;
#[path = "../common/files.rs"]
mod files;
#[path = "../common/generated.rs"]
mod generated;
#[path = "../../tools/bench/report/grouped.rs"]
mod grouped;
mod page;
use support::panel;

use generated::Generated;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::run(|| {
        let about = "Counts the bytes that a display driver sends, way by way: a page of tables";
        let file = Generated::arguments("wire", about, "docs/wire.md")?;
        file.finish_page(&page::page())
    })
}
