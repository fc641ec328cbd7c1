//! S4, its faces not asked by planes.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Plain};

bench::cell!(Plain<{ cells::ICO }>, cells::s4_no_planes);
