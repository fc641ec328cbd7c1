//! Anti-aliased lines without a depth test.
//!
//! - **Plain twin**: `pipeline::anti_aliased::mix_columns`, which tests each pixel.
//! - **Domain**: lines in 2D, and edges between the pixels around their ends, on a target whose pixels lie in memory: those that run more
//!   to the right than down or up, clipped or not, and all others that lie between the scissor's columns. The pixels around the ends of
//!   edges that lie inside the scissor, whose ends are not near one another, with a stroke that is opaque; not in
//!   a browser, where a page counts bytes and not instructions.
//! - **Gain**: S6 anti-aliased takes 3.9 million instructions on an M3, 6.0 on an M0; one loop for lines with and without depth took 6.9 and
//!   9.6 million. A1, the torus's edges, takes 3.0 million on an M3, 4.8 on an M0; with ends by the plain path 3.8 and 5.7 million.
//! - **Test**: `the_fast_path_mixes_the_pixels_of_the_plain_one` and `hard_lines_are_mixed_as_by_the_plain_path` in
//!   `pipeline/anti_aliased.rs`, which compare both pixel by pixel; `tests/pipeline/anti_aliased.rs`, in bands and with depth.
//!
//! A tall line is drawn through three slices, of the pixels before its middle, in its middle and after it. They have one length and begin
//! one pixel apart, so one bounds check serves all three and also ends the loop; the index is a fixed-point number with 32 fractional
//! bits, whose carry is the step to the next pixel of a row. A flat line is drawn into the slice of the scissor's rows, in which the
//! bounds check of a pixel is also the test whether its row lies in the scissor. The outermost two of the five pixels of a column are
//! covered in few columns of steep lines only, and have a function of their own.

use crate::color::StoredPixel;
use crate::math::hints::keep_rolled;
use crate::raster::{rest, share, unrounded_rest, weighted_area, LineArea, LineCoverage, LineEnds, Scissor};
use crate::shading::StrokeKind;
use crate::surface::Surface;
use core::cell::Cell;

use super::{memory_of, table_line::table_line};

/// Draws a line, whose columns lie in the scissor, which lies in the target, and returns `true`; or draws nothing.
#[inline(always)]
pub(crate) fn anti_aliased_line<T: Surface, K: StrokeKind<T::Color>>(
    line: &LineCoverage,
    area: &LineArea,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) -> bool {
    if K::BY_TABLE {
        return table_line(line, [false; 2], stroke, target);
    }
    if line.tall && !line.inside {
        return false;
    }
    let Some(memory) = memory_of(target) else { return false };
    let (cells, scratch) = memory.parts();
    let layout = scratch.layout;
    let mix = stroke.mixer();
    let mix = move |cell, rest| mix(T::Color::load(cell), rest).stored();
    let slope = line.slope();
    let row = if line.rises { !line.row } else { line.row };
    let count = line.end - line.first; // at least 1
    if line.tall {
        // A mirrored line is turned back: the complements of its row and fraction, and the opposite slope.
        let fraction = if line.rises { !line.fraction } else { line.fraction };
        let signed =
            |distance: i64| if line.rises { distance.wrapping_neg() as u64 } else { distance as u64 };
        let stride = (layout.stride as u64) << 32;
        let last = u64::from(fraction)
            .wrapping_add(stride.wrapping_mul((count - 1) as u64))
            .wrapping_add(signed(line.distance(count - 1)));
        // Two pixels before the first one, up to two pixels after the last one.
        let first = layout.at(row - 2, line.first);
        if let Some(cells) = cells.get_mut(first..first.wrapping_add((last >> 32) as usize + 5)) {
            let cells = Cell::from_mut(cells).as_slice_of_cells();
            let step = stride.wrapping_add(signed(slope.into()));
            tall(cells, fraction.into(), step, area, K::SHARE_BITS, mix);
        }
    } else {
        let (rows, columns) = (scissor.rows(), scissor.columns());
        let first = layout.at(columns.start, rows.start);
        let at = layout.at(line.first, row).wrapping_sub(first);
        let down = if line.rises { layout.stride.wrapping_neg() } else { layout.stride };
        if let Some(cells) = cells.get_mut(first..layout.at(columns.end, rows.end - 1)) {
            wide(cells, at, count, down, [line.fraction, slope], area, K::SHARE_BITS, mix);
        }
    }
    true
}

