//! What the firmware logs of each type, decoded, is what is computed by hand.
//!
//! Without the tools for it the test says so and passes, except with `CI` set.

use defmt_decoder::{DecodeError, Table};
use std::process::Stdio;
use support::firmware;

const TARGET: &str = "thumbv7m-none-eabi";

#[test]
fn each_type_logs_its_value() {
    let Some((image, sent)) = device() else { return };
    assert_eq!(decode(&image, &sent), TYPES.map(|text| format!("DEBUG {text}")));
}

/// The output of `types::log`, in its order, computed by hand. The camera stands 40 away and 6 up, and has 30° for 64 rows:
/// a focal length of 119.4 rows. So the square's half side of 9/8 takes 3.32 columns and 3.29 rows from (64, 32): faces
/// cover the centres from 61 to 66 and 29 to 34, and edges run from pixel 60 to 67 and 28 to 35.
///
/// Of numbers with an exponent the largest is 2²⁹ … 2³⁰: 1 is 2³⁰ · 2⁰ / 2³⁰ as a constant, and 2²⁹ · 2¹ / 2³⁰ where it was worked
/// out.
const TYPES: [&str; 24] = [
    "mesh of 4 vertices, 2 faces, 2 edges",
    "128x64+8+0 Deg0",
    "mesh of 4 vertices, 2 faces, 2 edges in Size { width: 128, height: 64 } at Point { x: 0, y: 0 }, cull Back",
    "mesh of 4 vertices, 2 faces, 2 edges in Size { width: 128, height: 64 } at Point { x: 0, y: 0 }, cull Back, \
     3 vertices cached",
    "faces within Scissor { left: 61, top: 29, right: 67, bottom: 35 }: \
     Statistics { drawn: 2, culled: 0, clipped: 0, outside: 0, degenerate: 0 }",
    "edges within Scissor { left: 60, top: 28, right: 68, bottom: 36 }: \
     Statistics { drawn: 2, culled: 0, clipped: 0, outside: 0, degenerate: 0 }",
    "painter of 4/8 vertices, 2/4 faces: \
     Statistics { drawn: 2, culled: 0, clipped: 0, outside: 0, degenerate: 0 }",
    "painter's order of 2 faces: Statistics { drawn: 2, culled: 0, clipped: 0, outside: 0, degenerate: 0 }",
    "Some(band of Size { width: 128, height: 8 } at Point { x: 0, y: 0 })",
    "frame of Size { width: 128, height: 64 } at Point { x: 0, y: 0 }, 8 rows drawn",
    "depth buffer of Size { width: 5, height: 6 } at Point { x: 3, y: 4 }",
    "dirty regions of Size { width: 128, height: 64 } at Point { x: 0, y: 0 }: 1/4 marks, 0 before, all: true",
    "hierarchy of 1 nodes",
    "(65536, 131072, -196608)/65536 radius 32768/65536",
    "(32768, 32768, 32768)/65536",
    "[-32768, 32768] x [-32768, 32768]/65536",
    "[[1073741824, 0, 0], [0, 1073741824, 0], [0, 0, 1073741824]] * 2^(0 - 30), \
     [4294967296, 8589934592, -12884901888]/2^32",
    "picture of Size { width: 3, height: 2 }",
    "pixels of Rectangle { top_left: Point { x: 0, y: 0 }, size: Size { width: 3, height: 2 } }",
    "shade table",
    // Of 255 entries, by full light and half of it.
    "light [261120, 130560, 0] of a shade table, in 1/1024",
    // x/2, y, and with the front plane at 0 and the back plane at −2 (z + w)/2 = −z/2, and w = 1.
    "[[536870912, 0, 0] * 2^(0 - 30), 0/2^32][[0, 536870912, 0] * 2^(1 - 30), 0/2^32]\
     [[0, 0, -536870912] * 2^(0 - 30), 0/2^32][[0, 0, 0] * 2^(0 - 30), 4294967296/2^32]",
    // x/2, y, and with near 1 and far 3 (z + w)/2 = (−2z − 3 − z)/2, and w = −z.
    "[[536870912, 0, 0] * 2^(0 - 30), 0/2^32][[0, 536870912, 0] * 2^(1 - 30), 0/2^32]\
     [[0, 0, -805306368] * 2^(1 - 30), -6442450944/2^32][[0, 0, -536870912] * 2^(1 - 30), 0/2^32]",
    "axes [[1073741824, 0, 0], [0, 1073741824, 0], [0, 0, 1073741824]]/2^30, eye [0, 0, 8589934592]/2^32, \
     centre (16384, 8192)/256",
];

/// The firmware's image, and what it sends under QEMU. None if the tools for that are missing.
fn device() -> Option<(Vec<u8>, Vec<u8>)> {
    if !firmware::has_compiler("defmt", TARGET) {
        return None;
    }
    let target_dir = firmware::target_dir(env!("CARGO_TARGET_TMPDIR"));
    // Ends by itself: a panic ends QEMU too.
    let run = firmware::cross(&target_dir)
        .args([env!("CARGO"), "run", "--quiet", "--release", "--target", TARGET])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdin(Stdio::null())
        .output()
        .expect("bash ran a moment ago");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let image = std::fs::read(target_dir.join(TARGET).join("release/log")).expect("it was run");
    Some((image, run.stdout))
}

/// Level and text of each line.
fn decode(image: &[u8], sent: &[u8]) -> Vec<String> {
    let table = Table::parse(image).expect("an ELF file").expect("a .defmt section");
    let mut decoder = table.new_stream_decoder();
    decoder.received(sent);
    let mut lines = Vec::new();
    loop {
        match decoder.decode() {
            Ok(frame) => {
                let level = frame.level().map_or("", |level| level.as_str()).to_uppercase();
                lines.push(format!("{level} {}", frame.display_message()));
            }
            Err(DecodeError::UnexpectedEof) => return lines,
            Err(DecodeError::Malformed) => panic!("malformed after {lines:#?}"),
        }
    }
}
