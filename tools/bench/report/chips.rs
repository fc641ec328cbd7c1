//! Frames on chips that users have: the waits for their flash, and the time of the display's bus.

use crate::cycles::emulated;
use crate::registers::{self, Frames};
use crate::side_by_side::side_by_side;
use crate::timing::flash::{DataCache, Flash, FlashRules};
use crate::timing::pipeline::Pipeline;
use crate::{provenance, Result};
use bench::scene::SIZE;
use bench::timed::{Memory, IMAGES, TIMED};
use std::sync::OnceLock;

/// A chip, as it is commonly clocked.
pub(crate) struct Chip {
    pub(crate) name: &'static str,
    pub(crate) core: &'static str,
    pub(crate) pipeline: Pipeline,
    /// The core whose images the chip runs.
    pub(crate) image: &'static str,
    pub(crate) mhz: f64,
    /// `None`: the code and the mesh are in RAM.
    pub(crate) flash: Option<FlashRules>,
    /// The description of the flash on the page.
    pub(crate) flash_says: &'static str,
    /// The fastest clock of its SPI, by its data sheet.
    pub(crate) spi_mhz: f64,
    /// RAM in bytes.
    pub(crate) ram: u32,
    /// The rows of a band.
    pub(crate) rows: u32,
    pub(crate) error: &'static str,
}

const NO_CACHE: FlashRules =
    FlashRules { wait: 0, line: 8, prefetch: true, lines: 0, ways: 0, data: DataCache::None };

pub(crate) static CHIPS: [Chip; 7] = [
    Chip {
        name: "RP2040, code in RAM",
        core: "M0+",
        pipeline: Pipeline::M0Plus,
        image: "M0",
        mhz: 125.0,
        flash: None,
        flash_says: "code and mesh copied to RAM, no wait states",
        spi_mhz: 62.5,
        ram: 264 << 10,
        rows: 16,
        error: "1 %",
    },
    Chip {
        name: "RP2040, code in flash",
        core: "M0+",
        pipeline: Pipeline::M0Plus,
        image: "M0",
        mhz: 125.0,
        // 28 clocks of half the core's frequency, and what starts and ends a transfer.
        flash: Some(FlashRules {
            wait: 60,
            line: 8,
            prefetch: false,
            lines: 2048,
            ways: 2,
            data: DataCache::Shared,
        }),
        flash_says: "quad SPI at 62.5 MHz, 60 cycles a miss; cache of 16 KB, 2 ways, lines of 8 bytes",
        spi_mhz: 62.5,
        ram: 264 << 10,
        rows: 16,
        error: "1 %, and a fifth of the waiting",
    },
    Chip {
        name: "STM32F030xC",
        core: "M0",
        pipeline: Pipeline::M0,
        image: "M0",
        mhz: 48.0,
        flash: Some(FlashRules { wait: 1, ..NO_CACHE }),
        flash_says: "1 wait state, lines of 8 bytes, prefetch",
        spi_mhz: 18.0,
        ram: 32 << 10,
        rows: 8,
        error: "1 %, and the waiting is unproven",
    },
    Chip {
        name: "STM32F103xB",
        core: "M3",
        pipeline: Pipeline::M3,
        image: "M3",
        mhz: 72.0,
        flash: Some(FlashRules { wait: 2, ..NO_CACHE }),
        flash_says: "2 wait states, lines of 8 bytes, prefetch",
        spi_mhz: 18.0,
        ram: 20 << 10,
        rows: 8,
        error: "15 %: the waiting is unproven",
    },
    Chip {
        name: "STM32F411xE",
        core: "M4",
        pipeline: Pipeline::M4,
        image: "M4F",
        mhz: 100.0,
        flash: Some(FlashRules {
            wait: 3,
            line: 16,
            prefetch: true,
            lines: 64,
            ways: 64,
            data: DataCache::Own(8),
        }),
        flash_says: "3 wait states, lines of 16 bytes, prefetch; caches of 64 lines for code and 8 for data",
        spi_mhz: 50.0,
        ram: 128 << 10,
        rows: 16,
        error: "0 to 4 % slower, 12 % at worst",
    },
    Chip {
        name: "nRF52840",
        core: "M4",
        pipeline: Pipeline::M4,
        image: "M4F",
        mhz: 64.0,
        flash: Some(FlashRules {
            wait: 2,
            line: 16,
            prefetch: false,
            lines: 128,
            ways: 2,
            data: DataCache::None,
        }),
        flash_says: "2 wait states, lines of 16 bytes; cache of 2 KB for code, switched on",
        spi_mhz: 32.0,
        ram: 256 << 10,
        rows: 16,
        error: "0 to 4 % slower, 12 % at worst",
    },
    Chip {
        name: "RP2350, code in RAM",
        core: "M33",
        pipeline: Pipeline::M33,
        image: "M4F",
        mhz: 150.0,
        flash: None,
        flash_says: "code and mesh copied to RAM, no wait states",
        spi_mhz: 75.0,
        ram: 520 << 10,
        rows: 16,
        error: "15 %",
    },
];

