//! From firmware to a display: firmware draws the pictures of the host on every core and links no float routine, drivers
//! and wire formats show pictures on models of panels, and the README's steps lead to a picture and to firmware.
//!
//! Builds `examples/hello.rs` for five targets by `tools/cross` and runs it under QEMU, where it prints checksums. Without the
//! tools the tests say so and pass, except with `CI` set. `boards/emulate` compares displays of emulated boards, pixel by pixel.

mod cross;
mod floats;
#[path = "../../examples/show/mod.rs"]
mod teapot;
mod tearing;
mod template;
mod wire;

use cross::Firmware;

fn no_floats(target: &'static str) {
    let Some(firmware) = Firmware::for_target(target) else { return };
    assert_eq!(firmware.float_routines(), [""; 0]);
}

// The other targets have an FPU or other names for the routines, so their absence would prove nothing.
#[test]
fn thumbv6m_links_no_float_routine() {
    no_floats("thumbv6m-none-eabi");
}

#[test]
fn thumbv7m_links_no_float_routine() {
    no_floats("thumbv7m-none-eabi");
}

macro_rules! draws_as_the_host {
    ($($test:ident $target:literal $core:literal)*) => {$(
        #[test]
        fn $test() {
            let Some(firmware) = Firmware::for_target($target) else { return };
            assert_eq!(firmware.run_hello($core), host());
        }
    )*};
}

draws_as_the_host! {
    cortex_m0_draws_as_the_host "thumbv6m-none-eabi" "cortex-m0"
    cortex_m3_draws_as_the_host "thumbv7m-none-eabi" "cortex-m3"
    cortex_m4_draws_as_the_host "thumbv7em-none-eabihf" "cortex-m4"
    cortex_m7_draws_as_the_host "thumbv7em-none-eabihf" "cortex-m7"
    cortex_m33_draws_as_the_host "thumbv8m.main-none-eabihf" "cortex-m33"
    risc_v_draws_as_the_host "riscv32imc-unknown-none-elf" "rv32imc"
}

/// The comparison would mean little if the frames were empty or alike.
#[test]
fn the_checksums_of_the_frames_differ() {
    let lines = host();
    let checksum = |line: &String| line.split_once(" crc ").map(|(_, rest)| rest[..8].to_string());
    let mut checksums: Vec<_> = lines.iter().map(checksum).collect();
    assert!(checksums.iter().all(Option::is_some), "{lines:#?}");
    checksums.sort();
    checksums.dedup();
    assert_eq!(checksums.len(), lines.len(), "{lines:#?}");
    assert!(lines.iter().any(|line| !line.contains(" 0 clipped")), "{lines:#?}");
}

/// The lines that `hello` prints: the teapot in a few frames, each with a checksum.
fn host() -> Vec<String> {
    let mut stage = Box::new(teapot::Stage::new());
    (0..teapot::FRAMES).map(|frame| stage.draw(frame).to_string()).collect()
}
