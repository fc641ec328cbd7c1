//! Hidden lines, in bands: the depths of the faces, then the edges that they do not hide.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

image!(
    [Model; cubes_with_edge_faces] cube,
    buffers: MeshBuffers<CORNERS, BIN_STORAGE, BIN_STORAGE> = MeshBuffers::new(),
    strips: StripBuffers<{ bytes(ROWS) }, { pixels(ROWS) }> = StripBuffers::new(),
    {
        let instance = Turntable::turned().place(cube);
        let transformed = instance.transform_depth(&mut buffers.cache);
        let mut faces = transformed.bin_faces(&mut buffers.bins);
        let mut edges = transformed.bin_edges(&mut buffers.edge_bins);
        let (faces, edges) = (faces.as_mut().ok()?, edges.as_mut().ok()?);
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(&mut strips.colors).ok()? {
            let mut depth = DepthBuffer::new(band.area(), &mut strips.depths).ok()?;
            faces.depth_only(&mut depth);
            edges.hidden_line(scene::LINE, &mut band.depth_tested(&mut depth)).ok()?;
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
