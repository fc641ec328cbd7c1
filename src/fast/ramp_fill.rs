//! Triangles whose colours are looked up by one word that varies linearly, into memory: light in a
//! [`ShadeTable`](crate::shading::ShadeTable), or texture coordinates that share a word.
//!
//! - **Plain twins**: `pipeline::fill::fill` and `fill_nearer` with `SpanShader::span` of [`TableShader`] and
//!   [`Textured`](crate::texture::Textured).
//! - **Domain**: on a target whose pixels lie in memory, with depth where the depth buffer is laid out as the memory is: every triangle
//!   whose colours are those of a table, and triangles with a `FastPath::ramp` of the [`Small`](super::Small) tier.
//! - **Gain**: a row has one run, whose first word is one addition from the row above, and colours of a table are looked up only for
//!   pixels that are nearer; the gradients of depth and light share one reciprocal. With packed coordinates and blocks of at most 64
//!   pixels, a textured torus of 1000 triangles takes 17 % fewer instructions on an M3, 20 % on an M4F and 13 % on an M0
//!   (`tools/bench/run cells X1`). A smooth one without depth takes 18 % fewer on an M3, 19 % on an M4F, 14 % on an M0 and 6 % on RV32
//!   than by [`shaded_fill`](super::shaded_fill), for 1.1 KB (S8).
//! - **Test**: `tests/shading/bands.rs` and `tests/shading/textures.rs`, by every draw call.

use super::fill_rows::{fill_triangle, same_length, Fill, FillRow, FillRows, NoDepth};
use super::put_run::{put_blocks, put_blocks_nearer, put_each, put_each_nearer, LookUp, Ramp, BLOCK};
use super::{depth_and_light_gradients, depth_gradient, memory_of, tiny_table, RowOrigin};
use crate::color::StoredPixel;
use crate::math::cores::CORTEX_M0;
use crate::math::hints::{keep_branch, opaque};
use crate::raster::{DepthTriangle, Gradient, Scissor, Triangle};
use crate::shading::TableShader;
use crate::surface::{DepthTarget, Surface};

/// Fills a triangle with colours of a table, if the target's pixels lie in memory; otherwise draws nothing and returns `false`.
/// `is_clipped`: the triangle probably has rows outside the scissor.
#[inline(always)]
pub(crate) fn table<T: Surface>(
    triangle: &Triangle<'_>,
    shader: &TableShader<'_, T::Color>,
    scissor: &Scissor,
    is_clipped: bool,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    fill_triangle(memory, triangle, scissor, is_clipped, NoDepth, shader);
    true
}

/// Fills a triangle with colours of a table where it is nearer than the depth buffer, if the target's pixels lie in memory and the depth
/// buffer [has their layout](DepthTarget::is_aligned); otherwise draws nothing and returns `false`. `is_clipped`: the triangle probably
/// has rows outside the scissor.
#[inline(always)]
pub(crate) fn table_nearer<T: Surface>(
    triangle: &DepthTriangle<'_>,
    shader: &TableShader<'_, T::Color>,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target).filter(|_| depth.is_aligned) else { return false };
    if !CORTEX_M0
        && (1..=tiny_table::MOST_AREA).contains(&triangle.triangle.area)
        && tiny_table::fill(memory, triangle, shader, scissor, depth.buffer.values_mut())
    {
        return true;
    }
    fill_triangle(memory, triangle, scissor, is_clipped, &mut *depth.buffer, shader);
    true
}

impl<C: StoredPixel<Cell>, Cell: Copy> Fill<Triangle<'_>, Cell> for &TableShader<'_, C> {
    #[inline(always)]
    fn set_up(self, triangle: &Triangle<'_>) -> impl FillRows<Cell> {
        let (colors, light) = (self.colors, Gradient::of_light(triangle, &self.light));
        RampFill::<_, true, false> {
            gradients: [Gradient::default(), light],
            color: move |[light, _]: [u32; 2]| TableShader::look_up(colors, light),
        }
    }
}

impl<C: StoredPixel<Cell>, Cell: Copy> Fill<DepthTriangle<'_>, Cell> for &TableShader<'_, C> {
    #[inline(always)]
    fn set_up(self, triangle: &DepthTriangle<'_>) -> impl FillRows<Cell> {
        let colors = self.colors;
        RampFill::<_, true, true> {
            gradients: depth_and_light_gradients(&triangle.triangle, &triangle.depths, &self.light),
            color: move |[light, _]: [u32; 2]| TableShader::look_up(colors, light),
        }
    }
}

/// A number that is linear over the triangle, and the function that returns the colour for it, such as a texel at coordinates that
/// share a word.
pub(super) struct Packed<'g, F> {
    pub(super) gradient: &'g Gradient,
    pub(super) color: F,
}

impl<Cell: Copy, C: StoredPixel<Cell>, F: Fn([u32; 2]) -> C + Copy> Fill<Triangle<'_>, Cell>
    for Packed<'_, F>
{
    #[inline(always)]
    fn set_up(self, _: &Triangle<'_>) -> impl FillRows<Cell> {
        RampFill::<_, false, false> { gradients: [Gradient::default(), *self.gradient], color: self.color }
    }
}

impl<Cell: Copy, C: StoredPixel<Cell>, F: Fn([u32; 2]) -> C + Copy> Fill<DepthTriangle<'_>, Cell>
    for Packed<'_, F>
{
    #[inline(always)]
    fn set_up(self, triangle: &DepthTriangle<'_>) -> impl FillRows<Cell> {
        let depth = depth_gradient(&triangle.triangle, &triangle.depths);
        RampFill::<_, false, true> { gradients: [depth, *self.gradient], color: self.color }
    }
}

