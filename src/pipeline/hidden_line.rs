//! Lines with a depth test: wireframes among solid objects, and hidden-line removal.

use super::anti_aliased;
use super::cull::Facing;
use super::draw_region::DrawRegion;
use super::drawable::StrokeFor;
use super::face_triangles::FaceTriangles;
use super::instance::MeshInstance;
use super::statistics::Statistics;
use super::vertex_cache::{self, TransformedMesh};
use super::wireframe::{each_edge, Edges};
use crate::camera::{ScreenVertex, UnpackedVertex};
use crate::color::Access;
use crate::math::Coordinate;
use crate::raster::{
    area, DepthTriangle, EdgePlanes, LineDepth, LineSetup, LineSpans, Scissor, ScreenPoint, Span,
};
use crate::surface::{DepthBuffer, Surface, WithDepth};

impl<V: Coordinate, F> Edges<'_, V, F> {
    /// Draws the parts of the mesh's edges that no face hides: a wireframe of a solid object, on any target, also on 1-bit
    /// displays. First store the depth of this mesh, and of all others that may hide its edges, with
    /// [`depth_only`](MeshInstance::depth_only).
    ///
    /// A pixel of an edge is drawn if the edge, or the plane of a front face beside it, is at least as near as the stored depth
    /// at the pixel's centre, or less than a step behind it. The plane counts on the side of the edge on which the face lies, beyond
    /// the face, too. So an edge is never hidden by the faces beside it, nor by any other face of a convex object, which all lie
    /// behind that plane. This includes a silhouette, an edge between a front face and a back face, and an edge of a front face
    /// that is seen edge-on. The faces beside an edge are those of [`Mesh::with_edge_faces`](crate::Mesh::with_edge_faces). If the
    /// mesh does not list them, all faces are searched, for each edge in each band: the same pixels, in a time that grows with the
    /// number of faces times that of edges.
    ///
    /// Of one convex object, every pixel of every edge in sight is drawn. Of other objects and scenes, 99.95 % of an edge's pixels in
    /// sight are drawn, as the mean over all edges; one edge in 1000 lacks more than a tenth of them; and at most 0.05 % of the
    /// drawn pixels have no edge in sight within a pixel (`tests/pipeline/hidden_lines.rs`). Within a pixel of the point at which
    /// another face begins to hide an edge, either may come out. A hidden edge of a front face that is seen edge-on may be drawn
    /// if what hides it lies closely before it. If an edge lies in a face that is not beside it, such as the lower edge of a box
    /// on a floor, about half of the edge's pixels are missing. An edge whose two ends lie in one pixel is tested by its nearer
    /// end.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// use pinhole::{mesh::edge_faces, prelude::*, Angle};
    /// const VERTICES: [[i16; 3]; 4] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    /// const FACES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    /// const EDGES: [[u16; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    /// const BESIDE: [[u16; 2]; 6] = edge_faces(&EDGES, &FACES);
    /// let mesh = Mesh::new(&VERTICES, 0, &FACES)?.with_edges(&EDGES)?.with_edge_faces(&BESIDE)?;
    /// let mut display = MockDisplay::<BinaryColor>::new();
    /// display.set_allow_overdraw(true);
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let model = Affine::<Model, World>::rotation_y(Angle::degrees(20));
    /// let instance = camera.place(&mesh, &model);
    /// let mut storage = [0; 64 * 64];
    /// let mut depth = DepthBuffer::new(display.bounding_box(), &mut storage)?;
    /// instance.depth_only(&mut [], &mut depth);
    /// instance.edges(|_| BinaryColor::On).hidden_line(&mut display.depth_tested(&mut depth))?;
    /// // The edge at the back is hidden: from (-1, 1, -1) to (1, -1, -1), through the middle.
    /// let lit = |at| display.get_pixel(at).is_some();
    /// let [from, to] = [2, 1].map(|i| instance.project(i).unwrap().into());
    /// assert!(lit(from) && lit(to) && !lit((from + to) / 2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn hidden_line<T: WithDepth, K: StrokeFor<T::Surface>>(
        self,
        target: &mut T,
    ) -> Result<Statistics, T::Error>
    where
        F: FnMut(usize) -> K,
    {
        target.dispatch(
            self,
            |_, _| Ok(Statistics::NONE), // never called
            |Self { instance, stroke, cache }, surface, depth| {
                instance.hidden_line(stroke, cache, depth, surface)
            },
        )
    }
}

impl<V: Coordinate> MeshInstance<'_, V> {
    #[inline(never)] // its stack frame is gone when it returns
    pub(super) fn wireframe_depth_tested<T: Surface, K: StrokeFor<T>>(
        &self,
        mut stroke: impl FnMut(usize) -> K,
        cache: &mut [ScreenVertex],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let region = DrawRegion::shared(&target.area(), self.area(), Some(depth));
        let mesh = TransformedMesh::<V, true>::new(self, cache);
        each_edge(&mesh, |edge, ends| draw_nearer(&ends, stroke(edge), &region, depth, target))
    }

    #[inline(never)] // its stack frame is gone when it returns
    fn hidden_line<T: Surface, K: StrokeFor<T>>(
        &self,
        mut stroke: impl FnMut(usize) -> K,
        cache: &mut [ScreenVertex],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let region = DrawRegion::shared(&target.area(), self.area(), Some(depth));
        let mesh = TransformedMesh::<V, true>::new(self, cache);
        each_edge(&mesh, |edge, ends| {
            mesh.draw_hidden_line(edge, &ends, stroke(edge), &region, depth, target)
        })
    }
}

