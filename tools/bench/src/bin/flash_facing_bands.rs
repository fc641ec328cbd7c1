//! Lit faces, in bands, known by their planes, into a band's pixels.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::solid_in_bands;

solid_in_bands!(|placed, corners, records| placed.cull_by_planes().bin_faces(corners, records));
