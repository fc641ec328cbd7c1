//! Silhouettes and creases, which are smoothed after the faces are drawn.

use super::bins::BinStorage;
use super::cull::{Cull, Facing};
use super::draw_region::pixels;
use super::edge_lists::EdgeLists;
use super::face_triangles::FaceTriangles;
use super::statistics::Statistics;
use super::vertex_cache::{area, TransformedMesh};
use crate::camera::UnpackedVertex;
use crate::color::{Color, StoredPixel};
use crate::math::hints::keep_rolled;
use crate::math::Coordinate;
use crate::raster::{CrossedEdge, CrossedPair, Scissor};
use crate::surface::{inside, rectangle, BufferError, Pairs, Seen, SeenKind, SmoothPass};
use embedded_graphics_core::primitives::Rectangle;

/// The edges of a mesh that are smoothed in a picture, binned by their first rows: silhouettes, beyond which no face of the mesh follows, and
/// creases, at which the surface turns. [`TransformedMesh::bin_smooth_edges`] makes it and has an example.
#[derive(Debug)]
pub struct SmoothEdges<'a, V: Coordinate = i16> {
    transformed: TransformedMesh<'a, V, true>,
    bins: SmoothBins<'a>,
    memory: SmoothMemory<'a>,
}

/// The edges of a mesh that are smoothed, without the mesh.
#[derive(Debug)]
pub(super) struct SmoothBins<'a> {
    lists: EdgeLists<'a>,
    kinds: Kinds<'a>,
    /// The pixels that smoothing may change.
    pub(super) bounds: Scissor,
}

/// Memory for edges that are set up, and for pairs of pixels.
#[derive(Debug)]
pub(super) struct SmoothMemory<'a> {
    /// Each edge at its index modulo a power of two, which is larger by 1 than `mask`.
    list: &'a mut [SmoothEdge],
    mask: usize,
    /// For an edge without an entry in the list.
    own: SmoothEdge,
    pairs: Pairs,
}

/// An entry of a list of edges that are set up, of 72 bytes: [`SmoothEdges::keep_in`].
#[derive(Clone, Copy, Debug)]
pub struct SmoothEdge {
    /// The index of the edge and, in the higher 16 bits, of its object, and 1; 0 of no edge.
    number: u32,
    seen: Seen,
    crossed: CrossedEdge,
}

impl SmoothEdge {
    /// An entry without an edge, with which the caller's list begins.
    pub const EMPTY: Self = Self { number: 0, seen: Seen::NONE, crossed: CrossedEdge::EMPTY }; // all bits 0: a static takes no flash
}

/// What an edge is, in bits for each edge.
#[derive(Debug)]
struct Kinds<'a> {
    silhouettes: &'a mut [u16],
    wide: &'a mut [u16],
}

impl<'a, V: Coordinate> TransformedMesh<'a, V, true> {
    /// Finds the silhouettes of a mesh, and those of its creases that are in front, for [smoothing](crate::target::DepthTestedSurface::smooth).
    /// `is_crease` tells of an edge by its index whether it is a crease where both of its faces are drawn: `|_| false` for a surface that is
    /// lit smoothly, `|_| true` for one in facets, or whether the colours of the [faces beside it](crate::Mesh::edge_faces) differ: each crease that
    /// is left out saves as much as a face takes. `storage` has [`smooth_bins_len`](crate::Mesh::smooth_bins_len) numbers.
    ///
    /// **Only [edges that the mesh lists](crate::Mesh::with_edges) are smoothed: of a mesh without edges none, and that is no error.** List all of them, and the
    /// [faces beside them](crate::Mesh::with_edge_faces): otherwise these are searched.
    ///
    /// ```
    /// # use embedded_graphics::{pixelcolor::Gray8, prelude::*};
    /// # use pinhole::{mesh::edge_faces, prelude::*, Angle};
    /// const VERTICES: [[i16; 3]; 4] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    /// const FACES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    /// const EDGES: [[u16; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    /// const BESIDE: [[u16; 2]; 6] = edge_faces(&EDGES, &FACES);
    /// let mesh = Mesh::new(&VERTICES, 0, &FACES)?.with_edges(&EDGES)?.with_edge_faces(&BESIDE)?;
    /// # let size = Size::new(64, 64);
    /// # let viewport = Viewport::new(Point::zero(), size)?;
    /// # let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::degrees(20))?;
    /// let (mut pixels, mut depths) = ([Gray8::BLACK; 64 * 64], [0; 64 * 64]);
    /// let mut picture = Picture::new(&mut pixels, size)?;
    /// let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths)?;
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// instance.faces(|_| Gray8::WHITE).draw(&mut picture.pixels().depth_tested(&mut depth))?;
    /// # let count = |picture: &Picture<'_, Gray8>| picture.colors().iter().filter(|c| (1..255).contains(&c.luma())).count();
    /// # assert_eq!(count(&picture), 0);
    ///
    /// let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 4], [0; 16]); // `mesh.cache_len()`, and more than `mesh.smooth_bins_len()`
    /// let mut edges = instance.transform_depth(&mut cache).bin_smooth_edges(|_| false, &mut bins)?;
    /// picture.pixels().depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
    /// # assert!(count(&picture) > 50);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`bin_edges`](Self::bin_edges).
    #[inline(never)] // the result is large
    pub fn bin_smooth_edges(
        &self,
        is_crease: impl FnMut(usize) -> bool,
        storage: &'a mut [u16],
    ) -> Result<SmoothEdges<'a, V>, BufferError> {
        let bins = self.smooth_bins(is_crease, storage)?;
        Ok(SmoothEdges { transformed: *self, bins, memory: SmoothMemory::new() })
    }
}

