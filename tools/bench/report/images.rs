//! Cycles of images that are built elsewhere and count one frame or more by the clock, on the chips that run them.

use crate::chips::chips;
use crate::core::{Core, CORES};
use crate::esp32c3::Sum;
use crate::record::record;
use crate::side_by_side::side_by_side;
use crate::timing::{flash::Flash, riscv};
use crate::{elf, provenance, Result, RV32};
use std::path::Path;

/// Prints a line `image;chip;instructions;cycles` for the first frame of each image, on each chip; of an ESP32-C3, whose rules are not all
/// known, the least, the likely and the most cycles.
pub(crate) fn print(images: &[&str]) -> Result<()> {
    let lines = side_by_side(images, |image| of(Path::new(image)))?;
    lines.iter().flatten().for_each(|line| println!("{line}"));
    Ok(())
}

fn of(image: &Path) -> Result<Vec<String>> {
    let name = image.display();
    let is_for = |core: &Core| image.components().any(|part| part.as_os_str() == core.build().target);
    let core = CORES.into_iter().find(is_for).ok_or_else(|| format!("{name}: no folder of a target"))?;
    let recorded = record(core, image, &provenance::frames(image)?, 1)?;
    let frame = recorded.frames.first().ok_or("a frame is missing")?;
    let instructions = frame.run.len();
    if core.build().target == RV32 {
        let sizes = elf::sizes(image)?;
        let constants = sizes.flash - (sizes.code.end - sizes.code.start);
        let mut sum = Sum::default();
        sum.add(&riscv::Program::of(image)?, frame, constants as u32); // far below 2³²
        let cycles = sum.in_flash().map(|cycles| cycles.to_string()).join(";");
        return Ok(vec![format!("{name};ESP32-C3, code in flash;{instructions};{cycles}")]);
    }
    let chips = chips()?;
    let lines = chips.iter().filter(|(chip, _)| chip.image == core.name).map(|(chip, _)| {
        let mut flash = chip.flash.map(Flash::new);
        let mut pass =
            || recorded.program.cycles(&frame.run, frame.end, chip.pipeline, flash.as_mut(), None).cycles;
        // Time a frame that follows another one, so that caches are warm.
        pass();
        format!("{name};{};{instructions};{}", chip.chip, pass())
    });
    Ok(lines.collect())
}
