//! The properties of a Thumb instruction that decide its cycles: kind, registers and memory address. Encodings: Arm, *ARMv7-M
//! Architecture Reference Manual* (DDI 0403), chapter A5.

/// A set of the sixteen core registers, a bit each.
pub(crate) type Registers = u16;

pub(crate) const SP: u32 = 13;
pub(crate) const PC: u32 = 15;

pub(crate) const fn register(number: u32) -> Registers {
    1 << (number & 15)
}

/// The rows of the cores' timing tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Arithmetic, moves, comparisons, hints.
    Simple,
    Multiply,
    /// `MLA`, `MLS`, and the DSP extension's products that add.
    MultiplyAdd,
    /// `UMULL`, `SMULL`.
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
    /// `B` without a condition.
    Branch,
    /// `B` with a condition.
    BranchIf,
    /// `CBZ`, `CBNZ`.
    CompareBranch,
    /// `BL`.
    Call,
    /// `BX`.
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
    /// An instruction of the FPU, with the cycles of the M4's table.
    Float(u32),
}

/// The address of a load or store: the sum of two terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Address {
    pub(crate) base: u32,
    pub(crate) offset: Offset,
    /// Bytes that are added to the address.
    pub(crate) bytes: u32,
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
    pub(crate) address: Option<Address>,
}

const fn simple(size: u32) -> Instruction {
    Instruction {
        size,
        kind: Kind::Simple,
        reads: 0,
        address_registers: 0,
        writes: 0,
        count: 0,
        loads_pc: false,
        address: None,
    }
}

/// Bits `from..from + count`.
const fn bits(half: u16, from: u32, count: u32) -> u32 {
    (half as u32 >> from) & ((1 << count) - 1)
}

/// Whether a first half starts an instruction of four bytes.
pub(crate) const fn is_wide(first: u16) -> bool {
    bits(first, 11, 5) >= 0b11101
}

impl Instruction {
    /// Decodes an instruction; the second half is used only if [`is_wide`] is true.
    pub(crate) fn decode(first: u16, second: u16) -> Self {
        match is_wide(first) {
            true => wide(first, second),
            false => narrow(first),
        }
    }

    /// A load or store of one register, whose condition is that of a plain `LDR` or `STR`.
    fn single(self, load: bool, target: u32, address: Address) -> Self {
        let index = match address.offset {
            Offset::Register(index, _) => register(index),
            Offset::Bytes(_) => 0,
        };
        Self {
            kind: if load { Kind::Load } else { Kind::Store },
            loads_pc: load && target == PC,
            reads: if load { 0 } else { register(target) },
            writes: self.writes | if load && target != PC { register(target) } else { 0 },
            address_registers: register(address.base) | index,
            address: Some(address),
            ..self
        }
    }

    /// `list` has a bit for each register; the base is written back if `back` says so.
    fn multiple(self, load: bool, base: u32, list: u16, back: bool, down: bool) -> Self {
        let count = list.count_ones();
        let offset = if down { -4 * count.cast_signed() } else { 0 };
        let loaded = if load { list & !register(PC) } else { 0 };
        Self {
            kind: if load { Kind::LoadMultiple } else { Kind::StoreMultiple },
            count,
            loads_pc: load && list & register(PC) != 0,
            reads: if load { 0 } else { list },
            writes: loaded | if back { register(base) } else { 0 },
            address_registers: register(base),
            address: Some(Address { base, offset: Offset::Bytes(offset), bytes: 4 * count }),
            ..self
        }
    }

    fn kind(self, kind: Kind) -> Self {
        Self { kind, ..self }
    }

    fn reads(self, registers: Registers) -> Self {
        Self { reads: registers, ..self }
    }

    fn writes(self, number: u32) -> Self {
        Self { writes: register(number), ..self }
    }
}

/// The bytes of a load or store by the two bits of its size.
const fn bytes(size: u32) -> u32 {
    1 << size
}

