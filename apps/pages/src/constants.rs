//! The book's constants of frame time, flash and stack: sections of the pages that measure them.

use crate::grouped::grouped;
use crate::page::{number, Page};

const SPI: u64 = 40_000_000;

pub(crate) fn tables() -> Result<String, String> {
    let growth = Page::read("docs/growth.md")?;
    let footprint = Page::read("docs/footprint.md")?;
    let mut text = String::from("## Instructions\n\n");
    text += growth.section("The constants")?;
    // A case that the fit did not use.
    let torus = growth.row("Whether it holds", &["bands of 8 rows", "S3's torus", "240 × 240"])?;
    let (counted, off) = (torus.get("M3 counts")?, torus.after("M3 counts")?);
    let sending = 240 * 240 * 16 * 1000 / SPI;
    let (clock, cycles) = (72_u64, 3); // in halves
    let drawing = number(counted)? * cycles / 2 / (clock * 1000);
    text += &format!(
        "\n\n**For example**: the torus of 1000 triangles, lit and with depth, on 240 × 240 pixels in bands of 8 rows took {counted} \
         instructions on the M3, and the formula is {off} off. At {clock} MHz and, say, 1.5 cycles an instruction these are {drawing} ms; \
         {} bytes at {} MHz take {sending} ms on the wire.\n",
        grouped(240 * 240 * 2),
        SPI / 1_000_000,
    );
    for (title, section) in [("Flash", "Flash"), ("Stack", "RAM and stack")] {
        let section = footprint.section(section)?;
        let table: Vec<_> = section.lines().filter(|line| line.starts_with('|')).collect();
        text += &format!("\n## {title}\n\n{}\n", table.join("\n"));
    }
    text += "\nIn bytes, at opt-level 3 and s, beyond a firmware that does nothing; *variables* are the memory that each program provides: the vertex\n\
        cache of a cube, in bands the bin storage, and 8 rows of 240 pixels of colour or depth where it needs them.\n";
    Ok(text)
}
