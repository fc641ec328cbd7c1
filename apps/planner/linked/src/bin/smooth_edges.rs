//! Faces with depth in bands, flat or with Gouraud shading, whose edges are smoothed: in 16-bit colour, or in greys that are packed.
#![no_std]
#![no_main]

use linked::*;
use pinhole::{bands::SmoothFrame, draw::SmoothEdge};

firmware!(|camera, turn, display: Color|
    mesh: MeshBuffers!(smooth: MODEL) = mesh_buffers!(smooth: MODEL),
    list: [SmoothEdge; 16] = [SmoothEdge::EMPTY; 16],
    strip: StripBuffers!(Color, WIDTH, ROWS, smooth) = strip_buffers!(Color, WIDTH, ROWS, smooth),
    {
        let model = Affine::rotation_y(turn);
        let light = light(&model)?;
        let instance = camera.place(&MODEL, &model);
        let transformed = instance.transform_depth(&mut mesh.cache);
        let mut faces = transformed.bin_faces(&mut mesh.bins).ok()?;
        let creases = if SHADING == "flat" { MODEL_CREASES } else { 0 };
        let mut edges = transformed.bin_smooth_edges(|edge| edge < creases, &mut mesh.edge_bins).ok()?;
        edges.keep_in(list);
        let mut frame = SmoothFrame::new(area(display), Color::from(BinaryColor::Off), &mut strip.kept, &mut strip.depths).ok()?;
        let smooth = |face| {
            let normals = MODEL.corners_of(face, MODEL.vertex_normals());
            Gouraud::lit(LIT, normals.map(|normal| light.level(normal)))
        };
        while let Some(mut band) = frame.next_band(&mut strip.colors).ok()? {
            let (mut pixels, mut depth) = band.new_rows();
            let target = &mut pixels.depth_tested(&mut depth);
            let Ok(()) = match SHADING {
                "flat" => faces.draw(|face| Color::from(LIT).dim(level(&MODEL, &light, face)), target),
                _ => faces.draw(smooth, target),
            };
            band.smooth(|pass| edges.draw(pass)).send(display).ok()?;
        }
        Some(())
    }
);
