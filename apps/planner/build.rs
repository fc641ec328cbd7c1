//! Figures for the planner, from the pages that `tools/bench/run` writes: `docs/growth.md` has the cost of a vertex, a face, a
//! row and a pixel, and the cycles of an instruction; `docs/speed.md` the chips; `docs/footprint.md` the flash of code. Also the
//! model of the templates, in fewer bytes than its file.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// The tables of constants: the heading of each, the name of its constant here, and its number of rows.
const WAYS: [(&str, &str, usize); 13] = [
    ("### Edges as lines", "LINES", 8),
    ("### Faces without depth", "FACES", 11),
    ("### Faces with depth", "DEPTH", 11),
    ("### Faces with depth in bands", "BANDS", 13),
    ("### Edges as lines in bands", "LINE_BANDS", 8),
    ("### Hidden lines in bands", "HIDDEN_BANDS", 15),
    ("### Smooth faces with depth in bands", "SMOOTH_BANDS", 11),
    ("### Flat faces in dithered colours, with depth, in bands", "DITHERED_BANDS", 11),
    ("### Smooth faces in dithered colours, with depth, in bands", "SMOOTH_DITHERED_BANDS", 11),
    ("### Textured faces with depth in bands", "TEXTURED_BANDS", 13),
    ("### Faces without depth in bands", "PLAIN_BANDS", 11),
    ("### Faces in painter's order", "PAINTED_WHOLE", 11),
    ("### Faces in painter's order in bands", "PAINTED_BANDS", 12),
];

/// The chips of `docs/speed.md`: the row of each, its name in choices, and the row of `docs/growth.md` that has its cycles.
const CHIPS: [(&str, &str, &str); 7] = [
    ("rp2040", "RP2040, code in flash", "RP2040, code in flash, 125 MHz"),
    ("rp2040-ram", "RP2040, code in RAM", "M0+, no wait states"),
    ("rp2350-ram", "RP2350, code in RAM", "M33, no wait states"),
    ("stm32f030", "STM32F030xC", "STM32F030xC, 48 MHz"),
    ("stm32f103", "STM32F103xB", "STM32F103xB, 72 MHz"),
    ("stm32f411", "STM32F411xE", "STM32F411xE, 100 MHz"),
    ("nrf52840", "nRF52840", "nRF52840, 64 MHz"),
];

/// Images of `docs/footprint.md`, and their names here.
const IMAGES: [(&str, &str); 15] = [
    ("flat faces with depth in bands, into `pixels()`, before a camera that frames them", "FRAMED_CODE"),
    ("wireframe, into a DrawTarget in memory", "LINES_CODE"),
    ("wireframe in bands", "LINES_BANDS_CODE"),
    ("hidden lines in bands", "HIDDEN_BANDS_CODE"),
    ("flat faces, into a picture in memory", "FACES_CODE"),
    ("flat faces with depth, into a picture in memory", "DEPTH_CODE"),
    ("flat faces in bands, into `pixels()`", "PLAIN_BANDS_CODE"),
    ("flat faces with depth in bands", "TARGET_CODE"),
    ("flat faces with depth in bands, into `pixels()`", "BANDS_CODE"),
    ("smooth faces with depth in bands, into `pixels()`", "SMOOTH_BANDS_CODE"),
    ("flat faces in dithered colours, with depth, in bands, into `pixels()`", "DITHERED_BANDS_CODE"),
    ("smooth faces in dithered colours, with depth, in bands, into `pixels()`", "SMOOTH_DITHERED_BANDS_CODE"),
    ("textured faces with depth in bands, into `pixels()`", "TEXTURED_BANDS_CODE"),
    ("flat faces in painter's order, into a picture in memory", "PAINTED_CODE"),
    ("flat faces in painter's order, in bands, into `pixels()`", "PAINTED_BANDS_CODE"),
];

