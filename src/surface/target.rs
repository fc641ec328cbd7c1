//! Where draw calls draw: a surface, which is everything whose pixels can be drawn, alone or with a depth buffer.

use super::memory::{Memory, PixelStore};
use super::DepthBuffer;
use crate::color::{InkKind, StoredPixel};
use crate::raster::Span;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

/// A drawing target: any `embedded-graphics` DrawTarget, [`Pixels`](crate::target::Pixels) in memory, which take a fraction of the
/// instructions, or your own type. All get the same picture.
///
/// Every DrawTarget implements this trait. Of a face it gets a `fill_solid` or a `fill_contiguous` for every run of pixels. Of a
/// line it gets
/// - one `draw_iter`, if its error type has no value, like `Infallible`: it draws into memory, where a call costs more than a
///   pixel. A line that is clipped, longer than 6688 pixels, or so flat that its runs have 16 pixels on average, is still one
///   `fill_solid` per run;
/// - one `fill_solid` per run of pixels, if it can fail: it drives a display, where a window costs more than a pixel. No other
///   calls send fewer bytes.
///
/// [`LeastRun`](crate::target::LeastRun) changes the choice for a target.
///
/// Your own type implements the trait if it is no DrawTarget, in one of two forms. A target that takes spans, or has several pixels in a byte,
/// has `[Self::Color; 0]` for [`Store`](Self::Store). A target whose pixels lie in memory owns [`Pixels`](crate::target::Pixels), and passes their
/// [`memory`](Self::memory) on:
///
/// ```
/// use core::convert::Infallible;
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
/// use pinhole::{draw::fill_triangle, raster::{ScreenPoint, Span}, target::{Memory, Pixels, Surface}};
///
/// /// A framebuffer that remembers whether it was drawn to.
/// struct Framebuffer<'a> {
///     pixels: Pixels<'a, Rgb565, u16>,
///     is_drawn: bool,
/// }
///
/// impl<'a> Surface for Framebuffer<'a> {
///     type Color = Rgb565;
///     type Error = Infallible;
///     type Store = &'a mut [u16];
///
///     fn area(&self) -> Rectangle {
///         self.pixels.area()
///     }
///     fn fill(&mut self, span: Span, color: Rgb565) -> Result<(), Infallible> {
///         self.is_drawn = true;
///         self.pixels.fill(span, color)
///     }
///     fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = Rgb565>) -> Result<(), Infallible> {
///         self.is_drawn = true;
///         self.pixels.fill_run(span, colors)
///     }
///     fn memory(&mut self) -> Option<&mut Memory<&'a mut [u16]>> {
///         self.is_drawn = true;
///         self.pixels.memory()
///     }
/// }
///
/// let mut cells = [0_u16; 32 * 24];
/// let area = Rectangle::new(Point::zero(), Size::new(32, 24));
/// let mut target = Framebuffer { pixels: Pixels::new(&mut cells, area)?, is_drawn: false };
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let Ok(()) = fill_triangle([corner(0, 0), corner(40, 0), corner(0, 20)], Rgb565::RED, &mut target);
/// assert!(target.is_drawn && cells[31] == 0xf800);
/// # Ok::<(), pinhole::target::BufferError>(())
/// ```
///
/// Pixels that share bytes, as those of a monochrome display, have no memory that fast paths could write to:
///
/// ```
/// use core::convert::Infallible;
/// use embedded_graphics::{pixelcolor::BinaryColor, prelude::*, primitives::Rectangle};
/// use pinhole::{draw::draw_line, raster::Span, target::Surface};
///
/// /// 128 × 64 pixels in pages of 8 rows: a byte is a column of a page, with its top row in the lowest bit.
/// struct Pages([u8; 1024]);
///
/// impl Surface for Pages {
///     type Color = BinaryColor;
///     type Error = Infallible;
///     type Store = [BinaryColor; 0];
///
///     fn area(&self) -> Rectangle {
///         Rectangle::new(Point::zero(), Size::new(128, 64))
///     }
///     fn fill(&mut self, span: Span, color: BinaryColor) -> Result<(), Infallible> {
///         for y in span.y..span.y + span.height {
///             self.fill_run(Span { y, height: 1, ..span }, core::iter::repeat(color))?;
///         }
///         Ok(())
///     }
///     fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = BinaryColor>) -> Result<(), Infallible> {
///         for (x, color) in (span.x..span.x + span.width).zip(colors) {
///             let (byte, bit) = (&mut self.0[(span.y / 8 * 128 + x) as usize], 1 << span.y % 8);
///             *byte = if color.is_on() { *byte | bit } else { *byte & !bit };
///         }
///         Ok(())
///     }
/// }
///
/// let mut display = Pages([0; 1024]);
/// let [from, to] = [0, 127].map(|x| Point::new(x, 10));
/// let Ok(()) = draw_line(from, to, BinaryColor::On, &mut display);
/// assert_eq!(display.0[128..256], [1 << 2; 128]);
/// ```
#[diagnostic::on_unimplemented(
    message = "pinhole cannot draw into `{Self}`",
    label = "not a drawing target",
    note = "pass any `DrawTarget` of embedded-graphics, `Picture::pixels()` or `Band::pixels()`, by `&mut`"
)]
pub trait Surface {
    /// The colour of a pixel.
    type Color: StoredPixel<<Self::Store as PixelStore>::Cell>;

