//! Pixels in memory, to draw into.

use super::depth::{Against, DepthBuffer};
use super::memory::{fill, Memory};
use super::reach;
use super::shades::Shades;
use super::target::{spans_nearer, spans_shaded_nearer, Target};
use crate::raster::{Piece, Pixel, Scissor, ScreenPoint, Span, Triangle};
use core::convert::Infallible;
use core::marker::PhantomData;
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;

/// Pixels in memory as a [`Target`]: of a [`Picture`](crate::Picture), or of a [`Band`](crate::Band).
#[derive(Debug)]
pub struct Pixels<'a, C, Cell = C> {
    area: Rectangle,
    /// Of the area: worked out once, not for each triangle.
    reach: Scissor,
    memory: Memory<'a, Cell>,
    colour: PhantomData<C>,
}

/// A colour as memory holds it: as it is, or in bytes as the wire takes them.
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
/// use pinhole::Stored;
/// assert_eq!((Rgb565::RED.stored(), Rgb565::RED.stored()), (Rgb565::RED, [0xf8, 0x00]));
/// ```
pub trait Stored<Cell>: PixelColor {
    /// The colour as a cell of memory.
    fn stored(self) -> Cell;
}

impl<C: PixelColor> Stored<C> for C {
    #[inline(always)]
    fn stored(self) -> C {
        self
    }
}

impl<'a, C, Cell: Copy> Pixels<'a, C, Cell> {
    /// Of `area`, a cell each.
    #[inline(always)]
    pub(super) fn new(cells: &'a mut [Cell], area: Rectangle) -> Self {
        Self { area, reach: reach(&area), memory: Memory::new(cells, &area), colour: PhantomData }
    }
}

impl<C: Stored<Cell>, Cell: Copy> Target for Pixels<'_, C, Cell> {
    type Color = C;
    type Error = Infallible;

    fn area(&self) -> Rectangle {
        self.area
    }

    #[inline(always)]
    fn reach(&self) -> Scissor {
        self.reach
    }

    #[inline(always)]
    fn fill(&mut self, Span { x, y, width, height }: Span, colour: C) -> Result<(), Infallible> {
        // Only rows of the area: a span may be of any height.
        let rows = self.reach.rows();
        for y in y.max(rows.start)..y.saturating_add(height).min(rows.end) {
            if let Some(run) = self.memory.row(x, y, width) {
                fill(run, [colour.stored(); 2]);
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn fill_run(&mut self, span: Span, colours: impl Iterator<Item = C>) -> Result<(), Infallible> {
        if let Some(run) = self.memory.row(span.x, span.y, span.width) {
            run.iter_mut().zip(colours).for_each(|(pixel, colour)| *pixel = colour.stored());
        }
        Ok(())
    }

    #[inline(always)]
    fn triangle(&mut self, triangle: &Triangle<'_>, scissor: &Scissor, colour: C) -> Result<(), Infallible> {
        self.memory.triangle(triangle, scissor, [colour.stored(); 2]);
        Ok(())
    }

    // Without a copy of the reach.
    #[inline(always)]
    fn plain_triangle(&mut self, corners: [ScreenPoint; 3], area: i64, colour: C) -> Result<(), Infallible> {
        let Self { reach, memory, .. } = self;
        memory.triangle(&Triangle::new(corners, area, reach), reach, [colour.stored(); 2]);
        Ok(())
    }

    fn against<'d, 'b>(&self, depth: &'d mut DepthBuffer<'b>) -> Against<'d, 'b> {
        Against::new(depth, Some(&self.area))
    }

    #[inline(always)]
    fn nearer(
        &mut self,
        piece: &Piece<'_>,
        scissor: &Scissor,
        against: &mut Against<'_, '_>,
        colour: C,
    ) -> Result<(), Infallible> {
        if against.beside {
            self.memory.nearer(piece, scissor, against.buffer, [colour.stored(); 2]);
            Ok(())
        } else {
            self.nearer_apart(piece, scissor, against, colour)
        }
    }

    #[inline(always)]
    fn shaded<R: Iterator<Item = C>>(
        &mut self,
        triangle: &Triangle<'_>,
        scissor: &Scissor,
        run: impl Fn(Span) -> R,
    ) -> Result<(), Infallible> {
        self.memory.shaded(triangle, scissor, |span| run(span).map(Stored::stored));
        Ok(())
    }

    #[inline(always)]
    fn shaded_nearer<R: Iterator<Item = C>>(
        &mut self,
        piece: &Piece<'_>,
        scissor: &Scissor,
        against: &mut Against<'_, '_>,
        run: impl Fn(Span) -> R,
    ) -> Result<(), Infallible> {
        if against.beside {
            let run = |span| run(span).map(Stored::stored);
            self.memory.shaded_nearer(piece, scissor, against.buffer.held(), run);
            Ok(())
        } else {
            self.shaded_nearer_apart(piece, scissor, against, run)
        }
    }

    #[inline(always)]
    fn shades_nearer(
        &mut self,
        piece: &Piece<'_>,
        scissor: &Scissor,
        against: &mut Against<'_, '_>,
        shades: &Shades<'_, C>,
    ) -> Result<(), Infallible> {
        if against.beside {
            self.memory.nearer(piece, scissor, against.buffer, shades);
            Ok(())
        } else {
            let shade = shades.over(&piece.triangle);
            self.shaded_nearer_apart(piece, scissor, against, |span| shade.run(span))
        }
    }

    #[inline(always)]
    fn line(&mut self, from: Pixel, to: Pixel, scissor: &Scissor, colour: C) -> Result<(), Infallible> {
        self.memory.line(from, to, scissor, colour.stored());
        Ok(())
    }
}

/// Where depths stand otherwise than pixels: rare, and in frames of their own.
impl<C: Stored<Cell>, Cell: Copy> Pixels<'_, C, Cell> {
    #[cold]
    #[inline(never)]
    fn nearer_apart(
        &mut self,
        piece: &Piece<'_>,
        scissor: &Scissor,
        against: &mut Against<'_, '_>,
        colour: C,
    ) -> Result<(), Infallible> {
        spans_nearer(self, piece, scissor, against, colour)
    }

    #[cold]
    #[inline(never)]
    fn shaded_nearer_apart<R: Iterator<Item = C>>(
        &mut self,
        piece: &Piece<'_>,
        scissor: &Scissor,
        against: &mut Against<'_, '_>,
        run: impl Fn(Span) -> R,
    ) -> Result<(), Infallible> {
        spans_shaded_nearer(self, piece, scissor, against, run)
    }
}

// Of colours nothing is said: a colour need not have a Format.
#[cfg(feature = "defmt")]
impl<C, Cell> defmt::Format for Pixels<'_, C, Cell> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "pixels of {}", self.area);
    }
}
