//! Faces in bands, with depth, one firmware each: flat, smooth, dithered and textured, into a band as into any DrawTarget and into its
//! pixels.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{bytes, pixels};
use bench::image::{Sink, Turntable, BIN_STORAGE, CORNERS, ROWS};
use bench::{image, position, scene};
use pinhole::{DepthBuffer, Frame, ScreenVertex};

/// The firmware that is built.
const IMAGE: usize = position(
    env!("CARGO_BIN_NAME"),
    &[
        "flash_depth_bands",
        "flash_depth_pixels",
        "flash_gouraud_pixels",
        "flash_dither",
        "flash_dither_pixels",
        "flash_flat_dither_pixels",
        "flash_textured_pixels",
    ],
);

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    bin_storage: [u16; BIN_STORAGE] = [0; BIN_STORAGE],
    strip: [u8; bytes(ROWS)] = [0; bytes(ROWS)],
    storage: [u16; pixels(ROWS)] = [0; pixels(ROWS)],
    {
        let turntable = Turntable::new();
        let instance = turntable.place(cube);
        let light = turntable.light();
        let light = light.as_ref()?;
        let mut faces = instance.transform_depth(corners).bin_faces(bin_storage);
        let faces = faces.as_mut().ok()?;
        let mesh = &cube.mesh;
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let mut depth = DepthBuffer::new(band.area(), storage).ok()?;
            match IMAGE {
    0 => faces.depth_tested(scene::flat(mesh, light), &mut depth, &mut band).ok()?,
    1 => faces.depth_tested(scene::flat(mesh, light), &mut depth, &mut band.pixels()).ok()?,
    2 => faces.depth_tested(scene::smooth(mesh, light), &mut depth, &mut band.pixels()).ok()?,
    3 =>
        faces.depth_tested(|face| scene::smooth(mesh, light)(face).dithered(), &mut depth, &mut band).ok()?,
    4 => faces
        .depth_tested(|face| scene::smooth(mesh, light)(face).dithered(), &mut depth, &mut band.pixels())
        .ok()?,
    5 => faces
        .depth_tested(scene::flat_dithered(mesh.normals(), light), &mut depth, &mut band.pixels())
        .ok()?,
    _ => faces.depth_tested(image::textured(mesh, light), &mut depth, &mut band.pixels()).ok()?,
};
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
