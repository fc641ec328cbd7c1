//! Spans of triangles for targets that take spans.
//!
//! - **Plain twin**: [`Triangle::spans`].
//! - **Domain**: triangles within 32 rows (on a Cortex-M0 31) between the scissor's columns. All
//!   other triangles go to the plain twin.
//! - **Gain**: that of the triangle tiers, in the table in [`fast`](super); the iterator is not measured alone.
//! - **Test**: `spans_are_those_of_the_plain_triangle` in this file, and `tests/raster/memory_triangles.rs`.

use super::{Low, LowSpans};
use crate::raster::{self, RowScratch, Scissor, Span, Triangle};

/// The spans of a triangle inside a scissor, top to bottom.
pub(crate) enum Spans {
    Low(LowSpans),
    Plain(raster::Spans),
}

/// The covered pixels of a triangle inside the scissor: one span per row, top to bottom. The fast twin of
/// [`Triangle::spans`].
#[inline(never)]
pub(crate) fn spans(triangle: &Triangle<'_>, scissor: &Scissor) -> Spans {
    let mut columns = RowScratch::of_columns();
    match Low::new(triangle, scissor, &mut columns) {
        Some(low) => Spans::Low(LowSpans::new(low, columns)),
        None => Spans::Plain(triangle.spans(scissor)),
    }
}

impl Spans {
    /// Calls `draw` with each span, for loops that `draw` is to be inlined into.
    ///
    /// # Errors
    ///
    /// The first error of `draw`; no further span is computed.
    #[inline(always)]
    pub(crate) fn try_each<E>(&mut self, draw: impl FnMut(Span) -> Result<(), E>) -> Result<(), E> {
        match self {
            Self::Low(low) => low.try_each(draw),
            Self::Plain(plain) => plain.try_for_each(draw),
        }
    }

    /// Whether the triangle has no row inside the scissor; valid before the first span is taken.
    pub(crate) fn is_empty(&self) -> bool {
        match self {
            Self::Low(low) => low.is_empty(),
            Self::Plain(plain) => plain.is_empty(),
        }
    }
}

impl Iterator for Spans {
    type Item = Span;

    #[inline(never)] // code size: there are many loops over spans
    fn next(&mut self) -> Option<Span> {
        match self {
            Self::Low(low) => low.span(),
            Self::Plain(plain) => plain.next(),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::math::random::Random;
    use crate::raster::{area, ScreenPoint};
    use std::vec::Vec;

    /// Triangles of every tier, inside the scissor and clipped at each of its sides.
    #[test]
    fn spans_are_those_of_the_plain_triangle() {
        let random = &mut Random(31);
        let (mut low, mut plain) = (0, 0);
        for i in 0..60_000 {
            let (width, height) = [
                (900, 900),
                (4080, 3840),
                (4080, 4096),
                (30_000, 4096),
                (300, 3968),
                (40, 40),
                (60_000, 30_000),
            ][i % 7];
            let center = (random.within(20_000), random.within(20_000));
            let corners = [(); 3].map(|()| {
                let (x, y) = (center.0 + random.within(width), center.1 + random.within(height));
                ScreenPoint::from_subpixels(x, y).unwrap()
            });
            if area(&corners) == 0 {
                continue;
            }
            let (x, y) = (random.within(60), random.within(60));
            let scissor = match i % 3 {
                0 => Scissor::new(-400, -400, 400, 400),
                1 => Scissor::new(x - 40, y - 40, x + 40, y + 40),
                _ => Scissor::new(-400, y, 400, y + 8),
            };
            let triangle = Triangle::new(corners, area(&corners), &scissor);
            let expected: Vec<_> = triangle.spans(&scissor).collect();
            let fast = spans(&triangle, &scissor);
            match fast {
                Spans::Low(_) => low += 1,
                Spans::Plain(_) => plain += 1,
            }
            assert!(!fast.is_empty() || expected.is_empty(), "{corners:?} {scissor:?}");
            assert_eq!(fast.collect::<Vec<_>>(), expected, "{corners:?} {scissor:?}");
        }
        assert!(low > 10_000 && plain > 10_000 || cfg!(pinhole_plain), "{low} {plain}");
    }
}
