//! The sections on time of `docs/speed.md` and `docs/growth.md`.

use crate::chips::{buffers, one_after_the_other, overlapped, ChipFrame, CHIPS};
use crate::cycles::{CellCycles, TIMED_CORES};
use crate::grouped::grouped;
use bench::timed::{Variant, TIMED};
use std::fmt::Write;

const CYCLES: &str = "
## Cycles

The cells once more, in cycles of a core whose memory answers without waiting, and in brackets the cycles per instruction. Every
instruction of the frame is recorded and timed by the tables of Arm's manuals (M0: DDI 0432, M0+: DDI 0484, M3: DDI 0337, M4:
DDI 0439). The M0+ runs the M0's images, the M4 and the M33 those of the M4F. `tools/bench/run cycles S3 M3` prints a line
`scene,variant,core,instructions,cycles,cycles per instruction` for each.

Error, against published measurements of elliptic-curve and AES code on chips: M0 and M0+ within 1 %. M3 and M4: the chip takes 0 to 4 %
more, 12 % at worst. The M33 has no published table; its rules are a guess, good for 15 %, and its own instructions (thumbv8m.main) are
not used. M0 and M0+ are those with the multiplier of one cycle; one of 32 cycles is in none of the chips below. Not modelled:
divisions and long products that end early on the M3 (taken: 7 cycles, 5 and 7), instructions in an IT block that are
skipped (taken: their time), wait states, and anything else on the bus.

| scene | | M0 | M0+ | M3 | M4 | M33 |
|---|---|--:|--:|--:|--:|--:|
";

const CHIPS_HEAD: &str = "
## Frames per second

What a user gets on a display of 240 × 240 pixels of 16 bits. A frame: the object is placed before the camera, the picture (and the
depth) cleared, everything drawn and sent: in bands, or *whole* from a picture in RAM. By `bin_faces` and `Band::pixels`, or by
`Picture::pixels`, without planes, opt-level 3; camera and light are set up before. The scenes are those above.

| chip | core | clock, MHz | flash | SPI at most, MHz | RAM, KB | error of the drawing time |
|---|---|--:|---|--:|--:|---|
";

const CHIPS_TEXT: &str = "
*Drawing* is the time of the core alone. *Waits* is the part of it that the core waits for flash, with caches that the frame before has
filled. For each clock of the bus: frames per second if each band is sent before the next one is drawn / if DMA sends one strip (or picture)
while the next one is drawn, and which of the two, *CPU* or *bus*, takes longer. Bands differ: where one takes long to draw, the bus
idles, so that a frame may take longer than either alone. The bus is taken to send without gaps, with 11 bytes of
commands a band; a driver that waits for every byte is much slower. A clock beyond the chip's own SPI stands in *italics*: it shows what
a faster interface would give. – : two pictures do not fit in RAM; a chip with too little RAM for one has no line.

Divide the drawing time by your clock if it is another, and take other wait states into account: the share of *waits* grows with
them. Code that runs from RAM has none. DMA takes a cycle of the RAM for each transfer, at 40 MHz SPI one in 25 at
125 MHz by bytes, half of that by halves; where core and DMA are in the same bank, the core waits for it. Interrupts, other tasks and the display's
own pace come on top.

| chip | scene | sent | drawing, ms | waits | own SPI | 40 MHz | 62.5 MHz |
|---|---|---|--:|--:|--:|--:|--:|
";

/// The cells' cycles, for `docs/speed.md`.
pub(crate) fn cycles(cells: &[CellCycles]) -> String {
    let mut text = CYCLES.to_string();
    let mut rows: Vec<(&str, &str)> = cells.iter().map(|cell| (cell.scene, cell.variant)).collect();
    rows.sort();
    rows.dedup();
    for (scene, variant) in rows {
        let _ = write!(text, "| {scene} | {} |", crate::speed_page::shown(variant));
        for core in TIMED_CORES {
            let same = |cell: &&CellCycles| (cell.scene, cell.variant, cell.core) == (scene, variant, core);
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

Of whole frames of S1 (lines), S2 and S3 in bands, clears included: the sum of cycles over that of instructions, by the tables and
with the clocks, flash and errors that [speed.md](speed.md#frames-per-second) states. A chip with another clock has other wait states: between its
line and that of its core without. Multiply the error of the formula with that of the chip.

| | lines | faces | faces with depth |
|---|--:|--:|--:|
";

/// Cycles per instruction of chips, and of their cores without wait states, for `docs/growth.md`.
pub(crate) fn per_instruction(frames: &[ChipFrame]) -> String {
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
    text
}
