//! Lit faces, at once, with depth for a part of the screen, a firmware each: for an object that turns, and for one that is also
//! stretched.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::pixels;
use bench::image::{Sink, Turntable, CORNERS, ROWS};
use bench::scene::{Light, Model};
use bench::{image, position, scene};
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{DepthBuffer, ScreenVertex};

/// The firmware that is built.
const STRETCHED: bool = position(env!("CARGO_BIN_NAME"), &["flash_depth", "flash_depth_stretched"]) == 1;

/// Draws the cube in this light.
#[inline(always)]
fn draw(
    cube: &'static Model,
    light: &impl Light,
    corners: &mut [ScreenVertex],
    storage: &mut [u16],
) -> Option<()> {
    let instance = Turntable::new().place(cube);
    let area = Rectangle::new(Point::zero(), Size::new(scene::SIZE, ROWS));
    let mut depth = DepthBuffer::new(area, storage).ok()?;
    instance.depth_tested(scene::flat(&cube.mesh, light), corners, &mut depth, &mut Sink).ok()?;
    Some(())
}

image!(cube, corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS], storage: [u16; pixels(ROWS)] = [0; pixels(ROWS)], {
    let scene = Turntable::new();
    match STRETCHED {
        true => draw(cube, &scene.light()?, corners, storage),
        false => draw(cube, &scene.rigid_light()?, corners, storage),
    }
});
