//! Lit faces, at once, into a picture in memory, some rows of one: a firmware each, without depth and with it.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::pixels;
use bench::image::{Turntable, CORNERS, ROWS};
use bench::{image, position, scene};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{DepthBuffer, Picture, ScreenVertex};

/// The firmware that is built.
const WITH_DEPTH: bool = position(env!("CARGO_BIN_NAME"), &["flash_picture", "flash_depth_picture"]) == 1;
/// The number of depths in the depth buffer.
const DEPTHS: usize = if WITH_DEPTH { pixels(ROWS) } else { 0 };

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    memory: [Rgb565; pixels(ROWS)] = [scene::BACKGROUND; pixels(ROWS)],
    storage: [u16; DEPTHS] = [0; DEPTHS],
    {
        let scene = Turntable::new();
        let size = black_box(Size::new(scene::SIZE, ROWS));
        let instance = scene.place(cube);
        let mut picture = Picture::new(memory, size).ok()?;
        if WITH_DEPTH {
            let light = scene.light();
            let shade = scene::flat(&cube.mesh, light.as_ref()?);
            let mut depth = DepthBuffer::new(Rectangle::new(Point::zero(), size), storage).ok()?;
            let Ok(_) = instance.depth_tested(shade, corners, &mut depth, &mut picture.pixels());
        } else {
            let light = scene.rigid_light()?;
            let Ok(_) = instance.solid(scene::flat(&cube.mesh, &light), corners, &mut picture.pixels());
        }
        black_box(picture.colors());
        Some(())
    }
);
