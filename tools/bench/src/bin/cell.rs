//! A cell: the name of the image that is built chooses it.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{of_image, Cell, Image};

type Chosen = Image<{ of_image(env!("CARGO_BIN_NAME")) }>;

bench::cell!(<Chosen as Cell>::Memory, Chosen::draw);
