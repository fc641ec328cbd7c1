//! Silhouettes and creases, which are smoothed after the faces are drawn.

use super::bins::{each_active, BinStorage, Bins};
use super::cull::{Cull, Facing};
use super::draw_region::pixels;
use super::face_triangles::FaceTriangles;
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::camera::UnpackedVertex;
use crate::color::{Color, StoredPixel};
use crate::math::hints::keep_rolled;
use crate::math::unrolled::map3;
use crate::math::Coordinate;
use crate::raster::{area, CrossedEdge, Scissor};
use crate::surface::{BufferError, Corner, Seen, SmoothPass};
use core::convert::Infallible;

/// The edges of a mesh that are smoothed in a picture, binned by their first rows: silhouettes, beyond which no face of the mesh follows, and
/// creases, at which the surface turns. [`TransformedMesh::bin_smooth_edges`] makes it and has an example.
#[derive(Debug)]
pub struct SmoothEdges<'a, V: Coordinate = i16> {
    transformed: TransformedMesh<'a, V, true>,
    bins: Bins<'a>,
    /// A bit for each edge: set for creases.
    creases: &'a [u16],
}

impl<'a, V: Coordinate> TransformedMesh<'a, V, true> {
    /// Finds the silhouettes of a mesh, and those of its creases that are in front, for [smoothing](crate::target::DepthTestedSurface::smooth).
    /// `is_crease` tells of an edge by its index whether it is a crease where both of its faces are drawn: `|_| false` for a surface that is
    /// lit smoothly, `|_| true` for one in facets. `storage` has [`smooth_bins_len`](crate::Mesh::smooth_bins_len) numbers. The mesh should list all of its edges,
    /// and the [faces beside them](crate::Mesh::with_edge_faces).
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
        mut is_crease: impl FnMut(usize) -> bool,
        storage: &'a mut [u16],
    ) -> Result<SmoothEdges<'a, V>, BufferError> {
        let mesh = self.instance.mesh();
        let (needed, given) = (mesh.smooth_bins_len(), storage.len());
        let bits = mesh.edges.len().div_ceil(16);
        let all = storage.get_mut(..needed).and_then(|all| all.split_at_mut_checked(bits));
        let (creases, storage) = all.ok_or(BufferError::Bins { needed, given })?;
        creases.fill(0);
        let mut storage = BinStorage::new(storage, mesh.edges.len())?;
        // The bits of active edges are not in use yet: they tell which faces are drawn, if there are as many.
        let are_faces_marked = self.mark_drawn_faces(storage.active());
        let viewport = pixels(self.instance.area());
        let (mut fill, mut statistics) = (storage.fill(viewport), Statistics::default());
        for (index, &edge) in mesh.edges.iter().enumerate() {
            keep_rolled();
            let beside = mesh.edge_faces.get(index).filter(|_| are_faces_marked);
            // Both faces lie on one side of an edge only where front and back faces are drawn: then their planes decide.
            let mut kind = beside.map(|beside| beside.map(|face| is_marked(fill.active(), face.into())));
            if kind == Some([true; 2]) && self.instance.cull() == Cull::None {
                kind = None;
            }
            if kind == Some([false; 2]) || kind == Some([true; 2]) && !is_crease(index) {
                continue;
            }
            let Some(ends) = self.edge_out_of_line(edge, &mut statistics) else { continue };
            let is_crease = match kind {
                Some(drawn) => drawn == [true; 2],
                None => match crossed(&ends).and_then(|crossed| self.seen(index, &crossed, &viewport)) {
                    Some(Seen::Silhouette { .. }) => false,
                    Some(Seen::Crease(_)) if is_crease(index) => true,
                    _ => continue,
                },
            };
            if let Some(bits) = creases.get_mut(index / 16) {
                *bits |= u16::from(is_crease) << (index % 16);
            }
            fill.add(index, &bounds(&ends));
        }
        Ok(SmoothEdges { transformed: *self, bins: fill.bins(), creases })
    }

    /// Sets a bit for each face that is drawn, and returns `true`; or nothing, if the bits are too few, or no edge lists its faces.
    fn mark_drawn_faces(&self, bits: &mut [u16]) -> bool {
        let mesh = self.instance.mesh();
        if mesh.edge_faces.is_empty() || bits.len() < mesh.faces.len().div_ceil(16) {
            return false;
        }
        for (bits, faces) in bits.iter_mut().zip(mesh.faces.chunks(16)) {
            *bits = 0;
            for face in faces.iter().rev() {
                keep_rolled();
                let is_drawn = match self.on_screen(face) {
                    Some(corners) => {
                        let area = area(&map3(corners, |corner| corner.offset::<true>()));
                        self.instance.cull().facing(area) == Facing::Drawn
                    }
                    None => self.is_clipped_face_drawn(face),
                };
                *bits = *bits << 1 | u16::from(is_drawn);
            }
        }
        true
    }

    #[cold]
    #[inline(never)]
    fn is_clipped_face_drawn(&self, face: &[u16; 3]) -> bool {
        let viewport = pixels(self.instance.area());
        self.clip_face(face, &mut FaceTriangles::<()>::new(&viewport)).is_drawn()
    }

    /// Between which pixels an edge is seen, by the planes of the drawn faces beside it.
    #[inline(never)]
    fn seen(&self, index: usize, edge: &CrossedEdge, viewport: &Scissor) -> Option<Seen> {
        let mut corners: [Option<Corner>; 2] = [None; 2];
        self.each_face_beside(index, edge.ends(), viewport, |point, depth, side| {
            if side == 0 {
                return;
            }
            let (is_high, corner) = (edge.is_high(side), Corner { point, depth });
            let [low, high] = &mut corners;
            let nearest = if is_high { high } else { low };
            // The nearest of several on one side.
            let is_nearer = |other: Corner| {
                let [own, other] = [corner, other].map(|Corner { point, depth }| edge.gradient(point, depth));
                if is_high {
                    own < other
                } else {
                    own > other
                }
            };
            if nearest.is_none_or(is_nearer) {
                *nearest = Some(corner);
            }
        });
        match corners {
            [Some(corner), None] => Some(Seen::Silhouette { corner, is_high: false }),
            [None, Some(corner)] => Some(Seen::Silhouette { corner, is_high: true }),
            [Some(low), Some(high)] => {
                let gradient = |Corner { point, depth }| edge.gradient(point, depth);
                Some(Seen::Crease([gradient(low), gradient(high)]))
            }
            [None, None] => None,
        }
    }
}

