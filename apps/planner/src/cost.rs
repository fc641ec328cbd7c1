//! What a frame costs on a chip: RAM and flash by the library's own lengths and measured images, time by the formula of
//! docs/growth.md.

use crate::choice::{Choice, Style};
use crate::display::Format;
use crate::json::{list, object, text};
use crate::lens::Lens;
use crate::texture::{Coordinates, TextureImage};
use crate::work::{hidden_in_bands, FaceWork, LineWork};
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{Affine, Mesh, Painter, Projected, ScreenVertex};
use pinhole_import::ImportedMesh;

/// Instructions per vertex, face and so on, on the cores M0, M3, M4F and RV32, and the largest error of their sum in percent.
pub(crate) struct Constants<const N: usize> {
    of: [[f32; N]; 4],
    error: f32,
}

/// The size of code in bytes on the cores M0, M3, M4F and RV32, at opt-level 3. An M4F has the figures of an M3.
#[derive(Clone, Copy)]
pub(crate) struct Code {
    flash: [i32; 4],
    stack: [i32; 4],
}

/// A microcontroller.
pub(crate) struct Chip {
    /// Its name in a choice.
    pub(crate) key: &'static str,
    pub(crate) name: &'static str,
    core: &'static str,
    /// The index of its core in [`Constants`].
    column: usize,
    /// The clock in MHz.
    clock: f64,
    /// The clock of the fastest SPI in MHz.
    spi: f64,
    /// RAM in KB.
    ram: f64,
    error: &'static str,
    /// Cycles per instruction: for lines, faces, faces with depth.
    cycles: [f64; 3],
    /// The least and the most cycles per instruction, if not all of the core's rules are known.
    range: Option<[[f64; 3]; 2]>,
}

impl Chip {
    /// The cycles per instruction for a kind of drawing: `cycles` is the chip's own, or a bound of its range.
    fn of_kind(&self, cycles: &[f64; 3], kind: usize) -> f64 {
        match (self.key, kind) {
            ("rp2040", LARGE) => LARGE_CYCLES,
            _ => cycles.get(kind.min(2)).copied().unwrap_or_default(),
        }
    }

    /// The largest difference between the stated cycles per instruction and those of linked firmware, in percent.
    /// `apps/planner/sizes --times` compares them, and finds more than half of this.
    fn cycles_error(&self) -> u32 {
        match self.key {
            "esp32c3" => 40,
            "rp2040" => 30,
            "stm32f411" | "nrf52840" => 20,
            "stm32f103" => 15,
            "stm32f030" => 10,
            _ => 12,
        }
    }
}

include!(concat!(env!("OUT_DIR"), "/figures.rs"));

const ESP32C3: Chip = Chip {
    key: "esp32c3",
    name: "ESP32-C3, code in flash",
    core: "RV32IMC",
    column: 3,
    clock: 160.0,
    spi: 80.0,
    // 400 KB, of which 16 are the cache.
    ram: 384.0,
    error: "a range, as products of two words, divisions and stores in a row were not measured on it",
    cycles: ESP32C3_CYCLES[1],
    range: Some([ESP32C3_CYCLES[0], ESP32C3_CYCLES[2]]),
};

/// The chips that a choice may name, the usual one first.
pub(crate) const CHIPS: [Chip; MODELLED.len() + 1] = {
    let [a, b, c, d, e, f, g] = MODELLED;
    [a, b, c, d, e, f, g, ESP32C3]
};

/// A way to draw.
struct Way {
    name: String,
    /// Bytes of RAM: vertex cache, bins, pixels, depths.
    ram: [usize; 4],
    code: Code,
    /// The instructions on the four cores, and their largest error in percent.
    time: ([f64; 4], f32),
    /// The index into [`Chip::cycles`], or [`LARGE`].
    kind: usize,
    /// The number of bands in a frame, which are sent one after the other.
    bands: u32,
    /// The number of rows to choose for this way to draw, if the page can draw it.
    rows: Option<u32>,
    /// Why not every model can be drawn so.
    note: &'static str,
}

impl Code {
    /// This code plus the code that image `with` has and image `without` has not.
    const fn and(self, with: Self, without: Self) -> Self {
        let (mut sum, mut core) = (self, 0);
        while core < 4 {
            sum.flash[core] += with.flash[core] - without.flash[core];
            core += 1;
        }
        sum
    }
}

impl<const N: usize> Constants<N> {
    fn time(&self, counts: &[f64; N]) -> ([f64; 4], f32) {
        let sum = |of: [f32; N]| of.iter().zip(counts).map(|(&one, count)| f64::from(one) * count).sum();
        (self.of.map(sum), self.error)
    }
}

