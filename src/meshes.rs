//! Ready meshes for trying: no model file needed.
//!
//! | mesh | vertices, faces, edges | flash | |
//! |---|---|--:|---|
//! | [`CUBE`] | 8, 12, 12 | 0.3 KB | −1 … 1 on all axes |
//! | [`SPHERE`] | 114, 224, 240 | 6.3 KB | of radius 1; vertex normals |
//! | [`TORUS`] | 200, 400, 400 | 10.9 KB | lies in the xz plane, radii 0.7 and 0.3; vertex normals |
//! | [`CYLINDER`] | 34, 64, 48 | 1.3 KB | of radius 1, y from −1 to 1 |
//! | [`ARROW`] | 32, 60, 60 | 1.4 KB | along y from 0 to 1 |
//! | [`GRID`] | 81, 128, 144 | 3.6 KB | 8 × 8 squares in the xz plane, −1 … 1, seen from above; vertex normals |
//! | [`AXES`] | 4, 0, 3 | 48 B | lines from the origin to 1 on x, y and z, in this order |
//!
//! Faces are counter-clockwise, and all meshes except the grid and the axes are closed. Each has face normals, edges without
//! diagonals, and edge faces, so that every draw call works. The sphere and the torus have [face planes](Mesh::with_planes). The
//! other meshes have few faces, or are open: culling by planes would cost more than it saves. Smooth light needs vertex normals.
//!
//! ```
//! use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
//! use pinhole::{meshes::TORUS, prelude::*, Angle};
//! let mut display = MockDisplay::<Rgb565>::new();
//! display.set_allow_overdraw(true);
//! let viewport = Viewport::new(Point::zero(), display.size())?;
//! let (yaw, pitch) = (Angle::degrees(20), Angle::degrees(30));
//! let camera = Camera::framing(&TORUS.bounding_sphere(), &viewport, Angle::degrees(40), yaw, pitch)?;
//! let model = Affine::identity();
//! let light = Lambert::new(&model, Vector3::from_ints(1, 3, 2), 40)?;
//!
//! let mut depths = [0; 64 * 64];
//! let mut depth = DepthBuffer::new(display.bounding_box(), &mut depths)?;
//! let mut buffers = mesh_buffers!(TORUS);
//! let shade = |face: usize| Rgb565::CSS_GOLD.dim(light.level(TORUS.normals()[face]));
//! let statistics = camera.place(&TORUS, &model).faces(shade).cached(&mut buffers.cache).draw(&mut display.depth_tested(&mut depth))?;
//! assert!(statistics.drawn > 100 && statistics.culled > 100);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::math::num::scale;
use crate::math::Angle;
use crate::scene::{edge_faces, Mesh};

/// 1 in vertex units of 2⁻¹⁴.
const ONE: i32 = 1 << 14;

const NO_FACE: u16 = Mesh::<i16>::NO_FACE;

/// Edges, and the faces beside each in the order of [`edge_faces`], which would search them: seconds of compilation.
type Edges<const E: usize> = ([[u16; 2]; E], [[u16; 2]; E]);

