//! What a frame costs on a chip: RAM and flash by the library's own lengths and measured images, time by the formula of
//! docs/growth.md.

use crate::choice::{Choice, Style};
use crate::display::Format;
use crate::json::{list, object, text};
use crate::lens::Lens;
use crate::work::{hidden_in_bands, FaceWork, LineWork};
use pinhole::{Affine, Mesh, ScreenVertex};
use pinhole_import::ImportedMesh;

/// Instructions for each thing that a frame has, on the cores M0, M3, M4F and RV32, and the largest error of their sum in percent.
pub(crate) struct Constants<const N: usize> {
    of: [[f64; N]; 4],
    error: f64,
}

/// Flash of the code, on two cores, at opt-level 3.
#[derive(Clone, Copy)]
pub(crate) struct Code {
    v7m: f64,
    v6m: f64,
}

/// A microcontroller.
pub(crate) struct Chip {
    /// Its name in a choice.
    pub(crate) key: &'static str,
    pub(crate) name: &'static str,
    core: &'static str,
    /// Of [`Constants`].
    column: usize,
    /// MHz.
    clock: f64,
    /// Of the fastest SPI, MHz.
    spi: f64,
    /// KB.
    ram: f64,
    error: &'static str,
    /// Cycles of an instruction: lines, faces, faces with depth.
    cycles: [f64; 3],
}

include!(concat!(env!("OUT_DIR"), "/figures.rs"));

/// A guess: no model of this core's timing has been compared with a chip. CoreMark at 2.55 for each MHz, as the maker states, takes
/// 392 000 cycles for what are some 290 000 instructions of RV32IMC, which were not counted here.
const ESP32C3: Chip = Chip {
    key: "esp32c3",
    name: "ESP32-C3",
    core: "RV32IMC",
    column: 3,
    clock: 160.0,
    spi: 80.0,
    // Of 400 KB, 16 are the cache.
    ram: 384.0,
    error: "perhaps 25 %: the cycles of an instruction are a guess by the maker's CoreMark, not measured",
    cycles: [1.35; 3],
};

/// The chips that a choice may name, the usual one first.
pub(crate) const CHIPS: [Chip; MODELLED.len() + 1] = {
    let [a, b, c, d, e, f, g] = MODELLED;
    [a, b, c, d, e, f, g, ESP32C3]
};

/// A way to draw.
struct Way {
    name: String,
    /// What it costs in bytes of RAM: vertex cache, bins, pixels, depths.
    ram: [usize; 4],
    code: Code,
    /// On the four cores; nothing where there is no formula.
    instructions: Option<[f64; 4]>,
    /// Percent.
    error: f64,
    /// Of [`Chip::cycles`].
    kind: usize,
    /// Bands of a frame, which are sent one after the other.
    bands: u32,
    /// The choice that draws so, if the page can.
    rows: Option<u32>,
    /// Why it is not for every model.
    note: &'static str,
}

impl Code {
    /// The flash of two images that have the code of a third one in common.
    fn with(self, other: Self, both: Self) -> Self {
        Self { v7m: self.v7m + other.v7m - both.v7m, v6m: self.v6m + other.v6m - both.v6m }
    }
}

impl<const N: usize> Constants<N> {
    fn instructions(&self, counts: &[f64; N]) -> [f64; 4] {
        self.of.map(|constants| constants.iter().zip(counts).map(|(constant, count)| constant * count).sum())
    }
}

/// Bytes of commands before a band: its window.
const COMMANDS: u32 = 11;

/// Bytes of rows of a display.
fn strip_bytes(choice: &Choice, rows: u32) -> usize {
    choice.format.bytes(choice.size.width, rows)
}

