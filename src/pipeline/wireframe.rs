//! Wireframes: the edges of a mesh as lines.

use super::anti_aliased;
use super::draw_region::DrawRegion;
use super::drawable::StrokeFor;
use super::fill::line;
use super::instance::{AnyInstance, MeshInstance};
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::camera::{ScreenVertex, UnpackedVertex};
use crate::math::Coordinate;
use crate::scene::FacePlanes;
use crate::surface::Target;

/// The edge loop: clips each edge and calls `draw` with the index and the ends of each edge of which clipping leaves something.
///
/// # Errors
///
/// The first error of `draw`.
#[inline(always)]
pub(super) fn each_edge<V: Coordinate, E, const DEPTH: bool>(
    mesh: &TransformedMesh<'_, V, DEPTH>,
    mut draw: impl FnMut(usize, [UnpackedVertex; 2]) -> Result<(), E>,
) -> Result<Statistics, E> {
    let mut statistics = Statistics::NONE;
    let edges = mesh.instance.mesh().edges;
    for (index, &edge) in edges.iter().enumerate() {
        if let Some(ends) = mesh.edge(edge, &mut statistics) {
            draw(index, ends)?;
        }
    }
    Ok(statistics.with_the_rest_drawn(edges.len()))
}

impl<V: Coordinate, P: FacePlanes> MeshInstance<'_, V, P> {
    /// Draws the mesh's edges, each as a line: a Bresenham line of one colour, or [`AntiAliased`](crate::AntiAliased). Clipping
    /// at the target's border does not change an edge's pixels; an end that is clipped at the near plane, the far plane or the
    /// guard band is rounded to 1/256 px.
    ///
    /// `cache` is memory for transformed vertices. If it is as long as the mesh's vertex list, each vertex is transformed once.
    /// If it is shorter, or empty, the vertices beyond its end are transformed whenever an edge needs them: slower, but the
    /// picture is equal.
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn wireframe<T: Target, K: StrokeFor<T>>(
        &self,
        stroke: K,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        self.any.wireframe(stroke, cache, target)
    }

    /// Draws the mesh's edges as [`wireframe`](Self::wireframe) does, each with the stroke that `stroke` returns for its index: colours by
    /// edge, such as the depth cue by [`VertexFog`](crate::VertexFog). Edges are drawn in the order of the mesh, so where lines cross, the
    /// later edge is seen.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::{Rgb565, RgbColor}, prelude::*};
    /// use pinhole::{Affine, Angle, Color, Camera, Fog, Mesh, Picture, Point3, Projection, Scalar, Vector3, VertexFog, ViewTransform, Viewport};
    /// // A line away from the viewer in two edges.
    /// const VERTICES: [[i16; 3]; 3] = [[-3, 0, 3], [0, 0, 0], [3, 0, -3]];
    /// const EDGES: [[u16; 2]; 2] = [[0, 1], [1, 2]];
    /// let mesh = Mesh::new(&VERTICES, 0, &[])?.with_edges(&EDGES)?;
    /// # let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// # let [eye, origin] = [16, 0].map(|z| Point3::from_ints(0, 0, z));
    /// # let view = ViewTransform::look_at(eye, origin, Vector3::from_ints(0, 1, 0))?;
    /// # let lens = Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_int(1), Scalar::from_int(50))?;
    /// # let camera = Camera::new(&view, &lens, &viewport);
    /// let model = Affine::identity();
    /// let fog = Fog::linear(Scalar::from_int(12), Scalar::from_int(20))?; // the camera is at z = 16
    /// let fog = VertexFog::new(&fog, &camera, &model, mesh.exponent());
    /// let mut factors = [0; VERTICES.len()];
    /// fog.factors(&VERTICES, &mut factors); // once per frame
    /// let stroke = |edge: usize| {
    ///     let [a, b] = EDGES[edge].map(|vertex| factors[usize::from(vertex)]);
    ///     Rgb565::WHITE.over(Rgb565::BLACK, (a + b) / 2)
    /// };
    /// # let mut pixels = [Rgb565::BLUE; 64 * 64];
    /// # let mut picture = Picture::new(&mut pixels, Size::new(64, 64))?;
    /// camera.place(&mesh, &model).wireframe_by_edge(stroke, &mut [], &mut picture.pixels())?;
    /// # let seen: Vec<_> = pixels.iter().filter(|c| **c != Rgb565::BLUE).map(|c| c.g()).collect();
    /// assert!(seen.iter().max() > seen.iter().min()); // the far edge is darker
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn wireframe_by_edge<T: Target, K: StrokeFor<T>>(
        &self,
        stroke: impl FnMut(usize) -> K,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        self.any.wireframe_by_edge(stroke, cache, target)
    }
}

impl<V: Coordinate> AnyInstance<'_, V> {
    #[inline(never)] // its stack frame is gone when it returns
    fn wireframe<T: Target, K: StrokeFor<T>>(
        &self,
        stroke: K,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let DrawRegion { scissor, viewport } = DrawRegion::new(target, self.area());
        each_edge(&TransformedMesh::<V, false>::new(self, cache), |_, ends| {
            if K::IS_ANTI_ALIASED {
                anti_aliased::edge(&ends, &viewport, &scissor, stroke, target);
                return Ok(());
            }
            let [from, to] = ends;
            line(target, from.point.pixel(), to.point.pixel(), &scissor, stroke.color())
        })
    }

    #[inline(never)] // its stack frame is gone when it returns
    fn wireframe_by_edge<T: Target, K: StrokeFor<T>>(
        &self,
        mut stroke: impl FnMut(usize) -> K,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let DrawRegion { scissor, viewport } = DrawRegion::new(target, self.area());
        each_edge(&TransformedMesh::<V, false>::new(self, cache), |index, ends| {
            if K::IS_ANTI_ALIASED {
                anti_aliased::edge(&ends, &viewport, &scissor, stroke(index), target);
                return Ok(());
            }
            let [from, to] = ends;
            line(target, from.point.pixel(), to.point.pixel(), &scissor, stroke(index).color())
        })
    }
}