/// Defines a mesh with all that belongs to it. The arrays are statics, so that a program has each once.
macro_rules! meshes {
    ($($(#[$doc:meta])* $name:ident $(with $planes:ident)?, $vertex_count:literal, $face_count:literal, $edge_count:literal:
        $vertices:expr, $faces:expr, $edges:expr $(, vertex normals $vertex_normals:expr)?;)*) => {$(
        $(#[$doc])*
        pub const $name: Mesh<'static> = {
            static VERTICES: [[i16; 3]; $vertex_count] = $vertices;
            static FACES: [[u16; 3]; $face_count] = $faces;
            static EDGES: [[u16; 2]; $edge_count] = $edges.0;
            static EDGE_FACES: [[u16; 2]; $edge_count] = $edges.1;
            static NORMALS: [[i16; 3]; $face_count] = face_normals(&VERTICES, &FACES);
            let mesh = with_normals(&VERTICES, &FACES, &NORMALS);
            $(
                static $planes: [i16; $face_count] = with_normals(&VERTICES, &FACES, &NORMALS).face_planes();
                let Ok(mesh) = mesh.with_planes(&$planes) else { panic!("one plane for each face") };
            )?
            let Ok(mesh) = mesh.with_edges(&EDGES) else { panic!("edges of these vertices") };
            let Ok(mesh) = mesh.with_edge_faces(&EDGE_FACES) else { panic!("two faces for each edge") };
            $(
                static VERTEX_NORMALS: [[i16; 3]; $vertex_count] = $vertex_normals;
                let Ok(mesh) = mesh.with_vertex_normals(&VERTEX_NORMALS) else { panic!("one normal for each vertex") };
            )?
            mesh
        };
    )*};
}

/// The radius and the y of the sphere's rings, from the lowest.
const SPHERE_RINGS: [[i32; 2]; 7] = {
    let (turn, mut rings, mut ring) = (circle::<16>(), [[0; 2]; 7], 0);
    while ring < 7 {
        // The angle from the south pole is 1/16, 2/16 … 7/16 of a turn.
        let (sine, cosine) = turn[ring + 1];
        rings[ring] = [times(ONE, sine), -times(ONE, cosine)];
        ring += 1;
    }
    rings
};

/// The shaft's foot, its head, and the foot of the tip.
const ARROW_RINGS: [[i32; 2]; 3] = [[ONE / 20, 0], [ONE / 20, ONE * 7 / 10], [ONE / 8, ONE * 7 / 10]];

const CUBE_FACES: [[u16; 3]; 12] = [
    [1, 3, 7],
    [1, 7, 5],
    [0, 4, 6],
    [0, 6, 2],
    [2, 6, 7],
    [2, 7, 3],
    [0, 1, 5],
    [0, 5, 4],
    [4, 5, 7],
    [4, 7, 6],
    [0, 2, 3],
    [0, 3, 1],
];
const CUBE_EDGES: [[u16; 2]; 12] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

meshes! {
    /// A cube from −1 to 1 on all axes.
    CUBE, 8, 12, 12:
        cube_vertices(), CUBE_FACES, (CUBE_EDGES, edge_faces(&CUBE_EDGES, &CUBE_FACES));

    /// A sphere of radius 1, with its poles on the y axis, 16 faces around and 8 from pole to pole.
    SPHERE with PLANES, 114, 224, 240:
        revolved::<16, 7, 114>(&SPHERE_RINGS, [-ONE, ONE]),
        revolved_faces::<16, 7, 224>(),
        revolved_edges::<16, 7, 240>(true, true),
        vertex normals sphere_normals();

    /// A torus about the y axis: a tube of radius 0.3 around a circle of radius 0.7, 20 segments around the axis and 10 around the
    /// tube.
    TORUS with PLANES, 200, 400, 400:
        torus_vertices::<20, 10, 200>(),
        torus_faces::<20, 10, 400>(),
        torus_edges::<20, 10, 400>(),
        vertex normals torus_normals::<20, 10, 200>();

    /// A cylinder about the y axis, of radius 1 and from y = −1 to 1, with 16 sides and both ends closed.
    CYLINDER, 34, 64, 48:
        revolved::<16, 2, 34>(&[[ONE, -ONE], [ONE, ONE]], [-ONE, ONE]),
        revolved_faces::<16, 2, 64>(),
        revolved_edges::<16, 2, 48>(false, false);

    /// An arrow along y, from the origin to y = 1. For the x axis rotate it by −90° about z, for the z axis by 90° about x.
    ARROW, 32, 60, 60:
        revolved::<10, 3, 32>(&ARROW_RINGS, [0, ONE]),
        revolved_faces::<10, 3, 60>(),
        revolved_edges::<10, 3, 60>(false, true);

    /// A square of 8 × 8 fields in the xz plane, from −1 to 1, whose front is above: a floor. It is open.
    GRID, 81, 128, 144:
        grid_vertices(),
        grid_faces(),
        grid_edges(),
        vertex normals [[0, 32_767, 0]; 81];

    /// Lines from the origin to 1 on the x axis, the y axis and the z axis: edges 0, 1 and 2.
    AXES, 4, 0, 3:
        [[0, 0, 0], [ONE as i16, 0, 0], [0, ONE as i16, 0], [0, 0, ONE as i16]],
        [],
        ([[0, 1], [0, 2], [0, 3]], [[NO_FACE; 2]; 3]);
}

/// `length · factor` for a factor in 2⁻³⁰, rounded to nearest.
const fn times(length: i32, factor: i32) -> i32 {
    scale(length as i64 * factor as i64, -30) as i32 // 62 bits, and at most `length`
}

const fn with_normals(
    vertices: &'static [[i16; 3]],
    faces: &'static [[u16; 3]],
    normals: &'static [[i16; 3]],
) -> Mesh<'static> {
    let Ok(mesh) = Mesh::new(vertices, -14, faces) else { panic!("faces of these vertices") };
    let Ok(mesh) = mesh.with_normals(normals) else { panic!("one normal for each face") };
    mesh
}

