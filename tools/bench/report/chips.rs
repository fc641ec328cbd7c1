//! Frames on chips that users have: the cycles of an instruction, with the waits for their flash, and the time of the display's bus.
//! `docs/data/chips.json` has what their data sheets say, and their rules.

use crate::core::emulated;
use crate::data::{self, row, Row};
use crate::esp32c3;
use crate::record::{self, Frames, APART};
use crate::side_by_side::side_by_side;
use crate::timing::flash::{Flash, FlashRules};
use crate::timing::pipeline::Pipeline;
use crate::{provenance, Result};
use bench::scene::SIZE;
use bench::timed::{Memory, Variant, IMAGES, TIMED};
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
pub(crate) fn chips() -> Result<Vec<(Chip, Row)>> {
    let rows = data::read("chips")?.into_iter().filter(|row| row.contains_key("pipeline"));
    rows.map(|row| Ok((serde_json::from_value(Value::Object(row.clone()))?, row))).collect()
}

/// A frame of [`TIMED`] on a chip.
struct ChipFrame {
    /// The numbers of the chip and of the frame.
    chip: usize,
    timed: usize,
    /// The rows of a band; `None` for a whole picture.
    rows: Option<u32>,
    instructions: u64,
    /// Cycles with waits, the waits among them, and cycles without.
    cycles: u64,
    waited: u64,
    ideal: u64,
    /// Cycles until each band is drawn, from the band before on.
    bands: Vec<u64>,
}

/// The kinds of frames whose cycles per instruction are stated: lines, faces, faces with depth.
const KINDS: [Variant; 3] = [Variant::Wireframe, Variant::Plain, Variant::Depth];

/// The rows of the chips, with the cycles of an instruction in frames in bands.
pub(crate) fn cycles(failures: &mut Vec<String>) -> Result<Vec<Row>> {
    let chips = chips()?;
    let frames = measure(&chips, failures)?;
    let mut rows = Vec::new();
    for (at, (_, mut row)) in chips.into_iter().enumerate() {
        let per_instruction = |cycles: fn(&ChipFrame) -> u64| {
            KINDS.map(|kind| {
                let is_one = |frame: &&ChipFrame| {
                    frame.chip == at && frame.rows.is_some() && TIMED[frame.timed].variant == kind
                };
                let these = frames.iter().filter(is_one);
                let (sum, all) =
                    these.fold((0, 0), |(sum, all), frame| (sum + cycles(frame), all + frame.instructions));
                rounded(sum as f64 / all as f64)
            })
        };
        row.insert("cycles".into(), json!(per_instruction(|frame| frame.cycles)));
        row.insert("cycles_without_waits".into(), json!(per_instruction(|frame| frame.ideal)));
        rows.push(row);
    }
    rows.extend(esp32c3::rows()?);
    Ok(rows)
}

pub(crate) fn rounded(figure: f64) -> f64 {
    (figure * 100.0).round() / 100.0
}

/// A row for each frame on each chip: drawing in milliseconds, the part of it that waits for flash in percent, and frames a second
/// over the fastest SPI, if each band is sent before the next is drawn, and if DMA sends it meanwhile.
pub(crate) fn frames(failures: &mut Vec<String>) -> Result<Vec<Row>> {
    let chips = chips()?;
    let frames = measure(&chips, failures)?;
    let fitting = frames.iter().filter(|frame| frame.fits(&chips[frame.chip].0, false));
    let row_of = |frame: &ChipFrame| {
        let (chip, _) = &chips[frame.chip];
        let tenths = |figure: f64| (figure * 10.0).round() / 10.0;
        let overlapped = frame.fits(chip, true).then(|| tenths(1000.0 / frame.overlapped(chip)));
        row([
            ("chip", json!(chip.chip)),
            ("scene", json!(TIMED[frame.timed].scene)),
            ("variant", json!(TIMED[frame.timed].variant.name())),
            ("rows", json!(frame.rows.unwrap_or(SIZE))),
            ("drawing_ms", json!(tenths(frame.milliseconds(frame.cycles, chip)))),
            ("waits_percent", json!((100.0 * frame.waited as f64 / frame.cycles as f64).round())),
            ("fps_blocking", json!(tenths(1000.0 / frame.one_after_the_other(chip)))),
            ("fps_dma", json!(overlapped)),
        ])
    };
    Ok(fitting.map(row_of).collect())
}

/// Bytes of commands that set a window, as docs/wire.md counts them.
const WINDOW: u32 = 11;
/// RAM for vertices, bins, variables and the stack, and for code and mesh where they are in RAM: in bytes, enough for S3 with depth.
const REST: u32 = 8 << 10;
const CODE: u32 = 40 << 10;

impl ChipFrame {
    fn milliseconds(&self, cycles: u64, chip: &Chip) -> f64 {
        cycles as f64 / chip.mhz / 1000.0
    }

    fn height(&self) -> u32 {
        self.rows.unwrap_or(SIZE)
    }

    /// Milliseconds that the bus takes for a band.
    fn sending(&self, chip: &Chip) -> f64 {
        f64::from(8 * (2 * SIZE * self.height() + WINDOW)) / chip.spi_mhz / 1000.0
    }

    fn one_after_the_other(&self, chip: &Chip) -> f64 {
        let bands = f64::from(SIZE.div_ceil(self.height()));
        self.milliseconds(self.cycles, chip) + bands * self.sending(chip)
    }

