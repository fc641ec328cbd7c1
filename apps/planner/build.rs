//! Figures for the planner, from the data that `tools/bench/run` writes into `docs/data`: `growth.json` has the cost of a vertex, a
//! face, a row and a pixel, `chips.json` the chips and the cycles of an instruction, `footprint.json` the flash of code. Also the
//! model of the templates, in fewer bytes than its file.

use pinhole_apps_support::work::terms;
use serde_json::Value;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// The ways to draw, by their names in the data. Here they are in capitals.
const WAYS: &str = "lines faces depth bands line-bands hidden-bands smooth-bands dithered-bands smooth-dithered-bands smooth-edges textured-bands \
                    plain-bands painted painted-bands";

const CORES: [&str; 4] = ["M0", "M3", "M4F", "RV32"];

/// The chips' names in choices and in the data, and their flash in KB: of an RP2040 that of a Pico, of an RP2350 that of a Pico 2.
const CHIPS: [(&str, &str, u32); 7] = [
    ("rp2040", "RP2040, code in flash", 2048),
    ("rp2040-ram", "RP2040, code in RAM", 2048),
    ("rp2350-ram", "RP2350, code in RAM", 4096),
    ("stm32f030", "STM32F030xC", 256),
    ("stm32f103", "STM32F103xB", 128),
    ("stm32f411", "STM32F411xE", 512),
    ("nrf52840", "nRF52840", 1024),
];

/// Images, by their names in the data. Here they are in capitals, with `_CODE` behind.
const IMAGES: &str = "framing wireframe_pixels wireframe_bands hidden_bands picture depth_picture solid_bands depth_bands depth_pixels smooth_edges \
                      gouraud_pixels flat_dither_pixels dither_pixels textured_bands textured_pixels \
                      painter painter_bands";

/// The targets of the cores. Code for an M4F is as that for an M3.
const TARGETS: [&str; 4] =
    ["thumbv6m-none-eabi", "thumbv7m-none-eabi", "thumbv7m-none-eabi", "riscv32imc-unknown-none-elf"];

fn main() -> Result<()> {
    let docs = Path::new(&std::env::var("CARGO_MANIFEST_DIR")?).join("../../docs");
    let mut out = String::new();
    growth(&read(&docs, "growth")?, &mut out)?;
    chips(&read(&docs, "chips")?, &mut out)?;
    let footprint = read(&docs, "footprint")?;
    for image in IMAGES.split(' ') {
        let of = |column: &str| -> Result<String> {
            let bytes = TARGETS.map(|target| {
                let found = row(&footprint, &[("image", image), ("target", target), ("level", "3")])?;
                Ok::<_, Box<dyn Error>>(found[column].as_i64().ok_or("no number")?.to_string())
            });
            Ok(bytes.into_iter().collect::<Result<Vec<_>>>()?.join(", "))
        };
        let [flash, stack] = [of("flash")?, of("stack")?];
        let name = image.to_uppercase();
        writeln!(out, "pub(crate) const {name}_CODE: Code = Code {{ flash: [{flash}], stack: [{stack}] }};")?;
    }
    let folder = std::env::var("OUT_DIR")?;
    std::fs::write(Path::new(&folder).join("figures.rs"), out)?;
    let model = docs.join("../boards/common/all/model.stl");
    println!("cargo::rerun-if-changed={}", model.display());
    std::fs::write(Path::new(&folder).join("gear.rs"), gear(&std::fs::read(&model)?)?)?;
    Ok(())
}

/// The rows of a file of data.
fn read(docs: &Path, name: &str) -> Result<Vec<Value>> {
    let file = docs.join("data").join(name).with_extension("json");
    println!("cargo::rerun-if-changed={}", file.display());
    let text = std::fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()))?;
    let parsed: Value = serde_json::from_str(&text).map_err(|e| format!("{}: {e}", file.display()))?;
    Ok(parsed["rows"].as_array().ok_or("no rows")?.clone())
}

/// The row with these values.
fn row<'a>(rows: &'a [Value], values: &[(&str, &str)]) -> Result<&'a Value> {
    let found = rows.iter().find(|row| values.iter().all(|(column, value)| row[*column] == *value));
    found.ok_or_else(|| format!("docs/data: no row {values:?}").into())
}

