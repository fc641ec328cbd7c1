//! Compares the timing tables with cycles that were measured on chips and published, where the code comes from a package registry.

use crate::chips::CHIPS;
use crate::cross::BENCH;
use crate::cycles::emulated;
use crate::timing::decode::is_wide;
use crate::timing::flash::Flash;
use crate::timing::pipeline::Pipeline;
use crate::{elf, provenance, registers, Result};
use std::path::{Path, PathBuf};

/// Cycles on an nRF52840 with its cache, from the page of P256-Cortex-M4, in the order of the firmware.
const PUBLISHED: [(&str, u64); 4] = [
    ("P-256 key", 327_000),
    ("P-256 signature", 375_000),
    ("P-256 verification", 976_000),
    ("P-256 shared secret", 906_000),
];

/// The stated error of the tables.
const MOST: f64 = 0.04;

/// Prints a line for each function: name, chip, published cycles, cycles by the tables, error in per cent.
pub(crate) fn run(failures: &mut Vec<String>) -> Result<()> {
    let (core, chip) = (emulated("M4F")?, CHIPS.iter().find(|chip| chip.name == "nRF52840"));
    let rules = chip.and_then(|chip| chip.flash).ok_or("no flash of an nRF52840")?;
    core.build().cargo_in(&format!("{BENCH}/validation"), "build", &[])?;
    let image = with_single_accesses(&core.build().image("validation"))?;
    let places = provenance::frames(&image)?;
    let recorded = registers::record(core, &image, &places, PUBLISHED.len())?;
    for ((name, published), frame) in PUBLISHED.iter().zip(&recorded.frames) {
        let mut flash = Flash::new(rules);
        let cycles =
            recorded.program.cycles(&frame.run, frame.end, Pipeline::M4, Some(&mut flash), None).cycles;
        let error = cycles as f64 / *published as f64 - 1.0;
        println!("{name},nRF52840,{published},{cycles},{:+.1}", 100.0 * error);
        if error.abs() > MOST {
            failures.push(format!("{name}: {cycles} cycles by the tables, {published} are published"));
        }
    }
    Ok(())
}

/// A copy of an image in which a multiple load or store of one register is replaced by a single one, as GNU's assembler writes
/// it. LLVM's assembler leaves it, which the architecture calls unpredictable and QEMU treats as undefined.
fn with_single_accesses(image: &Path) -> Result<PathBuf> {
    let code = elf::code(image)?;
    let mut halves: Vec<u16> =
        code.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
    let mut at = 0;
    while let [first, second, ..] = &mut halves[at..] {
        if !is_wide(*first) {
            at += 1;
            continue;
        }
        // LDMIA and STMIA without write-back become LDR and STR without an offset.
        if *first & 0xffe0 == 0xe880 && second.count_ones() == 1 {
            *first = 0xf8c0 | *first & 0x1f;
            *second = (second.trailing_zeros() as u16) << 12;
        }
        at += 2;
    }
    let copy = image.with_file_name("validation_of_single_accesses");
    let mut file = std::fs::read(image)?;
    let from = elf::code_offset(image)?;
    let bytes = halves.iter().flat_map(|half| half.to_le_bytes());
    file[from..].iter_mut().zip(bytes).for_each(|(byte, new)| *byte = new);
    std::fs::write(&copy, file)?;
    Ok(copy)
}
