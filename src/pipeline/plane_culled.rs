//! Early back-face culling by face planes, before a vertex is transformed.

use super::cull::Cull;
use super::draw_region::DrawRegion;
use super::face_source::PlaneOrder;
use super::faces;
use super::instance::MeshInstance;
use super::statistics::Statistics;
use super::vertex_cache::LazyCache;
use crate::camera::{PlaneEye, ScreenVertex};
use crate::math::Coordinate;
use crate::shading::SpanShader;
use crate::surface::{DepthBuffer, Target};

/// A mesh instance whose back faces are culled by their planes, before vertices are transformed:
/// [`MeshInstance::cull_by_planes`] makes it, and has an example.
#[derive(Clone, Copy, Debug)]
pub struct PlaneCulled<'a, V = i16> {
    pub(super) instance: &'a MeshInstance<'a, V>,
    eye: PlaneEye,
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// Tests each face's [plane](crate::Mesh::with_planes) first, and transforms a vertex only when a face that
    /// may be visible needs it. Draws at once, or [records](PlaneCulled::bin_faces) for bands.
    ///
    /// Worth it for closed meshes of some hundred faces and more. It costs more than it saves for some dozen
    /// faces, for terrain seen from above, for meshes without planes and for [`Cull::None`]. (Figures are in
    /// `docs/growth.md`; the eye alone takes as long as some ten vertices.)
    ///
    /// A face is culled where the eye lies behind its plane by more than 1/290 of the larger of the eye's distance
    /// and the mesh's largest coordinate, in model units; in parallel projections where its normal points away
    /// from the viewer by more than an angle whose sine is 1/290. No visible face is left out.
    ///
    /// The picture is the same as without, but for faces that are turned away and so thin on the screen that rounding
    /// turns their corners to the front: less than 1/100 pixel, however long, where vertices are within 1/256 px of their
    /// places (see [`project`](MeshInstance::project)). Those are left out here, and with them the few pixels that such a
    /// sliver may cover. In the [`Statistics`] all faces that are known by their planes are
    /// `culled`, what would be `degenerate` or `outside` too.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{
    ///     space::{Model, World}, Affine, Angle, Camera, ScreenVertex, Mesh, Point3, Projection, Scalar, Vector3, ViewTransform,
    ///     Viewport,
    /// };
    /// const VERTICES: [[i16; 3]; 4] = [[0, 0, 0], [8, 0, 0], [0, 8, 0], [0, 0, 8]];
    /// const FACES: [[u16; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// const NORMALS: [[i16; 3]; 4] = [[0, 0, -32767], [0, -32767, 0], [-32767, 0, 0], [18918; 3]];
    /// let mesh = Mesh::new(&VERTICES, -3, &FACES)?.with_normals(&NORMALS)?;
    /// let planes: [i16; 4] = mesh.face_planes();
    /// let mesh = mesh.with_planes(&planes)?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
    /// let camera = Camera::new(
    ///     &ViewTransform::look_at(Point3::from_ints(3, 2, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
    ///     &Projection::perspective(Angle::degrees(40), viewport.size(), Scalar::from_num(1), Scalar::from_num(9))?,
    ///     &viewport,
    /// );
    /// let model = Affine::<Model, World>::identity();
    /// let mut display = MockDisplay::<Gray8>::new();
    /// let placed = camera.place(&mesh, &model);
    /// let statistics = placed.cull_by_planes().solid(|_face| Gray8::WHITE, &mut [ScreenVertex::EMPTY; 4], &mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (1, 3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cull_by_planes(&self) -> PlaneCulled<'_, V> {
        let eye = match self.cull {
            Cull::Back => PlaneEye::new(&self.vertex_transform),
            Cull::None => PlaneEye::NOWHERE,
        };
        PlaneCulled { instance: self, eye }
    }
}

impl<'a, V: Coordinate> PlaneCulled<'a, V> {
    /// The faces that may be visible.
    #[inline(always)]
    pub(super) fn source(&self) -> PlaneOrder<'a, V> {
        PlaneOrder { instance: self.instance, eye: self.eye }
    }

    /// Draws the faces as [`MeshInstance::solid`] does. A vertex that must be clipped, or lies too far out for a
    /// [`ScreenVertex`], is transformed again for each face that shares it.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn solid<T: Target, S: SpanShader<T::Color>>(
        &self,
        shade: impl FnMut(usize) -> S,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let region = DrawRegion::new(target, self.instance.area());
        if S::NEEDS_DEPTH {
            let cache = LazyCache::<V, true>::new(self.instance, true, cache);
            faces::solid(self.source(), cache, &region, shade, target)
        } else {
            let cache = LazyCache::<V, false>::new(
                self.instance,
                self.instance.vertex_transform.clips_at_far(),
                cache,
            );
            faces::solid(self.source(), cache, &region, shade, target)
        }
    }

    /// Draws the faces as [`MeshInstance::depth_tested`] does. A vertex that must be clipped, or lies too far out for a
    /// [`ScreenVertex`], is transformed again for each face that shares it.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn depth_tested<T: Target, S: SpanShader<T::Color>>(
        &self,
        shade: impl FnMut(usize) -> S,
        cache: &mut [ScreenVertex],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let region = DrawRegion::new(target, self.instance.area()).with_depth(depth);
        let cache = LazyCache::new(self.instance, true, cache);
        faces::depth_tested(self.source(), cache, &region, shade, depth, target)
    }

    /// Keeps the faces' depth as [`MeshInstance::depth_only`] does: for [hidden lines](MeshInstance::hidden_line).
    #[inline(never)] // its frame is gone when it returns
    pub fn depth_only(&self, cache: &mut [ScreenVertex], depth: &mut DepthBuffer<'_>) -> Statistics {
        let region = DrawRegion::shared(&depth.area(), self.instance.area(), None);
        faces::depth_only(self.source(), LazyCache::new(self.instance, true, cache), &region, depth)
    }
}

