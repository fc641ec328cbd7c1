//! Short sequences. The expected cycles are added up by hand from the tables of Arm's manuals; the encodings are an assembler's.

use super::decode::{is_wide, Address, Instruction, Kind, Offset};
use super::flash::{DataCache, Flash, FlashRules};
use super::pipeline::{Cycles, Pipeline, Step};
use super::program::{Conditions, Executed, Program, State};

const LDR_R0_R1: u32 = 0x6808;
const LDR_R2_R3: u32 = 0x681a;
const LDR_R2_R0: u32 = 0x6802;
const STR_R0_R1_4: u32 = 0x6048;
const STR_R0_R1_R2: u32 = 0x5088;
const MULS: u32 = 0x4348;
const MLA: u32 = 0xfb01_3002;
const UMULL: u32 = 0xfba2_0103;
const SMLAL: u32 = 0xfbc2_0103;
const UDIV: u32 = 0xfbb1_f0f2;
const PUSH_R4_R7_LR: u32 = 0xb5f0;
const POP_R4_R7_PC: u32 = 0xbdf0;
const LDM_R1_4: u32 = 0xc93c;
const STM_R0_4: u32 = 0xc03c;
const SUBS_R0_1: u32 = 0x3801;
/// To the instruction before it.
const BNE: u32 = 0xd1fd;
const BX_LR: u32 = 0x4770;
const BLX_R3: u32 = 0x4798;
const BL: u32 = 0xf000_f832;
const CMP_R0_0: u32 = 0x2800;
const IT_EQ: u32 = 0xbf08;
const MOVS_R1_1: u32 = 0x2101;
const ADD_R0_R1_R2: u32 = 0xeb01_0002;
const ADDS_R1_1: u32 = 0x1c49;
const LDRD: u32 = 0xe9d2_0102;
const DSB: u32 = 0xf3bf_8f4f;

fn decoded(code: u32) -> Instruction {
    match u16::try_from(code) {
        Ok(half) => Instruction::decode(half, 0),
        Err(_) => Instruction::decode((code >> 16) as u16, code as u16),
    }
}

/// The cycles of each, where no branch is taken.
fn straight(pipeline: Pipeline, codes: &[u32]) -> Vec<u32> {
    let mut cycles = Cycles::new(pipeline);
    let step = |code: &u32| {
        cycles.step(Step {
            instruction: &decoded(*code),
            taken: false,
            next_unaligned: false,
            skipped: false,
        })
    };
    codes.iter().map(step).collect()
}

/// The cycles of one that goes elsewhere.
fn taken(pipeline: Pipeline, code: u32, next_unaligned: bool) -> u32 {
    let instruction = &decoded(code);
    Cycles::new(pipeline).step(Step { instruction, taken: true, next_unaligned, skipped: false })
}

const ALL: [Pipeline; 5] = [Pipeline::M0, Pipeline::M0Plus, Pipeline::M3, Pipeline::M4, Pipeline::M33];

#[test]
fn small_cores_take_two_cycles_for_memory_and_one_for_the_rest() {
    for pipeline in [Pipeline::M0, Pipeline::M0Plus] {
        let codes =
            [LDR_R0_R1, LDR_R2_R3, STR_R0_R1_R2, MULS, SUBS_R0_1, LDM_R1_4, STM_R0_4, PUSH_R4_R7_LR, BNE];
        assert_eq!(straight(pipeline, &codes), [2, 2, 2, 1, 1, 5, 5, 6, 1]);
    }
}

#[test]
fn branches_refill_the_pipeline() {
    // Of M0, M0+, M3, M4 and the guess for the M33.
    let of_all = |code| ALL.map(|pipeline| taken(pipeline, code, false));
    assert_eq!(of_all(BNE), [3, 2, 2, 2, 2]);
    assert_eq!(of_all(BL), [4, 3, 2, 2, 2]);
    assert_eq!(of_all(BX_LR), [3, 2, 3, 3, 3]);
    assert_eq!(of_all(BLX_R3), [3, 2, 3, 3, 3]);
    // Five registers, the PC among them.
    assert_eq!(of_all(POP_R4_R7_PC), [9, 8, 9, 9, 8]);
    // Two fetches for a target of four bytes across a word's border.
    assert_eq!([Pipeline::M0, Pipeline::M3, Pipeline::M4].map(|core| taken(core, BNE, true)), [3, 3, 3]);
}

#[test]
fn loads_overlap_unless_they_depend_on_each_other() {
    for pipeline in [Pipeline::M3, Pipeline::M4] {
        assert_eq!(straight(pipeline, &[LDR_R0_R1, LDR_R2_R3]), [2, 1]);
        assert_eq!(straight(pipeline, &[LDR_R0_R1, LDR_R2_R0]), [2, 2]);
        assert_eq!(straight(pipeline, &[LDR_R0_R1, SUBS_R0_1, LDR_R2_R3]), [2, 1, 2]);
    }
}

