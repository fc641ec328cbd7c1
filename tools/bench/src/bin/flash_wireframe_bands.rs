//! Lines, in bands.
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
        let instance = Turntable::new().place(cube);
        let mut edges = instance.transform(corners).bin_edges(bin_storage).ok()?;
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            edges.draw(scene::LINE, &mut band).ok()?;
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
