//! The properties of an instruction that decide its cycles: kind, registers and memory address. The tables have the encodings of
//! Thumb (Arm, *ARMv7-M Architecture Reference Manual*, DDI 0403, chapter A5) and of RV32IMC (*The RISC-V Instruction Set Manual*,
//! volume I, chapters 2, 7 and 16).

/// A set of core registers, a bit each.
pub(crate) type Registers = u32;

const SP: u32 = 13;
const LR: u32 = 14;
pub(crate) const PC: u32 = 15;
/// RISC-V's registers for return addresses and the stack.
const RA: u32 = 1;
const X2: u32 = 2;

/// The rows of the cores' timing tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// An instruction of the FPU, with the cycles of the M4's table, and one more for each word that it loads or stores.
    Float(u32),
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
    /// A load whose target is the PC.
    pub(crate) loads_pc: bool,
    /// Of a load or store of Thumb.
    pub(crate) address: Option<Address>,
}

/// An encoding: its bits, the highest first, the kind of the instruction (with `L`: if that bit is set, otherwise a store), and
/// fields that it does not have.
///
/// Bits with the same letter are a field: the registers `n`, `m` and `a` are read, `d` and `f` written, `e` and `g` both, and `t` and
/// `u` loaded or stored; capitals are RISC-V's, which count from register 8. An address is register `b` and register `x` shifted by
/// `h`, or plus `i` shifted by `k` bits, which bit `U` subtracts if it is 0, and which is not added where `P` is 0; if `W` is 1, `b` is written.
/// `l` is a list of registers, to which `r` belongs, stored downwards if `P` is 1; `c` are words, and `v` is the mask of `IT`.
type Row = (&'static str, Kind, &'static [(u8, u32)]);

use Kind::{
    Branch, BranchIf, BranchTo, Call, CallTo, CompareBranch, Divide, Float, IfThen, Load, LoadDouble,
    LoadMultiple, LongMultiply, LongMultiplyAdd, Multiply, MultiplyAdd, Simple, Store, StoreDouble,
    StoreMultiple, System, TableBranch, WritePc,
};

/// Thumb's encodings of 16 bits; the first row that fits counts.
const NARROW: &[Row] = &[
    ("000110.mmmnnnddd", Simple, &[]),
    ("000.......nnnddd", Simple, &[]),
    ("00100ddd........", Simple, &[]),
    ("00101nnn........", Simple, &[]),
    ("0011.eee........", Simple, &[]),
    // TST, CMP, CMN; RSB, MVN; MUL.
    ("0100001000mmmnnn", Simple, &[]),
    ("010000101.mmmnnn", Simple, &[]),
    ("0100001001mmmddd", Simple, &[]),
    ("0100001111mmmddd", Simple, &[]),
    ("0100001101mmmeee", Multiply, &[]),
    ("010000....mmmeee", Simple, &[]),
    // ADD, CMP, MOV of all registers; BLX, BX.
    ("010001001mmmm111", WritePc, &[]),
    ("01000100emmmmeee", Simple, &[]),
    ("01000101nmmmmnnn", Simple, &[]),
    ("010001101mmmm111", WritePc, &[]),
    ("01000110dmmmmddd", Simple, &[]),
    ("010001111mmmm...", CallTo, &[]),
    ("010001110mmmm...", BranchTo, &[]),
    ("01001tttiiiiiiii", Load, &[(b'b', PC), (b'k', 2)]),
    ("0101011xxxbbbttt", Load, &[]),
    ("01011..xxxbbbttt", Load, &[]),
    ("0101...xxxbbbttt", Store, &[]),
    ("0110Liiiiibbbttt", Load, &[(b'k', 2)]),
    ("0111Liiiiibbbttt", Load, &[]),
    ("1000Liiiiibbbttt", Load, &[(b'k', 1)]),
    ("1001Ltttiiiiiiii", Load, &[(b'b', SP), (b'k', 2)]),
    ("10100ddd........", Simple, &[(b'n', PC)]),
    ("10101ddd........", Simple, &[(b'n', SP)]),
    ("10110000........", Simple, &[(b'e', SP)]),
    ("1011.0.1.....nnn", CompareBranch, &[]),
    ("1011.010..mmmddd", Simple, &[]),
    // PUSH, with the link register; POP, with the PC.
    ("10110101llllllll", StoreMultiple, &[(b'b', SP), (b'r', LR), (b'W', 1), (b'P', 1)]),
    ("10110100llllllll", StoreMultiple, &[(b'b', SP), (b'W', 1), (b'P', 1)]),
    ("10111101llllllll", LoadMultiple, &[(b'b', SP), (b'r', PC), (b'W', 1)]),
    ("10111100llllllll", LoadMultiple, &[(b'b', SP), (b'W', 1)]),
    ("10111111....0000", Simple, &[]),
    ("10111111....vvvv", IfThen, &[]),
    ("1011............", System, &[]),
    ("1100Lbbbllllllll", LoadMultiple, &[(b'W', 1)]),
    ("1101111.........", System, &[]),
    ("1101............", BranchIf, &[]),
    ("................", Branch, &[]),
];