/// The sine and cosine, in 2⁻³⁰, of 0/N, 1/N … of a turn. A mesh takes them from this table, as the compiler needs long for each.
const fn circle<const N: usize>() -> [(i32, i32); N] {
    let (mut turn, mut k) = ([(0, 0); N], 0);
    while k < N {
        turn[k] = Angle::turns(k as i32, N as u32).sin_cos();
        k += 1;
    }
    turn
}

/// A number in 2⁻³⁰, at most 1, as Q0.15.
const fn q15(number: i32) -> i16 {
    let rounded = (number + (1 << 14)) >> 15;
    if rounded > 32_767 {
        32_767
    } else {
        rounded as i16
    }
}

/// The direction of a vector of at most 33 bits, as Q0.15. In `f64`: the compiler takes ten times as long for the integers of
/// `math::unit::normalise`, which give equal normals.
const fn direction([x, y, z]: [i64; 3]) -> [i16; 3] {
    let (x, y, z) = (x as f64, y as f64, z as f64);
    let square = x * x + y * y + z * z;
    // The square root by Newton's method: half the exponent is within 6 % of it, and each step doubles the digits.
    let (mut length, mut step) = (f64::from_bits((square.to_bits() >> 1) + (1023 << 51)), 0);
    while step < 4 {
        length = (length + square / length) / 2.0;
        step += 1;
    }
    const fn component(ratio: f64) -> i16 {
        let steps = ratio * (1 << 30) as f64;
        q15((if steps < 0.0 { steps - 0.5 } else { steps + 0.5 }) as i32) // `as` rounds to zero
    }
    [component(x / length), component(y / length), component(z / length)]
}

const fn face_normals<const F: usize>(vertices: &[[i16; 3]], faces: &[[u16; 3]; F]) -> [[i16; 3]; F] {
    const fn side([a, b, c]: [i16; 3], [p, q, r]: [i16; 3]) -> [i64; 3] {
        [p as i64 - a as i64, q as i64 - b as i64, r as i64 - c as i64]
    }
    let (mut normals, mut face) = ([[0; 3]; F], 0);
    while face < F {
        let [a, b, c] = faces[face];
        let (a, b, c) = (vertices[a as usize], vertices[b as usize], vertices[c as usize]);
        let ([a, b, c], [p, q, r]) = (side(a, b), side(a, c));
        normals[face] = direction([b * r - c * q, c * p - a * r, a * q - b * p]);
        face += 1;
    }
    normals
}

/// Vertex k has x, y, z = ±1 by bits 0, 1, 2.
const fn cube_vertices() -> [[i16; 3]; 8] {
    let (mut vertices, mut k) = ([[0; 3]; 8], 0);
    while k < 8 {
        const fn at(bit: i16) -> i16 {
            (2 * bit - 1) * ONE as i16
        }
        vertices[k as usize] = [at(k & 1), at(k >> 1 & 1), at(k >> 2 & 1)];
        k += 1;
    }
    vertices
}

/// The vertices of a surface of revolution about y, in 1/[`ONE`] unit: rings of `AROUND` vertices, each ring given by its radius
/// and its y, from the lowest; then the lower and the upper pole, given by their y.
const fn revolved<const AROUND: usize, const RINGS: usize, const V: usize>(
    rings: &[[i32; 2]; RINGS],
    [south, north]: [i32; 2],
) -> [[i16; 3]; V] {
    let (turn, mut vertices, mut ring) = (circle::<AROUND>(), [[0; 3]; V], 0);
    while ring < RINGS {
        let ([radius, y], mut i) = (rings[ring], 0);
        while i < AROUND {
            let (sine, cosine) = turn[i];
            vertices[ring * AROUND + i] =
                [times(radius, sine) as i16, y as i16, times(radius, cosine) as i16];
            i += 1;
        }
        ring += 1;
    }
    vertices[RINGS * AROUND] = [0, south as i16, 0];
    vertices[RINGS * AROUND + 1] = [0, north as i16, 0];
    vertices
}

