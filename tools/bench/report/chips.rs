//! Frames on chips that users have: the cycles of an instruction, with the waits for their flash, and the time of the display's bus.
//! `docs/data/chips.json` has what their data sheets say, and their rules.

use crate::core::CORES;
use crate::cycles::recorded;
use crate::data;
use crate::record::Frame;
use crate::timing::flash::{DataCache, Flash, FlashRules};
use crate::timing::pipeline::Pipeline;
use crate::timing::riscv::Rules;
use crate::{Result, RV32};
use bench::scene::SIZE;
use serde::Deserialize;
use serde_json::{json, Value};

/// A chip, as it is commonly clocked.
#[derive(Deserialize)]
pub(crate) struct Chip {
    pub(crate) chip: String,
    /// The core whose images the chip runs.
    pub(crate) image: String,
    pub(crate) pipeline: Pipeline,
    mhz: f64,
    /// `None`: the code and the mesh are in RAM.
    pub(crate) flash: Option<FlashRules>,
    /// The fastest clock of its SPI.
    spi_mhz: f64,
    ram_kb: u32,
    /// The rows of a band.
    rows: u32,
}

/// The chips, and their rows in the file.
pub(crate) fn chips() -> Result<Vec<(Chip, Value)>> {
    let rows = data::read("chips")?.into_iter().filter(|row| !row["pipeline"].is_null());
    rows.map(|row| Ok((serde_json::from_value(row.clone())?, row))).collect()
}

/// The scenes that each chip draws: in bands and, where the chip has the RAM, in one piece.
const SCENES: [&str; 3] = ["S1", "S2", "S3"];
/// The kinds of frames whose cycles per instruction are stated: lines (S1), faces, faces with depth.
const KINDS: [&str; 3] = ["wire", "plain", "z"];

/// The number in [`KINDS`], and the rows of a band, of a cell.
fn kind(scene: &str, variant: &str) -> (usize, u32) {
    let (pieces, depth) = match variant.strip_suffix("-z") {
        Some(pieces) => (pieces, 2),
        None => (variant, usize::from(scene != "S1")),
    };
    (depth, pieces.strip_prefix("bands").and_then(|rows| rows.parse().ok()).unwrap_or(SIZE))
}

/// A frame on a chip.
struct ChipFrame {
    scene: &'static str,
    kind: usize,
    /// The rows of a band.
    rows: u32,
    instructions: u64,
    /// Cycles with waits, the waits among them, and cycles without.
    cycles: u64,
    waited: u64,
    ideal: u64,
    /// Cycles until each band is drawn, from the band before on.
    bands: Vec<u64>,
}

/// The rows of the chips, with the cycles of an instruction in frames in bands; and a row for each frame on each chip: drawing in
/// milliseconds, the part of it that waits for flash in percent, and frames a second over the fastest SPI, if each band is sent before
/// the next is drawn, and if DMA sends it meanwhile.
pub(crate) fn rows(failures: &mut Vec<String>) -> Result<[Vec<Value>; 2]> {
    let (mut of_chips, mut of_frames) = (Vec::new(), Vec::new());
    let chips = chips()?;
    for core in CORES {
        let on_core = || chips.iter().filter(|(chip, _)| chip.image == core.name);
        let mut pieces: Vec<String> = on_core().map(|(chip, _)| format!("bands{}", chip.rows)).collect();
        if on_core().any(|(chip, _)| chip.draws(SIZE)) {
            pieces.push("full".into());
        }
        if core.target == RV32 {
            pieces.push("bands16".into());
        }
        let with_depth: Vec<String> = pieces.iter().map(|piece| format!("{piece}-z")).collect();
        let variants = pieces.iter().chain(&with_depth).map(String::as_str);
        let names: Vec<&str> = SCENES.into_iter().chain(variants).chain([core.name]).collect();
        let recorded = recorded(&names, failures)?;
        if core.target == RV32 {
            let mut kinds = [Estimate::default(); 3];
            recorded.iter().for_each(|(cell, frame)| kinds[kind(cell.scene, &cell.variant).0].add(frame));
            of_chips.extend(esp32c3(kinds));
        }
        for (chip, row) in on_core() {
            let timed = recorded.iter().map(|(cell, frame)| {
                let (kind, rows) = kind(cell.scene, &cell.variant);
                (chip.draws(rows)).then(|| ChipFrame::new(chip, cell.scene, kind, rows, frame))
            });
            let frames: Vec<ChipFrame> = timed.flatten().collect();
            let per_instruction = |cycles: fn(&ChipFrame) -> u64| {
                [0, 1, 2].map(|kind| {
                    let these = frames.iter().filter(|frame| frame.kind == kind && frame.rows != SIZE);
                    let (sum, all) = these
                        .fold((0, 0), |(sum, all), frame| (sum + cycles(frame), all + frame.instructions));
                    rounded(sum as f64 / all as f64)
                })
            };
            let mut row = row.clone();
            row["cycles"] = json!(per_instruction(|frame| frame.cycles));
            row["cycles_without_waits"] = json!(per_instruction(|frame| frame.ideal));
            of_chips.push(row);
            let fitting = frames.iter().filter(|frame| frame.fits(chip, false));
            of_frames.extend(fitting.map(|frame| frame.row(chip)));
        }
    }
    Ok([of_chips, of_frames])
}

