//! A recorded run of an image, and the cycles that it takes.

use super::decode::{Address, Instruction, Kind, Offset};
use super::flash::{Flash, FlashRules};
use super::pipeline::{Cycles, Pipeline, Step};
use crate::record::Frame;

/// The instructions of an image, by their addresses.
#[derive(Default)]
pub(crate) struct Program {
    start: u32,
    /// One for every two bytes, also in the middle of instructions.
    instructions: Vec<Instruction>,
    halves: Vec<u16>,
}

/// The board's flash ends here, its RAM begins far above.
const FLASH_END: u32 = 0x0040_0000;

/// An instruction that was executed.
#[derive(Clone, Copy)]
pub(crate) struct Executed {
    pub(crate) at: u32,
    /// The address in flash that it loads from, or [`Self::NOTHING`].
    read: u32,
    /// Whether the condition of its IT block did not hold.
    skipped: bool,
}

impl Executed {
    const NOTHING: u32 = u32::MAX;

    /// An instruction of which only the address is known.
    pub(crate) const fn at(at: u32) -> Self {
        Self { at, read: Self::NOTHING, skipped: false }
    }
}

/// The registers before an instruction, its address among them, and the flags.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct State {
    pub(crate) registers: [u32; 16],
    pub(crate) flags: u32,
}

impl State {
    /// Whether a condition holds (DDI 0403, A7.3).
    fn holds(&self, condition: u16) -> bool {
        let [n, z, c, v] = [31, 30, 29, 28].map(|bit| self.flags >> bit & 1 == 1);
        let holds = match condition >> 1 & 7 {
            0 => z,
            1 => c,
            2 => n,
            3 => v,
            4 => c && !z,
            5 => n == v,
            6 => n == v && !z,
            _ => return true,
        };
        holds != (condition & 1 == 1)
    }
}

/// The conditions of an IT block that is being executed: those of its next instructions, the first one last.
#[derive(Default)]
pub(crate) struct Conditions(Vec<u16>);

/// The cycles of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Taken {
    pub(crate) cycles: u64,
    /// The cycles among these for which the core waited for flash.
    pub(crate) waited: u64,
    /// The cycles before each of the marked instructions.
    pub(crate) marks: Vec<u64>,
}

impl Program {
    pub(crate) fn new(start: u32, halves: Vec<u16>, decode: fn(u16, u16) -> Instruction) -> Self {
        let second = halves.iter().skip(1).chain([&0]);
        let instructions = halves.iter().zip(second).map(|(first, second)| decode(*first, *second)).collect();
        Self { start, instructions, halves }
    }

    fn index(&self, at: u32) -> usize {
        (at.wrapping_sub(self.start) / 2) as usize
    }

    /// The instruction at an address; `None` outside of the code.
    pub(super) fn instruction(&self, at: u32) -> Option<&Instruction> {
        self.instructions.get(self.index(at))
    }

    /// The bytes of the instruction at an address.
    pub(crate) fn size(&self, at: u32) -> u32 {
        self.instruction(at).map_or(2, |instruction| instruction.size)
    }

    /// The facts of an instruction whose registers are known.
    pub(crate) fn record(&self, state: &State, conditions: &mut Conditions) -> Executed {
        let at = state.registers[15];
        let skipped = conditions.0.pop().is_some_and(|condition| !state.holds(condition));
        let Some(instruction) = self.instruction(at) else { return Executed { skipped, ..Executed::at(at) } };
        if instruction.kind == Kind::IfThen {
            let half = self.halves.get(self.index(at)).copied().unwrap_or_default();
            // The lowest bit of each condition is the first one's, or a bit of the mask.
            let (first, mask) = (half >> 4 & 0xf, half & 0xf);
            conditions.0 = (1..instruction.count).rev().map(|n| first & !1 | mask >> (4 - n) & 1).collect();
            conditions.0.push(first);
        }
        let loads = !matches!(instruction.kind, Kind::Store | Kind::StoreMultiple | Kind::StoreDouble);
        let address = instruction.address.filter(|_| loads && !skipped).map(|address| go(state, address));
        let read = address.filter(|address| *address < FLASH_END).unwrap_or(Executed::NOTHING);
        Executed { at, read, skipped }
    }

    /// The cycles of a run, the last instruction being followed by that at `end`; `flash` as it was left by what ran before.
    pub(crate) fn cycles(
        &self,
        run: &[Executed],
        end: u32,
        pipeline: Pipeline,
        mut flash: Option<&mut Flash>,
        mark: Option<u32>,
    ) -> Taken {
        let (mut counter, mut taken) =
            (Cycles::new(pipeline), Taken { cycles: 0, waited: 0, marks: Vec::new() });
        // A line counts its time from the start of this run.
        let following = run.iter().skip(1).map(|next| next.at).chain([end]);
        for (executed, next) in run.iter().zip(following) {
            let Some(instruction) = self.instruction(executed.at) else { continue };
            if mark == Some(executed.at) {
                taken.marks.push(taken.cycles);
            }
            let leaves = next != executed.at.wrapping_add(instruction.size);
            let next_unaligned =
                next % 4 != 0 && self.instruction(next).is_some_and(|instruction| instruction.size == 4);
            let skipped = executed.skipped || instruction.loads_pc && !leaves;
            if let Some(flash) = &mut flash {
                let waits = flash.fetch(executed.at, instruction.size, taken.cycles);
                taken.cycles += waits;
                taken.waited += waits;
            }
            let step = Step { instruction, taken: leaves, next_unaligned, skipped };
            taken.cycles += u64::from(counter.step(step));
            if let (Some(flash), true) = (&mut flash, executed.read != Executed::NOTHING) {
                let words = 0..instruction.count.max(1);
                let waits: u64 = words.map(|word| flash.read(executed.read.wrapping_add(4 * word))).sum();
                taken.cycles += waits;
                taken.waited += waits;
            }
        }
        taken
    }
}

impl Frame {
    /// The cycles of a frame that follows another one of its kind, so that caches are warm; without waits if there is no flash.
    pub(crate) fn cycles(&self, pipeline: Pipeline, rules: Option<FlashRules>) -> Taken {
        let mut flash = rules.map(Flash::new);
        let mut pass = || self.program.cycles(&self.run, self.end, pipeline, flash.as_mut(), self.mark);
        if rules.is_some() {
            pass();
        }
        pass()
    }
}

/// The address of a load or store. A register that an instruction reads as the PC is 4 bytes on, and a multiple of 4 as base.
fn go(state: &State, address: Address) -> u32 {
    let register = |number: u32| match number {
        15 => state.registers[15].wrapping_add(4) & !3,
        _ => state.registers[(number & 15) as usize],
    };
    match address.offset {
        Offset::Bytes(bytes) => register(address.base).wrapping_add_signed(bytes),
        Offset::Register(index, shift) => register(address.base).wrapping_add(register(index) << shift),
    }
}
