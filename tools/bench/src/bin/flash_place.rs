//! A mesh instance that is not drawn.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image;
use bench::image::Turntable;
use core::hint::black_box;

image!(cube, {
    black_box(Turntable::new().place(cube));
    Some(())
});
