//! Splits any triangle inside the guard band into trapezoids, and these into spans.

use super::edge::{first_row, Edge};
use super::triangle::{area, sort_by_y};
use super::{Scissor, ScreenPoint, Span, Trapezoid, Triangle};

/// The trapezoids of a triangle inside a scissor, top to bottom. A trapezoid ends at the middle corner, and where an edge
/// enters or leaves the scissor's columns.
pub(crate) struct AnyTriangle {
    /// The left and the right edge in the row `row`.
    edges: [Edge; 2],
    /// The next row, the row where an edge bends, and the row below the last one.
    row: i32,
    bend: i32,
    end: i32,
    /// The corners at which the short edge below the bend begins and ends, and whether it is the left edge.
    middle: ScreenPoint,
    last: ScreenPoint,
    middle_is_left: bool,
    /// The scissor's columns, and whether the triangle reaches beyond them.
    is_beyond: bool,
    left: i32,
    right: i32,
}

impl AnyTriangle {
    #[inline(never)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor) -> Self {
        let bounds = Scissor::bounding_box(&triangle.corners);
        let (row, end) = (bounds.top.max(scissor.top), bounds.bottom.min(scissor.bottom));
        let is_beside = bounds.left >= scissor.right || bounds.right <= scissor.left;
        let end = if is_beside { i32::MIN } else { end };
        let ([first, middle, last], middle_is_left) = sort_by_y(triangle.corners, triangle.area);
        let (mut edges, bend) = ([Edge::vertical(0); 2], first_row(&middle).min(end));
        if row < end {
            let long = Edge::new(&first, &last, row);
            // Above the bend: below, `trapezoid` sets up the short edge.
            let short = if row < bend { Edge::new(&first, &middle, row) } else { long };
            edges = if middle_is_left { [short, long] } else { [long, short] };
        }
        Self {
            edges,
            row,
            bend,
            end,
            middle,
            last,
            middle_is_left,
            is_beyond: bounds.left < scissor.left || bounds.right > scissor.right,
            left: scissor.left,
            right: scissor.right,
        }
    }

    #[inline(always)]
    fn short_and_long(&mut self) -> [&mut Edge; 2] {
        let [left, right] = &mut self.edges;
        if self.middle_is_left {
            [left, right]
        } else {
            [right, left]
        }
    }

    /// Whether no row is left.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.row >= self.end
    }

    /// Writes the next trapezoid, which has at least one row, to `trapezoid`, as long as a row is [left](Self::is_empty). The caller
    /// provides the memory, because a trapezoid is too large to be returned in registers.
    #[inline(never)]
    pub(crate) fn trapezoid(&mut self, trapezoid: &mut Trapezoid<Edge>) {
        let Self { row, bend, end, middle, last, .. } = *self;
        if row >= bend {
            let [short, _] = self.short_and_long();
            *short = Edge::new(&middle, &last, row);
            self.bend = end;
        }
        trapezoid.edges = self.edges;
        (trapezoid.x, trapezoid.y, trapezoid.rows) = (0, row, self.bend - row);
        if self.is_beyond {
            trapezoid.clip_columns(self.left, self.right);
        }
        self.row += trapezoid.rows;
        if !self.is_empty() {
            let is_bend = self.row >= self.bend;
            let [short, long] = self.short_and_long();
            long.advance(trapezoid.rows);
            if !is_bend {
                short.advance(trapezoid.rows);
            }
        }
    }
}

/// The spans of a triangle inside a scissor, top to bottom: the definition that every fast path reproduces.
pub(crate) struct Spans {
    /// The present trapezoid, without the rows already returned.
    trapezoid: Trapezoid<Edge>,
    /// The part of the triangle below it.
    below: AnyTriangle,
}

impl Spans {
    #[inline]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor) -> Self {
        Self { trapezoid: Trapezoid::without_rows(), below: AnyTriangle::new(triangle, scissor) }
    }

    /// Whether the triangle has no row inside the scissor; valid before the first span is taken.
    pub(crate) fn is_empty(&self) -> bool {
        self.below.is_empty()
    }
}

impl Triangle<'_> {
    /// The covered pixels inside the scissor: one span per row, top to bottom.
    #[inline(always)]
    pub(crate) fn spans(&self, scissor: &Scissor) -> Spans {
        Spans::new(self, scissor)
    }
}

/// Calls `span` for each row's covered pixels inside the scissor, top to bottom: rules R1 to R9.
///
/// # Errors
///
/// The first error of `span`, which ends the walk.
///
/// ```
/// use pinhole::raster::{triangle, Scissor, ScreenPoint};
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let scissor = Scissor::new(0, 0, 16, 16);
/// let mut rows = Vec::new();
/// triangle([corner(0, 0), corner(4, 0), corner(0, 4)], &scissor, |s| -> Result<(), ()> {
///     rows.push((s.y, s.x, s.width));
///     Ok(())
/// })?;
/// // The slanted edge passes through pixel centres and is a right edge: they are not covered.
/// assert_eq!(rows, [(0, 0, 3), (1, 0, 2), (2, 0, 1)]);
/// # Ok::<(), ()>(())
/// ```
pub fn triangle<E>(
    vertices: [ScreenPoint; 3],
    scissor: &Scissor,
    span: impl FnMut(Span) -> Result<(), E>,
) -> Result<(), E> {
    match area(&vertices) {
        0 => Ok(()), // R6
        area => Triangle::new(vertices, area, scissor).spans(scissor).try_for_each(span),
    }
}

impl Iterator for Spans {
    type Item = Span;

    #[inline]
    fn next(&mut self) -> Option<Span> {
        loop {
            if let Some(span) = self.trapezoid.span() {
                return Some(span);
            }
            if self.below.is_empty() {
                return None;
            }
            self.below.trapezoid(&mut self.trapezoid);
        }
    }
}
