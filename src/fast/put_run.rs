//! The loops over the pixels of a run in memory: any inks, with depth or without.
//!
//! - **Plain twins**: `Surface::fill_run` for each run; with depth, `DepthBuffer::test_kept` before it.
//! - **Domain**: runs of pixels that lie in memory, with depth also in the depth buffer.
//! - **Gain**: pixels of [`Blocks`] are written eight at once, with depth where the depth buffer is still clear, the common case: 7.4
//!   instructions for a texel in place of 11 on an M3, 4.6 for a mixed pixel in place of 6.4 (S5 half), 8.6 in place of 10.7
//!   (S5 alpha).
//! - **Test**: `by_every_call` and `everywhere` in `tests/support/src/bridge/ways.rs`.

use crate::color::{InkKind, StoredPixel};
use crate::math::cores::CORTEX_M0;
use crate::math::hints::{keep_branch, keep_rolled, opaque};
use crate::math::unrolled::each8;
use crate::shading::Line;
use crate::surface::block_fill::fill_eight;
use crate::surface::put;
use core::marker::PhantomData;

/// The number of pixels that are written at once.
pub(super) const BLOCK: usize = 8;

/// A stored pixel or an ink, which can be written into the cell of a pixel.
pub(super) trait Put<Cell>: Copy {
    /// Writes the stored pixel or the ink into a cell; returns `false` if the pixel is left out.
    fn put(self, cell: &mut Cell) -> bool;
}

/// A stored pixel.
#[derive(Clone, Copy)]
pub(super) struct Stored<Cell>(pub(super) Cell);

impl<Cell: Copy> Put<Cell> for Stored<Cell> {
    #[inline(always)]
    fn put(self, cell: &mut Cell) -> bool {
        *cell = self.0;
        true
    }
}

/// An ink over pixels of the colour `C`.
#[derive(Clone, Copy)]
pub(super) struct Inked<C, I> {
    ink: I,
    color: PhantomData<C>,
}

impl<C, I> Inked<C, I> {
    #[inline(always)]
    pub(super) const fn new(ink: I) -> Self {
        Self { ink, color: PhantomData }
    }
}

impl<Cell: Copy, C: StoredPixel<Cell>, I: InkKind<C>> Put<Cell> for Inked<C, I> {
    #[inline(always)]
    fn put(self, cell: &mut Cell) -> bool {
        put(cell, self.ink)
    }
}

/// A source of inks for a run of pixels. Each ink takes so few instructions that eight pixels are written at once.
pub(super) trait Blocks<Cell>: Copy {
    /// An endless iterator over the inks of the pixels, from left to right.
    type Inks: Iterator<Item: Put<Cell>> + Copy;

    /// The inks from the first pixel of the run on. The iterator is apart from the source, because LLVM keeps the two cells of an
    /// [`Equal`] that is part of an iterator in two registers: S2 with depth then takes 10 % more instructions on an M3.
    fn inks(self) -> Self::Inks;

    /// Writes the next eight pixels.
    #[inline(always)]
    fn put_eight(self, inks: &mut Self::Inks, cells: &mut [Cell; BLOCK]) {
        each8(cells, |cell| {
            put_next(inks, cell);
        });
    }

    /// Whether eight pixels are unrolled where the depth buffer is not clear: faster by a few instructions, 0.2 KB larger.
    const IS_UNROLLED: bool = true;

    /// Whether the compiler must not see that values are linear: it would keep multiples of their steps on the stack.
    const IS_HIDDEN: bool = false;

    /// The inks, in a form in which the compiler does not see that they are linear. Called if [`IS_HIDDEN`](Self::IS_HIDDEN).
    #[inline(always)]
    fn hidden(inks: Self::Inks) -> Self::Inks {
        inks
    }
}

/// One stored pixel, given twice: LLVM does not know that both are equal, so it stores two 16-bit pixels from one register.
#[derive(Clone, Copy)]
pub(super) struct Equal<Cell>(pub(super) [Cell; 2]);

impl<Cell: Copy> Blocks<Cell> for Equal<Cell> {
    type Inks = OneInk<Stored<Cell>>;

    #[inline(always)]
    fn inks(self) -> OneInk<Stored<Cell>> {
        let Self([cell, _]) = self;
        OneInk(Stored(cell))
    }

    #[inline(always)]
    fn put_eight(self, _: &mut OneInk<Stored<Cell>>, cells: &mut [Cell; BLOCK]) {
        fill_eight(cells, self.0);
    }
}

/// One ink for all pixels.
#[derive(Clone, Copy)]
pub(super) struct OneInk<P>(pub(super) P);

impl<P: Copy> Iterator for OneInk<P> {
    type Item = P;

