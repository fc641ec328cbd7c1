//! Triangles whose colours are looked up in a [`ShadeTable`](crate::ShadeTable), against a depth buffer, into memory.
//!
//! - **Plain twin**: `pipeline::fill::fill_nearer` with the shader's [`span`](crate::SpanShader::span).
//! - **Domain**: every triangle, on a target whose pixels lie in memory, where the depth buffer is laid out as the memory is.
//! - **Gain**: colours are looked up only for pixels that are nearer, eight at once where the depth buffer is still clear; the
//!   gradients of depth and light share one reciprocal. Not measured alone.
//! - **Test**: `tests/shading/bands.rs`, by every draw call.

use super::depth_fill::{fill_nearer, is_clear, same_length, DepthFill, RowFill, BLOCK};
use super::{depth_and_light_gradients, RowOrigin};
use crate::color::StoredPixel;
use crate::math::cores::CORTEX_M0;
use crate::math::hints::{keep_branch, keep_rolled, opaque};
use crate::math::unrolled::zip8;
use crate::raster::{DepthTriangle, Gradient, Scissor};
use crate::shading::TableShader;
use crate::surface::{DepthTarget, Target};
use embedded_graphics_core::pixelcolor::PixelColor;

/// Fills a triangle where it is nearer than the depth buffer, if the target's pixels lie in memory and the depth buffer
/// [has their layout](DepthTarget::is_aligned); otherwise draws nothing and returns `false`. `is_clipped`: the
/// triangle probably has rows outside the scissor.
#[inline(always)]
pub(crate) fn triangle_nearer<T: Target>(
    triangle: &DepthTriangle<'_>,
    shader: &TableShader<'_, T::Color>,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    fill_nearer(triangle, shader, scissor, is_clipped, depth, target)
}

impl<C: StoredPixel<Cell>, Cell: Copy> DepthFill<Cell> for &TableShader<'_, C> {
    /// The gradients of depth and of light.
    type Gradients = [Gradient; 2];

    #[inline(always)]
    fn set_up(self, triangle: &DepthTriangle<'_>) -> [Gradient; 2] {
        depth_and_light_gradients(&triangle.triangle, &triangle.depths, self.light())
    }

    #[inline(always)]
    fn rows<'a>(
        self,
        gradients: &'a mut [Gradient; 2],
        cells: &'a mut [Cell],
        depths: &'a mut [u16],
        start: RowOrigin,
    ) -> impl RowFill
    where
        Cell: 'a,
        Self: 'a,
    {
        let colors = self.colors();
        LookupRows::<_, _, false>::new(
            move |light| TableShader::look_up(colors, light),
            gradients,
            cells,
            depths,
            start,
        )
    }
}

/// Rows filled with the colours that a function returns for the values of a gradient.
///
/// `SMALL`: blocks that are not clear in the depth buffer take a loop that is not unrolled, which is 0.2 KB smaller.
pub(super) struct LookupRows<'a, F, Cell, const SMALL: bool> {
    steps: Steps<F>,
    cells: &'a mut [Cell],
    depths: &'a mut [u16],
    gradients: &'a [Gradient; 2],
    /// Depth and the value at the origin that the next row's ends are counted from.
    z: u32,
    value: u32,
}

impl<'a, F, Cell, const SMALL: bool> LookupRows<'a, F, Cell, SMALL> {
    /// Rows from gradients of depth and of the value.
    #[inline(always)]
    pub(super) fn new(
        color: F,
        gradients: &'a mut [Gradient; 2],
        cells: &'a mut [Cell],
        depths: &'a mut [u16],
        RowOrigin { x, y, shear }: RowOrigin,
    ) -> Self {
        let (cells, depths) = same_length(cells, depths);
        let [depth, value] = gradients;
        (*depth, *value) = (depth.sheared(shear), value.sheared(shear));
        let steps = Steps { color, depth: depth.step(), value: value.step() };
        Self { steps, cells, depths, z: depth.at(x, y), value: value.at(x, y), gradients }
    }
}

impl<C: StoredPixel<Cell>, F: Fn(u32) -> C + Copy, Cell, const SMALL: bool> RowFill
    for LookupRows<'_, F, Cell, SMALL>
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
        let [depth, value] = self.gradients;
        self.z = self.z.wrapping_add(depth.row_step());
        self.value = self.value.wrapping_add(value.row_step());
    }
}

