//! Lines with a depth test: wireframes among solid objects, and hidden-line removal.

use super::anti_aliased;
use super::draw_region::DrawRegion;
use super::face_triangles::FaceTriangles;
use super::instance::{AnyInstance, MeshInstance};
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use super::wireframe::each_edge;
use crate::camera::{ScreenVertex, UnpackedVertex};
use crate::fast;
use crate::math::Coordinate;
use crate::raster::{self, Gradient, LineDepth, Scissor, ScreenPoint, Span};
use crate::scene::FacePlanes;
use crate::shading::Stroke;
use crate::surface::{DepthBuffer, Target};
use heapless::Vec;

impl<V: Coordinate, P: FacePlanes> MeshInstance<'_, V, P> {
    /// Draws the pixels of the mesh's edges that are as near as the depth buffer or nearer, and stores their depth: for axes,
    /// paths and cages among solid objects. `cache` is as in [`wireframe`](Self::wireframe).
    ///
    /// Call this after the solid objects were drawn [`depth_tested`](Self::depth_tested) into `depth`. An edge that lies in a
    /// face comes out in pieces, as rounding decides which of both is nearer: for the edges of the solid objects themselves use
    /// [`hidden_line`](Self::hidden_line).
    ///
    /// A pixel's depth is the depth of the line at the pixel's centre along the line's major axis, within 0.51 of a step for
    /// lines of at most 512 pixels; for longer lines within ½ + 2⁻¹³ and 2⁻¹⁷ for every pixel. A line whose two ends lie in one
    /// pixel is tested by its nearer end.
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn wireframe_depth_tested<T: Target, K: Stroke<T::Color>>(
        &self,
        stroke: K,
        cache: &mut [ScreenVertex],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        self.any.wireframe_depth_tested(stroke, cache, depth, target)
    }

    /// Draws the parts of the mesh's edges that no face hides: a wireframe of a solid object, on any target, also on 1-bit
    /// displays. First store the depth of this mesh, and of all others that may hide its edges, with
    /// [`depth_only`](Self::depth_only).
    ///
    /// A pixel of an edge is drawn if the edge is at least as near as the stored depth, or if the stored depth belongs to one
    /// of the two faces beside the edge ([`Mesh::with_edge_faces`](crate::Mesh::with_edge_faces)). The second rule is needed
    /// because a pixel's centre lies to one side of the edge, where the depth of a steep face differs much from that of the
    /// edge. If the mesh has no edge faces, all faces are searched for them, for each edge in each band: the same pixels, in a
    /// time that grows with the number of faces times that of edges. An edge whose two ends lie in one pixel is tested by its
    /// nearer end.
    ///
    /// So no pixel is drawn where the edge lies more than two steps behind the nearest face at the pixel's centre, unless that
    /// face is beside the edge. Errors are possible within a pixel of the point at which another face begins to hide the edge:
    /// at least 99.8 % of the pixels in which a part of an edge is visible are drawn, and at most 0.3 % of the drawn pixels
    /// show a part that is just hidden (`tests/pipeline/hidden_lines.rs`). If an edge lies in a face that is not beside it,
    /// such as the lower edge of a box on a floor, about half of the edge's pixels are missing.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// use pinhole::{
    ///     edge_faces, space::{Model, World}, Affine, Angle, Camera, DepthBuffer, Mesh, Point3, Projection,
    ///     Scalar, Vector3, ViewTransform, Viewport,
    /// };
    /// const VERTICES: [[i16; 3]; 4] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    /// const FACES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    /// const EDGES: [[u16; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    /// const BESIDE: [[u16; 2]; 6] = edge_faces(&EDGES, &FACES);
    /// let mesh = Mesh::new(&VERTICES, 0, &FACES)?.with_edges(&EDGES)?.with_edge_faces(&BESIDE)?;
    /// let mut display = MockDisplay::<BinaryColor>::new();
    /// # display.set_allow_overdraw(true);
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::new(
    ///     &ViewTransform::look_at(Point3::from_ints(0, 0, 5), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
    ///     &Projection::perspective(Angle::degrees(45), viewport.size(), Scalar::from_int(1), Scalar::from_int(9))?,
    ///     &viewport,
    /// );
    /// let model = Affine::<Model, World>::rotation_y(Angle::degrees(20));
    /// let instance = camera.place(&mesh, &model);
    /// let mut storage = [0; 64 * 64];
    /// let mut depth = DepthBuffer::new(display.bounding_box(), &mut storage)?;
    /// instance.depth_only(&mut [], &mut depth);
    /// instance.hidden_line(BinaryColor::On, &mut [], &mut depth, &mut display)?;
    /// // The edge at the back is hidden: from (-1, 1, -1) to (1, -1, -1), through the middle.
    /// let lit = |x, y| display.get_pixel(Point::new(x, y)).is_some();
    /// let [from, to] = [2, 1].map(|i| instance.project(i).unwrap().point.pixel());
    /// assert!(lit(from.x.into(), from.y.into()) && lit(to.x.into(), to.y.into()));
    /// assert!(!lit((i32::from(from.x) + i32::from(to.x)) / 2, (i32::from(from.y) + i32::from(to.y)) / 2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn hidden_line<T: Target, K: Stroke<T::Color>>(
        &self,
        stroke: K,
        cache: &mut [ScreenVertex],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        self.any.hidden_line(stroke, cache, depth, target)
    }
}

