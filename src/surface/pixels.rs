//! Pixels in a borrowed slice, as a target.

use super::memory::Memory;
use super::target::Surface;
use crate::color::StoredPixel;
use crate::raster::Span;
use crate::surface::BufferError;
use core::convert::Infallible;
use core::marker::PhantomData;
use embedded_graphics_core::{geometry::Size, primitives::Rectangle};

/// Pixels in a borrowed slice, the fastest [`Surface`]. [`Picture::pixels`](crate::target::Picture::pixels) and
/// [`Band::pixels`](crate::bands::Band::pixels) make one, and [`new`](Self::new) makes one of any other framebuffer.
///
/// `C` is the colour type, `Cell` the stored form of one pixel: see [`StoredPixel`].
#[derive(Debug)]
pub struct Pixels<'a, C, Cell = C> {
    memory: Memory<&'a mut [Cell]>,
    color: PhantomData<C>,
}

impl<'a, C: StoredPixel<Cell>, Cell: Copy> Pixels<'a, C, Cell> {
    /// The pixels of `area`, row by row, in the first cells of a slice. A framebuffer of integers:
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
    /// use pinhole::{draw::fill_triangle, raster::ScreenPoint, target::Pixels};
    /// let mut framebuffer = [0_u16; 32 * 24];
    /// let area = Rectangle::new(Point::zero(), Size::new(32, 24));
    /// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
    /// let corners = [corner(0, 0), corner(40, 0), corner(0, 20)];
    /// let Ok(()) = fill_triangle(corners, Rgb565::RED, &mut Pixels::new(&mut framebuffer, area)?);
    /// assert_eq!((framebuffer[31], framebuffer[32 * 24 - 1]), (0xf800, 0));
    ///
    /// // Cells of two bytes, the high byte first: what a display takes over SPI.
    /// let cells: &mut [[u8; 2]] = bytemuck::cast_slice_mut(&mut framebuffer);
    /// let Ok(()) = fill_triangle(corners, Rgb565::RED, &mut Pixels::new(cells, area)?);
    /// assert_eq!(framebuffer[31].to_ne_bytes(), [0xf8, 0x00]);
    /// # Ok::<(), pinhole::target::BufferError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`BufferError`] when there are fewer cells than the area has pixels.
    pub fn new(cells: &'a mut [Cell], area: Rectangle) -> Result<Self, BufferError> {
        Ok(Self { memory: Memory::new(cells, area)?, color: PhantomData })
    }

    /// The pixels of `area` in rows that begin `stride` cells apart, from its first pixel on: a framebuffer that is wider than the picture,
    /// or a part of one. A smaller `stride` than the area's width counts as the width.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when there are fewer cells than up to the last pixel.
    pub fn with_stride(cells: &'a mut [Cell], area: Rectangle, stride: usize) -> Result<Self, BufferError> {
        let Size { width, height } = area.size;
        let stride = stride.max(width as usize);
        let above = (stride as u64).saturating_mul(height.saturating_sub(1).into());
        let needed = if height > 0 { above.saturating_add(width.into()) } else { 0 };
        if needed > cells.len() as u64 {
            return Err(BufferError::Picture { needed, given: cells.len() });
        }
        Ok(Self { memory: Memory::unchecked(cells, area, stride), color: PhantomData })
    }
}

impl<'a, C, Cell: Copy> Pixels<'a, C, Cell> {
    /// [`new`](Self::new) for callers that have checked the number of cells.
    #[inline(always)]
    pub(super) fn unchecked(cells: &'a mut [Cell], area: Rectangle) -> Self {
        Self { memory: Memory::unchecked(cells, area, area.size.width as usize), color: PhantomData }
    }
}

impl<'a, C: StoredPixel<Cell>, Cell: Copy> Surface for Pixels<'a, C, Cell> {
    type Color = C;
    type Error = Infallible;
    type Store = &'a mut [Cell];

    fn area(&self) -> Rectangle {
        self.memory.area()
    }

    #[inline(always)]
    fn fill(&mut self, span: Span, color: C) -> Result<(), Infallible> {
        self.memory.fill(span, color.stored());
        Ok(())
    }

    #[inline(always)]
    fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = C>) -> Result<(), Infallible> {
        self.memory.fill_run(span, colors.map(StoredPixel::stored));
        Ok(())
    }

    #[inline(always)]
    fn memory(&mut self) -> Option<&mut Memory<&'a mut [Cell]>> {
        Some(&mut self.memory)
    }
}

// The colour is not printed: it need not implement `Format`.
defmt_format!([C, Cell] Pixels<'_, C, Cell>, self, "pixels of {}", self.memory.area());
