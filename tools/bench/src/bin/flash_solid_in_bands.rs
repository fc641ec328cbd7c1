//! Flat faces in bands, into a band's pixels, a firmware each: with and without early culling by face planes.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{position, solid_in_bands};

/// The firmware that is built.
const BY_PLANES: bool = position(env!("CARGO_BIN_NAME"), &["flash_solid_bands", "flash_facing_bands"]) == 1;

solid_in_bands!(|instance, corners, bin_storage| match BY_PLANES {
    true => instance.cull_by_planes().bin_faces(corners, bin_storage),
    false => instance.transform(corners).bin_faces(bin_storage),
});
