//! Borrowed triangle meshes.

use crate::math::num::{scale, sqrt};
use crate::math::unrolled::map3;
use crate::math::{Coordinate, Point3, Scalar, Sphere};
use crate::scene::MeshError;

/// A triangle mesh over borrowed data, checked once when it is made. Made in a `const`, it lives in flash.
///
/// Vertices are `i16` with a power-of-two unit, model coordinate = vertex · 2^exponent: 6 bytes each, and 16-bit products on a
/// Cortex-M0. Meshes that need more range have [`Scalar`] vertices ([`Mesh::from_fixed`]). Faces are counter-clockwise seen
/// from outside; a mesh without faces is a list of points, for plots and tool paths. Wireframes need edges, lighting needs
/// normals.
///
/// ```
/// use pinhole::{mesh::MeshError, Mesh};
/// const VERTICES: [[i16; 3]; 4] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
/// const FACES: [[u16; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
/// const EDGES: [[u16; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
/// // Unit 2⁰: the legs have length 1.
/// const CORNER: Mesh<'static> = match Mesh::new(&VERTICES, 0, &FACES) {
///     Ok(mesh) => match mesh.with_edges(&EDGES) {
///         Ok(mesh) => mesh,
///         Err(_) => panic!("edges"), // at compile time
///     },
///     Err(_) => panic!("faces"),
/// };
/// assert_eq!(CORNER.edges().len(), 6);
/// let wrong = Mesh::new(&VERTICES, 0, &[[0, 1, 4]]);
/// assert_eq!(wrong, Err(MeshError::Index { of: "face", number: 0, used: "vertex", index: 4, count: 4 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mesh<'a, V = i16> {
    pub(crate) vertices: &'a [[V; 3]],
    pub(crate) faces: &'a [[u16; 3]],
    pub(crate) edges: &'a [[u16; 2]],
    pub(crate) edge_faces: &'a [[u16; 2]],
    pub(crate) normals: &'a [[i16; 3]],
    /// A plane for each face, and clusters behind them; or nothing.
    pub(crate) planes: &'a [i16],
    vertex_normals: &'a [[i16; 3]],
    exponent: i8,
    /// The left shift that brings the mesh's largest coordinate to the top of 32 bits.
    justify: u8,
    /// Whether an edge lists one face twice: then all faces are searched.
    pub(crate) has_unlisted_faces: bool,
}

impl<'a, V> Mesh<'a, V> {
    /// Vertices and faces alone.
    const fn of_lists(vertices: &'a [[V; 3]], faces: &'a [[u16; 3]], exponent: i8, justify: u8) -> Self {
        Self {
            vertices,
            faces,
            edges: &[],
            edge_faces: &[],
            normals: &[],
            planes: &[],
            vertex_normals: &[],
            exponent,
            justify,
            has_unlisted_faces: false,
        }
    }

    /// The list of the faces beside an edge, if there is one that names them all.
    pub(crate) fn listed_beside(&self, edge: usize) -> Option<&'a [u16; 2]> {
        self.edge_faces.get(edge).filter(|[first, second]| first != second || *first == NO_FACE)
    }

    /// A face of a list of the faces beside an edge.
    #[inline(always)]
    pub(crate) fn listed_face(&self, face: u16) -> Option<&'a [u16; 3]> {
        // NO_FACE is also the index of the last face of a mesh of 65536 faces: a list cannot name that face.
        if face == NO_FACE {
            return None;
        }
        self.faces.get(usize::from(face))
    }
}

/// The number of faces of a cluster.
pub(crate) const CLUSTER: usize = 32;

/// [`Mesh::NO_FACE`], whatever the type of the mesh.
pub(crate) const NO_FACE: u16 = u16::MAX;

