//! Faces without depth in bands.
#![no_std]
#![no_main]

use embedded_graphics_core::geometry::OriginDimensions;
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use linked::{firmware, level, light, COLOR};
use pinhole::{mesh_buffers, Affine, Color as _, Frame, MeshBuffers};

include!(concat!(env!("PLANNER_MODELS"), "/", env!("CARGO_BIN_NAME"), ".rs"));

const STRIP: usize = Frame::<Rgb565>::strip_bytes(WIDTH, ROWS);

firmware!(|camera, turn, display: Rgb565|
    mesh: MeshBuffers!(MODEL) = mesh_buffers!(MODEL),
    strip: [u8; STRIP] = [0; STRIP],
    {
        let model = Affine::rotation_y(turn);
        let light = light(&model)?;
        let instance = camera.place(&MODEL, &model);
        let mut faces = instance.transform(&mut mesh.cache).bin_faces(&mut mesh.bins).ok()?;
        let mut frame = Frame::new(Rectangle::new(Default::default(), display.size()), Rgb565::BLACK);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let Ok(()) = faces.solid(|face| COLOR.dim(level(&MODEL, &light, face)), &mut band.pixels());
            band.send(display).ok()?;
        }
        Some(())
    }
);
