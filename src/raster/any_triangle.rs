//! Splits any triangle inside the guard band into trapezoids, and these into spans.

use super::edge::{first_row, Edge};
use super::triangle::sort_by_y;
use super::{Scissor, ScreenPoint, Span, Trapezoid, Triangle};

/// The trapezoids of a triangle inside a scissor, top to bottom. A trapezoid ends at the middle corner, and where an edge
/// enters or leaves the scissor's columns.
pub(crate) struct AnyTriangle {
    /// The corners, sorted by y, and whether the middle one lies to the left of the edge between the other two.
    corners: [ScreenPoint; 3],
    middle_is_left: bool,
    /// Whether the triangle reaches beyond the scissor's columns. If so, both edges are set up for each trapezoid, because clipping
    /// replaces them.
    pub(crate) is_beyond: bool,
    long_is_set_up: bool,
    left: i32,
    right: i32,
    /// The next row, and the row below the last one.
    row: i32,
    end: i32,
}

impl AnyTriangle {
    #[inline(never)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor) -> Self {
        let bounds = Scissor::bounding_box(&triangle.corners);
        let (corners, middle_is_left) = sort_by_y(triangle.corners, triangle.area);
        let beside = bounds.left >= scissor.right || bounds.right <= scissor.left;
        Self {
            corners,
            middle_is_left,
            is_beyond: bounds.left < scissor.left || bounds.right > scissor.right,
            long_is_set_up: false,
            left: scissor.left,
            right: scissor.right,
            row: bounds.top.max(scissor.top),
            end: if beside { i32::MIN } else { bounds.bottom.min(scissor.bottom) },
        }
    }

    /// Whether no row is left.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.row >= self.end
    }

    /// Writes the next trapezoid, which has at least one row, to `trapezoid`; returns `false` if none is left. `trapezoid` is the one
    /// written before, with its edges at the row below it: the caller provides the memory, because a trapezoid is too large to be
    /// returned in registers.
    #[inline(never)]
    pub(crate) fn trapezoid(&mut self, trapezoid: &mut Trapezoid<Edge>) -> bool {
        let &mut Self { corners: [ref a, ref b, ref c], row, end, .. } = self;
        if row >= end {
            return false;
        }
        let middle = first_row(b);
        let (p, q, end) = if row < middle { (a, b, middle.min(end)) } else { (b, c, end) };
        let [left, right] = &mut trapezoid.edges;
        let (short, long) = if self.middle_is_left { (left, right) } else { (right, left) };
        short.set_up(p, q, row);
        if !self.long_is_set_up {
            long.set_up(a, c, row);
        }
        (trapezoid.y, trapezoid.rows) = (row, end - row);
        if self.is_beyond {
            trapezoid.clip_columns(self.left, self.right);
        } else {
            self.long_is_set_up = true;
        }
        self.row += trapezoid.rows;
        true
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
