//! The face loop, from a face source over a vertex cache to a sink, and the draw calls that consist of it. Any source works
//! with any cache and any sink:
//!
//! | source | cache | sink |
//! |---|---|---|
//! | [`MeshOrder`], [`PlaneOrder`], [`ClusterOrder`], binned faces | [`TransformedMesh`], [`LazyCache`] | a fill, a depth-tested fill, depth only, bins, a painter, picking |

use super::cull::Facing;
use super::draw_region::DrawRegion;
use super::drawable::ShaderFor;
use super::face_source::{ClusterOrder, FaceSource, MeshOrder, PlaneOrder};
use super::face_triangles::FaceTriangles;
use super::fill::{fill, fill_nearer};
use super::instance::MeshInstance;
use super::statistics::{Outcome, Statistics};
use super::vertex_cache::{area, LazyCache, TransformedMesh, VertexCache};
use crate::camera::ScreenVertex;
use crate::clip::Varying;
use crate::fast;
use crate::math::unrolled::map3;
use crate::math::Coordinate;
use crate::raster::{DepthTriangle, Scissor};
use crate::shading::{CornerValues, Shader};
use crate::surface::{DepthBuffer, DepthTarget, Surface, Target};
use core::convert::Infallible;

/// The face loop: culls each face that `source` pushes, clips it if a corner is not on the screen, and calls `sink` with the
/// index, the vertices and the triangles of each visible face. `sink` returns whether the face is finished: see
/// [`FaceSource::push`].
///
/// # Errors
///
/// The first error of `sink`.
#[inline(always)]
pub(super) fn each_face<
    'a,
    V: Coordinate + 'a,
    C: VertexCache<'a, V, DEPTH>,
    K: Varying,
    S: FaceSource,
    E,
    const DEPTH: bool,
