//! The runs of pixels of a span that are drawn.

use crate::raster::Span;

/// Calls `draw` for each run of pixels of a span for which `is_drawn` gives `true`. The span has one row, and `is_drawn` as many
/// elements as the span has pixels.
///
/// # Errors
///
/// The first error of `draw`; no further pixel is looked at.
#[inline(always)]
pub(crate) fn each_run<E>(
    span: Span,
    mut is_drawn: impl ExactSizeIterator<Item = bool>,
    mut draw: impl FnMut(Span) -> Result<(), E>,
) -> Result<(), E> {
    let end = span.x + span.width;
    // `any` stops after the first pixel that is drawn, `all` after the first that is not, so `len` gives both ends of the run.
    while is_drawn.any(|is_drawn| is_drawn) {
        let first = end - 1 - is_drawn.len() as i32;
        let to_the_end = is_drawn.all(|is_drawn| is_drawn);
        let width = end - is_drawn.len() as i32 - i32::from(!to_the_end) - first;
        draw(Span { x: first, width, ..span })?;
    }
    Ok(())
}
