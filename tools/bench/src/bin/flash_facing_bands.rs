//! Lit faces, in bands, known by their planes, into a band's pixels.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::bytes;
use bench::image::{Sink, Turntable, CORNERS, RECORDS, ROWS};
use bench::{image, scene};
use pinhole::{Corner, Frame};

image!(
    cube,
    corners: [Corner; CORNERS] = [Corner::EMPTY; CORNERS],
    records: [u16; RECORDS] = [0; RECORDS],
    strip: [u8; bytes(ROWS)] = [0; bytes(ROWS)],
    {
        let scene = Turntable::new();
        let placed = scene.place(cube);
        let light = scene.light()?;
        let mut faces = placed.facing().faces(corners, records).ok()?;
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let Ok(()) = faces.solid(scene::flat(placed.mesh(), &light), &mut band.pixels());
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