/// The two faces adjacent to each edge, or [`Mesh::NO_FACE`]: for [`Mesh::with_edge_faces`]. Call it in a `const` for small
/// meshes, at run time for large ones: time grows with edges × (edges + faces). Faces from index 65535 on are ignored, as a
/// `u16` cannot address them.
///
/// An edge between more than two faces gets its first face twice: drawing then searches all faces for those beside it. To avoid the
/// search, list such an edge once for every two of its faces (twice for three): the first entry gets the first two faces, the second the
/// next.
///
/// ```
/// use pinhole::{mesh::edge_faces, Mesh};
/// const FACES: [[u16; 3]; 2] = [[0, 1, 2], [2, 1, 3]];
/// const EDGES: [[u16; 2]; 2] = [[1, 2], [0, 2]];
/// const BESIDE: [[u16; 2]; 2] = edge_faces(&EDGES, &FACES);
/// assert_eq!(BESIDE, [[0, 1], [0, Mesh::<i16>::NO_FACE]]);
/// let twice = edge_faces(&[[0, 1], [1, 0]], &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
/// assert_eq!(twice, [[0, 1], [2, Mesh::<i16>::NO_FACE]]);
/// assert_eq!(edge_faces(&[[0, 1]], &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]), [[0, 0]]);
/// ```
pub const fn edge_faces<const E: usize>(edges: &[[u16; 2]; E], faces: &[[u16; 3]]) -> [[u16; 2]; E] {
    let mut beside = [[u16::MAX; 2]; E];
    let mut edge = 0;
    while edge < E {
        let (mut other, mut earlier, mut listed) = (0, 0, 0);
        while other < E {
            let ([a, b], [p, q]) = (edges[edge], edges[other]);
            let is_same = (a == p && b == q) || (a == q && b == p);
            listed += is_same as usize;
            earlier += (is_same && other < edge) as usize;
            other += 1;
        }
        beside[edge] = faces_beside(edges[edge], faces, 2 * earlier, 2 * listed);
        edge += 1;
    }
    beside
}

/// Two faces beside an edge, after the first `skip`; or twice the first of all, if there are more than `most`.
const fn faces_beside([p, q]: [u16; 2], faces: &[[u16; 3]], skip: usize, most: usize) -> [u16; 2] {
    // Variables, not an array: an index that the optimiser cannot bound would link a panic.
    let (mut found, mut any, mut first, mut second) = (0, NO_FACE, NO_FACE, NO_FACE);
    let mut face = 0;
    while face < faces.len() && face < u16::MAX as usize && found <= most {
        let [a, b, c] = faces[face];
        if (p == a || p == b || p == c) && (q == a || q == b || q == c) {
            if found == 0 {
                any = face as u16;
            }
            if found == skip {
                first = face as u16;
            } else if found == skip + 1 {
                second = face as u16;
            }
            found += 1;
        }
        face += 1;
    }
    if found > most {
        [any; 2]
    } else {
        [first, second]
    }
}

/// Checks that all entries of a list use indices below `count`. Written without iterators, which a `const fn` cannot use.
pub(super) const fn check_indices<const N: usize>(
    of: &'static str,
    list: &[[u16; N]],
    used: &'static str,
    count: usize,
) -> Result<(), MeshError> {
    let mut number = 0;
    while number < list.len() {
        let (mut index, mut at) = (0, 0);
        while at < N {
            index = if list[number][at] > index { list[number][at] } else { index };
            at += 1;
        }
        if index as usize >= count {
            return Err(MeshError::Index { of, number, used, index, count });
        }
        number += 1;
    }
    Ok(())
}

/// Checks that there are at most 65536 vertices and that all faces use indices of these.
const fn check_faces(vertices: usize, faces: &[[u16; 3]]) -> Result<(), MeshError> {
    match vertices {
        0..=65_536 => check_indices("face", faces, "vertex", vertices),
        _ => Err(MeshError::TooManyVertices { vertices }),
    }
}