    /// The error of drawing.
    type Error;

    /// The storage of the pixels: a slice, or `[Self::Color; 0]` if they do not lie in memory.
    type Store: PixelStore;

    /// The rectangle that can be drawn to.
    fn area(&self) -> Rectangle;

    /// Sets the pixels of a span, a row or a column, which lies in the [`area`](Self::area), to one colour.
    ///
    /// # Errors
    ///
    /// The error of the target.
    fn fill(&mut self, span: Span, color: Self::Color) -> Result<(), Self::Error>;

    /// Sets the pixels of a span of one row, which lies in the [`area`](Self::area), to these colours from left to right. There
    /// are at least `span.width` colours.
    ///
    /// # Errors
    ///
    /// The error of the target.
    fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = Self::Color>) -> Result<(), Self::Error>;

    /// The least number of pixels in a run of a line for which one [`fill`](Self::fill) per run costs less than the line's pixels
    /// in one call of [`draw_pixels`](Self::draw_pixels). With 1, the default, every line is one `fill` per run, and
    /// `draw_pixels` is never called. The picture is equal with every value.
    const LEAST_RUN: u16 = 1;

    /// Sets pixels of a line, each once and all in the [`area`](Self::area), to their colours. The default fills each as a span.
    ///
    /// Pixels come in the order of a window: from top to bottom with one pixel per row, or from left to right with one per
    /// column.
    ///
    /// # Errors
    ///
    /// The error of the target.
    fn draw_pixels(&mut self, pixels: impl Iterator<Item = Pixel<Self::Color>>) -> Result<(), Self::Error> {
        for Pixel(Point { x, y }, color) in pixels {
            self.fill(Span { x, y, width: 1, height: 1 }, color)?;
        }
        Ok(())
    }

    /// The memory of the [`area`](Self::area)'s pixels, if they lie in memory. Fast paths then write to it directly;
    /// [`fill`](Self::fill) and [`fill_run`](Self::fill_run) are called only where no fast path applies. Fast paths convert
    /// colours by [`StoredPixel`], so `fill` and `fill_run` must store colours in that form, too.
    #[inline(always)]
    fn memory(&mut self) -> Option<&mut Memory<Self::Store>> {
        None
    }

    /// This surface with a depth buffer: draw calls draw into it the pixels that are nearer than the buffer, and store their depth.
    /// Nothing is drawn outside the depth buffer.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
    /// use pinhole::{meshes::CUBE, prelude::*, Angle};
    /// let size = Size::new(32, 32);
    /// let viewport = Viewport::new(Point::zero(), size)?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let mut pixels = [Gray8::BLACK; 32 * 32];
    /// let mut picture = Picture::new(&mut pixels, size)?;
    /// let mut depths = [0; 32 * 32];
    /// let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths)?;
    /// let cube = camera.place(&CUBE, &Affine::identity());
    /// cube.faces(|_| Gray8::WHITE).draw(&mut picture.pixels().depth_tested(&mut depth))?;
    /// assert!(depth.at(Point::new(16, 16)) < Some(DepthBuffer::NOTHING));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(always)]
    fn depth_tested<'t, 'b>(&'t mut self, depth: &'t mut DepthBuffer<'b>) -> DepthTestedSurface<'t, 'b, Self>
    where
        Self: Sized,
    {
        DepthTestedSurface { surface: self, depth }
    }
}