    #[inline(always)]
    fn next(&mut self) -> Option<P> {
        Some(self.0)
    }
}

impl<Cell, P: Put<Cell>> Blocks<Cell> for OneInk<P> {
    type Inks = Self;

    #[inline(always)]
    fn inks(self) -> Self {
        self
    }
}

/// Numbers that are linear along a run.
pub(super) trait Linear: Copy {
    /// The numbers at the next pixel; advances to the pixel after it.
    fn advance(&mut self) -> [u32; 2];

    /// The numbers, in a form in which the compiler does not see that they are linear; `zero` is 0, [opaque] to it.
    fn hidden(self, zero: u32) -> Self;
}

impl Linear for Line {
    #[inline(always)]
    fn advance(&mut self) -> [u32; 2] {
        Self::advance(self)
    }

    #[inline(always)]
    fn hidden(self, zero: u32) -> Self {
        let [u, v] = self.at;
        // The second number is 0 where coordinates share a word. On a Cortex-M0 hiding it would store it for each pixel all the same.
        Self { at: [hidden(u, zero), if CORTEX_M0 { v } else { hidden(v, zero) }], ..self }
    }
}

/// One number that is linear along a run.
#[derive(Clone, Copy)]
pub(super) struct Ramp {
    pub(super) at: u32,
    pub(super) step: u32,
}

impl Linear for Ramp {
    #[inline(always)]
    fn advance(&mut self) -> [u32; 2] {
        let at = self.at;
        self.at = at.wrapping_add(self.step);
        [at, 0]
    }

    #[inline(always)]
    fn hidden(self, zero: u32) -> Self {
        Self { at: hidden(self.at, zero), ..self }
    }
}

/// `at`, without the compiler's knowledge of how it changes from turn to turn; `zero` is 0, [opaque] to it. An exclusive or with an
/// unknown 0 is one instruction; [`opaque`] stores the number and loads it again, which a Cortex-M0 can do better than keep another
/// register.
#[inline(always)]
fn hidden(at: u32, zero: u32) -> u32 {
    match CORTEX_M0 {
        true => opaque(at),
        false => at ^ zero,
    }
}

/// The colours that a function returns for a line of values: of a texture for coordinates, or, with `TABLE`, of a table for light.
#[derive(Clone, Copy)]
pub(super) struct LookUp<L, F, const TABLE: bool> {
    pub(super) line: L,
    pub(super) color: F,
    /// 0, which the compiler does not know unless `TABLE`: see [`hidden`].
    pub(super) zero: u32,
}

impl<L: Linear, C, F: Fn([u32; 2]) -> C, const TABLE: bool> Iterator for LookUp<L, F, TABLE> {
    type Item = Inked<C, C>;

    #[inline(always)]
    fn next(&mut self) -> Option<Inked<C, C>> {
        Some(Inked::new((self.color)(self.line.advance())))
    }
}

impl<Cell, C, L, F, const TABLE: bool> Blocks<Cell> for LookUp<L, F, TABLE>
where
    Cell: Copy,
    C: StoredPixel<Cell>,
    L: Linear,
    F: Fn([u32; 2]) -> C + Copy,
{
    type Inks = Self;

    #[inline(always)]
    fn inks(self) -> Self {
        self
    }

    const IS_UNROLLED: bool = TABLE;

    const IS_HIDDEN: bool = !TABLE;

    #[inline(always)]
    fn hidden(inks: Self) -> Self {
        Self { line: inks.line.hidden(inks.zero), ..inks }
    }
}

#[inline(always)]
fn put_next<Cell>(inks: &mut impl Iterator<Item: Put<Cell>>, cell: &mut Cell) -> bool {
    inks.next().is_some_and(|ink| ink.put(cell))
}

/// Writes a run pixel by pixel. `ROLLED`: the loop is not unrolled, as for few pixels, and for inks that need all registers.
#[inline(always)]
pub(super) fn put_each<Cell, const ROLLED: bool>(
    cells: &mut [Cell],
    mut inks: impl Iterator<Item: Put<Cell>>,
) {
    for cell in cells {
        put_next(&mut inks, cell);
        if ROLLED {
            keep_rolled();
        }
    }
}

/// Writes a run eight pixels at a time.
#[inline(always)]
pub(super) fn put_blocks<Cell, S: Blocks<Cell>>(cells: &mut [Cell], source: S) {
    let (blocks, rest) = cells.as_chunks_mut::<BLOCK>();
    let mut inks = source.inks();
    for block in blocks {
        source.put_eight(&mut inks, block);
        if S::IS_HIDDEN {
            inks = S::hidden(inks);
        }
        keep_rolled();
    }
    put_each::<Cell, true>(rest, inks);
}