/// Draws an edge with an opaque stroke, if it lies inside the scissor, which lies in the target, and is so long that its start and its end are
/// parts of their own, and returns `true`; or draws nothing. `parts` are the columns at its start, in its middle and at its end.
#[inline(always)]
pub(crate) fn anti_aliased_edge<T: Surface, K: StrokeKind<T::Color>>(
    parts: &[LineCoverage; 3],
    area: &LineArea,
    weights: &[LineEnds; 2],
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) -> bool {
    let [start, middle, end] = parts;
    if cfg!(target_family = "wasm") || !K::IS_OPAQUE || !start.inside || end.first >= end.end {
        return false;
    }
    let Some(memory) = memory_of(target) else { return false };
    let (cells, scratch) = memory.parts();
    let layout = scratch.layout;
    let mix = stroke.mixer();
    let mix = move |cell, area, weight| {
        let share = if weight < LineEnds::ALL { weighted_area(area, weight) } else { area };
        mix(T::Color::load(cell), rest(share, K::SHARE_BITS)).stored()
    };
    let (along, aside) = if start.tall { (layout.stride, 1) } else { (1, layout.stride) };
    let aside = if start.rises { aside.wrapping_neg() } else { aside };
    for (part, weights) in [(start, &weights[0]), (end, &weights[1])] {
        let row = if part.rises { !part.row } else { part.row };
        let [x, y] = if part.tall { [row, part.first] } else { [part.first, row] };
        let weight = weights.of_one_end([part.first, part.row]);
        let (count, minor) = (part.end - part.first, [part.fraction, part.slope()]);
        around_end(cells, layout.at(x, y), count, [along, aside], minor, area, weight, K::SHARE_BITS, mix);
    }
    anti_aliased_line(middle, area, scissor, stroke, target);
    true
}

/// Draws the columns around an end. `at` is the index of the first middle pixel; the next column lies `along` further, and the next row
/// `aside`. `weight`: the middle pixel's, and its change per column and per row, in 2⁻²⁰. `mix` returns a pixel of which the line covers
/// an area, with a weight.
#[inline(never)] // its loop needs all registers
#[allow(clippy::too_many_arguments)]
fn around_end<C: Copy>(
    cells: &mut [C],
    mut at: usize,
    count: i32,
    [along, aside]: [usize; 2],
    [mut fraction, slope]: [u32; 2],
    area: &LineArea,
    [mut weight, by_column, by_row]: [i32; 3],
    bits: u32,
    mix: impl Fn(C, i32, i32) -> C,
) {
    for _ in 0..count {
        let areas = area.column(fraction);
        // Few columns have five pixels.
        let (mut index, mut own, areas) = match &areas {
            [0, areas @ .., 0] => (at, weight, areas.as_slice()),
            areas => (at.wrapping_sub(aside), weight.wrapping_sub(by_row), areas.as_slice()),
        };
        (index, own) = (index.wrapping_sub(aside), own.wrapping_sub(by_row));
        for &area in areas {
            if share(area, bits) != 0
                && own >= 1 << 20
                && let Some(pixel) = cells.get_mut(index)
            {
                *pixel = mix(*pixel, area, own >> 20);
            }
            (index, own) = (index.wrapping_add(aside), own.wrapping_add(by_row));
            keep_rolled();
        }
        let carries;
        (fraction, carries) = fraction.overflowing_add(slope);
        (at, weight) = (at.wrapping_add(along), weight.wrapping_add(by_column));
        if carries {
            (at, weight) = (at.wrapping_add(aside), weight.wrapping_add(by_row));
        }
        keep_rolled();
    }
}

