//! Anti-aliased lines with shares from a table, without a depth test.
//!
//! - **Plain twin**: `pipeline::anti_aliased::mix_columns`, which tests each pixel.
//! - **Domain**: lines, and parts of lines, all of whose pixels lie in the scissor, on a target whose pixels lie in memory.
//! - **Gain**: A1, the torus's edges, takes 1.13 million instructions on an M3, 1.12 on an M4F, 1.86 on an M0; by the plain path 2.70,
//!   2.70 and 3.84 million.
//! - **Test**: `the_fast_path_mixes_the_pixels_of_the_plain_one` and `hard_lines_are_mixed_as_by_the_plain_path` in
//!   `pipeline/anti_aliased.rs`; `tests/pipeline/anti_aliased.rs`, in bands and with depth.

use super::memory_of;
use crate::color::StoredPixel;
use crate::math::hints::keep_rolled;
use crate::raster::{rests_at, LineCoverage, LineRests};
use crate::shading::{rests_of_line, StrokeKind};
use crate::surface::Surface;
use core::cell::Cell;

/// Draws a line, which has columns, and returns `true`, or draws nothing. `halves`: as in [`LineCoverage::split`].
#[inline(always)]
pub(crate) fn table_line<T: Surface, K: StrokeKind<T::Color>>(
    line: &LineCoverage,
    halves: [bool; 2],
    stroke: K,
    target: &mut T,
) -> bool {
    if !line.inside {
        return false;
    }
    let Some(memory) = memory_of(target) else { return false };
    let (cells, scratch) = memory.parts();
    let layout = scratch.layout;
    let mix = stroke.mixer();
    let mix = move |cell, rest| mix(T::Color::load(cell), rest).stored();
    let row = if line.rises { !line.row } else { line.row };
    let (x, y, along, aside) =
        if line.tall { (row, line.first, layout.stride, 1) } else { (line.first, row, 1, layout.stride) };
    let at = layout.at(x, y).wrapping_sub(aside);
    let [whole, half] = rests_of_line::<_, K>(line.slope());
    let [starts, ends] = halves.map(i32::from);
    let runs = [(starts, half), (line.end - line.first - starts - ends, whole), (ends, half)];
    columns(cells, at, &runs, [along, aside], line.rises, [line.fraction, line.slope()], mix);
    true
}

/// Mixes the pixels of the columns of some runs, each with its number of columns and what is left of their pixels. `at` is the index of
/// the first column's middle pixel, less `aside`: the next row lies `aside` further, or before if the line `rises`, and the next column
/// `along`.
#[inline(never)] // its loop needs all registers
fn columns<C: Copy>(
    cells: &mut [C],
    mut at: usize,
    runs: &[(i32, &LineRests)],
    [along, aside]: [usize; 2],
    rises: bool,
    [mut fraction, slope]: [u32; 2],
    mix: impl Fn(C, u32) -> C,
) {
    // Slices of one length, so that one bounds check serves three pixels.
    let cells = Cell::from_mut(cells).as_slice_of_cells();
    let Some(below) = cells.get(aside.wrapping_mul(2)..) else { return };
    let (Some(above), Some(middle)) = (cells.get(..below.len()), cells.get(aside..)) else { return };
    let Some(middle) = middle.get(..below.len()) else { return };
    let (before, after, aside) =
        if rises { (below, above, aside.wrapping_neg()) } else { (above, below, aside) };
    for &(count, rests) in runs {
        keep_rolled();
        for _ in 0..count {
            let [rest_before, rest, rest_after] = rests_at(rests, fraction);
            let (Some(pixel), Some(before), Some(after)) = (middle.get(at), before.get(at), after.get(at))
            else {
                return;
            };
            pixel.set(mix(pixel.get(), rest));
            if rest_before != 0 {
                before.set(mix(before.get(), rest_before));
            }
            if rest_after != 0 {
                after.set(mix(after.get(), rest_after));
            }
            let carries;
            (fraction, carries) = fraction.overflowing_add(slope);
            if carries {
                at = at.wrapping_add(aside);
            }
            at = at.wrapping_add(along);
            keep_rolled();
        }
    }
}
