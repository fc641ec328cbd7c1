//! Lines, at once.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::{Sink, Turntable, CORNERS};
use bench::{image, scene};
use pinhole::{LeastRun, ScreenVertex};

image!(cube, corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS], {
    // As a display takes lines: the image holds no code for those into memory.
    let mut display = LeastRun::<_, 1>(&mut Sink);
    Turntable::new().place(cube).without_clipping().wireframe(scene::LINE, corners, &mut display).ok()?;
    Some(())
});
