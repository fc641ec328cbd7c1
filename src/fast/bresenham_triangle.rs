//! Low triangles where a division is a call, as on a Cortex-M0: the ends of all rows, worked out beforehand, one side after
//! the other, so that each has the registers for itself.
//!
//! In the n-th row of a side ⌈T⌉ is x, where `e = x·dy − (m + n·dx)` is one of 0 … dy − 1 (`raster/edge.rs` has m and T).
//! With `dx = q·dy + r`, 0 ≤ r < dy, the next row has x + q and e − r, or where that is negative x + q + 1 and
//! e − r + dy: nothing is rounded, and the quotients of most sides are so small that they are counted. It is the way
//! along a line of J. E. Bresenham, *Algorithm for computer control of a digital plotter*, 1965, with whole steps q.

use crate::math::num::keep_rolled;
use crate::raster::edge::{column, counted, first_centre, first_row, numerator, Long};
use crate::raster::pixel_layout::{PixelLayout, RowOrigin, RowScratch, Rows};
use crate::raster::triangle::down;
use crate::raster::{Scissor, ScreenPoint, Span, Triangle, GUARD_BAND};

/// As many as there are ends kept.
const ROWS: usize = 31;

/// No corner is so many rows away.
const TALL: i32 = 2 * GUARD_BAND;

/// Where rows begin and end.
pub(crate) type Ends = [[usize; 2]; ROWS];

/// None yet.
pub(crate) const NONE: Ends = [[0; 2]; ROWS];

/// Triangles of 31 rows at the most, between the scissor's columns, whose ends are kept. `CUT`: there may be rows above and
/// below the scissor's.
#[derive(Clone, Copy)]
pub(crate) struct BresenhamTriangle<const CUT: bool> {
    /// The first row.
    top: i32,
    /// Which of those kept it is, and the one behind the last.
    first: usize,
    end: usize,
}

impl<const CUT: bool> BresenhamTriangle<CUT> {
    /// `None` for all other triangles.
    #[inline(always)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor, ground: &mut RowScratch) -> Option<Self> {
        if !CUT {
            let (top, rows) = ground.walk(triangle, scissor);
            return Some(Self { top, first: 0, end: usize::try_from(rows).ok()? });
        }
        // All rows of the guard band.
        let (top, rows) = ground.walk(triangle, &Scissor { top: -TALL, bottom: TALL, ..*scissor });
        let end = usize::try_from(rows).ok()?;
        let below = |y: i32| (y - top).max(0) as usize;
        let (first, end) = (below(scissor.top), end.min(below(scissor.bottom)));
        Some(Self { top: top.max(scissor.top), first, end })
    }

    /// All that have pixels.
    #[inline(always)]
    pub(crate) fn each_span(self, ground: &mut RowScratch, mut draw: impl FnMut(Span)) {
        let mut y = self.top;
        self.each(ground, |_, left, right| {
            if let Some(span) = span(left, y, right) {
                draw(span);
            }
            y += 1;
        });
    }
}

impl<const CUT: bool> Rows for BresenhamTriangle<CUT> {
    const WIDTH: i32 = i32::MAX;

    #[inline(always)]
    fn is_empty(&self) -> bool {
        self.first >= self.end
    }

    #[inline(always)]
    fn start(&self, places: PixelLayout) -> RowOrigin {
        // Ends are places: place p of row y is column p − origin − y·stride.
        RowOrigin { x: places.origin.wrapping_neg() as i32, y: self.top, shear: places.stride }
    }

    #[inline(always)]
    fn each(self, ground: &mut RowScratch, mut row: impl FnMut(usize, i32, i32)) {
        if let Some(ends) = ground.ends.get(self.first..self.end) {
            for &[from, to] in ends {
                row(0, from as i32, to as i32);
            }
        }
    }
}

