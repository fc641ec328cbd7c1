//! Cycles of an ESP32-C3, an RV32IMC core of four stages, by what was measured on the chip with its own counters.
//!
//! Loops that Timon Van Overveldt ran from RAM (github.com/timonvo/niccle, esp/examples/cycle_counting.rs, commit cc24cf46) give: one cycle
//! for arithmetic, shifts and `csrr`, two for a jump, three for a branch that is taken and one for a branch that is not, forward or
//! backward, whether it was met before or not; one for a store; two for a load whose result the next instruction takes, and for other
//! loads one, but two each fourth time.
//!
//! **Against a benchmark.** The maker's CoreMark does 409.249 rounds a second from RAM at 160 MHz (components.espressif.com, coremark 1.1.0,
//! GCC 12.2, -O3): 390 960 cycles each. Built by Debian's GCC 12.2.0 with those flags and with the checksums 0xe714, 0x1fd7 and 0x8e3a, a
//! round is 295 100 instructions, and 390 900 cycles by these rules: 0.0 % off. Its source is not in this repository, nor in a package
//! registry.
//!
//! **Not measured on this chip:** products of two words and divisions, which CoreMark has not. On its successor ESP32-C6, whose branches
//! differ, `mulh` and its like take 2 cycles, `div` and its like 10 (github.com/nilhoel1/LLTA-Bench, RESULTS.md, commit 7949f89a). A jump to a
//! register is taken for as long as a branch, whose target is known as late. CoreMark would also agree, to 0.4 %, if each
//! second store waited, and no load but for its result. [`Rules`] has both, and a range for what was not measured.

use super::decode::{Instruction, Kind};
use crate::record::Frame;

/// Guesses for the rules that were not measured, or not in all cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rules {
    /// The rules above.
    Likely,
    /// The least: a product of two words takes one cycle, divisions and jumps to registers as few as possible.
    Least,
    /// The most: these take twice as many as likely, and each second store waits in place of each fourth load.
    Most,
}

impl Rules {
    /// Quarters of a cycle: a load whose result is not used at once, a store, a jump to a register, a product of two words, a division.
    const fn quarters(self) -> [u32; 5] {
        match self {
            Self::Likely => [5, 4, 12, 8, 40],
            Self::Least => [5, 4, 8, 4, 20],
            Self::Most => [4, 6, 24, 16, 80],
        }
    }
}

/// The quarters of cycles of an instruction before another one; `taken`: that is not the one behind it.
fn quarters(rules: Rules, instruction: &Instruction, next: Option<&Instruction>, taken: bool) -> u32 {
    // Register 0 is always 0.
    let is_used = next.is_some_and(|next| instruction.writes & next.reads & !1 != 0);
    let [load, store, jump_to, multiply_high, divide] = rules.quarters();
    match instruction.kind {
        Kind::Load if is_used => 8,
        Kind::Load => load,
        Kind::Store => store,
        Kind::BranchIf if taken => 12,
        Kind::Branch => 8,
        Kind::BranchTo => jump_to,
        Kind::LongMultiply => multiply_high,
        Kind::Divide => divide,
        _ => 4,
    }
}

impl Rules {
    /// The cycles of a frame with its code in RAM.
    pub(crate) fn cycles(self, Frame { program, run, end, .. }: &Frame) -> u64 {
        let following = run.iter().skip(1).map(|next| next.at).chain([*end]);
        let one = |(executed, next): (&super::program::Executed, u32)| {
            let Some(instruction) = program.instruction(executed.at) else { return 0 };
            let taken = next != executed.at.wrapping_add(instruction.size);
            u64::from(quarters(self, instruction, program.instruction(next), taken))
        };
        run.iter().zip(following).map(one).sum::<u64>() / 4
    }
}
