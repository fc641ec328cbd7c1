//! Triangles of few rows where a division is a library call, as on a Cortex-M0: Bresenham's error term per edge.
//!
//! The ends of all rows are computed beforehand, one edge after the other, so that each edge has all registers for itself.
//! A [`RowScratch`] stores them.
//!
//! The edges are those of the plain twin, `raster/edge.rs`; but most quotients are so small that subtraction finds them.
//!
//! - **Plain twin**: [`AnyTriangle`](crate::raster::AnyTriangle), and its spans, [`Triangle::spans`].
//! - **Domain**: all corners between the scissor's columns and within 31 rows. Without `CLIP_ROWS` all corners lie inside the
//!   scissor.
//! - **Gain**: on a Cortex-M0 scene S3 takes 12 % more instructions, S4 and S7 11 % more, if edges are divided by reciprocals
//!   instead (`docs/decisions.md`). Other cores do not use it.
//! - **Test**: `rows_inside_are_exact` and `clipped_rows_are_exact` in this file, against rules R1 to R5, on every core.

use super::rows::{RowOrigin, Rows};
use crate::math::hints::keep_rolled;
use crate::math::num::{divide_by_subtraction, divide_floor};
use crate::raster::edge::{first_row, Edge, EdgeWalker};
use crate::raster::triangle::sort_by_y;
use crate::raster::{PixelLayout, RowScratch, Scissor, ScreenPoint, Span, Triangle, GUARD_BAND};

/// A triangle of at most 31 rows between the scissor's columns, whose row ends are stored in a [`RowScratch`].
/// `CLIP_ROWS`: rows may lie above and below the scissor.
#[derive(Clone, Copy)]
pub(crate) struct BresenhamTriangle<const CLIP_ROWS: bool> {
    /// The first row.
    top: i32,
    /// The entries of the [`RowScratch`] that hold the ends of the rows: the first one, and the one after the last.
    first: usize,
    end: usize,
}

impl<const CLIP_ROWS: bool> BresenhamTriangle<CLIP_ROWS> {
    /// Computes and stores the row ends; `None` for a triangle outside of the domain, which the module states.
    #[inline(always)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor, scratch: &mut RowScratch) -> Option<Self> {
        if cfg!(pinhole_plain) {
            return None;
        }
        if !CLIP_ROWS {
            let (top, rows) = scratch.walk(triangle, scissor);
            return Some(Self { top, first: 0, end: usize::try_from(rows).ok()? });
        }
        let all_rows = Scissor { top: -GUARD_BAND, bottom: GUARD_BAND, ..*scissor };
        let (top, rows) = scratch.walk(triangle, &all_rows);
        let end = usize::try_from(rows).ok()?;
        let below_top = |y: i32| (y - top).max(0) as usize;
        let (first, end) = (below_top(scissor.top), end.min(below_top(scissor.bottom)));
        Some(Self { top: top.max(scissor.top), first, end })
    }
}

impl<const CLIP_ROWS: bool> Rows for BresenhamTriangle<CLIP_ROWS> {
    const WIDTH: i32 = i32::MAX;

    #[inline(always)]
    fn is_empty(&self) -> bool {
        self.first >= self.end
    }

    #[inline(always)]
    fn start(&self, layout: PixelLayout) -> RowOrigin {
        // Row ends are buffer indices: index i in row y is column i − origin − y·stride.
        RowOrigin { x: layout.origin.wrapping_neg() as i32, y: self.top, shear: layout.stride }
    }

    #[inline(always)]
    fn each(self, scratch: &mut RowScratch, mut row: impl FnMut(usize, i32, i32)) {
        if let Some(ends) = scratch.ends.get(self.first..self.end) {
            for &[left, right] in ends {
                row(0, left as i32, right as i32);
            }
        }
    }
}

