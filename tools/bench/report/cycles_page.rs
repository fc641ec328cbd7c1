//! The sections on time of `docs/speed.md` and `docs/growth.md`.

use crate::chips::{buffers, one_after_the_other, overlapped, ChipFrame, CHIPS};
use crate::cycles::{CellCycles, TIMED_CORES};
use crate::esp32c3::Sum;
use crate::grouped::grouped;
use bench::timed::{Variant, TIMED};
use std::fmt::Write;

const CYCLES: &str = "
## Cycles

The cells in cycles, with cycles per instruction in brackets, for cores whose memory answers without wait states. Each instruction of the
frame is recorded and timed by the tables of Arm's manuals (M0: DDI 0432, M0+: DDI 0484, M3: DDI 0337, M4: DDI 0439). The M0+ runs the
images of the M0, the M4 and M33 run those of the M4F. `tools/bench/run cycles S3 M3` measures some cells and prints a line for each:
`scene,variant,core,instructions,cycles,cycles per instruction`.

**Error.** Compared with published measurements of cryptographic code on chips, M0 and M0+ are within 1 %; an M3 or M4 takes 0 to 4 % more
cycles than stated here, 12 % at worst. `tools/bench/run validate` compares again with P-256 code on an nRF52840 (Lenngren's, by the crate
p256-cm4): −2 to +1 %. The other code was not found in the package registries. Arm publishes no table for the M33: its rules are a guess with an
error of 15 %, and an image built for thumbv8m.main would differ.