/// The left shift that brings numbers up to `magnitude` to the top of 32 signed bits.
const fn justify(magnitude: u32) -> u8 {
    // `magnitude_bits` leaves the sign bit clear: 1 … 32 leading zeros, and a shift of 0 … 31.
    (magnitude.leading_zeros().saturating_sub(1)) as u8
}

impl<'a> Mesh<'a, i16> {
    /// A mesh of vertices in units of 2^`exponent`, exact, and faces, counter-clockwise from outside. All indices are checked,
    /// at compile time in a `const`.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if a face uses a vertex index out of range, there are more than 65536 vertices, or the exponent is not −32
    /// … 15.
    pub const fn new(
        vertices: &'a [[i16; 3]],
        exponent: i8,
        faces: &'a [[u16; 3]],
    ) -> Result<Self, MeshError> {
        if exponent < -32 || exponent > 15 {
            return Err(MeshError::Exponent { exponent });
        }
        if let Err(error) = check_faces(vertices.len(), faces) {
            return Err(error);
        }
        let (mut magnitude, mut i) = (0u32, 0);
        while i < vertices.len() {
            let [x, y, z] = vertices[i];
            magnitude |= magnitude_bits(x as i32) | magnitude_bits(y as i32) | magnitude_bits(z as i32);
            i += 1;
        }
        let justify = justify(magnitude);
        Ok(Self::of_lists(vertices, faces, exponent, justify))
    }
}

impl Mesh<'_, i16> {
    /// The plane of each face, for [`with_planes`](Mesh::with_planes): the signed distance of the face from the origin along
    /// its normal. `N` is the number of faces. In units of 2⁻¹⁴ of the power of two that bounds the mesh's coordinates, rounded
    /// to nearest. Best called in a `const`. 0 for faces without a normal and indices out of range.
    ///
    /// ```
    /// use pinhole::Mesh;
    /// const VERTICES: [[i16; 3]; 4] = [[0, 0, 0], [8, 0, 0], [0, 8, 0], [0, 0, 8]];
    /// const FACES: [[u16; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// const NORMALS: [[i16; 3]; 4] = [[0, 0, -32767], [0, -32767, 0], [-32767, 0, 0], [18918; 3]];
    /// const PLAIN: Mesh<'static> = {
    ///     let Ok(mesh) = Mesh::new(&VERTICES, -3, &FACES) else { panic!("faces") };
    ///     let Ok(mesh) = mesh.with_normals(&NORMALS) else { panic!("normals") };
    ///     mesh
    /// };
    /// const PLANES: [i16; 4] = PLAIN.face_planes();
    /// const CORNER: Mesh<'static> = match PLAIN.with_planes(&PLANES) {
    ///     Ok(mesh) => mesh,
    ///     Err(_) => panic!("planes"),
    /// };
    /// assert_eq!(CORNER.planes(), [0, 0, 0, 4730]);
    /// ```
    pub const fn face_planes<const N: usize>(&self) -> [i16; N] {
        let (mut planes, mut face) = ([0; N], 0);
        while face < N {
            if let Some((&[x, y, z], normal)) = self.corner_and_normal(face) {
                planes[face] = plane_distance([x as i32, y as i32, z as i32], normal, self.justify);
            }
            face += 1;
        }
        planes
    }
}

/// The signed distance of the plane through a vertex from the origin, n·v for the vertex v and the normal n in 2⁻¹⁵, in 2⁻¹⁴ of
/// the power of two that bounds the mesh's coordinates, rounded to nearest. At most √3·2¹⁴ for unit normals; saturates for
/// longer ones.
const fn plane_distance([x, y, z]: [i32; 3], [a, b, c]: [i16; 3], justify: u8) -> i16 {
    let shift = justify as u32 & 31;
    // Justified coordinates are at most 2³¹, normals 2¹⁵: three products of 2⁴⁶.
    let along =
        (x << shift) as i64 * a as i64 + (y << shift) as i64 * b as i64 + (z << shift) as i64 * c as i64;
    let half = scale(along, -32);
    if half > i16::MAX as i64 {
        i16::MAX
    } else if half < i16::MIN as i64 {
        i16::MIN
    } else {
        half as i16
    }
}