impl RowScratch {
    /// Stores the ends of all rows, if the triangle has at most [`ROWS`](Self::ROWS) rows and lies inside the scissor. Returns
    /// the first row and the number of rows; the number is −1 if nothing was stored.
    #[inline(never)]
    fn walk(&mut self, triangle: &Triangle<'_>, scissor: &Scissor) -> (i32, i32) {
        let ([a, b, c], middle_is_left) = sort_by_y(triangle.corners.each_ref(), triangle.area);
        // The sign bit is set if a difference is negative: one test for all comparisons. Differences are below 2²⁴. Row
        // ends lie within a column of the corners.
        let mut room = ((Self::ROWS as i32) << 8) - (c.y - a.y);
        for corner in [a, b, c] {
            room |= (corner.x - (scissor.left << 8)) | ((scissor.right << 8) - corner.x);
        }
        room |= (a.y - (scissor.top << 8)) | ((scissor.bottom << 8) - c.y);
        if room < 0 {
            return (0, -1);
        }
        let top = first_row(a);
        // The index of column 0 in the first row; the middle corner's row follows from the number of rows above.
        let start = self.layout.at(0, top);
        let mut short_edges = |side: usize| {
            let above = self.walk_edge(a, b, start, 0, side);
            self.walk_edge(b, c, start.wrapping_add(above.wrapping_mul(self.layout.stride)), above, side);
        };
        let long_side = if middle_is_left {
            short_edges(0);
            1
        } else {
            short_edges(1);
            0
        };
        (top, self.walk_edge(a, c, start, 0, long_side) as i32)
    }

    /// Stores the row ends of the edge from `p` down to `q` in the entries from `at` on, as left ends if `side` is 0 and as
    /// right ends if it is 1. `start` is the buffer index of column 0 in the first row. Returns the number of rows.
    #[inline(always)]
    fn walk_edge(&mut self, p: &ScreenPoint, q: &ScreenPoint, start: usize, at: usize, side: usize) -> usize {
        // |dx / dy| < 16: each quotient takes about 16 subtractions at most.
        let (dx, dy) = (q.x - p.x, q.y - p.y);
        match ((dx + (dy << 4)) as u32) < (dy << 5) as u32 {
            true => self.store_edge(p, q, start, at, side, divide_by_subtraction),
            false => self.walk_flat_edge(p, q, start, at, side),
        }
    }

    /// [`walk_edge`](Self::walk_edge) for edges so flat that subtraction would take long, and for horizontal ones.
    #[cold]
    #[inline(never)]
    fn walk_flat_edge(
        &mut self,
        p: &ScreenPoint,
        q: &ScreenPoint,
        start: usize,
        at: usize,
        side: usize,
    ) -> usize {
        self.store_edge(p, q, start, at, side, divide_floor)
    }

    /// [`walk_edge`](Self::walk_edge), given a function for ⌊n / d⌋ and its remainder.
    #[inline(always)]
    fn store_edge(
        &mut self,
        p: &ScreenPoint,
        q: &ScreenPoint,
        start: usize,
        at: usize,
        side: usize,
        divide: impl Fn(i32, i32) -> (i32, i32),
    ) -> usize {
        let row = first_row(p);
        let rows = first_row(q) - row;
        if rows <= 0 {
            return 0;
        }
        let rows = rows as usize;
        let Some(ends) = self.ends.get_mut(at..at.wrapping_add(rows)) else { return 0 };
        let mut edge = Edge::at_first_row(p, q, divide).as_indices(start, self.layout.stride);
        for ends in ends {
            keep_rolled();
            ends[side & 1] = edge.column() as usize;
            edge.next();
        }
        rows
    }
}

/// The spans of a triangle of at most 31 rows, with the [`RowScratch`] that holds the ends of its rows.
pub(crate) struct LowSpans {
    columns: RowScratch,
    /// The next row, and where its ends are stored.
    y: i32,
    next: usize,
    end: usize,
}

impl LowSpans {
    pub(crate) fn new(
        BresenhamTriangle { top, first, end }: BresenhamTriangle<true>,
        columns: RowScratch,
    ) -> Self {
        Self { columns, y: top, next: first, end }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.next >= self.end
    }

    /// Calls `draw` with each span, until it returns an error.
    #[allow(dead_code)] // on other cores only tests use this file
    #[inline(always)]
    pub(crate) fn try_each<E>(&mut self, mut draw: impl FnMut(Span) -> Result<(), E>) -> Result<(), E> {
        while let Some(span) = self.span() {
            draw(span)?;
        }
        Ok(())
    }

    /// The span of the next row in which the triangle covers a pixel.
    pub(crate) fn span(&mut self) -> Option<Span> {
        while !self.is_empty() {
            let &[left, right] = self.columns.ends.get(self.next)?;
            let span = span(left as i32, self.y, right as i32);
            (self.y, self.next) = (self.y + 1, self.next.wrapping_add(1));
            if span.is_some() {
                return span;
            }
        }
        None
    }
}

/// The span of a row, if the row is not empty.
#[inline(always)]
fn span(x: i32, y: i32, end: i32) -> Option<Span> {
    (x < end).then_some(Span { x, y, width: end - x, height: 1 })
}

