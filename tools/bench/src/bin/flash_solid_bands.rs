//! Lines, and flat faces into a band's pixels, in bands, one firmware each.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// The firmware that is built.
const OF_LINES: bool = is_equal(env!("CARGO_BIN_NAME"), "flash_wireframe_bands");

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    bin_storage: [u16; BIN_STORAGE] = [0; BIN_STORAGE],
    strip: [u8; bytes(ROWS)] = [0; bytes(ROWS)],
    {
        let scene = Turntable::turned();
        let instance = scene.place(cube);
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        if OF_LINES {
            let mut edges = instance.transform(corners).bin_edges(bin_storage).ok()?;
            while let Some(mut band) = frame.next_band(strip).ok()? {
                edges.draw(scene::LINE, &mut band).ok()?;
                band.send(&mut Sink).ok()?;
            }
        } else {
            let light = scene.light();
            let light = light.as_ref()?;
            let mut faces = instance.transform(corners).bin_faces(bin_storage);
            let faces = faces.as_mut().ok()?;
            while let Some(mut band) = frame.next_band(strip).ok()? {
                let Ok(()) = faces.draw(scene::flat(&cube.mesh, |normal| light.level(normal)), &mut band.pixels());
                band.send(&mut Sink).ok()?;
            }
        }
        Some(())
    }
);
