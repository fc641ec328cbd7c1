//! Colours that are mixed many times: what depends on one colour alone is computed once.

use super::format::Words;
use super::Color;
use crate::math::hints::opaque;

/// [`Color::mix`] and [`Color::over`] for loops.
pub(crate) trait Mixer: Color {
    /// How channels are mixed. Closures name constants instead of variables, which they would store.
    const WORDS: Words = Self::FORMAT.words();

    /// Shares of [`mixer`](Self::mixer) are in 2^−`SHARE_BITS`.
    const SHARE_BITS: u32 = if Self::WORDS.is_spread { 5 } else { 8 };

    /// The bits of the channels that are mixed by one product.
    const MASK: u32 = Self::WORDS.words[0].mask;

    /// The half that rounds each of them.
    const HALF: u32 = Self::WORDS.words[0].lowest << 4;

    /// A function of `alpha`, 0 … 32, that [mixes](Color::mix) this colour with another one. It owns two words, whatever the format.
    #[inline(always)]
    fn fade(self, other: Self) -> impl Fn(u8) -> Self + Copy {
        // `mix` by one product: modulo 2³², own·a + other·(32 − a) = 32·other + (own − other)·a.
        let (first, second) = if Self::WORDS.is_spread {
            let [own, other] = [self, other].map(|color| spread(color, Self::MASK));
            ((other << 5).wrapping_add(Self::HALF), own.wrapping_sub(other))
        } else {
            (self.to_bits(), other.to_bits())
        };
        move |alpha| {
            if !Self::WORDS.is_spread {
                return Self::from_bits(first).mix(Self::from_bits(second), alpha);
            }
            gathered(first.wrapping_add(second.wrapping_mul(alpha.into())) >> 5 & Self::MASK)
        }
    }

    /// [`Color::over`] for one colour. The arguments are the stored colour and its share, the part that this colour does not cover.
    #[inline(always)]
    fn mixer(self) -> impl Fn(Self, u32) -> Self + Copy {
        // Hidden from LLVM, which would make two masks of it and load each again where registers are few.
        let mask = opaque(Self::MASK);
        let own = if Self::WORDS.is_spread { spread(self, Self::MASK) } else { self.to_bits() };
        let all_own = (own << 5).wrapping_add(Self::HALF);
        move |stored, rest| {
            if !Self::WORDS.is_spread {
                return Self::from_bits(own).over(stored, 256_u32.wrapping_sub(rest) as u16);
                // 0 … 256
            }
            // `mix` by one product: own·(32 − rest) + stored·rest = 32·own + (stored − own)·rest modulo 2³².
            let sum = all_own.wrapping_add(spread(stored, mask).wrapping_sub(own).wrapping_mul(rest));
            gathered(sum >> 5 & mask)
        }
    }

    /// Two neighbours, each mixed with the other one by a share in 2^−`SHARE_BITS`, as by [`mixer`](Self::mixer). `mask`: `MASK`.
    #[inline(always)]
    fn exchanged([low, high]: [Self; 2], [to_low, to_high]: [u32; 2], mask: u32) -> [Self; 2] {
        if !Self::WORDS.is_spread {
            return [low.mixer()(high, to_low), high.mixer()(low, to_high)];
        }
        let [low, high] = [low, high].map(|color| spread(color, mask));
        let (beyond, all) = (high.wrapping_sub(low), |own: u32| (own << 5).wrapping_add(Self::HALF));
        let sums = [
            all(low).wrapping_add(beyond.wrapping_mul(to_low)),
            all(high).wrapping_sub(beyond.wrapping_mul(to_high)),
        ];
        sums.map(|sum| gathered(sum >> 5 & mask))
    }

    /// A function that mixes the colours of four neighbours, upper left, upper right, lower left and lower right, by the shares of the right
    /// and of the lower ones, below 1. The share of the lower right one is their product, rounded to nearest; all four shares have the
    /// sum 1, and none is negative. Each channel is rounded once, to nearest, ties up.
    #[inline(always)]
    fn bilinear(corners: [Self; 4], mask: u32) -> impl Fn([u32; 2]) -> Self + Copy {
        let [a, b, c, d] = corners.map(|color| color.words(mask));
        // Modulo 2³²: a channel's sum is at most 2^SHARE_BITS·max, which its room holds.
        let part = move |i: usize| {
            let [a, b, c, d] = [a, b, c, d].map(|words| words[i % 3]);
            let half = Self::WORDS.words[i % 3].lowest << (Self::SHARE_BITS - 1);
            let (right, below) = (b.wrapping_sub(a), c.wrapping_sub(a));
            [(a << Self::SHARE_BITS).wrapping_add(half), right, below, d.wrapping_sub(c).wrapping_sub(right)]
        };
        let parts = [part(0), part(1), part(2)];
        move |[u, v]| {
            let both = u.wrapping_mul(v).wrapping_add(1 << (Self::SHARE_BITS - 1)) >> Self::SHARE_BITS;
            let sums = parts.map(|[own, right, below, cross]| {
                let sum = own.wrapping_add(right.wrapping_mul(u)).wrapping_add(below.wrapping_mul(v));
                sum.wrapping_add(cross.wrapping_mul(both)) >> Self::SHARE_BITS
            });
            Self::from_words(sums, mask)
        }
    }

