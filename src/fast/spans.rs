//! Spans of triangles for targets that take spans.
//!
//! - **Plain twin**: [`Triangle::spans`].
//! - **Domain**: triangles within 32 rows (on a Cortex-M0 31) between the scissor's columns. All
//!   other triangles go to the plain twin.
//! - **Gain**: that of the triangle tiers, in the table in [`fast`](super); the iterator is not measured alone.
//! - **Test**: `tests/raster/memory_triangles.rs`: a target that is not the library's gets the spans of the plain twin;
//!   `tests/properties/scenes.rs`, with depth.

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
