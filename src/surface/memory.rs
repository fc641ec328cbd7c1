//! Pixels in memory, row by row without gaps, and plain functions that write to them. A *cell* is one stored pixel.

use super::block_fill::fill;
use super::buffer_error::BufferError;
use super::{drawable, inside};
use crate::color::{Access, Writes};
use crate::raster::{PixelLayout, RowScratch, Scissor, Span};
use embedded_graphics_core::primitives::Rectangle;

/// The storage of a [`Surface`](crate::target::Surface)'s pixels: a mutable slice with one cell per pixel, or `[Color; 0]` for a target
/// without memory.
///
/// The type tells the compiler whether there is memory, so a target without it links no code that draws into memory.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot store the pixels of a target",
    label = "not a mutable slice of cells",
    note = "use `&mut [Cell]`, or `[Color; 0]` for a target whose pixels do not lie in memory"
)]
pub trait PixelStore: Gives<Writes> {
    /// The stored form of one pixel: the colour itself, an integer, or the bytes that the display takes.
    type Cell: Copy;

    /// All cells, row by row.
    fn cells(&mut self) -> &mut [Self::Cell];
}

/// The storage of a target that gives a shader, a stroke or a sprite what it needs: every one takes colours, and slices give
/// stored pixels, too.
#[diagnostic::on_unimplemented(
    message = "a translucent shader, an anti-aliased line or a smoothed edge reads pixels, which this target cannot give",
    label = "its pixels cannot be read",
    note = "draw into the `pixels()` of a `Picture` or of a `Band`; or use a `ScreenDoor`, or a plain color for lines",
    note = "where the shader's type is a parameter, ask for a `ShaderFor<T>` of the target's type, or for `SpanShader<C, Ink = C>`"
)]
pub trait Gives<A: Access> {}

impl<Cell, A: Access> Gives<A> for &mut [Cell] {}

impl<Cell> Gives<Writes> for [Cell; 0] {}

impl<Cell: Copy> PixelStore for &mut [Cell] {
    type Cell = Cell;

    #[inline(always)]
    fn cells(&mut self) -> &mut [Cell] {
        self
    }
}

/// No memory: the store of a target that takes spans and whose pixels cannot be accessed, such as a display driver.
impl<Cell: Copy> PixelStore for [Cell; 0] {
    type Cell = Cell;

    #[inline(always)]
    fn cells(&mut self) -> &mut [Cell] {
        self
    }
}

/// The pixels of a rectangle in memory, row by row: what [`Pixels`](crate::target::Pixels) return from
/// [`memory`](crate::target::Surface::memory). A [`Surface`](crate::target::Surface) that owns `Pixels` passes it on, and is drawn to as fast.
#[derive(Debug)]
pub struct Memory<S> {
    /// The part of the area with coordinates in the range of 2D drawing, ±32768; computed once, not for each triangle.
    drawable: Scissor,
    rows: PixelRows<S>,
}

/// The cells of a [`Memory`] and their layout: what loops over rows take, while the rest of the memory is read.
#[derive(Debug)]
pub(crate) struct PixelRows<S> {
    area: Rectangle,
    store: S,
    /// The layout of the cells; on a Cortex-M0 also room for a triangle's rows.
    scratch: RowScratch,
}

impl<S: PixelStore> PixelRows<S> {
    /// The cells, and the layout and scratch space for loops over them.
    #[inline(always)]
    pub(crate) fn parts(&mut self) -> (&mut [S::Cell], &mut RowScratch) {
        (self.store.cells(), &mut self.scratch)
    }

    /// The layout and scratch space alone.
    #[inline(always)]
    pub(crate) fn scratch(&mut self) -> &mut RowScratch {
        &mut self.scratch
    }
}

impl<S> Memory<S> {
    /// The rectangle whose pixels these are.
    pub(crate) const fn area(&self) -> Rectangle {
        self.rows.area
    }

    /// How many cells apart rows begin: the area's width, or more.
    pub(crate) const fn stride(&self) -> usize {
        self.rows.scratch.layout.stride
    }
}

impl<S: PixelStore> Memory<S> {
    /// The pixels of `area`, whose first row begins with the first cell. Cells beyond those of the area are never written.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when there are fewer cells than the area has pixels.
    pub(super) fn new(mut store: S, area: Rectangle) -> Result<Self, BufferError> {
        BufferError::check_picture(area.size, store.cells().len())?;
        Ok(Self::unchecked(store, area, area.size.width as usize))
    }