/// A number with as many bits as `v` has without its sign.
const fn magnitude_bits(v: i32) -> u32 {
    (v ^ (v >> 31)) as u32
}

impl<'a> Mesh<'a, Scalar> {
    /// A mesh of vertices in [`Scalar`]s, ±32768 in steps of 2⁻¹⁶, and faces. It takes twice the memory of `i16` vertices, and
    /// 64-bit products on a Cortex-M0.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if a face uses a vertex index out of range, or there are more than 65536 vertices.
    pub const fn from_fixed(vertices: &'a [[Scalar; 3]], faces: &'a [[u16; 3]]) -> Result<Self, MeshError> {
        if let Err(error) = check_faces(vertices.len(), faces) {
            return Err(error);
        }
        let (mut magnitude, mut i) = (0u32, 0);
        while i < vertices.len() {
            let [x, y, z] = vertices[i];
            magnitude |=
                magnitude_bits(x.to_bits()) | magnitude_bits(y.to_bits()) | magnitude_bits(z.to_bits());
            i += 1;
        }
        let justify = justify(magnitude);
        Ok(Self::of_lists(vertices, faces, -16, justify))
    }
}

impl<'a, V> Mesh<'a, V> {
    /// The face index that stands for "no face" in lists of edge faces: a border.
    pub const NO_FACE: u16 = NO_FACE;

    /// Adds the edges that a wireframe draws, each listed once, as two vertex indices in any order. Removes edge faces that
    /// were added before, because they belong to other edges.
    ///
    /// # Errors
    ///
    /// [`MeshError::Index`] if an edge uses a vertex index out of range.
    pub const fn with_edges(self, edges: &'a [[u16; 2]]) -> Result<Self, MeshError> {
        if let Err(error) = check_indices("edge", edges, "vertex", self.vertices.len()) {
            return Err(error);
        }
        Ok(Self { edges, edge_faces: &[], has_unlisted_faces: false, ..self })
    }

    /// Adds the two faces adjacent to each edge, for hidden lines and smooth edges, which would search all faces for them otherwise:
    /// [`edge_faces`] finds them. An edge of more than two faces is listed once for every two of them, or has the same face twice:
    /// then all faces are searched. With two of its faces alone it is hidden where another one covers it.
    ///
    /// # Errors
    ///
    /// [`MeshError::ListLength`] if there is not one pair per edge, [`MeshError::Index`] if a face index is neither in range nor
    /// [`Mesh::NO_FACE`].
    pub const fn with_edge_faces(self, edge_faces: &'a [[u16; 2]]) -> Result<Self, MeshError> {
        let (given, needed, count) = (edge_faces.len(), self.edges.len(), self.faces.len());
        if given != needed {
            return Err(MeshError::ListLength { one: "pair of faces per edge", given, needed });
        }
        let (mut edge, mut has_unlisted_faces) = (0, false);
        while edge < edge_faces.len() {
            let [a, b] = edge_faces[edge];
            has_unlisted_faces |= a == b && a != NO_FACE;
            let (a_there, b_there) = ((a as usize) < count, (b as usize) < count);
            if !(a_there || a == NO_FACE) || !(b_there || b == NO_FACE) {
                let index = if a_there || a == NO_FACE { b } else { a };
                return Err(MeshError::Index { of: "edge", number: edge, used: "face", index, count });
            }
            edge += 1;
        }
        Ok(Self { edge_faces, has_unlisted_faces, ..self })
    }

