//! The cube drawn at once onto a display, a firmware each: its edges, and lit faces without depth and with depth for a part of the screen.
//! *Inside* draws without clipping, and *pixels* a display in memory.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// The firmware that is built.
const IMAGE: &str = env!("CARGO_BIN_NAME");
/// The number of depths in the depth buffer.
const DEPTHS: usize = if is_equal(IMAGE, "flash_depth") { pixels(ROWS) } else { 0 };

image!(cube, corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS], storage: [u16; DEPTHS] = [0; DEPTHS], {
    let scene = Turntable::turned();
    let place = || scene.place(cube);
    match IMAGE {
        "flash_wireframe_pixels" => {
            place().edges(|_| scene::LINE).cached(corners).draw(&mut Sink).ok()?;
        }
        // As a display takes lines: the image holds no code for those into memory.
        "flash_wireframe" => {
            place().edges(|_| scene::LINE).cached(corners).draw(&mut LeastRun::<_, 1>(&mut Sink)).ok()?;
        }
        "flash_wireframe_inside" => {
            let mut display = LeastRun::<_, 1>(&mut Sink);
            place().without_clipping().edges(|_| scene::LINE).cached(corners).draw(&mut display).ok()?;
        }
        "flash_solid" => {
            let light = scene.rigid_light()?;
            place().faces(scene::flat(&cube.mesh, |normal| light.level(normal))).cached(corners).draw(&mut Sink).ok()?;
        }
        "flash_solid_inside" => {
            let light = scene.rigid_light()?;
            place().without_clipping().faces(scene::flat(&cube.mesh, |normal| light.level(normal))).cached(corners).draw(&mut Sink).ok()?;
        }
        "flash_depth" => {
            let area = Rectangle::new(Point::zero(), Size::new(scene::SIZE, ROWS));
            let mut depth = DepthBuffer::new(area, storage).ok()?;
            let light = scene.rigid_light()?;
            place().faces(scene::flat(&cube.mesh, |normal| light.level(normal))).cached(corners).draw(&mut Sink.depth_tested(&mut depth)).ok()?;
        }
        _ => return None,
    }
    Some(())
});