    /// The time from frame to frame, once it repeats, if one of two strips (or pictures) is sent by DMA while the other is drawn.
    fn overlapped(&self, chip: &Chip) -> f64 {
        let send = self.sending(chip);
        let (mut drawn, mut sent, mut sent_before, mut ends) = (0.0_f64, 0.0_f64, 0.0_f64, Vec::new());
        // The first frames start with an idle bus; after a few the delay repeats.
        for _ in 0..8 {
            for band in &self.bands {
                // A strip is free when its last content, two bands ago, has been sent.
                drawn = drawn.max(sent_before) + self.milliseconds(*band, chip);
                sent_before = sent;
                sent = drawn.max(sent) + send;
            }
            ends.push(sent);
        }
        ends[7] - ends[6]
    }

    /// Whether the chip has the RAM for the pixels and depths of a frame, twice the pixels if `double`.
    fn fits(&self, chip: &Chip, double: bool) -> bool {
        let strip = 2 * SIZE * self.height();
        let depth = u32::from(TIMED[self.timed].variant == Variant::Depth);
        let code = if chip.flash.is_none() { CODE } else { 0 };
        strip * (1 + u32::from(double) + depth) + REST + code <= chip.ram_kb << 10
    }
}

/// Whether a chip draws in bands of this many rows, or has the RAM for a whole picture.
fn is_drawn(chip: &Chip, rows: Option<u32>) -> bool {
    match rows {
        Some(rows) => rows == chip.rows,
        None => 2 * SIZE * SIZE < chip.ram_kb << 10,
    }
}

/// Builds, runs and times the images of [`IMAGES`].
fn measure(chips: &[(Chip, Row)], failures: &mut Vec<String>) -> Result<Vec<ChipFrame>> {
    let mut runs: Vec<(&str, usize)> = Vec::new();
    for (chip, _) in chips {
        let drawn = (0..IMAGES.len()).filter(|&at| is_drawn(chip, IMAGES[at].1));
        runs.extend(drawn.map(|at| (chip.image.as_str(), at)));
    }
    runs.sort();
    runs.dedup();
    for core in ["M0", "M3", "M4F"] {
        let of_core = runs.iter().filter(|run| run.0 == core);
        let bins: Vec<String> = of_core.map(|run| format!("--bin={}", IMAGES[run.1].0)).collect();
        emulated(core)?.build().cargo("build", &bins)?;
    }
    let recorded = side_by_side(&runs, |&(core, image)| record(core, image))?;
    let mut frames = Vec::new();
    for (&(core, image), (recorded, printed, mark)) in runs.iter().zip(&recorded) {
        let rows = IMAGES[image].1;
        compare(image, recorded, printed, failures)?;
        for (at, (chip, _)) in chips.iter().enumerate() {
            if chip.image == core && is_drawn(chip, rows) {
                for timed in 0..TIMED.len() {
                    frames.push(ChipFrame { chip: at, rows, ..time(chip, timed, recorded, *mark)? });
                }
            }
        }
    }
    frames.sort_by_key(|frame| (frame.chip, frame.rows.is_none(), frame.timed));
    Ok(frames)
}

/// Runs an image and returns its recorded frames, its output, and the address of the function that takes the pixels.
fn record(core: &str, image: usize) -> Result<(Frames, String, u32)> {
    let core = emulated(core)?;
    let path = core.build().image(IMAGES[image].0);
    let places = provenance::frames(&path)?;
    let takes = if IMAGES[image].1.is_some() { "take_bytes" } else { "take_pixels" };
    let mark = record::function(&path, &places, |name| name.ends_with(takes))?.start;
    Ok((record::record(core, &path, &places, TIMED.len())?, core.run(&path)?, mark))
}

/// Fails if the clock counted something else than was recorded, or if the picture is not the host's.
fn compare(image: usize, recorded: &Frames, printed: &str, failures: &mut Vec<String>) -> Result<()> {
    let ((name, rows), mut memory) = (IMAGES[image], Box::new(Memory::NEW));
    let lines: Vec<&str> = printed.lines().collect();
    let (counts, checksums) = lines.split_at_checked(TIMED.len()).ok_or("a line for each frame")?;
    for (at, (timed, frame)) in TIMED.iter().zip(&recorded.frames).enumerate() {
        let (instructions, crc) = (counts[at], checksums.get(at).copied().unwrap_or_default());
        let length = frame.run.len() as u64;
        if instructions.parse::<u64>()?.abs_diff(length) > APART {
            failures.push(format!("{name}, {}: {instructions} counted, {length} recorded", timed.scene));
        }
        let host = timed.checksum(rows, &mut memory);
        if host != u32::from_str_radix(crc, 16).ok() {
            failures.push(format!("{name}, {}: not the host's picture, which is {host:08x?}", timed.scene));
        }
    }
    Ok(())
}

/// Times a frame that follows another one of its kind, so that caches are warm.
fn time(chip: &Chip, timed: usize, Frames { program, frames }: &Frames, mark: u32) -> Result<ChipFrame> {
    let frame = frames.get(timed).ok_or("a frame is missing")?;
    let mut flash = chip.flash.map(Flash::new);
    let pass =
        |flash: Option<&mut Flash>| program.cycles(&frame.run, frame.end, chip.pipeline, flash, Some(mark));
    let ideal = pass(None).cycles;
    pass(flash.as_mut());
    let taken = pass(flash.as_mut());
    // The cycles after the last band belong to the first band of the next frame.
    let first = taken.marks.first().copied().unwrap_or_default();
    let last = taken.marks.last().copied().unwrap_or_default();
    let between = taken.marks.windows(2).map(|pair| pair[1] - pair[0]);
    let bands = [first + taken.cycles - last].into_iter().chain(between).collect();
    let (cycles, waited, instructions) = (taken.cycles, taken.waited, frame.run.len() as u64);
    Ok(ChipFrame { chip: 0, timed, rows: None, instructions, cycles, waited, ideal, bands })
}