impl<V: Coordinate, const DEPTH: bool> TransformedMesh<'_, V, DEPTH> {
    /// Draws the pixels of an edge where the edge, or the plane of a face beside it, is as near as the depth buffer.
    #[inline(always)]
    pub(super) fn draw_hidden_line<T: Surface, K: StrokeFor<T>>(
        &self,
        edge: usize,
        ends: &[UnpackedVertex; 2],
        stroke: K,
        region: &DrawRegion,
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<(), T::Error> {
        let viewport = &region.viewport;
        let mut beside = PlanesBeside { mesh: self, edge, ends, viewport, are_found: false, planes: None };
        if <K::Access as Access>::READS {
            let line_depth = line_depth(ends);
            let tall = line_depth.step().0;
            let mut is_surface =
                |stored, x, y| beside.are_in_front(&line_depth, stored, if tall { [y, x] } else { [x, y] });
            anti_aliased::visible_edge(
                ends,
                false,
                &mut is_surface,
                viewport,
                &region.scissor,
                stroke,
                depth,
                target,
            );
            return Ok(());
        }
        let mut is_surface = |line_depth: &_, stored, pixel| beside.are_in_front(line_depth, stored, pixel);
        draw_visible(ends, false, &mut is_surface, stroke.color(), &region.scissor, depth, target)
    }

    /// Calls `add` for each drawn face beside an edge between these points, with a corner that is not an end of the edge, its depth in 16.8,
    /// and the [`area`] of the edge and this corner.
    #[inline(always)]
    pub(super) fn each_face_beside(
        &self,
        edge: usize,
        ends: &[ScreenPoint; 2],
        viewport: &Scissor,
        mut add: impl FnMut(ScreenPoint, i32, i64),
    ) {
        let mesh = self.instance.mesh();
        let Some(edge_ends) = mesh.edges.get(edge) else { return };
        let listed = mesh.listed_beside(edge);
        for at in 0..listed.map_or(mesh.faces.len(), |pair| pair.len()) {
            let face = match listed {
                Some(pair) => pair.get(at).and_then(|&face| mesh.listed_face(face)),
                None => mesh.faces.get(at).filter(|face| edge_ends.iter().all(|end| face.contains(end))),
            };
            let Some(face) = face else { continue };
            let found = match self.on_screen(face).or_else(|| self.uncached_corners(face)) {
                Some(corners) => self.corner_of_drawn(edge_ends, face, corners, ends),
                None if V::CLIPS => self.corner_of_clipped(face, ends, viewport),
                None => None,
            };
            if let Some((corner, depth, side)) = found {
                add(corner, depth, side);
            }
        }
    }

    /// Of a face with these corners, if it is drawn, the corner that is not an end of an edge, its depth in 16.8, and the [`area`] of the edge and this
    /// corner.
    #[inline(always)]
    fn corner_of_drawn(
        &self,
        edge_ends: &[u16; 2],
        face: &[u16; 3],
        corners: [ScreenVertex; 3],
        ends: &[ScreenPoint; 2],
    ) -> Option<(ScreenPoint, i32, i64)> {
        if self.instance.cull().facing(vertex_cache::area::<DEPTH>(&corners)) != Facing::Drawn {
            return None;
        }
        let (index, _) = third_corner(edge_ends, face)?; // `None` if the face is not beside the edge
        let corner = self.screen_vertex(index);
        let UnpackedVertex { point, depth } = self.instance.vertex_transform().unpack::<DEPTH>(corner);
        Some((point, depth, side_of(ends, point)))
    }

    /// Of a face that is clipped, if it is drawn, the corner of the polygon that is farthest from the edge.
    #[cold]
    #[inline(never)] // its stack frame is not set up for faces on the screen
    fn corner_of_clipped(
        &self,
        face: &[u16; 3],
        ends: &[ScreenPoint; 2],
        viewport: &Scissor,
    ) -> Option<(ScreenPoint, i32, i64)> {
        let mut triangles = FaceTriangles::<()>::new(viewport);
        if !self.clip_face(face, &mut triangles).is_drawn() {
            return None;
        }
        let mut farthest = (ScreenPoint::ORIGIN, 0, 0);
        loop {
            let DepthTriangle { triangle, depths } = triangles.fan.triangle();
            for (&corner, &depth) in triangle.corners().iter().zip(depths) {
                let side = side_of(ends, corner);
                if side.abs() > i64::abs(farthest.2) {
                    farthest = (corner, depth, side);
                }
            }
            if !triangles.fan.advance() {
                break;
            }
        }
        Some(farthest)
    }
}