/// The costs of a choice, as JSON.
pub(crate) fn costs(model: &ImportedMesh, choice: &Choice) -> Result<String, String> {
    let mesh = model.mesh().map_err(|e| e.to_string())?;
    let sphere = mesh.bounding_sphere();
    let camera = Lens::new(choice, &sphere).camera(choice, &sphere)?;
    let instance = camera.place(&mesh, &Affine::rotation_y(choice.turn()));
    let strip = |rows| strip_bytes(choice, rows);
    let ways = match choice.style {
        Style::Wireframe => lines(&mesh, choice, &LineWork::new(&instance, choice.size, None), &strip),
        Style::HiddenLine => {
            let faces = FaceWork::new(&instance, choice.size);
            let lines = LineWork::new(&instance, choice.size, Some(&faces));
            hidden_lines(&mesh, choice, &faces, &lines, &strip)
        }
        Style::Flat | Style::Gouraud | Style::Textured => {
            faces(&mesh, choice, &FaceWork::new(&instance, choice.size), &strip)
        }
    };
    let chip = CHIPS.iter().find(|chip| chip.key == choice.chip).unwrap_or(&CHIPS[0]);
    let frame = strip(choice.size.height);
    let ways = ways.iter().map(|way| way.on(chip, choice, frame, model.flash_bytes()));
    Ok(object([
        ("chip", text(chip.name)),
        ("core", text(chip.core)),
        ("clock", chip.clock.to_string()),
        ("spi", chip.spi.to_string()),
        ("ram", (chip.ram * 1024.0).to_string()),
        ("error", text(chip.error)),
        ("mesh", model.flash_bytes().to_string()),
        ("exact", u8::from(choice.format == Format::Rgb565).to_string()),
        ("ways", list(ways)),
    ]))
}

fn cache(mesh: &Mesh<'_>) -> usize {
    mesh.cache_len() * size_of::<ScreenVertex>()
}

fn depths(choice: &Choice, rows: u32) -> usize {
    choice.size.width as usize * rows as usize * size_of::<u16>()
}

/// The heights of bands that are compared: that of the choice, and others.
fn heights(choice: &Choice) -> Vec<u32> {
    let mut rows = vec![8, 16, 48, choice.rows];
    rows.retain(|rows| *rows <= choice.size.height);
    rows.sort_unstable();
    rows.dedup();
    rows
}

fn faces(mesh: &Mesh<'_>, choice: &Choice, work: &FaceWork, strip: &dyn Fn(u32) -> usize) -> Vec<Way> {
    let whole = choice.size.height;
    let bins = mesh.face_bins_len() * size_of::<u16>();
    let is_textured = choice.style == Style::Textured;
    let is_plain = choice.style == Style::Flat && !choice.dithers();
    let shaded = |constants: Constants<11>, rows| {
        (constants.instructions(&work.shaded_in_bands(rows)), constants.error)
    };
    let (code, time): (Code, &dyn Fn(u32) -> ([f64; 4], f64)) = match (choice.style, choice.dithers()) {
        (Style::Gouraud, true) => (DITHERED_BANDS_CODE, &|rows| shaded(SMOOTH_DITHERED_BANDS, rows)),
        (Style::Gouraud, false) => (SMOOTH_BANDS_CODE, &|rows| shaded(SMOOTH_BANDS, rows)),
        (_, true) => (DITHERED_BANDS_CODE, &|rows| shaded(DITHERED_BANDS, rows)),
        (_, false) => (BANDS_CODE, &|rows| (BANDS.instructions(&work.in_bands(rows)), BANDS.error)),
    };
    let in_bands = |rows: u32| Way {
        name: format!("bands of {rows} rows, with depth"),
        ram: [cache(mesh), bins, strip(rows), depths(choice, rows)],
        code,
        instructions: (!is_textured).then(|| time(rows).0),
        error: time(rows).1,
        kind: 2,
        bands: whole.div_ceil(rows),
        rows: Some(rows),
        note: if is_textured { "no estimate: textures take longer than flat faces" } else { "" },
    };
    let mut ways: Vec<Way> = heights(choice).into_iter().map(in_bands).collect();
    ways.push(Way {
        name: "a whole picture, with depth".into(),
        ram: [cache(mesh), 0, strip(whole), depths(choice, whole)],
        code: DEPTH_CODE,
        instructions: is_plain.then(|| DEPTH.instructions(&work.whole())),
        error: DEPTH.error,
        kind: 2,
        bands: 1,
        rows: None,
        note: "",
    });
    ways.push(Way {
        name: "a whole picture, without depth".into(),
        ram: [cache(mesh), 0, strip(whole), 0],
        code: FACES_CODE,
        instructions: is_plain.then(|| FACES.instructions(&work.whole())),
        error: FACES.error,
        kind: 1,
        bands: 1,
        rows: None,
        note: "one convex object only",
    });
    ways
}

