//! Memory of the cells.

use super::Counted;
use crate::measure::Checksum;
use crate::scene::{BACKGROUND, SIZE};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::camera::ScreenVertex;

const PIXELS: usize = (SIZE * SIZE) as usize;

/// A whole picture, aligned to a word as a DMA controller needs it.
#[repr(C, align(4))]
pub struct Frame(pub(crate) [Rgb565; PIXELS]);

impl Frame {
    pub const NEW: Self = Self([BACKGROUND; PIXELS]);

    /// The result of a cell whose frame this is.
    pub(super) fn counted(&self, instructions: u32) -> Counted {
        Counted { instructions, crc: Checksum::of(black_box(&self.0)) }
    }
}

/// Memory of a picture, of a mesh's vertices, and of a depth buffer unless `DEPTHS` is 0.
pub struct Memory<const N: usize, const DEPTHS: usize> {
    pub(crate) frame: Frame,
    pub(crate) depth: Depth<DEPTHS>,
    pub(crate) corners: [ScreenVertex; N],
}

#[repr(C, align(4))]
pub(crate) struct Depth<const DEPTHS: usize>(pub(crate) [u16; DEPTHS]);

pub type Plain<const N: usize> = Memory<N, 0>;
pub type Deep<const N: usize> = Memory<N, PIXELS>;

impl<const N: usize, const DEPTHS: usize> Memory<N, DEPTHS> {
    pub const NEW: Self =
        Self { frame: Frame::NEW, depth: Depth([0; DEPTHS]), corners: [ScreenVertex::EMPTY; N] };
}

/// Memory of a picture, a depth buffer, a mesh's vertices, and the light at each vertex.
pub struct Smooth<const N: usize> {
    pub(crate) deep: Deep<N>,
    pub(crate) levels: [u16; N],
}

impl<const N: usize> Smooth<N> {
    pub const NEW: Self = Self { deep: Deep::NEW, levels: [0; N] };
}
