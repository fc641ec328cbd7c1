//! What every cell has too: the start, the count of a frame in which nothing is drawn, the end.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Frame};

bench::cell!(Frame, cells::empty);