/// Thumb's encodings of 32 bits.
const WIDE: &[Row] = &[
    // The single-precision FPU, by the M4's table (DDI 0439, 7.2.3). Its registers are not followed.
    ("111.1100010Lttttuuuu............", Float(2), &[]),
    ("111.1101U.0Lbbbb.......0iiiiiiii", Float(1), &[(b'k', 2), (b'c', 1)]),
    ("111.1101U.0Lbbbb.......1iiiiiiii", Float(1), &[(b'k', 2), (b'c', 2)]),
    ("111.110P..WLbbbb........cccccccc", Float(1), &[]),
    ("111.111....1....1111.......1....", Float(1), &[]),
    ("111.111....L....tttt.......1....", Float(1), &[]),
    ("111.111.1.110001........11......", Float(14), &[]),
    ("111.111.1.00....................", Float(14), &[]),
    ("111.111.0.0.....................", Float(3), &[]),
    ("111.111.1.01....................", Float(3), &[]),
    ("111.111.1.10....................", Float(3), &[]),
    ("111.111.........................", Float(1), &[]),
    ("1110100P.0WLbbbbllllllllllllllll", LoadMultiple, &[]),
    // Two words, table branches, exclusive accesses.
    ("11101001U1WLbbbbttttuuuuiiiiiiii", LoadDouble, &[(b'k', 2)]),
    ("11101000.11Lbbbbttttuuuu........", LoadDouble, &[(b'W', 1)]),
    ("111010001101bbbb........000hxxxx", TableBranch, &[]),
    ("11101000.101bbbbtttt............", Load, &[]),
    ("111010000100bbbbttttdddd........", Store, &[]),
    ("111010001100bbbbtttt........dddd", Store, &[]),
    ("1110101.....nnnn....dddd....mmmm", Simple, &[]),
    // MOVW and MOVT have part of their constant where others have a register.
    ("11110.100100....0...dddd........", Simple, &[]),
    ("11110.101100....0...eeee........", Simple, &[]),
    ("11110.......nnnn0...dddd........", Simple, &[]),
    ("11110...........11..............", Call, &[]),
    ("11110...........10.1............", Branch, &[]),
    ("11110.111.......10.0............", System, &[]),
    ("11110...........10.0............", BranchIf, &[]),
    // Hints to preload look like loads of a byte or a half to the PC.
    ("1111100..0.1....1111............", Simple, &[]),
    ("1111100..111....1111............", Simple, &[]),
    ("1111100.U..L1111ttttiiiiiiiiiiii", Load, &[(b'b', PC)]),
    ("1111100.1..Lbbbbttttiiiiiiiiiiii", Load, &[]),
    ("1111100.0..Lbbbbtttt0.....hhxxxx", Load, &[]),
    ("1111100.0..Lbbbbtttt1PUWiiiiiiii", Load, &[]),
    ("11111010....nnnn....dddd....mmmm", Simple, &[]),
    ("111110110...nnnn1111dddd....mmmm", Multiply, &[]),
    ("111110110...nnnnaaaadddd....mmmm", MultiplyAdd, &[]),
    ("1111101110.1nnnn....dddd....mmmm", Divide, &[]),
    ("1111101110.0nnnnddddffff....mmmm", LongMultiply, &[]),
    ("111110111...nnnneeeegggg....mmmm", LongMultiplyAdd, &[]),
    ("................................", System, &[]),
];

