//! `pinhole-render` with the code of a project: see `Cargo.toml`.

use pinhole_apps_support::command;
use pinhole_render::firmware::{self, Code};
use std::process::ExitCode;

include!(concat!(env!("OUT_DIR"), "/project.rs"));

fn main() -> ExitCode {
    let wanted = std::env::var(firmware::PROJECT);
    if wanted.is_ok_and(|wanted| wanted != PROJECT) {
        command::complain("another project's preview was built at the same time: run the command again");
        return ExitCode::from(2);
    }
    pinhole_render::program::run(&Code { project: Some(PROJECT), options: script::options, draw })
}