    /// The channels of [`WORDS`](Self::WORDS).
    #[inline(always)]
    fn words(self, mask: u32) -> [u32; 3] {
        if !Self::FORMAT.has_channels() {
            return self.channels().map(u32::from);
        }
        match Self::WORDS.is_spread {
            true => [spread(self, mask), 0, 0],
            false => Self::WORDS.words.map(|word| self.to_bits() & word.mask),
        }
    }

    /// The colour of [`words`](Self::words), whose other bits are of no account.
    #[inline(always)]
    fn from_words(words: [u32; 3], mask: u32) -> Self {
        if !Self::FORMAT.has_channels() {
            return Self::from_channels(words.map(|word| word as u8));
        }
        let ([_, j, k], [x, y, z]) = (Self::WORDS.words.map(|word| word.mask), words);
        match Self::WORDS.is_spread {
            true => gathered(x & mask),
            false => Self::from_bits(x & mask | y & j | z & k),
        }
    }

    /// [`mixer`](Self::mixer) for shares that are equal over a run of pixels, such as those of fog: this colour times its share is computed
    /// once for the run. `mixer` takes one instruction more for each pixel on an M3.
    #[inline(always)]
    fn run_mixer(self) -> impl Fn(Self, u32) -> Self + Copy {
        let (mask, mix) = (opaque(Self::MASK), self.mixer());
        let own = spread(self, Self::MASK);
        move |stored, rest| match Self::WORDS.is_spread {
            // `rest` is 0 … 32. LLVM would turn a sum with own·rest into a product with (stored − own), as in `mixer`.
            true => {
                let of_run = own.wrapping_mul(32_u32.wrapping_sub(rest)).wrapping_add(Self::HALF);
                gathered(of_run.wrapping_add(spread(stored, mask).wrapping_mul(rest)) >> 5 & mask)
            }
            false => mix(stored, rest),
        }
    }
}

/// The channels of a colour in a word, with the middle one 16 bits higher.
#[inline(always)]
fn spread<C: Color>(color: C, mask: u32) -> u32 {
    (color.to_bits() | color.to_bits() << 16) & mask
}

/// The colour with the channels of [`spread`].
#[inline(always)]
fn gathered<C: Color>(word: u32) -> C {
    C::from_bits((word | word >> 16) & 0xffff)
}

impl<C: Color> Mixer for C {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use core::fmt::Debug;
    use embedded_graphics_core::pixelcolor::{Bgr555, Gray4, Rgb565, Rgb888};

    fn check<C: Color + Debug>(random: &mut Random) {
        for alpha in (0..=32).cycle().take(9_000) {
            let [own, other] = [(); 2].map(|()| C::from_bits(random.bits()));
            let (mixed, share) = (own.mix(other, alpha), u32::from(alpha) << (C::SHARE_BITS - 5));
            assert_eq!(own.fade(other)(alpha), mixed, "{own:?} {other:?} {alpha}");
            assert_eq!(other.run_mixer()(own, share), mixed, "{own:?} {other:?} {alpha}");
            let more = random.below(1 << C::SHARE_BITS) as u32;
            let coverage = ((1 << C::SHARE_BITS) - more) << (8 - C::SHARE_BITS);
            assert_eq!(
                own.mixer()(other, more),
                own.over(other, coverage as u16),
                "{own:?} {other:?} {more}"
            );
            let both = [other.mixer()(own, share), own.mixer()(other, more)];
            assert_eq!(
                C::exchanged([other, own], [share, more], C::MASK),
                both,
                "{own:?} {other:?} {alpha} {more}"
            );
        }
    }

    #[test]
    fn fades_and_runs_are_mixed() {
        let random = &mut Random(5);
        check::<Rgb565>(random);
        check::<Bgr555>(random);
        check::<Rgb888>(random);
        check::<Gray4>(random);
    }
}
