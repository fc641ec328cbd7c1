//! Filling a slice with one value, faster than [`slice::fill`] on Cortex-M and RISC-V.
//!
//! - **Plain twin**: [`slice::fill`].
//! - **Domain**: every slice; these functions never decline.
//! - **Gain**: one 32-bit store for two 16-bit pixels. [`fill_words`] takes a third of the time of the `memset` that LLVM
//!   would call on a Cortex-M.
//! - **Test**: `block_fill::tests`, bit for bit against [`slice::fill`].
//!
//! The functions are here and not in [`crate::fast`] because they are not about triangles: plain paths use them too, to clear
//! pictures and the depth buffer. `--cfg pinhole_plain` replaces each by [`slice::fill`]. A *cell* is one stored pixel.

use crate::math::cores::CORTEX_M0;
use crate::math::hints::{keep_rolled, opaque};

/// A run of at least this many cells is filled 32 cells at a time.
pub(crate) const LONG: i32 = 64;

/// The value twice, behind `opaque`, so that LLVM keeps both copies in one register and stores two 16-bit cells at once.
#[inline(always)]
pub(crate) fn pair<Cell: Copy>(cell: Cell) -> [Cell; 2] {
    opaque([cell; 2])
}

/// Fills a run of any length with one value.
#[inline(always)]
pub(crate) fn fill<Cell: Copy>(run: &mut [Cell], cell: Cell) {
    fill_pairs(run, pair(cell), true);
}

/// Fills a run with a [`pair`]: 32 cells at a time in long runs, then eight, then the remainder without a loop.
///
/// `may_be_long` is a constant at each call. If it is `false`, eight cells before the loop replace the loop over 32 cells: then
/// the compiler needs a single address for the run while the caller steps through rows.
#[inline(always)]
pub(crate) fn fill_pairs<Cell: Copy>(mut run: &mut [Cell], pair: [Cell; 2], may_be_long: bool) {
    let [cell, _] = pair;
    if cfg!(pinhole_plain) {
        return run.fill(cell);
    }
    if run.len() >= 8 {
        if may_be_long && run.len() >= LONG as usize {
            let (blocks, rest) = run.split_at_mut(run.len() & !31);
            for block in blocks.chunks_exact_mut(32) {
                if let [a, b, c, d] = block.as_chunks_mut::<8>().0 {
                    fill_eight(a, pair);
                    fill_eight(b, pair);
                    fill_eight(c, pair);
                    fill_eight(d, pair);
                }
                keep_rolled();
            }
            run = rest;
        }
        if !may_be_long && run.len() >= 16 {
            let (eight, rest) = run.split_at_mut(8);
            if let [a, b, c, d, e, f, g, h] = eight {
                [[*a, *b], [*c, *d], [*e, *f], [*g, *h]] = [pair; 4];
            }
            run = rest;
        }
        while let [a, b, c, d, e, f, g, h, rest @ ..] = run {
            [[*a, *b], [*c, *d], [*e, *f], [*g, *h]] = [pair; 4];
            run = rest;
            keep_rolled();
        }
    }
    match run {
        [] => {}
        [a] => *a = cell,
        [a, b] => [*a, *b] = pair,
        [a, b, c] => ([*a, *b], *c) = (pair, cell),
        [a, b, c, d] => [[*a, *b], [*c, *d]] = [pair; 2],
        [a, b, c, d, e] => ([[*a, *b], [*c, *d]], *e) = ([pair; 2], cell),
        [a, b, c, d, e, f] => [[*a, *b], [*c, *d], [*e, *f]] = [pair; 3],
        [a, b, c, d, e, f, g, ..] => ([[*a, *b], [*c, *d], [*e, *f]], *g) = ([pair; 3], cell),
    }
}

/// Sets eight cells, two at once if they have 16 bits.
#[inline(always)]
pub(crate) fn fill_eight<Cell: Copy>([a, b, c, d, e, f, g, h]: &mut [Cell; 8], pair: [Cell; 2]) {
    [[*a, *b], [*c, *d], [*e, *f], [*g, *h]] = [pair; 4];
}

/// Fills a slice that is not part of a drawing loop, such as a whole picture.
pub(super) fn clear<Cell: Copy>(cells: &mut [Cell], cell: Cell) {
    fill(cells, cell);
}

/// Fills a slice of words in blocks of 64, which LLVM stores by instructions for several words. The stores of a block are
/// written out: as a loop over its words, opt-level "s" would store one word a turn.
///
/// `opaque` keeps LLVM from turning the loop into a call of `memset`, which takes up to three times as long on a Cortex-M.
pub(super) fn fill_words(words: &mut [u32], word: u32) {
    if cfg!(pinhole_plain) {
        return words.fill(word);
    }
    let (blocks, rest) = words.as_chunks_mut::<64>();
    if CORTEX_M0 {
        // The compiler does not know that the words of this block are equal, so it copies four at a time, by one `stm`.
        let source = opaque([word; 16]);
        for block in blocks {
            if let [a, b, c, d] = block.as_chunks_mut().0 {
                (*a, *b, *c, *d) = (source, source, source, source);
            }
            keep_rolled();
        }
    } else {
        for block in blocks {
            let word = opaque(word);
            if let [a, b, c, d] = block.as_chunks_mut().0 {
                fill_sixteen(a, word);
                fill_sixteen(b, word);
                fill_sixteen(c, word);
                fill_sixteen(d, word);
            }
        }
    }
    for rest in rest {
        keep_rolled(); // or LLVM would call `memset`, which is larger
        *rest = word;
    }
}

#[inline(always)]
fn fill_sixteen([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p]: &mut [u32; 16], word: u32) {
    [[*a, *b, *c, *d], [*e, *f, *g, *h], [*i, *j, *k, *l], [*m, *n, *o, *p]] = [[word; 4]; 4];
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn block_fills_write_what_slice_fill_writes() {
        for from in 0..5 {
            for length in 0..300 {
                let (mut long, mut short, mut words) = ([7_u16; 310], [7_u16; 310], [7_u32; 310]);
                let mut plain = [7_u16; 310];
                plain[from..from + length].fill(0xabcd);
                fill(&mut long[from..from + length], 0xabcd);
                fill_pairs(&mut short[from..from + length], pair(0xabcd), false);
                fill_words(&mut words[from..from + length], 0xabcd);
                assert_eq!((long, short), (plain, plain), "{from} {length}");
                assert_eq!(words, plain.map(u32::from), "{from} {length}");
            }
        }
    }
}