/// DDI 0403, A5.2.
fn narrow(half: u16) -> Instruction {
    let [low, middle, upper, high] = [0, 3, 6, 8].map(|from| bits(half, from, 3));
    let new = simple(2);
    match bits(half, 10, 6) {
        // Shifts by a constant, additions and subtractions.
        0b000000..=0b000101 => new.reads(register(middle)).writes(low),
        0b000110 => new.reads(register(middle) | register(upper)).writes(low),
        0b000111 => new.reads(register(middle)).writes(low),
        // MOV, CMP, ADD, SUB with eight bits.
        0b001000 | 0b001001 => new.writes(high),
        0b001010 | 0b001011 => new.reads(register(high)),
        0b001100..=0b001111 => new.reads(register(high)).writes(high),
        0b010000 => data_processing(half),
        0b010001 => special(half),
        0b010010 | 0b010011 => {
            let offset = Offset::Bytes(4 * bits(half, 0, 8).cast_signed());
            new.single(true, high, Address { base: PC, offset, bytes: 4 })
        }
        0b010100..=0b010111 => {
            // STR, STRH, STRB, LDRSB, LDR, LDRH, LDRB, LDRSH.
            let operation = bits(half, 9, 3);
            let size = [2, 1, 0, 0, 2, 1, 0, 1][operation as usize & 7];
            let address = Address { base: middle, offset: Offset::Register(upper, 0), bytes: bytes(size) };
            new.single(operation >= 3, low, address)
        }
        0b011000..=0b100011 => {
            let size = match bits(half, 12, 4) {
                0b0110 => 2,
                0b0111 => 0,
                _ => 1,
            };
            let offset = Offset::Bytes((bits(half, 6, 5) << size).cast_signed());
            new.single(bits(half, 11, 1) == 1, low, Address { base: middle, offset, bytes: bytes(size) })
        }
        0b100100..=0b100111 => {
            let offset = Offset::Bytes(4 * bits(half, 0, 8).cast_signed());
            new.single(bits(half, 11, 1) == 1, high, Address { base: SP, offset, bytes: 4 })
        }
        0b101000 | 0b101001 => new.reads(register(PC)).writes(high),
        0b101010 | 0b101011 => new.reads(register(SP)).writes(high),
        0b101100..=0b101111 => miscellaneous(half),
        // STM, LDM. A load writes its base back unless it loads it.
        0b110000 | 0b110001 => new.multiple(false, high, half & 0xff, true, false),
        0b110010 | 0b110011 => new.multiple(true, high, half & 0xff, true, false),
        0b110100..=0b110111 => match bits(half, 8, 4) {
            0b1110 | 0b1111 => new.kind(Kind::System),
            _ => new.kind(Kind::BranchIf),
        },
        _ => new.kind(Kind::Branch),
    }
}

fn data_processing(half: u16) -> Instruction {
    let (low, middle) = (bits(half, 0, 3), bits(half, 3, 3));
    let new = simple(2).reads(register(low) | register(middle));
    match bits(half, 6, 4) {
        // TST, CMP, CMN.
        0b1000 | 0b1010 | 0b1011 => new,
        // RSB, MVN.
        0b1001 | 0b1111 => new.reads(register(middle)).writes(low),
        0b1101 => new.kind(Kind::Multiply).writes(low),
        _ => new.writes(low),
    }
}

/// ADD, CMP, MOV of all registers, BX, BLX.
fn special(half: u16) -> Instruction {
    let (to, from) = (bits(half, 0, 3) | bits(half, 7, 1) << 3, bits(half, 3, 4));
    let new = simple(2);
    match bits(half, 8, 2) {
        0b00 if to == PC => new.kind(Kind::WritePc).reads(register(from)),
        0b00 => new.reads(register(from) | register(to)).writes(to),
        0b01 => new.reads(register(from) | register(to)),
        0b10 if to == PC => new.kind(Kind::WritePc).reads(register(from)),
        0b10 => new.reads(register(from)).writes(to),
        _ if bits(half, 7, 1) == 1 => new.kind(Kind::CallTo).reads(register(from)),
        _ => new.kind(Kind::BranchTo).reads(register(from)),
    }
}

fn miscellaneous(half: u16) -> Instruction {
    let (low, middle) = (bits(half, 0, 3), bits(half, 3, 3));
    let new = simple(2);
    match bits(half, 8, 4) {
        0b0000 => new.reads(register(SP)).writes(SP),
        0b0001 | 0b0011 | 0b1001 | 0b1011 => new.kind(Kind::CompareBranch).reads(register(low)),
        0b0010 | 0b1010 => new.reads(register(middle)).writes(low),
        // PUSH, with the link register; POP, with the PC.
        0b0100 | 0b0101 => {
            let list = half & 0xff | if bits(half, 8, 1) == 1 { register(14) } else { 0 };
            new.multiple(false, SP, list, true, true)
        }
        0b1100 | 0b1101 => {
            let list = half & 0xff | if bits(half, 8, 1) == 1 { register(PC) } else { 0 };
            new.multiple(true, SP, list, true, false)
        }
        0b1111 if half & 0xf != 0 => {
            // The lowest bit that is set ends the mask.
            Instruction { kind: Kind::IfThen, count: 4 - (half & 0xf).trailing_zeros(), ..new }
        }
        0b1111 => new,
        _ => new.kind(Kind::System),
    }
}

