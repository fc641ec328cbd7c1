//! Fills sprites row by row, and leaves out pixels that are transparent or hidden.
//!
//! The plain path passes each run of drawn pixels to the target; the call before it attaches the fast path for memory.

use super::drawable::SpriteFor;
use crate::color::InkKind;
use crate::fast::sprite_fill;
use crate::math::hints::keep_rolled;
use crate::raster::{Gradient, Scissor, Span, SpriteAxis, TexelWalk};
use crate::shading::SpriteSource;
use crate::surface::{draw_run, each_run, DepthBuffer, Surface};

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
pub(super) fn fill<T: Surface, S: SpriteFor<T>, const DEPTH: bool>(
    sprite: &ScreenSprite,
    source: &S,
    scissor: &Scissor,
    strip: &mut sprite_fill::Strip,
    mut depth: Option<&mut DepthBuffer<'_>>,
    target: &mut T,
) -> Result<(), T::Error> {
    let covered = sprite.covered(scissor);
    if covered.is_empty() {
        return Ok(());
    }
    let (left, width) = (covered.left, covered.right - covered.left); // inside the guard band
    let (first, mut row) = (sprite.columns.walk(left), sprite.rows.walk(covered.top));
    let tested = depth.as_deref_mut().filter(|_| DEPTH);
    if sprite_fill::sprite(&covered, [first, row], strip, source, sprite.depth, tested, target) {
        return Ok(());
    }
    for y in covered.rows() {
        let span = Span { x: left, y, width, height: 1 };
        let texels = TexelRow { source, row: row.texel(), first };
        fill_row::<T, S, DEPTH>(span, &texels, sprite.depth, &mut depth, target)?;
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

/// Draws the pixels of a span. With `DEPTH` there is a depth buffer.
#[inline(always)]
fn fill_row<T: Surface, S: SpriteFor<T>, const DEPTH: bool>(
    span: Span,
    texels: &TexelRow<'_, S>,
    own: u16,
    depth: &mut Option<&mut DepthBuffer<'_>>,
    target: &mut T,
) -> Result<(), T::Error> {
    let depth = depth.as_deref_mut().filter(|_| DEPTH);
    let mut inks = texels.inks(texels.first);
    let mut is_kept = || inks.next().and_then(InkKind::own).is_some();
    // The walk goes on from run to run.
    let (mut x, mut walk) = (span.x, texels.first);
    let draw = |run: Span| {
        while x < run.x {
            keep_rolled();
            walk.advance();
            x += 1;
        }
        draw_texels(run, texels, walk, target)
    };
    match depth {
        Some(depth) => {
            let gradient = Gradient { origin: u32::from(own) << 16, ..Gradient::default() };
            depth.test_kept(span, &gradient, is_kept, !S::Ink::READS, draw)
        }
        // Sprites lie in the guard band, which is narrower than 2¹⁶.
        None => each_run(span, (0..span.width as u16).map(|_| is_kept()), draw),
    }
}

/// Draws a run of pixels, none of which is transparent or hidden.
#[inline(never)] // code size: two calls
fn draw_texels<T: Surface, S: SpriteFor<T>>(
    run: Span,
    texels: &TexelRow<'_, S>,
    first: TexelWalk,
    target: &mut T,
) -> Result<(), T::Error> {
    match texels.source.solid_texel().filter(|_| !S::Ink::READS).and_then(InkKind::own) {
        Some(color) => target.fill(run, color),
        None => draw_run(run, texels.inks(first), target),
    }
}
