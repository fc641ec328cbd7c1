//! Smoothed edges, without a list of the faces beside them and with one: in one piece and in bands of any height, one after the other or by
//! their numbers, whatever the number of edges that are kept, pictures are equal. No pixel leaves the levels of the picture before.

use super::scene::input::Scene;
use super::Bytes;
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{bands::SmoothFrame, draw::SmoothEdge, prelude::*, target::Pixels};

const SKY: Gray8 = Gray8::new(100);

struct Check<'a> {
    instance: &'a MeshInstance<'a>,
    area: Rectangle,
    /// The length of the cache.
    cache: usize,
    creases: u8,
}

impl Check<'_> {
    fn color(face: usize) -> Gray8 {
        Gray8::new([10, 250, 130][face % 3])
    }

    fn is_crease(&self, edge: usize) -> bool {
        self.creases >> (edge % 8) & 1 != 0
    }

    fn in_one_piece(&self) -> Vec<Gray8> {
        let count = (self.area.size.width * self.area.size.height) as usize;
        let (mut cells, mut depths) = (vec![SKY; count], vec![0; count]);
        let mut depth = DepthBuffer::new(self.area, &mut depths).expect("room");
        let mut pixels = Pixels::<Gray8>::new(&mut cells, self.area).expect("room");
        let mut target = pixels.depth_tested(&mut depth);
        let Ok(_) = self.instance.faces(Self::color).draw(&mut target);
        let mut cache = vec![ScreenVertex::EMPTY; self.cache];
        let mut bins = vec![0; self.instance.mesh().smooth_bins_len()];
        let transformed = self.instance.transform_depth(&mut cache);
        let mut edges = transformed.bin_smooth_edges(|edge| self.is_crease(edge), &mut bins).expect("room");
        target.smooth(|pass| edges.draw(pass));
        cells
    }

    fn in_bands(&self, rows: u32, kept_edges: usize, by_number: bool) -> Vec<Gray8> {
        let (mesh, width) = (self.instance.mesh(), self.area.size.width);
        let mut cache = vec![ScreenVertex::EMPTY; self.cache];
        let (mut bins, mut edge_bins) = (vec![0; mesh.face_bins_len()], vec![0; mesh.smooth_bins_len()]);
        let mut list = vec![SmoothEdge::EMPTY; kept_edges];
        let transformed = self.instance.transform_depth(&mut cache);
        let mut faces = transformed.bin_faces(&mut bins).expect("room");
        let is_crease = |edge| self.is_crease(edge);
        let mut edges = transformed.bin_smooth_edges(is_crease, &mut edge_bins).expect("room");
        edges.keep_in(&mut list);
        let storage = |rows| {
            (vec![0; SmoothFrame::<Gray8>::strip_bytes(width, rows)], vec![0; (width * rows) as usize])
        };
        let ((mut strip, mut depths), (mut kept, _)) = (storage(rows), storage(2));
        let mut frame = SmoothFrame::new(self.area, SKY, &mut kept, &mut depths).expect("room");
        let mut picture = Vec::new();
        for index in 0.. {
            let band = match by_number {
                true => frame.nth_band(index, &mut strip),
                false => frame.next_band(&mut strip),
            };
            let Some(mut band) = band.expect("room") else { break };
            let (mut pixels, mut depth) = band.new_rows();
            let Ok(()) = faces.draw(Self::color, &mut pixels.depth_tested(&mut depth));
            picture.extend(band.smooth(|pass| edges.draw(pass)).colors());
        }
        picture
    }
}

pub(super) fn check(data: &[u8]) {
    let (head, tail) = data.split_at(data.len().min(4));
    let Some(scene) = Scene::read(tail) else { return };
    let Some(area) = scene.rectangle() else { return };
    let mut b = Bytes::new(head);
    let (kind, rows, kept_edges) = (b.byte(), 6 + u32::from(b.byte() % 20), b.below(9));
    let by_number = kind & 2 != 0 && rows > 6;
    let sides = scene.faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: Vec<[u16; 2]> = sides.chain(scene.edges.iter().copied()).collect();
    let beside = edges.iter().map(|edge| {
        let has = |face: &u16| edge.iter().all(|end| scene.faces[usize::from(*face)].contains(end));
        let mut faces = (0..scene.faces.len() as u16).filter(has);
        [0; 2].map(|_| faces.next().unwrap_or(u16::MAX))
    });
    let beside: Vec<[u16; 2]> = if kind & 1 == 0 { Vec::new() } else { beside.collect() };
    let mesh =
        Mesh::new(&scene.vertices, scene.exponent, &scene.faces).and_then(|mesh| mesh.with_edges(&edges));
    let mesh = match mesh.expect("a mesh") {
        mesh if beside.is_empty() => mesh,
        mesh => mesh.with_edge_faces(&beside).expect("faces"),
    };
    let camera = scene.camera.library().with_far_clip(scene.far_clip);
    let instance = &camera.place(&mesh, &scene.model.library()).with_cull(scene.cull);
    let check = Check { instance, area, cache: scene.cache, creases: b.byte() };
    let whole = check.in_one_piece();
    assert!(whole == check.in_bands(rows, kept_edges, by_number), "{kind} {rows} {kept_edges} {scene:?}");
    assert!(whole.iter().all(|color| (10..=250).contains(&color.luma())), "{scene:?}");
}