/// DDI 0403, A5.3.
fn wide(first: u16, second: u16) -> Instruction {
    let (n, d, t, m) = (bits(first, 0, 4), bits(second, 8, 4), bits(second, 12, 4), bits(second, 0, 4));
    let new = simple(4);
    let write = |to: u32| if to == PC { 0 } else { register(to) };
    if bits(first, 10, 1) == 1 && bits(first, 11, 5) != 0b11110 {
        return float(first, second);
    }
    match bits(first, 9, 7) {
        0b1110100 if bits(first, 6, 1) == 0 => {
            let (load, back, down) = (bits(first, 4, 1) == 1, bits(first, 5, 1) == 1, bits(first, 8, 1) == 1);
            new.multiple(load, n, second, back, down)
        }
        0b1110100 => double(first, second),
        // Data processing, with a register or a constant.
        0b1110101 => Instruction { reads: register(n) | register(m), writes: write(d), ..new },
        0b1111000..=0b1111011 if bits(second, 15, 1) == 0 => {
            // MOVW and MOVT have part of their constant where others have a register.
            let reads = match bits(first, 4, 6) {
                0b100100 => 0,
                0b101100 => register(d),
                _ => register(n),
            };
            Instruction { reads, writes: write(d), ..new }
        }
        0b1111000..=0b1111011 => match (bits(second, 14, 1), bits(second, 12, 1)) {
            (1, _) => new.kind(Kind::Call),
            (0, 1) => new.kind(Kind::Branch),
            _ if bits(first, 7, 3) == 0b111 => new.kind(Kind::System),
            _ => new.kind(Kind::BranchIf),
        },
        0b1111100 => single(first, second),
        0b1111101 if bits(first, 8, 1) == 0 => {
            Instruction { reads: register(n) | register(m), writes: write(d), ..new }
        }
        0b1111101 if bits(first, 7, 1) == 0 => {
            let (kind, added) = if t == PC { (Kind::Multiply, 0) } else { (Kind::MultiplyAdd, register(t)) };
            Instruction { kind, reads: register(n) | register(m) | added, writes: write(d), ..new }
        }
        0b1111101 => {
            let (both, inputs) = (register(t) | register(d), register(n) | register(m));
            match bits(first, 4, 3) {
                0b001 | 0b011 => new.kind(Kind::Divide).reads(inputs).writes(d),
                0b000 | 0b010 => Instruction { writes: both, ..new.kind(Kind::LongMultiply).reads(inputs) },
                _ => Instruction { writes: both, ..new.kind(Kind::LongMultiplyAdd).reads(inputs | both) },
            }
        }
        _ => new.kind(Kind::System),
    }
}

/// Two words, exclusive accesses, table branches.
fn double(first: u16, second: u16) -> Instruction {
    let (n, d, t, m) = (bits(first, 0, 4), bits(second, 8, 4), bits(second, 12, 4), bits(second, 0, 4));
    let (load, new) = (bits(first, 4, 1) == 1, simple(4));
    let (indexed, back) = (bits(first, 8, 1) == 1, bits(first, 5, 1) == 1);
    let offset = 4 * bits(second, 0, 8).cast_signed();
    if indexed || back {
        let signed = if bits(first, 7, 1) == 1 { offset } else { -offset };
        let both = register(t) | register(d);
        return Instruction {
            kind: if load { Kind::LoadDouble } else { Kind::StoreDouble },
            count: 2,
            reads: if load { 0 } else { both },
            writes: if load { both } else { 0 } | if back { register(n) } else { 0 },
            address_registers: register(n),
            address: Some(Address {
                base: n,
                offset: Offset::Bytes(if indexed { signed } else { 0 }),
                bytes: 8,
            }),
            ..new
        };
    }
    match (bits(first, 7, 1), bits(second, 4, 4)) {
        (1, halves @ (0b0000 | 0b0001)) if load => Instruction {
            address_registers: register(n) | register(m),
            address: Some(Address { base: n, offset: Offset::Register(m, halves), bytes: bytes(halves) }),
            ..new.kind(Kind::TableBranch)
        },
        _ if load => new.single(true, t, Address { base: n, offset: Offset::Bytes(0), bytes: 4 }),
        _ => {
            let stored = new.single(false, t, Address { base: n, offset: Offset::Bytes(0), bytes: 4 });
            Instruction { writes: register(if bits(first, 7, 1) == 1 { m } else { d }), ..stored }
        }
    }
}

