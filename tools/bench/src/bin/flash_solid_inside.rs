//! Lit faces, at once, without depth.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::{Sink, Turntable, CORNERS};
use bench::{image, scene};
use pinhole::ScreenVertex;

image!(cube, corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS], {
    let scene = Turntable::new();
    let light = scene.rigid_light()?;
    let instance = scene.place(cube).without_clipping();
    instance.solid(scene::flat(&cube.mesh, &light), corners, &mut Sink).ok()?;
    Some(())
});