pub(crate) fn rounded(figure: f64) -> f64 {
    (figure * 100.0).round() / 100.0
}

/// Bytes of commands that set a window, as docs/wire.md counts them.
const WINDOW: u32 = 11;
/// RAM for vertices, bins, variables and the stack, and for code and mesh where they are in RAM: in bytes, enough for S3 with depth.
const REST: u32 = 8 << 10;
const CODE: u32 = 40 << 10;

impl Chip {
    /// Whether it draws in bands of this many rows, or has the RAM for a whole picture.
    fn draws(&self, rows: u32) -> bool {
        rows == self.rows || rows == SIZE && 2 * SIZE * SIZE < self.ram_kb << 10
    }

    fn milliseconds(&self, cycles: u64) -> f64 {
        cycles as f64 / self.mhz / 1000.0
    }
}

impl ChipFrame {
    fn new(chip: &Chip, scene: &'static str, kind: usize, rows: u32, frame: &Frame) -> Self {
        let (ideal, taken) = (frame.cycles(chip.pipeline, None), frame.cycles(chip.pipeline, chip.flash));
        // The cycles after the last band belong to the first band of the next frame.
        let first = taken.marks.first().copied().unwrap_or_default();
        let last = taken.marks.last().copied().unwrap_or_default();
        let between = taken.marks.windows(2).map(|pair| pair[1] - pair[0]);
        let bands = [first + taken.cycles - last].into_iter().chain(between).collect();
        let (cycles, waited, instructions) = (taken.cycles, taken.waited, frame.run.len() as u64);
        Self { scene, kind, rows, instructions, cycles, waited, ideal: ideal.cycles, bands }
    }

    fn row(&self, chip: &Chip) -> Value {
        let tenths = |figure: f64| (figure * 10.0).round() / 10.0;
        let (drawing, bands) = (chip.milliseconds(self.cycles), f64::from(SIZE.div_ceil(self.rows)));
        let overlapped = self.fits(chip, true).then(|| tenths(1000.0 / self.overlapped(chip)));
        let waits = (100.0 * self.waited as f64 / self.cycles as f64).round();
        let blocking = tenths(1000.0 / (drawing + bands * self.sending(chip)));
        json!({"chip": chip.chip, "scene": self.scene, "variant": KINDS[self.kind], "rows": self.rows,
            "drawing_ms": tenths(drawing), "waits_percent": waits, "fps_blocking": blocking, "fps_dma": overlapped})
    }

    /// Milliseconds that the bus takes for a band.
    fn sending(&self, chip: &Chip) -> f64 {
        f64::from(8 * (2 * SIZE * self.rows + WINDOW)) / chip.spi_mhz / 1000.0
    }