const fn revolved_faces<const AROUND: usize, const RINGS: usize, const F: usize>() -> [[u16; 3]; F] {
    let (mut faces, mut face, mut i) = ([[0; 3]; F], 0, 0);
    let (south, north) = ((RINGS * AROUND) as u16, (RINGS * AROUND + 1) as u16);
    while i < AROUND {
        let (here, next) = (i as u16, ((i + 1) % AROUND) as u16);
        faces[face] = [south, next, here];
        face += 1;
        let mut ring = 0;
        while ring + 1 < RINGS {
            let (low, high) = ((ring * AROUND) as u16, ((ring + 1) * AROUND) as u16);
            faces[face] = [low + here, low + next, high + next];
            faces[face + 1] = [low + here, high + next, high + here];
            (face, ring) = (face + 2, ring + 1);
        }
        let top = ((RINGS - 1) * AROUND) as u16;
        faces[face] = [north, top + here, top + next];
        (face, i) = (face + 1, i + 1);
    }
    faces
}

/// The rings and the lines from ring to ring, and those to the poles where wanted.
const fn revolved_edges<const AROUND: usize, const RINGS: usize, const E: usize>(
    to_south: bool,
    to_north: bool,
) -> Edges<E> {
    let (mut edges, mut beside, mut edge, mut i) = ([[0; 2]; E], [[0; 2]; E], 0, 0);
    while i < AROUND {
        let (here, next) = (i as u16, ((i + 1) % AROUND) as u16);
        // The first face of the sector from `here` to `next`, and of the sector before it.
        let (face, before) = (2 * RINGS * i, 2 * RINGS * ((i + AROUND - 1) % AROUND));
        let mut ring = 0;
        while ring < RINGS {
            let (low, high) = ((ring * AROUND) as u16, ((ring + 1) * AROUND) as u16);
            (edges[edge], beside[edge]) =
                ([low + here, low + next], ascending(face + 2 * ring, face + 2 * ring + 1));
            edge += 1;
            if ring + 1 < RINGS {
                edges[edge] = [low + here, high + here];
                beside[edge] = ascending(face + 2 * ring + 2, before + 2 * ring + 1);
                edge += 1;
            }
            ring += 1;
        }
        if to_south {
            (edges[edge], beside[edge]) = ([(RINGS * AROUND) as u16, here], ascending(face, before));
            edge += 1;
        }
        if to_north {
            edges[edge] = [((RINGS - 1) * AROUND) as u16 + here, (RINGS * AROUND + 1) as u16];
            beside[edge] = ascending(face + 2 * RINGS - 1, before + 2 * RINGS - 1);
            edge += 1;
        }
        i += 1;
    }
    (edges, beside)
}

const fn ascending(face: usize, other: usize) -> [u16; 2] {
    if face < other {
        [face as u16, other as u16]
    } else {
        [other as u16, face as u16]
    }
}

/// The vertex normals of the sphere, in 2⁻¹⁵: the directions of its vertices from its centre.
const fn sphere_normals() -> [[i16; 3]; 114] {
    let vertices: [[i16; 3]; 114] = revolved::<16, 7, 114>(&SPHERE_RINGS, [-ONE, ONE]);
    let (mut normals, mut i) = ([[0; 3]; 114], 0);
    while i < 114 {
        let [x, y, z] = vertices[i];
        normals[i] = direction([x as i64, y as i64, z as i64]);
        i += 1;
    }
    normals
}

/// Vertex i · `ACROSS` + j: i around the axis, j around the tube, from the outside upwards.
const fn torus_vertices<const AROUND: usize, const ACROSS: usize, const V: usize>() -> [[i16; 3]; V] {
    let (around, across) = (circle::<AROUND>(), circle::<ACROSS>());
    let (mut vertices, mut k) = ([[0; 3]; V], 0);
    while k < V {
        let ((s, c), (t, d)) = (around[k / ACROSS], across[k % ACROSS]);
        let (radius, tube) = (ONE * 7 / 10, ONE * 3 / 10);
        let from_axis = radius + times(tube, d);
        vertices[k] = [times(from_axis, s) as i16, times(tube, t) as i16, times(from_axis, c) as i16];
        k += 1;
    }
    vertices
}

