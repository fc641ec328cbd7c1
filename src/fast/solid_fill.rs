//! Triangles of one colour, into memory.
//!
//! - **Plain twin**: `pipeline::fill::fill`, which passes each span to `Target::fill`.
//! - **Domain**: every triangle, on a target whose pixels lie in memory.
//! - **Gain**: rows go from the edge walker to the cells without a span in between; a small triangle (32 × 30 pixels, or 31 rows
//!   on a Cortex-M0) has a loop of its own with all registers. Not measured alone: all fast paths together halve the time of S3.
//! - **Test**: `by_every_call` in `tests/support/src/bridge/ways.rs`, and `tests/raster/memory_triangles.rs`.

use super::attach::memory_with_drawable;
use super::Rows;
use super::{memory_of, Low, Small};
use crate::color::StoredPixel;
use crate::math::cores::CORTEX_M0;
use crate::raster::{AnyTriangle, PixelLayout, Scissor, ScreenPoint, Trapezoid, Triangle};
use crate::surface::block_fill::{fill_pairs, LONG};
use crate::surface::{PixelRows, PixelStore, Target};

/// Fills a triangle, if the target's pixels lie in memory; otherwise draws nothing and returns `false`. `is_clipped`: the
/// triangle probably has rows outside the scissor, so the [`Small`] tier is not tried.
#[inline(always)]
pub(crate) fn triangle<T: Target>(
    triangle: &Triangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    is_clipped: bool,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    match is_clipped {
        true => fill_low(memory, triangle, scissor, [color.stored(); 2]),
        false => fill_small(memory, triangle, scissor, [color.stored(); 2]),
    }
    true
}

/// [`triangle`] for 2D drawing, clipped to the part of the target that 2D drawing can reach. `area` is the
/// [`area`](crate::raster::area()) of the corners and not zero.
#[inline(always)]
pub(crate) fn triangle_2d<T: Target>(
    corners: [ScreenPoint; 3],
    area: i64,
    color: T::Color,
    target: &mut T,
) -> bool {
    let Some((scissor, memory)) = memory_with_drawable(target) else { return false };
    fill_small(memory, &Triangle::new(corners, area, scissor), scissor, [color.stored(); 2]);
    true
}

/// Fills a triangle of the [`Small`] tier; passes all others to [`fill_low`]. `pair` is the stored pixel twice, as two
/// arguments: LLVM does not know that they are equal, so it stores two 16-bit pixels from one register.
#[inline(never)] // its loop needs all registers
fn fill_small<S: PixelStore>(
    memory: &mut PixelRows<S>,
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    pair: [S::Cell; 2],
) {
    match Small::new(triangle, scissor, memory.scratch()) {
        Some(small) => fill_rows(small, memory, pair),
        None => fill_low(memory, triangle, scissor, pair),
    }
}

/// Fills a triangle of the [`Low`] tier, which may be wide, and may begin or end beyond the scissor's rows; passes all others to
/// [`fill_any`].
#[inline(never)]
fn fill_low<S: PixelStore>(
    memory: &mut PixelRows<S>,
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    pair: [S::Cell; 2],
) {
    match Low::new(triangle, scissor, memory.scratch()) {
        Some(low) => fill_rows(low, memory, pair),
        // In close-ups, most triangles that `Low` declines lie beside the picture.
        None if triangle.is_beside(scissor) => {}
        None => {
            let (cells, scratch) = memory.parts();
            fill_any(cells, scratch.layout, triangle, scissor, pair);
        }
    }
}

#[inline(always)]
fn fill_rows<R: Rows, S: PixelStore>(rows: R, memory: &mut PixelRows<S>, pair: [S::Cell; 2]) {
    let (cells, scratch) = memory.parts();
    let may_be_long = R::WIDTH > LONG << 8;
    rows.each(scratch, |start, left, right| fill_row(cells, start, left, right, pair, may_be_long));
}

/// Fills any triangle, trapezoid by trapezoid.
#[inline(never)] // its loop needs all registers
fn fill_any<Cell: Copy>(
    cells: &mut [Cell],
    layout: PixelLayout,
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    pair: [Cell; 2],
) {
    let (mut triangle, mut trapezoid) = (AnyTriangle::new(triangle, scissor), Trapezoid::without_rows());
    while triangle.trapezoid(&mut trapezoid) {
        match trapezoid.as_rectangle(layout.stride as i32) {
            // A face wider than the picture is clipped at both sides: its rows join into one run.
            Some((x, pixels)) => {
                let from = layout.at(x, trapezoid.y);
                if let Some(run) = cells.get_mut(from..from.wrapping_add(pixels as usize)) {
                    fill_pairs(run, pair, true);
                }
            }
            None => {
                let start = layout.at(trapezoid.x, trapezoid.y);
                trapezoid.each(start, layout.stride, |start, left, right| {
                    fill_row(cells, start, left, right, pair, true);
                });
            }
        }
    }
}

/// Fills the row from `left` up to but excluding `right`, both counted from index `start`; nothing if `right < left`.
#[inline(always)]
fn fill_row<Cell: Copy>(
    cells: &mut [Cell],
    start: usize,
    left: i32,
    right: i32,
    pair: [Cell; 2],
    may_be_long: bool,
) {
    let from = start.wrapping_add(left as usize);
    // If the row ends before it begins, the difference wraps to more than any slice has.
    let width = right.wrapping_sub(left) as usize;
    // On a Cortex-M0 both ends are indices already; on other cores the width is in a register.
    if CORTEX_M0 {
        if let Some(run) = cells.get_mut(from..from.wrapping_add(width)) {
            fill_pairs(run, pair, may_be_long);
        }
    } else if let Some(run) = cells.get_mut(from..)
        && let Some(run) = run.get_mut(..width)
    {
        fill_pairs(run, pair, may_be_long);
    }
}
