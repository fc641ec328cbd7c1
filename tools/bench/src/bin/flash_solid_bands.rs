//! Flat faces in bands, into a band's pixels.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{image, scene, solid_in_bands};

solid_in_bands!(scene::Model; image::cubes);
