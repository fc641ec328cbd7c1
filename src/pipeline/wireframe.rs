//! Wireframes: the edges of a mesh as lines.

use super::anti_aliased;
use super::draw_region::DrawRegion;
use super::drawable::StrokeFor;
use super::fill::line;
use super::instance::MeshInstance;
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::camera::{ScreenVertex, UnpackedVertex};
use crate::color::Access;
use crate::math::Coordinate;
use crate::surface::{Surface, Target};

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

/// The edges of an instance, with the closure that gives their strokes: drawn by one more call. [`MeshInstance::edges`] makes it.
#[must_use = "`.draw(&mut target)` draws the edges, `.hidden_line(&mut target)` those in sight"]
#[derive(Debug)]
pub struct Edges<'a, V: Coordinate, F> {
    pub(super) instance: &'a MeshInstance<'a, V>,
    pub(super) stroke: F,
    pub(super) cache: &'a mut [ScreenVertex],
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// The mesh's edges, to be drawn as lines. `stroke` is called once for each edge that is drawn, with the edge's index, and returns
    /// its colour, or [`AntiAliased`](crate::shading::AntiAliased) of it. Edges are drawn in the order of the mesh, so where lines of several
    /// colours cross, the later edge is seen.
    ///
    /// Colours by edge, such as the depth cue by [`VertexFog`](crate::fog::VertexFog):
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::{Rgb565, RgbColor}, prelude::*};
    /// use pinhole::{fog::{Fog, VertexFog}, prelude::*, Angle};
    /// // A line away from the viewer in two edges.
    /// const VERTICES: [[i16; 3]; 3] = [[-3, 0, 3], [0, 0, 0], [3, 0, -3]];
    /// const EDGES: [[u16; 2]; 2] = [[0, 1], [1, 2]];
    /// let mesh = Mesh::new(&VERTICES, 0, &[])?.with_edges(&EDGES)?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), Scalar::from_int(16), Angle::ZERO, Angle::ZERO);
    /// let lens = Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_int(1), Scalar::from_int(50))?;
    /// let camera = Camera::new(&view, &lens, &viewport);
    /// let model = Affine::identity();
    /// let fog = Fog::new(Scalar::from_int(12), Scalar::from_int(20))?; // the camera is at z = 16
    /// let fog = VertexFog::new(&fog, &camera, &model, mesh.exponent());
    /// let factors = VERTICES.map(|vertex| fog.factor(vertex)); // once per frame
    /// let stroke = |edge: usize| {
    ///     let [a, b] = EDGES[edge].map(|vertex| factors[usize::from(vertex)]);
    ///     Rgb565::WHITE.over(Rgb565::BLACK, (a + b) / 2)
    /// };
    /// let mut pixels = [Rgb565::BLUE; 64 * 64];
    /// let mut picture = Picture::new(&mut pixels, Size::new(64, 64))?;
    /// camera.place(&mesh, &model).edges(stroke).draw(&mut picture.pixels())?;
    /// let seen: Vec<_> = pixels.iter().filter(|c| **c != Rgb565::BLUE).map(|c| c.g()).collect();
    /// assert!(seen.iter().max() > seen.iter().min()); // the far edge is darker
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(always)]
    pub fn edges<K, F: FnMut(usize) -> K>(&self, stroke: F) -> Edges<'_, V, F> {
        Edges { instance: self, stroke, cache: &mut [] }
    }
}

impl<'a, V: Coordinate, F> Edges<'a, V, F> {
    /// With memory for transformed vertices: as long as the mesh's vertex list, so that each vertex is transformed once. Without it,
    /// or beyond its end, a vertex is transformed for each edge that needs it: slower, but the picture is equal.
    #[inline(always)]
    pub fn cached(self, cache: &'a mut [ScreenVertex]) -> Self {
        Self { cache, ..self }
    }

    /// Draws each edge as a line: a Bresenham line of one colour, or [`AntiAliased`](crate::shading::AntiAliased). Clipping
    /// at the target's border does not change an edge's pixels; an end that is clipped at the near plane, the far plane or the
    /// guard band is rounded to 1/256 px.
    ///
    /// Into a target [with a depth buffer](crate::target::Surface::depth_tested) it draws the pixels that are as near as the buffer or nearer,
    /// and stores their depth: for axes, paths and cages among solid objects, after those objects. An edge that lies in a face comes
    /// out in pieces, as rounding decides which of both is nearer: for the edges of the solid objects themselves use
    /// [`hidden_line`](Self::hidden_line). A pixel's depth is the depth of the line at the pixel's centre along the line's major axis, or
    /// that of an end if the centre lies beyond it, within 0.51 of a step for lines of at most 512 pixels; for longer lines within ½ + 2⁻¹³ and 2⁻¹⁷ for every pixel. A line
    /// whose two ends lie in one pixel is tested by its nearer end.
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn draw<T: Target, K: StrokeFor<T::Surface>>(self, target: &mut T) -> Result<Statistics, T::Error>
    where
        F: FnMut(usize) -> K,
    {
        target.dispatch(
            self,
            |Edges { instance, stroke, cache }, surface| instance.wireframe(stroke, cache, surface),
            |Edges { instance, stroke, cache }, surface, depth| {
                instance.wireframe_depth_tested(stroke, cache, depth, surface)
            },
        )
    }
}

defmt_format!([V: Coordinate, F] Edges<'_, V, F>, self, "edges of {}", self.instance);

impl<V: Coordinate> MeshInstance<'_, V> {
    #[inline(never)] // its stack frame is gone when it returns
    fn wireframe<T: Surface, K: StrokeFor<T>>(
        &self,
        mut stroke: impl FnMut(usize) -> K,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let DrawRegion { scissor, viewport } = DrawRegion::new(target, self.area());
        each_edge(&TransformedMesh::<V, false>::new(self, cache), |index, ends| {
            if <K::Access as Access>::READS {
                anti_aliased::edge(&ends, &viewport, &scissor, stroke(index), target);
                return Ok(());
            }
            let [from, to] = ends;
            line(target, from.point.pixel(), to.point.pixel(), &scissor, stroke(index).color())
        })
    }
}
