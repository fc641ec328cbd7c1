//! Silhouettes and creases, which are smoothed after the faces are drawn.

use super::binned::DrawnWith;
use super::bins::BinStorage;
use super::cull::Cull;
use super::draw_region::pixels;
use super::edge_lists::{EdgeLists, KINDS, WIDE_CREASES, WIDE_SILHOUETTES};
use super::face_triangles::FaceTriangles;
use super::hidden_line::third_corner;
use super::statistics::Statistics;
use super::vertex_cache::{area, TransformedMesh};
use crate::camera::UnpackedVertex;
use crate::color::{Color, StoredPixel};
use crate::math::hints::keep_rolled;
use crate::math::Coordinate;
use crate::raster::{CrossedEdge, Scissor};
use crate::surface::{inside, rectangle, BufferError, Seen, SeenKind, SmoothPass, Tested};
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
    kinds: &'a mut [Kinds],
    /// The pixels that smoothing may change.
    pub(super) bounds: Scissor,
}

/// Memory for edges that are set up.
#[derive(Debug)]
pub(super) struct SmoothMemory<'a> {
    /// Each edge at its index modulo a power of two, which is larger by 1 than `mask`.
    list: &'a mut [SmoothEdge],
    mask: usize,
    /// For an edge without an entry in the list.
    own: SmoothEdge,
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

/// Three bits for each of 16 edges.
type Kinds = [u16; 3];
/// Word of [`Kinds`]: silhouettes.
const SILHOUETTE: usize = 0;
/// Word of [`Kinds`]: creases, and silhouettes whose second face is drawn.
const SECOND: usize = 1;
/// Word of [`Kinds`]: edges wider than tall.
const WIDE: usize = 2;

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Finds the silhouettes of a mesh, and those of its creases that are in front, for [smoothing](crate::target::DepthTestedSurface::smooth).
    /// `is_crease` tells of an edge by its index whether it is a crease where both of its faces are drawn: `|_| false` for a surface that is
    /// lit smoothly, `|_| true` for one in facets, or whether the colours of the [faces beside it](crate::Mesh::edge_faces) differ: each crease that
    /// is left out saves as much as a face takes. `storage` has [`smooth_bins_len`](crate::Mesh::smooth_bins_len) numbers.
    ///
    /// **Only [edges that the mesh lists](crate::Mesh::with_edges) are smoothed: of a mesh without edges none, and that is no error.** List all edges, each
    /// once: an edge that is listed twice is mixed twice. List the [faces beside them](crate::Mesh::with_edge_faces), too: otherwise all faces are searched
    /// for each edge.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
    /// use pinhole::{meshes::CUBE, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::degrees(20))?;
    /// let (mut pixels, mut depths) = ([Gray8::BLACK; 64 * 64], [0; 64 * 64]);
    /// let mut picture = Picture::new(&mut pixels, viewport.size())?;
    /// let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths)?;
    /// let instance = camera.place(&CUBE, &Affine::identity());
    /// instance.faces(|_| Gray8::WHITE).draw(&mut picture.pixels().depth_tested(&mut depth))?;
    /// # assert!(picture.colors().iter().all(|c| [0, 255].contains(&c.luma())));
    ///
    /// let mut buffers = mesh_buffers!(smooth: CUBE);
    /// let mut edges = instance.transform_depth(&mut buffers.cache).bin_smooth_edges(|_| false, &mut buffers.edge_bins)?;
    /// picture.pixels().depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
    /// # assert!(picture.colors().iter().filter(|c| (1..255).contains(&c.luma())).count() > 50);
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
    ) -> Result<SmoothEdges<'a, V>, BufferError>
    where
        Self: DrawnWith<Tested>,
    {
        let bins = self.smooth_bins(is_crease, storage)?;
        // Vertices have depth here, by the bound, from which the compiler does not conclude it.
        let transformed = TransformedMesh::with_cache(self.instance, true, self.cache);
        Ok(SmoothEdges { transformed, bins, memory: SmoothMemory::new() })
    }
}

impl<V: Coordinate> DrawnWith<Tested> for TransformedMesh<'_, V, true> {}

