//! What a frame costs on a chip: RAM and flash by the library's own lengths and measured images, time by the formula of
//! docs/growth.md.

use crate::chip::{Chip, CHIPS};
use crate::choice::{Choice, Style};
use crate::display::Format;
use crate::figures::{Code, DEPTH_PIXELS_CODE, FRAMING_CODE, PLACING};
use crate::json::{list, object, text};
use crate::lens::Lens;
use crate::refused;
use crate::texture::{Coordinates, TextureImage};
use crate::ways::{faces, hidden_lines, lines, strip};
use pinhole::{camera::Projected, Affine};
use pinhole_apps_support::work::Frame;
use pinhole_import::ImportedMesh;

/// A way to draw.
pub(crate) struct Way {
    pub(crate) name: String,
    /// Bytes of RAM: vertex cache, bins, pixels, depths.
    pub(crate) ram: [usize; 4],
    pub(crate) code: Code,
    /// The instructions on the four cores, and their largest error in percent.
    pub(crate) time: ([f64; 4], f32),
    /// The index into [`Chip::cycles`], or [`LARGE`].
    pub(crate) kind: usize,
    /// The number of bands in a frame, which are sent one after the other.
    pub(crate) bands: u32,
    /// The number of rows to choose for this way to draw, if the page can draw it.
    pub(crate) rows: Option<u32>,
    /// Why not every model can be drawn so.
    pub(crate) note: &'static str,
}

/// The largest difference between the stated flash and that of linked firmware, in percent: `apps/planner/sizes` compares them,
/// and finds at most 8.3.
const FLASH_ERROR: u32 = 10;

/// The least error of instructions that the page states, in percent, even if the cases of docs/growth.md have less:
/// `apps/planner/sizes --times` finds up to 8.6.
const LEAST_ERROR: f32 = 10.0;

/// Bytes of the commands that set a band's window.
const COMMANDS: u32 = 11;

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
    let mesh = model.mesh().map_err(refused::mesh)?;
    let sphere = mesh.bounding_sphere();
    let lens = Lens::new(choice, &sphere);
    let camera = lens.camera(choice, &sphere)?;
    let model_to_world = Affine::rotation_y(choice.turn());
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
    let frame = Frame::new(&mesh, choice.size, &|mesh| camera.place(mesh, &model_to_world), &is_linear);
    let ways = match choice.style {
        Style::Wireframe => lines(&mesh, choice, &frame),
        Style::HiddenLine => hidden_lines(&mesh, choice, &frame),
        Style::Flat | Style::Gouraud | Style::Textured => faces(&mesh, choice, &frame),
    };
    let chip = CHIPS.iter().find(|chip| chip.key == choice.chip).unwrap_or(&CHIPS[0]);
    let spi = if choice.spi == 0 { chip.spi } else { chip.spi.min(choice.spi.into()) };
    let pixels = strip(choice, choice.size.height);
    let data = model.flash_bytes() + materials(model, choice, image);
    // The first way with the chosen rows: with depth, if there are several.
    let chosen = ways.iter().position(|way| way.rows == Some(choice.rows()));
    let ways = ways.iter().enumerate().map(|(at, way)| way.on(chip, spi, [pixels, data], chosen == Some(at)));
    let is_in_few_bits = choice.format != Format::Rgb565 && !choice.style.is_of_lines();
    Ok(object([
        ("chip", text(chip.name)),
        ("core", text(chip.core)),
        ("clock", chip.clock.to_string()),
        ("spi", spi.to_string()),
        ("ram", (chip.ram * 1024.0).to_string()),
        ("rom", (chip.flash() * 1024.0).to_string()),
        ("inRam", u8::from(chip.is_in_ram()).to_string()),
        ("error", text(chip.error)),
        ("mesh", data.to_string()),
        ("cyclesError", chip.cycles_error(is_in_few_bits).to_string()),
        ("flashError", FLASH_ERROR.to_string()),
        ("exact", u8::from(choice.format == Format::Rgb565).to_string()),
        ("ways", list(ways)),
    ]))
}

impl Way {
    /// The code, with the camera, which the templates' firmware has too: its bytes of flash and of stack.
    fn code_on(&self, chip: &Chip) -> [f64; 2] {
        let code = self.code.and(FRAMING_CODE, DEPTH_PIXELS_CODE);
        [code.flash, code.stack].map(|of| of.get(chip.column).copied().unwrap_or_default().into())
    }

    /// The bytes of RAM that a firmware needs beside the variables: the stack, and the code if it is copied to RAM.
    fn beside(&self, chip: &Chip) -> f64 {
        let [code, stack] = self.code_on(chip);
        stack + if chip.is_in_ram() { code } else { 0.0 }
    }

    /// Whether the RAM is large enough, with so many more bytes.
    fn fits(&self, chip: &Chip, more: f64) -> bool {
        let ram: usize = self.ram.iter().sum();
        ram as f64 + more + self.beside(chip) < chip.ram * 1024.0
    }

    /// The costs on a chip whose SPI has so many MHz, of pixels and a mesh of so many bytes, as JSON: bytes, instructions,
    /// milliseconds and frames per second.
    fn on(&self, chip: &Chip, spi: f64, [frame, data]: [usize; 2], is_chosen: bool) -> String {
        let ram: usize = self.ram.iter().sum();
        let bytes = frame as f64 + f64::from(COMMANDS * self.bands);
        let bus = bytes * 8.0 / (spi * 1000.0); // ms

        let [code, stack] = self.code_on(chip);
        let flash = code + data as f64;
        let [_, _, pixels, _] = self.ram;
        let [drawn, placing] =
            [self.time.0, PLACING].map(|of| of.get(chip.column).copied().unwrap_or_default());
        let instructions = drawn + placing;
        let cycles = |per: &[f64; 3]| instructions * chip.of_kind(per, self.kind);
        let in_ms = |per: &[f64; 3]| cycles(per) / (chip.clock * 1000.0);
        let drawing = in_ms(&chip.cycles);
        let range = chip.range.iter().flatten().map(|per| format!("{:.2}", in_ms(per)));
        let flag = |is_so: bool| u8::from(is_so).to_string();
        object([
            ("name", text(&self.name)),
            ("note", text(self.note)),
            ("ram", ram.to_string()),
            ("parts", list(self.ram.map(|bytes| bytes.to_string()))),
            ("beside", self.beside(chip).to_string()),
            ("stack", stack.to_string()),
            ("flash", flash.to_string()),
            ("bytes", bytes.to_string()),
            ("bus", format!("{bus:.2}")),
            ("fits", flag(self.fits(chip, 0.0))),
            ("fitsTwice", flag(self.fits(chip, pixels as f64))),
            ("fitsFlash", flag(flash < chip.flash() * 1024.0)),
            ("chosen", flag(is_chosen)),
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
