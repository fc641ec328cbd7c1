//! Hidden lines in bands.
#![no_std]
#![no_main]

use linked::*;

firmware!(|camera, turn, display: Color|
    mesh: MeshBuffers!(faces, edges: MODEL) = mesh_buffers!(faces, edges: MODEL),
    strip: StripBuffers!(Color, WIDTH, ROWS) = strip_buffers!(Color, WIDTH, ROWS),
    {
        let instance = camera.place(&MODEL, &Affine::rotation_y(turn));
        let transformed = instance.transform_depth(&mut mesh.cache);
        let mut faces = transformed.bin_faces(&mut mesh.bins).ok()?;
        let mut edges = transformed.bin_edges(&mut mesh.edge_bins).ok()?;
        let mut frame = Frame::new(area(display), Color::from(BinaryColor::Off));
        while let Some(mut band) = frame.next_band(&mut strip.colors).ok()? {
            let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).ok()?;
            faces.depth_only(&mut depth);
            let Ok(()) = edges.hidden_line(Color::from(BinaryColor::On), &mut band.depth_tested(&mut depth));
            band.send(display).ok()?;
        }
        Some(())
    }
);
