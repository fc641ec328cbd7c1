//! The displays, and the colours of their pixels.

use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::raw::RawU2;
use embedded_graphics_core::pixelcolor::{PixelColor, Rgb888, RgbColor};
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

/// A pixel of e-paper with black, white and red particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tricolor {
    /// No other particles in front.
    Black,
    /// White particles in front.
    White,
    /// Red particles in front.
    Red,
}

impl PixelColor for Tricolor {
    type Raw = RawU2;
}

/// Two bits, as the controller stores them in two planes: white, and red. Each channel has levels 0 and 1: a colour with red and without
/// green is red; any other colour is black or white by its green.
impl Color for Tricolor {
    const FORMAT: pinhole::color::Format = pinhole::color::Format::indexed(2, [1; 3]);

    fn to_bits(self) -> u32 {
        match self {
            Self::Black => 0b00,
            Self::White => 0b01,
            Self::Red => 0b10,
        }
    }

    fn from_bits(bits: u32) -> Self {
        match bits & 3 {
            0b00 => Self::Black,
            0b01 => Self::White,
            _ => Self::Red,
        }
    }

    fn channels(self) -> [u8; 3] {
        match self {
            Self::Black => [0; 3],
            Self::White => [1; 3],
            Self::Red => [1, 0, 0],
        }
    }

    fn from_channels([r, g, _]: [u8; 3]) -> Self {
        match (r != 0, g != 0) {
            (true, false) => Self::Red,
            (false, false) => Self::Black,
            (_, true) => Self::White,
        }
    }
}

impl From<Rgb888> for Tricolor {
    fn from(color: Rgb888) -> Self {
        Self::from_channels([color.r(), color.g(), color.b()].map(|level| u8::from(level > 127)))
    }
}

impl From<Tricolor> for Rgb888 {
    fn from(color: Tricolor) -> Self {
        match color {
            Tricolor::Black => Self::BLACK,
            Tricolor::White => Self::WHITE,
            Tricolor::Red => Self::new(200, 30, 30),
        }
    }
}