    /// Adds a unit normal for each face, pointing outwards, in 2⁻¹⁵ (32767 stands for 1). Removes planes that were added before,
    /// because they belong to other normals.
    ///
    /// # Errors
    ///
    /// [`MeshError::ListLength`] if there is not one normal per face.
    pub const fn with_normals(self, normals: &'a [[i16; 3]]) -> Result<Self, MeshError> {
        if normals.len() != self.faces.len() {
            return Err(MeshError::ListLength {
                one: "normal per face",
                given: normals.len(),
                needed: self.faces.len(),
            });
        }
        Ok(Self { normals, planes: &[], ..self })
    }

    /// Adds the plane of each face: its signed distance from the origin along the normal, which
    /// [`face_planes`](Mesh::face_planes) computes. Call [`with_normals`](Self::with_normals) first: planes refer to those normals.
    ///
    /// [`culled_by_planes`](crate::draw::Faces::culled_by_planes) draws a mesh by **early back-face culling**: it first tests each face's plane,
    /// and transforms a vertex only when a face that may be visible needs it. So does a [`Scene`](crate::draw::Scene) in one piece.
    ///
    /// This is worth it for closed meshes of a few hundred faces or more, drawn in one piece. It costs more than it saves for a few dozen
    /// faces, for terrain seen from above, and with [`Cull::None`](crate::draw::Cull::None). (Figures are in `docs/growth.md`: a draw call
    /// computes the eye's position in the mesh's coordinates, which takes as long as transforming about ten vertices.)
    ///
    /// **Which faces are culled.** A face is culled by its plane if the eye lies behind the plane by more than `max(eye, mesh) / 290`:
    /// the eye's distance from the model's origin and the mesh's largest coordinate, in model units. In a parallel projection a face is
    /// culled if its normal points away from the viewer by more than asin(1/290). No visible face is culled.
    /// Faces that pass are culled by their area on the screen, as those of every mesh. With [`Cull::Front`](crate::draw::Cull::Front) the
    /// sides change places: a face is culled if the eye lies so far in front of its plane.
    ///
    /// The picture equals that of the mesh without planes, except for back faces so thin on the screen that rounding their
    /// vertices turns them to the front: slivers narrower than 1/100 pixel, of any length, if vertices are accurate to 1/256 px
    /// (see [`project`](crate::draw::MeshInstance::project)). Such a sliver may cover a few pixels; with planes it is left out. In
    /// the [`Statistics`](crate::draw::Statistics), all faces that are culled by planes count as `culled`, even those that would be
    /// `degenerate` or `outside`.
    ///
    /// **Normals** then decide which faces are culled. They must be the geometric normals of the rounded vertices, of unit length,
    /// each component within 2⁻¹⁵; with other normals, such as smoothed ones, visible faces are culled. A face with normal [0,
    /// 0, 0] is never culled by its plane.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// const VERTICES: [[i16; 3]; 4] = [[0, 0, 0], [8, 0, 0], [0, 8, 0], [0, 0, 8]];
    /// const FACES: [[u16; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// const NORMALS: [[i16; 3]; 4] = [[0, 0, -32767], [0, -32767, 0], [-32767, 0, 0], [18918; 3]];
    /// let mesh = Mesh::new(&VERTICES, -3, &FACES)?.with_normals(&NORMALS)?;
    /// let planes: [i16; 4] = mesh.face_planes();
    /// let mesh = mesh.with_planes(&planes)?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
    /// let camera = Camera::new(
    ///     &ViewTransform::look_at(Point3::from_ints(3, 2, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
    ///     &Projection::perspective(Angle::degrees(40), viewport.size(), Scalar::from_int(1), Scalar::from_int(9))?,
    ///     &viewport,
    /// );
    /// let mut display = MockDisplay::<Gray8>::new();
    /// let mut cache = [ScreenVertex::EMPTY; 4];
    /// let model = Affine::<Model, World>::identity();
    /// let statistics = camera
    ///     .place(&mesh, &model)
    ///     .faces(|_face| Gray8::WHITE)
    ///     .culled_by_planes()
    ///     .cached(&mut cache)
    ///     .draw(&mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (1, 3));
    /// assert_eq!(cache[0], ScreenVertex::EMPTY); // no visible face has this vertex: it was not transformed
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// **Clusters.** The list may go on with *clusters*: for every 32 consecutive faces a ball around
    /// their vertices and a ball around their normals. [`culled_by_clusters`](crate::draw::Faces::culled_by_clusters) then leaves out
    /// all faces of a cluster by one test, if it lies outside of the view volume or all of its planes show their backs. `pinhole-import
    /// --clusters` orders faces so that those of a cluster lie close together and are turned alike, and makes the list: half a byte more
    /// for a face. `culled_by_clusters` has an example. A cluster has eight numbers; the last cluster may have fewer faces:
    ///
    /// 1. x, y and z of a point, and a radius (a `u16`), in 2⁻¹⁵ of the power of two that bounds the mesh's coordinates. All corners of
    ///    the faces lie within the radius of the point.
    /// 2. x, y and z of a vector in 2⁻¹⁵, and in the last number, also a `u16`, two bytes m (the higher one) and e: all normals lie
    ///    within (m + 1)/256 of the vector, and all planes, each with its normal, within (e + 1)/256 of the radius and one unit of the
    ///    point.
    ///
    /// As with normals, other numbers cull visible faces.
    ///
    /// # Errors
    ///
    /// [`MeshError::ListLength`] if there is not one plane per face, and nothing or eight numbers per 32 faces behind them, or if the mesh has
    /// no normals.
    pub const fn with_planes(self, planes: &'a [i16]) -> Result<Self, MeshError> {
        let (faces, normals, given) = (self.faces.len(), self.normals.len(), planes.len());
        let with_clusters = faces + 8 * faces.div_ceil(CLUSTER); // a slice has at most 2⁶³/6 faces
        if given != faces && given != with_clusters {
            let (one, needed) = match given < faces {
                true => ("plane per face", faces),
                false => ("plane per face and eight numbers per 32 faces", with_clusters),
            };
            return Err(MeshError::ListLength { one, given, needed });
        }
        if normals != faces {
            return Err(MeshError::ListLength { one: "normal per face", given: normals, needed: faces });
        }
        Ok(Self { planes, ..self })
    }

