//! The properties of an instruction that decide its cycles: kind, registers and memory address, by the tables of `instructions.txt`.

use serde::Deserialize;
use std::sync::LazyLock;

/// A set of core registers, a bit each.
pub(crate) type Registers = u32;

/// The number of Thumb's program counter.
const PC: u32 = 15;

/// The rows of the cores' timing tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
pub(crate) enum Kind {
    /// Arithmetic, moves, comparisons, hints.
    Simple,
    Multiply,
    /// `MLA`, `MLS`, and the DSP extension's products that add.
    MultiplyAdd,
    /// `UMULL`, `SMULL`; RISC-V's `mulh`, `mulhu`, `mulhsu`.
    LongMultiply,
    /// `UMLAL`, `SMLAL`, `UMAAL`.
    LongMultiplyAdd,
    Divide,
    Load,
    Store,
    LoadMultiple,
    StoreMultiple,
    LoadDouble,
    StoreDouble,
    /// `B` without a condition, `jal`.
    Branch,
    /// `B` with a condition, `beq` and its like.
    BranchIf,
    /// `CBZ`, `CBNZ`.
    CompareBranch,
    /// `BL`.
    Call,
    /// `BX`, `jalr`.
    BranchTo,
    /// `BLX` with a register.
    CallTo,
    /// `MOV` or `ADD` to the PC.
    WritePc,
    /// `TBB`, `TBH`.
    TableBranch,
    /// `IT`, with the number of instructions that it makes conditional.
    IfThen,
    /// `MRS`, `MSR`, barriers, `CPS`, `SVC`, `BKPT`.
    System,
    /// An instruction of the FPU.
    Float,
}

impl Kind {
    pub(super) fn named(name: &str) -> Option<Self> {
        serde_json::from_value(name.into()).ok()
    }
}