impl<C: StoredPixel<Cell>, F: Fn(u32) -> C + Copy, Cell, const SMALL: bool> LookupRows<'_, F, Cell, SMALL> {
    /// The cells and depths of a row that begins at index `from` and column `left`, and depth and the value at its first pixel.
    #[inline(always)]
    fn part(&mut self, from: usize, left: i32, width: usize) -> Option<(&mut [Cell], &mut [u16], u32, u32)> {
        let (run, depths) = (part_of(self.cells, from, width)?, part_of(self.depths, from, width)?);
        let z = self.z.wrapping_add(self.steps.depth.wrapping_mul(left as u32));
        let value = self.value.wrapping_add(self.steps.value.wrapping_mul(left as u32));
        Some((run, depths, z, value))
    }

    /// Fills a row of fewer than [`BLOCK`] pixels. What it needs is in memory behind `self`, so the call passes few arguments
    /// and its loop has all registers.
    #[inline(never)]
    fn short(&mut self, from: usize, left: i32, width: usize) {
        let steps = Steps { ..self.steps };
        if let Some((run, depths, z, value)) = self.part(from, left, width) {
            let (_, run) = run.as_chunks_mut::<BLOCK>(); // the same run: tells the compiler that it is shorter than a block
            steps.fill_each(run, depths, z, value);
        }
    }

    /// Fills [`BLOCK`] pixels or more of a row: `width` from index `from` in the memory, which is column `left`.
    #[inline(never)]
    fn long(&mut self, from: usize, left: i32, width: usize) {
        let steps = Steps { ..self.steps };
        if let Some((run, depths, z, value)) = self.part(from, left, width) {
            steps.fill_blocks::<_, SMALL>(run, depths, z, value);
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

/// The function, and the steps of depth and of its argument from a pixel to its right neighbour.
struct Steps<F> {
    color: F,
    depth: u32,
    value: u32,
}

impl<C: PixelColor, F: Fn(u32) -> C + Copy> Steps<F> {
    /// Fills pixels one by one; returns depth and the value after the last one.
    #[inline(always)]
    fn fill_each<Cell>(&self, run: &mut [Cell], depths: &mut [u16], mut z: u32, mut value: u32) -> (u32, u32)
    where
        C: StoredPixel<Cell>,
    {
        for (pixel, stored) in run.iter_mut().zip(depths) {
            if z >> 16 < u32::from(*stored) {
                *stored = (z >> 16) as u16;
                *pixel = (self.color)(value).stored();
            }
            (z, value) = (z.wrapping_add(self.depth), value.wrapping_add(self.value));
            keep_rolled(); // except for fewer than eight pixels
        }
        (z, value)
    }

    /// Fills a block where the depth buffer is not clear everywhere. Not on a Cortex-M0, which has no registers to keep.
    #[cold] // so that the loop over clear blocks keeps its registers, and this call saves them
    #[inline(never)]
    fn fill_mixed<Cell, const SMALL: bool>(
        &self,
        pixels: &mut [Cell; BLOCK],
        depths: &mut [u16; BLOCK],
        z: u32,
        value: u32,
    ) where
        C: StoredPixel<Cell>,
    {
        match SMALL {
            true => self.fill_each(opaque(pixels.as_mut_slice()), opaque(depths.as_mut_slice()), z, value),
            false => self.fill_each(pixels, depths, z, value),
        };
    }

    /// Fills a long run, eight pixels at once where the depth buffer is still clear, the common case.
    #[inline(always)]
    fn fill_blocks<Cell, const SMALL: bool>(
        &self,
        run: &mut [Cell],
        depths: &mut [u16],
        mut z: u32,
        mut value: u32,
    ) where
        C: StoredPixel<Cell>,
    {
        // The lengths are equal already; this tells the compiler.
        let Some(depths) = depths.get_mut(..run.len()) else { return };
        let ((blocks, rest), (depth_blocks, depth_rest)) =
            (run.as_chunks_mut::<BLOCK>(), depths.as_chunks_mut::<BLOCK>());
        for (pixels, depths) in blocks.iter_mut().zip(depth_blocks) {
            if is_clear(depths) {
                zip8(pixels, depths, |pixel, stored| {
                    *stored = (z >> 16) as u16;
                    *pixel = (self.color)(value).stored();
                    (z, value) = (z.wrapping_add(self.depth), value.wrapping_add(self.value));
                });
            } else if CORTEX_M0 {
                // `opaque`: the depths are loaded again, because the branch above needs the registers.
                (z, value) = self.fill_each(pixels, opaque(depths), z, value);
            } else {
                self.fill_mixed::<_, SMALL>(pixels, depths, z, value);
                z = z.wrapping_add(self.depth.wrapping_mul(BLOCK as u32));
                value = value.wrapping_add(self.value.wrapping_mul(BLOCK as u32));
            }
            keep_rolled();
        }
        self.fill_each(rest, depth_rest, z, value);
    }
}
