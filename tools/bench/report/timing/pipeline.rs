//! Cycles of a sequence of instructions, by the timing tables of Arm's manuals: Cortex-M0 DDI 0432 (table 3-1), M0+ DDI 0484
//! (table 3-1), M3 DDI 0337 (table 3-1 and section 3.3.3), M4 DDI 0439 (table 3-1 and section 3.3.2). The M33 has no published
//! table: its rules are a guess.
//!
//! Operands are not known: divisions, which end early, and the M3's long products take what is stated below. Memory answers
//! without waiting; what flash adds is in `flash.rs`.

use super::decode::{Instruction, Kind, Registers};
use serde::Deserialize;

#[derive(Clone, Copy, Deserialize)]
pub(crate) enum Pipeline {
    M0,
    M0Plus,
    M3,
    M4,
    M33,
}

/// Divisions take 2 to 12 cycles on the M3 and M4 and 2 to 11 on the M33: the middle is taken.
const DIVISION: u32 = 7;
/// The M3's UMULL and SMULL: 3 to 5. Only products of small numbers end early.
const LONG_PRODUCT: u32 = 5;
/// The M3's UMLAL and SMLAL: 4 to 7.
const LONG_PRODUCT_ADDED: u32 = 7;

/// Cycles to fill the pipeline of an M3, M4 or M33 again, 1 to 3 by the manuals: after a branch whose target is in the
/// instruction, after one to a register, and after a load of the PC.
const REFILL: u32 = 1;
const REFILL_FROM_REGISTER: u32 = 2;
const REFILL_FROM_MEMORY: u32 = 3;

/// An executed instruction, with the facts that decide its cycles.
#[derive(Clone, Copy)]
pub(crate) struct Step<'i> {
    pub(crate) instruction: &'i Instruction,
    /// Whether the next instruction is not the one at the following address.
    pub(crate) taken: bool,
    /// Whether the next instruction takes four bytes that do not start at a multiple of four.
    pub(crate) next_unaligned: bool,
    /// Whether the condition of its IT block did not hold.
    pub(crate) skipped: bool,
}

/// Counts cycles, instruction by instruction.
#[derive(Clone)]
pub(crate) struct Cycles {
    pipeline: Pipeline,
    /// The registers that the last instruction loaded, if the next load can overlap with it.
    loaded: Registers,
    /// Whether the last instruction took two bytes and an IT can hide behind it (M3, M4), or another can join it (M33).
    joinable: bool,
    /// The registers that the last instruction wrote.
    written: Registers,
}

impl Cycles {
    pub(crate) const fn new(pipeline: Pipeline) -> Self {
        Self { pipeline, loaded: 0, joinable: false, written: 0 }
    }

    /// The cycles of the next instruction.
    pub(crate) fn step(&mut self, step: Step<'_>) -> u32 {
        match self.pipeline {
            Pipeline::M0 => small(step, 1),
            Pipeline::M0Plus => small(step, 0),
            Pipeline::M3 | Pipeline::M4 => self.middle(step),
            Pipeline::M33 => self.large(step),
        }
    }

    /// M3 and M4: three stages; a load overlaps with the one before.
    fn middle(&mut self, step: Step<'_>) -> u32 {
        let Step { instruction, taken, skipped, .. } = step;
        let three = matches!(self.pipeline, Pipeline::M3);
        // The address of a load or store overlaps with the load before, unless it depends on it.
        let overlaps = self.loaded != 0 && self.loaded & instruction.address_registers == 0;
        let mut loaded = 0;
        let cycles = match instruction.kind {
            _ if skipped => 1,
            Kind::Load if instruction.loads_pc => 2 + refill(step, REFILL_FROM_MEMORY),
            Kind::Load => {
                loaded = instruction.writes;
                if overlaps {
                    1
                } else {
                    2
                }
            }
            // With a constant offset the store goes on while the next instruction runs.
            Kind::Store if overlaps || !is_indexed(instruction) => 1,
            Kind::Store => 2,
            Kind::LoadMultiple | Kind::LoadDouble if instruction.loads_pc => {
                1 + instruction.count + refill(step, REFILL_FROM_MEMORY)
            }
            Kind::LoadMultiple | Kind::LoadDouble | Kind::StoreMultiple | Kind::StoreDouble => {
                1 + instruction.count
            }
            Kind::MultiplyAdd if three => 2,
            Kind::LongMultiply if three => LONG_PRODUCT,
            Kind::LongMultiplyAdd if three => LONG_PRODUCT_ADDED,
            Kind::IfThen if self.joinable => 0,
            _ => both(step, taken),
        };
        *self = Self {
            loaded,
            joinable: instruction.size == 2,
            written: instruction.writes,
            pipeline: self.pipeline,
        };
        cycles
    }