fn lines(mesh: &Mesh<'_>, choice: &Choice, work: &LineWork, strip: &dyn Fn(u32) -> usize) -> Vec<Way> {
    let whole = choice.size.height;
    let bins = mesh.edge_bins_len() * size_of::<u16>();
    let in_bands = |rows: u32| Way {
        name: format!("lines in bands of {rows} rows"),
        ram: [cache(mesh), bins, strip(rows), 0],
        code: LINES_BANDS_CODE,
        instructions: Some(LINE_BANDS.instructions(&work.in_bands(rows))),
        error: LINE_BANDS.error,
        kind: 0,
        bands: whole.div_ceil(rows),
        rows: Some(rows),
        note: "",
    };
    let mut ways: Vec<Way> = heights(choice).into_iter().map(in_bands).collect();
    ways.push(Way {
        name: "lines in a whole picture".into(),
        ram: [cache(mesh), 0, strip(whole), 0],
        code: LINES_CODE,
        instructions: Some(LINES.instructions(&work.whole())),
        error: LINES.error,
        kind: 0,
        bands: 1,
        rows: None,
        note: "",
    });
    ways
}

/// No image draws hidden lines alone: the code is that of faces with depth and of lines, without what they share.
fn hidden_lines(
    mesh: &Mesh<'_>,
    choice: &Choice,
    faces: &FaceWork,
    lines: &LineWork,
    strip: &dyn Fn(u32) -> usize,
) -> Vec<Way> {
    let bins = (mesh.face_bins_len() + mesh.edge_bins_len()) * size_of::<u16>();
    let in_bands = |rows: u32| Way {
        name: format!("hidden lines in bands of {rows} rows"),
        ram: [cache(mesh), bins, strip(rows), depths(choice, rows)],
        code: BANDS_CODE.with(LINES_BANDS_CODE, PLACED_CODE),
        instructions: Some(HIDDEN_BANDS.instructions(&hidden_in_bands(faces, lines, rows))),
        error: HIDDEN_BANDS.error,
        kind: 2,
        bands: choice.size.height.div_ceil(rows),
        rows: Some(rows),
        note: "flash of faces and lines together",
    };
    heights(choice).into_iter().map(in_bands).collect()
}

impl Way {
    /// The costs on a chip, as JSON: bytes, instructions, milliseconds and frames per second.
    fn on(&self, chip: &Chip, choice: &Choice, frame: usize, mesh: usize) -> String {
        // No image is measured for RISC-V: its code, compressed as that of a Cortex-M0 is, is estimated by that.
        let code = if matches!(chip.column, 0 | 3) { self.code.v6m } else { self.code.v7m };
        let ram: usize = self.ram.iter().sum();
        let bytes = frame as f64 + f64::from(COMMANDS * self.bands);
        let bus = bytes * 8.0 / (chip.spi * 1000.0); // ms
        let mut parts = vec![
            ("name", text(&self.name)),
            ("note", text(self.note)),
            ("ram", ram.to_string()),
            ("parts", list(self.ram.map(|bytes| bytes.to_string()))),
            ("flash", (code + mesh as f64).to_string()),
            ("bytes", bytes.to_string()),
            ("bus", format!("{bus:.2}")),
            ("fits", u8::from((ram as f64) < chip.ram * 1024.0).to_string()),
            ("chosen", u8::from(self.rows == Some(choice.rows)).to_string()),
            ("rows", self.rows.map_or("null".into(), |rows| rows.to_string())),
        ];
        if let Some(instructions) = self.instructions.as_ref().and_then(|of| of.get(chip.column)) {
            let cycles = instructions * chip.cycles.get(self.kind).copied().unwrap_or_default();
            let drawing = cycles / (chip.clock * 1000.0); // ms
            parts.extend([
                ("instructions", format!("{instructions:.0}")),
                ("cycles", format!("{cycles:.0}")),
                ("drawing", format!("{drawing:.2}")),
                ("error", self.error.to_string()),
                ("blocking", format!("{:.1}", 1000.0 / (drawing + bus))),
                ("dma", format!("{:.1}", 1000.0 / drawing.max(bus))),
                ("limit", text(if drawing > bus { "CPU" } else { "bus" })),
            ]);
        }
        object(parts)
    }
}

/// The chips by the names of choices, and in words, as JSON.
pub(crate) fn chips() -> String {
    list(CHIPS.iter().map(|chip| object([("key", text(chip.key)), ("name", text(chip.name))])))
}

/// A chip of this name.
pub(crate) fn named(key: &str) -> Result<&'static str, String> {
    CHIPS.iter().find(|chip| chip.key == key).map(|chip| chip.key).ok_or_else(|| {
        let keys: Vec<_> = CHIPS.iter().map(|chip| chip.key).collect();
        format!("none of {}", keys.join(", "))
    })
}