impl<V: Coordinate> TransformedMesh<'_, V, true> {
    /// The edges that are smoothed.
    #[inline(always)]
    pub(super) fn smooth_bins<'s>(
        &self,
        mut is_crease: impl FnMut(usize) -> bool,
        storage: &'s mut [u16],
    ) -> Result<SmoothBins<'s>, BufferError> {
        let mesh = self.instance.mesh();
        let (needed, given) = (mesh.smooth_bins_len(), storage.len());
        let bits = mesh.edges.len().div_ceil(16);
        let all = storage.get_mut(..needed).and_then(|all| all.split_at_mut_checked(2 * bits));
        let (kinds, storage) = all.ok_or(BufferError::Bins { needed, given })?;
        kinds.fill(0);
        let (silhouettes, wide) = kinds.split_at_mut_checked(bits).unwrap_or_default();
        let kinds = Kinds { silhouettes, wide };
        let mut storage = BinStorage::new(storage, mesh.edges.len())?;
        // No edge is active yet: the bits tell which faces are drawn, if there are as many.
        let drawn_faces = storage.take_active();
        let are_faces_marked = self.mark_drawn_faces(drawn_faces);
        let viewport = pixels(self.instance.area());
        let (mut fill, mut statistics) = (storage.fill(viewport), Statistics::default());
        let mut own = SmoothEdge::EMPTY;
        fill.leave_all_out();
        let edge_faces = if are_faces_marked { mesh.edge_faces } else { &[] };
        let culls = self.instance.cull() != Cull::None;
        // From the last one to the first one: each bin has its edges in the order of the mesh.
        for (index, &edge) in mesh.edges.iter().enumerate().rev() {
            keep_rolled();
            let mut drawn = None;
            if let Some(&[one, other]) = edge_faces.get(index) {
                let count = [one, other].map(|face| u8::from(is_marked(drawn_faces, face.into())));
                let count = count[0] + count[1];
                if count == 0 || count == 2 && !is_crease(index) {
                    continue;
                }
                // Both faces lie on one side of an edge only where front and back faces are drawn: then their planes decide.
                drawn = (count == 1 || culls).then_some(count);
            }
            let Some(ends) = self.edge_out_of_line(edge, &mut statistics) else { continue };
            let is_silhouette = match drawn {
                Some(drawn) => drawn == 1,
                None if !self.set_up(index, 0, &viewport, &mut own) => continue,
                None => own.seen.kind != SeenKind::Crease,
            };
            let [from, to] = ends.map(|end| end.point);
            let is_wide = (to.x - from.x).abs() >= (to.y - from.y).abs();
            for (bits, is_set) in [(&mut *kinds.silhouettes, is_silhouette), (&mut *kinds.wide, is_wide)] {
                if let Some(bits) = bits.get_mut(index / 16) {
                    *bits |= u16::from(is_set) << (index % 16);
                }
            }
            if is_silhouette || drawn.is_some() || is_crease(index) {
                fill.add(index, &bounds(&ends));
            }
        }
        // A pixel that an edge crosses is mixed with its neighbour. Bounds without an edge remain empty.
        let bounds = fill.bounds.grown(1).clipped_to(&viewport);
        let (first, next, rows) = fill.links();
        Ok(SmoothBins { lists: EdgeLists::new(first, next, rows), kinds, bounds })
    }

    /// Sets a bit for each face that is drawn, and returns `true`; or nothing, if the bits are too few, or no edge lists its faces.
    fn mark_drawn_faces(&self, bits: &mut [u16]) -> bool {
        let mesh = self.instance.mesh();
        if mesh.edge_faces.is_empty() || bits.len() < mesh.faces.len().div_ceil(16) {
            return false;
        }
        // Whether faces of positive and of negative area are drawn.
        let [front, back] = [1, -1].map(|area| self.instance.cull().facing(area) == Facing::Drawn);
        for (bits, faces) in bits.iter_mut().zip(mesh.faces.chunks(16)) {
            *bits = faces.iter().rev().fold(0, |bits, face| {
                keep_rolled();
                let is_drawn = match self.on_screen(face) {
                    Some(corners) => match area::<true>(&corners) {
                        ..0 => back,
                        area => front && area != 0,
                    },
                    None => self.is_clipped_face_drawn(face),
                };
                bits << 1 | u32::from(is_drawn)
            }) as u16; // 16 bits
        }
        true
    }

    #[cold]
    #[inline(never)]
    fn is_clipped_face_drawn(&self, face: &[u16; 3]) -> bool {
        let viewport = pixels(self.instance.area());
        self.clip_face(face, &mut FaceTriangles::<()>::new(&viewport)).is_drawn()
    }

    /// Sets an edge up, with the planes of the drawn faces beside it. Returns whether there is such a face.
    #[inline(never)]
    fn set_up(&self, index: usize, id: u32, viewport: &Scissor, to: &mut SmoothEdge) -> bool {
        to.number = 0;
        let Some(&edge) = self.instance.mesh().edges.get(index) else { return false };
        let Some(ends) = self.edge_out_of_line(edge, &mut Statistics::default()) else { return false };
        let points = ends.map(|end| end.point);
        let Some(crossed) = CrossedEdge::new(points, ends.map(|end| end.depth)) else { return false };
        to.crossed = crossed;
        let SmoothEdge { crossed, seen: Seen { gradients, kind }, number } = to;
        let mut sides = 0; // a bit for each side on which a face lies
        self.each_face_beside(index, &points, viewport, |point, depth, side| {
            if side == 0 {
                return;
            }
            let (is_high, gradient) = (crossed.is_high(side), crossed.gradient(point, depth));
            let [low, high] = &mut *gradients;
            let (nearest, bit) = if is_high { (high, 2) } else { (low, 1) };
            // The nearest of several on one side.
            if sides & bit == 0 || (gradient < *nearest) == is_high {
                *nearest = gradient;
            }
            sides |= bit;
        });
        (*number, *kind) = (
            id,
            match sides {
                1 => SeenKind::Low,
                2 => SeenKind::High,
                _ => SeenKind::Crease,
            },
        );
        sides != 0
    }
}

