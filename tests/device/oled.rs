//! The show on an SPI display: every pixel of every frame on the display equals the host's.

use crate::cross::{Firmware, PATIENCE};
use crate::emulator::{complains, Emulator, Report};
use crate::picture::Picture;
use crate::show::{caption, FRAMES, STEPS};
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::time::Duration;

/// The bound of the firmware's stack in bytes, about 5 % above the measured use, which is that of the balloon's frame while it is
/// set up: the scenes without textures take 2060 bytes, on a Cortex-M0 2620.
const STACK: usize = 4180;
/// A Cortex-M0 draws the pictures of the host with fewer registers.
const STACK_OF_M0: usize = 4590;
/// The bound of the firmware's variables in bytes.
const VARIABLES: u32 = 26_700;

/// The differences, frame by frame; empty if the pictures and their number are equal.
fn differences(seen: &[Picture], wanted: &[Picture]) -> Vec<String> {
    let frames = seen.iter().zip(wanted).enumerate();
    let pixels = frames
        .filter_map(|(frame, (seen, wanted))| Some(format!("frame {frame}: {}", seen.difference(wanted)?)));
    let missing = (seen.len() != wanted.len()).then(|| format!("{} of {} frames", seen.len(), wanted.len()));
    pixels.chain(missing).collect()
}

fn host() -> Vec<Picture> {
    (0..FRAMES).map(Picture::of_frame).collect()
}

fn shows_what_the_host_draws(target: &'static str, core: &str, most: usize) {
    let Some(firmware) = Firmware::for_target(target) else { return };
    let variables = firmware.variables("oled");
    assert!(variables <= VARIABLES && variables > VARIABLES / 2, "{variables} bytes of variables");
    let mut emulator = Emulator::start(core, &firmware.image("oled"), PATIENCE).expect("QEMU");
    let (mut reports, mut pictures) = (Vec::new(), Vec::new());
    // One more than there are is enough to see that there are too many.
    while let Some((report, picture)) = emulator.frame().expect("a frame") {
        reports.push(report);
        pictures.push(picture);
        assert!(pictures.len() <= FRAMES as usize, "the show does not end");
        emulator.proceed().expect("an answer");
    }
    let stack = emulator.finish().expect("a good end, and a display that understood everything");
    println!("{core}: {variables} bytes of variables, {stack} of stack");
    assert!(stack <= most, "{stack} bytes of stack");
    assert_eq!(differences(&pictures, &host()), [""; 0]);

    // In their order, and in bands of what changed: 4096 bytes are all of the display.
    for (frame, report) in (0..).zip(&reports) {
        let Report { frame: number, bytes, caption: name } = report;
        assert_eq!((*number, name.as_str()), (frame, caption(frame)));
        assert_eq!(*bytes == 4096, frame % STEPS == 0, "frame {frame}: {bytes} bytes");
    }
}

macro_rules! shows_what_the_host_draws {
    ($($test:ident $target:literal $core:literal $stack:ident)*) => {$(
        #[test]
        fn $test() {
            shows_what_the_host_draws($target, $core, $stack);
        }
    )*};
}

shows_what_the_host_draws! {
    cortex_m0_shows_the_pictures_of_the_host "thumbv6m-none-eabi" "cortex-m0" STACK_OF_M0
    cortex_m3_shows_the_pictures_of_the_host "thumbv7m-none-eabi" "cortex-m3" STACK
    cortex_m4f_shows_the_pictures_of_the_host "thumbv7em-none-eabihf" "cortex-m4" STACK
    cortex_m7_shows_the_pictures_of_the_host "thumbv7em-none-eabihf" "cortex-m7" STACK
    cortex_m33_shows_the_pictures_of_the_host "thumbv8m.main-none-eabihf" "cortex-m33" STACK
}

/// The comparison would mean little if the frames were empty or alike.
#[test]
fn the_frames_of_the_show_differ() {
    let frames: BTreeSet<_> = host().iter().map(|picture| picture.levels().to_vec()).collect();
    assert_eq!(frames.len(), FRAMES as usize);
    // Levels that no display has stand for pixels that were not drawn.
    assert!(frames.iter().flatten().all(|level| *level < 16));
    assert!(frames.iter().all(|levels| levels.iter().filter(|level| **level > 0).count() > 200));
}

/// The last scene is in black and white alone, with enough of both.
#[test]
fn the_last_scene_is_of_one_bit() {
    for picture in &host()[FRAMES as usize - STEPS as usize..] {
        let white = picture.levels().iter().filter(|level| **level == 15).count();
        let black = picture.levels().iter().filter(|level| **level == 0).count();
        assert_eq!(white + black, picture.levels().len());
        assert!(black.min(white) > 1000, "{black} {white}");
    }
}

/// A firmware that gets no answer waits forever, like a firmware that hangs. The test notices and ends QEMU.
#[test]
fn a_firmware_that_hangs_is_killed() {
    let Some(firmware) = Firmware::for_target("thumbv7m-none-eabi") else { return };
    // Enough for a start under load; the firmware itself says nothing any more.
    let patience = Duration::from_secs(10);
    let mut emulator = Emulator::start("cortex-m3", &firmware.image("oled"), patience).expect("QEMU");
    assert!(emulator.frame().expect("the first frame").is_some());
    assert_eq!(
        emulator.frame().map(|frame| frame.is_some()).map_err(|error| error.kind()),
        Err(ErrorKind::TimedOut)
    );
}

/// The show's firmware, made to send a command that the SSD0323 does not have. If QEMU did not report it, or in other
/// words, the other tests here could not fail.
#[test]
fn an_unknown_display_command_fails_the_test() {
    let Some(firmware) = Firmware::for_target("thumbv7m-none-eabi") else { return };
    let mut emulator = Emulator::start("cortex-m3", &firmware.image("oled"), PATIENCE).expect("QEMU");
    assert!(emulator.frame().expect("the first frame").is_some());
    emulator.answer(0x01).expect("an answer");
    assert!(emulator.frame().expect("the end").is_none());
    let error = emulator.finish().expect_err("a display that has not understood").to_string();
    assert!(error.contains("exit status: 0") && complains(&error), "{error}");
}
