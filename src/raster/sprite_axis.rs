//! One axis of a sprite: which pixels its rectangle covers, and which texel each of them shows.

use crate::math::num::{divide, divide_floor};
use core::ops::Range;

/// The columns or the rows of a sprite: a length on the screen that holds a number of texels of equal size.
///
/// A pixel is covered if its centre lies in [low, low + size), and shows the texel that holds the centre, exactly:
/// `⌊(256·pixel + 128 − low) · texels / size⌋`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpriteAxis {
    /// The left or upper border in sub-pixels: −2³⁰ − 2²¹ … 2²¹.
    low: i32,
    /// The length in sub-pixels: 0 … [`LARGEST`](Self::LARGEST).
    size: i32,
    /// The number of texels: 1 … 2³² − 1.
    texels: u32,
}

impl SpriteAxis {
    /// The largest length in sub-pixels: 2²² pixels, of which the guard band shows 2¹⁴.
    pub(crate) const LARGEST: i32 = 1 << 30;

    /// An axis of `size` sub-pixels, 0 … [`LARGEST`](Self::LARGEST), with `before` of them left of or above `at`, a coordinate of
    /// a point in the guard band; `before` is 0 … `size`. There is at least one texel, or `size` is 0.
    pub(crate) fn new(at: i32, before: i32, size: i32, texels: u32) -> Self {
        Self { low: at - before, size, texels }
    }

    /// Whether the axis has no length.
    pub(crate) const fn is_empty(&self) -> bool {
        self.size == 0
    }

    /// The pixels whose centres lie between the borders.
    pub(crate) fn pixels(&self) -> Range<i32> {
        let first = |border: i32| (border + 127) >> 8; // ⌈border − ½⌉; |border| ≤ 2³⁰ + 2²¹
        first(self.low)..first(self.low + self.size)
    }

    /// The texel of a pixel that the axis [covers](Self::pixels), and of the pixels after it.
    pub(crate) fn walk(&self, pixel: i32) -> TexelWalk {
        let Self { low, size, texels } = *self;
        let size = size as u32; // 1 … 2³⁰: it covers a pixel
        let offset = (256 * pixel + 128 - low) as u32; // 0 … size − 1

        // Numerators below 2⁶² and 2⁴⁰.
        let (texel, rest) = divided(u64::from(offset) * u64::from(texels), size);
        let (step, step_rest) = divided(256 * u64::from(texels), size);
        TexelWalk { texel, rest, step, step_rest, size }
    }
}

/// `⌊n / size⌋`, modulo 2³², and the remainder, for n < 2⁶²: a quotient of 2³² or more is only ever a step beyond the last pixel.
#[inline(never)] // code size: four calls
fn divided(n: u64, size: u32) -> (u32, u32) {
    match i32::try_from(n) {
        // The step of a magnified sprite, and its first texel unless it is clipped.
        Ok(n) if n < size as i32 => (0, n as u32),
        // By 32 bits, without long division.
        Ok(n) if size <= 1 << 22 => {
            let (quotient, rest) = divide_floor(n, size as i32);
            (quotient as u32, rest as u32)
        }
        _ => {
            let (quotient, rest) = divide(n, size);
            (quotient as u32, rest)
        }
    }
}

/// The texel of a pixel, and the step to the next pixel's texel without a division: each is a quotient and a remainder of a
/// division by `size`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TexelWalk {
    texel: u32,
    /// 0 … size − 1.
    rest: u32,
    step: u32,
    /// 0 … size − 1.
    step_rest: u32,
    /// 1 … 2³⁰.
    size: u32,
}

impl TexelWalk {
    /// The texel of the current pixel, below the number of texels where the axis covers that pixel.
    #[inline(always)]
    pub(crate) const fn texel(&self) -> u32 {
        self.texel
    }

    /// Goes to the next pixel.
    #[inline(always)]
    pub(crate) const fn advance(&mut self) {
        // Beyond the last pixel the texel may wrap: it is not asked for.
        self.texel = self.texel.wrapping_add(self.step);
        self.rest = self.rest.wrapping_add(self.step_rest); // below 2³¹
        if self.rest >= self.size {
            self.rest = self.rest.wrapping_sub(self.size);
            self.texel = self.texel.wrapping_add(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// Pixels and texels by the definition, in i128, where the borders, the scale and the number of texels are extreme, too.
    #[test]
    fn a_pixel_shows_the_texel_that_holds_its_centre() {
        let mut random = Random(11);
        let mut compared = 0;
        for i in 0..20_000 {
            let reach = [1 << 9, 1 << 14, 1 << 21, 1 << 30][i % 4];
            let size = 1 + random.below(reach) as i32;
            let texels = 1 + random.below([1, 4, 300, 1 << 16, u32::MAX.into()][i / 4 % 5]) as u32;
            let at = random.below(1 << 22) as i32 - (1 << 21);
            let before = random.below(i64::from(size) + 1) as i32;
            let axis = SpriteAxis::new(at, before, size, texels);
            let low = i128::from(at) - i128::from(before);
            let centre = |pixel: i32| 256 * i128::from(pixel) + 128 - low;
            let covers = |pixel: i32| (0..i128::from(size)).contains(&centre(pixel));
            let pixels = axis.pixels();
            assert!(!covers(pixels.start - 1) && !covers(pixels.end));
            if pixels.is_empty() {
                continue;
            }
            assert!(covers(pixels.start) && covers(pixels.end - 1));
            for first in [pixels.start, pixels.start + (pixels.len() / 2) as i32, pixels.end - 1] {
                let mut walk = axis.walk(first);
                for pixel in (first..pixels.end).take(300) {
                    let exact = centre(pixel) * i128::from(texels) / i128::from(size);
                    assert_eq!(i128::from(walk.texel()), exact, "{axis:?} at {pixel}");
                    walk.advance();
                    compared += 1;
                }
            }
        }
        assert!(compared > 1_000_000, "{compared}");
    }
}
