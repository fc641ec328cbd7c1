//! Splits any triangle inside the guard band into trapezoids, and these into spans.

use super::edge::{first_row, Edge32};
use super::triangle::sort_by_y;
use super::{Scissor, ScreenPoint, Span, Trapezoid, Triangle};

/// The trapezoids of a triangle inside a scissor, top to bottom. A trapezoid ends at the middle corner, where an edge
/// enters or leaves the scissor's columns, and where an edge must be set up again to stay exact.
pub(crate) struct AnyTriangle {
    /// The next row, and the row below the last one.
    row: i32,
    end: i32,
    /// The edge that ends or begins at the middle corner, and the edge from the top to the bottom corner, both in the row `row`.
    short: Edge32,
    long: Edge32,
    /// The rows at which `short` and `long` must be set up again.
    until: [i32; 2],
    /// The scissor's columns, and whether the triangle reaches beyond them.
    left: i32,
    right: i32,
    is_beyond: bool,
    /// Whether the middle corner lies to the left of `long`.
    middle_is_left: bool,
    /// The corners, sorted by y.
    corners: [ScreenPoint; 3],
}

impl AnyTriangle {
    #[inline(never)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor) -> Self {
        let bounds = Scissor::bounding_box(&triangle.corners);
        let (corners, middle_is_left) = sort_by_y(triangle.corners, triangle.area);
        let beside = bounds.left >= scissor.right || bounds.right <= scissor.left;
        Self {
            row: bounds.top.max(scissor.top),
            end: if beside { i32::MIN } else { bounds.bottom.min(scissor.bottom) },
            short: Edge32::default(),
            long: Edge32::default(),
            until: [i32::MIN; 2],
            left: scissor.left,
            right: scissor.right,
            is_beyond: bounds.left < scissor.left || bounds.right > scissor.right,
            middle_is_left,
            corners,
        }
    }

    /// Whether no row is left.
    pub(crate) fn is_empty(&self) -> bool {
        self.row >= self.end
    }

    /// Writes the next trapezoid, which has at least one row, to `trapezoid`; returns `false` if none is left. The caller
    /// provides the memory, because a trapezoid is too large to be returned in registers.
    #[inline(never)]
    pub(crate) fn trapezoid(&mut self, trapezoid: &mut Trapezoid<Edge32>) -> bool {
        if self.is_empty() {
            return false;
        }
        self.set_up_edges();
        self.take_rows(trapezoid);
        true
    }

    /// Writes the rows up to the next row where an edge must be set up, or crosses the left or right border of the scissor, and
    /// advances both edges.
    #[inline(never)] // its stack frame is not live while edges are set up
    fn take_rows(&mut self, trapezoid: &mut Trapezoid<Edge32>) {
        let Self { row: y, short, long, until: [short_until, long_until], .. } = *self;
        let rows = self.end.min(short_until).min(long_until) - y;
        let edges = if self.middle_is_left { [short, long] } else { [long, short] };
        *trapezoid = Trapezoid { x: 0, y, rows, edges };
        if self.is_beyond {
            trapezoid.clip_columns(self.left, self.right);
        }
        self.short.advance(trapezoid.rows);
        self.long.advance(trapezoid.rows);
        self.row += trapezoid.rows;
    }

    /// Where the next row is the one in `until`, sets up the short or the long edge from there on.
    #[inline(never)]
    fn set_up_edges(&mut self) {
        let Self { row, corners: [a, b, c], until: [short_until, long_until], .. } = *self;
        let furthest = row + Edge32::MAX_ROWS;
        if row >= short_until {
            let middle = first_row(&b);
            let (p, q, end) = if row < middle { (a, b, middle.min(furthest)) } else { (b, c, furthest) };
            self.short = Edge32::new(&p, &q, row);
            self.until = [end, long_until];
        }
        if row >= long_until {
            self.long = Edge32::new(&a, &c, row);
            let [short_until, _] = self.until;
            self.until = [short_until, furthest];
        }
    }
}

/// The spans of a triangle inside a scissor, top to bottom: the definition that every fast path reproduces.
pub(crate) struct Spans {
    /// The present trapezoid, without the rows already returned.
    trapezoid: Trapezoid<Edge32>,
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

impl Iterator for Spans {
    type Item = Span;

    #[inline]
    fn next(&mut self) -> Option<Span> {
        loop {
            if let Some(span) = self.trapezoid.span() {
                return Some(span);
            }
            if !self.below.trapezoid(&mut self.trapezoid) {
                return None;
            }
        }
    }
}
