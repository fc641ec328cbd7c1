//! Reads what `cargo run --release --example report` in a template has logged, compares it with the emulated cores, and prints its row for
//! `docs/hardware.md`:
//!
//! ```text
//! cargo run -p pinhole-report -- LOG [WHO]
//! ```
//!
//! Other lines of the log do not matter. It fails where a picture differs, or a scene is missing.

use serde::Deserialize;
use std::fmt::Write;
use std::process::ExitCode;

const CELLS: &str = include_str!("../../../docs/data/cells.json");
const CYCLES: &str = include_str!("../../../docs/data/cycles.json");

/// The scenes of `tools/bench/src/report.rs`.
const SCENES: [[&str; 2]; 6] = [
    ["S1", "bands8"],
    ["S2", "bands8"],
    ["S2", "bands8-z"],
    ["S3", "bands8"],
    ["S3", "bands8-z"],
    ["S3", "bands8-z-edges"],
];

/// A core as the log names it, the emulated core with its instructions, and the pipeline with its cycles, if there is a model.
const CORES: [(&str, &str, Option<&str>); 6] = [
    ("M0", "M0", Some("M0")),
    ("M0+", "M0", Some("M0+")),
    ("M3", "M3", Some("M3")),
    ("M4", "M4F", Some("M4")),
    ("M33", "M4F", Some("M33")),
    ("RV32", "RV32", None),
];

#[derive(Deserialize)]
struct Table {
    rows: Vec<Figure>,
}

/// A row of either file.
#[derive(Deserialize)]
struct Figure {
    scene: String,
    variant: String,
    core: String,
    instructions: Option<f64>,
    cycles: Option<f64>,
    crc: Option<String>,
}

/// What a board has logged.
#[derive(Debug, PartialEq)]
struct Log {
    chip: String,
    core: String,
    megahertz: u32,
    compiler: String,
    /// Cycles and CRC of each of the scenes.
    frames: Vec<(u32, String)>,
}

/// Frames a second, with a decimal, which firmware rounds down.
fn speed_of(megahertz: u32, cycles: u32) -> String {
    format!("{:.1}", (f64::from(megahertz) * 1e7 / f64::from(cycles)).floor() / 10.0)
}

/// The text of the report's lines, which follow this mark.
const MARK: &str = "report: ";

fn read(text: &str) -> Result<Log, String> {
    let lines: Vec<&str> = text.lines().filter_map(|line| Some(line.split_once(MARK)?.1.trim())).collect();
    let board = lines.iter().rev().find_map(|line| line.strip_prefix("chip ")).ok_or(
        "no line `report: chip …`: is this the log of `cargo run --release --example report`, from its first line on?",
    )?;
    let wanted = || {
        format!("`{board}`: wanted a chip, its core, its clock and the compiler, such as `RP2040, code in flash, M0+, 125 MHz, rustc 1.96.0`")
    };
    // The names of chips and compilers have commas, too.
    let (left, compiler) = board.split_once(" MHz, ").ok_or_else(wanted)?;
    let parts: Vec<&str> = left.rsplitn(3, ", ").collect();
    let &[clock, core, chip] = &parts[..] else { return Err(wanted()) };
    let megahertz = clock.parse().map_err(|_| wanted())?;
    let frames = SCENES.iter().map(|[scene, variant]| {
        let name = format!("{scene} {variant}");
        let figures = lines.iter().rev().find_map(|line| line.strip_prefix(&name)?.strip_prefix(' '));
        let missing = format!("no line `report: {name} …`: copy the log up to `report: end`");
        let (cycles, rest) = figures.and_then(|line| line.split_once(" cycles, ")).ok_or(&missing[..])?;
        let (speed, crc) = rest.split_once(" frames/s, crc ").ok_or(missing)?;
        let cycles = cycles.parse().map_err(|_| format!("`{cycles}` is no number of cycles"))?;
        let expected = speed_of(megahertz, cycles);
        if speed != expected {
            return Err(format!(
                "{name}: {speed} frames/s, but {cycles} cycles at {megahertz} MHz are {expected}"
            ));
        }
        Ok((cycles, crc.to_lowercase()))
    });
    let frames = frames.collect::<Result<_, String>>()?;
    Ok(Log { chip: chip.into(), core: core.into(), megahertz, compiler: compiler.into(), frames })
}

