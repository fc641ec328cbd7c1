//! A camera made at run time, and a placed mesh, of which nothing is drawn.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{firmware, scene};
use core::hint::black_box;

firmware!({
    black_box(scene::Scene::new(&scene::CUBE)?.place());
    Some(())
});
