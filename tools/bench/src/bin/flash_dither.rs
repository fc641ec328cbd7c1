//! Faces shaded smoothly and dithered, in bands, with depth.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{bytes, pixels};
use bench::image::{Sink, CORNERS, RECORDS};
use bench::{firmware, scene};
use pinhole::{Corner, DepthBuffer, Frame};

firmware!(
    corners: [Corner; CORNERS] = [Corner::EMPTY; CORNERS],
    records: [u16; RECORDS] = [0; RECORDS],
    strip: [u8; bytes(8)] = [0; bytes(8)],
    storage: [u16; pixels(8)] = [0; pixels(8)],
    {
        let scene = scene::Scene::new(&scene::CUBE)?;
        let light = scene.light()?;
        let projected = scene.place().transform_depth(corners);
        let mut faces = projected.faces(records).ok()?;
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let mut depth = DepthBuffer::new(band.area(), storage).ok()?;
            let ink = scene.smooth(&light);
            faces.depth_tested(|face| ink(face).dithered(), &mut depth, &mut band).ok()?;
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
