//! BinnedFaces shaded smoothly and dithered, in bands, with depth.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{depth_in_bands, scene};

depth_in_bands!(|faces, mesh, light, depth, band| faces.depth_tested(
    |face| scene::smooth(mesh, light)(face).dithered(),
    &mut depth,
    &mut band
));