    /// Adds a unit normal for each vertex, pointing outwards, in 2⁻¹⁵ (32767 stands for 1): the normal of the surface that the
    /// faces approximate, or the mean of the normals of the faces around the vertex. For smooth shading: see
    /// [`Light::levels`](crate::light::Light::levels).
    ///
    /// ```
    /// use pinhole::Mesh;
    /// const UP: [i16; 3] = [0, 0, 32_767];
    /// let mesh = Mesh::new(&[[0, 0, 0], [1, 0, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?;
    /// assert_eq!(mesh.with_vertex_normals(&[UP; 3])?.vertex_normals(), [UP; 3]);
    /// let too_few = mesh.with_vertex_normals(&[UP; 2]).unwrap_err();
    /// assert_eq!(too_few.to_string(), "a list of 2 entries where 3 are needed: give one normal per vertex");
    /// # Ok::<(), pinhole::mesh::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::ListLength`] if there is not one normal per vertex.
    pub const fn with_vertex_normals(self, vertex_normals: &'a [[i16; 3]]) -> Result<Self, MeshError> {
        let (vertices, normals) = (self.vertices.len(), vertex_normals.len());
        if normals != vertices {
            return Err(MeshError::ListLength { one: "normal per vertex", given: normals, needed: vertices });
        }
        Ok(Self { vertex_normals, ..self })
    }