/// The largest difference between the stated flash and that of linked firmware, in percent: `apps/planner/sizes` compares them,
/// and finds at most 8.3.
const FLASH_ERROR: u32 = 10;

/// The least error of instructions that the page states, in percent, even if the cases of docs/growth.md have less:
/// `apps/planner/sizes --times` finds up to 8.6.
const LEAST_ERROR: f32 = 10.0;

/// The kind of faces with depth whose code is larger than a cache of 16 KB.
const LARGE: usize = 3;
/// Cycles per instruction of such code on an RP2040, whose flash has a cache of 16 KB. `apps/planner/sizes --times` finds 2.03 to
/// 3.42.
const LARGE_CYCLES: f64 = 2.55;

/// The factor by which faces in fewer than 16 bits a pixel take more instructions, as they are drawn into a band as into any target: for
/// one colour a face, and for a shader. Linked firmware took 1.08 to 1.61 and 1.41 to 1.92 times as many.
const INDIRECT: [f64; 2] = [1.4, 1.6];
/// The error of such instructions, in percent: 29 was found.
const INDIRECT_ERROR: f32 = 35.0;

/// Bytes of the commands that set a band's window.
const COMMANDS: u32 = 11;

/// The bytes of `rows` rows of the display.
fn strip_bytes(choice: &Choice, rows: u32) -> usize {
    choice.format.bytes(choice.size.width, rows)
}

/// Bytes of flash for the colours of faces, if the model has materials and the style shows them, or for a texture and its
/// coordinates.
fn materials(model: &ImportedMesh, choice: &Choice, image: &TextureImage) -> usize {
    match choice.style {
        Style::Flat | Style::Gouraud => size_of_val(&model.palette[..]) + model.face_colors.len(),
        Style::Textured => {
            size_of_val(&model.texture_coords[..])
                + size_of_val(&model.texture_faces[..])
                + image.flash_bytes()
        }
        Style::Wireframe | Style::HiddenLine => 0,
    }
}

/// The costs of a choice as JSON. `image` is the texture of textured faces.
pub(crate) fn costs(model: &ImportedMesh, choice: &Choice, image: &TextureImage) -> Result<String, String> {
    let mesh = model.mesh().map_err(|e| e.to_string())?;
    let sphere = mesh.bounding_sphere();
    let lens = Lens::new(choice, &sphere);
    let camera = lens.camera(choice, &sphere)?;
    let instance = camera.place(&mesh, &Affine::rotation_y(choice.turn()));
    let strip = |rows| strip_bytes(choice, rows);
    let coords = Coordinates::of(model, &mesh)?;
    let is_linear = |face: usize, corners: [Projected; 3]| {
        if choice.style != Style::Textured {
            return true;
        }
        let [a, b, c] = corners.map(|seen| lens.distance(seen.depth));
        let (near, far) = (a.min(b).min(c), a.max(b).max(c));
        let unit = 2.0f64.powi(coords.exponent().into());
        image.sides().iter().enumerate().all(|(axis, &side)| {
            let [a, b, c] = coords.corners(face).map(|uv| f64::from(uv[axis]));
            let texels = (a.max(b).max(c) - a.min(b).min(c)) * unit * side as f64;
            // The error that the library permits for texture coordinates, in texels.
            texels * (far - near) / (4.0 * near) < 0.25
        })
    };
    let work = || FaceWork::new(&instance, choice.size, &is_linear);
    let ways = match choice.style {
        Style::Wireframe => lines(&mesh, choice, &LineWork::new(&instance, choice.size, None), &strip),
        Style::HiddenLine => {
            let faces = work();
            let lines = LineWork::new(&instance, choice.size, Some(&faces));
            hidden_lines(&mesh, choice, &faces, &lines, &strip)
        }
        Style::Flat | Style::Gouraud | Style::Textured => faces(&mesh, choice, &work(), &strip),
    };
    let chip = CHIPS.iter().find(|chip| chip.key == choice.chip).unwrap_or(&CHIPS[0]);
    let spi = if choice.spi == 0 { chip.spi } else { chip.spi.min(choice.spi.into()) };
    let frame = strip(choice.size.height);
    let data = model.flash_bytes() + materials(model, choice, image);
    // The first way with the chosen rows: with depth, if there are several.
    let chosen = ways.iter().position(|way| way.rows == Some(choice.rows));
    let ways = ways.iter().enumerate().map(|(at, way)| way.on(chip, spi, [frame, data], chosen == Some(at)));
    Ok(object([
        ("chip", text(chip.name)),
        ("core", text(chip.core)),
        ("clock", chip.clock.to_string()),
        ("spi", spi.to_string()),
        ("ram", (chip.ram * 1024.0).to_string()),
        ("error", text(chip.error)),
        ("mesh", data.to_string()),
        ("cyclesError", chip.cycles_error().to_string()),
        ("flashError", FLASH_ERROR.to_string()),
        ("exact", u8::from(choice.format == Format::Rgb565).to_string()),
        ("ways", list(ways)),
    ]))
}

