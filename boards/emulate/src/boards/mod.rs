//! The boards that are emulated. A new one is a file here, which draws its pictures on the host, and a row of [`BOARDS`].

mod rp2040_embassy;
mod rp2040_st7789;
mod rp2040_st7789_balloon;
mod stm32f4_ili9341;

use pinhole_import::{ImportedMesh, Options};
use pinhole_render::firmware;
use std::path::Path;
use support::panel::Held;

/// A firmware of `boards`, and the circuit around its microcontroller.
pub(crate) struct Board {
    /// Its folder in `boards`, and for an example of it the example's name behind a slash.
    pub(crate) name: &'static str,
    pub(crate) chip: Chip,
    pub(crate) display: Display,
    /// Frames of a turn, after which pictures repeat.
    pub(crate) frames: u32,
    pub(crate) sends: Sends,
    pub(crate) pictures: MakePictures,
}

/// What a frame sends after the first one, which decides how the end of a frame is recognised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sends {
    /// All pixels: a frame ends with the last one.
    All,
    /// Rectangles that contain what has changed: a frame ends when the display shows the next picture. Until then each pixel is
    /// that of one picture or the next.
    Changes,
}

/// The microcontroller and its wires to the display, by the numbers of pins.
pub(crate) enum Chip {
    /// Pins of SPI0 or SPI1.
    Rp2040 { spi: u8, clock: u8, data: u8, select: u8, command: u8, reset: u8 },
    /// Pins of port A, with SPI1.
    Stm32f411 { clock: u8, data: u8, select: u8, command: u8, reset: u8 },
}

impl Chip {
    pub(crate) fn reset(&self) -> u8 {
        match *self {
            Self::Rp2040 { reset, .. } | Self::Stm32f411 { reset, .. } => reset,
        }
    }
}

/// A display controller behind a glass.
pub(crate) struct Display {
    pub(crate) width: u16,
    pub(crate) height: u16,
    pub(crate) held: Held,
    /// Whether the glass has blue where others have red.
    pub(crate) bgr: bool,
    /// Whether the glass shows right colours only with inversion on.
    pub(crate) inverted: bool,
    /// The shortest bit on the bus, in nanoseconds.
    pub(crate) bit: u64,
}

/// The pixels of a frame of the turn as the display's memory stores them, row by row.
pub(crate) type Pictures = Box<dyn FnMut(u32) -> Result<Vec<u32>, String>>;
/// Makes the pictures, given the file of the model that the board draws.
pub(crate) type MakePictures = fn(&Path) -> Result<Pictures, String>;

pub(crate) const BOARDS: &[Board] = &[
    Board {
        name: "rp2040-st7789",
        chip: PICO,
        display: ST7789,
        frames: rp2040_st7789::FRAMES,
        sends: Sends::All,
        pictures: rp2040_st7789::pictures,
    },
    Board {
        name: "rp2040-st7789/balloon",
        chip: PICO,
        display: ST7789,
        frames: rp2040_st7789_balloon::FRAMES,
        sends: Sends::All,
        pictures: rp2040_st7789_balloon::pictures,
    },
    Board {
        name: "rp2040-embassy",
        chip: PICO,
        display: ST7789,
        frames: rp2040_embassy::FRAMES,
        sends: Sends::Changes,
        pictures: rp2040_embassy::pictures,
    },
    Board {
        name: "stm32f4-ili9341",
        chip: Chip::Stm32f411 { clock: 5, data: 7, select: 4, command: 3, reset: 2 },
        display: Display {
            width: 320,
            height: 240,
            held: Held::LandscapeMirrored,
            bgr: true,
            inverted: false,
            bit: 40, // beyond the data sheet, as the board's README says
        },
        frames: stm32f4_ili9341::FRAMES,
        sends: Sends::All,
        pictures: stm32f4_ili9341::pictures,
    },
];

const PICO: Chip = Chip::Rp2040 { spi: 0, clock: 18, data: 19, select: 17, command: 20, reset: 21 };
const ST7789: Display = Display {
    width: 240,
    height: 240,
    held: Held::Upright,
    bgr: false,
    inverted: true,
    bit: 16, // the data sheet's limit
};

/// Imports a board's model as its build script does, which is that of all these templates (`boards/share`).
fn import(model: &Path) -> Result<ImportedMesh, String> {
    let options = firmware::options(&firmware::TEMPLATE, &Options::default());
    pinhole_import::import(model, &options).map_err(|error| error.to_string())
}

/// Reads the pictures of a turn from a file, in the format that the command's help describes. The file may have fewer pictures
/// than a turn.
pub(crate) fn read(board: &Board, file: &Path) -> Result<Pictures, String> {
    let bytes = std::fs::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let length = usize::from(board.display.width) * usize::from(board.display.height) * 2;
    if bytes.is_empty() || bytes.len() % length != 0 {
        return Err(format!("{}: {} bytes are not pictures of {length} bytes", file.display(), bytes.len()));
    }
    Ok(Box::new(move |frame| {
        let picture = bytes.chunks_exact(length).nth(frame as usize);
        let picture = picture.ok_or_else(|| format!("there is no picture of frame {frame}"))?;
        Ok(picture.as_chunks().0.iter().map(|&pair| u32::from(u16::from_be_bytes(pair))).collect())
    }))
}