#[cfg(test)]
#[cfg(not(pinhole_plain))] // without fast paths no triangle is walked, and there is nothing to compare
mod tests {
    extern crate std;

    use super::*;
    use crate::math::random::Random;
    use crate::raster::{area, Gradient};
    use std::vec::Vec;

    /// Whether the triangle covers pixel (x, y): rules R1 to R5, word by word.
    fn is_covered(corners: &[ScreenPoint; 3], x: i32, y: i32) -> bool {
        let [a, b, c] = corners.map(|p| (i128::from(p.x), i128::from(p.y)));
        let across = |p: (i128, i128), q: (i128, i128), r: (i128, i128)| {
            (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0)
        };
        let oriented = if across(a, b, c) > 0 { [a, b, c] } else { [a, c, b] };
        let centre = (i128::from(x) * 256 + 128, i128::from(y) * 256 + 128);
        (0..3).all(|i| {
            let (p, q) = (oriented[i], oriented[(i + 1) % 3]);
            let (dx, dy) = (q.0 - p.0, q.1 - p.1);
            let is_left_or_top = dy < 0 || dy == 0 && dx > 0;
            across(p, q, centre) > 0 || is_left_or_top && across(p, q, centre) == 0
        })
    }

    fn corners(random: &mut Random, width: i64, height: i64) -> [ScreenPoint; 3] {
        let middle = (random.within(20_000), random.within(20_000));
        // Half of the triangles have corners on borders and centres of pixels, so that many centres lie on edges.
        let grid = [!0, !127][random.below(2) as usize];
        [(); 3].map(|()| {
            let (x, y) = (middle.0 + random.within(width), middle.1 + random.within(height));
            ScreenPoint::from_subpixels(x & grid, y & grid).unwrap()
        })
    }

    /// Triangles of many shapes, slivers and flat ones among them.
    fn triangles(count: usize) -> impl Iterator<Item = [ScreenPoint; 3]> {
        let random = &mut Random(12);
        let extents = [(900, 900), (3000, 300), (300, 3900), (40, 40), (30_000, 200), (6000, 3968), (700, 3)];
        let all: Vec<_> = (0..count).map(|i| corners(random, extents[i % 7].0, extents[i % 7].1)).collect();
        all.into_iter().filter(|corners| area(corners) != 0)
    }

    /// Asserts that the spans contain exactly the covered pixels inside the scissor.
    fn assert_covered(spans: &[Span], corners: &[ScreenPoint; 3], scissor: &Scissor) {
        let bounds = Scissor::bounding_box(corners);
        for y in bounds.top.max(scissor.top)..bounds.bottom.min(scissor.bottom) {
            let row: Vec<_> = spans.iter().filter(|span| span.y == y).collect();
            assert!(row.len() <= 1);
            for x in bounds.left.max(scissor.left) - 1..=bounds.right.min(scissor.right) {
                let inside = row.first().is_some_and(|span| (span.x..span.x + span.width).contains(&x));
                assert_eq!(inside, is_covered(corners, x, y), "{corners:?} ({x}, {y})");
            }
        }
        assert!(spans.iter().all(|span| (scissor.top..scissor.bottom).contains(&span.y)));
    }

    /// Whether the triangle is in the domain, given whether its rows must lie inside the scissor, too; and the first row and
    /// the row below the last one.
    fn is_low(corners: &[ScreenPoint; 3], scissor: &Scissor, rows_too: bool) -> (bool, i32, i32) {
        let (mut top, mut bottom, mut inside) = (i32::MAX, i32::MIN, true);
        for p in corners {
            (top, bottom) = (top.min(p.y), bottom.max(p.y));
            inside &= (256 * scissor.left..=256 * scissor.right).contains(&p.x);
            inside &= !rows_too || (256 * scissor.top..=256 * scissor.bottom).contains(&p.y);
        }
        (inside && bottom - top <= 31 * 256, (top + 127).div_euclid(256), (bottom + 127).div_euclid(256))
    }

    #[test]
    fn rows_inside_are_exact() {
        let random = &mut Random(14);
        let (mut walked, mut refused) = (0, 0);
        for (i, corners) in triangles(6000).enumerate() {
            // Layouts that are wide, as narrow as can be, or let indices wrap; and a scissor that clips many triangles.
            let stride = [160, 161, 1 << 16, 1, 0][i % 5];
            let layout = PixelLayout::new([-80, 0, 77][i % 3], [-60, 0, -30_000][i % 3], stride);
            let scissor = Scissor::new(-90, -70, 85, 65);
            let mut scratch = RowScratch::new(layout);
            let triangle = Triangle::new(corners, area(&corners), &scissor);
            let (low, first, end) = is_low(&corners, &scissor, true);
            let walk = BresenhamTriangle::<false>::new(&triangle, &scissor, &mut scratch);
            assert_eq!(walk.is_some(), low, "{corners:?}");
            let Some(walk) = walk else {
                refused += 1;
                continue;
            };
            assert_eq!(walk.is_empty(), first >= end);

            let spans = spans(walk, &mut scratch, random);
            assert_covered(&spans, &corners, &scissor);
            walked += 1;
        }
        assert!(walked > 1000 && refused > 1000, "{walked} {refused}");
    }

