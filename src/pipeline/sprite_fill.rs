//! Fills sprites row by row, and leaves out pixels that are transparent or hidden.
//!
//! The plain path passes each run of drawn pixels to the target; the call before it attaches the fast path for memory.

use super::drawable::SpriteFor;
use crate::color::Ink;
use crate::fast::sprite_fill;
use crate::math::hints::keep_rolled;
use crate::raster::{Scissor, Span, SpriteAxis, TexelWalk};
use crate::shading::SpriteSource;
use crate::surface::{put, DepthBuffer, Target};

/// A sprite on the screen.
#[derive(Debug)]
pub(super) struct ScreenSprite {
    pub(super) columns: SpriteAxis,
    pub(super) rows: SpriteAxis,
    /// The depth of all pixels: 0 near to 65534 far.
    pub(super) depth: u16,
}

impl ScreenSprite {
    /// Whether the sprite has no area.
    pub(super) fn is_empty(&self) -> bool {
        self.columns.is_empty() || self.rows.is_empty()
    }

    /// The pixels inside the scissor that the sprite covers.
    pub(super) fn covered(&self, scissor: &Scissor) -> Scissor {
        let (columns, rows) = (self.columns.pixels(), self.rows.pixels());
        Scissor::unclamped(columns.start, rows.start, columns.end, rows.end).intersection(scissor)
    }
}

/// Draws the pixels of a sprite inside the scissor, which lies in the target. With `DEPTH`, only those that are nearer than the depth
/// buffer, in which the scissor lies, too.
#[inline(never)] // its stack frame is gone when it returns
pub(super) fn fill<T: Target, S: SpriteFor<T>, const DEPTH: bool>(
    sprite: &ScreenSprite,
    source: &S,
    scissor: &Scissor,
    mut depth: Option<&mut DepthBuffer<'_>>,
    target: &mut T,
) -> Result<(), T::Error> {
    let covered = sprite.covered(scissor);
    if covered.is_empty() {
        return Ok(());
    }
    let (left, width) = (covered.left, covered.right - covered.left); // inside the guard band
    let first = sprite.columns.walk(left);
    let mut row = sprite.rows.walk(covered.top);
    for y in covered.rows() {
        let span = Span { x: left, y, width, height: 1 };
        let texels = TexelRow { source, row: row.texel(), first };
        let depths = match &mut depth {
            Some(depth) if DEPTH => depth.row(left, y, width).unwrap_or_default(),
            _ => &mut [],
        };
        fill_row::<T, S, DEPTH>(span, &texels, sprite.depth, depths, target)?;
        row.advance();
    }
    Ok(())
}

/// A row of a picture, and the texel of the first pixel of a span.
struct TexelRow<'s, S> {
    source: &'s S,
    row: u32,
    first: TexelWalk,
}

impl<S: SpriteSource> TexelRow<'_, S> {
    /// The inks of a row's pixels from a pixel whose texel is known, without end.
    #[inline(always)]
    fn inks(&self, mut walk: TexelWalk) -> impl Iterator<Item = S::Ink> {
        core::iter::repeat_with(move || {
            let ink = self.source.texel_at(walk.texel(), self.row);
            walk.advance();
            ink
        })
    }
}

/// Draws the pixels of a span. With `DEPTH` there is a stored depth for each of them.
#[inline(always)]
fn fill_row<T: Target, S: SpriteFor<T>, const DEPTH: bool>(
    span: Span,
    texels: &TexelRow<'_, S>,
    own: u16,
    depths: &mut [u16],
    target: &mut T,
) -> Result<(), T::Error> {
    let inks = texels.inks(texels.first);
    let is_drawn = match DEPTH {
        false => sprite_fill::row(span, inks, target),
        true => sprite_fill::row_nearer(span, inks, own, depths, target),
    };
    if is_drawn {
        return Ok(());
    }
    let mut stored = depths.iter_mut();
    let mut walk = texels.first;
    let (mut start, mut run) = (span.x, walk); // of the current run
    let end = span.x + span.width;
    for x in span.x..end {
        keep_rolled();
        let is_nearer = |depth: &mut u16| {
            let is_nearer = own < *depth;
            if is_nearer && !S::Ink::READS {
                *depth = own;
            }
            is_nearer
        };
        let stored = if DEPTH { stored.next() } else { None };
        let is_kept = texels.source.texel_at(walk.texel(), texels.row).own().is_some();
        let is_drawn = is_kept && (!DEPTH || stored.is_some_and(is_nearer));
        if !is_drawn {
            draw_run(Span { x: start, width: x - start, ..span }, texels, run, target)?;
        }
        walk.advance();
        if !is_drawn {
            (start, run) = (x + 1, walk);
        }
    }
    draw_run(Span { x: start, width: end - start, ..span }, texels, run, target)
}

/// Draws a run of pixels, none of which is transparent or hidden. It may be empty.
#[inline(never)] // code size: two calls
fn draw_run<T: Target, S: SpriteFor<T>>(
    run: Span,
    texels: &TexelRow<'_, S>,
    first: TexelWalk,
    target: &mut T,
) -> Result<(), T::Error> {
    if run.width == 0 {
        return Ok(());
    }
    if S::Ink::READS {
        if let Some(row) = target.memory().and_then(|memory| memory.row(run.x, run.y, run.width)) {
            row.iter_mut().zip(texels.inks(first)).for_each(|(cell, ink)| {
                put::<T, _>(cell, ink);
            });
        }
        return Ok(());
    }
    match texels.source.solid_texel().and_then(Ink::own) {
        Some(color) => target.fill(run, color),
        // No texel of the run is transparent: nothing is dropped.
        None => target.fill_run(run, texels.inks(first).map_while(Ink::own)),
    }
}