impl<V: Coordinate, const DEPTH: bool> TransformedMesh<'_, V, DEPTH> {
    /// The edges that are smoothed.
    #[inline(always)]
    pub(super) fn smooth_bins<'s>(
        &self,
        mut is_crease: impl FnMut(usize) -> bool,
        storage: &'s mut [u16],
    ) -> Result<SmoothBins<'s>, BufferError> {
        let mesh = self.instance.mesh();
        let mut storage = BinStorage::new(storage, mesh.edges.len(), 3)?;
        let (kinds, _) = storage.take_bits().as_chunks_mut();
        self.mark_silhouettes(storage.next, kinds);
        let viewport = pixels(self.instance.area());
        let mut fill = storage.fill(viewport);
        // From the last one to the first one: each bin has its edges in the order of the mesh.
        for (word, kinds) in kinds.iter_mut().enumerate().rev() {
            let [silhouettes, seconds, _] = kinds.map(u32::from);
            let (mut rest, mut smooth, mut wide) = (silhouettes, 0, 0);
            // A loop of its own, which LLVM removes where no edge is a crease: S3 then takes 7k less in bands on an M3.
            let mut fronts = seconds & !silhouettes;
            while fronts != 0 {
                let bit = fronts & fronts.wrapping_neg();
                fronts ^= bit;
                rest |= if is_crease(16 * word + bit.trailing_zeros() as usize) { bit } else { 0 };
            }
            while rest != 0 {
                keep_rolled();
                let bit = 1 << (31 - rest.leading_zeros());
                rest ^= bit;
                let index = 16 * word + bit.trailing_zeros() as usize;
                let Some(ends) = self.edge_at(index) else { continue };
                if fill.add(index, &bounds(&ends)) {
                    let [from, to] = ends.map(|end| end.point);
                    smooth |= bit;
                    wide |= if (to.x - from.x).abs() >= (to.y - from.y).abs() { bit } else { 0 };
                }
            }
            kinds[SILHOUETTE] &= smooth as u16; // 16 bits
            kinds[SECOND] &= smooth as u16;
            kinds[WIDE] = wide as u16;
        }
        // A pixel that an edge crosses is mixed with its neighbour. Bounds without an edge remain empty.
        let bounds = fill.bounds.grown(1).clipped_to(&viewport);
        let (first, next, rows) = fill.links();
        Ok(SmoothBins { lists: EdgeLists::new(first, next, rows), kinds, bounds })
    }

    /// Whether the drawn faces beside an edge tell what it is: edges list their faces, the memory for edges has room for a number for each face, and
    /// front or back faces are culled; otherwise both faces of an edge may lie on one side.
    #[inline(always)]
    fn knows_silhouettes(&self) -> bool {
        let mesh = self.instance.mesh();
        self.instance.cull() != Cull::None
            && !mesh.edge_faces.is_empty()
            && mesh.faces.len() <= mesh.edges.len()
    }

    /// Marks silhouettes, and edges that may be creases. `flags`: memory for a number for each edge.
    #[inline(never)] // the loops get all registers
    fn mark_silhouettes(&self, flags: &mut [u16], kinds: &mut [Kinds]) {
        let (mesh, is_front_drawn) = (self.instance.mesh(), self.instance.cull() == Cull::Back);
        if !self.knows_silhouettes() {
            return self.find_silhouettes(kinds, true);
        }
        for (flag, face) in flags.iter_mut().zip(mesh.faces) {
            keep_rolled();
            *flag = match self.on_screen(face) {
                // The area with two corners exchanged is negative for faces in front.
                Some([a, b, c]) if is_front_drawn => u16::from(area::<true>(&[a, c, b]) < 0),
                Some(corners) => u16::from(area::<true>(&corners) < 0),
                None => u16::from(self.is_clipped_face_drawn(face)),
            };
        }
        let flags = flags.get(..mesh.faces.len()).unwrap_or_default();
        for (kinds, faces) in kinds.iter_mut().zip(mesh.edge_faces.chunks(16)) {
            let (mut silhouettes, mut seconds) = (0, 0);
            for beside in faces.iter().rev() {
                keep_rolled();
                let [one, second] =
                    beside.map(|face| flags.get(usize::from(face)).map_or(0, |&flag| u32::from(flag)));
                (silhouettes, seconds) = (silhouettes << 1 | (one ^ second), seconds << 1 | second);
            }
            *kinds = [silhouettes as u16, seconds as u16, 0]; // 16 bits
        }
        if mesh.has_unlisted_faces {
            self.find_silhouettes(kinds, false);
        }
    }

    /// Marks silhouettes, and edges that may be creases, by the planes of the drawn faces beside them: of `all` edges, or of those that list
    /// one face twice.
    #[cold]
    #[inline(never)]
    fn find_silhouettes(&self, kinds: &mut [Kinds], all: bool) {
        let (viewport, mut own) = (pixels(self.instance.area()), SmoothEdge::EMPTY);
        for (word, kinds) in kinds.iter_mut().enumerate() {
            for at in 0..16 {
                keep_rolled();
                let index = 16 * word + at;
                if !all && self.instance.mesh().listed_beside(index).is_some() {
                    continue;
                }
                *kinds = kinds.map(|bits| bits & !(1 << at));
                if self.set_up(index, 0, 0, &viewport, &mut own) {
                    let is_crease = own.seen.kind == SeenKind::Crease;
                    kinds[usize::from(is_crease)] |= 1 << at;
                }
            }
        }
    }

    #[cold]
    #[inline(never)]
    fn is_clipped_face_drawn(&self, face: &[u16; 3]) -> bool {
        let viewport = pixels(self.instance.area());
        self.clip_face(face, &mut FaceTriangles::<()>::new(&viewport)).is_drawn()
    }

    /// Sets an edge up. Returns whether it is one, and has a drawn face beside it. `drawn`: a bit for each drawn face of those listed beside it;
    /// 0: not known.
    #[inline(never)]
    fn set_up(&self, index: usize, id: u32, drawn: u32, viewport: &Scissor, to: &mut SmoothEdge) -> bool {
        to.number = 0;
        let Some(ends) = self.edge_at(index) else { return false };
        let Some(crossed) = CrossedEdge::new(ends.map(|end| end.point), ends.map(|end| end.depth)) else {
            return false;
        };
        to.crossed = crossed;
        if !self.find_gradients(index, drawn, viewport, to) {
            return false;
        }
        to.number = id;
        true
    }

    /// The ends of an edge.
    #[inline(always)]
    fn edge_at(&self, index: usize) -> Option<[UnpackedVertex; 2]> {
        self.edge_out_of_line(*self.instance.mesh().edges.get(index)?, &mut Statistics::default())
    }

    /// The [third corner](third_corner) of one of the faces listed beside an edge, which is drawn, and whether it lies on the side of larger minor
    /// coordinates; `None` if the face does not lie on the screen.
    #[inline(never)] // it ends early, and its caller adds up in one place
    fn corner_beside(&self, index: usize, at: usize, crossed: &CrossedEdge) -> Option<(u16, bool)> {
        let mesh = self.instance.mesh();
        let face = mesh.listed_face(*mesh.listed_beside(index)?.get(at)?)?;
        self.on_screen(face)?;
        let (corner, is_along) = third_corner(mesh.edges.get(index)?, face)?;
        // A drawn face is turned as all are: the order of its corners says on which side it lies.
        Some((corner, crossed.is_high(is_along == (self.instance.cull() == Cull::Front))))
    }

    /// Finds the planes of the drawn faces beside an edge. Returns whether there is such a face. `drawn`: as in [`set_up`](Self::set_up).
    #[inline(never)]
    fn find_gradients(&self, index: usize, drawn: u32, viewport: &Scissor, to: &mut SmoothEdge) -> bool {
        let SmoothEdge { crossed, seen: Seen { gradients, kind }, .. } = to;
        let mut sides = 0; // a bit for each side on which a face lies
        let mut add = |sides: &mut u32, point, depth, is_high| {
            let gradient = crossed.gradient(point, depth);
            let [low, high] = &mut *gradients;
            let (nearest, bit) = if is_high { (high, 2) } else { (low, 1) };
            // The nearest of several on one side.
            if *sides & bit == 0 || (gradient < *nearest) == is_high {
                *nearest = gradient;
            }
            *sides |= bit;
        };
        let mut is_on_screen = |at: usize| {
            let Some((corner, is_high)) = self.corner_beside(index, at, crossed) else { return false };
            let UnpackedVertex { point, depth } =
                self.instance.vertex_transform().unpack::<true>(self.screen_vertex(corner));
            add(&mut sides, point, depth, is_high);
            true
        };
        let mut are_on_screen = drawn != 0;
        for at in 0..2 {
            keep_rolled();
            are_on_screen &= drawn >> at & 1 == 0 || is_on_screen(at);
        }
        if !are_on_screen {
            sides = 0;
            self.each_face_beside(index, &crossed.ends(), viewport, |point, depth, side| {
                if side != 0 {
                    add(&mut sides, point, depth, crossed.is_high(side < 0));
                }
            });
        }
        *kind = match sides {
            1 => SeenKind::Low,
            2 => SeenKind::High,
            _ => SeenKind::Crease,
        };
        sides != 0
    }
}