/// The colours that a function returns for the values of a gradient, and the gradients of depth and of the value. `TABLE` is that of
/// [`LookUp`]; `DEPTH`: whether there is a depth buffer.
struct RampFill<F, const TABLE: bool, const DEPTH: bool> {
    color: F,
    gradients: [Gradient; 2],
}

impl<Cell, C, F, const TABLE: bool, const DEPTH: bool> FillRows<Cell> for RampFill<F, TABLE, DEPTH>
where
    Cell: Copy,
    C: StoredPixel<Cell>,
    F: Fn([u32; 2]) -> C + Copy,
{
    #[inline(always)]
    fn rows<'a>(
        &'a mut self,
        cells: &'a mut [Cell],
        depths: &'a mut [u16],
        RowOrigin { x, y, shear }: RowOrigin,
        _: i32,
    ) -> impl FillRow
    where
        Cell: 'a,
    {
        let (cells, depths) = if DEPTH { same_length(cells, depths) } else { (cells, depths) };
        let [depth, value] = &mut self.gradients;
        (*depth, *value) = (depth.sheared(shear), value.sheared(shear));
        let (z, value) = (depth.at(x, y), value.at(x, y));
        RampRows { fill: self, cells, depths, z, value }
    }
}

/// Rows of cells, and depth and the value along them.
struct RampRows<'a, F, Cell, const TABLE: bool, const DEPTH: bool> {
    fill: &'a RampFill<F, TABLE, DEPTH>,
    cells: &'a mut [Cell],
    depths: &'a mut [u16],
    /// Depth and the value at the origin that the next row's ends are counted from.
    z: u32,
    value: u32,
}

/// The cells and depths of a row, depth at its first pixel and its step, and the colours.
type Row<'r, Cell, F, const TABLE: bool> = (&'r mut [Cell], &'r mut [u16], [u32; 2], LookUp<Ramp, F, TABLE>);

impl<C, F, Cell, const TABLE: bool, const DEPTH: bool> FillRow for RampRows<'_, F, Cell, TABLE, DEPTH>
where
    Cell: Copy,
    C: StoredPixel<Cell>,
    F: Fn([u32; 2]) -> C + Copy,
{
    #[inline(always)]
    fn row(&mut self, start: usize, left: i32, right: i32) {
        let (from, width) = (start.wrapping_add(left as usize), right.wrapping_sub(left));
        if width > 0 {
            if width < BLOCK as i32 {
                self.short(from, left, width as usize);
            } else {
                self.long(from, left, width as usize);
            }
        }
        let [depth, value] = &self.fill.gradients;
        if DEPTH {
            self.z = self.z.wrapping_add(depth.row_step());
        }
        self.value = self.value.wrapping_add(value.row_step());
    }
}

impl<C, F, Cell, const TABLE: bool, const DEPTH: bool> RampRows<'_, F, Cell, TABLE, DEPTH>
where
    Cell: Copy,
    C: StoredPixel<Cell>,
    F: Fn([u32; 2]) -> C + Copy,
{
    /// The row of `width` pixels that begins at index `from` and column `left`.
    #[inline(always)]
    fn part(&mut self, from: usize, left: i32, width: usize) -> Option<Row<'_, Cell, F, TABLE>> {
        let RampFill { gradients: [depth, value], color } = self.fill;
        let (depth, value, color) = (depth.step(), value.step(), *color);
        let run = part_of(self.cells, from, width)?;
        let depths = if DEPTH { part_of(self.depths, from, width)? } else { &mut [] };
        let z = self.z.wrapping_add(depth.wrapping_mul(left as u32));
        let line = Ramp { at: self.value.wrapping_add(value.wrapping_mul(left as u32)), step: value };
        Some((run, depths, [z, depth], LookUp { line, color, zero: 0 }))
    }

    /// Fills a row of fewer than [`BLOCK`] pixels. The gradients and slices stay in memory behind `self`: the call passes few
    /// arguments, and the loop has all registers.
    #[inline(never)]
    fn short(&mut self, from: usize, left: i32, width: usize) {
        if let Some((run, depths, [z, step], mut colors)) = self.part(from, left, width) {
            let (_, run) = run.as_chunks_mut::<BLOCK>(); // the same run: tells the compiler that it is shorter than a block
            match DEPTH {
                true => _ = put_each_nearer::<Cell, true>(run, depths, z, step, &mut colors),
                false => put_each::<Cell, true>(run, colors),
            }
        }
    }

    /// Fills a row of [`BLOCK`] pixels or more.
    #[inline(never)]
    fn long(&mut self, from: usize, left: i32, width: usize) {
        if let Some((run, depths, [z, step], mut colors)) = self.part(from, left, width) {
            if !TABLE {
                colors.zero = opaque(0);
            }
            match DEPTH {
                true => _ = put_blocks_nearer(run, depths, z, step, colors),
                false => put_blocks(run, colors),
            }
        }
    }
}

/// `width` elements from index `from` on, if there are as many.
#[inline(always)]
fn part_of<T>(all: &mut [T], from: usize, width: usize) -> Option<&mut [T]> {
    if CORTEX_M0 {
        // `keep_branch` keeps LLVM from merging the two checks into arithmetic, which takes five more instructions per slice.
        let part = all.get_mut(from..)?;
        keep_branch();
        let part = part.get_mut(..width)?;
        keep_branch();
        return Some(part);
    }
    all.get_mut(from..from.wrapping_add(width)) // a sum that wraps is below `from`
}