    /// [`new`](Self::new) for callers that have checked the number of cells. Rows begin `stride` cells apart. Pixels
    /// without a cell are not drawn.
    #[inline(always)]
    pub(super) fn unchecked(store: S, area: Rectangle, stride: usize) -> Self {
        let layout = PixelLayout::new(area.top_left.x, area.top_left.y, stride);
        Self { drawable: drawable(&area), rows: PixelRows { area, store, scratch: RowScratch::new(layout) } }
    }

    /// The part of the area with coordinates in the range of 2D drawing, ±32768.
    #[inline(always)]
    pub(crate) const fn drawable(&self) -> &Scissor {
        &self.drawable
    }

    /// The cells of `width` pixels from (`x`, `y`) to the right, or `None` where not all of them lie in the
    /// [`area`](Self::area).
    #[inline(always)]
    fn row(&mut self, x: i32, y: i32, width: i32) -> Option<&mut [S::Cell]> {
        let Rectangle { top_left, size } = self.rows.area;
        // The subtraction wraps: a pixel to the left of or above the area gets a column or row beyond any size.
        let (column, row) = (x.wrapping_sub(top_left.x) as u32, y.wrapping_sub(top_left.y) as u32);
        let fits =
            row < size.height && column <= size.width && width as u32 <= size.width.wrapping_sub(column);
        let from = self.rows.scratch.layout.at(x, y);
        self.rows.store.cells().get_mut(from..from.wrapping_add(width as usize)).filter(|_| fits)
    }

    /// Sets the pixels of a span to one stored pixel; pixels outside the [`area`](Self::area) are ignored.
    #[inline(always)]
    pub(super) fn fill(&mut self, span: Span, cell: S::Cell) {
        let Span { x, y, width, height } = span;
        let clipped = Scissor::unclamped(x, y, x.saturating_add(width), y.saturating_add(height));
        let clipped = clipped.clipped_to(&inside(&self.area()));
        let (columns, rows) = (clipped.columns(), clipped.rows());
        for y in rows {
            if let Some(run) = self.row(columns.start, y, columns.end.wrapping_sub(columns.start)) {
                fill(run, cell);
            }
        }
    }

    /// Sets the pixels of a span of one row from left to right, until the span or the iterator ends. A span that does not lie
    /// entirely in the [`area`](Self::area) is not drawn.
    #[inline(always)]
    pub(super) fn fill_run(&mut self, span: Span, cells: impl Iterator<Item = S::Cell>) {
        self.put_run(span, cells, |pixel, cell| *pixel = cell);
    }

    /// [`fill_run`](Self::fill_run) by a function that puts a value into a cell.
    #[inline(always)]
    pub(super) fn put_run<V>(
        &mut self,
        span: Span,
        values: impl Iterator<Item = V>,
        put: impl Fn(&mut S::Cell, V),
    ) {
        if let Some(run) = self.row(span.x, span.y, span.width) {
            run.iter_mut().zip(values).for_each(|(cell, value)| put(cell, value));
        }
    }

    /// The cells with their layout, and the part of the area that 2D drawing can reach.
    #[inline(always)]
    pub(crate) fn split(&mut self) -> (&Scissor, &mut PixelRows<S>) {
        (&self.drawable, &mut self.rows)
    }
}

// The cells are not printed: there are as many as pixels.
defmt_format!([S] Memory<S>, self, "memory of {} at {}", self.rows.area.size, self.rows.area.top_left);

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_graphics_core::geometry::{Point, Size};

    #[test]
    fn a_row_lies_in_the_area_or_is_refused() {
        let area = Rectangle::new(Point::new(-3, 5), Size::new(4, 3));
        let mut cells = [0_u8; 14];
        (0..).zip(&mut cells).for_each(|(i, cell)| *cell = i);
        let mut memory = Memory::new(&mut cells[..], area).unwrap();
        for y in 3..10 {
            for x in -6..4 {
                for width in -2..6 {
                    let is_inside = width >= 0 && (5..8).contains(&y) && x >= -3 && x + width <= 1;
                    let first = (x + 3 + 4 * (y - 5)) as u8;
                    let row = memory.row(x, y, width);
                    assert_eq!(row.as_ref().map(|row| row.len()), is_inside.then_some(width as usize));
                    assert!(row.is_none_or(|row| row.iter().copied().eq((first..).take(width as usize))));
                }
            }
        }
        for (x, y) in [(i32::MIN, i32::MIN), (i32::MAX, i32::MAX), (-3, i32::MIN), (i32::MAX, 5)] {
            assert_eq!(memory.row(x, y, 1), None);
        }
    }
}