impl<V: Coordinate> AnyInstance<'_, V> {
    #[inline(never)] // its stack frame is gone when it returns
    fn wireframe_depth_tested<T: Target, K: Stroke<T::Color>>(
        &self,
        stroke: K,
        cache: &mut [ScreenVertex],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let region = DrawRegion::shared(&target.area(), self.area(), Some(depth));
        let mesh = TransformedMesh::<V, true>::new(self, cache);
        each_edge(&mesh, |_, ends| draw_nearer(&ends, stroke, &region, depth, target))
    }

    #[inline(never)] // its stack frame is gone when it returns
    fn hidden_line<T: Target, K: Stroke<T::Color>>(
        &self,
        stroke: K,
        cache: &mut [ScreenVertex],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let region = DrawRegion::shared(&target.area(), self.area(), Some(depth));
        let mesh = TransformedMesh::<V, true>::new(self, cache);
        each_edge(&mesh, |edge, ends| mesh.draw_hidden_line(edge, &ends, stroke, &region, depth, target))
    }
}

impl<V: Coordinate> TransformedMesh<'_, V, true> {
    /// Draws the pixels of an edge that are as near as the depth buffer, or where the stored depth is that of a face beside the
    /// edge.
    #[inline(always)]
    pub(super) fn draw_hidden_line<T: Target, K: Stroke<T::Color>>(
        &self,
        edge: usize,
        ends: &[UnpackedVertex; 2],
        stroke: K,
        region: &DrawRegion,
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<(), T::Error> {
        let (mut beside, mut first) = (Beside::new(), 0);
        loop {
            let more = self.triangles_beside(edge, first, &region.viewport, &mut beside);
            let is_beside = |stored, x, y| beside.iter().any(|triangle| triangle.is_stored(stored, x, y));
            if K::IS_ANTI_ALIASED {
                // Once, with all triangles: a pixel must not be mixed twice.
                let is_beside = |stored, x, y| {
                    is_beside(stored, x, y)
                        || more && self.is_further_beside(edge, beside.len(), &region.viewport, stored, x, y)
                };
                let DrawRegion { viewport, scissor } = region;
                anti_aliased::visible_edge(ends, false, &is_beside, viewport, scissor, stroke, depth, target);
                return Ok(());
            }
            draw_visible(ends, false, &is_beside, stroke.color(), &region.scissor, depth, target)?;
            if !more {
                return Ok(());
            }
            first += beside.len();
        }
    }

    /// Whether the stored depth of a pixel belongs to a face beside an edge, from triangle number `first` on: the rare case of
    /// more triangles than fit.
    #[inline(never)] // its stack frame is gone when it returns
    fn is_further_beside(
        &self,
        edge: usize,
        mut first: usize,
        viewport: &Scissor,
        stored: u16,
        x: i32,
        y: i32,
    ) -> bool {
        loop {
            let mut beside = Beside::new();
            let more = self.triangles_beside(edge, first, viewport, &mut beside);
            if beside.iter().any(|triangle| triangle.is_stored(stored, x, y)) {
                return true;
            }
            if !more {
                return false;
            }
            first += beside.len();
        }
    }

    /// Fills `beside` with triangles of the faces beside an edge, clipped as they were when their depth was stored, beginning
    /// with triangle number `first`. Returns whether there are more triangles than fit.
    #[inline(never)]
    fn triangles_beside(&self, edge: usize, first: usize, viewport: &Scissor, beside: &mut Beside) -> bool {
        beside.clear();
        let (mesh, mut number) = (self.instance.mesh(), 0);
        let mut triangles = FaceTriangles::<()>::new(viewport);
        let most = if mesh.edge_faces.is_empty() { mesh.faces.len() } else { 2 };
        for at in 0..most {
            let Some(face) = mesh.face_beside(edge, at) else { continue };
            if !self.clip_face(face, &mut triangles).is_drawn() {
                continue;
            }
            loop {
                if number >= first {
                    let triangle = triangles.fan.triangle();
                    let points = *triangle.triangle.corners();
                    if beside
                        .push(TriangleBeside {
                            points,
                            depth: fast::depth_gradient(&triangle.triangle, &triangle.depths),
                        })
                        .is_err()
                    {
                        return true;
                    }
                }
                number += 1; // fewer than 2·CORNERS
                if !V::CLIPS || !triangles.fan.advance() {
                    break;
                }
            }
        }
        false
    }
}