impl<'a, V: Coordinate> SmoothEdges<'a, V> {
    /// Keeps edges that are set up in the entries of `list`, of which the largest power of two is used. An edge without an entry is
    /// set up again in each band, and twice if it is wide. 16 entries hold the silhouettes that meet a band of most meshes. Declare the list before the
    /// edges, which borrow it.
    ///
    /// ```
    /// use embedded_graphics::geometry::{Point, Size};
    /// use pinhole::{draw::SmoothEdge, meshes::CUBE, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let instance = camera.place(&CUBE, &Affine::identity());
    /// let (mut buffers, mut list) = (mesh_buffers!(smooth: CUBE), [SmoothEdge::EMPTY; 16]);
    /// let mut edges = instance.transform_depth(&mut buffers.cache).bin_smooth_edges(|_| false, &mut buffers.edge_bins)?;
    /// edges.keep_in(&mut list);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
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
        Self { list: &mut [], mask: 0, own: SmoothEdge::EMPTY }
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
        let SmoothMemory { list, mask, own } = memory;
        let viewport = pixels(transformed.instance.area());
        let (scissor, number) = (pass.pixels().clipped_to(&viewport), pass.number());
        if scissor.is_empty() {
            return;
        }
        let rows = scissor.rows();
        if number == 0 {
            lists.advance(&rows, |index| {
                let [is_silhouette, is_second, is_wide] =
                    kinds.get(index / 16)?.map(|bits| bits >> (index % 16) & 1 != 0);
                (is_silhouette || is_second).then_some(2 * usize::from(is_silhouette) + usize::from(is_wide))
            });
        }
        for kind in 0..KINDS {
            keep_rolled();
            if lists.is_empty(kind) {
                continue;
            }
            // A bit for each of its passes.
            let passes = match kind {
                WIDE_CREASES => 0b011,
                WIDE_SILHOUETTES => 0b110,
                _ => 0b001,
            };
            let (is_wide, passes) = (kind & 1 != 0, passes >> (number & 3));
            if passes & 1 == 0 {
                continue;
            }
            let axes = pass.axes(&scissor, !is_wide);
            lists.each(kind, |index| {
                let id = ((object as u32) << 16 | index as u32) + 1; // fewer than 65535 edges
                let free = |edge: &&mut SmoothEdge| edge.number == 0 || edge.number == id;
                let edge = list.get_mut(index & *mask).filter(free).unwrap_or(&mut *own);
                let drawn = || match kinds.get(index / 16) {
                    Some(_) if !transformed.knows_silhouettes() => 0,
                    Some(kinds) if kind > 1 => 1 << (kinds[SECOND] >> (index % 16) & 1),
                    _ => 0b11,
                };
                if edge.number != id && !transformed.set_up(index, id, drawn(), &viewport, edge) {
                    return true;
                }
                pass.edge(&edge.crossed, &edge.seen, &axes);
                // The last row of a wide edge may be mixed with the row below it.
                let bottom = edge.crossed.bottom();
                let ends = passes == 1 && bottom < rows.end + i32::from(!is_wide);
                if ends {
                    edge.number = 0;
                }
                ends
            });
        }
    }
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
