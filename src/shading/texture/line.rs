//! Texture coordinates of a run of pixels: linear, with 16 or 32 bits for each coordinate.

use super::texels::Texels;
use crate::math::cores::CORTEX_M0;
use crate::math::hints::opaque;
use crate::raster::{Gradient, Span};
use core::marker::PhantomData;

/// Texture coordinates of pixels from left to right, in 2⁻³² of the sides: an endless linear sequence.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a line of texture coordinates",
    label = "no `Line`",
    note = "leave `draw_runs` as the trait has it"
)]
pub trait Line: Iterator<Item = [u32; 2]> + Copy {
    /// The line of a block of 2^`bits` pixels from its pixel `passed` on, given the exact coordinates of the block's first pixel
    /// and the change from a pixel to the next. `bits` is 0 … [`LARGEST_BLOCK`].
    fn of_block(first: [u32; 2], step: [u32; 2], bits: i32, passed: i32) -> Self;

    /// [`of_block`](Self::of_block) from the coordinates at both ends, 2^`bits` pixels from each other, in 2^`up` of 2⁻³² of the
    /// sides, relative to `origin`; `up` is at least `bits`, so that steps are exact.
    fn between(
        left: [i32; 2],
        right: [i32; 2],
        origin: [u32; 2],
        up: [u32; 2],
        bits: i32,
        passed: i32,
    ) -> Self;

    /// A line of packed coordinates, which lines of 32 bits for each coordinate are never made of.
    fn of_packed(line: PackedLine) -> Option<Self>;

    /// The coordinates of the next pixel; advances to the pixel after it.
    fn advance(&mut self) -> [u32; 2];

    /// The line, in a form in which the compiler does not see that its coordinates are linear; `zero` is 0, [opaque] to it.
    fn hidden(self, zero: u32) -> Self;
}

/// The binary logarithm of the widest block, in pixels.
pub(super) const LARGEST_BLOCK: i32 = 6;

/// 32 bits for each coordinate.
#[derive(Clone, Copy, Debug)]
pub(super) struct WideLine {
    at: [u32; 2],
    step: [u32; 2],
}

impl Iterator for WideLine {
    type Item = [u32; 2];

    #[inline(always)]
    fn next(&mut self) -> Option<[u32; 2]> {
        Some(self.advance())
    }
}

impl Line for WideLine {
    #[inline(always)]
    fn of_block([u, v]: [u32; 2], step @ [du, dv]: [u32; 2], _: i32, passed: i32) -> Self {
        let passed = passed as u32;
        Self { at: [u.wrapping_add(du.wrapping_mul(passed)), v.wrapping_add(dv.wrapping_mul(passed))], step }
    }

    #[inline(always)]
    fn between(
        left: [i32; 2],
        right: [i32; 2],
        origin: [u32; 2],
        up: [u32; 2],
        bits: i32,
        passed: i32,
    ) -> Self {
        let ([a, b], [m, n]) = (left, up);
        let [u, v] = origin;
        let first = [u.wrapping_add((a as u32) << (m & 31)), v.wrapping_add((b as u32) << (n & 31))];
        Self::of_block(first, steps(left, right, up, bits), bits, passed)
    }

    #[inline(always)]
    fn of_packed(_: PackedLine) -> Option<Self> {
        None
    }

    #[inline(always)]
    fn advance(&mut self) -> [u32; 2] {
        let at @ [u, v] = self.at;
        let [du, dv] = self.step;
        self.at = [u.wrapping_add(du), v.wrapping_add(dv)];
        at
    }

    #[inline(always)]
    fn hidden(self, zero: u32) -> Self {
        let [u, v] = self.at;
        Self { at: [hidden(u, zero), hidden(v, zero)], ..self }
    }
}

/// Both coordinates in one word: see [`packed`].
#[derive(Clone, Copy, Debug)]
pub struct PackedLine {
    at: u32,
    step: u32,
}

impl PackedLine {
    /// A line of words, each a step from the one before.
    #[inline(always)]
    pub(crate) const fn new(at: u32, step: u32) -> Self {
        Self { at, step }
    }

    /// The line of a row, from a gradient of packed coordinates.
    #[inline(always)]
    pub(crate) fn of_row(gradient: &Gradient, Span { x, y, .. }: Span) -> Self {
        Self { at: gradient.at(x, y), step: gradient.step() }
    }
}

impl Iterator for PackedLine {
    type Item = [u32; 2];

    #[inline(always)]
    fn next(&mut self) -> Option<[u32; 2]> {
        Some(self.advance())
    }
}

