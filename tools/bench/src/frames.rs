//! Whole frames, drawn at once: into memory, with depth for every pixel.

use crate::board::{println, Clock};
use crate::canvas::Canvas;
use crate::scene::{Model, Scene, BACKGROUND, LINE, SIZE};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{IntoStorage, Rgb565};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Corner, DepthBuffer, Lambert};

const PIXELS: usize = (SIZE * SIZE) as usize;
/// The most vertices of a scene.
const CORNERS: usize = 2892;

/// The scenes and what they are drawn as.
pub type Named = (&'static str, &'static Model);

/// Memory for a whole frame.
pub struct Memory {
    pixels: [Rgb565; PIXELS],
    depth: [u16; PIXELS],
    corners: [Corner; CORNERS],
}

impl Memory {
    pub const NEW: Self =
        Self { pixels: [BACKGROUND; PIXELS], depth: [0; PIXELS], corners: [Corner::EMPTY; CORNERS] };
}

/// Counts every scene's second frame and prints a line `scene,way,instructions,crc`. `frame` is one whole frame.
pub fn measure(
    way: &str,
    scenes: &[Named],
    memory: &mut Memory,
    frame: impl Fn(&Scene, &Lambert, &mut Memory),
) -> Option<()> {
    let mut clock = Clock::new()?;
    for (name, model) in scenes {
        let scene = Scene::new(model)?;
        let light = scene.light()?;
        let mut once = || frame(black_box(&scene), black_box(&light), black_box(memory));
        once();
        let instructions = clock.count(&mut once)?;
        let crc = crc32(memory.pixels.iter().flat_map(|pixel| pixel.into_storage().to_le_bytes()));
        println!("{name},{way},{instructions},{crc:08x}");
    }
    Some(())
}

/// What a frame costs before anything is drawn.
pub fn empty(_: &Scene, _: &Lambert, Memory { pixels, .. }: &mut Memory) {
    canvas(pixels);
}

/// The same, with depth.
pub fn empty_depth(_: &Scene, _: &Lambert, Memory { pixels, depth, .. }: &mut Memory) {
    canvas(pixels);
    black_box(DepthBuffer::new(area(), depth)).ok();
}

pub fn wireframe(scene: &Scene, _: &Lambert, Memory { pixels, corners, .. }: &mut Memory) {
    let Ok(statistics) = scene.place().wireframe(LINE, corners, &mut canvas(pixels));
    black_box(statistics);
}

pub fn solid(scene: &Scene, light: &Lambert, Memory { pixels, corners, .. }: &mut Memory) {
    let Ok(statistics) = scene.place().solid(scene.shade(light), corners, &mut canvas(pixels));
    black_box(statistics);
}

pub fn depth(scene: &Scene, light: &Lambert, Memory { pixels, depth, corners }: &mut Memory) {
    let Ok(mut depth) = DepthBuffer::new(area(), depth) else { return };
    let Ok(statistics) =
        scene.place().depth_tested(scene.shade(light), corners, &mut depth, &mut canvas(pixels));
    black_box(statistics);
}

fn area() -> Rectangle {
    Rectangle::new(Point::zero(), Size::new(SIZE, SIZE))
}

/// Cleared.
fn canvas(pixels: &mut [Rgb565]) -> Canvas<'_, Rgb565> {
    let mut canvas = Canvas::new(pixels, Size::new(SIZE, SIZE));
    let Ok(()) = canvas.clear(BACKGROUND);
    canvas
}

/// CRC-32 as in zip and PNG. Bit by bit: a table would be larger than the code.
pub(crate) fn crc32(bytes: impl Iterator<Item = u8>) -> u32 {
    !bytes.fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}
