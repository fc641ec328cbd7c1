//! Lines of one colour, into memory.
//!
//! - **Plain twin**: `pipeline::fill::line`, which passes each span of `raster::line` to `Surface::fill`.
//! - **Domain**: every line, on a target whose pixels lie in memory.
//! - **Gain**: a steep line costs no span and no error term per pixel: its step takes two instructions. Not measured alone.
//! - **Test**: `by_every_call` in `tests/support/src/bridge/ways.rs`, and `tests/raster/lines.rs` against
//!   an oracle.
//!
//! A steep line moves one row at each step, so the indices of its pixels only grow or only fall: the loop gets the slice that
//! ends with the last pixel, and the bounds check of an index also ends the loop. An index is a fixed-point number with 32
//! fractional bits, whose carry is the step to the next column. A flat line is drawn with Bresenham's error term.

use super::line_slope::{slope, HALF, LONGEST};
use super::memory_of;
use super::put_run::{put_each, OneInk, Stored};
use crate::color::StoredPixel;
use crate::math::hints::{keep_branch, keep_rolled};
use crate::raster::{LineSetup, LineSpans, Pixel, PixelLayout, RowScratch, Scissor, Span};
use crate::surface::block_fill::{fill_pairs, pair};
use crate::surface::Surface;

/// Draws a line inside the scissor, which lies in the target, if the target's pixels lie in memory; otherwise draws nothing and
/// returns `false`.
#[inline(always)]
pub(crate) fn line_into_memory<T: Surface>(
    from: Pixel,
    to: Pixel,
    scissor: &Scissor,
    color: T::Color,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    let (cells, &mut RowScratch { layout, .. }) = memory.parts();
    line(cells, layout, from, to, scissor, color.stored());
    true
}

/// Draws a line into `cells`, row by row. Slice and layout are separate arguments, so that they stay in registers from line to
/// line.
#[inline(never)] // its loops need all registers
fn line<Cell: Copy>(
    cells: &mut [Cell],
    layout: PixelLayout,
    from: Pixel,
    to: Pixel,
    scissor: &Scissor,
    cell: Cell,
) {
    let setup = LineSetup::new(from, to);
    if !setup.lies_in(scissor) || setup.tall && !is_short(&setup, layout.stride) {
        return cut(cells, layout, (setup.x, setup.y), setup.end, scissor, cell);
    }
    let (start, end) = ((setup.x, setup.y), setup.end);
    if setup.tall {
        steep(cells, layout, start, end, &setup, 0, cell);
    } else if setup.rise <= setup.length >> 2 {
        gentle(
            cells,
            layout.at(start.0, start.1),
            down(layout.stride, setup.up),
            setup.rise,
            setup.length,
            cell,
        );
    } else {
        flat(cells, layout, start, end, &setup, -1 - setup.length, cell);
    }
}

/// Draws the part of a line that lies in the scissor, or a line for which [`steep`] is not exact.
#[cold]
#[inline(never)]
fn cut<Cell: Copy>(
    cells: &mut [Cell],
    layout: PixelLayout,
    from: (i32, i32),
    to: (i32, i32),
    scissor: &Scissor,
    cell: Cell,
) {
    let [highest, lowest] = [from.1.min(to.1), from.1.max(to.1)];
    // Most lines that come here in a close-up lie beside the scissor. `from` has the smaller column.
    if to.0 < scissor.left || from.0 >= scissor.right || lowest < scissor.top || highest >= scissor.bottom {
        return;
    }
    let setup = LineSetup::between(from, to).clipped(scissor);
    let LineSetup { x, y, tall, up, length, first, last, .. } = setup;
    if first > last {
        return;
    }
    // A line of one pixel lies in the scissor or was left out above, so the length is not 0.
    let ((aside, rest), (last_aside, _)) = (setup.aside(first), setup.aside(last));
    let at = |step: i32, aside: i32| {
        let (right, down) = if tall { (aside, step) } else { (step, aside) };
        (x + right, if up { y - down } else { y + down })
    };
    let (start, end) = (at(first, aside), at(last, last_aside));
    if !tall {
        // `raster::line` has `rest` + 1 + 2m − 2L there.
        flat(cells, layout, start, end, &setup, rest - 2 * length, cell);
    } else if is_short(&setup, layout.stride) {
        steep(cells, layout, start, end, &setup, first as u32, cell);
    } else {
        by_runs(cells, layout, from, to, scissor, cell);
    }
}

/// The change of an index from a row of the line to the line's next row.
#[inline(always)]
fn down(stride: usize, up: bool) -> usize {
    if up {
        stride.wrapping_neg()
    } else {
        stride
    }
}

