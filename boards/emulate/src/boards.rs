//! The boards that are emulated. A new one is a row of [`BOARDS`] with a function that draws its pictures on the host, by the drawing
//! code of the board, which is compiled here, too.

use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use pinhole::{camera::Rotation, prelude::*, Angle};
use pinhole_import::{Edges, ImportedMesh, Options};
use pinhole_render::firmware;
use std::path::Path;
use support::oracle::target::Screen;
use support::panel::screen::StoredPixel;
use support::panel::Held;

// As files of their own they are right.
#[allow(dead_code, unreachable_pub)]
#[path = "../../common/two-strips/src/picture.rs"]
mod bands;
#[allow(dead_code, unreachable_pub)] // the rectangles of changes are the firmware's
#[path = "../../common/embassy/src/picture.rs"]
mod changes;
#[allow(unreachable_pub)] // as the macro writes it
mod drawing {
    use super::bands;
    pinhole_render::draws_bands!(bands);
}
#[allow(unreachable_pub)]
mod turned {
    use super::bands;
    pinhole_render::draws_bands!(bands, Deg90);
}

/// A firmware of `boards`, and the circuit around its microcontroller.
pub(crate) struct Board {
    /// Its folder in `boards`, and for a change of it (`*.diff`) the change's name behind a slash.
    pub(crate) name: &'static str,
    pub(crate) chip: Chip,
    pub(crate) display: Display,
    /// Frames of a turn, after which pictures repeat.
    pub(crate) frames: u32,
    pub(crate) pictures: MakePictures,
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
    pub(crate) refresh: Refresh,
    /// The pin that the panel's TE is connected with: then no refresh of the panel may show rows of two frames.
    pub(crate) tearing: Option<u8>,
}

/// How a panel reads its memory: row by row, after a pause of some lines, in which TE is high.
pub(crate) struct Refresh {
    pub(crate) lines: u64,
    pub(crate) pause: u64,
    /// Nanoseconds of a line; `None`: as FRMCTR1 of an ILI9341 sets them.
    pub(crate) line: Option<u64>,
}

/// The pixels of a frame of the turn as the display's memory stores them, row by row.
pub(crate) type Pictures = Box<dyn FnMut(u32) -> Result<Vec<u32>, String>>;
/// Makes the pictures, given the file of the model that the boards draw.
pub(crate) type MakePictures = fn(&Path) -> Result<Pictures, String>;

pub(crate) const BOARDS: &[Board] = &[
    RP2040_ST7789,
    Board {
        name: "rp2040-st7789/smooth",
        pictures: |model| smooth(model, Size::new(240, 240), 120, Rotation::Deg0),
        ..RP2040_ST7789
    },
    Board {
        name: "rp2040-embassy",
        chip: PICO,
        display: Display { tearing: Some(13), ..ST7789 },
        frames: changes::STEPS as u32,
        pictures: changes,
    },
    STM32F4_ILI9341,
    Board {
        name: "stm32f4-ili9341/smooth",
        pictures: |model| smooth(model, Size::new(240, 320), 48, Rotation::Deg90),
        ..STM32F4_ILI9341
    },
];

const RP2040_ST7789: Board = Board {
    name: "rp2040-st7789",
    chip: PICO,
    display: ST7789,
    frames: 120, // as in the firmware, like those of each board
    pictures: |model| turn(model, Size::new(240, 240), 120, drawing::draw),
};
const STM32F4_ILI9341: Board = Board {
    name: "stm32f4-ili9341",
    chip: Chip::Stm32f411 { clock: 5, data: 7, select: 4, command: 3, reset: 2 },
    display: Display {
        width: 240,
        height: 320,
        held: Held::UprightMirrored,
        bgr: true,
        inverted: false,
        tearing: None,
        bit: 40, // beyond the data sheet, as the board's README says
        refresh: Refresh { lines: 324, pause: 4, line: None },
    },
    frames: 48,
    pictures: |model| turn(model, Size::new(240, 320), 48, turned::draw),
};

const PICO: Chip = Chip::Rp2040 { spi: 0, clock: 18, data: 19, select: 17, command: 20, reset: 21 };
const ST7789: Display = Display {
    width: 240,
    height: 240,
    held: Held::Upright,
    bgr: false,
    inverted: true,
    bit: 16, // the data sheet's limit
    refresh: Refresh { lines: 344, pause: 24, line: Some(48_449) },
    tearing: None,
};

/// Imports a board's model as its build script does, which is that of all these templates.
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
        Ok(received(picture).collect())
    }))
}

/// The pixels of a picture as the display stores them.
fn stored(picture: &Screen<Rgb565>, background: Rgb565) -> Vec<u32> {
    picture.over(background).iter().map(|color| color.stored()).collect()
}

/// The pixels of bytes as they are on the bus: the high byte first.
fn received(bytes: &[u8]) -> impl Iterator<Item = u32> + '_ {
    bytes.as_chunks().0.iter().map(|&pair| u16::from_be_bytes(pair).into())
}