    /// The vertices, in units of 2^[`exponent`](Self::exponent).
    pub const fn vertices(&self) -> &'a [[V; 3]] {
        self.vertices
    }

    /// The faces: three vertex indices each, counter-clockwise from outside.
    pub const fn faces(&self) -> &'a [[u16; 3]] {
        self.faces
    }

    /// The edges: two vertex indices each; empty if none were added.
    pub const fn edges(&self) -> &'a [[u16; 2]] {
        self.edges
    }

    /// The indices of the two faces adjacent to each edge, [`NO_FACE`](Self::NO_FACE) at a border; empty if none were added.
    pub const fn edge_faces(&self) -> &'a [[u16; 2]] {
        self.edge_faces
    }

    /// The unit normals of the faces in 2⁻¹⁵; empty if none were added.
    pub const fn normals(&self) -> &'a [[i16; 3]] {
        self.normals
    }

    /// The planes of the faces; empty if none were added. See [`with_planes`](Self::with_planes).
    pub const fn planes(&self) -> &'a [i16] {
        match self.planes.split_at_checked(self.faces.len()) {
            Some((planes, _)) => planes,
            None => &[],
        }
    }

    /// The clusters of the faces; empty if none were added. See [`with_planes`](Self::with_planes).
    pub const fn clusters(&self) -> &'a [[i16; 8]] {
        match self.planes.split_at_checked(self.faces.len()) {
            Some((_, clusters)) => clusters.as_chunks().0,
            None => &[],
        }
    }

    /// The unit normals of the vertices in 2⁻¹⁵; empty if none were added, as for the ready `CUBE`, `CYLINDER` and `ARROW`.
    pub const fn vertex_normals(&self) -> &'a [[i16; 3]] {
        self.vertex_normals
    }

    /// Looks up the entries of a face's three vertices, in the face's order, in a list with one entry per vertex.
    /// Missing entries are `T::default()`.
    ///
    /// ```
    /// let mesh = pinhole::Mesh::new(&[[0, 0, 0], [1, 0, 0], [0, 1, 0]], 0, &[[2, 0, 1]])?;
    /// assert_eq!(mesh.corners_of(0, &["a", "b", "c"]), ["c", "a", "b"]);
    /// # Ok::<(), pinhole::mesh::MeshError>(())
    /// ```
    pub fn corners_of<T: Copy + Default>(&self, face: usize, of_vertices: &[T]) -> [T; 3] {
        let at = |index: u16| of_vertices.get(usize::from(index)).copied().unwrap_or_default();
        self.faces.get(face).map_or_else(|| [T::default(); 3], |&corners| map3(corners, at))
    }

    /// How many `u16`s of bin storage the faces of this mesh take: one per face, one per 16 faces, and up to 32 for the bins.
    ///
    /// ```
    /// const FACES: [[u16; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// let mesh = pinhole::Mesh::new(&[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], 0, &FACES)?;
    /// assert_eq!((mesh.vertices().len(), mesh.face_bins_len(), mesh.edge_bins_len()), (4, 7, 0));
    /// # Ok::<(), pinhole::mesh::MeshError>(())
    /// ```
    pub const fn face_bins_len(&self) -> usize {
        bins_len(self.faces.len())
    }

    /// How many `u16`s of bin storage the edges of this mesh take: one per edge, one per 16 edges, and up to 32 for the bins.
    pub const fn edge_bins_len(&self) -> usize {
        bins_len(self.edges.len())
    }

    /// How many `u16`s of bin storage the edges of this mesh take to be smoothed: those of
    /// [`edge_bins_len`](Self::edge_bins_len), and two more per 16 edges.
    pub const fn smooth_bins_len(&self) -> usize {
        bins_len(self.edges.len()) + 2 * self.edges.len().div_ceil(16)
    }

    /// The exponent of the vertices' unit: model coordinate = vertex · 2^exponent, of the bits of [`Scalar`] vertices.
    pub const fn exponent(&self) -> i8 {
        self.exponent
    }
}

/// A link for each primitive, a bit for each, and a number for each bin: slices have at most 2⁶³/4 elements, so the sum does not overflow.
pub(crate) const fn bins_len(primitives: usize) -> usize {
    primitives + primitives.div_ceil(16) + bin_count(primitives)
}

