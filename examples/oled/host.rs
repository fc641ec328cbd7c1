//! The host's side: takes the pictures of the emulated display, or draws them itself.

use crate::picture::Picture;
use crate::show::{FRAMES, SCENES, SIZE, STEPS};
use clap::{value_parser, Arg};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use pinhole_apps_support::command;
use pinhole_apps_support::files;
use pinhole_apps_support::generated::Generated;
use pinhole_apps_support::still;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

pub(crate) fn run() -> Result<ExitCode, Box<dyn Error>> {
    let about = "Draws what the emulated display shows, as a contact sheet; or takes it from the display";
    let firmware = Arg::new("emulate")
        .long("emulate")
        .value_name("FIRMWARE")
        .value_parser(value_parser!(PathBuf))
        .help("Run the firmware under QEMU and write what its display shows to target/oled instead");
    let core = command::option("core", "NAME", "The emulated core, as QEMU names it", "cortex-m3");
    let command =
        Generated::command("--example oled --features qemu", about, "docs/oled.png").arg(firmware).arg(core);
    let mut given = command::matches(command)?;
    let core: String = given.remove_one("core").unwrap_or_default();
    if let Some(firmware) = given.remove_one::<PathBuf>("emulate") {
        emulate(&core, &firmware)?;
        return Ok(ExitCode::SUCCESS);
    }
    let file = Generated::from("--example oled --features qemu", &mut given);
    let pictures: Vec<_> = (0..FRAMES).map(Picture::of_frame).collect();
    Ok(file.finish(&sheet(&pictures)?)?)
}

/// All frames: each scene from left to right.
fn sheet(pictures: &[Picture]) -> Result<Vec<u8>, Box<dyn Error>> {
    const GAP: u32 = 4;
    const PAPER: Rgb888 = Rgb888::new(85, 85, 85);
    let columns = STEPS.div_ceil(2);
    let size = Size::new(columns * (SIZE.width + GAP) + GAP, SCENES.len() as u32 * (SIZE.height + GAP) + GAP);
    let mut pixels = vec![PAPER; (size.width * size.height) as usize];
    // Every second frame.
    for (place, picture) in (0..).zip(pictures.iter().step_by(2)) {
        let left = place % columns * (SIZE.width + GAP) + GAP;
        let top = place / columns * (SIZE.height + GAP) + GAP;
        let (_, picture) = picture.enlarged(1);
        for (y, row) in (top..).zip(picture.chunks(SIZE.width as usize)) {
            let start = (y * size.width + left) as usize;
            pixels[start..start + row.len()].copy_from_slice(row);
        }
    }
    still::png(size, &pixels)
}

#[cfg(not(unix))]
fn emulate(_: &str, _: &std::path::Path) -> Result<(), Box<dyn Error>> {
    Err("QEMU is spoken to over Unix sockets, which this system has not".into())
}

#[cfg(unix)]
fn emulate(core: &str, firmware: &std::path::Path) -> Result<(), Box<dyn Error>> {
    use crate::emulator::Emulator;
    // A frame takes milliseconds.
    const PATIENCE: std::time::Duration = std::time::Duration::from_secs(20);
    let out = std::path::Path::new("target/oled");
    let unwritable = |error: std::io::Error| format!("{}: cannot be written: {error}", out.display());
    if out.exists() {
        std::fs::remove_dir_all(out).map_err(unwritable)?;
    }
    command::folder(out)?;
    let write = |name: &str, bytes: Vec<u8>| files::write(&[(&*out.join(name), bytes)]);

    let mut emulator = Emulator::start(core, firmware, PATIENCE)?;
    let mut pictures = Vec::new();
    while let Some((report, picture)) = emulator.frame()? {
        command::say(format_args!(
            "frame {:2}: {:4} bytes sent, {}",
            report.frame, report.bytes, report.caption
        ))?;
        let (size, pixels) = picture.enlarged(4);
        write(&format!("{:02}.png", report.frame), still::png(size, &pixels)?)?;
        pictures.push(picture);
        emulator.proceed()?;
    }
    let stack = emulator.finish()?;
    write("contact-sheet.png", sheet(&pictures)?)?;
    write("oled.gif", film(&pictures)?)?;
    let count = pictures.len();
    command::say(format_args!(
        "{}: {count} pictures of the display, contact-sheet.png, oled.gif",
        out.display()
    ))?;
    command::say(format_args!("{stack} bytes of stack"))?;
    Ok(())
}

/// An endless animation at twice the size: the panel's 16 shades are its palette.
#[cfg(unix)]
fn film(pictures: &[Picture]) -> Result<Vec<u8>, Box<dyn Error>> {
    const SCALE: u32 = 2;
    let palette: Vec<_> = (0..16).map(|level| [17 * level; 3]).collect();
    let mut film = pinhole_apps_support::animation::Animation::new(
        Vec::new(),
        [SIZE.width * SCALE, SIZE.height * SCALE],
        &palette,
    )?;
    for picture in pictures {
        let (_, pixels) = picture.enlarged(SCALE);
        film.add(pixels.iter().map(|pixel| pixel.r() / 17).collect(), None, 15)?;
    }
    Ok(film.finish()?)
}
