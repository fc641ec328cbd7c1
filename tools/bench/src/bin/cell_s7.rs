//! S7: a thousand triangles.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Frame};

bench::cell!(Frame, cells::s7);
