//! Faces without depth in bands.
#![no_std]
#![no_main]

use linked::*;

const STRIP: usize = Frame::<Rgb565>::strip_bytes(WIDTH, ROWS);

firmware!(|camera, turn, display: Rgb565|
    mesh: MeshBuffers!(MODEL) = mesh_buffers!(MODEL),
    strip: [u8; STRIP] = [0; STRIP],
    {
        let model = Affine::rotation_y(turn);
        let light = light(&model)?;
        let instance = camera.place(&MODEL, &model);
        let mut faces = instance.transform(&mut mesh.cache).bin_faces(&mut mesh.bins).ok()?;
        let mut frame = Frame::new(area(display), Rgb565::BLACK);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let Ok(()) = faces.draw(|face| COLOR.dim(level(&MODEL, &light, face)), &mut band.pixels());
            band.send(display).ok()?;
        }
        Some(())
    }
);