impl Line for PackedLine {
    /// Packed in the middle of the block, so that the steps' rounding adds up over half of it.
    #[inline(always)]
    fn of_block([u, v]: [u32; 2], step @ [du, dv]: [u32; 2], bits: i32, passed: i32) -> Self {
        let half = (1u32 << (bits & 31)) >> 1; // 0 … 32
        let middle = packed([u.wrapping_add(du.wrapping_mul(half)), v.wrapping_add(dv.wrapping_mul(half))]);
        let step = packed(step);
        Self { at: middle.wrapping_add(step.wrapping_mul((passed as u32).wrapping_sub(half))), step }
    }

    #[inline(always)]
    fn between(
        left: [i32; 2],
        right: [i32; 2],
        origin: [u32; 2],
        up: [u32; 2],
        bits: i32,
        passed: i32,
    ) -> Self {
        let ([a, b], [c, d], [u, v], [m, n]) = (left, right, origin, up);
        let step = packed(steps(left, right, up, bits));
        // The middle is the mean of both ends.
        let middle = packed([
            u.wrapping_add(((a + c) as u32) << (m.wrapping_sub(1) & 31)),
            v.wrapping_add(((b + d) as u32) << (n.wrapping_sub(1) & 31)),
        ]);
        let half = 1i32 << (bits.wrapping_sub(1) & 31);
        Self { at: middle.wrapping_add(step.wrapping_mul(passed.wrapping_sub(half) as u32)), step }
    }

    #[inline(always)]
    fn of_packed(line: PackedLine) -> Option<Self> {
        Some(line)
    }

    #[inline(always)]
    fn advance(&mut self) -> [u32; 2] {
        let at = self.at;
        self.at = at.wrapping_add(self.step);
        unpacked(at)
    }

    #[inline(always)]
    fn hidden(self, zero: u32) -> Self {
        Self { at: hidden(self.at, zero), ..self }
    }
}

/// `at`, without the compiler's knowledge of how it changes from turn to turn. An exclusive or with an unknown 0 is one instruction;
/// [`opaque`] stores the number and loads it again, which a Cortex-M0 can do better than keep another register.
#[inline(always)]
fn hidden(at: u32, zero: u32) -> u32 {
    match CORTEX_M0 {
        true => opaque(at),
        false => at ^ zero,
    }
}

/// The change per pixel between coordinates 2^`bits` pixels from each other.
#[inline(always)]
fn steps([a, b]: [i32; 2], [c, d]: [i32; 2], up: [u32; 2], bits: i32) -> [u32; 2] {
    let [m, n] = up.map(|up| up.wrapping_sub(bits as u32) & 31);
    [((c - a) as u32) << m, ((d - b) as u32) << n]
}

/// The kind of line that texels of type `S` need, wide or packed; the other kind is not used.
#[derive(Clone, Copy, Debug)]
pub(super) struct TexelLine<S> {
    wide: WideLine,
    packed: PackedLine,
    texels: PhantomData<S>,
}

impl<S> TexelLine<S> {
    #[inline(always)]
    pub(super) const fn of_wide(wide: WideLine) -> Self {
        Self { wide, packed: PackedLine { at: 0, step: 0 }, texels: PhantomData }
    }

    #[inline(always)]
    pub(super) const fn of_packed(packed: PackedLine) -> Self {
        Self { wide: WideLine { at: [0; 2], step: [0; 2] }, packed, texels: PhantomData }
    }
}

impl<S: Texels> Iterator for TexelLine<S> {
    type Item = [u32; 2];

    #[inline(always)]
    fn next(&mut self) -> Option<[u32; 2]> {
        Some(if S::WIDE { self.wide.advance() } else { self.packed.advance() })
    }
}

/// Both coordinates, or their steps, from 2⁻³² of the sides into one word: the word nearest to u whose lower 16 bits are v,
/// rounded to 2⁻¹⁶. Each is off by at most ½ of 2⁻¹⁶ of its side.
///
/// Sums of such words wrap as v wraps, and a carry out of v becomes part of u: after n steps of the word u and v are off by at
/// most (n + 1)·½ of 2⁻¹⁶ of a side, however often they wrap.
#[inline(always)]
pub(super) const fn packed([u, v]: [u32; 2]) -> u32 {
    const HALF: u32 = 1 << 15;
    let v = v.wrapping_add(HALF) >> 16;
    (u.wrapping_sub(v).wrapping_add(HALF) & 0xffff_0000) | v
}

/// The coordinates of a [`packed`] word, in 2⁻³² of the sides.
#[inline(always)]
const fn unpacked(word: u32) -> [u32; 2] {
    [word, word << 16]
}
