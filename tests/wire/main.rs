//! Counts the bytes that go over the wire to a display, and writes docs/wire.md:
//!
//! ```text
//! cargo run --release --example wire -- --help
//! ```

mod page;
use support::panel;

use pinhole_apps_support::command;
use pinhole_apps_support::generated::Generated;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::run(|| {
        let about = "Counts the bytes that a display driver sends, and writes a page of tables";
        let file = Generated::arguments("--example wire", about, "docs/wire.md")?;
        file.finish_page(&page::page())
    })
}
