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

use crate::{elf, Result};
use std::path::Path;

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

/// The properties of an instruction that decide its cycles: kind and registers (*The RISC-V Instruction Set Manual*, volume I,
/// chapters 2, 7 and 16).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Instruction {
    /// The size in bytes: 2 or 4.
    pub(crate) size: u32,
    pub(crate) kind: Kind,
    /// The registers that it reads, a bit each.
    pub(crate) reads: u32,
    /// The register that it writes.
    pub(crate) writes: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Simple,
    Load,
    Store,
    /// `beq` and its like.
    Branch,
    /// `jal`.
    Jump,
    /// `jalr`.
    JumpTo,
    Multiply,
    /// `mulh`, `mulhu`, `mulhsu`.
    MultiplyHigh,
    Divide,
}

/// Bits `from..from + count`.
const fn bits(code: u32, from: u32, count: u32) -> u32 {
    code >> from & ((1 << count) - 1)
}

impl Instruction {
    /// Decodes an instruction from its first and second half; the second one is used for an instruction of four bytes.
    pub(crate) fn decode(first: u16, second: u16) -> Self {
        match first & 3 {
            3 => wide(u32::from(first) | u32::from(second) << 16),
            quadrant => compressed(first.into(), quadrant),
        }
    }
}

fn wide(code: u32) -> Instruction {
    let [to, a, b] = [bits(code, 7, 5), bits(code, 15, 5), bits(code, 20, 5)];
    let (one, both) = (1 << a, 1 << a | 1 << b);
    let of = |kind, reads, writes| Instruction { size: 4, kind, reads, writes };
    match bits(code, 2, 5) {
        0b00000 => of(Kind::Load, one, to),
        0b01000 => of(Kind::Store, both, 0),
        0b11000 => of(Kind::Branch, both, 0),
        0b11011 => of(Kind::Jump, 0, to),
        0b11001 => of(Kind::JumpTo, one, to),
        // Of registers: those of the extension M have a bit of their own.
        0b01100 if bits(code, 25, 7) == 1 => {
            let kind = match bits(code, 12, 3) {
                0 => Kind::Multiply,
                1..=3 => Kind::MultiplyHigh,
                _ => Kind::Divide,
            };
            of(kind, both, to)
        }
        0b01100 => of(Kind::Simple, both, to),
        // `lui`, `auipc`.
        0b01101 | 0b00101 => of(Kind::Simple, 0, to),
        _ => of(Kind::Simple, one, to),
    }
}

fn compressed(code: u32, quadrant: u16) -> Instruction {
    // The registers 8 to 15 have three bits.
    let ([low, high], [full, second]) =
        ([bits(code, 2, 3) + 8, bits(code, 7, 3) + 8], [bits(code, 7, 5), bits(code, 2, 5)]);
    let of = |kind, reads: u32, writes| Instruction { size: 2, kind, reads, writes };
    const SP: u32 = 2;
    match (quadrant, bits(code, 13, 3)) {
        // `c.addi4spn`, `c.lw`, `c.sw`.
        (0, 0b000) => of(Kind::Simple, 1 << SP, low),
        (0, 0b010) => of(Kind::Load, 1 << high, low),
        (0, 0b110) => of(Kind::Store, 1 << high | 1 << low, 0),
        // `c.addi`, `c.jal`, `c.li`, `c.lui` or `c.addi16sp`.
        (1, 0b000) => of(Kind::Simple, 1 << full, full),
        (1, 0b001) => of(Kind::Jump, 0, 1),
        (1, 0b010) => of(Kind::Simple, 0, full),
        (1, 0b011) => of(Kind::Simple, if full == SP { 1 << SP } else { 0 }, full),
        (1, 0b100) => {
            let reads = if bits(code, 10, 2) == 3 { 1 << high | 1 << low } else { 1 << high };
            of(Kind::Simple, reads, high)
        }
        (1, 0b101) => of(Kind::Jump, 0, 0),
        (1, _) => of(Kind::Branch, 1 << high, 0),
        // `c.slli`, `c.lwsp`, `c.swsp`.
        (2, 0b000) => of(Kind::Simple, 1 << full, full),
        (2, 0b010) => of(Kind::Load, 1 << SP, full),
        (2, 0b110) => of(Kind::Store, 1 << SP | 1 << second, 0),
        // `c.jr`, `c.mv`, `c.ebreak`, `c.jalr`, `c.add`.
        (2, 0b100) => match (bits(code, 12, 1), full, second) {
            (_, 0, _) => of(Kind::Simple, 0, 0),
            (link, _, 0) => of(Kind::JumpTo, 1 << full, link),
            (0, ..) => of(Kind::Simple, 1 << second, full),
            _ => of(Kind::Simple, 1 << full | 1 << second, full),
        },
        _ => of(Kind::Simple, 0, 0),
    }
}

/// The quarters of cycles of an instruction before another one; `taken`: that is not the one behind it.
fn quarters(rules: Rules, instruction: &Instruction, next: Option<&Instruction>, taken: bool) -> u32 {
    let is_used =
        next.is_some_and(|next| instruction.writes != 0 && next.reads >> instruction.writes & 1 == 1);
    let [load, store, jump_to, multiply_high, divide] = rules.quarters();
    match instruction.kind {
        Kind::Simple | Kind::Multiply => 4,
        Kind::Load if is_used => 8,
        Kind::Load => load,
        Kind::Store => store,
        Kind::Branch if taken => 12,
        Kind::Branch => 4,
        Kind::Jump => 8,
        Kind::JumpTo => jump_to,
        Kind::MultiplyHigh => multiply_high,
        Kind::Divide => divide,
    }
}

/// The code of an image.
pub(crate) struct Program {
    start: u32,
    halves: Vec<u16>,
}

impl Program {
    pub(crate) fn of(image: &Path) -> Result<Self> {
        let halves =
            elf::code(image)?.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
        Ok(Self::new(u32::try_from(elf::sizes(image)?.code.start)?, halves))
    }

    pub(crate) const fn new(start: u32, halves: Vec<u16>) -> Self {
        Self { start, halves }
    }

    /// The instruction at an address; `None` outside of the code.
    pub(crate) fn instruction(&self, at: u32) -> Option<Instruction> {
        let index = (at.wrapping_sub(self.start) / 2) as usize;
        let second = self.halves.get(index + 1).copied().unwrap_or_default();
        Some(Instruction::decode(*self.halves.get(index)?, second))
    }

    /// The cycles of a run, the last instruction being followed by that at `end`.
    pub(crate) fn cycles(&self, rules: Rules, run: &[u32], end: u32) -> u64 {
        let following = run.iter().skip(1).copied().chain([end]);
        let one = |(&at, next): (&u32, u32)| {
            let Some(instruction) = self.instruction(at) else { return 0 };
            let taken = next != at.wrapping_add(instruction.size);
            u64::from(quarters(rules, &instruction, self.instruction(next).as_ref(), taken))
        };
        run.iter().zip(following).map(one).sum::<u64>() / 4
    }
}