    /// M33, a guess: a load takes 1 and one more if its result is used at once; of two short instructions that do not
    /// depend on each other the second is free.
    fn large(&mut self, step: Step<'_>) -> u32 {
        let Step { instruction, taken, skipped, .. } = step;
        let inputs = instruction.reads | instruction.address_registers;
        let waits = u32::from(!skipped && self.loaded & inputs != 0);
        let mut loaded = 0;
        let cycles = waits
            + match instruction.kind {
                _ if skipped => 1,
                Kind::Load if instruction.loads_pc => 1 + refill(step, REFILL_FROM_MEMORY),
                Kind::Load => {
                    loaded = instruction.writes;
                    1
                }
                Kind::Store => 1,
                Kind::LoadMultiple | Kind::LoadDouble => {
                    loaded = instruction.writes;
                    instruction.count
                        + if instruction.loads_pc { refill(step, REFILL_FROM_MEMORY) } else { 0 }
                }
                Kind::StoreMultiple | Kind::StoreDouble => instruction.count,
                Kind::IfThen if self.joinable => 0,
                _ => both(step, taken),
            };
        let leaves = matches!(
            instruction.kind,
            Kind::Branch
                | Kind::Call
                | Kind::BranchTo
                | Kind::CallTo
                | Kind::WritePc
                | Kind::TableBranch
                | Kind::Multiply
        );
        let short = instruction.size == 2;
        let joins = self.joinable && short && !leaves && self.written & inputs == 0 && cycles == 1;
        *self = Self {
            loaded,
            joinable: !joins && short && instruction.kind == Kind::Simple && !taken,
            written: instruction.writes,
            pipeline: self.pipeline,
        };
        if joins {
            0
        } else {
            cycles
        }
    }
}

/// M0 and M0+; the M0 has one more stage to fill again. MULS takes one cycle, as in all chips of `docs/data/chips.json`: a core with the small
/// multiplier takes 32.
fn small(Step { instruction, taken, .. }: Step<'_>, stage: u32) -> u32 {
    match instruction.kind {
        Kind::Load | Kind::Store => 2,
        Kind::LoadMultiple if instruction.loads_pc => 3 + stage + instruction.count,
        Kind::LoadMultiple | Kind::StoreMultiple => 1 + instruction.count,
        Kind::Branch | Kind::BranchTo | Kind::CallTo | Kind::WritePc => 2 + stage,
        Kind::BranchIf if taken => 2 + stage,
        Kind::Call | Kind::System => 3 + stage,
        _ => 1,
    }
}

/// Rows that the M3, the M4 and the guess for the M33 share.
fn both(step: Step<'_>, taken: bool) -> u32 {
    match step.instruction.kind {
        Kind::Divide => DIVISION,
        Kind::Branch | Kind::Call => 1 + refill(step, REFILL),
        Kind::BranchIf | Kind::CompareBranch if taken => 1 + refill(step, REFILL),
        Kind::BranchTo | Kind::CallTo | Kind::WritePc if taken => 1 + refill(step, REFILL_FROM_REGISTER),
        Kind::TableBranch => 2 + refill(step, REFILL_FROM_REGISTER),
        Kind::System => 2,
        Kind::Float => step.instruction.cycles,
        _ => 1,
    }
}

/// An instruction of four bytes that is not aligned takes two fetches of four bytes.
fn refill(step: Step<'_>, cycles: u32) -> u32 {
    cycles + u32::from(step.taken && step.next_unaligned)
}

fn is_indexed(instruction: &Instruction) -> bool {
    use super::decode::{Address, Offset};
    matches!(instruction.address, Some(Address { offset: Offset::Register(..), .. }))
}