#[cfg(feature = "defmt")]
impl<V> defmt::Format for PlaneCulled<'_, V> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{}, culled by planes", self.instance);
    }
}

#[cfg(test)]
mod tests {
    use crate::camera::{Camera, Projection, ViewTransform, Viewport};
    use crate::math::random::Random;
    use crate::math::{Affine, Angle, Point3, Scalar, Vector3};
    use crate::scene::Mesh;
    use crate::space::{Model, World};
    use embedded_graphics_core::geometry::{Point, Size};

    type V = [f64; 3];

    fn dot(a: V, b: V) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    fn cross(a: V, b: V) -> V {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }

    fn minus(a: V, b: V) -> V {
        [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
    }

    /// BinnedFaces through random points against their planes in f64: none is left out that the eye is before, or in the
    /// plane of, and all are that it is behind by more than 1/579 of its distance or of the power of two to which the
    /// mesh is justified.
    #[test]
    fn faces_are_left_out_only_where_the_eye_is_behind_their_plane() {
        const FACES: usize = 27;
        let mut random = Random(11);
        let number = Scalar::from_num::<f64>;
        let bits = |v: V| v.map(|c| f64::from(number(c).to_bits()) / 65_536.0); // what the library is given
        let viewport = Viewport::new(Point::new(-7, 3), Size::new(240, 180)).unwrap();
        let lens =
            Projection::perspective(Angle::degrees(50), viewport.size(), number(0.1), number(90.0)).unwrap();
        // Behind the plane, in parts of the eye's distance: the least of those left out, the most of those kept.
        let (mut least, mut most, mut left_out) = (f64::MAX, f64::MIN, 0);
        for i in 0..4_000 {
            let reach: f64 = [32_767.0, 300.0][i % 2];
            let mut vertices = [[0_i16; 3]; 3 * FACES];
            let mut normals = [[0_i16; 3]; FACES];
            let mut faces = [[0_u16; 3]; FACES];
            for face in 0..FACES {
                faces[face] = [0, 1, 2].map(|corner| (3 * face + corner) as u16);
                loop {
                    // AnyTriangle ones, and small ones.
                    let (size, about) = ([0.5, 0.02][face % 2], [0; 3].map(|_| 0.5 * random.unit()));
                    for vertex in &mut vertices[3 * face..3 * face + 3] {
                        *vertex = about.map(|c| (reach * (c + size * random.unit())) as i16);
                    }
                    let [a, b, c] = faces[face].map(|vertex| vertices[usize::from(vertex)].map(f64::from));
                    let normal = cross(minus(b, a), minus(c, a));
                    let length = dot(normal, normal).sqrt();
                    if length > 0.0 {
                        normals[face] = normal.map(|n| (n / length * 32_767.0).round() as i16);
                        break;
                    }
                }
            }
            let exponent = -reach.log2().ceil() as i8;
            let mesh = Mesh::new(&vertices, exponent, &faces).unwrap().with_normals(&normals).unwrap();
            let planes: [i16; FACES] = mesh.face_planes();
            let mesh = mesh.with_planes(&planes).unwrap();
            // Sheared, mirrored, thin.
            let mut vector = |size: f64| bits([0; 3].map(|_| size * random.unit()));
            let thin = [1.0, 0.05][i / 2 % 2];
            let (x, y, z, origin) = (vector(1.0), vector(1.0), vector(thin), vector(1.0));
            let eye = vector([1.2, 4.0, 40.0][i / 4 % 3]);
            let as_vector = |[x, y, z]: V| Vector3::<World>::new(number(x), number(y), number(z));
            let point = |[x, y, z]: V| Point3::<World>::new(number(x), number(y), number(z));
            // The eye where the model's matrix brings it from.
            let volume = dot(x, cross(y, z));
            if volume.abs() < 0.02 * thin {
                continue;
            }
            let away = minus(eye, origin);
            let own = [dot(away, cross(y, z)), dot(away, cross(z, x)), dot(away, cross(x, y))]
                .map(|c| c / volume * f64::from(exponent).exp2().recip());
            let model =
                Affine::<Model, World>::from_frame(as_vector(x), as_vector(y), as_vector(z), point(origin));
            let viewing =
                ViewTransform::look_at(point(eye), Point3::from_ints(0, 0, 0), Vector3::from_ints(1, 2, 3))
                    .unwrap();
            let camera = Camera::new(&viewing, &lens, &viewport);
            let placed = camera.place(&mesh, &model);
            let facing = placed.cull_by_planes();
            let seen = facing.source().visible(0, FACES);
            assert_eq!(seen >> FACES, 0);
            let distance = own.into_iter().fold(f64::from(1 << (31 - mesh.justify())), |m, c| m.max(c.abs()));
            for (face, corners) in faces.iter().enumerate() {
                let [a, b, c] = corners.map(|vertex| vertices[usize::from(vertex)].map(f64::from));
                let normal = cross(minus(b, a), minus(c, a));
                // A mirrored face turns the other way.
                let behind =
                    volume.signum() * dot(normal, minus(a, own)) / dot(normal, normal).sqrt() / distance;
                if seen >> face & 1 == 0 {
                    least = least.min(behind);
                    left_out += 1;
                } else {
                    most = most.max(behind);
                }
            }
        }
        assert!(least > 0.0 && left_out > 50_000, "{least} {left_out}");
        // By the margin and errors as large against it, 2·115 806 of 32 767·4096; 0.00067 is met.
        assert!((0.0005..1.0 / 579.0).contains(&most), "{most}");
    }
}