/// The planes of the drawn faces beside an edge, found when they are first needed.
struct PlanesBeside<'a, V: Coordinate, const DEPTH: bool> {
    mesh: &'a TransformedMesh<'a, V, DEPTH>,
    edge: usize,
    ends: &'a [UnpackedVertex; 2],
    viewport: &'a Scissor,
    are_found: bool,
    planes: Option<EdgePlanes>,
}

impl<V: Coordinate, const DEPTH: bool> PlanesBeside<'_, V, DEPTH> {
    /// [`EdgePlanes::are_in_front`]; `None` if there is no plane.
    #[inline(always)]
    fn are_in_front(&mut self, line_depth: &LineDepth, stored: u16, pixel: [i32; 2]) -> Option<bool> {
        if !self.are_found {
            self.find(line_depth);
        }
        self.planes.as_ref().map(|planes| planes.are_in_front(stored, pixel))
    }

    #[inline(never)] // its stack frame is gone when it returns
    fn find(&mut self, line_depth: &LineDepth) {
        let Self { mesh, edge, ends, viewport, are_found, planes } = self;
        *are_found = true;
        let points = ends.map(|end| end.point);
        mesh.each_face_beside(*edge, &points, viewport, |corner, depth, side| {
            if planes.is_none() {
                EdgePlanes::set(planes, &points, ends.map(|end| end.depth), line_depth);
            }
            if let Some(planes) = planes {
                planes.add(corner, depth, side);
            }
        });
    }
}

/// The [`area`] of an edge and a point.
#[inline(always)]
fn side_of(&[from, to]: &[ScreenPoint; 2], point: ScreenPoint) -> i64 {
    area(&[from, to, point])
}

/// The corner of a face that is not an end of an edge, and whether the face has the edge from its first to its second end. `None` if
/// the face has not both ends, or has no area.
#[inline(always)]
pub(super) fn third_corner([from, to]: &[u16; 2], [a, b, c]: &[u16; 3]) -> Option<(u16, bool)> {
    let is_end = |index: &u16| index == from || index == to;
    if !is_end(c) {
        (is_end(a) && is_end(b)).then_some((*c, a == from))
    } else if !is_end(a) {
        is_end(b).then_some((*a, b == from))
    } else {
        (!is_end(b)).then_some((*b, c == from))
    }
}

/// Depth along an edge.
#[inline(always)]
fn line_depth(ends: &[UnpackedVertex; 2]) -> LineDepth {
    LineDepth::new(ends.map(|end| end.point), ends.map(|end| end.depth))
}

/// Draws the pixels of a line that are as near as the depth buffer or nearer, and stores their depth.
#[inline(always)]
pub(super) fn draw_nearer<T: Surface, K: StrokeFor<T>>(
    ends: &[UnpackedVertex; 2],
    stroke: K,
    region: &DrawRegion,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let DrawRegion { viewport, scissor } = region;
    if <K::Access as Access>::READS {
        anti_aliased::visible_edge(ends, true, &mut |_, _, _| None, viewport, scissor, stroke, depth, target);
        return Ok(());
    }
    draw_visible(ends, true, &mut |_, _, _| None, stroke.color(), scissor, depth, target)
}

/// Whether a pixel of a line is drawn that lies behind the stored depth: given the depth along the line, the stored depth, and the
/// pixel's coordinates along the line's major and minor axis. `None`: no pixel of this line is ever drawn over.
type IsDrawnOver<'a> = dyn FnMut(&LineDepth, u16, [i32; 2]) -> Option<bool> + 'a;

/// Draws the pixels of a line that are as near as the depth buffer or nearer, or for which `is_drawn_over` is true. `stores`: the depth of drawn
/// pixels is stored.
#[inline(never)] // one copy for both callers; `is_drawn_over` is called only where the line lies behind the stored depth
fn draw_visible<T: Surface>(
    ends: &[UnpackedVertex; 2],
    stores: bool,
    is_drawn_over: &mut IsDrawnOver<'_>,
    color: T::Color,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let [from, to] = ends.map(|end| end.point.pixel());
    let setup = LineSetup::new(from, to);
    let line =
        if setup.lies_in(scissor) { LineSpans::unclipped(&setup) } else { LineSpans::new(&setup, scissor) };
    let line_depth = LineDepth::on_axis(line.tall, ends.map(|end| end.point), ends.map(|end| end.depth));
    let mut may_be_drawn_over = true;
    let is_visible = |own, stored: &mut u16, pixel| {
        let is_visible = own <= u32::from(*stored)
            || may_be_drawn_over && {
                let is_drawn_over = is_drawn_over(&line_depth, *stored, pixel);
                may_be_drawn_over = is_drawn_over.is_some();
                is_drawn_over == Some(true)
            };
        if is_visible && stores {
            *stored = own as u16; // a step of depth
        }
        is_visible
    };
    depth.along(line, &line_depth, is_visible, |visible| fill_run(target, visible, color))
}

/// Fills a run of a line.
#[inline(never)] // code size: `along` has several calls
fn fill_run<T: Surface>(target: &mut T, run: Span, color: T::Color) -> Result<(), T::Error> {
    target.fill(run, color)
}