impl<'a, V: Coordinate> SmoothEdges<'a, V> {
    /// Keeps edges that are set up, a power of two of them: an edge without an entry is set up again in each band, and twice if it is flat. 16
    /// entries are enough for the silhouettes of most meshes.
    ///
    /// ```
    /// # use pinhole::{draw::{SmoothEdge, SmoothEdges}, prelude::*};
    /// # fn each_frame<'a>(transformed: &pinhole::draw::TransformedMesh<'a, i16, true>, bins: &'a mut [u16], list: &'a mut [SmoothEdge; 16]) -> Option<()> {
    /// // let mut list = [SmoothEdge::EMPTY; 16];
    /// let mut edges = transformed.bin_smooth_edges(|_| false, bins).ok()?;
    /// edges.keep_in(list);
    /// # Some(())
    /// # }
    /// ```
    pub fn keep_in(&mut self, list: &'a mut [SmoothEdge]) {
        self.memory.keep_in(list);
    }

    /// The smallest rectangle around `faces`, the [bounds of the faces](crate::draw::BinnedFaces::bounds), and the pixels that smoothing may change,
    /// which lie inside the viewport and up to a pixel outside the faces: for [`DirtyRegions`](crate::bands::DirtyRegions).
    /// [`SmoothFrame`](crate::bands::SmoothFrame) has an example.
    pub fn bounds(&self, faces: Rectangle) -> Rectangle {
        let faces = inside(&faces);
        rectangle(&self.bins.bounds_with(&faces))
    }