impl<D: DrawTarget> Surface for D {
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

    const LEAST_RUN: u16 = if is_infallible::<D::Error>() { IN_MEMORY } else { 1 };

    #[inline(always)]
    fn draw_pixels(&mut self, pixels: impl Iterator<Item = Pixel<D::Color>>) -> Result<(), D::Error> {
        self.draw_iter(pixels)
    }
}

/// Where draw calls draw: a [`Surface`], or a surface [with a depth buffer](Surface::depth_tested). Sealed: your own framebuffer
/// implements [`Surface`].
#[diagnostic::on_unimplemented(
    message = "pinhole cannot draw into `{Self}`",
    label = "not a drawing target",
    note = "pass any `DrawTarget` of embedded-graphics, `Picture::pixels()` or `Band::pixels()`, by `&mut`; for a depth test its `depth_tested(&mut depth)`"
)]
pub trait Target: TargetKind<Own = <Self as Target>::Surface> {
    /// The colour of a pixel.
    type Color: PixelColor;

    /// The error of drawing.
    type Error;

    /// The pixels.
    type Surface: Surface<Color = Self::Color, Error = Self::Error>;
}

/// How a [`Target`] is drawn to.
pub trait TargetKind {
    /// The pixels: [`Target::Surface`].
    type Own;

    /// A marker type that says whether the target has a depth buffer.
    type Test;

    /// Calls `untested` with the surface, or `tested` with the surface and its depth buffer; either gets `arguments`.
    fn dispatch<A, R>(
        &mut self,
        arguments: A,
        untested: impl FnOnce(A, &mut Self::Own) -> R,
        tested: impl FnOnce(A, &mut Self::Own, &mut DepthBuffer<'_>) -> R,
    ) -> R;
}

/// Marks a [`Target`] without a depth buffer. No value of this type exists.
#[derive(Clone, Copy, Debug)]
pub enum Untested {}

/// Marks a [`Target`] with a depth buffer. No value of this type exists.
#[derive(Clone, Copy, Debug)]
pub enum Tested {}

/// Marks no target. If a type implements a trait for one mark only, the compiler expects that mark, and does not print the trait's advice. A
/// second implementation, for `Unmatched`, makes the compiler print it. No value of this type exists.
#[derive(Clone, Copy, Debug)]
pub enum Unmatched {}

impl<S: Surface> Target for S {
    type Color = S::Color;
    type Error = S::Error;
    type Surface = S;
}

impl<S: Surface> TargetKind for S {
    type Own = S;
    type Test = Untested;

    #[inline(always)]
    fn dispatch<A, R>(
        &mut self,
        arguments: A,
        untested: impl FnOnce(A, &mut S) -> R,
        _: impl FnOnce(A, &mut S, &mut DepthBuffer<'_>) -> R,
    ) -> R {
        untested(arguments, self)
    }
}

/// A [`Surface`] with a depth buffer, as [`Surface::depth_tested`] makes it: a draw call draws the pixels that are nearer than the
/// buffer, and stores their depth.
#[must_use = "pass it to a draw call by `&mut`"]
#[derive(Debug)]
pub struct DepthTestedSurface<'t, 'b, S> {
    pub(crate) surface: &'t mut S,
    pub(crate) depth: &'t mut DepthBuffer<'b>,
}

impl<S: Surface> Target for DepthTestedSurface<'_, '_, S> {
    type Color = S::Color;
    type Error = S::Error;
    type Surface = S;
}

impl<S: Surface> TargetKind for DepthTestedSurface<'_, '_, S> {
    type Own = S;
    type Test = Tested;