fn numbers(list: &Value) -> Result<Vec<f64>> {
    let numbers = list.as_array().ok_or("no list")?.iter();
    numbers.map(|number| number.as_f64().ok_or_else(|| format!("{number} is no number").into())).collect()
}

/// The largest error of the formula in linked firmware, in percent, where it is larger than in the cases of docs/data/growth.json:
/// `apps/planner/sizes --times` finds them.
const IN_FIRMWARE: [(&str, f64); 2] = [("smooth-bands", 31.0), ("painted", 14.0)];

/// The constants of each way to draw for the four cores, and the largest error of the formula, in percent, whether a case was fitted
/// or not; and the instructions of placing an object, and of turning its light.
fn growth(rows: &[Value], out: &mut String) -> Result<()> {
    for way in WAYS.split(' ') {
        let name = way.to_uppercase().replace('-', "_");
        let known: Vec<_> = terms(way).iter().map(|term| Value::from(term.0)).collect();
        let in_firmware = IN_FIRMWARE.iter().find(|(known, _)| *known == way);
        let (mut constants, mut largest) = (String::new(), in_firmware.map_or(0.0, |(_, error)| *error));
        for core in CORES {
            let row = row(rows, &[("way", way), ("core", core)])?;
            if row["names"] != Value::from(known.clone()) {
                return Err(
                    format!("{way}: constants of {}, where {known:?} are counted", row["names"]).into()
                );
            }
            write!(constants, "&{:?}, ", numbers(&row["constants"])?)?;
            for errors in ["mean_and_largest_error_in_the_fit", "mean_and_largest_error_elsewhere"] {
                largest = largest.max(*numbers(&row[errors])?.get(1).ok_or("no largest error")?);
            }
        }
        writeln!(
            out,
            "pub(crate) const {name}: Constants = Constants {{ way: {way:?}, of: [{constants}], error: {largest:?} }};"
        )?;
    }
    for (name, at) in [("PLACING", 0), ("LIGHTING", 1)] {
        let of = CORES.map(|core| -> Result<f64> {
            let constants = numbers(&row(rows, &[("way", "placing"), ("core", core)])?["constants"])?;
            Ok(*constants.get(at).ok_or("two constants")?)
        });
        let figures = of.into_iter().collect::<Result<Vec<_>>>()?;
        writeln!(out, "pub(crate) const {name}: [f64; 4] = {figures:?};")?;
    }
    Ok(())
}

/// The chips, and the cycles of an instruction of an ESP32-C3: the least, the likely ones, and the most.
fn chips(rows: &[Value], out: &mut String) -> Result<()> {
    writeln!(out, "pub(crate) const MODELLED: [Chip; {}] = [", CHIPS.len())?;
    for (key, name, flash) in CHIPS {
        let row = row(rows, &[("chip", name)])?;
        let core = &row["core"];
        let column = match core.as_str() {
            Some("M0" | "M0+") => 0,
            Some("M3") => 1,
            Some("M4" | "M33") => 2,
            _ => return Err(format!("the core {core} has no constants").into()),
        };
        let [clock, spi, ram] =
            ["mhz", "spi_mhz", "ram_kb"].map(|column| row[column].as_f64().unwrap_or_default());
        let (error, cycles) = (&row["error"], numbers(&row["cycles"])?);
        writeln!(
            out,
            "    Chip {{ key: {key:?}, name: {name:?}, core: {core}, column: {column}, clock: {clock:?}, spi: {spi:?}, ram: {ram:?}, flash: {flash}.0, error: {error}, is_estimate: false, cycles: {cycles:?}, range: None }},"
        )?;
    }
    writeln!(out, "];")?;
    let row = row(rows, &[("chip", "ESP32-C3, code in flash")])?;
    let cycles = ["least", "cycles", "most"].map(|column| numbers(&row[column]));
    let cycles = cycles.into_iter().collect::<Result<Vec<_>>>()?;
    writeln!(out, "pub(crate) const ESP32C3_CYCLES: [[f64; 3]; 3] = {cycles:?};")?;
    Ok(())
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