/// The most bins that primitives have. With 240 rows, each has eight.
pub(crate) const MOST_BINS: usize = 32;

/// The number of bins of some primitives, a power of two: fewer for few, which are tested in more bands for it.
pub(crate) const fn bin_count(primitives: usize) -> usize {
    match primitives / 2 {
        0 => primitives, // none, or one
        half if half < MOST_BINS => 1 << (usize::BITS - 1 - half.leading_zeros()),
        _ => MOST_BINS,
    }
}

impl<V: Coordinate> Mesh<'_, V> {
    /// The plane of one face, for lists whose length is known at run time: as [`face_planes`](Mesh::face_planes).
    pub fn face_plane(&self, face: usize) -> i16 {
        self.corner_and_normal(face)
            .map_or(0, |(&corner, normal)| plane_distance(map3(corner, |c| c.times(1)), normal, self.justify))
    }

    /// A bounding sphere about the centre of the vertices' bounding box, in model units. Its radius is at most √3 times the
    /// smallest possible, rounded up by at most 9·2⁻¹⁶ plus 2⁻²⁸ of itself; `Scalar::MAX` if centre or radius do not fit
    /// [`Scalar`]. For [`Frustum::visibility`](crate::camera::Frustum::visibility): compute it once per mesh.
    pub fn bounding_sphere(&self) -> Sphere {
        let justify = u32::from(self.justify);
        // In 2^unit world units.
        let (unit, factor) = (i32::from(self.exponent) - justify as i32, 1 << (justify & 31));
        let (mut low, mut high) = ([i64::MAX; 3], [i64::MIN; 3]);
        for &vertex in self.vertices {
            let v = vertex.map(|c| i64::from(c.times(factor)));
            for ((low, high), c) in low.iter_mut().zip(&mut high).zip(v) {
                *low = c.min(*low);
                *high = c.max(*high);
            }
        }
        if self.vertices.is_empty() {
            return Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::ZERO };
        }
        let middle = |i: usize| -> i64 { (low[i] + high[i]) >> 1 }; // 33 bits
        let wide = |v: i64| scale(v, unit + 16);
        let bits = |v: i64| wide(v).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32;
        let centre = [middle(0), middle(1), middle(2)];
        let mut square = 0u64;
        for &vertex in self.vertices {
            let v = vertex.map(|c| i64::from(c.times(factor)));
            // Differences of at most 2³¹, halved: three squares of at most 2⁶⁰.
            let part = |i: usize| (v[i] - centre[i]).unsigned_abs().div_ceil(2).pow(2);
            square = square.max(part(0) + part(1) + part(2));
        }
        let radius = 2 * (i64::from(sqrt(square)) + 1);
        // Three units of 2⁻¹⁶ more, for the rounding of the centre and of the radius itself.
        let outside = centre.iter().any(|&c| i64::from(bits(c)) != wide(c));
        let radius = if outside { i32::MAX } else { bits(radius).saturating_add(3) };
        Sphere { centre: Point3::from_bits(centre.map(bits)), radius: Scalar::from_bits(radius) }
    }
}

impl<'a, V> Mesh<'a, V> {
    pub(crate) const fn justify(&self) -> u32 {
        self.justify as u32
    }

    /// A face's first vertex, and its normal.
    const fn corner_and_normal(&self, face: usize) -> Option<(&'a [V; 3], [i16; 3])> {
        if face >= self.faces.len() || face >= self.normals.len() {
            return None;
        }
        let index = self.faces[face][0] as usize;
        if index >= self.vertices.len() {
            return None; // `check_faces` excludes it; the compiler does not know
        }
        Some((&self.vertices[index], self.normals[face]))
    }
}

defmt_format!(
    [V] Mesh<'_, V>, self,
    "mesh of {=usize} vertices, {=usize} faces, {=usize} edges",
    self.vertices.len(), self.faces.len(), self.edges.len()
);