    /// The time from frame to frame, once it repeats, if one of two strips (or pictures) is sent by DMA while the other is drawn.
    fn overlapped(&self, chip: &Chip) -> f64 {
        let send = self.sending(chip);
        let (mut drawn, mut sent, mut sent_before, mut ends) = (0.0_f64, 0.0_f64, 0.0_f64, Vec::new());
        // The first frames start with an idle bus; after a few the delay repeats.
        for _ in 0..8 {
            for band in &self.bands {
                // A strip is free when its last content, two bands ago, has been sent.
                drawn = drawn.max(sent_before) + chip.milliseconds(*band);
                sent_before = sent;
                sent = drawn.max(sent) + send;
            }
            ends.push(sent);
        }
        ends[7] - ends[6]
    }

    /// Whether the chip has the RAM for the pixels and depths of a frame, twice the pixels if `double`.
    fn fits(&self, chip: &Chip, double: bool) -> bool {
        let strips = 1 + u32::from(double) + u32::from(self.kind == 2);
        let code = if chip.flash.is_none() { CODE } else { 0 };
        2 * SIZE * self.rows * strips + REST + code <= chip.ram_kb << 10
    }
}

/// Code and constants of an ESP32-C3 in flash: a read-only cache of 16 KB, 8 ways, lines of 32 bytes (data sheet, section 3.1.5). Only
/// the number of its waits is used.
const FLASH: FlashRules =
    FlashRules { wait: 1, line: 32, prefetch: false, lines: 512, ways: 8, data: DataCache::Shared };

/// Cycles of a line, for [`Rules::Least`], [`Rules::Likely`] and [`Rules::Most`]: 84 clocks of 80 MHz by four wires; a load that
/// misses, measured on an ESP32-C6 (LLTA-Bench, as in `timing/riscv.rs`); and 152 clocks of 40 MHz by two wires.
const MISS: [u64; 3] = [168, 347, 608];

/// The sum of frames on an ESP32-C3, with cycles by [`Rules::Least`], [`Rules::Likely`] and [`Rules::Most`].
#[derive(Clone, Copy, Default)]
pub(crate) struct Estimate {
    instructions: u64,
    in_ram: [u64; 3],
    /// Lines of code and mesh that the cache lacks.
    misses: u64,
}

impl Estimate {
    /// Cycles with code and mesh in flash: least, likely, most.
    pub(crate) fn in_flash(&self) -> [u64; 3] {
        [0, 1, 2].map(|at| self.in_ram[at] + self.misses * MISS[at])
    }

    pub(crate) fn add(&mut self, frame: &Frame) {
        self.instructions += frame.run.len() as u64;
        for (cycles, rules) in self.in_ram.iter_mut().zip([Rules::Least, Rules::Likely, Rules::Most]) {
            *cycles += rules.cycles(frame);
        }
        // The lines that a frame behind another one misses: of its code, and of the constants, each once, as both together exceed the cache.
        let mut flash = Flash::new(FLASH);
        let mut pass = || -> u64 { frame.run.iter().map(|executed| flash.fetch(executed.at, 2, 0)).sum() };
        pass();
        self.misses += pass() + frame.constants.div_ceil(FLASH.line.into());
    }
}

/// The rows of an ESP32-C3: the cycles of an instruction in lines, faces, and faces with depth.
fn esp32c3(kinds: [Estimate; 3]) -> [Value; 2] {
    let row_of = |chip: &str, cycles: fn(&Estimate) -> [u64; 3]| {
        let [least, likely, most] = [0, 1, 2]
            .map(|at| json!(kinds.map(|sum| rounded(cycles(&sum)[at] as f64 / sum.instructions as f64))));
        json!({"chip": chip, "core": "RV32", "mhz": 160, "cycles": likely, "least": least, "most": most})
    };
    [row_of("ESP32-C3, code in RAM", |sum| sum.in_ram), row_of("ESP32-C3, code in flash", Estimate::in_flash)]
}
