//! Compiler hints: functions that change no result, only the code that LLVM makes of a loop, a branch or a value.
//!
//! Each is `core::hint::black_box` under the name of its purpose. `black_box` is a request, so no result may depend on it;
//! what a hint gains depends on the compiler. `docs/compiler-hints.md` lists every kind of hint, which core gains how
//! much, and how to judge a hint again with a new compiler: remove it, then compare
//!
//! ```sh
//! tools/bench/run cells S3 z M0   # instructions and flash of one scene on one core, before and after
//! ```
//!
//! | hint | prevents | gains |
//! |---|---|---|
//! | [`keep_rolled`] | unrolling | S3 z: Cortex-M0 3.5 % of instructions, 4956 bytes of flash; M3 12 %, 4052 bytes |
//! | [`opaque_next`] | unrolling of loops whose count is a small constant | S3 z: Cortex-M0 820 bytes of flash, M3 1296 bytes |
//! | [`keep_branch`] | a branch turned into arithmetic, or two tests merged into one | instructions on a Cortex-M0 and M3 |
//! | [`opaque`] | constant propagation, keeping a value in a register across a loop, recognition of `memset` | instructions |

use core::hint::black_box;

/// Keeps a loop rolled when its body calls it: LLVM unrolls four times and more, which costs flash on every core, and time
/// where unrolled code runs out of registers. Used in set-up code and short loops.
#[inline(always)]
pub(crate) const fn keep_rolled() {
    black_box(());
}

/// `index + 1`, as a value that the compiler does not know, so that it does not unroll a loop of three or four iterations.
/// [`keep_rolled`] does not prevent full unrolling where the count is a constant.
#[inline(always)]
pub(crate) const fn opaque_next(index: usize) -> usize {
    black_box(index + 1)
}

/// Keeps a branch a branch when one of its sides calls it. Without it LLVM computes both sides and selects, or merges two
/// tests with one outcome into a single test that needs more arithmetic: slower on cores without predicated instructions.
#[inline(always)]
pub(crate) const fn keep_branch() {
    black_box(());
}

/// Returns `value` so that the compiler no longer knows it. The call site says why: to keep a constant in a register, to load a
/// value again where a register is needed more, or to prevent a call of `memset`.
#[inline(always)]
pub(crate) const fn opaque<T>(value: T) -> T {
    black_box(value)
}
