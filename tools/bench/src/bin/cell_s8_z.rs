//! S8: the torus, smooth, with depth.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Smooth};

bench::cell!(Smooth<{ cells::TORUS }>, cells::s8_z);
