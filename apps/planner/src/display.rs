//! The displays, and the colours of their pixels.

use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb888;
use pinhole::color::Color;

/// The format of a display's pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 16-bit colour.
    Rgb565,
    /// Black and white.
    Mono,
    /// 4 levels of grey.
    Gray2,
    /// 16 levels of grey.
    Gray4,
    /// Black, white and red, as e-paper has them.
    Tricolor,
}

impl Format {
    /// The formats by their names.
    pub const ALL: [(&'static str, Self); 5] = [
        ("rgb565", Self::Rgb565),
        ("mono", Self::Mono),
        ("gray2", Self::Gray2),
        ("gray4", Self::Gray4),
        ("tricolor", Self::Tricolor),
    ];

    /// Whether faces are always dithered, because without it so few colours show no shape.
    pub const fn always_dithers(self) -> bool {
        matches!(self, Self::Mono | Self::Tricolor)
    }

    /// Whether colours between two others can be shown, as smooth edges need.
    pub const fn mixes(self) -> bool {
        matches!(self, Self::Rgb565 | Self::Gray2 | Self::Gray4)
    }

    /// The format's name.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, format)| *format == self).map_or("", |(name, _)| name)
    }
}

/// A display that the page offers.
pub struct Display {
    /// What it is.
    pub name: &'static str,
    /// Its columns.
    pub width: u32,
    /// Its rows.
    pub height: u32,
    /// The format of its pixels.
    pub format: Format,
}

impl Display {
    pub(crate) const fn parts(&self) -> (Size, Format) {
        (Size::new(self.width, self.height), self.format)
    }
}

const fn display(name: &'static str, width: u32, height: u32, format: Format) -> Display {
    Display { name, width, height, format }
}

/// The displays that the page offers, the usual one first.
pub static DISPLAYS: [Display; 15] = [
    display("ST7789, 240 × 240, 16-bit colour", 240, 240, Format::Rgb565),
    display("ST7789, 240 × 320, 16-bit colour", 240, 320, Format::Rgb565),
    display("ST7789, 170 × 320, 16-bit colour", 170, 320, Format::Rgb565),
    display("ILI9341, 320 × 240, 16-bit colour", 320, 240, Format::Rgb565),
    display("ILI9488, 480 × 320, 18-bit colour", 480, 320, Format::Rgb565),
    display("GC9A01, 240 × 240, round, 16-bit colour", 240, 240, Format::Rgb565),
    display("CO5300, 466 × 466, round, 16-bit colour", 466, 466, Format::Rgb565),
    display("ST7735, 128 × 128, 16-bit colour", 128, 128, Format::Rgb565),
    display("SSD1306, 128 × 64, black and white", 128, 64, Format::Mono),
    display("SH1106, 128 × 64, black and white", 128, 64, Format::Mono),
    display("SSD1327, 128 × 128, 16 greys", 128, 128, Format::Gray4),
    display("e-paper, 200 × 200, black and white", 200, 200, Format::Mono),
    display("e-paper, 296 × 128, 4 greys", 296, 128, Format::Gray2),
    display("e-paper, 400 × 300, 16 greys", 400, 300, Format::Gray4),
    display("e-paper, 212 × 104, black, white and red", 212, 104, Format::Tricolor),
];

/// A colour type of a pixel that can be drawn, and shown on the page.
pub(crate) trait Shown: Color + From<Rgb888> + Into<Rgb888> {}
impl<C: Color + From<Rgb888> + Into<Rgb888>> Shown for C {}
