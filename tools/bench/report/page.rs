//! The page: how it reads, and whether an older one says the same.

use crate::flash::{Flash, BUILDS, IMAGES};
use crate::speed::Speed;
use std::fmt::Write;

/// Between the digits of large numbers: a space that does not break.
const THIN: char = '\u{a0}';
/// The line that says what built the firmware.
const BUILT: &str = "Built with ";

const HEAD: &str = "\
# What bands cost

Instructions, RAM and flash, measured on an emulated Cortex-M. This page is written by

```sh
tools/bench/run
```

and CI runs that with `--check`: it fails where a limit is broken or, with the same compiler, a figure is not within 2 %
(or 64 bytes) of this page's. ";

const SPEED: &str = "
## Instructions

Of one frame on a Cortex-M3 (thumbv7m, opt-level 3, fat LTO), 240 × 240 pixels of Rgb565. Instructions are not cycles.
They are counted by the emulator's clock, 64 ns for each, against a loop of known length in the same run; the same in
every run. Counted is the second frame of a scene, all of it: the frame's pixels set to the background, the depth strips
cleared, the object placed, its vertices transformed, its faces sorted out, lit and drawn. It ends when the pixels lie
in memory: nothing is sent. Camera and light are set up before. The compiler knows none of the numbers. Every picture
is that of the host, compared by checksum, and the scenes cover the pixels that `tools/bench/scenes.json` says.

*At once* draws into memory for the whole frame, with a depth for each pixel; in *bands* the same goes through strips of
so many rows. *Empty* is a frame in which nothing is drawn: what the clears cost. The last columns divide the bands of
16 rows by what is drawn at once, and both less the empty frame; for the torus with depth both are to be at most 1.25.

| scene | | at once | one band of 240 rows | bands of 16 rows | of 8 rows | 16 rows / at once | without the clears |
|---|---|--:|--:|--:|--:|--:|--:|
";

const RAM: &str = "
## RAM

Depth-tested in bands of 8 rows: all variables (corners, records, the strips of colour and depth, from the image's
sections) and the stack from the top of RAM to its deepest byte in two frames and the set-up before them (painted
first). The mesh lies in flash.

| scene | variables | stack | together | at most |
|---|--:|--:|--:|--:|
";

const FLASH: &str = "
## Flash

Of linking only what is used: code, constants and start values of a firmware with one purpose, less those of one that
does nothing (it has the same mesh, start and end). The display is a stub. CI allows 5 % more than
`tools/bench/flash.txt` has. *Set-up* is a camera and a placed mesh, which every other one needs too.

| bytes |";

const FILES: &str = "
What each of them holds, in bytes of code on thumbv7m at opt-level 3, by the module of the library that an instruction
was written for, wherever it was inlined: the innermost one, when code of Rust's own library was inlined there. The
rest is the compiler's routines and the firmware's own. CI fails if an image holds a byte that it has no use for: a
wireframe of triangles, planes, depth and `shade`; flat faces of smooth shades and dither; those without depth of depth;
and if the last image does not hold all of these, for then the check would be blind.

| bytes of |";

pub(crate) fn text(compiler: &str, speed: &Speed, flash: &Flash) -> String {
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
    text += FLASH;
    for build in BUILDS {
        let core = build.target.trim_end_matches("-none-eabi");
        let _ = write!(text, " {core}, {} |", build.level);
    }
    let _ = writeln!(text, "\n|---|{}", "--:|".repeat(BUILDS.len()));
    for image in IMAGES {
        let _ = write!(text, "| {} |", image.says);
        for build in BUILDS {
            let bytes = flash.sizes.get(&(image.name, build)).copied();
            let _ = write!(text, " {} |", bytes.map_or("–".into(), grouped));
        }
        text.push('\n');
    }
    text += FILES;
    for image in IMAGES {
        let _ = write!(text, " {} |", image.says);
    }
    let _ = writeln!(text, "\n|---|{}", "--:|".repeat(IMAGES.len()));
    for module in MODULES {
        let _ = write!(text, "| `{}` |", module.trim_end_matches('/'));
        for image in IMAGES {
            let bytes = flash.code.get(image.name).map(|code| code.of_file(module));
            let _ = write!(text, " {} |", bytes.map_or("–".into(), grouped));
        }
        text.push('\n');
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

const MODULES: &[&str] = &[
    "math/",
    "raster/line.rs",
    "raster/edge.rs",
    "raster/triangle.rs",
    "raster/plane.rs",
    "raster/",
    "scene/",
    "camera/",
    "clip.rs",
    "shade/",
    "output/",
    "render/",
];

/// 1234567 as 1 234 567.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(THIN);
        }
        text.push(digit);
    }
    text
}

/// What a number of bytes may differ by where 2 % are less: little functions come and go.
const BYTES: f64 = 64.0;

/// The same words, and numbers within 2 %.
pub(crate) fn compare(old: &str, new: &str, compiler: &str, failures: &mut Vec<String>) {
    if !old.contains(&format!("{BUILT}{compiler}.")) {
        println!("The page is another compiler's: nothing is compared with it.");
        return;
    }
    if old.lines().count() != new.lines().count() {
        failures.push(format!("{}: not current, it has other lines: tools/bench/run", crate::PAGE));
        return;
    }
    for (old, new) in old.lines().zip(new.lines()) {
        if !alike(old, new) {
            failures.push(format!("{}: not current:\n  is   {old}\n  now  {new}", crate::PAGE));
        }
    }
}

fn alike(old: &str, new: &str) -> bool {
    let words = |line: &str| -> Vec<String> { line.split(' ').map(str::to_string).collect() };
    let (old, new) = (words(old), words(new));
    let number = |word: &str| word.replace(THIN, "").parse::<f64>().ok();
    old.len() == new.len()
        && old.iter().zip(&new).all(|(old, new)| match (number(old), number(new)) {
            (Some(o), Some(n)) => {
                let whole = !old.contains('.');
                (n - o).abs() <= (0.02 * o.abs()).max(if whole { BYTES } else { 0.0 })
            }
            _ => old == new,
        })
}