/// Writes the pixels of a run that are nearer than the depth buffer, one by one, given depth at the first pixel in 16.16 and its step to
/// the next; returns depth after the last one. `WRITES`: whether depths are stored.
#[inline(always)]
pub(super) fn put_each_nearer<Cell, const WRITES: bool>(
    cells: &mut [Cell],
    depths: &mut [u16],
    mut z: u32,
    step: u32,
    inks: &mut impl Iterator<Item: Put<Cell>>,
) -> u32 {
    for (cell, stored) in cells.iter_mut().zip(depths) {
        let ink = inks.next();
        if z >> 16 < u32::from(*stored) && ink.is_some_and(|ink| ink.put(cell)) && WRITES {
            *stored = (z >> 16) as u16;
        }
        z = z.wrapping_add(step);
        keep_rolled();
    }
    z
}

/// [`put_each_nearer`] for a long run of pixels of which none is left out, eight at once where the depth buffer is still clear.
#[inline(always)]
pub(super) fn put_blocks_nearer<Cell, S: Blocks<Cell>>(
    cells: &mut [Cell],
    depths: &mut [u16],
    mut z: u32,
    step: u32,
    source: S,
) -> u32 {
    // The lengths are equal already; this tells the compiler.
    let Some(depths) = depths.get_mut(..cells.len()) else { return z };
    let mut inks = source.inks();
    let ((blocks, rest), (depth_blocks, depth_rest)) =
        (cells.as_chunks_mut::<BLOCK>(), depths.as_chunks_mut::<BLOCK>());
    for (block, stored) in blocks.iter_mut().zip(depth_blocks) {
        if is_clear(stored) {
            each8(stored, |stored| {
                *stored = (z >> 16) as u16;
                z = z.wrapping_add(step);
            });
            source.put_eight(&mut inks, block);
        } else if !S::IS_UNROLLED {
            // Lengths that the compiler does not know keep it from unrolling the loop.
            let (cells, depths) = (opaque(block.as_mut_slice()), opaque(stored.as_mut_slice()));
            z = put_each_nearer::<Cell, true>(cells, depths, z, step, &mut inks);
        } else if CORTEX_M0 {
            // `opaque`: the depths are loaded again, because the branch above needs the registers.
            z = put_each_nearer::<Cell, true>(block, opaque(stored), z, step, &mut inks);
        } else {
            put_mixed::<Cell, S>(block, stored, z, step, inks);
            each8(&mut [(); BLOCK], |()| {
                inks.next();
            });
            z = z.wrapping_add(step.wrapping_mul(BLOCK as u32));
        }
        if S::IS_HIDDEN {
            inks = S::hidden(inks);
        }
        keep_rolled();
    }
    if S::IS_UNROLLED {
        return put_each_nearer::<Cell, true>(rest, depth_rest, z, step, &mut inks);
    }
    // A number that the compiler does not know keeps it from unrolling the loop.
    let count = opaque(rest.len());
    let (Some(rest), Some(depth_rest)) = (rest.get_mut(..count), depth_rest.get_mut(..count)) else {
        return z;
    };
    for (cell, stored) in rest.iter_mut().zip(depth_rest) {
        let ink = inks.next();
        if z >> 16 < u32::from(*stored) && ink.is_some_and(|ink| ink.put(cell)) {
            *stored = (z >> 16) as u16;
            keep_branch();
        }
        z = z.wrapping_add(step);
        keep_rolled();
    }
    z
}

/// Writes a block of pixels where the depth buffer is not clear. On a Cortex-M0, [`put_each_nearer`] is inlined instead: that core has too few registers to
/// gain by a call, which makes S2 5 % slower.
#[cold] // so that the loop over clear blocks keeps its registers, and this call saves them
#[inline(never)]
fn put_mixed<Cell, S: Blocks<Cell>>(
    cells: &mut [Cell; BLOCK],
    depths: &mut [u16; BLOCK],
    z: u32,
    step: u32,
    mut inks: S::Inks,
) {
    put_each_nearer::<Cell, true>(cells, depths, z, step, &mut inks);
}

/// Whether the depth buffer is clear at all of these pixels.
#[inline(always)]
fn is_clear(depths: &[u16; BLOCK]) -> bool {
    let &[a, b, c, d, e, f, g, h] = depths;
    if CORTEX_M0 {
        return a & b & c & d & e & f & g & h == u16::MAX;
    }
    // In pairs, so that each is loaded as one word.
    let pair = |low: u16, high: u16| u32::from(low) | u32::from(high) << 16;
    pair(a, b) & pair(c, d) & pair(e, f) & pair(g, h) == u32::MAX
}
