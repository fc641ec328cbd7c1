//! Lit faces, in bands, into a band's pixels.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::solid_in_bands;

solid_in_bands!(|placed, corners, records| placed.transform(corners).bin_faces(records));
