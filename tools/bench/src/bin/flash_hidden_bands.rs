//! Hidden lines, in bands: the depths of the faces, then the edges that they do not hide.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

image!(
    [Model; cubes_with_edge_faces] cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    bin_storage: [u16; BIN_STORAGE] = [0; BIN_STORAGE],
    edge_bin_storage: [u16; BIN_STORAGE] = [0; BIN_STORAGE],
    strip: [u8; bytes(ROWS)] = [0; bytes(ROWS)],
    storage: [u16; pixels(ROWS)] = [0; pixels(ROWS)],
    {
        let instance = Turntable::turned().place(cube);
        let transformed = instance.transform_depth(corners);
        let mut faces = transformed.bin_faces(bin_storage);
        let mut edges = transformed.bin_edges(edge_bin_storage);
        let (faces, edges) = (faces.as_mut().ok()?, edges.as_mut().ok()?);
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let mut depth = DepthBuffer::new(band.area(), storage).ok()?;
            faces.depth_only(&mut depth);
            edges.hidden_line(scene::LINE, &mut band.depth_tested(&mut depth)).ok()?;
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