impl<V: Coordinate> SmoothEdges<'_, V> {
    /// Smooths the edges in a pass, which [`smooth`](crate::target::DepthTestedSurface::smooth) makes: pixels that an edge crosses, and that
    /// no face hides, are mixed with their neighbours beyond the edge, by the area of the pixel that lies there.
    ///
    /// The area is exact but for the rounding of corners to 1/256 px, of the slope to 2⁻²⁹, and of shares to 1/32 or 1/256.
    #[inline(never)] // its stack frame does not exist while faces are drawn
    pub fn draw<C: Color + StoredPixel<Cell>, Cell: Copy>(&mut self, pass: &mut SmoothPass<'_, C, Cell>) {
        let Self { transformed, bins, creases } = self;
        let viewport = pixels(transformed.instance.area());
        let scissor = pass.pixels().clipped_to(&viewport);
        if scissor.is_empty() {
            return;
        }
        let (rows, is_last) = pass.rows();
        // The passes over a band are one visit of the bins, which begins with the first pass that draws.
        if !is_last || bins.is_new() {
            bins.advance_to_band(&rows);
        }
        let edges = transformed.instance.mesh().edges;
        let mut statistics = Statistics::default();
        let has_creases = creases.iter().any(|bits| *bits != 0);
        // Creases first: where both meet, what lies beyond a silhouette is mixed with the smoothed crease.
        for of_creases in [true, false].into_iter().skip(usize::from(!has_creases)) {
            let Ok(()) = each_active(bins.active(), |index| {
                if is_marked(creases, index) != of_creases {
                    return Ok(false);
                }
                let edge = edges.get(index).copied().unwrap_or_default();
                let Some(ends) = transformed.edge_out_of_line(edge, &mut statistics) else { return Ok(true) };
                let Some(crossed) = crossed(&ends) else { return Ok(true) };
                if let Some(seen) = transformed.seen(index, &crossed, &viewport) {
                    pass.edge(&crossed, seen, &scissor);
                }
                Ok::<bool, Infallible>(is_last && bounds(&ends).rows().end <= rows.end)
            });
        }
    }
}

/// Whether the bit of a number is set.
#[inline(always)]
fn is_marked(bits: &[u16], at: usize) -> bool {
    bits.get(at / 16).is_some_and(|bits| bits >> (at % 16) & 1 != 0)
}

/// The edge between two vertices.
#[inline(always)]
fn crossed(ends: &[UnpackedVertex; 2]) -> Option<CrossedEdge> {
    CrossedEdge::new(ends.map(|end| end.point), ends.map(|end| end.depth))
}

/// The bounding box of the pixels that an edge crosses.
#[inline(always)]
fn bounds([from, to]: &[UnpackedVertex; 2]) -> Scissor {
    let floor = |[a, b]: [i32; 2]| [a.min(b) >> 8, (a.max(b) >> 8) + 1];
    let [[left, right], [top, bottom]] = [[from.point.x, to.point.x], [from.point.y, to.point.y]].map(floor);
    Scissor::unclamped(left, top, right, bottom)
}

defmt_format!([V: Coordinate] SmoothEdges<'_, V>, self, "edges to smooth within {}", self.bins.bounds());
