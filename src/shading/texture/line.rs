//! Texture coordinates of a run of pixels: linear, with 16 or 32 bits for each coordinate.

/// The binary logarithm of the widest block, in pixels.
pub(super) const LARGEST_BLOCK: i32 = 6;

/// Two numbers that are linear along a run, as `FastPath::lines` returns them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) at: [u32; 2],
    pub(crate) step: [u32; 2],
}

impl Line {
    /// The numbers at the next pixel; advances to the pixel after it.
    #[inline(always)]
    pub(crate) fn advance(&mut self) -> [u32; 2] {
        let (at @ [u, v], [du, dv]) = (self.at, self.step);
        self.at = [u.wrapping_add(du), v.wrapping_add(dv)];
        at
    }
}

impl Iterator for Line {
    type Item = [u32; 2];

    #[inline(always)]
    fn next(&mut self) -> Option<[u32; 2]> {
        Some(self.advance())
    }
}

/// Texture coordinates that are linear along a run: u and v in 2⁻³² of the sides if `N` is 2, both in a [word](packed) if it is 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coordinates<const N: usize> {
    pub(super) at: [u32; N],
    pub(super) step: [u32; N],
}

impl<const N: usize> Coordinates<N> {
    /// Coordinates of a block of 2^`bits` pixels from its pixel `passed` on, given the exact coordinates of the block's first pixel and
    /// the change from a pixel to the next. `bits` is 0 … [`LARGEST_BLOCK`].
    ///
    /// Words are packed in the middle of the block, so that the steps' rounding adds up over half of it.
    #[inline(always)]
    pub(super) fn of_block([u, v]: [u32; 2], step @ [du, dv]: [u32; 2], bits: i32, passed: i32) -> Self {
        let along = |by: u32| [u.wrapping_add(du.wrapping_mul(by)), v.wrapping_add(dv.wrapping_mul(by))];
        if N == 2 {
            return Self::of(along(passed as u32), step);
        }
        let half = (1u32 << (bits & 31)) >> 1; // 0 … 32
        Self::around(packed(along(half)), packed(step), passed.wrapping_sub(half as i32))
    }

    /// The line over a block of 2^`bits` pixels, 1 … [`LARGEST_BLOCK`], from its pixel `passed` on, given the sum of the coordinates at
    /// both ends and their difference, relative to `origin`, in twice `half_units` of 2⁻³² of the sides; a unit is at least 2^`bits`, so
    /// that steps are exact.
    #[inline(always)]
    pub(super) fn through(
        [a, b]: [i32; 2],
        [du, dv]: [i32; 2],
        [u, v]: [u32; 2],
        [m, n]: [u32; 2],
        bits: i32,
        passed: i32,
    ) -> Self {
        let less = bits.wrapping_sub(1) & 31;
        let step = [(du as u32).wrapping_mul(m >> less), (dv as u32).wrapping_mul(n >> less)];
        // The middle is the mean of both ends.
        let middle = [u.wrapping_add((a as u32).wrapping_mul(m)), v.wrapping_add((b as u32).wrapping_mul(n))];
        let by = passed.wrapping_sub(1 << less);
        match N {
            1 => Self::around(packed(middle), packed(step), by),
            _ => {
                let ([u, v], [du, dv]) = (middle, step);
                let along = |at: u32, step: u32| at.wrapping_add(step.wrapping_mul(by as u32));
                Self::of([along(u, du), along(v, dv)], step)
            }
        }
    }

    /// Both numbers of a line; the second is 0 if coordinates share a word.
    #[inline(always)]
    pub(super) fn line(self) -> Line {
        let of = |numbers: [u32; N]| core::array::from_fn(|i| numbers.get(i).copied().unwrap_or(0));
        Line { at: of(self.at), step: of(self.step) }
    }

    /// A word, and its step.
    #[inline(always)]
    pub(super) fn of_word((at, step): (u32, u32)) -> Self {
        Self::of([at, 0], [step, 0])
    }

    /// The word `by` pixels from that in the middle of a block.
    #[inline(always)]
    fn around(middle: u32, step: u32, by: i32) -> Self {
        Self::of([middle.wrapping_add(step.wrapping_mul(by as u32)), 0], [step, 0])
    }

    #[inline(always)]
    fn of([u, v]: [u32; 2], [du, dv]: [u32; 2]) -> Self {
        let of = |first: u32, second: u32| core::array::from_fn(|i| if i == 0 { first } else { second });
        Self { at: of(u, v), step: of(du, dv) }
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
pub(super) const fn unpacked(word: u32) -> [u32; 2] {
    [word, word << 16]
}
