//! Anti-aliased lines into memory, with and without a depth test.
//!
//! Without a depth test, most lines are drawn by `fast::anti_aliased_line`. There is no path for a `DrawTarget`: targets whose pixels cannot be read do not compile with a stroke that is anti-aliased.

use crate::camera::UnpackedVertex;
use crate::fast::anti_aliased_line::anti_aliased_line;
use crate::math::hints::opaque_next;
use crate::raster::{rest, Column, LineCoverage, LineDepth, Pixel, Scissor};
use crate::shading::Stroke;
use crate::surface::{DepthBuffer, Memory, PixelStore, StoredPixel, Target};

/// How many pixels a line reaches beyond the rows and columns of its ends' pixels: it begins at a pixel border up to ½ pixel
/// before the end, and its sides are up to √2/2 pixel from its middle. Both together are 1.21 pixels from an end, which may lie
/// on the border of its pixel.
pub(super) const BEYOND: i32 = 2;

/// Draws a line between two points with coordinates in 1/256 pixel, without a depth test. `rounding`: as in [`LineCoverage::new`].
#[inline(never)] // one copy for all callers
fn line<T: Target, K: Stroke<T::Color>>(
    ends: [[i32; 2]; 2],
    rounding: i32,
    viewport: Option<&Scissor>,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    let mut line = LineCoverage::new(ends, rounding, scissor);
    if !line.inside {
        if viewport.is_some_and(|viewport| !meet(ends, viewport)) {
            return;
        }
        line = line.clipped(scissor);
        if line.tall && !line.inside {
            line = ends_of_line(line, scissor, stroke, target);
        }
    }
    if line.first < line.end && !anti_aliased_line(&line, scissor, stroke, target) {
        // Copied, so that the line itself has no address, and its fields lie in registers.
        by_pixels(&line.clone(), scissor, stroke, target);
    }
}

/// Draws the columns of a line that may have pixels outside the scissor, and returns the line's other columns.
#[cold]
#[inline(never)]
fn ends_of_line<T: Target, K: Stroke<T::Color>>(
    line: LineCoverage,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) -> LineCoverage {
    let interior = line.interior(scissor);
    by_pixels(&line.part(line.first..interior.first), scissor, stroke, target);
    by_pixels(&line.part(interior.end..line.end), scissor, stroke, target);
    interior
}

/// Mixes the pixels of a line that lie in the scissor.
#[inline(never)]
fn by_pixels<T: Target, K: Stroke<T::Color>>(
    line: &LineCoverage,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    mix_columns::<false, _, _, _>(line, scissor, stroke, target, |_| (), |(), _, _, _| true);
}

/// Mixes the pixels of a line inside the scissor, which lies in the target, for which `is_visible` is true, given x, y and the
/// area that the line covers, in 2⁻¹⁶.
#[inline(always)]
fn mix_columns<const UNROLLED: bool, T: Target, K: Stroke<T::Color>, D: Copy>(
    line: &LineCoverage,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
    mut depth: impl FnMut(i32) -> D,
    mut is_visible: impl FnMut(D, i32, i32, i32) -> bool,
) {
    const {
        // The compiler evaluates this for plain colours, too.
        let readable = !K::IS_ANTI_ALIASED || <T::Store as PixelStore>::READABLE;
        assert!(readable, "anti-aliased lines read pixels: draw into the pixels() of a Picture or of a Band");
    }
    let Some((_, memory)) = target.memory().map(Memory::split) else { return };
    let (cells, scratch) = memory.parts();
    let (layout, mix) = (scratch.layout, stroke.mixer());
    // Without a branch, from which LLVM would make two loops.
    let [tall, wide] = [line.tall, !line.tall].map(i32::from);
    for Column { column, first, areas } in line.columns() {
        let own = depth(column);
        let mut pixel = 0;
        while let Some(&area) = areas.get(pixel) {
            let row = first + pixel as i32;
            let row = if line.rises { !row } else { row };
            let (x, y) = (column * wide + row * tall, column * tall + row * wide);
            let rest = rest(area, K::SHARE_BITS);
            if rest != 1 << K::SHARE_BITS
                && scissor.rows().contains(&y)
                && scissor.columns().contains(&x)
                && is_visible(own, x, y, area)
                && let Some(cell) = cells.get_mut(layout.at(x, y))
            {
                *cell = mix(T::Color::load(*cell), rest).stored();
            }
            pixel = if UNROLLED { pixel + 1 } else { opaque_next(pixel) };
        }
    }
}

/// Draws a line between the centres of two pixels, from border to border.
#[inline(always)]
pub(super) fn line_between_pixels<T: Target, K: Stroke<T::Color>>(
    ends: [Pixel; 2],
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    // Pixels may lie beyond the guard band, within 2¹⁵. The border before the first centre is the nearest one beyond it.
    line(ends.map(|p| [p.x, p.y].map(|v| 256 * i32::from(v) + 128)), 0, None, scissor, stroke, target);
}

/// The ends of an edge in 1/256 pixel.
#[inline(always)]
fn subpixels(ends: &[UnpackedVertex; 2]) -> [[i32; 2]; 2] {
    ends.map(|end| [end.point.x, end.point.y])
}

/// Whether the box around the pixels of an edge's ends meets the viewport.
#[inline(always)]
fn meet(ends: [[i32; 2]; 2], viewport: &Scissor) -> bool {
    let [[ax, ay], [bx, by]] = ends.map(|end| end.map(|v| v >> 8));
    let pixels = Scissor::unclamped(ax.min(bx), ay.min(by), ax.max(bx) + 1, ay.max(by) + 1);
    !pixels.intersection(viewport).is_empty()
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
    line(subpixels(ends), 128, Some(viewport), scissor, stroke, target);
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
    if !meet(subpixels(ends), viewport) {
        return;
    }
    let line = LineCoverage::new(subpixels(ends), 128, scissor).clipped(scissor);
    let line_depth = LineDepth::on_axis(line.tall, ends.map(|end| end.point), ends.map(|end| end.depth));
    mix_columns::<true, _, _, _>(
        &line,
        scissor,
        stroke,
        target,
        |column| line_depth.depth(column, column),
        |own, x, y, area| {
            let Some([stored]) = depth.row(x, y, 1) else { return false };
            let is_visible = own <= *stored || is_drawn_over(*stored, x, y);
            if is_visible && stores && area >= 1 << 15 {
                *stored = own;
            }
            is_visible
        },
    );
}
