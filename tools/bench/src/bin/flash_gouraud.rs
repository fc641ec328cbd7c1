//! Faces shaded smoothly, in bands, with depth.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{bytes, pixels};
use bench::image::{Sink, Turntable, CORNERS, RECORDS, ROWS};
use bench::{image, scene};
use pinhole::{Corner, DepthBuffer, Frame};

image!(
    cube,
    corners: [Corner; CORNERS] = [Corner::EMPTY; CORNERS],
    records: [u16; RECORDS] = [0; RECORDS],
    strip: [u8; bytes(ROWS)] = [0; bytes(ROWS)],
    storage: [u16; pixels(ROWS)] = [0; pixels(ROWS)],
    {
        let scene = Turntable::new();
        let placed = scene.place(cube);
        let light = scene.light()?;
        let mut faces = placed.transform_depth(corners).faces(records).ok()?;
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let mut depth = DepthBuffer::new(band.area(), storage).ok()?;
            faces.depth_tested(scene::smooth(placed.mesh(), &light), &mut depth, &mut band).ok()?;
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