fn cache(mesh: &Mesh<'_>) -> usize {
    mesh.cache_len() * size_of::<ScreenVertex>()
}

/// Bytes of a face in a painter: five indices of 16 bits, and a colour.
const PAINTED: usize = 12;

fn depths(choice: &Choice, rows: u32) -> usize {
    choice.size.width as usize * rows as usize * size_of::<u16>()
}

/// The heights of bands that are compared: the chosen one, and others.
fn heights(choice: &Choice) -> Vec<u32> {
    let mut rows = vec![8, 16, 48, choice.rows];
    rows.retain(|rows| *rows <= choice.size.height);
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// Whether a pixel is a number of whole bytes, into which the fastest code draws.
fn is_in_memory(choice: &Choice) -> bool {
    choice.format == Format::Rgb565
}

/// The code that draws into bands of a format. Images are measured in 16-bit colour; other formats draw into a band as into any
/// target.
fn into(choice: &Choice, code: Code) -> Code {
    if is_in_memory(choice) {
        code
    } else {
        code.and(TARGET_CODE, BANDS_CODE)
    }
}

/// The time of a frame of faces that take so many times the instructions of 16-bit colour, with a lamp, which is turned to the object
/// first.
fn lit((mut time, error): ([f64; 4], f32), times: f64) -> ([f64; 4], f32) {
    time.iter_mut().zip(LIGHTING).for_each(|(time, light)| *time = *time * times + light);
    (time, if times > 1.0 { error.max(INDIRECT_ERROR) } else { error })
}

fn faces(mesh: &Mesh<'_>, choice: &Choice, work: &FaceWork, strip: &dyn Fn(u32) -> usize) -> Vec<Way> {
    let whole = choice.size.height;
    let bins = mesh.face_bins_len() * size_of::<u16>();
    let shaded = |constants: &Constants<11>, rows| constants.time(&work.shaded_in_bands(rows));
    let is_plain = choice.style == Style::Flat && !choice.dithers();
    let (code, time): (Code, &dyn Fn(u32) -> ([f64; 4], f32)) = match (choice.style, choice.dithers()) {
        (Style::Textured, _) => {
            (TEXTURED_BANDS_CODE, &|rows| TEXTURED_BANDS.time(&work.textured_in_bands(rows)))
        }
        (Style::Gouraud, true) => (SMOOTH_DITHERED_BANDS_CODE, &|rows| shaded(&SMOOTH_DITHERED_BANDS, rows)),
        (Style::Gouraud, false) => (SMOOTH_BANDS_CODE, &|rows| shaded(&SMOOTH_BANDS, rows)),
        (_, true) => (DITHERED_BANDS_CODE, &|rows| shaded(&DITHERED_BANDS, rows)),
        (_, false) => (BANDS_CODE, &|rows| BANDS.time(&work.in_bands(rows))),
    };
    let times = if is_in_memory(choice) { 1.0 } else { INDIRECT[usize::from(!is_plain)] };
    let way = |name: &str, ram: [usize; 4], code, time, kind, rows: Option<u32>, note| Way {
        name: rows.map_or(name.into(), |rows| format!("bands of {rows} rows, {name}")),
        ram,
        code,
        time: lit(time, times),
        kind,
        bands: rows.map_or(1, |rows| whole.div_ceil(rows)),
        rows,
        note,
    };
    let in_bands = |rows: u32| {
        let ram = [cache(mesh), bins, strip(rows), depths(choice, rows)];
        // Code for flat faces has neither smooth shading nor textures.
        let kind = if choice.style == Style::Flat { 2 } else { LARGE };
        way("with depth", ram, into(choice, code), time(rows), kind, Some(rows), "")
    };
    let mut ways: Vec<Way> = heights(choice).into_iter().map(in_bands).collect();
    if !(is_plain && is_in_memory(choice)) {
        return ways;
    }
    // Room for all faces, because another view may show more of them.
    let painted = size_of::<Painter<Rgb565, 0, 0>>() + PAINTED * mesh.faces().len();
    let (small, rows) = ("small faces that do not pierce each other", choice.rows);
    let ram = [cache(mesh), painted, strip(rows), 0];
    let time = PAINTED_BANDS.time(&work.painted_in_bands(rows));
    ways.push(way("painter's order", ram, PAINTED_BANDS_CODE, time, 1, Some(rows), small));
    let (convex, ram) = ("one convex object only", [cache(mesh), bins, strip(rows), 0]);
    ways.push(way("without depth", ram, PLAIN_BANDS_CODE, shaded(&PLAIN_BANDS, rows), 1, Some(rows), convex));
    let ram = [cache(mesh), 0, strip(whole), depths(choice, whole)];
    let time = DEPTH.time(&work.whole());
    ways.push(way("a whole picture, with depth", ram, DEPTH_CODE, time, 2, None, ""));
    let ram = [cache(mesh), painted, strip(whole), 0];
    let time = PAINTED_WHOLE.time(&work.painted());
    ways.push(way("a whole picture, painter's order", ram, PAINTED_CODE, time, 1, None, small));
    let (ram, time) = ([cache(mesh), 0, strip(whole), 0], FACES.time(&work.whole()));
    ways.push(way("a whole picture, without depth", ram, FACES_CODE, time, 1, None, convex));
    ways
}

fn lines(mesh: &Mesh<'_>, choice: &Choice, work: &LineWork, strip: &dyn Fn(u32) -> usize) -> Vec<Way> {
    let whole = choice.size.height;
    let bins = mesh.edge_bins_len() * size_of::<u16>();
    let in_bands = |rows: u32| Way {
        name: format!("lines in bands of {rows} rows"),
        ram: [cache(mesh), bins, strip(rows), 0],
        code: LINES_BANDS_CODE,
        time: LINE_BANDS.time(&work.in_bands(rows)),
        kind: 0,
        bands: whole.div_ceil(rows),
        rows: Some(rows),
        note: "",
    };
    let mut ways: Vec<Way> = heights(choice).into_iter().map(in_bands).collect();
    if is_in_memory(choice) {
        ways.push(Way {
            name: "lines in a whole picture".into(),
            ram: [cache(mesh), 0, strip(whole), 0],
            code: LINES_CODE,
            time: LINES.time(&work.whole()),
            kind: 0,
            bands: 1,
            rows: None,
            note: "",
        });
    }
    ways
}

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
        code: HIDDEN_BANDS_CODE,
        time: HIDDEN_BANDS.time(&hidden_in_bands(faces, lines, rows)),
        kind: LARGE,
        bands: choice.size.height.div_ceil(rows),
        rows: Some(rows),
        note: "",
    };
    heights(choice).into_iter().map(in_bands).collect()
}

