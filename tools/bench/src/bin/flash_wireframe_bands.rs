//! Lines, in bands.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::bytes;
use bench::image::{Sink, Turntable, CORNERS, RECORDS, ROWS};
use bench::{image, scene};
use pinhole::{Frame, ScreenVertex};

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    records: [u16; RECORDS] = [0; RECORDS],
    strip: [u8; bytes(ROWS)] = [0; bytes(ROWS)],
    {
        let placed = Turntable::new().place(cube);
        let mut edges = placed.transform(corners).bin_edges(records).ok()?;
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            edges.draw(scene::LINE, &mut band).ok()?;
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
