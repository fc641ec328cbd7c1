//! Short sequences. The expected cycles are added up by hand from the tables of Arm's manuals, and of an ESP32-C3 they are what the chip
//! counted; the encodings are an assembler's.

use super::decode::Instruction;
use super::flash::{DataCache, Flash, FlashRules};
use super::pipeline::{Cycles, Pipeline, Step};
use super::program::{Conditions, Executed, Program, State};
use super::riscv::Rules;
use crate::record::Frame;
use Pipeline::{M0Plus, M0, M3, M33, M4};

fn decoded(code: u32) -> Instruction {
    match u16::try_from(code) {
        Ok(half) => Instruction::thumb(half, 0),
        Err(_) => Instruction::thumb((code >> 16) as u16, code as u16),
    }
}

#[test]
fn sequences_take_what_the_manuals_say() {
    let [ldr_r0_r1, ldr_r2_r3, ldr_r2_r0, str_offset, str_index] = [0x6808, 0x681a, 0x6802, 0x6048, 0x5088];
    let [muls, mla, umull, smlal, udiv] = [0x4348, 0xfb01_3002, 0xfba2_0103, 0xfbc2_0103, 0xfbb1_f0f2];
    let [push_3, ldm_4, stm_4, ldrd, subs, movs, it] =
        [0xb5f0, 0xc93c, 0xc03c, 0xe9d2_0102, 0x3801, 0x2101, 0xbf08];
    let (vldr, vpush_4, vdiv, vmla, vadd) = (0xed91_0a01, 0xed2d_8b04, 0xee80_0a81, 0xee00_0a81, 0xee30_0a81);
    let small: &[u32] = &[ldr_r0_r1, ldr_r2_r3, str_index, muls, subs, ldm_4, stm_4, push_3];
    let cases: [(&[Pipeline], &[u32], &[u32]); 9] = [
        (&[M0, M0Plus], small, &[2, 2, 2, 1, 1, 5, 5, 6]),
        // Loads overlap unless they depend on each other, and a store with an offset goes on while the next instruction runs.
        (&[M3, M4], &[ldr_r0_r1, ldr_r2_r3, subs, ldr_r0_r1, ldr_r2_r0], &[2, 1, 1, 2, 2]),
        (&[M3, M4], &[str_offset, str_index, ldm_4, push_3, ldrd], &[1, 2, 5, 6, 3]),
        (&[M3], &[muls, mla, umull, smlal, udiv], &[1, 2, 5, 7, 7]),
        (&[M4], &[muls, mla, umull, smlal, udiv], &[1, 1, 1, 1, 7]),
        // An IT is free behind a short instruction.
        (&[M3, M4], &[subs, it, movs], &[1, 0, 1]),
        (&[M4], &[vldr, vpush_4, vdiv, vmla, vadd], &[2, 5, 14, 3, 1]),
        // The guess: short instructions are joined, and a load waits where its result is used at once.
        (&[M33], &[movs, subs, movs, subs], &[1, 0, 1, 0]),
        (&[M33], &[ldr_r0_r1, subs], &[1, 2]),
    ];
    for (pipelines, codes, expected) in cases {
        for &pipeline in pipelines {
            let mut cycles = Cycles::new(pipeline);
            let step = |code: &u32| {
                let instruction = &decoded(*code);
                cycles.step(Step { instruction, taken: false, next_unaligned: false, skipped: false })
            };
            assert_eq!(codes.iter().map(step).collect::<Vec<_>>(), expected, "{codes:x?}");
        }
    }
}

#[test]
fn branches_refill_the_pipeline() {
    // BNE, BL, BX LR, BLX R3, POP {R4-R7, PC}.
    for (code, expected) in [
        (0xd1fd, [3, 2, 2, 2, 2]),
        (0xf000_f832, [4, 3, 2, 2, 2]),
        (0x4770, [3, 2, 3, 3, 3]),
        (0x4798, [3, 2, 3, 3, 3]),
        (0xbdf0, [9, 8, 9, 9, 8]),
    ] {
        let instruction = &decoded(code);
        let step = Step { instruction, taken: true, next_unaligned: false, skipped: false };
        assert_eq!([M0, M0Plus, M3, M4, M33].map(|core| Cycles::new(core).step(step)), expected, "{code:x}");
    }
}

#[test]
fn a_loop_takes_its_turns_and_waits_for_flash() {
    // LDM 5, STM 5, SUBS 1, and BNE back: 3 or 2 cycles where it is taken, 1 the third time.
    let program = Program::new(0, vec![0xc93c, 0xc03c, 0x3a10, 0xd1fb], Instruction::thumb);
    let run: Vec<_> = [0, 2, 4, 6].repeat(3).into_iter().map(Executed::at).collect();
    for (pipeline, branch) in [(M0, 3), (M0Plus, 2), (M3, 2)] {
        let taken = program.cycles(&run, 8, pipeline, None, Some(4));
        assert_eq!((taken.cycles, taken.marks), (34 + 2 * branch, vec![10, 21 + branch, 32 + 2 * branch]));
    }
    // Two lines a turn; a cache waits for each line once.
    let slow = FlashRules { wait: 3, line: 4, prefetch: false, lines: 0, ways: 0, data: DataCache::None };
    for (rules, waited) in [(slow, 18), (FlashRules { lines: 4, ways: 2, ..slow }, 6)] {
        assert_eq!(program.cycles(&run, 8, M0, Some(&mut Flash::new(rules)), None).waited, waited);
    }
}

#[test]
fn a_skipped_load_takes_one_cycle_and_reads_nothing() {
    // CMP R0, #0; ITE EQ; LDREQ R0, [R1] from RAM; LDRNE R2, [R3] from flash. With Z the first is executed and the second is not.
    let program = Program::new(0, vec![0x2800, 0xbf0c, 0x6808, 0x681a], Instruction::thumb);
    let rules = FlashRules { wait: 9, line: 8, prefetch: false, lines: 0, ways: 0, data: DataCache::None };
    for (zero, waited) in [(1, 9), (0, 18)] {
        let mut conditions = Conditions::default();
        let run = [0, 2, 4, 6].map(|at| {
            let mut state = State { flags: zero << 30, ..State::default() };
            (state.registers[1], state.registers[3], state.registers[15]) = (0x2000_0000, 0x100, at);
            program.record(&state, &mut conditions)
        });
        assert_eq!(program.cycles(&run, 8, M3, None, None).cycles, 4);
        assert_eq!(program.cycles(&run, 8, M3, Some(&mut Flash::new(rules)), None).waited, waited);
    }
}

/// A loop of Timon Van Overveldt's `cycle_counting.rs`, a thousand times round: lw, add with its result, nop, bne back.
#[test]
fn a_loop_takes_what_an_esp32c3_counted() {
    let code = vec![0x2603, 0x0005, 0x9532, 0x0001, 0x1ee3, 0xfeb5];
    let program = Program::new(0, code, Instruction::riscv);
    let run = [0, 4, 6, 8].repeat(1000).into_iter().map(Executed::at).collect();
    let frame = Frame { program, run, end: 12, mark: None, constants: 0 };
    assert_eq!(Rules::Likely.cycles(&frame), 999 * (2 + 1 + 1 + 3) + 5);
}