/// Triangles of the faces beside an edge, two at a time, as stack is scarce. If clipping makes more than two triangles of the
/// faces, which is rare, the line is drawn again for each further two.
type Beside = Vec<TriangleBeside, 2>;

/// A triangle of a face beside an edge.
struct TriangleBeside {
    points: [ScreenPoint; 3],
    depth: Gradient,
}

impl TriangleBeside {
    /// Whether the stored depth of a pixel belongs to this triangle: the values are equal, and the pixel's centre lies inside
    /// the triangle or on its border.
    fn is_stored(&self, stored: u16, x: i32, y: i32) -> bool {
        (self.depth.at(x, y) >> 16) as u16 == stored && {
            let center = ScreenPoint::inside(x * 256 + 128, y * 256 + 128); // of a pixel of the target
            let [a, b, c] = self.points;
            let sides = [[a, b, center], [b, c, center], [c, a, center]].map(|side| raster::area(&side));
            sides.iter().all(|&side| side >= 0) || sides.iter().all(|&side| side <= 0)
        }
    }
}

/// Draws the pixels of a line that are as near as the depth buffer or nearer, and stores their depth.
#[inline(always)]
pub(super) fn draw_nearer<T: Target, K: Stroke<T::Color>>(
    ends: &[UnpackedVertex; 2],
    stroke: K,
    region: &DrawRegion,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let DrawRegion { viewport, scissor } = region;
    if K::IS_ANTI_ALIASED {
        anti_aliased::visible_edge(ends, true, &|_, _, _| false, viewport, scissor, stroke, depth, target);
        return Ok(());
    }
    draw_visible(ends, true, &|_, _, _| false, stroke.color(), scissor, depth, target)
}

/// Draws the pixels of a line that are as near as the depth buffer or nearer, or for which `is_drawn_over` is true, given the
/// stored depth and the pixel. `stores`: the depth of drawn pixels is stored.
#[inline(never)] // one copy for both callers; `is_drawn_over` is called only where the line lies behind the stored depth
fn draw_visible<T: Target>(
    ends: &[UnpackedVertex; 2],
    stores: bool,
    is_drawn_over: &dyn Fn(u16, i32, i32) -> bool,
    color: T::Color,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let line_depth = LineDepth::new(ends.map(|end| end.point), ends.map(|end| end.depth));
    let [from, to] = ends.map(|end| end.point.pixel());
    raster::line(from, to, scissor, |span| {
        let is_visible = |x, y, stored: &mut u16| {
            let own = line_depth.depth(x, y);
            let is_visible = own <= *stored || is_drawn_over(*stored, x, y);
            if is_visible && stores {
                *stored = own;
            }
            is_visible
        };
        depth.along(span, is_visible, |visible| fill_run(target, visible, color))
    })
}

/// Fills a run of a line.
#[inline(never)] // code size: `along` has several calls
fn fill_run<T: Target>(target: &mut T, run: Span, color: T::Color) -> Result<(), T::Error> {
    target.fill(run, color)
}