    /// The spans of the stored rows. Asserts that a sheared gradient at a buffer index is the gradient at the column.
    fn spans<const CLIP_ROWS: bool>(
        walk: BresenhamTriangle<CLIP_ROWS>,
        scratch: &mut RowScratch,
        random: &mut Random,
    ) -> Vec<Span> {
        let layout = scratch.layout;
        let mut number = || random.within(1 << 30) as u32;
        let gradient = Gradient { origin: number() << 2, right: number() << 1, down: number() << 1 };
        let RowOrigin { x, y, shear } = walk.start(layout);
        let sheared = gradient.sheared(shear);
        let (mut value, mut row, mut spans) = (sheared.at(x, y), y, Vec::new());
        walk.each(scratch, |start, from, to| {
            let index_0 = layout.at(0, row) as i32;
            assert_eq!(start, 0);
            for index in [from, to] {
                let by_index = value.wrapping_add(sheared.step().wrapping_mul(index as u32));
                assert_eq!(by_index, gradient.at(index.wrapping_sub(index_0), row));
            }
            spans.extend(span(from.wrapping_sub(index_0), row, to.wrapping_sub(index_0)));
            (value, row) = (value.wrapping_add(sheared.row_step()), row + 1);
        });
        spans
    }

    #[test]
    fn all_heights_up_to_31_rows_are_walked() {
        let scissor = Scissor::new(0, 0, 64, 64);
        let scratch = &mut RowScratch::new(PixelLayout::new(0, 0, 64));
        for top in 256..512 {
            for (height, is_low) in [(31 * 256, true), (31 * 256 + 1, false)] {
                let point = |x, y| ScreenPoint::from_subpixels(x, y).unwrap();
                let corners = [point(1000, top), point(4000, top + 77), point(3000, top + height)];
                let triangle = Triangle::new(corners, area(&corners), &scissor);
                let walk = BresenhamTriangle::<false>::new(&triangle, &scissor, scratch);
                assert_eq!(walk.is_some(), is_low, "{top} {height}");
                if let Some(walk) = walk {
                    assert_covered(&spans(walk, scratch, &mut Random(15)), &corners, &scissor);
                }
            }
        }
    }

    #[test]
    fn clipped_rows_are_exact() {
        let random = &mut Random(16);
        let (mut walked, mut clipped) = (0, 0);
        for (i, corners) in triangles(3000).enumerate() {
            let bounds = Scissor::bounding_box(&corners);
            let top = bounds.top + [0, 1, 3, -2, 40][i % 5];
            let scissor = Scissor::new(-90, top, 90, top + [9, 1, 40][i % 3]);
            let triangle = Triangle::new(corners, area(&corners), &scissor);
            let (low, first, end) = is_low(&corners, &scissor, false);
            let mut scratch = RowScratch::new(PixelLayout::new(-90, top, 180));
            let walk = BresenhamTriangle::<true>::new(&triangle, &scissor, &mut scratch);
            assert_eq!(walk.is_some(), low, "{corners:?} {scissor:?}");
            let Some(walk) = walk else { continue };
            assert_eq!(walk.is_empty(), first.max(scissor.top) >= end.min(scissor.bottom));
            let from_rows = spans(walk, &mut scratch, random);
            assert_covered(&from_rows, &corners, &scissor);

            let mut columns = RowScratch::of_columns();
            let walk = BresenhamTriangle::<true>::new(&triangle, &scissor, &mut columns).unwrap();
            let mut low = LowSpans::new(walk, columns);
            assert_eq!(low.is_empty(), first.max(scissor.top) >= end.min(scissor.bottom));
            let from_iterator: Vec<_> = core::iter::from_fn(|| low.span()).collect();
            assert_eq!(from_iterator, from_rows);
            walked += 1;
            clipped += u32::from(top > bounds.top);
        }
        assert!(walked > 1000 && clipped > 500, "{walked} {clipped}");
    }
}
