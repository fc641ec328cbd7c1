//! `docs/bands.md`.

use crate::bands::Speed;
use crate::grouped::grouped;
use crate::page::BUILT;
use std::fmt::Write;

const HEAD: &str = "\
# What bands cost

Instructions and RAM, measured on an emulated Cortex-M. This page is written by

```sh
tools/bench/run
```

and CI runs it with `--check`: the check fails if a limit is broken or, with the same compiler, a figure is not within 2 %
(or 64 bytes) of this page's. Code size is in [footprint.md](footprint.md). ";

const SPEED: &str = "
## Instructions

For one frame on a Cortex-M3 (thumbv7m, opt-level 3, fat LTO), 240 × 240 pixels of Rgb565. Instructions are not cycles.
The emulator's clock counts them, 64 ns for each, checked against a loop of known length in the same run; every run
gives equal counts. The second frame of a scene is counted: its pixels are set to the background, the depth strips
cleared, the object's transform set up, its vertices transformed, its faces culled, lit and drawn. The count ends when the pixels
lie in memory: nothing is sent. Camera and light are set up before. No figure of the scene is known at compile time. Every picture
equals the host's, by checksum, and each scene covers as many pixels as `tools/bench/scenes.json` states.

*At once* draws the whole frame into memory through the generic `DrawTarget` interface, with a depth for each pixel; in
*bands* the frame is drawn strip by strip, by `Band::pixels`. (A whole frame by `Picture::pixels` takes less than
either: see [speed.md](speed.md). S3 and S4 are culled by face planes there; here, by the area of the projected
corners.) *Empty* is a frame in which nothing is drawn: the cost of the clears. The last columns divide the bands of 16 rows
by the frame drawn at once, with the clears and without; for the torus with depth, the quotient with the clears may be at most 1.25.

| scene | | at once | one band of 240 rows | bands of 16 rows | of 8 rows | 16 rows / at once | without the clears |
|---|---|--:|--:|--:|--:|--:|--:|
";

const RAM: &str = "
## RAM

Depth-tested in bands of 8 rows, without planes: all variables (vertex cache, bin storage, the strips of colour and depth, from the image's
sections) and the stack from the top of RAM to its deepest byte in two frames and the set-up before them (painted
first). The mesh lies in flash.

| scene | variables | stack | together | at most |
|---|--:|--:|--:|--:|
";

pub(crate) fn text(compiler: &str, speed: &Speed) -> String {
    let mut text = format!("{HEAD}{BUILT}{compiler}.\n{SPEED}");
    for (scene, way, what) in ROWS {
        let counts = ["full", "band240", "band16", "band8"].map(|how| speed.instructions(scene, way, how));
        let _ = write!(text, "| {scene} | {what} |");
        for count in counts {
            let _ = write!(text, " {} |", count.map_or("–".into(), grouped));
        }
        for ratio in speed.ratios(scene, way) {
            let _ = write!(text, " {} |", ratio.map_or("–".into(), |ratio| format!("{ratio:.3}")));
        }
        text.push('\n');
    }
    text += RAM;
    for ram in &speed.ram {
        let (together, limit) = (grouped(ram.together()), grouped(ram.limit));
        let (statics, stack) = (grouped(ram.statics), grouped(ram.stack));
        let _ = writeln!(text, "| {} | {statics} | {stack} | {together} | {limit} |", ram.scene);
    }
    text
}

const ROWS: &[(&str, &str, &str)] = &[
    ("empty", "solid", "no depth"),
    ("empty", "depth", "depth"),
    ("S1", "wireframe", "cube, wireframe"),
    ("S2", "solid", "cube, no depth"),
    ("S2", "depth", "cube, depth"),
    ("S3", "solid", "torus, 1000 triangles, no depth"),
    ("S3", "depth", "torus, 1000 triangles, depth"),
    ("S4", "solid", "sphere, 5780 triangles, no depth"),
    ("S4", "depth", "sphere, 5780 triangles, depth"),
];