/// Draws a line that runs more to the right than down or up, pixel by pixel. `error` is the error term of
/// `raster::line` at the first pixel, less 2m + 1, for the minor extent m: the line goes to its next
/// row where adding 2m makes it 0 or more.
#[cfg_attr(all(target_arch = "arm", not(target_has_atomic = "32")), inline(never))] // a Cortex-M0 has registers for a loop, not for the rest
#[cfg_attr(not(all(target_arch = "arm", not(target_has_atomic = "32"))), inline(always))]
fn flat<Cell: Copy>(
    cells: &mut [Cell],
    layout: PixelLayout,
    (x, y): (i32, i32),
    end: (i32, i32),
    setup: &LineSetup,
    error: i32,
    cell: Cell,
) {
    // Downwards the slice ends before the line's first column in its last row; upwards it begins at that column in the row below the last
    // one. The line has at most as many columns as a row, so the index leaves the slice where the line comes to its last row.
    let last = layout.at(x, end.1);
    let (low, high) = if setup.up { (last.wrapping_add(layout.stride), cells.len()) } else { (0, last) };
    let (mut at, down) = (layout.at(x, y).wrapping_sub(low), down(layout.stride, setup.up));
    // The error is negative at every pixel: the addition carries where it becomes 0 or more.
    let (along, back) = (2 * setup.rise as u32, 2 * setup.length as u32);
    let mut error = error as u32;
    if let Some(cells) = cells.get_mut(low..high) {
        while let Some(pixel) = cells.get_mut(at) {
            *pixel = cell;
            let carries;
            (error, carries) = error.overflowing_add(along);
            if carries {
                keep_branch(); // not a conditional sum
                error = error.wrapping_sub(back);
                at = at.wrapping_add(down);
            }
            at = at.wrapping_add(1);
            keep_rolled();
        }
    }
    if let Some(run) = cells.get_mut(at.wrapping_add(low)..layout.at(end.0, end.1).wrapping_add(1)) {
        put_each::<Cell, true>(run, OneInk(Stored(cell))); // a few pixels
    }
}

/// Draws a flat line that is not clipped and whose runs have four pixels or more, run by run.
///
/// With L and m the major and minor extent, the last step in row K is ⌊(2K + 1)·L / 2m⌋: each run has ⌊L/m⌋ pixels or one more.
/// (Bresenham, *Run length slice algorithm for incremental lines*, 1985.)
#[inline(never)] // its loop needs all registers
fn gentle<Cell: Copy>(cells: &mut [Cell], mut at: usize, down: usize, rise: i32, length: i32, cell: Cell) {
    let pair = pair(cell);
    let mut left = length + 1;
    if let Some(least) = length.checked_div(rise) {
        let (back, first) = (2 * rise, least >> 1);
        // The remainder of L / 2m, whose quotient is `first`, less 2m: negative.
        let mut error = length - first * back - back;
        let along = 2 * (length - least * rise);
        let mut run = first + 1;
        for _ in 0..rise {
            let next = at.wrapping_add(run as usize);
            if let Some(run) = cells.get_mut(at..next) {
                fill_pairs(run, pair, true);
            }
            at = next.wrapping_add(down);
            left -= run;
            run = least;
            error += along;
            if error >= 0 {
                error -= back;
                run += 1;
            }
        }
    }
    if let Some(run) = cells.get_mut(at..at.wrapping_add(left as usize)) {
        fill_pairs(run, pair, true);
    }
}

/// Draws a line that runs more down or up than to the right. `first` is the number of rows between the start of the line and its
/// first pixel in the scissor.
#[cfg_attr(all(target_arch = "arm", not(target_has_atomic = "32")), inline(never))] // a Cortex-M0 has registers for a loop, not for the rest
#[cfg_attr(not(all(target_arch = "arm", not(target_has_atomic = "32"))), inline(always))]
fn steep<Cell: Copy>(
    cells: &mut [Cell],
    layout: PixelLayout,
    (x, y): (i32, i32),
    end: (i32, i32),
    setup: &LineSetup,
    first: u32,
    cell: Cell,
) {
    let (start, end) = (layout.at(x, y), layout.at(end.0, end.1));
    let (low, high) = if setup.up { (end, start) } else { (start, end) };
    let Some(cells) = cells.get_mut(low..high.wrapping_add(1)) else { return };
    // Columns per row, in 2⁻³².
    let slope = slope(setup);
    let mut at = fixed(start.wrapping_sub(low), slope.wrapping_mul(first).wrapping_add(HALF));
    let step = fixed(down(layout.stride, setup.up), slope);
    // After the last pixel the index is beyond the end of the slice; moving upwards it wraps below 0, which is beyond the end,
    // too.
    while let Some(pixel) = cells.get_mut((at >> 32) as usize) {
        *pixel = cell;
        at = at.wrapping_add(step);
        keep_rolled();
    }
}

/// The number `integer` + `fraction`·2⁻³², in 32.32.
#[inline(always)]
fn fixed(integer: usize, fraction: u32) -> u64 {
    (integer as u64) << 32 | u64::from(fraction)
}

/// Whether [`steep`] draws the line exactly. It needs at least two columns, so that the index after the last pixel leaves the
/// slice, and at most 2¹⁵ columns and 2¹³ rows, so that indices have less than 32 bits.
#[inline(always)]
fn is_short(setup: &LineSetup, stride: usize) -> bool {
    setup.length <= LONGEST && (2..=0x8000).contains(&stride)
}

/// Draws the part of a line that lies in the scissor span by span, like the plain path: for steep lines for which [`steep`] is
/// not exact.
#[cold]
#[inline(never)]
fn by_runs<Cell: Copy>(
    cells: &mut [Cell],
    layout: PixelLayout,
    from: (i32, i32),
    to: (i32, i32),
    scissor: &Scissor,
    cell: Cell,
) {
    for Span { x, y, width, height } in LineSpans::new(&LineSetup::between(from, to), scissor) {
        for y in y..y.wrapping_add(height) {
            let from = layout.at(x, y);
            if let Some(run) = cells.get_mut(from..from.wrapping_add(width as usize)) {
                run.fill(cell);
            }
        }
    }
}