>(
    source: S,
    cache: &mut C,
    viewport: &Scissor,
    mut sink: impl FnMut(usize, &[u16; 3], &mut FaceTriangles<'_, K>) -> Result<bool, E>,
) -> Result<Statistics, E> {
    let mut statistics = Statistics::NONE;
    let mut triangles = FaceTriangles::new(viewport);
    let instance = cache.instance();
    let faces = instance.mesh().faces;
    source.push(faces, |index, face| {
        match cache.corners(face) {
            // The common case. Culled faces are not counted one by one: see `with_the_rest_culled`.
            Some(corners) => {
                let area = area::<DEPTH>(&corners);
                let facing = if C::CULLED { Facing::Drawn } else { instance.cull().facing(area) };
                match facing {
                    Facing::Drawn => {}
                    Facing::Culled => return Ok(true),
                    Facing::EdgeOn => {
                        statistics.count(Outcome::Degenerate);
                        return Ok(true);
                    }
                }
                if !S::may_show::<DEPTH>(instance.vertex_transform(), &corners) {
                    return Ok(true); // counted as culled
                }
                let Some(corners) = cache.reload_corners(face, corners) else { return Ok(true) };
                statistics.count(Outcome::Unclipped);
                let transform = instance.vertex_transform();
                triangles
                    .fan
                    .set_unclipped::<DEPTH>(&map3(corners, |corner| transform.unpack::<DEPTH>(corner)), area);
            }
            None if !V::CLIPS => {
                statistics.count(Outcome::Outside);
                return Ok(true);
            }
            None => {
                let outcome = cache.view_with_corners(face).clip_face(face, &mut triangles);
                statistics.count(outcome);
                if !outcome.is_drawn() {
                    return Ok(true);
                }
            }
        }
        sink(index, face, &mut triangles)
    })?;
    Ok(statistics.with_the_rest_culled(faces.len()))
}

/// The shader of a face's current triangle, with the depths and 1/w of the triangle's corners if the shader needs them.
#[inline(always)]
pub(super) fn triangle_shader<V: Coordinate, S: Shader>(
    instance: &MeshInstance<'_, V>,
    face: &[u16; 3],
    triangles: &FaceTriangles<'_, S::Varying>,
    shader: &S,
) -> S {
    let shader = if V::CLIPS { triangles.shader(shader) } else { *shader };
    if !(S::NEEDS_DEPTH || S::NEEDS_W) {
        return shader;
    }
    let w = if !S::NEEDS_W {
        [1; 3]
    } else if V::CLIPS && triangles.fan.is_cut() {
        triangles.fan.clip_w()
    } else {
        w_of_corners(instance, face)
    };
    shader.with_corners(&CornerValues::new(triangles.fan.triangle().depths, w))
}

/// Clip space's w at the corners of a face that is not cut.
#[inline(never)] // code size
fn w_of_corners<V: Coordinate>(instance: &MeshInstance<'_, V>, face: &[u16; 3]) -> [i32; 3] {
    let (vertices, transform) = (instance.mesh().vertices, instance.vertex_transform());
    map3(*face, |index| {
        let vertex = vertices.get(usize::from(index)); // Mesh has checked that there is one
        vertex.map_or(1, |vertex| transform.w(vertex))
    })
}

/// Draws the triangles of a face: `draw` gets each with its shader.
#[inline(always)]
pub(super) fn draw_triangles<V: Coordinate, S: Shader, E>(
    instance: &MeshInstance<'_, V>,
    face: &[u16; 3],
    triangles: &mut FaceTriangles<'_, S::Varying>,
    shader: &S,
    mut draw: impl FnMut(&DepthTriangle<'_>, &S) -> Result<(), E>,
) -> Result<(), E> {
    loop {
        // The common case passes the face's shader by reference: no copy.
        let own;
        let shader = if V::CLIPS && triangles.fan.is_cut() || S::NEEDS_DEPTH || S::NEEDS_W {
            own = triangle_shader(instance, face, triangles, shader);
            &own
        } else {
            shader
        };
        draw(triangles.fan.triangle(), shader)?;
        if !V::CLIPS || !triangles.fan.advance() {
            return Ok(());
        }
    }
}

/// Draws faces without a depth test.
#[inline(always)]
pub(super) fn solid<'a, V: Coordinate + 'a, T: Surface, S: ShaderFor<T>, const DEPTH: bool>(
    source: impl FaceSource,
    mut cache: impl VertexCache<'a, V, DEPTH>,
    region: &DrawRegion,
    mut shade: impl FnMut(usize) -> S,
    target: &mut T,
) -> Result<Statistics, T::Error> {
    let instance = cache.instance();
    each_face(source, &mut cache, &region.viewport, |index, face, triangles| {
        let shader = shade(index);
        draw_triangles(instance, face, triangles, &shader, |triangle, shader| {
            fill(&triangle.triangle, shader, &region.scissor, false, target)
        })?;
        Ok(true)
    })
}

/// Draws the pixels of faces that are nearer than a depth buffer, and stores their depth.
#[inline(always)]
pub(super) fn depth_tested<'a, V: Coordinate + 'a, T: Surface, S: ShaderFor<T>>(
    source: impl FaceSource,
    mut cache: impl VertexCache<'a, V, true>,
    region: &DrawRegion,
    mut shade: impl FnMut(usize) -> S,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) -> Result<Statistics, T::Error> {
    let instance = cache.instance();
    let mut depth = DepthTarget::new(depth, target);
    each_face(source, &mut cache, &region.viewport, |index, face, triangles| {
        let shader = shade(index);
        draw_triangles(instance, face, triangles, &shader, |triangle, shader| {
            fill_nearer(triangle, shader, &region.scissor, false, &mut depth, target)
        })?;
        Ok(true)
    })
}

/// Stores the depth of a face's triangles.
#[inline(always)]
pub(super) fn store_depth<V: Coordinate>(
    triangles: &mut FaceTriangles<'_, ()>,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
) {
    loop {
        let triangle = triangles.fan.triangle();
        let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
        for span in fast::spans(&triangle.triangle, scissor) {
            let Ok(()) = depth.test(span, &gradient, |_| Ok::<(), Infallible>(()));
        }
        if !V::CLIPS || !triangles.fan.advance() {
            return;
        }
    }
}

/// The faces of an instance, with the closure that shades them: drawn, or [picked](Self::pick), by one more call.
/// [`MeshInstance::faces`] makes it.
#[must_use = "`.draw(&mut target)` draws the faces, `.pick(pixel)` finds the one in a pixel"]
#[derive(Debug)]
pub struct Faces<'a, V: Coordinate, F, const CULLED_BY: u8 = NOTHING> {
    pub(super) instance: &'a MeshInstance<'a, V>,
    pub(super) shade: F,
    pub(super) cache: &'a mut [ScreenVertex],
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// The faces, to be drawn or picked. `shade` is called once for each face that is drawn, with the face's index, and returns its
    /// colour or another [`Shader`](crate::shading::Shader).
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{meshes::CUBE, prelude::*, Angle};
    /// let mut display = MockDisplay::<Gray8>::new();
    /// display.set_allow_overdraw(true);
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let cube = camera.place(&CUBE, &Affine::identity());
    /// cube.faces(|_| Gray8::WHITE).draw(&mut display)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(always)]
    pub fn faces<S, F: FnMut(usize) -> S>(&self, shade: F) -> Faces<'_, V, F> {
        Faces { instance: self, shade, cache: &mut [] }
    }
}

