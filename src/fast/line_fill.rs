//! Lines of one colour, into memory.
//!
//! - **Plain twin**: `pipeline::fill::line`, which passes each span of [`raster::line`](crate::raster::line()) to `Target::fill`.
//! - **Domain**: every line, on a target whose pixels lie in memory.
//! - **Gain**: no span and no error term for each pixel of a steep line: two instructions for its step.
//! - **Test**: `pipeline::fill::tests`; `tests/memory_lines.rs` holds it against the oracle.
//!
//! A steep line moves one row at each step, so that the indices of its pixels only grow, or only fall: the loop gets the slice
//! that ends with the last pixel, and the bounds check of an index also ends the loop. Indices are fixed-point numbers with 32
//! fractional bits, whose carry is the step aside. A flat line is drawn row by row, with Bresenham's error in integers.

use super::memory_of;
use crate::math::num::{mul_high, reciprocal};
use crate::raster::{pixel_index, LineSetup, LineSpans, Pixel, Scissor, Span};
use crate::surface::block_fill::{fill_pairs, pair};
use crate::surface::{StoredPixel, Target};
use core::hint::black_box;
use embedded_graphics_core::primitives::Rectangle;

/// Draws a line, unless the target's pixels do not lie in memory. The scissor lies in the target.
#[inline(always)]
pub(crate) fn line_into_memory<T: Target>(
    from: Pixel,
    to: Pixel,
    scissor: &Scissor,
    color: T::Color,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    let Rectangle { top_left, size } = memory.area();
    let (cells, _) = memory.parts();
    // Counted from the first pixel. These wrap where the area begins so far away that no pixel of it is in the scissor.
    let (right, down) = (|x: i32| x.wrapping_sub(top_left.x), |y: i32| y.wrapping_sub(top_left.y));
    let moved = |p: Pixel| (right(p.x.into()), down(p.y.into()));
    let (rows, columns) = (scissor.rows(), scissor.columns());
    if !rows.is_empty() && !columns.is_empty() {
        let scissor =
            Scissor::unclamped(right(columns.start), down(rows.start), right(columns.end), down(rows.end));
        line(cells, size.width as usize, moved(from), moved(to), &scissor, color.stored());
    }
    true
}

/// Draws a line into cells, row by row. The parts of the memory are arguments: from line to line they stay in registers.
#[inline(never)] // its loops need all registers
fn line<Cell: Copy>(
    cells: &mut [Cell],
    stride: usize,
    from: (i32, i32),
    to: (i32, i32),
    scissor: &Scissor,
    cell: Cell,
) {
    let course = LineSetup::between(from, to);
    if !course.lies_in(scissor) || course.tall && !is_short(&course, stride) {
        return cut(cells, stride, (course.x, course.y), course.end, scissor, cell);
    }
    let (start, end) = ((course.x, course.y), course.end);
    if course.tall {
        steep(cells, stride, start, end, &course, 0, cell);
    } else if course.rise <= course.length >> 2 {
        gentle(
            cells,
            pixel_index(start.0, start.1, stride),
            down(stride, course.up),
            course.rise,
            course.length,
            cell,
        );
    } else {
        flat(cells, stride, start, end, &course, -1 - course.length, cell);
    }
}

/// Draws the part of a line that lies in the scissor.
#[cold]
#[inline(never)]
fn cut<Cell: Copy>(
    cells: &mut [Cell],
    stride: usize,
    from: (i32, i32),
    to: (i32, i32),
    scissor: &Scissor,
    cell: Cell,
) {
    let course = LineSetup::between(from, to).clipped(scissor);
    let LineSetup { x, y, tall, up, length, first, last, .. } = course;
    if first > last {
        return;
    }
    // The line is longer than one pixel.
    let ((aside, rest), (last_aside, _)) = (course.aside(first), course.aside(last));
    let at = |step: i32, aside: i32| {
        let (right, down) = if tall { (aside, step) } else { (step, aside) };
        (x + right, if up { y - down } else { y + down })
    };
    let (start, end) = (at(first, aside), at(last, last_aside));
    if !tall {
        // `raster::line` has `rest` + 1 + 2m − 2L there.
        flat(cells, stride, start, end, &course, rest - 2 * length, cell);
    } else if is_short(&course, stride) {
        steep(cells, stride, start, end, &course, first as u32, cell);
    } else {
        by_runs(cells, stride, from, to, scissor, cell);
    }
}

/// The step of an index from a row to the line's next row.
#[inline(always)]
fn down(stride: usize, up: bool) -> usize {
    if up {
        stride.wrapping_neg()
    } else {
        stride
    }
}

/// Draws a line that runs more to the right than down or up, pixel by pixel. `error` is that of
/// [`raster::line`](crate::raster::line()) less 1 and less 2m, at the first pixel; where it is not negative once 2m is added, the
/// line steps aside.
#[cfg_attr(all(target_arch = "arm", not(target_has_atomic = "32")), inline(never))] // a Cortex-M0 has registers for a loop, not for the rest
#[cfg_attr(not(all(target_arch = "arm", not(target_has_atomic = "32"))), inline(always))]
fn flat<Cell: Copy>(
    cells: &mut [Cell],
    stride: usize,
    (x, y): (i32, i32),
    end: (i32, i32),
    course: &LineSetup,
    error: i32,
    cell: Cell,
) {
    // All rows but the last one: the index leaves this slice when the line comes to its last row.
    let last = pixel_index(0, end.1, stride);
    let (low, high) = if course.up { (last.wrapping_add(stride), cells.len()) } else { (0, last) };
    let (mut at, down) = (pixel_index(x, y, stride).wrapping_sub(low), down(stride, course.up));
    // The error is negative at every pixel: the addition carries where it becomes 0 or more.
    let (along, back) = (2 * course.rise as u32, 2 * course.length as u32);
    let mut error = error as u32;
    if let Some(cells) = cells.get_mut(low..high) {
        while let Some(pixel) = cells.get_mut(at) {
            *pixel = cell;
            let carries;
            (error, carries) = error.overflowing_add(along);
            if carries {
                black_box(()); // a branch, not a conditional sum
                error = error.wrapping_sub(back);
                at = at.wrapping_add(down);
            }
            at = at.wrapping_add(1);
            black_box(()); // not unrolled
        }
    }
    if let Some(run) = cells.get_mut(at.wrapping_add(low)..pixel_index(end.0, end.1, stride).wrapping_add(1))
    {
        for pixel in run {
            *pixel = cell;
            black_box(()); // not unrolled: a few pixels
        }
    }
}

