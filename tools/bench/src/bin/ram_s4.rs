//! S4 with depth in bands of 8 rows, with no more memory than that takes.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{self, bytes, pixels, Storage};
use bench::{firmware, measure, scene};
use pinhole::ScreenVertex;

const VERTICES: usize = 2892;
/// BinnedFaces that show, with some to spare, and a bit for each of the mesh.
const RECORDS: usize = 1750 + 5780_usize.div_ceil(16);

firmware!(
    corners: [ScreenVertex; VERTICES] = [ScreenVertex::EMPTY; VERTICES],
    records: [u16; RECORDS] = [0; RECORDS],
    strip: [u8; bytes(8)] = [0; bytes(8)],
    depth: [u16; pixels(8)] = [0; pixels(8)],
    {
        measure::once("S4", &scene::ICO, &mut |scene, light, display| {
            let (corners, records) = (&mut *corners, &mut *records);
            bands::depth(scene, light, Storage { corners, records, strip, depth }, display)
        })
    }
);