/// How a draw call culls faces before it transforms their vertices: not at all, by planes, or by clusters and planes.
pub(super) const NOTHING: u8 = 0;
pub(super) const PLANES: u8 = 1;
pub(super) const CLUSTERS: u8 = 2;

impl<'a, V: Coordinate, F, const CULLED_BY: u8> Faces<'a, V, F, CULLED_BY> {
    /// Culls back faces by the [planes](crate::Mesh::with_planes) of the mesh, if it has any, before their vertices are transformed. Worth
    /// it for closed meshes of a few hundred faces or more: `with_planes` says when, and has an example. Firmware links this code only if
    /// it calls this.
    #[inline(always)]
    pub fn culled_by_planes(self) -> Faces<'a, V, F, PLANES> {
        let Self { instance, shade, cache } = self;
        Faces { instance, shade, cache }
    }

    /// Culls faces by the [clusters](crate::Mesh::with_planes) of the mesh, if it has any, which leaves out 32 faces by one test:
    /// those that lie outside of the viewport or before the near plane as a whole, or are turned away. In other clusters back faces are
    /// culled by their planes, and faces beside the viewport before they are shaded. Worth it for meshes of a thousand faces or more, most
    /// of which are out of view or turned away.
    ///
    /// The picture equals that of [`culled_by_planes`](Self::culled_by_planes). In the [`Statistics`] faces that are left out count as
    /// `culled`, also those out of view. Firmware links this code only if it calls this.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// let mut display = MockDisplay::<Gray8>::new();
    /// let mesh = Mesh::new(&[[0, 0, 0], [1, 0, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?.with_normals(&[[0, 0, 32_767]])?;
    /// let mesh = mesh.with_planes(&[0, 8192, 8192, 0, 11_586, 0, 0, 32_767, 0])?; // pinhole-import makes them
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let aside = Affine::translation(Vector3::from_ints(9, 0, 0));
    /// let statistics = camera.place(&mesh, &aside).faces(|_| Gray8::WHITE).culled_by_clusters().draw(&mut display)?;
    /// assert_eq!(statistics.culled, 1); // out of view: no vertex was transformed
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(always)]
    pub fn culled_by_clusters(self) -> Faces<'a, V, F, CLUSTERS> {
        let Self { instance, shade, cache } = self;
        Faces { instance, shade, cache }
    }

    /// With memory for transformed vertices: as long as the mesh's vertex list, so that each vertex is transformed once. Without it,
    /// or beyond its end, a vertex is transformed for each face that needs it: slower, but the picture is equal.
    ///
    /// [Culled by planes](Self::culled_by_planes), a vertex is transformed when the first face that may be visible needs it; a
    /// vertex that must be clipped, or lies farther out than a [`ScreenVertex`] can hold, is transformed again for each such face.
    #[inline(always)]
    pub fn cached(self, cache: &'a mut [ScreenVertex]) -> Self {
        Self { cache, ..self }
    }

    /// Draws the faces: into a target without a depth buffer in the mesh's order, without hidden-surface removal, which is right
    /// for convex meshes, whose front faces never hide each other; into a target [with a depth
    /// buffer](crate::target::Surface::depth_tested) the pixels that are nearer than the buffer, whose depth it then stores: right for all
    /// meshes, also for meshes that pierce each other. A [`Painter`](crate::draw::Painter) needs no depth buffer.
    ///
    /// **Depth** is the depth of the face's plane at the pixel's centre, in steps from 0 near to 65534 far, linear on
    /// the screen. Where two faces have equal depth, the one that was drawn first stays. With a depth buffer, faces are clipped at
    /// the far plane, even if the camera [does not clip](crate::Camera::with_far_clip) there.
    ///
    /// **Error**: within 0.54 of a step for faces within 512 pixels; for larger ones within ½ + 2⁻¹³ and 2⁻¹⁷ for
    /// every column and row of the viewport. At the far plane a face is drawn half a step nearer, as 65535 is the value of an
    /// empty buffer: the error there is within 1.1. So faces that are two steps apart are drawn in the right order.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*, primitives::Rectangle};
    /// use pinhole::{prelude::*, Angle};
    /// // Two triangles through each other: one upright, one lying.
    /// const VERTICES: [[i16; 3]; 6] = [[-9, -9, 0], [9, -9, 0], [0, 9, 0], [-9, 0, 9], [9, 0, 9], [0, 0, -9]];
    /// let mesh = Mesh::new(&VERTICES, -3, &[[0, 1, 2], [3, 4, 5]])?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
    /// let camera = Camera::new(
    ///     &ViewTransform::look_at(Point3::from_ints(0, 2, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
    ///     &Projection::perspective(Angle::degrees(40), viewport.size(), Scalar::from_int(1), Scalar::from_int(9))?,
    ///     &viewport,
    /// );
    /// let mut display = MockDisplay::<Gray8>::new();
    /// display.set_allow_overdraw(true);
    /// let mut storage = [0; 32 * 32];
    /// let area = Rectangle::new(Point::zero(), viewport.size());
    /// let mut depth = DepthBuffer::new(area, &mut storage)?;
    /// let model = Affine::<Model, World>::identity();
    /// let instance = camera.place(&mesh, &model).with_cull(Cull::None);
    /// instance.faces(|face| Gray8::new(100 + face as u8)).draw(&mut display.depth_tested(&mut depth))?;
    /// let seen = |x, y| display.get_pixel(Point::new(x, y)).map(|c| c.luma());
    /// assert_eq!((seen(16, 20), seen(16, 10)), (Some(101), Some(100))); // in front of it, and behind
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn draw<T: Target, S: ShaderFor<T::Surface>>(self, target: &mut T) -> Result<Statistics, T::Error>
    where
        F: FnMut(usize) -> S,
    {
        target.dispatch(
            self,
            |Faces { instance, shade, cache }, surface| {
                instance.solid::<_, _, CULLED_BY>(shade, cache, surface)
            },
            |Faces { instance, shade, cache }, surface, depth| {
                instance.depth_tested::<_, _, CULLED_BY>(shade, cache, depth, surface)
            },
        )
    }
}