/// A frame of `bench::timed::TIMED` on a chip.
pub(crate) struct ChipFrame {
    pub(crate) chip: &'static Chip,
    /// The number of the frame in `bench::timed::TIMED`.
    pub(crate) timed: usize,
    /// The rows of a band; `None` for a whole picture.
    pub(crate) rows: Option<u32>,
    pub(crate) instructions: u64,
    /// Cycles with code in flash, waits included.
    pub(crate) cycles: u64,
    pub(crate) waited: u64,
    /// Without wait states.
    pub(crate) ideal: u64,
    /// Cycles until each band is drawn, from the band before on.
    pub(crate) bands: Vec<u64>,
}

impl ChipFrame {
    /// The time of drawing in milliseconds.
    pub(crate) fn drawing(&self) -> f64 {
        self.cycles as f64 / self.chip.mhz / 1000.0
    }
}

/// Bytes of commands that set a window, as docs/wire.md counts them.
const WINDOW: u32 = 11;

/// Milliseconds that the bus takes for this many rows.
pub(crate) fn sending(rows: u32, spi_mhz: f64) -> f64 {
    f64::from(8 * (2 * SIZE * rows + WINDOW)) / spi_mhz / 1000.0
}

/// The time of a frame if each band is drawn and then sent; in milliseconds.
pub(crate) fn one_after_the_other(frame: &ChipFrame, spi_mhz: f64) -> f64 {
    let rows = frame.rows.unwrap_or(SIZE);
    frame.drawing() + f64::from(SIZE.div_ceil(rows)) * sending(rows, spi_mhz)
}

/// The time of a frame if one of two strips (or pictures) is sent by DMA while the other is drawn; in milliseconds.
pub(crate) fn overlapped(frame: &ChipFrame, spi_mhz: f64) -> f64 {
    let draw: Vec<f64> = frame.bands.iter().map(|cycles| *cycles as f64 / frame.chip.mhz / 1000.0).collect();
    period(&draw, sending(frame.rows.unwrap_or(SIZE), spi_mhz))
}

/// The time from frame to frame, once it repeats: band after band takes `draw` to draw and `send` to send.
fn period(draw: &[f64], send: f64) -> f64 {
    let (mut drawn, mut sent, mut sent_before, mut ends) = (0.0_f64, 0.0_f64, 0.0_f64, Vec::new());
    // The first frames start with an idle bus; after a few the delay repeats.
    for _ in 0..8 {
        for band in draw {
            // A strip is free when its last content, two bands ago, has been sent.
            drawn = drawn.max(sent_before) + band;
            sent_before = sent;
            sent = drawn.max(sent) + send;
        }
        ends.push(sent);
    }
    match ends[..] {
        [.., before, last] => last - before,
        _ => 0.0,
    }
}

/// Bytes for the pixels and depths of a frame, twice the pixels if `double`.
pub(crate) fn buffers(frame: &ChipFrame, double: bool) -> u32 {
    let strip = 2 * SIZE * frame.rows.unwrap_or(SIZE);
    let depth = u32::from(TIMED[frame.timed].variant == bench::timed::Variant::Depth);
    strip * (1 + u32::from(double) + depth)
}

static MEASURED: OnceLock<std::result::Result<Vec<ChipFrame>, String>> = OnceLock::new();

/// Builds, runs and times the images of [`IMAGES`], once for all pages.
pub(crate) fn measured(failures: &mut Vec<String>) -> Result<&'static [ChipFrame]> {
    let mut found = Vec::new();
    let frames = MEASURED.get_or_init(|| measure(&mut found).map_err(|error| error.to_string()));
    failures.append(&mut found);
    Ok(frames.as_ref().map_err(Clone::clone)?)
}

/// The emulated core and the number of an image of [`IMAGES`], each once.
fn runs() -> Vec<(&'static str, usize)> {
    let mut runs: Vec<(&str, usize)> = CHIPS
        .iter()
        .flat_map(|chip| {
            let drawn = IMAGES.iter().enumerate().filter(|(_, (_, rows))| is_drawn(chip, *rows));
            drawn.map(|(at, _)| (chip.image, at))
        })
        .collect();
    runs.sort();
    runs.dedup();
    runs
}

