//! The cube drawn at once onto a display, a firmware each: its edges, and lit faces without depth and with depth for a part of the screen.
//! *Inside* draws without clipping, and *pixels* a display in memory.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// The firmware that is built.
const IMAGE: usize = position(
    env!("CARGO_BIN_NAME"),
    &[
        "flash_wireframe",
        "flash_wireframe_inside",
        "flash_wireframe_pixels",
        "flash_solid",
        "flash_solid_inside",
        "flash_depth",
    ],
);
/// The number of depths in the depth buffer.
const DEPTHS: usize = if IMAGE < 5 { 0 } else { pixels(ROWS) };

image!(cube, corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS], storage: [u16; DEPTHS] = [0; DEPTHS], {
    let scene = Turntable::new();
    let place = || scene.place(cube);
    if IMAGE == 2 {
        place().wireframe(scene::LINE, corners, &mut Sink).ok()?;
    } else if IMAGE < 2 {
        // As a display takes lines: the image holds no code for those into memory.
        let mut display = LeastRun::<_, 1>(&mut Sink);
        match IMAGE {
            0 => place().wireframe(scene::LINE, corners, &mut display).ok()?,
            _ => place().without_clipping().wireframe(scene::LINE, corners, &mut display).ok()?,
        };
    } else if IMAGE < 5 {
        let light = scene.rigid_light()?;
        let shade = scene::flat(&cube.mesh, &light);
        match IMAGE {
            3 => place().solid(shade, corners, &mut Sink).ok()?,
            _ => place().without_clipping().solid(shade, corners, &mut Sink).ok()?,
        };
    } else {
        let area = Rectangle::new(Point::zero(), Size::new(scene::SIZE, ROWS));
        let mut depth = DepthBuffer::new(area, storage).ok()?;
        let light = scene.rigid_light()?;
        place().depth_tested(scene::flat(&cube.mesh, &light), corners, &mut depth, &mut Sink).ok()?;
    }
    Some(())
});
