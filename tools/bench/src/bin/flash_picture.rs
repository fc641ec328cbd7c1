//! Lit faces, at once, without depth, into a picture in memory: some rows of one.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::pixels;
use bench::image::{Turntable, CORNERS, ROWS};
use bench::{image, scene};
use core::hint::black_box;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{Picture, ScreenVertex};

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    memory: [Rgb565; pixels(ROWS)] = [scene::BACKGROUND; pixels(ROWS)],
    {
        let scene = Turntable::new();
        let light = scene.rigid_light()?;
        let instance = scene.place(cube);
        let mut picture = Picture::new(memory, black_box(Size::new(scene::SIZE, ROWS))).ok()?;
        let Ok(_) = instance.solid(scene::flat(&cube.mesh, &light), corners, &mut picture.pixels());
        black_box(picture.colors());
        Some(())
    }
);