/// The CRC of a scene's picture and, of a core with a model, the cycles of a frame.
fn expected(
    cells: &Table,
    cycles: &Table,
    name: &[&str; 2],
    core: &str,
) -> Result<(String, Option<f64>), String> {
    let (_, image, pipeline) = CORES.iter().find(|(name, ..)| *name == core).ok_or_else(|| {
        let known = CORES.map(|(name, ..)| name).join(", ");
        format!("core `{core}`: known are {known}")
    })?;
    let is_this = |row: &&Figure| [&row.scene[..], &row.variant[..]] == *name;
    let of_scene = || cells.rows.iter().filter(is_this);
    let crc = of_scene().find_map(|row| row.crc.clone()).ok_or(format!("no figures of {name:?}"))?;
    let instructions = of_scene().find(|row| row.core == *image).and_then(|row| row.instructions);
    // Cycles an instruction, of a frame with depth.
    let of_pipeline =
        |row: &&Figure| row.scene == "S3" && row.variant == "z" && Some(&row.core[..]) == *pipeline;
    let row = cycles.rows.iter().find(of_pipeline);
    let each = row.and_then(|row| Some(row.cycles? / row.instructions?));
    Ok((crc, instructions.zip(each).map(|(instructions, each)| instructions * each)))
}

/// The table of a log, the row for the page, and whether all pictures are right.
fn report(log: &Log, who: &str) -> Result<(String, bool), String> {
    let parse = |text| serde_json::from_str::<Table>(text).map_err(|error| error.to_string());
    let (cells, cycles) = (parse(CELLS)?, parse(CYCLES)?);
    let (mut text, mut row, mut is_right) = (String::new(), String::new(), true);
    for (name, &(counted, ref crc)) in SCENES.iter().zip(&log.frames) {
        let (wanted, model) = expected(&cells, &cycles, name, &log.core)?;
        let against = model.map_or("no model of this core".into(), |model| {
            format!("{:+.0} % of the model's {model:.0}", 100.0 * (f64::from(counted) / model - 1.0))
        });
        let picture = if *crc == wanted {
            "as it should be".into()
        } else {
            format!("WRONG: crc {crc} in place of {wanted}")
        };
        is_right &= *crc == wanted;
        let [scene, variant] = name;
        let speed = speed_of(log.megahertz, counted);
        let _ = writeln!(
            text,
            "{scene} {variant}: {counted} cycles, {speed} frames/s, {against}; picture {picture}"
        );
        let _ = write!(row, " {:.1} |", f64::from(counted) / 1000.0 / f64::from(log.megahertz));
    }
    let Log { chip, core, megahertz, compiler, .. } = log;
    let _ = writeln!(text, "\n| {chip} | {core}, {megahertz} MHz | {compiler} |{row} {who} |");
    Ok((text, is_right))
}

