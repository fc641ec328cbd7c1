//! Cycles of images that are built elsewhere and count one frame or more by the clock, on the chips that run them.

use crate::chips::CHIPS;
use crate::core::Core;
use crate::cycles::emulated;
use crate::esp32c3::Sum;
use crate::timing::flash::Flash;
use crate::timing::riscv;
use crate::{provenance, registers, trace, Result, M0, M3, RV32};
use std::path::Path;

/// Prints a line `image;chip;instructions;cycles` for the first frame of each image, on each chip; of an ESP32-C3, whose rules are not all
/// known, the least, the likely and the most cycles.
pub(crate) fn print(images: &[String]) -> Result<()> {
    let lines = crate::side_by_side::side_by_side(images, |image| of(Path::new(image)))?;
    lines.iter().flatten().for_each(|line| println!("{line}"));
    Ok(())
}

/// The core that a target's folder is for.
fn core_of(image: &Path) -> Result<Core> {
    let is_in = |target: &str| image.components().any(|part| part.as_os_str() == target);
    let named = [(M0, "M0"), (M3, "M3"), ("thumbv7em-none-eabihf", "M4F"), (RV32, "RV32")];
    let core = named.into_iter().find(|(target, _)| is_in(target));
    emulated(core.ok_or_else(|| format!("{}: no folder of a target", image.display()))?.1)
}

fn of(image: &Path) -> Result<Vec<String>> {
    let (core, places) = (core_of(image)?, provenance::frames(image)?);
    let name = image.display();
    if core.name == "RV32" {
        let mut run = Vec::new();
        trace::frame(core, image, &places, |block| {
            run.extend(block.iter().map(|at| *at as u32)); // the board's addresses have 32 bits
        })?;
        let sizes = crate::elf::sizes(image)?;
        let constants = sizes.flash - (sizes.code.end - sizes.code.start);
        let mut sum = Sum::default();
        sum.add(&riscv::Program::of(image)?, &run, constants as u32)?; // far below 2³²
        let cycles = sum.in_flash().map(|cycles| format!("{:.0}", cycles * sum.instructions() as f64));
        return Ok(vec![format!(
            "{name};ESP32-C3, code in flash;{};{}",
            sum.instructions(),
            cycles.join(";")
        )]);
    }
    let recorded = registers::record(core, image, &places, 1)?;
    let frame = recorded.frames.first().ok_or("a frame is missing")?;
    let chips = CHIPS.iter().filter(|chip| chip.image == core.name);
    let lines = chips.map(|chip| {
        let mut flash = chip.flash.map(Flash::new);
        let mut pass =
            || recorded.program.cycles(&frame.run, frame.end, chip.pipeline, flash.as_mut(), None).cycles;
        // Time a frame that follows another one, so that caches are warm.
        pass();
        format!("{name};{};{};{}", chip.name, frame.run.len(), pass())
    });
    Ok(lines.collect())
}