impl Way {
    /// The costs on a chip whose SPI has so many MHz, of pixels and a mesh of so many bytes, as JSON: bytes, instructions, milliseconds and frames per second.
    fn on(&self, chip: &Chip, spi: f64, [frame, data]: [usize; 2], is_chosen: bool) -> String {
        let ram: usize = self.ram.iter().sum();
        let bytes = frame as f64 + f64::from(COMMANDS * self.bands);
        let bus = bytes * 8.0 / (spi * 1000.0); // ms

        // The templates' firmware also has the camera.
        let code = self.code.and(FRAMED_CODE, BANDS_CODE);
        let of = |bytes: [i32; 4]| bytes.get(chip.column).copied().unwrap_or_default();
        let stack = of(code.stack);
        let fits = ram as f64 + f64::from(stack) < chip.ram * 1024.0;
        let [drawn, placing] =
            [self.time.0, PLACING].map(|of| of.get(chip.column).copied().unwrap_or_default());
        let instructions = drawn + placing;
        let cycles = |per: &[f64; 3]| instructions * chip.of_kind(per, self.kind);
        let in_ms = |per: &[f64; 3]| cycles(per) / (chip.clock * 1000.0);
        let drawing = in_ms(&chip.cycles);
        let range = chip.range.iter().flatten().map(|per| format!("{:.2}", in_ms(per)));
        object([
            ("name", text(&self.name)),
            ("note", text(self.note)),
            ("ram", ram.to_string()),
            ("parts", list(self.ram.map(|bytes| bytes.to_string()))),
            ("stack", stack.to_string()),
            ("flash", (of(code.flash) as usize + data).to_string()), // not negative
            ("bytes", bytes.to_string()),
            ("bus", format!("{bus:.2}")),
            ("fits", u8::from(fits).to_string()),
            ("chosen", u8::from(is_chosen).to_string()),
            ("rows", self.rows.map_or("null".into(), |rows| rows.to_string())),
            ("instructions", format!("{instructions:.0}")),
            ("cycles", format!("{:.0}", cycles(&chip.cycles))),
            ("drawing", format!("{drawing:.2}")),
            ("range", list(range)),
            ("error", self.time.1.max(LEAST_ERROR).to_string()),
            ("blocking", format!("{:.1}", 1000.0 / (drawing + bus))),
            ("dma", format!("{:.1}", 1000.0 / drawing.max(bus))),
            ("limit", text(if drawing > bus { "CPU" } else { "bus" })),
        ])
    }
}

/// The chips by their names in choices, with descriptions, as JSON.
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