/// The address of a load or store: the sum of two terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Address {
    pub(crate) base: u32,
    pub(crate) offset: Offset,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Offset {
    Bytes(i32),
    /// A register and how far it is shifted to the left.
    Register(u32, u32),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Instruction {
    /// The size in bytes: 2 or 4.
    pub(crate) size: u32,
    pub(crate) kind: Kind,
    /// The registers that it reads, other than `address_registers`.
    pub(crate) reads: Registers,
    pub(crate) address_registers: Registers,
    pub(crate) writes: Registers,
    /// The registers of a multiple load or store, the instructions of an `IT` block; otherwise 0.
    pub(crate) count: u32,
    /// The cycles of an instruction of the FPU, otherwise 0.
    pub(crate) cycles: u32,
    /// A load whose target is the PC.
    pub(crate) loads_pc: bool,
    /// Of a load or store of Thumb.
    pub(crate) address: Option<Address>,
}

/// The encodings of an instruction set, of 16 or 32 bits.
type Encodings = Vec<Encoding>;

struct Encoding {
    bits: &'static str,
    kind: Kind,
    /// Fields that the bits do not have.
    fixed: Vec<(u8, u32)>,
}

pub(super) const TEXT: &str = include_str!("instructions.txt");

/// The first tables of `instructions.txt`: the encodings of Thumb and RISC-V, of 16 and of 32 bits.
static TABLES: LazyLock<[Encodings; 4]> = LazyLock::new(|| {
    let tables: Vec<Encodings> = TEXT.split("\n[").skip(1).take(4).map(table).collect();
    tables.try_into().unwrap_or_else(|_| panic!("instructions.txt: four tables"))
});

fn table(text: &'static str) -> Encodings {
    let lines = text.lines().skip(1).filter(|line| !line.is_empty() && !line.starts_with('#'));
    lines.map(|line| encoding(line).unwrap_or_else(|| panic!("instructions.txt: {line}"))).collect()
}

fn encoding(line: &'static str) -> Option<Encoding> {
    let mut words = line.split(' ');
    let (bits, kind) = (words.next()?, Kind::named(words.next()?)?);
    let fixed = words.map(|field| {
        let (name, value) = field.split_once('=')?;
        Some((*name.as_bytes().first()?, value.parse().ok()?))
    });
    Some(Encoding { bits, kind, fixed: fixed.collect::<Option<_>>()? })
}

impl Instruction {
    /// An instruction of Thumb; its second half counts if the first says that it takes four bytes.
    pub(crate) fn thumb(first: u16, second: u16) -> Self {
        let [narrow, wide, ..] = &*TABLES;
        match first >> 11 {
            0b11101.. => Self::of(wide, 4, u32::from(first) << 16 | u32::from(second), 1 << PC),
            _ => Self::of(narrow, 2, first.into(), 1 << PC),
        }
    }

    /// An instruction of RV32IMC.
    pub(crate) fn riscv(first: u16, second: u16) -> Self {
        let [.., compressed, whole] = &*TABLES;
        match first & 3 {
            3 => Self::of(whole, 4, u32::from(second) << 16 | u32::from(first), 0),
            _ => Self::of(compressed, 2, first.into(), 0),
        }
    }

    /// By the first line that fits; the last one of a table fits everything. A write to one of the `program_counters` is a branch.
    fn of(table: &[Encoding], size: u32, code: u32, program_counters: Registers) -> Self {
        let fits = |encoding: &&Encoding| {
            encoding.bits.bytes().rev().enumerate().all(|(at, bit)| match bit {
                b'0' | b'1' => code >> at & 1 == u32::from(bit - b'0'),
                _ => true,
            })
        };
        let Encoding { bits, kind, fixed } = table.iter().find(fits).expect("a table's last line");
        let field = |letter: u8| {
            let fixed = fixed.iter().find(|field| field.0 == letter).map(|field| field.1);
            let bits = bits.bytes().zip((0..8 * size).rev()).filter(|(bit, _)| *bit == letter);
            bits.fold(fixed, |value, (_, at)| Some(value.unwrap_or(0) << 1 | code >> at & 1))
        };
        let registers = |letters: &str| -> Registers {
            let one =
                |letter: u8| Some(1 << (field(letter)? + if letter.is_ascii_uppercase() { 8 } else { 0 }));
            letters.bytes().filter_map(one).fold(0, |all, one| all | one)
        };
        let is_store = field(b'L') == Some(0) || matches!(kind, Kind::Store | Kind::StoreMultiple);
        let kind = match kind {
            Kind::Load if is_store => Kind::Store,
            Kind::LoadMultiple if is_store => Kind::StoreMultiple,
            Kind::LoadDouble if is_store => Kind::StoreDouble,
            kind => *kind,
        };
        let moved = registers("tur") | field(b'l').unwrap_or(0);
        let count = match kind {
            Kind::LoadDouble | Kind::StoreDouble => 2,
            // The lowest bit that is set ends the mask.
            Kind::IfThen => 4 - field(b'v').unwrap_or(0).trailing_zeros(),
            _ => field(b'c').unwrap_or(if field(b'l').is_some() { moved.count_ones() } else { 0 }),
        };
        let (subtracts, is_indexed) = (field(b'U') == Some(0), field(b'P').is_none_or(|bit| bit == 1));
        let offset = match (field(b'x'), field(b'i')) {
            (Some(index), _) => Offset::Register(index, field(b'h').unwrap_or(0)),
            (None, Some(number)) if is_indexed => {
                let bytes = (number << field(b'k').unwrap_or(0)).cast_signed();
                Offset::Bytes(if subtracts { -bytes } else { bytes })
            }
            // Registers that are stored or loaded downwards.
            (None, None) if field(b'P') == Some(1) => Offset::Bytes(-4 * count.cast_signed()),
            _ => Offset::Bytes(0),
        };
        let (loaded, stored) = if is_store { (0, moved) } else { (moved, 0) };
        let base = if field(b'W') == Some(1) { registers("b") } else { 0 };
        Self {
            size,
            kind,
            reads: registers("nmaegNME") | stored,
            address_registers: registers("bx"),
            writes: (registers("dfegDE") | loaded) & !program_counters | base,
            count,
            cycles: field(b'y').map_or(0, |cycles| cycles + field(b'c').unwrap_or(0)),
            loads_pc: matches!(kind, Kind::Load | Kind::LoadMultiple) && loaded & program_counters != 0,
            address: field(b'b')
                .filter(|_| !is_store || kind == Kind::Store)
                .map(|base| Address { base, offset }),
        }
    }
}
