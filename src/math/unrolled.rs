//! Arrays of a few elements, processed without a loop.
//!
//! At opt-level "s" LLVM compiles `array::map`, and iterators over arrays, to loops: each element goes through memory, and a
//! loop of three turns costs more than its body. These functions are straight code at every level, so they stand
//! where code runs for each pixel, vertex or face. `docs/compiler-hints.md` has their gain: S3 with depth takes a quarter
//! fewer instructions on a Cortex-M3.

/// Both elements, each replaced by what `f` returns for it.
#[inline(always)]
pub(crate) fn map2<A, B>([a, b]: [A; 2], mut f: impl FnMut(A) -> B) -> [B; 2] {
    [f(a), f(b)]
}

/// All three elements, each replaced by what `f` returns for it.
#[inline(always)]
pub(crate) fn map3<A, B>([a, b, c]: [A; 3], mut f: impl FnMut(A) -> B) -> [B; 3] {
    [f(a), f(b), f(c)]
}

/// Calls `each` for each of eight elements.
#[inline(always)]
pub(crate) fn each8<A>([a, b, c, d, e, f, g, h]: &mut [A; 8], mut each: impl FnMut(&mut A)) {
    each(a);
    each(b);
    each(c);
    each(d);
    each(e);
    each(f);
    each(g);
    each(h);
}