    #[inline(always)]
    fn dispatch<A, R>(
        &mut self,
        arguments: A,
        _: impl FnOnce(A, &mut S) -> R,
        tested: impl FnOnce(A, &mut S, &mut DepthBuffer<'_>) -> R,
    ) -> R {
        tested(arguments, self.surface, self.depth)
    }
}

/// A [`Target`] with a depth buffer. What draws hidden lines has this bound, so that the compiler says how to make one.
#[diagnostic::on_unimplemented(
    message = "hidden lines need a depth buffer, which `{Self}` does not have",
    label = "no depth buffer",
    note = "pass `&mut target.depth_tested(&mut depth)`, where `depth` has the depths that `depth_only` stores"
)]
pub trait WithDepth: Target {}

impl<S: Surface> WithDepth for DepthTestedSurface<'_, '_, S> {}

// A surface need not implement `Format`.
defmt_format!([S] DepthTestedSurface<'_, '_, S>, self, "surface with a {}", self.depth);

/// A depth buffer, and whether its rows are laid out like those of the target's memory.
#[derive(Debug)]
pub(crate) struct DepthTarget<'d, 'b> {
    pub(crate) buffer: &'d mut DepthBuffer<'b>,
    /// Whether a pixel has the same index in the depth buffer as in the target's memory: the two begin with the same pixel, and their
    /// rows are equally far apart. Either may have more rows.
    pub(crate) is_aligned: bool,
}

impl<'d, 'b> DepthTarget<'d, 'b> {
    /// Compares the layouts of depth buffer and target: once per draw call, not for each triangle.
    #[inline(always)]
    pub(crate) fn new<T: Surface>(buffer: &'d mut DepthBuffer<'b>, target: &mut T) -> Self {
        let Rectangle { top_left, size } = buffer.area();
        // The width of the target is not that of its rows: they may lie in a wider framebuffer.
        let is_aligned = target.memory().is_some_and(|memory| {
            memory.area().top_left == top_left && memory.stride() == size.width as usize
        });
        Self { buffer, is_aligned }
    }
}

/// Puts ink into a pixel; returns `false` if the ink leaves the pixel out.
#[inline(always)]
pub(crate) fn put<Cell: Copy, C: StoredPixel<Cell>, I: InkKind<C>>(cell: &mut Cell, ink: I) -> bool {
    let stored = *cell;
    match ink.over(|| C::load(stored)) {
        Some(color) => {
            *cell = color.stored();
            true
        }
        None => false,
    }
}

/// Draws a run of inks of which none leaves its pixel out.
#[inline(always)]
pub(crate) fn draw_run<T: Surface, I: InkKind<T::Color>>(
    run: Span,
    inks: impl Iterator<Item = I>,
    target: &mut T,
) -> Result<(), T::Error> {
    if !I::READS {
        return target.fill_run(run, inks.map_while(InkKind::own));
    }
    if let Some(memory) = target.memory() {
        memory.put_run(run, inks, |cell, ink| {
            put(cell, ink);
        });
    }
    Ok(())
}

/// [`LEAST_RUN`](Surface::LEAST_RUN) of a DrawTarget in memory: there a run takes 130 to 190 instructions and a pixel of
/// `draw_iter` 14, on a Cortex-M3.
const IN_MEMORY: u16 = 16;

/// Whether an error type has no value. Then the compiler stores nothing to tell `Ok(())` from `Err`; a compiler that stored
/// something would cost speed, but change no picture.
const fn is_infallible<E>() -> bool {
    size_of::<Result<(), E>>() == 0
}

/// A span as a rectangle of `embedded-graphics`.
#[inline(always)]
fn rectangle(Span { x, y, width, height }: Span) -> Rectangle {
    Rectangle::new(Point::new(x, y), Size::new(width as u32, height as u32)) // both positive
}
