//! S8, its faces not asked by planes.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Smooth};

bench::cell!(Smooth<{ cells::TORUS }>, cells::s8_z_no_planes);
