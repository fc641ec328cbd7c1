//! A sprite into memory.
//!
//! - **Plain twin**: the loop over rows in `pipeline::sprite_fill::fill`, with its loop over runs in `fill_row`.
//! - **Domain**: every sprite, on a target whose pixels lie in memory; with depth, whatever the layout of the depth buffer.
//! - **Gain**: the texel of a column is found once for all rows, and looked up once for a pixel, where the plain path finds it for each
//!   row and looks it up for the run and for its colour. With a texel found for each pixel, before commit e01dfe9d, P1 took 1213k
//!   on an M3; it takes 707k now, and 949k on an M0. At commit 56efee2b blocks of eight pixels took
//!   40k less on an M3 than blocks of four, 2k on an M0.
//! - **Test**: `every_target_shows_the_oracles_pixels` in `tests/pipeline/sprites.rs`, with `--cfg pinhole_plain` and without.

use super::memory_of;
use crate::color::InkKind;
use crate::math::hints::keep_rolled;
use crate::raster::{Scissor, TexelWalk};
use crate::shading::SpriteSource;
use crate::surface::{put, DepthBuffer, Surface};

/// The number of columns whose texels are found at once.
const STRIP: usize = 32;
/// The texels of a strip's columns, written anew for each strip. All sprites share one, because clearing it takes 137 instructions on an
/// M3.
pub(crate) type Strip = [u32; STRIP];
/// The number of pixels that are written without a branch back.
const BLOCK: usize = 8;

/// Draws the `covered` pixels of a sprite, if the target's pixels lie in memory; otherwise draws nothing and returns `false`. `columns`
/// and `rows` have the texel of the first pixel; `strip` is overwritten. With a depth buffer, only pixels whose stored depths are larger
/// than `own`, which replaces them unless the ink is mixed with stored pixels.
#[inline(always)]
pub(crate) fn sprite<T: Surface, S: SpriteSource<Color = T::Color>>(
    covered: &Scissor,
    [mut columns, rows]: [TexelWalk; 2],
    strip: &mut Strip,
    source: &S,
    own: u16,
    mut depth: Option<&mut DepthBuffer<'_>>,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    let (cells, scratch) = memory.parts();
    let mut left = covered.left;
    while left < covered.right {
        let width = (covered.right - left).min(STRIP as i32); // at least 1
        let Some(texels) = strip.get_mut(..width as usize) else { return true };
        for texel in &mut *texels {
            *texel = columns.texel();
            columns.advance();
            keep_rolled();
        }
        let mut row = rows;
        let (mut from, stride) = (scratch.layout.at(left, covered.top), scratch.layout.stride);
        let mut depth = depth.as_deref_mut().map(|depth| depth.rows_from(left, covered.top));
        for _ in covered.rows() {
            // The pixels lie in the target, so in its memory.
            let Some(cells) = cells.get_mut(from..from.wrapping_add(texels.len())) else { return true };
            from = from.wrapping_add(stride);
            let line = row.texel();
            row.advance(); // before the pixels, so that their loop keeps no state of the row
            match &mut depth {
                Some((depths, from, stride)) => {
                    let Some(depths) = depths.get_mut(*from..from.wrapping_add(texels.len())) else {
                        return true;
                    };
                    *from = from.wrapping_add(*stride);
                    let put = |((cell, stored), &column): ((&mut _, &mut u16), &u32)| {
                        if own < *stored && put(cell, source.texel_at(column, line)) && !S::Ink::READS {
                            *stored = own;
                        }
                    };
                    let (blocks, rest) = cells.as_chunks_mut::<BLOCK>();
                    let (depth_blocks, depth_rest) = depths.as_chunks_mut::<BLOCK>();
                    let (texel_blocks, texel_rest) = texels.as_chunks::<BLOCK>();
                    for ((block, depths), texels) in blocks.iter_mut().zip(depth_blocks).zip(texel_blocks) {
                        block.iter_mut().zip(depths).zip(texels).for_each(put);
                        keep_rolled();
                    }
                    for pixel in rest.iter_mut().zip(depth_rest).zip(texel_rest) {
                        put(pixel);
                        keep_rolled();
                    }
                }
                None => {
                    for (cell, column) in cells.iter_mut().zip(&*texels) {
                        put(cell, source.texel_at(*column, line));
                        keep_rolled();
                    }
                }
            }
        }
        left += width;
    }
    true
}