fn main() -> Result<()> {
    let docs = Path::new(&std::env::var("CARGO_MANIFEST_DIR")?).join("../../docs");
    let read = |name: &str| -> Result<String> {
        let file = docs.join(name);
        println!("cargo::rerun-if-changed={}", file.display());
        Ok(std::fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()))?)
    };
    let (growth, speed, footprint) = (read("growth.md")?, read("speed.md")?, read("footprint.md")?);
    let mut out = String::new();
    for (heading, name, count) in WAYS {
        way(&growth, heading, name, count, &mut out)
            .map_err(|e| format!("docs/growth.md, {heading}: {e}"))?;
    }
    placing(&growth, &mut out).map_err(|e| format!("docs/growth.md, placing an object: {e}"))?;
    writeln!(out, "pub(crate) const MODELLED: [Chip; {}] = [", CHIPS.len())?;
    for (key, name, cycles) in CHIPS {
        chip(&speed, &growth, [key, name, cycles], &mut out)
            .map_err(|e| format!("docs/speed.md, {name}: {e}"))?;
    }
    writeln!(out, "];")?;
    esp32c3(&growth, &mut out).map_err(|e| format!("docs/growth.md, ESP32-C3: {e}"))?;
    let [flash, stack] = [section(&footprint, "## Flash")?, section(&footprint, "## RAM and stack")?];
    for (image, name) in IMAGES {
        let [flash, stack] = [bytes(flash, image)?, bytes(stack, image)?];
        writeln!(out, "pub(crate) const {name}: Code = Code {{ flash: [{flash}], stack: [{stack}] }};")?;
    }
    let folder = std::env::var("OUT_DIR")?;
    std::fs::write(Path::new(&folder).join("figures.rs"), out)?;
    let model = docs.join("../boards/any-cortex-m/model.stl");
    println!("cargo::rerun-if-changed={}", model.display());
    std::fs::write(Path::new(&folder).join("gear.rs"), gear(&std::fs::read(&model)?)?)?;
    Ok(())
}

/// The instructions of placing an object, and of turning its light, on the cores M0, M3, M4F and RV32.
fn placing(growth: &str, out: &mut String) -> Result<()> {
    let table = rows(section(growth, "### Placing an object")?).collect::<Vec<_>>();
    let [header, _, place, light] = &table[..] else { return Err("not two rows".into()) };
    if header.get(1..) != Some(&["M0", "M3", "M4F", "RV32"]) {
        return Err("other cores".into());
    }
    for (name, figures) in [("PLACING", place), ("LIGHTING", light)] {
        let figures: Vec<String> = figures.iter().skip(1).map(|cell| number(cell)).collect::<Result<_>>()?;
        writeln!(out, "pub(crate) const {name}: [f64; 4] = [{}];", figures.join(", "))?;
    }
    Ok(())
}

/// The cycles of an instruction of an ESP32-C3, whose cells are such as `1.35 (1.23–1.67)`: the least, the likely ones, and the most.
fn esp32c3(growth: &str, out: &mut String) -> Result<()> {
    let cells = row(section(growth, "## Cycles per instruction")?, "ESP32-C3, code in flash, 160 MHz")?;
    let mut cycles = [const { Vec::new() }; 3];
    for cell in cells.iter().skip(1) {
        let parts: Vec<_> = cell.split(['(', '–', ')']).map(str::trim).collect();
        let [likely, least, most, ""] = parts[..] else { return Err(format!("{cell}: no range").into()) };
        for (of, part) in cycles.iter_mut().zip([least, likely, most]) {
            of.push(number(part)?);
        }
    }
    let [least, likely, most] = cycles.map(|of| of.join(", "));
    writeln!(out, "pub(crate) const ESP32C3_CYCLES: [[f64; 3]; 3] = [[{least}], [{likely}], [{most}]];")?;
    Ok(())
}

/// The bytes of an image on the cores M0, M3, M4F (as on the M3) and RV32.
fn bytes(table: &str, image: &str) -> Result<String> {
    let row = row(table, image).map_err(|e| format!("docs/footprint.md: {e}"))?;
    // The columns of `docs/footprint.md`, for M0, M3, M4F and RV32. A size is one figure for all builds, or one each for thumbv7m
    // at 3 and s, thumbv6m at 3 and s, and riscv32imc at 3.
    let bytes = [4, 2, 2, 6]
        .map(|column| row.get(column).map_or(String::new(), |cell| cell.split_whitespace().collect()));
    let is_number = |bytes: &String| bytes.parse::<i32>().is_ok();
    bytes
        .iter()
        .all(is_number)
        .then(|| bytes.join(", "))
        .ok_or_else(|| format!("docs/footprint.md: {row:?}").into())
}

/// The vertices and faces of a binary STL file, as Rust: each position is written once.
fn gear(stl: &[u8]) -> Result<String> {
    let mut vertices: Vec<[f32; 3]> = Vec::new();
    let mut faces = Vec::new();
    // A header of 84 bytes, then records of 50: a normal, three corners, two bytes.
    for record in stl.get(84..).ok_or("model.stl: too short")?.chunks_exact(50) {
        let number = |at: usize| -> Result<f32> { Ok(f32::from_le_bytes(record[at..at + 4].try_into()?)) };
        let mut face = [0; 3];
        for (corner, index) in face.iter_mut().enumerate() {
            let at = 12 + 12 * corner;
            let vertex = [number(at)?, number(at + 4)?, number(at + 8)?];
            *index = vertices.iter().position(|other| *other == vertex).unwrap_or_else(|| {
                vertices.push(vertex);
                vertices.len() - 1
            });
        }
        faces.push(face);
    }
    Ok(format!(
        "const GEAR_VERTICES: [[f32; 3]; {}] = {vertices:?};\nconst GEAR_FACES: [[u16; 3]; {}] = {faces:?};\n",
        vertices.len(),
        faces.len()
    ))
}

