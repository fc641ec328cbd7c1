//! What every other image has too: the start, the end, the cube.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{firmware, scene};
use core::hint::black_box;

firmware!({
    black_box(&scene::CUBE);
    Some(())
});
