//! S4 with depth, its faces not asked by planes.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Deep};

bench::cell!(Deep<{ cells::ICO }>, cells::s4_z_no_planes);
