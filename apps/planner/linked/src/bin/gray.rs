//! Faces with depth in bands, on a display of 16 greys.
#![no_std]
#![no_main]

use embedded_graphics_core::geometry::OriginDimensions;
use embedded_graphics_core::pixelcolor::{Gray4, GrayColor};
use embedded_graphics_core::primitives::Rectangle;
use linked::{firmware, level, light, LIT};
use pinhole::{mesh_buffers, strip_buffers, Affine, DepthBuffer, Dim, Frame, MeshBuffers, StripBuffers};

include!(concat!(env!("PLANNER_MODELS"), "/", env!("CARGO_BIN_NAME"), ".rs"));

firmware!(|camera, turn, display: Gray4|
    mesh: MeshBuffers!(MODEL) = mesh_buffers!(MODEL),
    strip: StripBuffers!(Gray4, WIDTH, ROWS) = strip_buffers!(Gray4, WIDTH, ROWS),
    {
        let model = Affine::rotation_y(turn);
        let light = light(&model)?;
        let shade = |face| Gray4::from(LIT).dim(level(&MODEL, &light, face));
        let instance = camera.place(&MODEL, &model);
        let mut faces = instance.transform_depth(&mut mesh.cache).bin_faces(&mut mesh.bins).ok()?;
        let mut frame = Frame::new(Rectangle::new(Default::default(), display.size()), Gray4::BLACK);
        while let Some(mut band) = frame.next_band(&mut strip.colors).ok()? {
            let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).ok()?;
            let Ok(()) = faces.depth_tested(shade, &mut depth, &mut band);
            band.send(display).ok()?;
        }
        Some(())
    }
);