/// The pictures of a template that draws its model, turned by a part of a turn.
fn turn(
    model: &Path,
    size: Size,
    frames: u32,
    draw: fn(&ImportedMesh, Angle, &mut Screen<Rgb565>) -> Result<Statistics, String>,
) -> Result<Pictures, String> {
    let imported = import(model)?;
    Ok(Box::new(move |frame| {
        let mut picture = Screen::sized(size.width, size.height);
        draw(&imported, Angle::turns(frame as i32, frames), &mut picture)?;
        Ok(stored(&picture, Rgb565::new(31, 0, 31)))
    }))
}

/// Complete pictures of `boards/rp2040-embassy`, which sends only the rectangles that have changed.
fn changes(model: &Path) -> Result<Pictures, String> {
    let imported = import(model)?;
    Ok(Box::new(move |frame| {
        let mesh = imported.mesh().map_err(|error| error.to_string())?;
        let colors = imported.colors().map_err(|error| error.to_string())?;
        let color = |face: usize, level: u16| match colors {
            Some(colors) => colors.lit(face, level),
            None => pinhole::color::Color::dim(changes::COLOR, level),
        };
        let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
        let mut bins = vec![0; mesh.face_bins_len()];
        let mut depths = vec![0; changes::PIXELS];
        let mut strip = vec![0; 2 * changes::PIXELS];
        let mut picture = changes::Picture::new(&mesh, &mut cache, &mut bins, &mut depths)?;
        let mut turned = picture.turned(frame as i32)?;
        let mut frame = changes::frame(changes::SCREEN);
        let mut pixels = Vec::new();
        for _ in 0..changes::SCREEN.size.height.div_ceil(changes::ROWS) {
            pixels.extend(received(turned.next_band(color, &mut frame, &mut strip)?.into_bytes()));
        }
        Ok(pixels)
    }))
}

/// The pictures of a template after `smooth.diff`, drawn in one piece.
fn smooth(model: &Path, size: Size, frames: u32, rotation: Rotation) -> Result<Pictures, String> {
    let edges = Edges::CreasesFirst { degrees: 0.0 };
    let options =
        Options { edges, edge_faces: true, ..firmware::options(&firmware::TEMPLATE, &Options::default()) };
    let imported = pinhole_import::import(model, &options).map_err(|error| error.to_string())?;
    Ok(Box::new(move |frame| {
        let turn = Angle::turns(frame as i32, frames);
        smoothed(&imported, turn, size, rotation).map_err(|error| error.to_string())
    }))
}

fn smoothed(
    imported: &ImportedMesh,
    turn: Angle,
    size: Size,
    rotation: Rotation,
) -> Result<Vec<u32>, Box<dyn std::error::Error>> {
    let (mesh, model) = (imported.mesh()?, Affine::rotation_y(turn));
    let viewport = Viewport::new(Point::zero(), size)?.rotated(rotation);
    let [field_of_view, yaw, pitch] = [40, 30, 20].map(Angle::degrees);
    let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch)?;
    let light = Lambert::new(&model, Vector3::from_ints(2, 3, 4), 48)?;
    let (mut cache, mut bins) =
        (vec![ScreenVertex::EMPTY; mesh.vertices().len()], vec![0; mesh.smooth_bins_len()]);
    let count = (size.width * size.height) as usize;
    let (mut pixels, mut depths) = (vec![Rgb565::BLACK; count], vec![0; count]);
    let mut picture = Picture::new(&mut pixels, size)?;
    let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths)?;
    let instance = camera.place(&mesh, &model);
    let color = |face: usize| pinhole::color::Color::dim(bands::COLOR, light.level(mesh.normals()[face]));
    instance.faces(color).draw(&mut picture.pixels().depth_tested(&mut depth))?;
    let transformed = instance.transform_depth(&mut cache);
    let mut edges = transformed.bin_smooth_edges(|edge| edge < imported.creases.unwrap_or(0), &mut bins)?;
    picture.pixels().depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
    Ok(pixels.iter().map(|color| color.stored()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With its right border up the display of `stm32f4-ili9341` shows what a display shows that is mounted upright, but for pixels whose
    /// centres lie at the border of a face.
    #[test]
    fn a_turned_panel_shows_the_picture() {
        let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../common/all/model.stl");
        let picture = |size, draw| (turn(&model, size, 48, draw).expect("a model"))(5).expect("a picture");
        let upright = picture(Size::new(320, 240), drawing::draw);
        let turned = picture(Size::new(240, 320), turned::draw);
        let at = |x: usize, y: usize| (upright[320 * y + x], turned[240 * x + 239 - y]);
        let pixels = (0..240).flat_map(|y| (0..320).map(move |x| at(x, y)));
        let differing = pixels.filter(|(upright, turned)| upright != turned).count();
        assert!(differing < 100, "{differing} pixels");
    }
}
