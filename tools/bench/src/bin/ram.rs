//! S3 and S4 with depth in bands of 8 rows, a firmware each, with exactly the memory that the scene needs.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{self, bytes, pixels, Storage};
use bench::{firmware, measure, position, scene};
use pinhole::ScreenVertex;

/// The firmware that is built.
const S4: bool = position(env!("CARGO_BIN_NAME"), &["ram_s3", "ram_s4"]) == 1;
const VERTICES: usize = if S4 { 2892 } else { 500 };
/// Visible faces, with some to spare, and a bit for each face of the mesh.
const BIN_STORAGE: usize = if S4 { 1750 + 5780_usize.div_ceil(16) } else { 480 + 1000_usize.div_ceil(16) };

firmware!(
    corners: [ScreenVertex; VERTICES] = [ScreenVertex::EMPTY; VERTICES],
    bin_storage: [u16; BIN_STORAGE] = [0; BIN_STORAGE],
    strip: [u8; bytes(8)] = [0; bytes(8)],
    depth: [u16; pixels(8)] = [0; pixels(8)],
    {
        let (name, model) = if S4 { ("S4", &scene::ICO) } else { ("S3", &scene::TORUS) };
        measure::once(name, model, &mut |scene, light, display| {
            let (corners, bin_storage) = (&mut *corners, &mut *bin_storage);
            bands::depth(scene, light, Storage { corners, bin_storage, strip, depth }, display)
        })
    }
);