#[test]
fn a_store_with_a_constant_offset_takes_one_cycle() {
    for pipeline in [Pipeline::M3, Pipeline::M4] {
        assert_eq!(straight(pipeline, &[STR_R0_R1_4, STR_R0_R1_4]), [1, 1]);
        assert_eq!(straight(pipeline, &[STR_R0_R1_R2]), [2]);
        // The index comes with a load that it does not depend on.
        assert_eq!(straight(pipeline, &[LDR_R0_R1 + 5, STR_R0_R1_R2]), [2, 1]);
    }
}

#[test]
fn products_and_divisions_take_what_the_table_says() {
    let codes = [MULS, MLA, UMULL, SMLAL, UDIV];
    assert_eq!(straight(Pipeline::M3, &codes), [1, 2, 5, 7, 7]);
    assert_eq!(straight(Pipeline::M4, &codes), [1, 1, 1, 1, 7]);
}

#[test]
fn an_it_is_free_behind_a_short_instruction() {
    for pipeline in [Pipeline::M3, Pipeline::M4] {
        assert_eq!(straight(pipeline, &[CMP_R0_0, IT_EQ, MOVS_R1_1]), [1, 0, 1]);
        assert_eq!(straight(pipeline, &[ADD_R0_R1_R2, IT_EQ, MOVS_R1_1]), [1, 1, 1]);
    }
}

#[test]
fn multiple_accesses_take_one_more_than_their_registers() {
    for pipeline in [Pipeline::M3, Pipeline::M4] {
        assert_eq!(straight(pipeline, &[LDM_R1_4, STM_R0_4, PUSH_R4_R7_LR, LDRD]), [5, 5, 6, 3]);
    }
}

#[test]
fn barriers_wait() {
    assert_eq!(ALL.map(|pipeline| straight(pipeline, &[DSB])[0]), [4, 3, 2, 2, 2]);
}

#[test]
fn the_guess_for_the_m33_joins_short_instructions_and_waits_for_loads() {
    assert_eq!(straight(Pipeline::M33, &[MOVS_R1_1, SUBS_R0_1, MOVS_R1_1, SUBS_R0_1]), [1, 0, 1, 0]);
    // The second depends on the first.
    assert_eq!(straight(Pipeline::M33, &[MOVS_R1_1, ADDS_R1_1]), [1, 1]);
    assert_eq!(straight(Pipeline::M33, &[LDR_R0_R1, SUBS_R0_1]), [1, 2]);
}

#[test]
fn the_fpu_takes_what_the_m4s_table_says() {
    // VLDR, VPUSH of two doubles, VMOV to a core register, VDIV, VSQRT, VMLA, VFMA, VADD.
    let codes = [
        0xed91_0a01,
        0xed2d_8b04,
        0xee10_0a90,
        0xee80_0a81,
        0xeeb1_0ae0,
        0xee00_0a81,
        0xeea0_0a81,
        0xee30_0a81,
    ];
    assert_eq!(straight(Pipeline::M4, &codes), [2, 5, 1, 14, 14, 3, 3, 1]);
}

#[test]
fn registers_and_addresses_are_decoded() {
    let at = |base, offset, bytes| Some(Address { base, offset, bytes });
    // STR R0, [R1, #4]; STR.W R0, [R1, R2, LSL #2]; LDR R0, [R1], #4; LDR R8, [PC, #-12]; LDRSH R1, [R2, #6].
    let codes = [STR_R0_R1_4, 0xf841_0022, 0xf851_0b04, 0xf85f_800c, 0xf9b2_1006];
    let [constant, indexed, after, literal, half] = codes.map(decoded);
    assert_eq!(constant.address, at(1, Offset::Bytes(4), 4));
    assert_eq!((constant.reads, constant.address_registers, constant.writes), (1, 2, 0));
    assert_eq!(indexed.address, at(1, Offset::Register(2, 2), 4));
    assert_eq!(indexed.address_registers, 0b110);
    assert_eq!((after.address, after.writes), (at(1, Offset::Bytes(0), 4), 0b11));
    assert_eq!((literal.address, literal.writes), (at(15, Offset::Bytes(-12), 4), 1 << 8));
    assert_eq!((half.address, half.kind), (at(2, Offset::Bytes(6), 2), Kind::Load));
    // LDMDB R0, {R1, R2, R8} starts three words below R0. PUSH {R4, R8, LR}; POP {R4, R8, PC}; TBH [PC, R0, LSL #1].
    let [down, push, pop, table] = [0xe910_0106, 0xe92d_4110, 0xe8bd_8110, 0xe8df_f010].map(decoded);
    assert_eq!((down.address, down.writes), (at(0, Offset::Bytes(-12), 12), 0b1_0000_0110));
    assert_eq!((push.kind, push.count, push.reads), (Kind::StoreMultiple, 3, 0x4110));
    assert_eq!((pop.kind, pop.count, pop.loads_pc), (Kind::LoadMultiple, 3, true));
    assert_eq!((table.kind, table.address), (Kind::TableBranch, at(15, Offset::Register(0, 1), 2)));
    // MOVW has no register to read, MOVT its own; PLD is a hint; LDR PC, [R0] a branch.
    let [movw, movt, pld, jump] = [0xf241_2334, 0xf2c1_2334, 0xf890_f004, 0xf8d0_f000].map(decoded);
    assert_eq!([movw, movt].map(|code| (code.reads, code.writes)), [(0, 8), (8, 8)]);
    assert_eq!((pld.kind, jump.kind, jump.loads_pc), (Kind::Simple, Kind::Load, true));
    // ITTE NE: three.
    assert_eq!((decoded(0xbf1a).kind, decoded(0xbf1a).count), (Kind::IfThen, 3));
    assert!(is_wide(0xe8df) && is_wide(0xf000) && !is_wide(0xe7fe));
}

