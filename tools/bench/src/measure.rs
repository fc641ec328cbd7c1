//! Counting frames, and looking at them.

use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{IntoStorage, Rgb565};

/// Where frames go. What is counted ends where a DMA controller would take the bytes; in a frame that is not
/// counted they go into a checksum.
#[derive(Default)]
pub struct Display {
    checksum: Option<Checksum>,
}

impl Display {
    /// Pixels as they go over the wire, the high byte first.
    #[inline(never)]
    pub fn take_bytes(&mut self, bytes: &[u8]) {
        if let Some(checksum) = &mut self.checksum {
            for pair in black_box(bytes).chunks_exact(2) {
                pair.iter().rev().for_each(|&byte| checksum.add(byte));
            }
        }
    }

    /// The CRC-32 of the pixels that `frame` gives it, as little-endian numbers.
    pub fn look(&mut self, frame: &mut dyn FnMut(&mut Self)) -> u32 {
        self.checksum = Some(Checksum(!0));
        frame(self);
        self.checksum.take().map_or(0, |checksum| !checksum.0)
    }
}

/// CRC-32 as in zip and PNG. Bit by bit: a table would be larger than the code.
pub(crate) struct Checksum(u32);

impl Checksum {
    /// Of pixels as little-endian numbers.
    pub(crate) fn of(pixels: &[Rgb565]) -> u32 {
        let mut checksum = Self(!0);
        pixels.iter().flat_map(|p| p.into_storage().to_le_bytes()).for_each(|b| checksum.add(b));
        !checksum.0
    }

    fn add(&mut self, byte: u8) {
        self.0 = (0..8)
            .fold(self.0 ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()));
    }
}