/// Draws a flat line that is not clipped and whose runs have four pixels or more, run by run.
///
/// The last step in row K is ⌊(2K + 1)·L / 2m⌋: from row to row ⌊L/m⌋ more, or one more than that. (Bresenham, *Run length
/// slice algorithm for incremental lines*, 1985.)
#[inline(never)] // its loop needs all registers
fn gentle<Cell: Copy>(cells: &mut [Cell], mut at: usize, down: usize, rise: i32, length: i32, cell: Cell) {
    let pair = pair(cell);
    let mut left = length + 1;
    if let Some(least) = length.checked_div(rise) {
        let (back, first) = (2 * rise, least >> 1);
        // The remainder of the division by 2m, less 2m: negative.
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

/// Draws a line that runs more down or up than to the right. `first` is the step of the first pixel.
#[cfg_attr(all(target_arch = "arm", not(target_has_atomic = "32")), inline(never))] // a Cortex-M0 has registers for a loop, not for the rest
#[cfg_attr(not(all(target_arch = "arm", not(target_has_atomic = "32"))), inline(always))]
fn steep<Cell: Copy>(
    cells: &mut [Cell],
    stride: usize,
    (x, y): (i32, i32),
    end: (i32, i32),
    course: &LineSetup,
    first: u32,
    cell: Cell,
) {
    let (start, end) = (pixel_index(x, y, stride), pixel_index(end.0, end.1, stride));
    let (low, high) = if course.up { (end, start) } else { (start, end) };
    let Some(cells) = cells.get_mut(low..high.wrapping_add(1)) else { return };
    // Steps aside in a row, in 2⁻³².
    let slope = slope(course);
    let mut at = fixed(start.wrapping_sub(low), slope.wrapping_mul(first).wrapping_add(HALF));
    let step = fixed(down(stride, course.up), slope);
    // The index after the last pixel lies beyond the slice, or wraps far beyond it.
    while let Some(pixel) = cells.get_mut((at >> 32) as usize) {
        *pixel = cell;
        at = at.wrapping_add(step);
        black_box(()); // not unrolled
    }
}

#[inline(always)]
fn fixed(whole: usize, part: u32) -> u64 {
    (whole as u64) << 32 | u64::from(part)
}

/// Just below ½, in 2⁻³².
///
/// After i steps a line has made ⌊(2mi + L − 1)/2L⌋ steps aside, for its minor extent m and its major extent L. The sum of i
/// slopes and this constant is that number before rounding, plus 1/2L − 2⁻³², minus i times what the slope is short of m/L.
/// Rounded down both are equal as long as the difference is not negative (so the floor is not too low) and below 1/2L (the
/// rounded numbers are multiples of 1/2L).
const HALF: u32 = (1 << 31) - 1;

/// The largest L with 48·L + 1 ≤ 2³²/2L: a slope is short by less than 48 · 2⁻³².
const LONGEST: i32 = 6688;

/// Whether [`steep`] draws the line exactly. With two columns or more the index after the last pixel is larger; with at most 2¹⁵
/// columns and 2¹³ rows, the indices from one end to the other have less than 32 bits.
#[inline(always)]
fn is_short(course: &LineSetup, stride: usize) -> bool {
    course.length <= LONGEST && (2..=0x8000).contains(&stride)
}

/// m/L in 2⁻³², short by at least 0 and less than 48; 0 for 0. `0 ≤ m ≤ L`, `0 < L ≤ LONGEST`.
#[inline(always)]
fn slope(&LineSetup { rise, length, .. }: &LineSetup) -> u32 {
    let r = reciprocal(length);
    // m·2^shift ≤ L·2^shift < 2³¹, and the mantissa is 2⁶¹/(L·2^shift) within 2⁻²⁸: the high word is m/L in 2⁻²⁹, within
    // 2 and rounded down. So 3 less is short by 0 to 6, and below 2²⁹.
    let high = mul_high(rise << r.shift, r.mantissa) - 3;
    (high.max(0) as u32) << 3
}

/// Draws a line span by span: the slow path.
#[cold]
#[inline(never)]
fn by_runs<Cell: Copy>(
    cells: &mut [Cell],
    stride: usize,
    from: (i32, i32),
    to: (i32, i32),
    scissor: &Scissor,
    cell: Cell,
) {
    for Span { x, y, width, height } in LineSpans::new(&LineSetup::between(from, to), scissor) {
        for y in y..y.wrapping_add(height) {
            let from = pixel_index(x, y, stride);
            if let Some(run) = cells.get_mut(from..from.wrapping_add(width as usize)) {
                run.fill(cell);
            }
        }
    }
}