/// Loads and stores of a byte, a half or a word.
fn single(first: u16, second: u16) -> Instruction {
    let (n, t, m) = (bits(first, 0, 4), bits(second, 12, 4), bits(second, 0, 4));
    let (load, size) = (bits(first, 4, 1) == 1, bits(first, 5, 2));
    // Hints to preload look like loads of a byte or a half to the PC.
    if load && t == PC && size != 2 {
        return simple(4);
    }
    let (twelve, eight) = (bits(second, 0, 12).cast_signed(), bits(second, 0, 8).cast_signed());
    let up = |offset: i32, up: u32| if up == 1 { offset } else { -offset };
    let (offset, back) = if n == PC {
        (Offset::Bytes(up(twelve, bits(first, 7, 1))), false)
    } else if bits(first, 7, 1) == 1 {
        (Offset::Bytes(twelve), false)
    } else if bits(second, 11, 1) == 0 {
        (Offset::Register(m, bits(second, 4, 2)), false)
    } else {
        // Before or after: an address that is written back.
        let indexed = bits(second, 10, 1) == 1;
        (Offset::Bytes(if indexed { up(eight, bits(second, 9, 1)) } else { 0 }), bits(second, 8, 1) == 1)
    };
    let new = Instruction { writes: if back { register(n) } else { 0 }, ..simple(4) };
    new.single(load, t, Address { base: n, offset, bytes: bytes(size) })
}

/// The single-precision FPU, by the M4's table (DDI 0439, 7.2.3): loads and stores of N registers take 1 + N, a division or root
/// 14, a product that adds 3, everything else 1. Registers of the FPU are not followed.
fn float(first: u16, second: u16) -> Instruction {
    let new = simple(4);
    let base = bits(first, 0, 4);
    let (load, words) = (bits(first, 4, 1) == 1, bits(second, 0, 8));
    if bits(first, 9, 1) == 0 {
        // Two core registers to or from the FPU.
        if bits(first, 5, 4) == 0b0010 {
            let both = register(base) | register(bits(second, 12, 4));
            return match load {
                true => Instruction { writes: both, ..new.kind(Kind::Float(2)) },
                false => new.kind(Kind::Float(2)).reads(both),
            };
        }
        let (down, back) = (bits(first, 8, 1) == 1, bits(first, 5, 1) == 1);
        // A single one has no list: the number is its offset in words.
        let single = down && !back;
        let count = if !single {
            words
        } else if bits(second, 8, 1) == 1 {
            2
        } else {
            1
        };
        let signed = if bits(first, 7, 1) == 1 { 4 } else { -4 } * words.cast_signed();
        let offset = if single || down { signed } else { 0 };
        return Instruction {
            kind: Kind::Float(1 + count),
            writes: if back { register(base) } else { 0 },
            address_registers: register(base),
            address: load.then_some(Address { base, offset: Offset::Bytes(offset), bytes: 4 * count }),
            ..new
        };
    }
    if bits(second, 4, 1) == 1 {
        // A core register to or from the FPU.
        let core = register(bits(second, 12, 4));
        return match load {
            true if bits(second, 12, 4) != PC => Instruction { writes: core, ..new.kind(Kind::Float(1)) },
            true => new.kind(Kind::Float(1)),
            false => new.kind(Kind::Float(1)).reads(core),
        };
    }
    let (operation, root) = (bits(first, 4, 4), bits(first, 0, 4) == 1 && bits(second, 6, 2) == 0b11);
    // Bit 2 belongs to the number of the target.
    new.kind(Kind::Float(match operation & 0b1011 {
        0b1011 if root => 14,
        0b1000 => 14,
        0b0000 | 0b0001 | 0b1001 | 0b1010 => 3,
        _ => 1,
    }))
}