    /// Smooths the edges in a pass, which [`smooth`](crate::target::DepthTestedSurface::smooth) makes: pixels that an edge crosses, and that
    /// no face hides, are mixed with their neighbours beyond the edge, by the area of the pixel that lies there.
    ///
    /// The area is exact but for the rounding of corners to 1/256 px, of the slope to 2⁻²⁹, and of shares to 1/32 or 1/256.
    #[inline(never)] // its stack frame does not exist while faces are drawn
    pub fn draw<C: Color + StoredPixel<Cell>, Cell: Copy>(&mut self, pass: &mut SmoothPass<'_, C, Cell>) {
        self.bins.draw(&self.transformed, 0, &mut self.memory, pass);
    }
}

impl<'a> SmoothMemory<'a> {
    pub(super) fn new() -> Self {
        Self { list: &mut [], mask: 0, own: SmoothEdge::EMPTY, pairs: [CrossedPair::EMPTY; 16] }
    }

    /// Keeps edges in a list from now on.
    pub(super) fn keep_in(&mut self, list: &'a mut [SmoothEdge]) {
        for edge in list.iter_mut() {
            keep_rolled();
            edge.number = 0;
        }
        self.mask = list.len().checked_ilog2().map_or(0, |bits| (1 << bits) - 1);
        self.list = list;
    }
}

impl SmoothBins<'_> {
    /// The smallest rectangle around the pixels that smoothing may change, and the bounds of the faces.
    pub(super) fn bounds_with(&self, faces: &Scissor) -> Scissor {
        match (faces.is_empty(), self.bounds.is_empty()) {
            (true, _) => self.bounds,
            (_, true) => *faces,
            _ => faces.union(&self.bounds),
        }
    }

    /// Smooths the edges of an object, whose number in a scene is `object`, in a pass.
    #[inline(always)]
    pub(super) fn draw<V: Coordinate, C: Color + StoredPixel<Cell>, Cell: Copy>(
        &mut self,
        transformed: &TransformedMesh<'_, V, true>,
        object: usize,
        memory: &mut SmoothMemory<'_>,
        pass: &mut SmoothPass<'_, C, Cell>,
    ) {
        let Self { lists, kinds, .. } = self;
        let SmoothMemory { list, mask, own, pairs } = memory;
        let viewport = pixels(transformed.instance.area());
        let (scissor, is_last) = (pass.pixels().clipped_to(&viewport), pass.is_last());
        if scissor.is_empty() {
            return;
        }
        let rows = scissor.rows();
        lists.advance(&rows, is_last, |index| {
            2 * usize::from(is_marked(kinds.silhouettes, index)) + usize::from(is_marked(kinds.wide, index))
        });
        // Creases, then silhouettes; the second pass mixes no neighbours in a row, as tall edges do.
        for kind in [0, 1, 2, 3] {
            let is_wide = kind & 1 != 0;
            if is_last && !is_wide || lists.is_empty(kind) {
                continue;
            }
            let axes = pass.axes(&scissor, !is_wide);
            lists.each(kind, |index| {
                let number = ((object as u32) << 16 | index as u32) + 1; // fewer than 65535 edges
                let free = |edge: &&mut SmoothEdge| edge.number == 0 || edge.number == number;
                let edge = list.get_mut(index & *mask).filter(free).unwrap_or(&mut *own);
                if edge.number != number && !transformed.set_up(index, number, &viewport, edge) {
                    return true;
                }
                pass.edge(&edge.crossed, &edge.seen, &axes, pairs);
                // The last row of a wide edge may be mixed with the row below it.
                let bottom = edge.crossed.bottom();
                let ends = if is_wide { is_last && bottom < rows.end } else { bottom <= rows.end };
                if ends {
                    edge.number = 0;
                }
                ends
            });
        }
    }
}

/// Whether the bit of a number is set.
#[inline(always)]
fn is_marked(bits: &[u16], at: usize) -> bool {
    bits.get(at / 16).is_some_and(|bits| bits >> (at % 16) & 1 != 0)
}

/// The bounding box of the pixels that an edge crosses.
#[inline(always)]
fn bounds([from, to]: &[UnpackedVertex; 2]) -> Scissor {
    let floor = |[a, b]: [i32; 2]| [a.min(b) >> 8, (a.max(b) >> 8) + 1];
    let [[left, right], [top, bottom]] = [[from.point.x, to.point.x], [from.point.y, to.point.y]].map(floor);
    Scissor::unclamped(left, top, right, bottom)
}

defmt_format!([] SmoothEdge, self, "smooth edge {=u32}", self.number);
defmt_format!([V: Coordinate] SmoothEdges<'_, V>, self, "edges to smooth, with a list of {=usize}", self.memory.list.len());

/// The figure of the documentation.
#[cfg(target_pointer_width = "32")]
const _: () = assert!(size_of::<SmoothEdge>() == 72);