const fn torus_normals<const AROUND: usize, const ACROSS: usize, const V: usize>() -> [[i16; 3]; V] {
    let (around, across) = (circle::<AROUND>(), circle::<ACROSS>());
    let (mut normals, mut k) = ([[0; 3]; V], 0);
    while k < V {
        let ((s, c), (t, d)) = (around[k / ACROSS], across[k % ACROSS]);
        normals[k] = [q15(times(s, d)), q15(t), q15(times(c, d))];
        k += 1;
    }
    normals
}

const fn torus_faces<const AROUND: usize, const ACROSS: usize, const F: usize>() -> [[u16; 3]; F] {
    let (mut faces, mut k) = ([[0; 3]; F], 0);
    while k < AROUND * ACROSS {
        let (i, j) = (k / ACROSS, k % ACROSS);
        let (next_i, next_j) = ((i + 1) % AROUND * ACROSS, (j + 1) % ACROSS);
        let (a, b) = (k as u16, (next_i + j) as u16);
        let (c, d) = ((next_i + next_j) as u16, (i * ACROSS + next_j) as u16);
        (faces[2 * k], faces[2 * k + 1]) = ([a, b, c], [a, c, d]);
        k += 1;
    }
    faces
}

const fn torus_edges<const AROUND: usize, const ACROSS: usize, const E: usize>() -> Edges<E> {
    let (mut edges, mut beside, mut k) = ([[0; 2]; E], [[0; 2]; E], 0);
    while k < AROUND * ACROSS {
        let (i, j) = (k / ACROSS, k % ACROSS);
        let (before_i, before_j) = ((i + AROUND - 1) % AROUND * ACROSS, (j + ACROSS - 1) % ACROSS);
        edges[2 * k] = [k as u16, ((i + 1) % AROUND * ACROSS + j) as u16];
        beside[2 * k] = ascending(2 * k, 2 * (i * ACROSS + before_j) + 1);
        edges[2 * k + 1] = [k as u16, (i * ACROSS + (j + 1) % ACROSS) as u16];
        beside[2 * k + 1] = ascending(2 * k + 1, 2 * (before_i + j));
        k += 1;
    }
    (edges, beside)
}

/// The fields of the grid along a side.
const SIDE: usize = 8;

/// Vertex j · 9 + i: i along x, j along z.
const fn grid_vertices() -> [[i16; 3]; 81] {
    const fn at(k: usize) -> i16 {
        (k as i32 * (2 * ONE / SIDE as i32) - ONE) as i16
    }
    let (mut vertices, mut k) = ([[0; 3]; 81], 0);
    while k < 81 {
        vertices[k] = [at(k % (SIDE + 1)), 0, at(k / (SIDE + 1))];
        k += 1;
    }
    vertices
}

const fn grid_faces() -> [[u16; 3]; 128] {
    let (mut faces, mut k) = ([[0; 3]; 128], 0);
    while k < SIDE * SIDE {
        // Seen from above with x to the right, z points towards the viewer: the far corners have less z.
        let far_left = (k / SIDE * (SIDE + 1) + k % SIDE) as u16;
        let near_left = far_left + (SIDE + 1) as u16;
        faces[2 * k] = [near_left, near_left + 1, far_left + 1];
        faces[2 * k + 1] = [near_left, far_left + 1, far_left];
        k += 1;
    }
    faces
}

const fn grid_edges() -> Edges<144> {
    let (mut edges, mut beside, mut edge, mut k) = ([[0; 2]; 144], [[0; 2]; 144], 0, 0);
    while k < 81 {
        let (i, j) = (k % (SIDE + 1), k / (SIDE + 1));
        // The second face of the field to the right of and nearer than vertex `k`.
        let face = 2 * (j * SIDE + i) + 1;
        if i < SIDE {
            edges[edge] = [k as u16, k as u16 + 1];
            beside[edge] = match j {
                0 => [face as u16, NO_FACE],
                SIDE => [(face - 2 * SIDE - 1) as u16, NO_FACE],
                _ => [(face - 2 * SIDE - 1) as u16, face as u16],
            };
            edge += 1;
        }
        if j < SIDE {
            edges[edge] = [k as u16, (k + SIDE + 1) as u16];
            beside[edge] = match i {
                0 => [face as u16, NO_FACE],
                SIDE => [(face - 3) as u16, NO_FACE],
                _ => [(face - 3) as u16, face as u16],
            };
            edge += 1;
        }
        k += 1;
    }
    (edges, beside)
}
