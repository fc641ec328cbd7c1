//! BinnedFaces shaded smoothly, in bands, with depth.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{depth_in_bands, scene};

depth_in_bands!(|faces, mesh, light, depth, band| faces.depth_tested(
    scene::smooth(mesh, light),
    &mut depth,
    &mut band
));