/// Copies 16 bytes a turn: LDM, STM, SUBS, BNE back to the start.
fn copying() -> (Program, Vec<Executed>) {
    let program = Program::new(0, vec![0xc93c, 0xc03c, 0x3a10, 0xd1fb]);
    let run = [0, 2, 4, 6].repeat(3).into_iter().map(Executed::at).collect();
    (program, run)
}

#[test]
fn a_loop_takes_its_turns() {
    let (program, run) = copying();
    // LDM 5, STM 5, SUBS 1, and the branch: 3, 2 and 2 cycles where it is taken, 1 the third time.
    for (pipeline, branch) in [(Pipeline::M0, 3), (Pipeline::M0Plus, 2), (Pipeline::M3, 2)] {
        let taken = program.cycles(&run, 8, pipeline, None, Some(4));
        assert_eq!(taken.cycles, 3 * 11 + 2 * branch + 1);
        // At the three SUBS.
        assert_eq!(taken.marks, [10, 21 + branch, 32 + 2 * branch]);
    }
}

#[test]
fn code_waits_for_flash_line_by_line() {
    let (program, run) = copying();
    let rules = FlashRules { wait: 3, line: 4, prefetch: false, lines: 0, ways: 0, data: DataCache::None };
    // Two lines a turn.
    let taken = program.cycles(&run, 8, Pipeline::M0, Some(&mut Flash::new(rules)), None);
    assert_eq!((taken.waited, taken.cycles), (18, 40 + 18));
    // A cache waits for each line once.
    let cached = FlashRules { lines: 4, ways: 2, ..rules };
    let taken = program.cycles(&run, 8, Pipeline::M0, Some(&mut Flash::new(cached)), None);
    assert_eq!((taken.waited, taken.cycles), (6, 40 + 6));
}

#[test]
fn loads_from_flash_wait_too() {
    // LDR R0, [R1]; LDR R2, [R3].
    let program = Program::new(0, vec![0x6808, 0x681a]);
    let rules = FlashRules { wait: 2, line: 8, prefetch: false, lines: 0, ways: 0, data: DataCache::None };
    let mut state = State::default();
    // R1 in flash, R3 in RAM.
    (state.registers[1], state.registers[3]) = (0x100, 0x2000_0000);
    let run = [0, 2].map(|at| {
        state.registers[15] = at;
        program.record(&state, &mut Conditions::default())
    });
    let taken = program.cycles(&run, 4, Pipeline::M0, Some(&mut Flash::new(rules)), None);
    // Two for the code, two for R0, and twice two of the core.
    assert_eq!((taken.waited, taken.cycles), (4, 8));
}

#[test]
fn a_skipped_load_takes_one_cycle_and_reads_nothing() {
    // CMP R0, #0; ITE EQ; LDREQ R0, [R1]; LDRNE R2, [R3].
    let program = Program::new(0, vec![0x2800, 0xbf0c, 0x6808, 0x681a]);
    let rules = FlashRules { wait: 9, line: 8, prefetch: false, lines: 0, ways: 0, data: DataCache::None };
    // With Z the first is executed and the second is not.
    for (zero, cycles) in [(true, [1, 0, 2, 1]), (false, [1, 0, 1, 2])] {
        let mut conditions = Conditions::default();
        let run = [0, 2, 4, 6].map(|at| {
            let mut state = State { flags: u32::from(zero) << 30, ..State::default() };
            (state.registers[1], state.registers[3], state.registers[15]) = (0x2000_0000, 0x100, at);
            program.record(&state, &mut conditions)
        });
        let counted = program.cycles(&run, 8, Pipeline::M3, None, None).cycles;
        assert_eq!(counted, cycles.iter().sum::<u64>());
        // One line of code; a second wait is that for flash by R3.
        let waited = program.cycles(&run, 8, Pipeline::M3, Some(&mut Flash::new(rules)), None).waited;
        assert_eq!(waited, if zero { 9 } else { 18 });
    }
}
