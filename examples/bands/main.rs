//! Drawing a frame without a framebuffer: in a blocking loop, with two strips and DMA, and in an async task. Each loop pulls
//! bands from a [`Frame`](pinhole::Frame).
//!
//! ```text
//! cargo run --release --example bands
//! ```
//!
//! Transfers to the display take time here, as by SPI. The three pictures are equal; one is written to
//! `target/bands/bands.png`.

mod blocking;
mod display;
mod ping_pong;
mod scene;
mod task;

use clap::{value_parser, Command};
use display::Display;
use embedded_graphics::pixelcolor::Rgb888;
use pinhole_apps_support::{command, files, still};
use scene::{Scene, SIZE};
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, Box<dyn Error>> {
        let out = command::option("out", "DIR", "The folder for the picture", "target/bands");
        let about =
            "Draws a frame in bands: in a blocking loop, by DMA with two strips, and in an async task";
        let command = Command::new("bands").about(about).arg(out.value_parser(value_parser!(PathBuf)));
        let out: PathBuf = command::matches(command)?.remove_one("out").unwrap_or_default();
        let mut scene = Scene::new()?;

        let mut pictures: Vec<(&str, Vec<Rgb888>)> = Vec::new();
        let mut display = Display::new(SIZE);
        blocking::show(&mut scene, &mut display)?;
        pictures.push(("blocking", display.pixels()));
        let display = ping_pong::show(&mut scene, Display::new(SIZE))?;
        pictures.push(("two strips and DMA", display.pixels()));
        let (display, others) = task::show(&mut scene, Display::new(SIZE))?;
        pictures.push(("async task", display.pixels()));
        command::say(format_args!("another task ran {others} times during the transfers of the async task"))?;

        for (name, picture) in &pictures {
            if *picture != pictures[0].1 {
                return Err(format!("{name}: not the picture of the blocking loop").into());
            }
        }
        command::folder(&out)?;
        let file = out.join("bands.png");
        let png = still::png(SIZE, &pictures[0].1)?;
        files::write(&[(&*file, png)])?;
        command::say(format_args!("{}: the same picture three times", file.display()))?;
        Ok(ExitCode::SUCCESS)
    })
}
