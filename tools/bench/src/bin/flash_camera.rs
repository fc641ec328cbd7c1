//! A camera made at run time, and a placed mesh, of which nothing is drawn.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{image, scene};
use core::hint::black_box;

image!(cube, {
    black_box(scene::Scene::new(cube)?.place());
    Some(())
});
