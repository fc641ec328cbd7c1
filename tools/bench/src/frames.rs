//! Whole frames drawn into memory, with a depth buffer for the whole frame.

use crate::measure::Display;
use crate::scene::{area, Scene, BACKGROUND, LINE, SIZE};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{DepthBuffer, Lambert, Picture, ScreenVertex};

const PIXELS: usize = (SIZE * SIZE) as usize;
/// The most vertices of a scene.
const CORNERS: usize = 2892;

/// Memory for a whole frame.
pub struct Memory {
    pub pixels: [Rgb565; PIXELS],
    pub depth: [u16; PIXELS],
    pub corners: [ScreenVertex; CORNERS],
}

impl Memory {
    pub const NEW: Self =
        Self { pixels: [BACKGROUND; PIXELS], depth: [0; PIXELS], corners: [ScreenVertex::EMPTY; CORNERS] };
}

/// Clears a picture and draws nothing.
pub fn empty(Memory { pixels, .. }: &mut Memory, display: &mut Display) -> Option<()> {
    picture(pixels)?;
    display.take_pixels(pixels);
    Some(())
}

/// Clears a picture and a depth buffer, and draws nothing.
pub fn empty_depth(Memory { pixels, depth, .. }: &mut Memory, display: &mut Display) -> Option<()> {
    picture(pixels)?;
    black_box(DepthBuffer::new(area(), depth).ok()?);
    display.take_pixels(pixels);
    Some(())
}

pub fn wireframe(
    scene: &Scene,
    _: &Lambert,
    Memory { pixels, corners, .. }: &mut Memory,
    display: &mut Display,
) -> Option<()> {
    let mut picture = picture(pixels)?;
    let Ok(statistics) = scene.place().wireframe(LINE, corners, &mut picture);
    black_box(statistics);
    display.take_pixels(pixels);
    Some(())
}

pub fn solid(
    scene: &Scene,
    light: &Lambert,
    Memory { pixels, corners, .. }: &mut Memory,
    display: &mut Display,
) -> Option<()> {
    let mut picture = picture(pixels)?;
    let Ok(statistics) = scene.place().solid(scene.shade(light), corners, &mut picture);
    black_box(statistics);
    display.take_pixels(pixels);
    Some(())
}

pub fn depth(
    scene: &Scene,
    light: &Lambert,
    Memory { pixels, depth, corners }: &mut Memory,
    display: &mut Display,
) -> Option<()> {
    let mut depth = DepthBuffer::new(area(), depth).ok()?;
    let mut picture = picture(pixels)?;
    let Ok(statistics) = scene.place().depth_tested(scene.shade(light), corners, &mut depth, &mut picture);
    black_box(statistics);
    display.take_pixels(pixels);
    Some(())
}

/// A picture over `pixels`, cleared.
fn picture(pixels: &mut [Rgb565]) -> Option<Picture<'_, Rgb565>> {
    let mut picture = Picture::new(pixels, Size::new(SIZE, SIZE)).ok()?;
    let Ok(()) = picture.clear(BACKGROUND);
    Some(picture)
}
