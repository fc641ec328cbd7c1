//! Colours that are mixed many times: what depends on one colour alone is computed once.

use super::Color;
use crate::math::hints::opaque;

/// [`Color::mix`] and [`Color::over`] for loops.
pub(crate) trait Mixer: Color {
    /// Shares of [`mixer`](Self::mixer) are in 2^−`SHARE_BITS`.
    const SHARE_BITS: u32 = if Self::FORMAT.words().is_spread { 5 } else { 8 };

    /// A function of `alpha`, 0 … 32, that [mixes](Color::mix) this colour with another one.
    #[inline(always)]
    fn fade(self, other: Self) -> impl Fn(u8) -> Self + Copy {
        let words = const { Self::FORMAT.words() };
        let [first, ..] = words.words;
        let spread = |color: Self| (color.to_bits() | color.to_bits() << 16) & first.mask;
        let (own, below) = (spread(self), spread(other));
        // `mix` by one product: modulo 2³², own·a + other·(32 − a) = 32·other + (own − other)·a.
        let (none, step) = ((below << 5).wrapping_add(first.lowest << 4), own.wrapping_sub(below));
        move |alpha| {
            if !words.is_spread {
                return self.mix(other, alpha);
            }
            let mixed = none.wrapping_add(step.wrapping_mul(alpha.into())) >> 5 & first.mask;
            Self::from_bits((mixed | mixed >> 16) & 0xffff)
        }
    }

    /// [`Color::over`] for one colour. The arguments are the stored colour and its share, the part that this colour does not cover.
    #[inline(always)]
    fn mixer(self) -> impl Fn(Self, u32) -> Self + Copy {
        let words = const { Self::FORMAT.words() };
        let [first, ..] = words.words;
        // Hidden from LLVM, which would make two masks of it and load each again where registers are few.
        let mask = opaque(first.mask);
        let spread = |color: Self| color.to_bits() | color.to_bits() << 16;
        let own = spread(self) & first.mask;
        let all_own = (own << 5).wrapping_add(first.lowest << 4);
        move |stored, rest| {
            if !words.is_spread {
                return self.over(stored, 256_u32.wrapping_sub(rest) as u16); // 0 … 256
            }
            // `mix` by one product: own·(32 − rest) + stored·rest = 32·own + (stored − own)·rest modulo 2³².
            let sum = all_own.wrapping_add((spread(stored) & mask).wrapping_sub(own).wrapping_mul(rest));
            let mixed = sum >> 5 & mask;
            Self::from_bits((mixed | mixed >> 16) & 0xffff)
        }
    }
}

impl<C: Color> Mixer for C {}
