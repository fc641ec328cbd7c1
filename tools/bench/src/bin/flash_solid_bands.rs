//! Flat faces in bands, into a band's pixels.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::bytes;
use bench::image::{Sink, Turntable, BIN_STORAGE, CORNERS, ROWS};
use bench::{image, scene};
use pinhole::{Frame, ScreenVertex};

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    bin_storage: [u16; BIN_STORAGE] = [0; BIN_STORAGE],
    strip: [u8; bytes(ROWS)] = [0; bytes(ROWS)],
    {
        let scene = Turntable::new();
        let instance = scene.place(cube);
        let light = scene.light();
        let light = light.as_ref()?;
        let mut faces = instance.bin_faces(corners, bin_storage);
        let faces = faces.as_mut().ok()?;
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let Ok(()) = faces.solid(scene::flat(&cube.mesh, light), &mut band.pixels());
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
