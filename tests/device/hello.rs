//! The teapot in a few frames, each with a checksum.

use crate::cross::Firmware;

#[path = "../../examples/show/mod.rs"]
mod show;

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

fn host() -> Vec<String> {
    let mut stage = Box::new(show::Stage::new());
    (0..show::FRAMES).map(|frame| stage.draw(frame).to_string()).collect()
}