/// Whether a chip draws in bands of this many rows, or has the RAM for a whole picture.
fn is_drawn(chip: &Chip, rows: Option<u32>) -> bool {
    match rows {
        Some(rows) => rows == chip.rows,
        None => 2 * SIZE * SIZE < chip.ram,
    }
}

fn measure(failures: &mut Vec<String>) -> Result<Vec<ChipFrame>> {
    let runs = runs();
    for core in ["M0", "M3", "M4F"] {
        let of_core = runs.iter().filter(|run| run.0 == core);
        let bins: Vec<String> = of_core.map(|run| format!("--bin={}", IMAGES[run.1].0)).collect();
        emulated(core)?.build().cargo("build", &bins)?;
    }
    let recorded = side_by_side(&runs, |&(core, image)| record(core, image))?;
    let mut frames = Vec::new();
    for (&(core, image), (recorded, printed, mark)) in runs.iter().zip(&recorded) {
        let (name, rows) = IMAGES[image];
        compare(name, rows, recorded, printed, failures)?;
        for chip in CHIPS.iter().filter(|chip| chip.image == core && is_drawn(chip, rows)) {
            for timed in 0..TIMED.len() {
                frames.push(time(chip, timed, rows, recorded, *mark)?);
            }
        }
    }
    // In the order of the table.
    let order = |frame: &ChipFrame| {
        let chip = CHIPS.iter().position(|chip| std::ptr::eq(chip, frame.chip));
        (chip, frame.rows.is_none(), frame.timed)
    };
    frames.sort_by_key(order);
    Ok(frames)
}

/// Runs an image and returns its recorded frames, its output, and the address of the function that takes the pixels.
fn record(core: &str, image: usize) -> Result<(Frames, String, u32)> {
    let core = emulated(core)?;
    let path = core.build().image(IMAGES[image].0);
    let places = provenance::frames(&path)?;
    let takes = if IMAGES[image].1.is_some() { "take_bytes" } else { "take_pixels" };
    let mark = registers::function(&path, &places, takes)?;
    Ok((registers::record(core, &path, &places, TIMED.len())?, core.run(&path)?, mark))
}

/// Fails if the clock counted something else than was recorded, or if the picture is not the host's.
fn compare(
    name: &str,
    rows: Option<u32>,
    recorded: &Frames,
    printed: &str,
    failures: &mut Vec<String>,
) -> Result<()> {
    let mut memory = Box::new(Memory::NEW);
    let lines: Vec<&str> = printed.lines().collect();
    let (counts, checksums) = lines.split_at_checked(TIMED.len()).ok_or("a line for each frame")?;
    for (at, (timed, frame)) in TIMED.iter().zip(&recorded.frames).enumerate() {
        let (instructions, crc) = (counts[at], checksums.get(at).copied().unwrap_or_default());
        let length = frame.run.len() as u64;
        if instructions.parse::<u64>()?.abs_diff(length) > crate::profile::APART {
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
fn time(
    chip: &'static Chip,
    timed: usize,
    rows: Option<u32>,
    Frames { program, frames }: &Frames,
    mark: u32,
) -> Result<ChipFrame> {
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
    Ok(ChipFrame {
        chip,
        timed,
        rows,
        instructions: frame.run.len() as u64,
        cycles: taken.cycles,
        waited: taken.waited,
        ideal,
        bands,
    })
}

#[cfg(test)]
mod tests {
    use super::{period, sending};

    #[test]
    fn the_slower_of_drawing_and_sending_sets_the_period() {
        // Four bands of 3 ms, each sent within 1 ms, and the other way round.
        assert_eq!(period(&[3.0; 4], 1.0), 12.0);
        assert_eq!(period(&[1.0; 4], 3.0), 12.0);
    }

    #[test]
    fn an_uneven_frame_takes_longer_than_either() {
        // Drawing takes 8 and 0 ms, sending 4 and 4 ms. The second band is drawn at 8 ms, sent from 12 to 16 ms; the first
        // strip is free at 12 ms, the third band, drawn from then on, is ready at 20 ms. So a frame takes 12 ms, not 8 ms.
        assert_eq!(period(&[8.0, 0.0], 4.0), 12.0);
    }

    #[test]
    fn the_bus_takes_16_bits_a_pixel_and_a_window() {
        // 240 × 240 × 2 + 11 bytes of 8 bits at 40 MHz.
        assert!((sending(240, 40.0) - 23.0422).abs() < 1e-9);
    }
}
