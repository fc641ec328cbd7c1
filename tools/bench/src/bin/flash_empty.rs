//! The parts that every other image has too: the start, the end, the cube.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image;
use core::hint::black_box;

image!(cube, {
    black_box(cube);
    Some(())
});
