//! What pixels are drawn into.

use super::memory::{Memory, PixelStore};
use super::pixels::StoredPixel;
use crate::raster::Span;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// What is drawn into: any `embedded-graphics` DrawTarget, [`Pixels`](crate::Pixels) in memory in a fraction of the
/// instructions, or a type of your own. The picture is the same.
///
/// A DrawTarget gets a `fill_solid` or a `fill_contiguous` for every run of pixels.
///
/// A type that is no DrawTarget implements this trait: either it takes spans, and has `[Self::Color; 0]` for
/// [`Store`](Self::Store); or its pixels lie in [`Memory`], which it hands out:
///
/// ```
/// use core::convert::Infallible;
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
/// use pinhole::{fill_triangle, raster::{ScreenPoint, Span}, Memory, PictureError, StoredPixel, Target};
///
/// /// A framebuffer that remembers whether it was drawn to.
/// struct Framebuffer<'a> {
///     memory: Memory<&'a mut [u16]>,
///     is_drawn: bool,
/// }
///
/// impl<'a> Target for Framebuffer<'a> {
///     type Color = Rgb565;
///     type Error = Infallible;
///     type Store = &'a mut [u16];
///
///     fn area(&self) -> Rectangle {
///         self.memory.area()
///     }
///     fn fill(&mut self, span: Span, color: Rgb565) -> Result<(), Infallible> {
///         self.is_drawn = true;
///         Ok(self.memory.fill(span, color.stored()))
///     }
///     fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = Rgb565>) -> Result<(), Infallible> {
///         self.is_drawn = true;
///         Ok(self.memory.fill_run(span, colors.map(StoredPixel::stored)))
///     }
///     fn memory(&mut self) -> Option<&mut Memory<&'a mut [u16]>> {
///         self.is_drawn = true;
///         Some(&mut self.memory)
///     }
/// }
///
/// let mut cells = [0_u16; 32 * 24];
/// let area = Rectangle::new(Point::zero(), Size::new(32, 24));
/// let mut target = Framebuffer { memory: Memory::new(&mut cells[..], area)?, is_drawn: false };
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let Ok(()) = fill_triangle([corner(0, 0), corner(40, 0), corner(0, 20)], Rgb565::RED, &mut target);
/// assert!(target.is_drawn && cells[31] == 0xf800);
/// # Ok::<(), PictureError>(())
/// ```
pub trait Target {
    /// The colour of a pixel.
    type Color: StoredPixel<<Self::Store as PixelStore>::Cell>;

    /// What drawing can fail with.
    type Error;

    /// What holds the pixels: a slice, or `[Self::Color; 0]` where they do not lie in memory.
    type Store: PixelStore;

    /// The rectangle that can be drawn to.
    fn area(&self) -> Rectangle;

    /// Sets the pixels of a span, which lies in the [`area`](Self::area), to one colour.
    ///
    /// # Errors
    ///
    /// The target's own.
    fn fill(&mut self, span: Span, color: Self::Color) -> Result<(), Self::Error>;

    /// Sets the pixels of a row's span, which lies in the [`area`](Self::area), to these colours from left to right. There are
    /// at least `span.width` colours.
    ///
    /// # Errors
    ///
    /// The target's own.
    fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = Self::Color>) -> Result<(), Self::Error>;

    /// The memory that holds the pixels of the [`area`](Self::area), if they lie in memory. Most drawing then writes to it, and
    /// [`fill`](Self::fill) and [`fill_run`](Self::fill_run) are called only for what no fast path takes. Colours are converted
    /// by [`StoredPixel`], so both ways must store the same cells.
    #[inline(always)]
    fn memory(&mut self) -> Option<&mut Memory<Self::Store>> {
        None
    }
}

impl<D: DrawTarget> Target for D {
    type Color = D::Color;
    type Error = D::Error;
    type Store = [D::Color; 0];

    fn area(&self) -> Rectangle {
        self.bounding_box()
    }

    #[inline(always)]
    fn fill(&mut self, span: Span, color: D::Color) -> Result<(), D::Error> {
        self.fill_solid(&rectangle(span), color)
    }

    #[inline(always)]
    fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = D::Color>) -> Result<(), D::Error> {
        self.fill_contiguous(&rectangle(span), colors.take(span.width as usize))
    }
}

/// A span as a rectangle of `embedded-graphics`.
#[inline(always)]
fn rectangle(Span { x, y, width, height }: Span) -> Rectangle {
    Rectangle::new(Point::new(x, y), Size::new(width as u32, height as u32)) // both positive
}
