//! Draws a model or a scene with depth test, through the library's public interface: pictures for people, raw numbers for
//! other programs.
//!
//! ```text
//! cargo run --release -p pinhole-render -- MODEL.stl
//! cargo run --release -p pinhole-render -- --help
//! ```

use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole_render::program::run(&pinhole_render::firmware::TEMPLATE)
}
