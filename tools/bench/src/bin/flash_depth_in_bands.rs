//! Faces in bands, with depth, one firmware each: flat, flat into a band's pixels, smooth, and dithered.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{depth_in_bands, position, scene};

/// The firmware that is built.
const IMAGE: usize = position(
    env!("CARGO_BIN_NAME"),
    &["flash_depth_bands", "flash_depth_pixels", "flash_gouraud", "flash_dither"],
);

depth_in_bands!(|faces, mesh, light, depth, band| match IMAGE {
    0 => faces.depth_tested(scene::flat(mesh, light), &mut depth, &mut band).ok()?,
    1 => faces.depth_tested(scene::flat(mesh, light), &mut depth, &mut band.pixels()).ok()?,
    2 => faces.depth_tested(scene::smooth(mesh, light), &mut depth, &mut band).ok()?,
    _ =>
        faces.depth_tested(|face| scene::smooth(mesh, light)(face).dithered(), &mut depth, &mut band).ok()?,
});
