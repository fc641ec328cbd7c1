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

/// A mesh instance whose back faces are culled by their planes, before vertices are transformed.
/// [`MeshInstance::cull_by_planes`] makes it and has an example.
#[derive(Clone, Copy, Debug)]
pub struct PlaneCulled<'a, V: Coordinate = i16> {
    pub(super) instance: &'a MeshInstance<'a, V>,
    eye: PlaneEye,
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// Enables early back-face culling: drawing first tests each face's [plane](crate::Mesh::with_planes), and transforms a
    /// vertex only when a face that may be visible needs it. Then draw at once, or [bin](PlaneCulled::bin_faces) the faces for
    /// bands.
    ///
    /// This is worth it for closed meshes of a few hundred faces or more. It costs more than it saves for a few dozen faces,
    /// for terrain seen from above, for meshes without planes and with [`Cull::None`]. (Figures are in `docs/growth.md`:
    /// computing the eye's position alone takes as long as transforming about ten vertices.)
    ///
    /// A face is culled by its plane if the eye lies behind the plane by more than 1/290 of the eye's distance or of the mesh's
    /// largest coordinate, whichever is larger, in model units. In a parallel projection a face is culled if its normal points
    /// away from the viewer by more than an angle whose sine is 1/290. No visible face is culled.
    ///
    /// The picture equals the picture without culling by planes, except for back faces so thin on the screen that rounding
    /// their vertices turns them to the front: slivers narrower than 1/100 pixel, of any length, if vertices are accurate to
    /// 1/256 px (see [`project`](MeshInstance::project)). Such a sliver may cover a few pixels; culling by planes leaves it
    /// out. In the [`Statistics`], all faces that are culled by planes count as `culled`, even those that would be `degenerate`
    /// or `outside`.
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
    /// let instance = camera.place(&mesh, &model);
    /// let statistics = instance.cull_by_planes().solid(|_face| Gray8::WHITE, &mut [ScreenVertex::EMPTY; 4], &mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (1, 3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cull_by_planes(&self) -> PlaneCulled<'_, V> {
        let eye = match self.cull() {
            Cull::Back => PlaneEye::new(self.vertex_transform()),
            Cull::None => PlaneEye::NOWHERE,
        };
        PlaneCulled { instance: self, eye }
    }
}

impl<'a, V: Coordinate> PlaneCulled<'a, V> {
    /// The source of the faces that may be visible.
    #[inline(always)]
    pub(super) fn source(&self) -> PlaneOrder<'a, V> {
        PlaneOrder { instance: self.instance, eye: self.eye }
    }

    /// Draws the faces that may be visible as [`MeshInstance::solid`] does. A vertex that must be clipped, or lies farther out
    /// than a [`ScreenVertex`] can hold, is transformed again for each face that uses it.
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(never)] // its stack frame is gone when it returns
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
                self.instance.vertex_transform().clips_at_far(),
                cache,
            );
            faces::solid(self.source(), cache, &region, shade, target)
        }
    }

    /// Draws the faces that may be visible as [`MeshInstance::depth_tested`] does. A vertex that must be clipped, or lies
    /// farther out than a [`ScreenVertex`] can hold, is transformed again for each face that uses it.
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(never)] // its stack frame is gone when it returns
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

    /// Stores the depth of the faces that may be visible and draws nothing, as [`MeshInstance::depth_only`] does: the first
    /// step of [hidden-line removal](MeshInstance::hidden_line).
    #[inline(never)] // its stack frame is gone when it returns
    pub fn depth_only(&self, cache: &mut [ScreenVertex], depth: &mut DepthBuffer<'_>) -> Statistics {
        let region = DrawRegion::shared(&depth.area(), self.instance.area(), None);
        faces::depth_only(self.source(), LazyCache::new(self.instance, true, cache), &region, depth)
    }
}

#[cfg(feature = "defmt")]
impl<V: Coordinate> defmt::Format for PlaneCulled<'_, V> {
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

    /// Faces through random points, compared with their planes in f64: a face is never culled if the eye is in front of its
    /// plane or in it, and always if the eye is behind the plane by more than 1/579 of the eye's distance or of the power of
    /// two to which the mesh is justified.
    #[test]
    fn faces_are_left_out_only_where_the_eye_is_behind_their_plane() {
        const FACES: usize = 27;
        let mut random = Random(11);
        let number = Scalar::from_num::<f64>;
        let bits = |v: V| v.map(|c| f64::from(number(c).to_bits()) / 65_536.0); // what the library is given
        let viewport = Viewport::new(Point::new(-7, 3), Size::new(240, 180)).unwrap();
        let lens =
            Projection::perspective(Angle::degrees(50), viewport.size(), number(0.1), number(90.0)).unwrap();
        // How far the eye is behind the plane, as a share of its distance: the least of culled faces, the most of others.
        let (mut least, mut most, mut culled_faces) = (f64::MAX, f64::MIN, 0);
        for i in 0..4_000 {
            let reach: f64 = [32_767.0, 300.0][i % 2];
            let mut vertices = [[0_i16; 3]; 3 * FACES];
            let mut normals = [[0_i16; 3]; FACES];
            let mut faces = [[0_u16; 3]; FACES];
            for face in 0..FACES {
                faces[face] = [0, 1, 2].map(|corner| (3 * face + corner) as u16);
                loop {
                    // Large faces and small faces.
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
            // The eye in model space.
            let volume = dot(x, cross(y, z));
            if volume.abs() < 0.02 * thin {
                continue;
            }
            let away = minus(eye, origin);
            let own = [dot(away, cross(y, z)), dot(away, cross(z, x)), dot(away, cross(x, y))]
                .map(|c| c / volume * f64::from(exponent).exp2().recip());
            let model =
                Affine::<Model, World>::from_frame(as_vector(x), as_vector(y), as_vector(z), point(origin));
            let view =
                ViewTransform::look_at(point(eye), Point3::from_ints(0, 0, 0), Vector3::from_ints(1, 2, 3))
                    .unwrap();
            let camera = Camera::new(&view, &lens, &viewport);
            let instance = camera.place(&mesh, &model);
            let culled = instance.cull_by_planes();
            let seen = culled.source().visible(0, FACES);
            assert_eq!(seen >> FACES, 0);
            let distance = own.into_iter().fold(f64::from(1 << (31 - mesh.justify())), |m, c| m.max(c.abs()));
            for (face, corners) in faces.iter().enumerate() {
                let [a, b, c] = corners.map(|vertex| vertices[usize::from(vertex)].map(f64::from));
                let normal = cross(minus(b, a), minus(c, a));
                // A mirrored face is turned the other way.
                let behind =
                    volume.signum() * dot(normal, minus(a, own)) / dot(normal, normal).sqrt() / distance;
                if seen >> face & 1 == 0 {
                    least = least.min(behind);
                    culled_faces += 1;
                } else {
                    most = most.max(behind);
                }
            }
        }
        assert!(least > 0.0 && culled_faces > 50_000, "{least} {culled_faces}");
        // The margin and an error of equal size allow 2·115 806 of 32 767·4096 = 1/579; the largest seen is 0.00067.
        assert!((0.0005..1.0 / 579.0).contains(&most), "{most}");
    }
}
