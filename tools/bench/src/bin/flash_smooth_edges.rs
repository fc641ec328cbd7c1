//! Flat faces in bands, with depth, whose silhouettes and creases are smoothed.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;
use pinhole::{bands::SmoothFrame, draw::SmoothEdge};

/// Bin storage for the cube's edges.
const EDGE_BINS: usize = 12 + 1 + 4 + 2;

image!(
    [Model; cubes_with_edge_faces] cube,
    buffers: MeshBuffers<CORNERS, BIN_STORAGE, EDGE_BINS> = MeshBuffers::new(),
    strips: StripBuffers<{ bytes(ROWS + 2) }, { pixels(ROWS + 2) }> = StripBuffers::new(),
    kept: [u8; bytes(2)] = [0; bytes(2)],
    list: [SmoothEdge; 16] = [SmoothEdge::EMPTY; 16],
    {
        let turntable = Turntable::turned();
        let instance = turntable.place(cube);
        let light = turntable.light();
        let light = light.as_ref()?;
        let transformed = instance.transform_depth(&mut buffers.cache);
        let mut faces = transformed.bin_faces(&mut buffers.bins);
        let mut edges = transformed.bin_smooth_edges(|edge| edge < black_box(12), &mut buffers.edge_bins);
        let (faces, edges) = (faces.as_mut().ok()?, edges.as_mut().ok()?);
        edges.keep_in(list);
        let mut frame = SmoothFrame::new(scene::area(), scene::BACKGROUND, kept, &mut strips.depths).ok()?;
        while let Some(mut band) = frame.next_band(&mut strips.colors).ok()? {
            let (mut pixels, mut depth) = band.new_rows();
            let shade = scene::flat(&cube.mesh, |normal| light.level(normal));
            faces.draw(shade, &mut pixels.depth_tested(&mut depth)).ok()?;
            band.smooth(|pass| edges.draw(pass)).send(&mut Sink).ok()?;
        }
        Some(())
    }
);