fn main() -> ExitCode {
    let mut given = std::env::args().skip(1);
    let (Some(file), who) = (given.next(), given.next()) else {
        eprintln!("Usage: cargo run -p pinhole-report -- LOG [WHO]   (LOG: what `cargo run --release --example report` printed)");
        return ExitCode::from(2);
    };
    let text = std::fs::read(&file).map_err(|error| format!("{file}: {error}"));
    let found =
        text.and_then(|text| report(&read(&String::from_utf8_lossy(&text))?, who.as_deref().unwrap_or("?")));
    match found {
        Ok((text, is_right)) => {
            print!("{text}");
            if is_right {
                println!("Add this line to docs/hardware.md, and the log to docs/data.");
                return ExitCode::SUCCESS;
            }
            eprintln!("A picture differs from the host's: please file an issue with the log.");
        }
        Err(problem) => eprintln!("{problem}"),
    }
    ExitCode::FAILURE
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOG: &str = "INFO  report: chip RP2040, code in flash, M0+, 125 MHz, rustc 1.96.0 (a, b)\n";

    fn lines() -> String {
        SCENES
            .map(|[scene, variant]| {
                format!("0.5 INFO report: {scene} {variant} 3000000 cycles, 41.6 frames/s, crc 1234ABCD\n")
            })
            .concat()
    }

    #[test]
    fn a_log_is_read_among_other_lines() {
        let log = read(&format!("boot\n{LOG}x\n{}report: end", lines())).expect("a log");
        assert_eq!((&log.chip[..], &log.core[..], log.megahertz), ("RP2040, code in flash", "M0+", 125));
        assert_eq!(log.compiler, "rustc 1.96.0 (a, b)");
        assert_eq!(log.frames, vec![(3_000_000, "1234abcd".to_owned()); 6]);
        let (text, is_right) = report(&log, "me").expect("figures");
        assert!(!is_right && text.contains("WRONG: crc 1234abcd"), "{text}");
        assert!(
            text.contains("| RP2040, code in flash | M0+, 125 MHz | rustc 1.96.0 (a, b) | 24.0 |"),
            "{text}"
        );
    }

    /// Each row of the page ends with a link to its log.
    #[test]
    fn the_rows_of_the_page_are_those_of_their_logs() {
        let docs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs");
        let page = std::fs::read_to_string(format!("{docs}/hardware.md")).expect("the page");
        let (_, rows) = page.split_once("| measured by |\n").expect("the table");
        let rows: Vec<&str> = rows.lines().skip(1).take_while(|line| line.starts_with('|')).collect();
        assert!(rows.len() >= 2, "{page}");
        for row in rows {
            let who = row.trim_end_matches(" |").rsplit("| ").next().expect("a cell");
            let log = who.split(['(', ')']).find(|part| part.starts_with("data/")).expect(row);
            let text = std::fs::read_to_string(format!("{docs}/{log}")).expect(log);
            let (text, is_right) = report(&read(&text).expect(log), who).expect(log);
            let problem = "run cargo run -p pinhole-report with the log and the last cell";
            assert!(is_right && text.ends_with(&format!("\n{row}\n")), "{log}: {problem}: {text}");
            assert_eq!(who.contains("emulated"), log.contains("emulated"), "{row}");
        }
    }

    #[test]
    fn the_emulated_cores_figures_are_right() {
        let table: Table = serde_json::from_str(CELLS).expect("a table");
        for (core, image, _) in CORES {
            let frames = SCENES.map(|[scene, variant]| {
                let row = table
                    .rows
                    .iter()
                    .find(|row| row.scene == scene && row.variant == variant && row.core == image);
                let row = row.unwrap_or_else(|| panic!("{scene} {variant} {image}"));
                (row.instructions.expect("a count") as u32, row.crc.clone().expect("a checksum"))
            });
            let (chip, compiler) = ("emulated".into(), "rustc".into());
            let log = Log { chip, core: core.into(), megahertz: 100, compiler, frames: frames.into() };
            let (text, is_right) = report(&log, "me").expect("figures");
            assert!(is_right, "{text}");
            // An instruction takes more than a cycle: what is counted is less than the model says.
            assert!(core == "RV32" || text.matches("-").count() > 6, "{text}");
        }
    }

    #[test]
    fn what_is_missing_is_named() {
        let message = |text: &str| read(text).expect_err("an error");
        assert!(message("").contains("report: chip"));
        assert!(message(&lines()).contains("report: chip"));
        assert!(message("report: chip RP2040, M0+").contains("the compiler"));
        assert!(message("report: chip RP2040, M0+, fast MHz, rustc")
            .contains("`RP2040, M0+, fast MHz, rustc`: wanted"));
        let cut = message(&format!("report: chip RP2040, M0+, 125 MHz, rustc\n{}", &lines()[..80]));
        assert!(cut.contains("no line `report: S2 bands8 …`"), "{cut}");
        for (from, to, problem) in [
            ("3000000", "many", "`many` is no number"),
            ("41.6", "41.7", "S1 bands8: 41.7 frames/s, but 3000000 cycles at 125 MHz are 41.6"),
            ("41.6 frames/s, ", "", "no line `report: S1 bands8 …`"),
        ] {
            let wrong = lines().replacen(from, to, 1);
            let wrong = message(&format!("report: chip RP2040, M0+, 125 MHz, rustc\n{wrong}"));
            assert!(wrong.contains(problem), "{wrong}");
        }
        let log = read(&format!("report: chip RP2040, M7, 125 MHz, rustc\n{}", lines())).expect("a log");
        assert!(report(&log, "me").expect_err("an error").contains("core `M7`: known are M0, M0+"));
    }
}
