//! Faces in bands, with depth, one firmware each: flat, smooth, dithered and textured, into a band as into any DrawTarget and into its
//! pixels.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{depth_in_bands, image, position, scene};

/// The firmware that is built.
const IMAGE: usize = position(
    env!("CARGO_BIN_NAME"),
    &[
        "flash_depth_bands",
        "flash_depth_pixels",
        "flash_gouraud",
        "flash_gouraud_pixels",
        "flash_dither",
        "flash_dither_pixels",
        "flash_flat_dither_pixels",
        "flash_textured_pixels",
    ],
);

depth_in_bands!(|faces, mesh, light, depth, band| match IMAGE {
    0 => faces.depth_tested(scene::flat(mesh, light), &mut depth, &mut band).ok()?,
    1 => faces.depth_tested(scene::flat(mesh, light), &mut depth, &mut band.pixels()).ok()?,
    2 => faces.depth_tested(scene::smooth(mesh, light), &mut depth, &mut band).ok()?,
    3 => faces.depth_tested(scene::smooth(mesh, light), &mut depth, &mut band.pixels()).ok()?,
    4 =>
        faces.depth_tested(|face| scene::smooth(mesh, light)(face).dithered(), &mut depth, &mut band).ok()?,
    5 => faces
        .depth_tested(|face| scene::smooth(mesh, light)(face).dithered(), &mut depth, &mut band.pixels())
        .ok()?,
    6 => faces
        .depth_tested(scene::flat_dithered(mesh.normals(), light), &mut depth, &mut band.pixels())
        .ok()?,
    _ => faces.depth_tested(image::textured(mesh, light), &mut depth, &mut band.pixels()).ok()?,
});