impl RowScratch {
    /// Puts the ends of all rows where they are kept, if the triangle is low and inside the scissor: the first row, and how many
    /// there are, −1 if it is not.
    #[inline(never)]
    fn walk(&mut self, triangle: &Triangle<'_>, scissor: &Scissor) -> (i32, i32) {
        let ([a, b, c], middle_left) = down(triangle.corners.each_ref(), triangle.area);
        // Negative where one of these is: below 2²⁴, all of them. Ends lie within a column of the corners.
        let mut room = ((ROWS as i32) << 8) - (c.y - a.y);
        for corner in [a, b, c] {
            room |= (corner.x - (scissor.left << 8)) | ((scissor.right << 8) - corner.x);
        }
        room |= (a.y - (scissor.top << 8)) | ((scissor.bottom << 8) - c.y);
        if room < 0 {
            return (0, -1);
        }
        let top = first_row(a);
        // Where column 0 would stand in the first row, and in that of the middle corner.
        let first = self.places.at(0, top);
        let mut bent = |end: usize| {
            let above = self.side(a, b, first, 0, end);
            self.side(b, c, first.wrapping_add(above.wrapping_mul(self.places.stride)), above, end);
        };
        let long = if middle_left {
            bent(0);
            1
        } else {
            bent(1);
            0
        };
        (top, self.side(a, c, first, 0, long) as i32)
    }

    /// Puts where the rows between `p` and `q` end on this side, from row `at` of those kept on: how many rows these are. The
    /// first of two ends is where a row begins.
    #[inline(always)]
    fn side(&mut self, p: &ScreenPoint, q: &ScreenPoint, start: usize, at: usize, end: usize) -> usize {
        // Quotients of less than 16 and a little more.
        let (dx, dy) = (q.x - p.x, q.y - p.y);
        match ((dx + (dy << 4)) as u32) < (dy << 5) as u32 {
            true => self.put(p, q, start, at, end, counted),
            false => self.flat_side(p, q, start, at, end),
        }
    }

    /// The same of one so flat that its quotients are large, or level.
    #[cold]
    #[inline(never)]
    fn flat_side(&mut self, p: &ScreenPoint, q: &ScreenPoint, start: usize, at: usize, end: usize) -> usize {
        self.put(p, q, start, at, end, by_long)
    }

    /// The same, given what divides.
    #[inline(always)]
    fn put(
        &mut self,
        p: &ScreenPoint,
        q: &ScreenPoint,
        start: usize,
        at: usize,
        end: usize,
        divide: impl Fn(i32, i32) -> (i32, i32),
    ) -> usize {
        let row = first_row(p);
        let rows = first_row(q) - row;
        if rows <= 0 {
            return 0;
        }
        let rows = rows as usize;
        let Some(ends) = self.ends.get_mut(at..at.wrapping_add(rows)) else { return 0 };
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx| ≤ 2²², 0 < dy < 2¹³
        let (less, mut e) = divide(-numerator(first_centre(p), dx, dy), dy);
        let mut x = start.wrapping_add((column(p) - less) as usize);
        let (whole, r) = if rows > 1 { divide(dx, dy) } else { (0, 0) };
        let step = self.places.stride.wrapping_add(whole as usize);
        for ends in ends {
            keep_rolled();
            ends[end & 1] = x;
            x = x.wrapping_add(step);
            e -= r;
            if e < 0 {
                keep_rolled();
                e += dy;
                x = x.wrapping_add(1);
            }
        }
        rows
    }
}

/// `⌊n / d⌋` and what is left.
fn by_long(n: i32, d: i32) -> (i32, i32) {
    let whole = (Long::new(d).divide(n.into()) >> 32) as i32; // or one less
    let rest = n.wrapping_sub(whole.wrapping_mul(d));
    if rest < d {
        (whole, rest)
    } else {
        (whole.wrapping_add(1), rest.wrapping_sub(d))
    }
}

/// The rows of a low triangle, which are kept.
pub(crate) struct Kept {
    columns: RowScratch,
    /// The next one, and that of those kept.
    y: i32,
    next: usize,
    end: usize,
}

impl Kept {
    pub(crate) fn new(
        BresenhamTriangle { top, first, end }: BresenhamTriangle<true>,
        columns: RowScratch,
    ) -> Self {
        Self { columns, y: top, next: first, end }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.next >= self.end
    }

    /// The next one that has pixels.
    pub(crate) fn span(&mut self) -> Option<Span> {
        while !self.is_empty() {
            let &[from, to] = self.columns.ends.get(self.next)?;
            let span = span(from as i32, self.y, to as i32);
            (self.y, self.next) = (self.y + 1, self.next.wrapping_add(1));
            if span.is_some() {
                return span;
            }
        }
        None
    }
}

