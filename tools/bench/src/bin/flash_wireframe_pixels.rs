//! Lines, at once, into a DrawTarget in memory: one call per line.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::{Sink, Turntable, CORNERS};
use bench::{image, scene};
use pinhole::ScreenVertex;

image!(cube, corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS], {
    Turntable::new().place(cube).wireframe(scene::LINE, corners, &mut Sink).ok()?;
    Some(())
});