/// The constants of a way to draw, for the cores M0, M3, M4F and RV32, and the largest error of the formula, in percent.
fn way(page: &str, heading: &str, name: &str, count: usize, out: &mut String) -> Result<()> {
    let table = section(page, heading)?;
    let header = rows(table).next().ok_or("no table")?;
    let rows: Vec<Vec<&str>> = rows(table).skip(2).collect();
    let (constants, errors) = rows.split_at_checked(count).ok_or("too few rows")?;
    let column = |core: &str| -> Result<Vec<String>> {
        let column =
            header.iter().position(|cell| *cell == core).ok_or_else(|| format!("no column {core}"))?;
        constants.iter().map(|row| number(row.get(column).copied().unwrap_or_default())).collect()
    };
    let names: Vec<_> = constants.iter().filter_map(|row| row.first()).collect();
    let last = **names.last().ok_or("no constants")?;
    let lasts = ["pixel of the picture", "band", "pixel of a line", "pixel of a face in perspective: more"];
    if !lasts.contains(&last) {
        return Err(format!("the last constant is {last}").into());
    }
    if !errors.first().and_then(|row| row.first()).is_some_and(|cell| cell.starts_with("error in the fit")) {
        return Err(format!("more than {count} constants").into());
    }
    // The largest error, whether the case was fitted or not: mean, mean of sizes, largest.
    let mut largest = 0.0f32;
    for cell in errors.iter().flat_map(|row| row.iter().skip(1)) {
        let percent = cell.rsplit(", ").next().unwrap_or_default().trim_end_matches(" %");
        largest = largest.max(percent.parse().map_err(|_| format!("{cell}: not an error"))?);
    }
    let [m0, m3, m4, rv] =
        [column("M0")?, column("M3")?, column("M4F")?, column("RV32")?].map(|column| column.join(", "));
    writeln!(
        out,
        "pub(crate) const {name}: Constants<{count}> = Constants {{ of: [[{m0}], [{m3}], [{m4}], [{rv}]], error: {largest:?} }};"
    )?;
    Ok(())
}

fn chip(speed: &str, growth: &str, [key, name, cycles]: [&str; 3], out: &mut String) -> Result<()> {
    // Chip, core, clock, flash, fastest SPI, RAM, error.
    let cells = row(section(speed, "## Frames per second")?, name)?;
    let [_, core, clock, _, spi, ram, error] = cells[..] else { return Err("not seven columns".into()) };
    let column = match core {
        "M0" | "M0+" => 0,
        "M3" => 1,
        "M4" | "M33" => 2,
        _ => return Err(format!("the core {core} has no constants").into()),
    };
    let per = row(section(growth, "## Cycles per instruction")?, cycles)?;
    let per: Vec<String> = per.iter().skip(1).map(|cell| number(cell)).collect::<Result<_>>()?;
    let [clock, spi, ram] = [number(clock)?, number(spi)?, number(ram)?];
    writeln!(
        out,
        "    Chip {{ key: {key:?}, name: {name:?}, core: {core:?}, column: {column}, clock: {clock}, spi: {spi}, ram: {ram}, error: {error:?}, cycles: [{}], range: None }},",
        per.join(", ")
    )?;
    Ok(())
}

/// What follows a heading, to the next one.
fn section<'a>(page: &'a str, heading: &str) -> Result<&'a str> {
    let start = page.find(&format!("\n{heading}\n")).ok_or_else(|| format!("no heading {heading}"))?;
    let text = page.get(start + 1 + heading.len()..).unwrap_or_default();
    Ok(text.find("\n#").map_or(text, |end| text.get(..end).unwrap_or_default()))
}

/// The rows of the tables in a text, as cells.
fn rows(text: &str) -> impl Iterator<Item = Vec<&str>> {
    let rows = text.lines().filter(|line| line.starts_with('|'));
    rows.map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
}

/// The row whose first cell is this.
fn row<'a>(text: &'a str, first: &str) -> Result<Vec<&'a str>> {
    let found = rows(text).find(|row| row.first() == Some(&first));
    found.ok_or_else(|| format!("no row {first}").into())
}

/// A number as Rust writes it: `15 052` is 15052.0.
fn number(cell: &str) -> Result<String> {
    let digits: String = cell.split_whitespace().collect();
    let number: f64 = digits.parse().map_err(|_| format!("{cell:?} is not a number"))?;
    Ok(format!("{number:?}"))
}