/// What is not empty.
#[inline(always)]
fn span(x: i32, y: i32, end: i32) -> Option<Span> {
    (x < end).then_some(Span { x, y, width: end - x, height: 1 })
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::math::random::Random;
    use crate::raster::{area, Gradient};
    use std::vec::Vec;

    /// R1 to R5 for the pixel (x, y), as they are written.
    fn is_covered(corners: &[ScreenPoint; 3], x: i32, y: i32) -> bool {
        let [a, b, c] = corners.map(|p| (i128::from(p.x), i128::from(p.y)));
        let across = |p: (i128, i128), q: (i128, i128), r: (i128, i128)| {
            (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0)
        };
        let turned = if across(a, b, c) > 0 { [a, b, c] } else { [a, c, b] };
        let centre = (i128::from(x) * 256 + 128, i128::from(y) * 256 + 128);
        (0..3).all(|i| {
            let (p, q) = (turned[i], turned[(i + 1) % 3]);
            let (dx, dy) = (q.0 - p.0, q.1 - p.1);
            let is_left_or_top = dy < 0 || dy == 0 && dx > 0;
            across(p, q, centre) > 0 || is_left_or_top && across(p, q, centre) == 0
        })
    }

    fn corners(random: &mut Random, width: i64, height: i64) -> [ScreenPoint; 3] {
        let middle = (random.within(20_000), random.within(20_000));
        [(); 3].map(|()| {
            let (x, y) = (middle.0 + random.within(width), middle.1 + random.within(height));
            ScreenPoint::from_subpixels(x, y).unwrap()
        })
    }

    /// Of any shape, as flat as can be among them.
    fn triangles(count: usize) -> impl Iterator<Item = [ScreenPoint; 3]> {
        let random = &mut Random(12);
        let extents = [(900, 900), (3000, 300), (300, 3900), (40, 40), (30_000, 200), (6000, 3968), (700, 3)];
        let all: Vec<_> = (0..count).map(|i| corners(random, extents[i % 7].0, extents[i % 7].1)).collect();
        all.into_iter().filter(|corners| area(corners) != 0)
    }

    /// Spans that are all those of the scissor's covered pixels.
    fn assert_covered(spans: &[Span], corners: &[ScreenPoint; 3], scissor: &Scissor) {
        let reach = Scissor::of(corners);
        for y in reach.top.max(scissor.top)..reach.bottom.min(scissor.bottom) {
            let row: Vec<_> = spans.iter().filter(|span| span.y == y).collect();
            assert!(row.len() <= 1);
            for x in reach.left.max(scissor.left) - 1..=reach.right.min(scissor.right) {
                let inside = row.first().is_some_and(|span| (span.x..span.x + span.width).contains(&x));
                assert_eq!(inside, is_covered(corners, x, y), "{corners:?} ({x}, {y})");
            }
        }
        assert!(spans.iter().all(|span| (scissor.top..scissor.bottom).contains(&span.y)));
    }

    /// Corners that all lie within these columns, and rows if that is asked; and the rows of centres between them.
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
        for (i, corners) in triangles(4000).enumerate() {
            // Where the pixels lie: wide, as narrow as can be, or so that places wrap; and a scissor that often is in the way.
            let stride = [160, 161, 1 << 16, 1, 0][i % 5];
            let places = PixelLayout::new([-80, 0, 77][i % 3], [-60, 0, -30_000][i % 3], stride);
            let scissor = Scissor::new(-90, -70, 85, 65);
            let mut ground = RowScratch::new(places);
            let triangle = Triangle::new(corners, area(&corners), &scissor);
            let (low, first, end) = is_low(&corners, &scissor, true);
            let walk = BresenhamTriangle::<false>::new(&triangle, &scissor, &mut ground);
            assert_eq!(walk.is_some(), low, "{corners:?}");
            let Some(walk) = walk else {
                refused += 1;
                continue;
            };
            assert_eq!(walk.is_empty(), first >= end);

            let spans = spans(walk, &mut ground, random);
            assert_covered(&spans, &corners, &scissor);
            let columns = &mut RowScratch::of_columns();
            let again = BresenhamTriangle::<false>::new(&triangle, &scissor, columns).unwrap();
            let mut drawn = Vec::new();
            again.each_span(columns, |span| drawn.push(span));
            assert_eq!(drawn, spans);
            walked += 1;
        }
        assert!(walked > 1000 && refused > 1000, "{walked} {refused}");
    }

    /// What a walk passes on; any plane by its places is what it is by columns.
    fn spans<const CUT: bool>(
        walk: BresenhamTriangle<CUT>,
        ground: &mut RowScratch,
        random: &mut Random,
    ) -> Vec<Span> {
        let places = ground.places;
        let mut number = || random.within(1 << 30) as u32;
        let plane = Gradient { origin: number() << 2, right: number() << 1, down: number() << 1 };
        let RowOrigin { x, y, shear } = walk.start(places);
        let sheared = plane.sheared(shear);
        let (mut value, mut row, mut spans) = (sheared.at(x, y), y, Vec::new());
        walk.each(ground, |start, from, to| {
            let place_0 = places.at(0, row) as i32;
            assert_eq!(start, 0);
            for place in [from, to] {
                let by_places = value.wrapping_add(sheared.step().wrapping_mul(place as u32));
                assert_eq!(by_places, plane.at(place.wrapping_sub(place_0), row));
            }
            spans.extend(span(from.wrapping_sub(place_0), row, to.wrapping_sub(place_0)));
            (value, row) = (value.wrapping_add(sheared.down()), row + 1);
        });
        spans
    }

    #[test]
    fn all_heights_up_to_31_rows_are_walked() {
        let scissor = Scissor::new(0, 0, 64, 64);
        let ground = &mut RowScratch::new(PixelLayout::new(0, 0, 64));
        for top in 256..512 {
            for (height, is_low) in [(31 * 256, true), (31 * 256 + 1, false)] {
                let point = |x, y| ScreenPoint::from_subpixels(x, y).unwrap();
                let corners = [point(1000, top), point(4000, top + 77), point(3000, top + height)];
                let triangle = Triangle::new(corners, area(&corners), &scissor);
                let walk = BresenhamTriangle::<false>::new(&triangle, &scissor, ground);
                assert_eq!(walk.is_some(), is_low, "{top} {height}");
                if let Some(walk) = walk {
                    assert_covered(&spans(walk, ground, &mut Random(15)), &corners, &scissor);
                }
            }
        }
    }

    #[test]
    fn cut_rows_are_exact() {
        let random = &mut Random(16);
        let (mut walked, mut cut) = (0, 0);
        for (i, corners) in triangles(3000).enumerate() {
            let reach = Scissor::of(&corners);
            let top = reach.top + [0, 1, 3, -2, 40][i % 5];
            let scissor = Scissor::new(-90, top, 90, top + [9, 1, 40][i % 3]);
            let triangle = Triangle::new(corners, area(&corners), &scissor);
            let (low, first, end) = is_low(&corners, &scissor, false);
            let mut ground = RowScratch::new(PixelLayout::new(-90, top, 180));
            let walk = BresenhamTriangle::<true>::new(&triangle, &scissor, &mut ground);
            assert_eq!(walk.is_some(), low, "{corners:?} {scissor:?}");
            let Some(walk) = walk else { continue };
            assert_eq!(walk.is_empty(), first.max(scissor.top) >= end.min(scissor.bottom));
            let passed_on = spans(walk, &mut ground, random);
            assert_covered(&passed_on, &corners, &scissor);

            let mut columns = RowScratch::of_columns();
            let walk = BresenhamTriangle::<true>::new(&triangle, &scissor, &mut columns).unwrap();
            let mut kept = Kept::new(walk, columns);
            assert_eq!(kept.is_empty(), first.max(scissor.top) >= end.min(scissor.bottom));
            let kept: Vec<_> = core::iter::from_fn(|| kept.span()).collect();
            assert_eq!(kept, passed_on);
            walked += 1;
            cut += u32::from(top > reach.top);
        }
        assert!(walked > 1000 && cut > 500, "{walked} {cut}");
    }

    #[test]
    fn quotients_are_exact() {
        let random = &mut Random(13);
        for i in 0..100_000 {
            let d = random.within([3, 300, 8191][i % 3]).abs() + 1;
            for n in [random.within(1 << 22), random.within(40) * d, random.within(40) * d - 1] {
                let exact = (n.div_euclid(d), n.rem_euclid(d));
                assert_eq!(by_long(n, d), exact, "{n} / {d}");
                if n.abs() < 40 * d {
                    assert_eq!(counted(n, d), exact, "{n} / {d}");
                }
            }
        }
    }
}
