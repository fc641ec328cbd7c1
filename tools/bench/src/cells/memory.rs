//! Memory of the cells.

use super::Counted;
use crate::measure::Checksum;
use crate::scene::{BACKGROUND, SIZE};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::prelude::{DepthBuffer, ScreenVertex};

const SIDE: usize = SIZE as usize;

/// A whole picture, aligned to a word as a DMA controller needs it.
#[repr(C, align(4))]
pub struct Frame<const WIDTH: usize = SIDE, const HEIGHT: usize = SIDE>(pub(crate) [[Rgb565; WIDTH]; HEIGHT]);

impl<const WIDTH: usize, const HEIGHT: usize> Frame<WIDTH, HEIGHT> {
    pub const NEW: Self = Self([[BACKGROUND; WIDTH]; HEIGHT]);
    pub(crate) const SIZE: Size = Size::new(WIDTH as u32, HEIGHT as u32);

    /// The result of a cell whose frame this is.
    pub(super) fn counted(&self, instructions: u32) -> Counted {
        Counted { instructions, crc: Checksum::of(black_box(self.0.as_flattened())) }
    }
}

/// Memory of a picture, of a mesh's vertices, and of a depth buffer unless `DEPTH_ROWS` is 0.
pub struct Memory<
    const N: usize,
    const DEPTH_ROWS: usize,
    const WIDTH: usize = SIDE,
    const HEIGHT: usize = SIDE,
> {
    pub(crate) frame: Frame<WIDTH, HEIGHT>,
    pub(crate) depth: Depth<WIDTH, DEPTH_ROWS>,
    pub(crate) corners: [ScreenVertex; N],
}

#[repr(C, align(4))]
pub(crate) struct Depth<const WIDTH: usize, const ROWS: usize>([[u16; WIDTH]; ROWS]);

impl<const WIDTH: usize, const ROWS: usize> Depth<WIDTH, ROWS> {
    /// A cleared depth buffer. The compiler does not know its area.
    #[inline(always)]
    pub(crate) fn buffer(&mut self) -> Option<DepthBuffer<'_>> {
        let area = Rectangle::new(Point::zero(), Size::new(WIDTH as u32, ROWS as u32));
        DepthBuffer::new(black_box(area), self.0.as_flattened_mut()).ok()
    }
}

pub type Plain<const N: usize> = Memory<N, 0>;
pub type Deep<const N: usize> = Memory<N, SIDE>;

impl<const N: usize, const DEPTH_ROWS: usize, const WIDTH: usize, const HEIGHT: usize>
    Memory<N, DEPTH_ROWS, WIDTH, HEIGHT>
{
    pub const NEW: Self =
        Self { frame: Frame::NEW, depth: Depth([[0; WIDTH]; DEPTH_ROWS]), corners: [ScreenVertex::EMPTY; N] };
}

/// Memory of a picture, a mesh's vertices, the light at each, and a depth buffer unless `DEPTH_ROWS` is 0.
pub struct Smooth<const N: usize, const DEPTH_ROWS: usize> {
    pub(crate) memory: Memory<N, DEPTH_ROWS>,
    pub(crate) levels: [u16; N],
}

pub type PlainSmooth<const N: usize> = Smooth<N, 0>;
pub type DeepSmooth<const N: usize> = Smooth<N, SIDE>;

impl<const N: usize, const DEPTH_ROWS: usize> Smooth<N, DEPTH_ROWS> {
    pub const NEW: Self = Self { memory: Memory::NEW, levels: [0; N] };
}
