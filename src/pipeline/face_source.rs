//! Where faces come from: a source pushes them, with their indices, into the face loop.
//!
//! Sources push and are not iterators: pulled through an iterator, a frame of S3 takes 6 % more instructions.

use super::cull::Cull;
use super::instance::MeshInstance;
use crate::camera::{Borders, PlaneEye, ScreenVertex, VertexTransform};
use crate::math::hints::keep_rolled;
use crate::math::unrolled::map3;
use crate::math::Coordinate;
use crate::scene::CLUSTER;
use core::ops::Range;

/// Pushes faces of a mesh into the face loop.
pub(super) trait FaceSource {
    /// Calls `visit` with the index and the vertices of each face. `visit` returns whether the face is finished: a
    /// binned source does not offer a finished face again.
    ///
    /// # Errors
    ///
    /// The first error of `visit`, which ends the loop.
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E>;

    /// Whether a face with these corners may cover a pixel of the viewport; true if the source does not find out.
    #[inline(always)]
    fn may_show<const DEPTH: bool>(_transform: &VertexTransform, _corners: &[ScreenVertex; 3]) -> bool {
        true
    }
}

/// All faces in the order of the mesh.
pub(super) struct MeshOrder;

impl FaceSource for MeshOrder {
    #[inline(always)]
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        mut visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E> {
        // The index is computed from the number of faces that are left: so culled faces take no instruction to count it.
        let mut left = faces;
        while let [face, rest @ ..] = left {
            visit(faces.len() - left.len(), face)?;
            left = rest;
        }
        Ok(())
    }
}

/// Some faces in the order of the mesh, with indices from 0.
pub(super) struct PartOrder(pub(super) Range<usize>);

impl FaceSource for PartOrder {
    #[inline(always)]
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E> {
        MeshOrder.push(faces.get(self.0).unwrap_or_default(), visit)
    }
}

/// The faces of a mesh, in its order, without those whose planes show that they are culled: early back-face culling, before a
/// vertex is transformed.
pub(super) struct PlaneOrder<'a, V: Coordinate> {
    instance: &'a MeshInstance<'a, V>,
    eye: PlaneEye,
}

/// The number of faces whose planes are tested together: one bit of a word for each.
const BATCH: usize = 32;

impl<V: Coordinate> FaceSource for PlaneOrder<'_, V> {
    #[inline(always)]
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E> {
        push_batches::<BATCH, _>(faces, |first, count| self.visible(first, count), visit)
    }
}

/// The faces of a mesh, in its order, by batches: `visible` gets the first face and the number of faces of a batch, and returns one bit for
/// each face, the lowest for the first.
#[inline(always)]
fn push_batches<const LENGTH: usize, E>(
    faces: &[[u16; 3]],
    mut visible: impl FnMut(usize, usize) -> u32,
    mut visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
) -> Result<(), E> {
    let (mut left, mut first) = (faces, 0);
    while !left.is_empty() {
        let (batch, others) = left.split_at_checked(LENGTH).unwrap_or((left, &[]));
        let mut visible = visible(first, batch.len());
        while visible != 0 {
            let at = visible.trailing_zeros() as usize;
            visible &= visible - 1; // clears the lowest bit
            let Some(face) = batch.get(at) else { break };
            visit(first + at, face)?;
        }
        (left, first) = (others, first + LENGTH);
    }
    Ok(())
}

/// The faces of [`PlaneOrder`], which is the plain twin, without those of clusters that are out of view or turned away as a whole, for which
/// no plane is tested; faces beside the viewport are left out before they are shaded. The domain is meshes with clusters. Beside planes it
/// saves 8 % of `N1 z` and 27 % of `N2 z` on an M3 and an M4F; with planes 30 % and 55 % on an M0. `tests/pipeline/culling_by_planes.rs`
/// compares the pictures.
pub(super) struct ClusterOrder<'a, V: Coordinate> {
    planes: PlaneOrder<'a, V>,
    borders: Borders,
}

impl<V: Coordinate> FaceSource for ClusterOrder<'_, V> {
    #[inline(always)]
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E> {
        push_batches::<CLUSTER, _>(faces, |first, count| self.visible(first, count), visit)
    }

    #[inline(always)]
    fn may_show<const DEPTH: bool>(transform: &VertexTransform, corners: &[ScreenVertex; 3]) -> bool {
        let [a, b, c] = map3(*corners, |corner| corner.offset::<DEPTH>());
        let ([left, top], [right, bottom]) = transform.pixel_centres();
        // Negative if all three are: then no corner reaches the centre of a first or a last pixel.
        let across = (a.x() - left) & (b.x() - left) & (c.x() - left)
            | (right - a.x()) & (right - b.x()) & (right - c.x());
        let down = (a.y() - top) & (b.y() - top) & (c.y() - top)
            | (bottom - a.y()) & (bottom - b.y()) & (bottom - c.y());
        across | down >= 0
    }
}

impl<'a, V: Coordinate> ClusterOrder<'a, V> {
    /// The faces of an instance that may be drawn.
    #[inline(always)]
    pub(super) fn new(instance: &'a MeshInstance<'a, V>) -> Self {
        Self { planes: PlaneOrder::new(instance), borders: Borders::new(instance.vertex_transform()) }
    }

    /// One bit for each of `count` faces, as [`PlaneOrder::visible`].
    #[inline(never)] // one copy for all draw calls
    fn visible(&self, first: usize, count: usize) -> u32 {
        let Self { planes: PlaneOrder { instance, eye }, borders } = self;
        let cluster = instance.mesh().clusters().get(first / CLUSTER);
        match cluster.is_some_and(|cluster| eye.is_behind_all(cluster) || borders.exclude(cluster)) {
            true => 0,
            false => self.planes.visible(first, count),
        }
    }
}

impl<'a, V: Coordinate> PlaneOrder<'a, V> {
    /// The faces of an instance that may be drawn; all of them if it culls none.
    #[inline(always)]
    pub(super) fn new(instance: &'a MeshInstance<'a, V>) -> Self {
        let eye = match instance.cull() {
            _ if instance.mesh().planes.is_empty() => PlaneEye::NOWHERE,
            Cull::Back => PlaneEye::new(instance.vertex_transform()),
            Cull::Front => PlaneEye::new(instance.vertex_transform()).opposite(),
            Cull::None => PlaneEye::NOWHERE,
        };
        Self { instance, eye }
    }

    /// One bit for each of `count` faces (at most [`BATCH`]), the lowest for face `first`: 0 if the face's plane shows that it
    /// is culled.
    #[inline(never)] // the loop gets all registers; one copy for all draw calls
    fn visible(&self, first: usize, count: usize) -> u32 {
        let (mesh, range, eye) = (self.instance.mesh(), first..first + count, self.eye);
        let (Some(normals), Some(planes)) = (mesh.normals.get(range.clone()), mesh.planes.get(range)) else {
            return u32::MAX; // the mesh has no planes
        };
        let mut visible = 0;
        for (&normal, &plane) in normals.iter().zip(planes) {
            keep_rolled();
            // The sign bit.
            visible = visible >> 1 | eye.behind(normal, plane) as u32 & 1 << 31;
        }
        visible >> ((BATCH - count) & 31)
    }
}

#[cfg(test)]
mod tests {
    use super::PlaneOrder;
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
        let number = |v| Scalar::try_from(v).expect("in range");
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
            let seen = PlaneOrder::new(&instance).visible(0, FACES);
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
