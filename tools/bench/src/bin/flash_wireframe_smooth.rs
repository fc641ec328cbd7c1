//! Anti-aliased lines, at once, into a picture in memory: some rows of one.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::pixels;
use bench::image::{Turntable, CORNERS, ROWS};
use bench::{image, scene};
use core::hint::black_box;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{AntiAliased, Picture, ScreenVertex};

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    memory: [Rgb565; pixels(ROWS)] = [scene::BACKGROUND; pixels(ROWS)],
    {
        let instance = Turntable::new().place(cube);
        let mut picture = Picture::new(memory, black_box(Size::new(scene::SIZE, ROWS))).ok()?;
        let Ok(_) = instance.wireframe(AntiAliased(scene::LINE), corners, &mut picture.pixels());
        black_box(picture.colors());
        Some(())
    }
);