defmt_format!(
    [V: Coordinate, F, const CULLED_BY: u8] Faces<'_, V, F, CULLED_BY>, self,
    "faces of {}", self.instance
);

impl<V: Coordinate> MeshInstance<'_, V> {
    #[inline(never)] // its stack frame is gone when it returns
    fn solid<T: Surface, S: ShaderFor<T>, const CULLED_BY: u8>(
        &self,
        shade: impl FnMut(usize) -> S,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let region = DrawRegion::new(target, self.area());
        let far = self.vertex_transform().clips_at_far();
        match (CULLED_BY, S::NEEDS_DEPTH) {
            (NOTHING, false) => {
                let cache = TransformedMesh::<V, false>::new(self, cache);
                solid(MeshOrder, cache, &region, shade, target)
            }
            (NOTHING, true) => {
                let cache = TransformedMesh::<V, true>::new(self, cache);
                solid(MeshOrder, cache, &region, shade, target)
            }
            (PLANES, false) => {
                let source = PlaneOrder::new(self);
                solid(source, LazyCache::<V, false>::new(self, far, cache), &region, shade, target)
            }
            (PLANES, true) => {
                let source = PlaneOrder::new(self);
                solid(source, LazyCache::<V, true>::new(self, true, cache), &region, shade, target)
            }
            (_, false) => {
                let source = ClusterOrder::new(self);
                solid(source, LazyCache::<V, false>::new(self, far, cache), &region, shade, target)
            }
            (_, true) => {
                let source = ClusterOrder::new(self);
                solid(source, LazyCache::<V, true>::new(self, true, cache), &region, shade, target)
            }
        }
    }

    #[inline(never)] // its stack frame is gone when it returns
    fn depth_tested<T: Surface, S: ShaderFor<T>, const CULLED_BY: u8>(
        &self,
        shade: impl FnMut(usize) -> S,
        cache: &mut [ScreenVertex],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let region = DrawRegion::new(target, self.area()).with_depth(depth);
        match CULLED_BY {
            NOTHING => {
                depth_tested(MeshOrder, TransformedMesh::new(self, cache), &region, shade, depth, target)
            }
            PLANES => {
                let source = PlaneOrder::new(self);
                depth_tested(source, LazyCache::new(self, true, cache), &region, shade, depth, target)
            }
            _ => {
                let source = ClusterOrder::new(self);
                depth_tested(source, LazyCache::new(self, true, cache), &region, shade, depth, target)
            }
        }
    }

    /// Stores the depth of the faces and draws nothing: the first step of hidden-line removal. The depth is, bit for bit, that
    /// of [`Faces::draw`]. `cache` is that of [`Faces::cached`], or empty. [`Edges::hidden_line`](crate::draw::Edges::hidden_line) has an example.
    #[inline(never)] // its stack frame is gone when it returns
    pub fn depth_only(&self, cache: &mut [ScreenVertex], depth: &mut DepthBuffer<'_>) -> Statistics {
        let region = DrawRegion::shared(&depth.area(), self.area(), None);
        let mut cache = TransformedMesh::<V, true>::new(self, cache);
        let Ok(statistics) = each_face(MeshOrder, &mut cache, &region.viewport, |_, _, triangles| {
            store_depth::<V>(triangles, &region.scissor, depth);
            Ok::<bool, Infallible>(true)
        });
        statistics
    }
}
