//! Flat faces in bands, into a band's pixels, of meshes with face planes.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{image, scene, solid_in_bands};
use pinhole::WithPlanes;

solid_in_bands!(scene::Model<WithPlanes>; image::cubes_by_planes);