/// RISC-V's encodings of 16 bits.
const COMPRESSED: &[Row] = &[
    // `c.addi4spn`, `c.lw`, `c.sw`.
    ("000........DDD00", Simple, &[(b'n', X2)]),
    ("010...NNN..DDD00", Load, &[]),
    ("110...NNN..MMM00", Store, &[]),
    // `c.addi`, `c.jal`, `c.li`, `c.addi16sp`, `c.lui`.
    ("000.eeeee.....01", Simple, &[]),
    ("001...........01", Branch, &[(b'd', RA)]),
    ("010.ddddd.....01", Simple, &[]),
    ("011.00010.....01", Simple, &[(b'e', X2)]),
    ("011.ddddd.....01", Simple, &[]),
    ("100.11EEE..MMM01", Simple, &[]),
    ("100...EEE.....01", Simple, &[]),
    ("101...........01", Branch, &[]),
    ("11....NNN.....01", BranchIf, &[]),
    // `c.slli`, `c.lwsp`, `c.swsp`.
    ("000.eeeee.....10", Simple, &[]),
    ("010.ddddd.....10", Load, &[(b'n', X2)]),
    ("110......mmmmm10", Store, &[(b'n', X2)]),
    // `c.ebreak`, `c.jr`, `c.jalr`, `c.mv`, `c.add`.
    ("100.00000.....10", Simple, &[]),
    ("1000nnnnn0000010", BranchTo, &[]),
    ("1001nnnnn0000010", BranchTo, &[(b'd', RA)]),
    ("1000dddddmmmmm10", Simple, &[]),
    ("1001eeeeemmmmm10", Simple, &[]),
    ("................", Simple, &[]),
];

/// RISC-V's encodings of 32 bits.
const RV32IM: &[Row] = &[
    ("............nnnnn...ddddd0000011", Load, &[]),
    (".......mmmmmnnnnn........0100011", Store, &[]),
    (".......mmmmmnnnnn........1100011", BranchIf, &[]),
    ("....................ddddd1101111", Branch, &[]),
    ("............nnnnn...ddddd1100111", BranchTo, &[]),
    ("0000001mmmmmnnnnn000ddddd0110011", Multiply, &[]),
    ("0000001mmmmmnnnnn001ddddd0110011", LongMultiply, &[]),
    ("0000001mmmmmnnnnn01.ddddd0110011", LongMultiply, &[]),
    ("0000001mmmmmnnnnn1..ddddd0110011", Divide, &[]),
    (".......mmmmmnnnnn...ddddd0110011", Simple, &[]),
    // `lui`, `auipc`.
    ("....................ddddd0.10111", Simple, &[]),
    ("............nnnnn...ddddd.......", Simple, &[]),
];

impl Instruction {
    /// An instruction of Thumb; its second half counts if the first says that it takes four bytes.
    pub(crate) fn thumb(first: u16, second: u16) -> Self {
        match first >> 11 {
            0b11101.. => Self::of(WIDE, 4, u32::from(first) << 16 | u32::from(second), 1 << PC),
            _ => Self::of(NARROW, 2, first.into(), 1 << PC),
        }
    }

    /// An instruction of RV32IMC.
    pub(crate) fn riscv(first: u16, second: u16) -> Self {
        match first & 3 {
            3 => Self::of(RV32IM, 4, u32::from(second) << 16 | u32::from(first), 0),
            _ => Self::of(COMPRESSED, 2, first.into(), 0),
        }
    }

    /// By the first row that fits; the last one of a table fits everything. A write to one of the `program_counters` is a branch.
    fn of(table: &[Row], size: u32, code: u32, program_counters: Registers) -> Self {
        let fits = |(encoding, ..): &&Row| {
            encoding.bytes().rev().enumerate().all(|(at, bit)| match bit {
                b'0' | b'1' => code >> at & 1 == u32::from(bit - b'0'),
                _ => true,
            })
        };
        let (encoding, kind, fixed) = table.iter().find(fits).expect("a table's last row");
        let field = |letter: u8| {
            let fixed = fixed.iter().find(|field| field.0 == letter).map(|field| field.1);
            let bits = encoding.bytes().zip((0..8 * size).rev()).filter(|(bit, _)| *bit == letter);
            bits.fold(fixed, |value, (_, at)| Some(value.unwrap_or(0) << 1 | code >> at & 1))
        };
        let registers = |letters: &str| -> Registers {
            let one =
                |letter: u8| Some(1 << (field(letter)? + if letter.is_ascii_uppercase() { 8 } else { 0 }));
            letters.bytes().filter_map(one).fold(0, |all, one| all | one)
        };
        let is_store = field(b'L') == Some(0) || matches!(kind, Store | StoreMultiple);
        let kind = match kind {
            Load if is_store => Store,
            LoadMultiple if is_store => StoreMultiple,
            LoadDouble if is_store => StoreDouble,
            Float(cycles) => Float(cycles + field(b'c').unwrap_or(0)),
            kind => *kind,
        };
        let moved = registers("tur") | field(b'l').unwrap_or(0);
        let count = match kind {
            LoadDouble | StoreDouble => 2,
            // The lowest bit that is set ends the mask.
            IfThen => 4 - field(b'v').unwrap_or(0).trailing_zeros(),
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
            loads_pc: matches!(kind, Load | LoadMultiple) && loaded & program_counters != 0,
            address: field(b'b').filter(|_| !is_store || kind == Store).map(|base| Address { base, offset }),
        }
    }
}
