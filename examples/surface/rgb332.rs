//! A custom pixel format: eight bits, three of red, three of green, two of blue.

use embedded_graphics::pixelcolor::raw::RawU8;
use embedded_graphics::pixelcolor::{PixelColor, Rgb565};
use pinhole::{Channels, PixelFormat};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rgb332(u8);

impl Rgb332 {
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        (0..=255).map(Self)
    }
}

impl PixelColor for Rgb332 {
    type Raw = RawU8;
}

/// Bands need this trait.
impl PixelFormat for Rgb332 {
    const BITS: u32 = 8;

    fn encode(self) -> u32 {
        self.0.into()
    }

    fn decode(bits: u32) -> Self {
        Self(bits as u8)
    }
}

/// Smooth and dithered shaders need this trait.
impl Channels for Rgb332 {
    const GRAY: bool = false;
    const MAX: [u8; 3] = [7, 7, 3];

    fn from_channels([r, g, b]: [u8; 3]) -> Self {
        Self(r << 5 | g << 2 | b)
    }
}

impl From<Rgb332> for Rgb565 {
    fn from(Rgb332(bits): Rgb332) -> Self {
        let part =
            |shift: u32, max: u8, to: u32| (u32::from(bits >> shift & max) * to / u32::from(max)) as u8;
        Rgb565::new(part(5, 7, 31), part(2, 7, 63), part(0, 3, 31))
    }
}