/// Where the line reaches `$x` beyond a border of the middle pixel, takes the area beyond it from what is `$left` of that pixel, and mixes the
/// pixel beyond it, `$near`, and the one after that, `$far`. S6 takes 8 % more instructions on an M3 if this is an inlined function.
macro_rules! beside {
    ($left:ident, $x:ident, $near:ident[$at:expr], $cells:ident[$far:expr], $area:ident, $bits:ident, $mix:ident) => {
        if $x > 0 {
            let (mut beyond, far) = $area.area($x);
            $left += beyond;
            if far != 0 {
                beyond -= far;
                put($cells, $far, rest(far, $bits), &$mix);
            }
            let share = share(beyond, $bits);
            if share != 0
                && let Some(pixel) = $near.get($at)
            {
                pixel.set($mix(pixel.get(), (1 << $bits) - share));
            }
        }
    };
}

/// Draws a line with one row per column. `at` is the index of the middle pixel relative to the first one, in 32.32, in which the position
/// in that pixel is the fraction; `cells` begins two pixels before the first one and ends two after the last one.
#[inline(never)] // its loop needs all registers
fn tall<C: Copy>(
    cells: &[Cell<C>],
    mut at: u64,
    step: u64,
    area: &LineArea,
    bits: u32,
    mix: impl Fn(C, u32) -> C,
) {
    let [_, before @ ..] = cells else { return };
    let [_, middle @ ..] = before else { return };
    let [_, after @ .., _] = middle else { return };
    let (Some(before), Some(middle)) = (before.get(..after.len()), middle.get(..after.len())) else { return };
    let all_left = unrounded_rest(area.height, bits);
    while let Some(pixel) = middle.get((at >> 32) as usize) {
        let index = (at >> 32) as usize;
        let mut left = all_left;
        let [above, below] = area.beyond(at as u32);
        beside!(left, above, before[index], cells[index], area, bits, mix);
        beside!(left, below, after[index], cells[index + 4], area, bits, mix);
        pixel.set(mix(pixel.get(), (left >> (16 - bits)) as u32));
        at = at.wrapping_add(step);
        keep_rolled();
    }
}

/// Mixes a pixel, if it is one of these cells.
#[cold]
#[inline(never)]
fn put<C: Copy>(cells: &[Cell<C>], index: usize, rest: u32, mix: &impl Fn(C, u32) -> C) {
    if let Some(pixel) = cells.get(index) {
        pixel.set(mix(pixel.get(), rest));
    }
}

/// Draws a line with one pixel column per column. `at` is the index of the first middle pixel; where the sum of the fraction and the slope
/// carries, the next one lies `down` further.
#[inline(never)] // its loop needs all registers
#[allow(clippy::too_many_arguments)]
fn wide<C: Copy>(
    cells: &mut [C],
    mut at: usize,
    count: i32,
    down: usize,
    [mut fraction, slope]: [u32; 2],
    area: &LineArea,
    bits: u32,
    mix: impl Fn(C, u32) -> C,
) {
    let cells = Cell::from_mut(cells).as_slice_of_cells();
    let (all_left, twice) = (unrounded_rest(area.height, bits), down.wrapping_mul(2));
    for _ in 0..count {
        let mut left = all_left;
        let [above, below] = area.beyond(fraction);
        beside!(left, above, cells[at.wrapping_sub(down)], cells[at.wrapping_sub(twice)], area, bits, mix);
        beside!(left, below, cells[at.wrapping_add(down)], cells[at.wrapping_add(twice)], area, bits, mix);
        if let Some(pixel) = cells.get(at) {
            pixel.set(mix(pixel.get(), (left >> (16 - bits)) as u32));
        }
        let carries;
        (fraction, carries) = fraction.overflowing_add(slope);
        if carries {
            at = at.wrapping_add(down);
        }
        at = at.wrapping_add(1);
        keep_rolled();
    }
}
