//! Anti-aliased lines into memory, with and without a depth test.
//!
//! There is no other path: targets whose pixels cannot be read do not compile with a stroke that is anti-aliased.

use super::bounds::bounds;
use crate::camera::UnpackedVertex;
use crate::math::hints::{keep_rolled, opaque};
use crate::raster::{Column, LineCoverage, LineDepth, Pixel, Scissor};
use crate::shading::Stroke;
use crate::surface::{DepthBuffer, Memory, PixelStore, StoredPixel, Target};
use core::ops::Range;

/// How many pixels a line reaches beyond the rows and columns of its ends' pixels: it begins at a pixel border up to ½ pixel before the
/// end, and its border is up to √2/2 pixel from its middle, so that is 1.21 pixels from an end, which may lie on the border of its pixel.
pub(super) const BEYOND: i32 = 2;

/// Mixes the pixels of a line inside the scissor, which lies in the target, for which `is_visible` is true, given column, row and
/// coverage.
#[inline(always)]
pub(super) fn mix_line<T: Target, K: Stroke<T::Color>>(
    line: &LineCoverage,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
    mut is_visible: impl FnMut(i32, i32, i32) -> bool,
) {
    const {
        // The compiler evaluates this for plain colours, too.
        let readable = !K::IS_ANTI_ALIASED || <T::Store as PixelStore>::READABLE;
        assert!(readable, "anti-aliased lines read pixels: draw into the pixels() of a Picture or of a Band");
    }
    let Some((_, memory)) = target.memory().map(Memory::split) else { return };
    let (cells, scratch) = memory.parts();
    let layout = scratch.layout;
    let (along, across) = if line.tall { (layout.stride, 1) } else { (1, layout.stride) };
    let (_, rows) = line.axes(scissor);
    let cover = stroke.cover();
    // The columns that begin in one of these many rows, from the first one on, lie in the scissor.
    let inside = (rows.end - rows.start - 4).max(0) as u32;
    // Index of the pixel in column 0 and row 0 of the line's axes.
    let origin = layout.at(0, 0);
    for column in line.columns(scissor) {
        let first = column.first();
        let mut at = (column.column as usize).wrapping_mul(along).wrapping_add(origin);
        // Not known to LLVM, which would multiply again for each pixel.
        at = opaque(at.wrapping_add((first as usize).wrapping_mul(across)));
        if (first.wrapping_sub(rows.start) as u32) < inside
            && let Some(cells) = cells.get_mut(at..)
        {
            line.each_pixel(&column, |pixel, coverage| {
                let row = first + pixel as i32; // 0 … 4
                let (x, y) = if line.tall { (row, column.column) } else { (column.column, row) };
                if is_visible(x, y, coverage)
                    && let Some(cell) = cells.get_mut(across.wrapping_mul(pixel))
                {
                    *cell = cover(T::Color::load(*cell), coverage as u16).stored();
                    // 0 … 256
                }
            });
        } else {
            mix_clipped::<T, K>(line, &column, &rows, stroke, cells, [at, across], &mut is_visible);
        }
    }
}

/// Mixes the pixels of a column that lie in these rows. `at` is the index of the first pixel, `across` is added for each of the
/// next ones.
#[inline(never)] // few columns are clipped
fn mix_clipped<T: Target, K: Stroke<T::Color>>(
    line: &LineCoverage,
    column: &Column,
    rows: &Range<i32>,
    stroke: K,
    cells: &mut [<T::Store as PixelStore>::Cell],
    [mut at, across]: [usize; 2],
    is_visible: &mut impl FnMut(i32, i32, i32) -> bool,
) {
    for (row, coverage) in (column.first()..).zip(line.coverage(column)) {
        let (x, y) = if line.tall { (row, column.column) } else { (column.column, row) };
        if coverage != 0
            && rows.contains(&row)
            && is_visible(x, y, coverage)
            && let Some(cell) = cells.get_mut(at)
        {
            *cell = stroke.covering(T::Color::load(*cell), coverage as u16).stored();
            // 0 … 256
        }
        at = at.wrapping_add(across);
        keep_rolled();
    }
}

/// Draws a line without a depth test.
#[inline(never)] // one copy for all callers
pub(super) fn line<T: Target, K: Stroke<T::Color>>(
    line: &LineCoverage,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    mix_line(line, scissor, stroke, target, |_, _, _| true);
}

/// Draws a line between the centres of two pixels, from border to border.
#[inline(never)]
pub(super) fn line_between_pixels<T: Target, K: Stroke<T::Color>>(
    ends: [Pixel; 2],
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    // Pixels may lie beyond the guard band, within 2¹⁵; the line is set up relative to its first end, where the distance of
    // both ends is below 2¹⁶ pixels.
    line(&LineCoverage::between_pixels(ends), scissor, stroke, target);
}

/// Draws an edge of a mesh without a depth test, if its ends' pixels meet the viewport.
#[inline(always)]
pub(super) fn edge<T: Target, K: Stroke<T::Color>>(
    ends: &[UnpackedVertex; 2],
    viewport: &Scissor,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    if !bounds(ends).intersection(viewport).is_empty() {
        line(&LineCoverage::new(ends.map(|end| end.point)), scissor, stroke, target);
    }
}

/// Draws the pixels of an edge that are as near as the depth buffer, or for which `is_drawn_over` is true, given the stored depth
/// and the pixel. All pixels of a column have the depth of the line in the middle of the column. `stores`: that depth is stored
/// where the line covers at least half of a pixel.
#[inline(never)] // one copy for both callers
#[allow(clippy::too_many_arguments)]
pub(super) fn visible_edge<T: Target, K: Stroke<T::Color>>(
    ends: &[UnpackedVertex; 2],
    stores: bool,
    is_drawn_over: &dyn Fn(u16, i32, i32) -> bool,
    viewport: &Scissor,
    scissor: &Scissor,
    stroke: K,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) {
    if bounds(ends).intersection(viewport).is_empty() {
        return;
    }
    let points = ends.map(|end| end.point);
    let line = LineCoverage::new(points);
    let line_depth = LineDepth::on_axis(line.tall, points, ends.map(|end| end.depth));
    mix_line(&line, scissor, stroke, target, |x, y, coverage| {
        let Some([stored]) = depth.row(x, y, 1) else { return false };
        let own = line_depth.depth(x, y);
        let is_visible = own <= *stored || is_drawn_over(*stored, x, y);
        if is_visible && stores && coverage >= 128 {
            *stored = own;
        }
        is_visible
    });
}
