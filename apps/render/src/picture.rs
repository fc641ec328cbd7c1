//! A picture in the pixel format of a display, and pictures that scenes name: PNG and BMP files.

use crate::bands::Report;
use crate::json::Names;
use crate::paint::{paint, Subject};
use crate::quantised::Quantised;
use crate::scene::Scene;
use crate::style::Style;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use std::path::Path;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Format {
    Rgb888,
    Rgb666,
    Rgb565,
    Gray8,
    Gray4,
    Gray2,
    Mono,
}

/// Calls a generic function with the colour type of a format.
macro_rules! by_format {
    ($format:expr, $colour:ident => $call:expr) => {
        $crate::picture::by_format!(
            $format, $colour => $call,
            Rgb888 Rgb888, Rgb666 Rgb666, Rgb565 Rgb565, Gray8 Gray8, Gray4 Gray4, Gray2 Gray2, Mono BinaryColor
        )
    };
    ($format:expr, $colour:ident => $call:expr, $($variant:ident $type:ident),*) => {
        match $format {$(
            $crate::picture::Format::$variant => {
                type $colour = embedded_graphics::pixelcolor::$type;
                $call
            }
        )*}
    };
}
pub(crate) use by_format;

impl Format {
    pub const ALL: [(&'static str, Self); 7] = [
        ("rgb888", Self::Rgb888),
        ("rgb666", Self::Rgb666),
        ("rgb565", Self::Rgb565),
        ("gray8", Self::Gray8),
        ("gray4", Self::Gray4),
        ("gray2", Self::Gray2),
        ("mono", Self::Mono),
    ];

    /// Bits of a pixel.
    pub fn bits(self) -> u32 {
        by_format!(self, C => <C as pinhole::color::Color>::FORMAT.bits())
    }

    /// Whether the format is monochrome; such displays mostly have a dark background.
    pub const fn is_grey(self) -> bool {
        matches!(self, Self::Gray8 | Self::Gray4 | Self::Gray2 | Self::Mono)
    }

    /// Whether the format is coarse enough to show steps in smooth shading.
    pub const fn wants_dither(self) -> bool {
        !matches!(self, Self::Rgb888 | Self::Gray8)
    }
}

impl Names for Format {
    fn names() -> impl Iterator<Item = (&'static str, Self)> {
        Self::ALL.into_iter()
    }
}

/// The pixels of a scene, row by row, and the statistics of the frame.
pub fn picture(
    subject: &Subject,
    scene: (&Scene, &Quantised),
    style: &Style,
    format: Format,
) -> Result<(Vec<Rgb888>, Report), String> {
    let size = Size::new(scene.0.width, scene.0.height);
    let mut pixels = Vec::new();
    let mut all = |_| vec![Rectangle::new(Point::zero(), size)];
    let mut send = |_, colours: &mut dyn Iterator<Item = Rgb888>| pixels.extend(colours);
    let report = paint(subject, scene, style, format, size.height, &mut all, &mut send)?;
    Ok((pixels, report))
}

/// Luma of a colour, 0 to 255, as the grey formats take it.
pub fn luma(colour: Rgb888) -> u32 {
    (77 * u32::from(colour.r()) + 150 * u32::from(colour.g()) + 29 * u32::from(colour.b())) / 256
}

/// The size and the pixels of a picture, row by row: red, green, blue and opacity.
type FilePixels = ([usize; 2], Vec<[u8; 4]>);

/// Reads a picture of at most `longest` pixels a side. The error names the file.
pub(crate) fn read_file(path: &Path, longest: u32) -> Result<FilePixels, String> {
    let named = |problem: String| format!("{}: {problem}", path.display());
    let file = std::fs::read(path).map_err(|e| named(format!("cannot be read: {e}")))?;
    let (size, pixels) = pinhole_import::read_picture(&file).map_err(named)?;
    let [width, height] = size;
    match width.max(height) > longest as usize {
        true => Err(named(format!(
            "has {width} x {height} pixels, and may have {longest} a side: make it smaller"
        ))),
        false => Ok((size, pixels)),
    }
}