**Not modelled.** Divisions and the M3's long products end early for small operands (taken: 7 cycles for a division, 5 for a product, 7 for one
that adds). Skipped instructions of an IT block count as executed. A Cortex-M0 or M0+ with the small multiplier takes 32 cycles for a product
in place of 1. Wait states and other users of the bus come on top: [below](#frames-per-second).

| scene | | M0 | M0+ | M3 | M4 | M33 |
|---|---|--:|--:|--:|--:|--:|
";

const CHIPS_HEAD: &str = "
## Frames per second

On a display of 240 × 240 pixels of 16 bits. In each frame the object is placed before the camera, the picture and the depth buffer are
cleared, and the scene is drawn and sent: in bands (`bin_faces`, `Band::pixels`), or *whole* from a picture in RAM (`Picture::pixels`). The
scenes are those above, without planes, at opt-level 3; camera and light are set up before. `tools/bench/run chips` prints these
tables.

| chip | core | clock, MHz | flash | fastest SPI, MHz | RAM, KB | error of the drawing time |
|---|---|--:|---|--:|--:|---|
";

const CHIPS_TEXT: &str = "
*Drawing* is the time of the core, *waits* the part of it that is spent waiting for flash, with caches as the previous frame left them. The
columns of the bus have frames per second: if each band is sent before the next is drawn / if DMA sends one strip or picture while
the next is drawn; and which takes longer, drawing (*CPU*) or sending (*bus*). A band that takes long to draw lets the bus idle, so a
frame in bands can take longer than both. A – means that RAM does not hold two pictures; where it does not hold one, there is no line. An
SPI clock beyond the chip's own is in *italics*: a parallel interface can be as fast.

**What comes on top.** The bus sends without gaps here, with 11 bytes of commands for each band; a driver that waits for each byte takes several times
as long. For another clock, multiply the cycles without wait states ([growth.md](growth.md#cycles-per-instruction)) and add waits: they
grow with the wait states. DMA takes one cycle of the RAM for each transfer: at 40 MHz SPI and 125 MHz that is one cycle in 25 by bytes, one in 50
by half-words, and the core waits if it uses the same bank of RAM then. Interrupts and other tasks are not included.

| chip | scene | sent | drawing, ms | waits | fastest SPI | 40 MHz | 62.5 MHz |
|---|---|---|--:|--:|--:|--:|--:|
";

/// The cells' cycles, for `docs/speed.md`.
pub(crate) fn cycles(cells: &[CellCycles]) -> String {
    let mut text = CYCLES.to_string();
    let mut rows: Vec<(&str, &str)> = Vec::new();
    for cell in cells {
        let row = (cell.scene, cell.variant.as_str());
        if !rows.contains(&row) {
            rows.push(row);
        }
    }
    for (scene, variant) in rows {
        let _ = write!(text, "| {scene} | {} |", crate::speed_page::shown(variant));
        for core in TIMED_CORES {
            let same =
                |cell: &&CellCycles| (cell.scene, cell.variant.as_str(), cell.core) == (scene, variant, core);
            let _ = match cells.iter().find(same) {
                Some(cell) => write!(text, " {} ({:.2}) |", grouped(cell.cycles), cell.per_instruction()),
                None => write!(text, " – |"),
            };
        }
        text.push('\n');
    }
    text
}

/// The frames per second of chips, for `docs/speed.md`.
pub(crate) fn frames_per_second(frames: &[ChipFrame]) -> String {
    let mut text = CHIPS_HEAD.to_string();
    for chip in &CHIPS {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} |",
            chip.name,
            chip.core,
            chip.mhz,
            chip.flash_says,
            chip.spi_mhz,
            chip.ram >> 10,
            chip.error
        );
    }
    text += CHIPS_TEXT;
    for frame in frames.iter().filter(|frame| fits(frame, false)) {
        let _ = write!(
            text,
            "| {} | {} | {} | {:.1} | {:.0} % |",
            frame.chip.name,
            named(frame.timed),
            frame.rows.map_or("whole".into(), |rows| format!("bands of {rows} rows")),
            frame.drawing(),
            100.0 * frame.waited as f64 / frame.cycles as f64,
        );
        for bus in [None, Some(40.0), Some(62.5)] {
            let own = frame.chip.spi_mhz;
            let _ = match bus {
                Some(mhz) if mhz > own => write!(text, " *{}* |", rates(frame, mhz)),
                _ => write!(text, " {} |", rates(frame, bus.unwrap_or(own))),
            };
        }
        text.push('\n');
    }
    text
}

/// RAM for vertices, bins, variables and the stack, and for code and mesh where they are in RAM: in bytes, enough for S3 with depth.
const REST: u32 = 8 << 10;
const CODE: u32 = 40 << 10;

fn fits(frame: &ChipFrame, double: bool) -> bool {
    let code = if frame.chip.flash.is_none() { CODE } else { 0 };
    buffers(frame, double) + REST + code <= frame.chip.ram
}

/// Frames per second without and with overlap, and what limits the latter, or the former if there is no RAM for two.
fn rates(frame: &ChipFrame, mhz: f64) -> String {
    let apart = one_after_the_other(frame, mhz);
    let limit = if frame.drawing() >= apart - frame.drawing() { "CPU" } else { "bus" };
    match fits(frame, true) {
        true => format!("{:.1} / {:.1} {limit}", 1000.0 / apart, 1000.0 / overlapped(frame, mhz)),
        false => format!("{:.1} / – {limit}", 1000.0 / apart),
    }
}

fn named(timed: usize) -> String {
    let of = &TIMED[timed];
    match of.variant {
        Variant::Wireframe => format!("{}, wireframe", of.scene),
        Variant::Plain => of.scene.to_string(),
        Variant::Depth => format!("{} z", of.scene),
    }
}

const PER_INSTRUCTION: &str = "
## Cycles per instruction

Measured on frames in bands, clears included: S1 for lines, S2 and S3 for faces. The clocks, wait states and errors of the chips are in
[speed.md](speed.md#frames-per-second); the errors add to those of the formula. For a chip that is not listed, start from its core
without wait states.

The ESP32-C3 has a range, from the least to the most that is known of it. Loops that were measured on the chip (timonvo/niccle) give one cycle for
arithmetic, 2 for a jump and for a load whose result is used at once, 3 for a branch that is taken. With them the maker's CoreMark, 390 960 cycles a
round from RAM, takes 390 900. Products of two words, divisions and several stores in a row were not measured: they make up most of the range. In flash a
line that its cache of 16 KB lacks takes 168 to 608 cycles, likely 347, by how the flash is wired.

| | lines | faces | faces with depth |
|---|--:|--:|--:|
";

/// Cycles per instruction of chips, and of their cores without wait states, for `docs/growth.md`.
pub(crate) fn per_instruction(frames: &[ChipFrame], esp32c3: &[Sum; 3]) -> String {
    let (mut text, mut cores) = (PER_INSTRUCTION.to_string(), Vec::new());
    for chip in &CHIPS {
        let mut line = |name: &str, cycles: fn(&ChipFrame) -> u64| {
            let _ = write!(text, "| {name} |");
            for variant in [Variant::Wireframe, Variant::Plain, Variant::Depth] {
                let these = frames.iter().filter(|frame| {
                    std::ptr::eq(frame.chip, chip)
                        && frame.rows.is_some()
                        && TIMED[frame.timed].variant == variant
                });
                let (sum, all) =
                    these.fold((0, 0), |(sum, all), frame| (sum + cycles(frame), all + frame.instructions));
                let _ = write!(text, " {:.2} |", sum as f64 / all as f64);
            }
            text.push('\n');
        };
        if !cores.contains(&chip.core) {
            cores.push(chip.core);
            line(&format!("{}, no wait states", chip.core), |frame| frame.ideal);
        }
        if chip.flash.is_some() {
            line(&format!("{}, {} MHz", chip.name, chip.mhz), |frame| frame.cycles);
        }
    }
    type Of = fn(&Sum) -> [f64; 3];
    let rows: [(&str, Of); 2] = [
        ("ESP32-C3, code in RAM, 160 MHz", Sum::in_ram),
        ("ESP32-C3, code in flash, 160 MHz", Sum::in_flash),
    ];
    for (name, of) in rows {
        let _ = write!(text, "| {name} |");
        for [least, likely, most] in esp32c3.iter().map(of) {
            let _ = write!(text, " {likely:.2} ({least:.2}–{most:.2}) |");
        }
        text.push('\n');
    }
    text
}
