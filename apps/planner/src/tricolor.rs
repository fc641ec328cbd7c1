//! The colours of e-paper with black, white and red particles. Firmware gets this file, too.

use embedded_graphics_core::pixelcolor::raw::RawU2;
use embedded_graphics_core::pixelcolor::{PixelColor, Rgb888, RgbColor};
use pinhole::color::Color;

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
