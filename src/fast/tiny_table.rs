//! Triangles of a few pixels with colours of a [`ShadeTable`](crate::shading::ShadeTable) and depth: the faces of a height field.
//!
//! - **Plain twin**: `pipeline::fill::fill_nearer` with `SpanShader::span` of [`TableShader`].
//! - **Domain**: an area above 0 and of at most [`MOST_AREA`], in a box of at most 15 × 4 pixel centres whose columns lie inside the scissor;
//!   rows may lie outside. On a target whose pixels lie in memory, with depth where the depth buffer is laid out as the memory is. Not on a
//!   Cortex-M0, where a division is a call.
//! - **Gain**: the ends of a row take two divisions, and edges no step; a triangle that covers no pixel centre has no gradient, and rows
//!   outside a band no edge. On an M3, F1 takes 3 % fewer instructions, 16 % in bands of 8 rows (`tools/bench/run cells F1 z bands8-z M3`).
//! - **Test**: `tiny_faces_with_depth_are_those_of_the_plain_path` in `tests/shading/bands.rs`.

use super::depth_and_light_gradients;
use super::fill_rows::same_length;
use crate::color::StoredPixel;
use crate::math::hints::keep_rolled;
use crate::raster::edge::first_row;
use crate::raster::{DepthTriangle, RowScratch, Scissor, ScreenPoint};
use crate::shading::TableShader;
use crate::surface::{PixelRows, PixelStore};

/// The largest area of a triangle, twice that in square sub-pixels: 8 pixels. Larger ones seldom fit into the box.
pub(super) const MOST_AREA: i64 = 8 << 17;

/// The columns and rows of the box: four bits hold a number of columns, and a word both ends of each row.
const COLUMNS: i32 = 15;
const ROWS: i32 = 4;

/// An edge that leads down. In each row a division gives its end, ⌈T⌉ of `raster/edge.rs`.
struct TinyEdge {
    /// The numerator of T, plus the denominator less 1, which rounds the quotient up. Not negative in rows that the edge meets.
    numerator: i32,
    /// The change of the numerator from a row to the next.
    step: i32,
    denominator: u32,
}

impl TinyEdge {
    /// The edge from `p` down to `q` at row `y`. Columns are counted from `x`, the first one of the triangle's box. An edge that meets no row
    /// may have any height.
    #[inline(always)]
    fn new(p: &ScreenPoint, q: &ScreenPoint, x: i32, y: i32) -> Self {
        let (dx, dy) = (q.x - p.x, (q.y - p.y).max(1));
        // With the box, each difference is below 2¹³, and each product below 2²⁶.
        let numerator = dx * ((y << 8) + 128 - p.y) - dy * ((x << 8) - 128 - p.x) - 1;
        Self { numerator: numerator >> 8, step: dx, denominator: dy as u32 }
    }

    /// The end of the row; advances to the row below.
    #[inline(always)]
    fn next(&mut self) -> u32 {
        let column = self.numerator as u32 / self.denominator;
        self.numerator += self.step;
        column
    }
}

/// Appends the rows between two edges: the first column of each and its number of pixels, four bits each.
#[inline(always)]
fn append_rows(left: &mut TinyEdge, right: &mut TinyEdge, rows: i32, ends: &mut u32) {
    for _ in 0..rows {
        let (left, right) = (left.next(), right.next());
        *ends = *ends << 8 | left << 4 | right.wrapping_sub(left);
        keep_rolled();
    }
}

/// Fills a triangle with an area in the domain where it is nearer than `stored`. Otherwise draws nothing and returns `false`.
#[inline(never)] // needs all registers
pub(super) fn fill<C: StoredPixel<S::Cell>, S: PixelStore>(
    memory: &mut PixelRows<S>,
    triangle: &DepthTriangle<'_>,
    shader: &TableShader<'_, C>,
    scissor: &Scissor,
    stored: &mut [u16],
) -> bool {
    let [mut p, mut q, mut r] = triangle.triangle.corners;
    let column = |x: i32| (x + 127) >> 8; // the first one whose centre does not lie to the left
    let (x, end) = (column(p.x.min(q.x).min(r.x)), column(p.x.max(q.x).max(r.x)));
    // From the top corner, with its left edge to `q` and its right edge to `r`.
    if q.y < p.y && q.y <= r.y {
        (p, q, r) = (q, r, p);
    } else if r.y < p.y {
        (p, q, r) = (r, p, q);
    }
    let middle_is_left = q.y < r.y;
    let [middle, last] = if middle_is_left { [q, r] } else { [r, q] };
    let (top, bottom) = (first_row(&p), first_row(&last));
    // The sign bit is set if a difference is negative.
    let room = (x + COLUMNS - end) | (top + ROWS - bottom) | (x - scissor.left) | (scissor.right - end);
    if room < 0 {
        return false;
    }
    let (y, bottom) = (top.max(scissor.top), bottom.min(scissor.bottom));
    if y >= bottom {
        return true;
    }
    let (mut left, mut right) = (TinyEdge::new(&p, &q, x, y), TinyEdge::new(&p, &r, x, y));
    let (end, mut ends) = (first_row(&middle).min(bottom), 0);
    append_rows(&mut left, &mut right, end - y, &mut ends);
    if end < bottom {
        let row = end.max(y);
        let lower = TinyEdge::new(&middle, &last, x, row);
        (left, right) = if middle_is_left { (lower, right) } else { (left, lower) };
        append_rows(&mut left, &mut right, bottom - row, &mut ends);
    }
    if ends & 0x0f0f_0f0f == 0 {
        return true; // no row has a pixel
    }
    ends <<= (8 * (ROWS + y - bottom)) & 31; // the first row in the upper eight bits
    let [depth, light] = depth_and_light_gradients(&triangle.triangle, &triangle.depths, &shader.light);
    let (cells, &mut RowScratch { layout, .. }) = memory.parts();
    let (cells, stored) = same_length(cells, stored);
    let (mut start, mut row_z, mut row_light) = (layout.at(x, y), depth.at(x, y), light.at(x, y));
    while ends != 0 {
        let (left, mut width) = (ends >> 28, ends >> 24 & 15);
        let mut at = start.wrapping_add(left as usize);
        let mut z = row_z.wrapping_add(depth.step().wrapping_mul(left));
        let mut value = row_light.wrapping_add(light.step().wrapping_mul(left));
        while width != 0 {
            if let (Some(cell), Some(stored)) = (cells.get_mut(at), stored.get_mut(at))
                && z >> 16 < u32::from(*stored)
            {
                *stored = (z >> 16) as u16;
                *cell = TableShader::look_up(shader.colors, value).stored();
            }
            (z, value) = (z.wrapping_add(depth.step()), value.wrapping_add(light.step()));
            (at, width) = (at.wrapping_add(1), width - 1);
            keep_rolled();
        }
        start = start.wrapping_add(layout.stride);
        row_z = row_z.wrapping_add(depth.row_step());
        row_light = row_light.wrapping_add(light.row_step());
        ends <<= 8;
        keep_rolled();
    }
    true
}
