//! Lines, at once.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::{Sink, CORNERS};
use bench::{firmware, scene};
use pinhole::Corner;

struct Memory([Corner; CORNERS]);
impl Memory {
    const NEW: Self = Self([Corner::EMPTY; CORNERS]);
}

firmware!(Memory, |Memory(corners)| {
    let scene = scene::Scene::new(&scene::CUBE)?;
    scene.place().wireframe(scene::LINE, corners, &mut Sink).ok()?;
    Some(())
});
