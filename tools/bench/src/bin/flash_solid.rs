//! Lit faces, at once, without depth.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::{Sink, CORNERS};
use bench::{firmware, scene};
use pinhole::Corner;

firmware!(corners: [Corner; CORNERS] = [Corner::EMPTY; CORNERS], {
    let scene = scene::Scene::new(&scene::CUBE)?;
    let light = scene.light()?;
    scene.place().solid(scene.shade(&light), corners, &mut Sink).ok()?;
    Some(())
});
