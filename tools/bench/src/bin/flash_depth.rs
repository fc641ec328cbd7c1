//! Lit faces, at once, with depth for a part of the screen.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::{Sink, CORNERS};
use bench::{firmware, scene};
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Corner, DepthBuffer};

const ROWS: u32 = 8;
const PIXELS: usize = (scene::SIZE * ROWS) as usize;

firmware!(corners: [Corner; CORNERS] = [Corner::EMPTY; CORNERS], storage: [u16; PIXELS] = [0; PIXELS], {
    let scene = scene::Scene::new(&scene::CUBE)?;
    let light = scene.light()?;
    let area = Rectangle::new(Point::zero(), Size::new(scene::SIZE, ROWS));
    let mut depth = DepthBuffer::new(area, storage).ok()?;
    scene.place().depth_tested(scene.shade(&light), corners, &mut depth, &mut Sink).ok()?;
    Some(())
});
