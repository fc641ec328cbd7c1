//! Lit faces, at once, with depth for a part of the screen.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::pixels;
use bench::image::{Sink, Turntable, CORNERS, ROWS};
use bench::{image, scene};
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{DepthBuffer, ScreenVertex};

image!(cube, corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS], storage: [u16; pixels(ROWS)] = [0; pixels(ROWS)], {
    let scene = Turntable::new();
    let light = scene.rigid_light()?;
    let instance = scene.place(cube).without_clipping();
    let area = Rectangle::new(Point::zero(), Size::new(scene::SIZE, ROWS));
    let mut depth = DepthBuffer::new(area, storage).ok()?;
    instance.depth_tested(scene::flat(&cube.mesh, &light), corners, &mut depth, &mut Sink).ok()?;
    Some(())
});
