//! What a frame costs on a chip: RAM and flash by the library's own lengths and measured images, time by the formula of
//! docs/growth.md.

use crate::chip::{self, Chip, CHIPS};
use crate::choice::{Choice, Order, Style};
use crate::display::Format;
use crate::figures::{Code, DEPTH_PIXELS_CODE, FRAMING_CODE, PLACING};
use crate::json::{list, number, object_of_numbers, text};
use crate::lens::Lens;
use crate::refused;
use crate::texture::{Coordinates, TextureImage};
use crate::ways::{faces, hidden_lines, lines};
use pinhole::{camera::Projected, Affine};
use pinhole_apps_support::work::{Frame, Place};
use pinhole_import::ImportedMesh;

/// A way to draw.
pub(crate) struct Way {
    pub(crate) name: String,
    /// Bytes of RAM: vertex cache, bins, pixels, depths, what smooth edges take whatever the mesh.
    pub(crate) ram: [usize; 5],
    pub(crate) code: Code,
    /// The instructions on the four cores, and their largest error in percent.
    pub(crate) time: ([f64; 4], f32),
    /// The index into [`Chip::cycles`], or [`LARGE`].
    pub(crate) kind: usize,
    /// The number of bands in a frame, which are sent one after the other.
    pub(crate) bands: u32,
    /// The number of rows of a band; `None` in one piece.
    pub(crate) rows: Option<u32>,
    pub(crate) order: Order,
    /// Why not every model can be drawn so.
    pub(crate) note: &'static str,
}

/// The largest difference between the stated flash and that of linked firmware, in percent: `apps/planner/sizes` compares them,
/// and finds at most 8.3, and `apps/planner/zips` in firmware 10.1.
const FLASH_ERROR: u32 = 12;

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
    let creases = choice.creases(model);
    let place: Place<'_> = &|mesh| camera.place(mesh, &model_to_world);
    let frame = Frame::new(&mesh, choice.size, place, &is_linear, creases);
    let ways = match choice.style {
        Style::Wireframe => lines(&mesh, choice, &frame),
        Style::HiddenLine => hidden_lines(&mesh, choice, &frame),
        Style::Flat | Style::Gouraud | Style::Textured => faces(&mesh, choice, &frame),
    };
    let chip = &chip::stated(choice.chip, choice);
    let spi = |chip: &Chip| if choice.spi == 0 { chip.spi } else { chip.spi.min(choice.spi.into()) };
    let pixels = match choice.wire {
        0 => choice.format.bytes(choice.size.width, choice.size.height),
        bits => (choice.size.width * choice.size.height * bits).div_ceil(8) as usize,
    };
    let data = model.flash_bytes() + materials(model, choice, image);
    let is_chosen = |way: &Way| way.rows == choice.bands() && way.order == choice.order();
    let chosen = ways.iter().position(is_chosen).or(Some(0));
    let bytes = [pixels, data];
    // The chosen way on each chip, in the order of the menu.
    let chips = chosen.and_then(|at| ways.get(at)).into_iter().flat_map(|way| {
        CHIPS.iter().map(move |chip| {
            let chip = chip::stated(chip.key, choice);
            way.on(&chip, spi(&chip), bytes, true)
        })
    });
    let ways = ways.iter().enumerate().map(|(at, way)| way.on(chip, spi(chip), bytes, chosen == Some(at)));
    let is_in_few_bits = choice.format != Format::Rgb565 && !choice.style.is_of_lines();
    let numbers = [
        ("spi", spi(chip)),
        ("inRam", u8::from(chip.is_in_ram()).into()),
        ("estimate", u8::from(chip.is_estimate).into()),
        ("mesh", data as f64),
        ("cyclesError", chip.cycles_error(is_in_few_bits).into()),
        ("flashError", FLASH_ERROR.into()),
        ("exact", u8::from(choice.format == Format::Rgb565).into()),
    ];
    let texts = [
        ("chip", text(chip.name)),
        ("core", text(chip.core)),
        ("error", text(chip.error)),
        ("ways", list(ways)),
        ("chips", list(chips)),
    ];
    Ok(object_of_numbers(&texts, &numbers))
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
        let [_, _, pixels, ..] = self.ram;
        let [drawn, placing] =
            [self.time.0, PLACING].map(|of| of.get(chip.column).copied().unwrap_or_default());
        let instructions = drawn + placing;
        let cycles = |per: &[f64; 3]| instructions * chip.of_kind(per, self.kind);
        let in_ms = |per: &[f64; 3]| cycles(per) / (chip.clock * 1000.0);
        let drawing = in_ms(&chip.cycles);
        let range = chip.range.iter().flatten().map(|per| number(in_ms(per)));
        let flag = |is_so: bool| f64::from(u8::from(is_so));
        let numbers = [
            ("ram", ram as f64),
            ("beside", self.beside(chip)),
            ("stack", stack),
            ("flash", flash),
            ("bytes", bytes),
            ("bus", bus),
            ("clock", chip.clock),
            ("room", chip.ram * 1024.0),
            ("rom", chip.flash * 1024.0),
            ("fits", flag(self.fits(chip, 0.0))),
            ("fitsTwice", flag(self.fits(chip, pixels as f64))),
            ("fitsFlash", flag(flash < chip.flash * 1024.0)),
            ("chosen", flag(is_chosen)),
            ("instructions", instructions),
            ("cycles", cycles(&chip.cycles)),
            ("drawing", drawing),
            ("error", self.time.1.max(LEAST_ERROR).into()),
            ("blocking", 1000.0 / (drawing + bus)),
            ("dma", 1000.0 / drawing.max(bus)),
            // 0 if there are no bands.
            ("rows", self.rows.unwrap_or_default().into()),
        ];
        let texts = [
            ("name", text(&self.name)),
            ("note", text(self.note)),
            ("order", text(Order::ALL[self.order as usize].0)),
            ("parts", list(self.ram.map(|bytes| number(bytes as f64)))),
            ("range", list(range)),
            ("limit", text(if drawing > bus { "CPU" } else { "bus" })),
        ];
        object_of_numbers(&texts, &numbers)
    }
}
