//! Cycles of a sequence of instructions, by the timing tables of Arm's manuals: Cortex-M0 DDI 0432 (table 3-1), M0+ DDI 0484
//! (table 3-1), M3 DDI 0337 (table 3-1 and section 3.3.3), M4 DDI 0439 (table 3-1 and section 3.3.2). The M33 has no published
//! table: its rules are a guess.
//!
//! What an instruction takes by itself is the table `cycles` of `instructions.txt`; what depends on its neighbours is here. Memory
//! answers without waiting; what flash adds is in `flash.rs`.

use super::decode::{Address, Instruction, Kind, Offset, Registers, TEXT};
use serde::Deserialize;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Columns of the table of cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(crate) enum Pipeline {
    M0,
    M0Plus,
    M3,
    M4,
    M33,
}

/// An entry of the table: cycles, for each word too, and to fetch the next instruction anew.
#[derive(Clone, Copy)]
struct Rule {
    cycles: u32,
    for_each_word: bool,
    fetches: bool,
}

/// By the kind, and whether the instruction loads the PC, the rules of each [`Pipeline`].
static RULES: LazyLock<HashMap<(Kind, bool), [Rule; 5]>> = LazyLock::new(|| {
    let (_, table) = TEXT.split_once("\n[cycles]\n").unwrap_or_default();
    let rule = |word: &str| Rule {
        cycles: word.trim_end_matches(['c', 'r']).parse().expect("cycles"),
        for_each_word: word.contains('c'),
        fetches: word.contains('r'),
    };
    let row = |line: &str| {
        let (name, rules) = line.split_once(' ').expect("a kind and its cycles");
        let kind = name.trim_end_matches("-PC");
        let rules: Vec<_> = rules.split_whitespace().map(rule).collect();
        ((Kind::named(kind).expect("a kind"), kind != name), rules.try_into().ok().expect("five cores"))
    };
    table.lines().filter(|line| !line.starts_with('#')).map(row).collect()
});

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

    /// The cycles of the next instruction. M3 and M4 have three stages, and a load overlaps with the one before. The M33 is a guess: a load
    /// takes one more if its result is used at once; of two short instructions that do not depend on each other the second is free.
    pub(crate) fn step(&mut self, step: Step<'_>) -> u32 {
        let Step { instruction, taken, next_unaligned, skipped } = step;
        let Instruction { kind, loads_pc, reads, address_registers, writes, .. } = *instruction;
        let is_m33 = self.pipeline == Pipeline::M33;
        let overlaps = matches!(self.pipeline, Pipeline::M3 | Pipeline::M4) && !loads_pc && {
            // The address overlaps with the load before, unless it depends on it.
            let is_free = self.loaded != 0 && self.loaded & address_registers == 0;
            // With a constant offset a store goes on while the next instruction runs.
            let is_indexed =
                matches!(instruction.address, Some(Address { offset: Offset::Register(..), .. }));
            is_free || kind == Kind::Store && !is_indexed
        };
        let cycles = match kind {
            _ if skipped => 1,
            Kind::BranchIf | Kind::CompareBranch | Kind::BranchTo | Kind::CallTo | Kind::WritePc
                if !taken =>
            {
                1
            }
            Kind::Float => instruction.cycles,
            Kind::IfThen if self.joinable => 0,
            Kind::Load | Kind::Store if overlaps => 1,
            _ => RULES.get(&(kind, loads_pc)).map_or(1, |rules| {
                let Rule { cycles, for_each_word, fetches } = rules[self.pipeline as usize];
                let words = if for_each_word { instruction.count } else { 0 };
                // One of four bytes that is not aligned takes two fetches of four bytes.
                cycles + words + u32::from(fetches && taken && next_unaligned)
            }),
        };
        let inputs = reads | address_registers;
        let cycles = cycles + u32::from(is_m33 && !skipped && self.loaded & inputs != 0);
        let stands_alone = matches!(
            kind,
            Kind::Branch
                | Kind::Call
                | Kind::BranchTo
                | Kind::CallTo
                | Kind::WritePc
                | Kind::TableBranch
                | Kind::Multiply
        );
        let is_short = instruction.size == 2;
        let is_apart = is_short && !stands_alone && self.written & inputs == 0;
        let joins = is_m33 && self.joinable && is_apart && cycles == 1;
        let is_loaded = match kind {
            Kind::Load => !loads_pc,
            Kind::LoadMultiple | Kind::LoadDouble => is_m33,
            _ => false,
        };
        *self = Self {
            loaded: if is_loaded && !skipped { writes } else { 0 },
            joinable: is_short && (!is_m33 || !joins && kind == Kind::Simple && !taken),
            written: writes,
            pipeline: self.pipeline,
        };
        if joins {
            0
        } else {
            cycles
        }
    }
}
