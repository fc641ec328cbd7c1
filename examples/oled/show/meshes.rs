//! Meshes: a ship, a ball, a ring and the teapot. The compiler evaluates them into flash; an invalid mesh does not compile.

use pinhole::{mesh::edge_faces, Mesh};

/// A ship, nose towards +z, within ±10.
pub(super) const SHIP: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&SHIP_VERTICES, 0, &SHIP_FACES) else { panic!() };
    let Ok(mesh) = mesh.with_edges(&SHIP_EDGES) else { panic!() };
    let Ok(mesh) = mesh.with_edge_faces(&SHIP_BESIDE) else { panic!() };
    let Ok(mesh) = mesh.with_normals(&SHIP_NORMALS) else { panic!() };
    mesh
};
/// Vertices with labels in the picture.
pub(super) const NOSE: usize = 0;
pub(super) const LEFT_TIP: usize = 1;
pub(super) const RIGHT_TIP: usize = 2;

const SHIP_VERTICES: [[i16; 3]; 8] =
    [[0, 0, 10], [-10, -1, -6], [10, -1, -6], [0, 4, -4], [-4, 2, -8], [4, 2, -8], [-4, -2, -8], [4, -2, -8]];
const SHIP_FACES: [[u16; 3]; 12] = [
    [0, 3, 1],
    [0, 2, 3],
    [3, 4, 1],
    [3, 2, 5],
    [3, 5, 4],
    [4, 5, 7],
    [4, 7, 6],
    [1, 4, 6],
    [2, 7, 5],
    [0, 1, 6],
    [0, 7, 2],
    [0, 6, 7],
];
/// All edges except the diagonal of the stern.
const SHIP_EDGES: [[u16; 2]; 17] = [
    [0, 1],
    [0, 2],
    [0, 3],
    [0, 6],
    [0, 7],
    [1, 3],
    [1, 4],
    [1, 6],
    [2, 3],
    [2, 5],
    [2, 7],
    [3, 4],
    [3, 5],
    [4, 5],
    [4, 6],
    [5, 7],
    [6, 7],
];
const SHIP_BESIDE: [[u16; 2]; 17] = edge_faces(&SHIP_EDGES, &SHIP_FACES);
const SHIP_NORMALS: [[i16; 3]; 12] = {
    let mut normals = [[0; 3]; 12];
    let mut i = 0;
    while i < 12 {
        let [a, b, c] = SHIP_FACES[i];
        let [a, b, c] = [SHIP_VERTICES[a as usize], SHIP_VERTICES[b as usize], SHIP_VERTICES[c as usize]];
        normals[i] = unit(cross(minus(b, a), minus(c, a)), 32_767);
        i += 1;
    }
    normals
};

/// The teapot, with vertex normals.
pub(super) const TEAPOT: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES) else { panic!() };
    let Ok(mesh) = mesh.with_vertex_normals(&TEAPOT_NORMALS) else { panic!() };
    mesh
};
pub(super) const TEAPOT_VERTICES: usize = teapot::VERTICES.len();
pub(super) const TEAPOT_FACES: usize = teapot::FACES.len();
const TEAPOT_NORMALS: [[i16; 3]; TEAPOT_VERTICES] = {
    let mut sums = [[0i64; 3]; TEAPOT_VERTICES];
    let mut face = 0;
    while face < TEAPOT_FACES {
        let mut corner = 0;
        while corner < 3 {
            let sum = &mut sums[teapot::FACES[face][corner] as usize];
            let [x, y, z] = teapot::NORMALS[face];
            *sum = [sum[0] + x as i64, sum[1] + y as i64, sum[2] + z as i64];
            corner += 1;
        }
        face += 1;
    }
    let mut normals = [[0; 3]; TEAPOT_VERTICES];
    let mut vertex = 0;
    while vertex < TEAPOT_VERTICES {
        normals[vertex] = unit(sums[vertex], 32_767);
        vertex += 1;
    }
    normals
};

/// A sphere of radius 1: the faces of an octahedron, subdivided and projected to the sphere. Its vertices are its normals.
pub(super) const BALL: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&BALL_VERTICES, BALL_EXPONENT, &BALL_FACES) else { panic!() };
    let Ok(mesh) = mesh.with_vertex_normals(&BALL_VERTICES) else { panic!() };
    mesh
};
pub(super) const BALL_CORNERS: usize = 8 * OCTANT;
pub(super) const BALL_COUNT: usize = 8 * PARTS * PARTS;
/// 32767 stands for 1.
const BALL_EXPONENT: i8 = -15;
/// Number of parts of an edge of the octahedron.
const PARTS: usize = 6;
const OCTANT: usize = (PARTS + 1) * (PARTS + 2) / 2;

const BALL_VERTICES: [[i16; 3]; BALL_CORNERS] = {
    let mut vertices = [[0; 3]; BALL_CORNERS];
    let (mut octant, mut next) = (0, 0);
    while octant < 8 {
        let mut row = 0;
        while row <= PARTS {
            let mut place = 0;
            while place <= row {
                // On the face x + y + z = PARTS.
                let [x, y, z] = [row - place, PARTS - row, place];
                let [x, y, z] = [x as i64, y as i64, z as i64];
                let (across, up, deep) = signs(octant);
                vertices[next] = unit([across * x, up * y, deep * z], 32_767);
                next += 1;
                place += 1;
            }
            row += 1;
        }
        octant += 1;
    }
    vertices
};

const BALL_FACES: [[u16; 3]; BALL_COUNT] = {
    let mut faces = [[0; 3]; BALL_COUNT];
    let (mut octant, mut next) = (0, 0);
    while octant < 8 {
        let first = (octant * OCTANT) as u16;
        let (across, up, deep) = signs(octant);
        // Every negative sign mirrors the face.
        let mirrored = across * up * deep < 0;
        let mut row = 0;
        while row < PARTS as u16 {
            // Vertices of a row, and of the row below, which has one more.
            let (above, below) = (first + row * (row + 1) / 2, first + (row + 1) * (row + 2) / 2);
            let mut place = 0;
            while place <= row {
                let (a, b, c) = (above + place, below + place, below + place + 1);
                faces[next] = if mirrored { [a, b, c] } else { [a, c, b] };
                next += 1;
                if place < row {
                    let d = above + place + 1;
                    faces[next] = if mirrored { [a, c, d] } else { [a, d, c] };
                    next += 1;
                }
                place += 1;
            }
            row += 1;
        }
        octant += 1;
    }
    faces
};

const fn signs(octant: usize) -> (i64, i64, i64) {
    (1 - 2 * (octant as i64 & 1), 1 - (octant as i64 & 2), 1 - (octant as i64 & 4) / 2)
}

/// A circle of radius 1 about the y axis, as edges.
pub(super) const RING: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&RING_VERTICES, BALL_EXPONENT, &[]) else { panic!() };
    let Ok(mesh) = mesh.with_edges(&RING_EDGES) else { panic!() };
    mesh
};
pub(super) const RING_CORNERS: usize = 48;

const RING_VERTICES: [[i16; 3]; RING_CORNERS] = {
    let mut vertices = [[0; 3]; RING_CORNERS];
    let mut i = 0;
    while i < RING_CORNERS {
        // A side of a square, projected to the circle, in four directions.
        let quarter = RING_CORNERS as i64 / 4;
        let along = i as i64 % quarter;
        let (x, z) = (quarter - along, along);
        let (x, z) = match i as i64 / quarter {
            0 => (x, z),
            1 => (-z, x),
            2 => (-x, -z),
            _ => (z, -x),
        };
        vertices[i] = unit([x, 0, z], 32_767);
        i += 1;
    }
    vertices
};
const RING_EDGES: [[u16; 2]; RING_CORNERS] = {
    let mut edges = [[0; 2]; RING_CORNERS];
    let mut i = 0;
    while i < RING_CORNERS {
        edges[i] = [i as u16, ((i + 1) % RING_CORNERS) as u16];
        i += 1;
    }
    edges
};

const fn minus([a, b, c]: [i16; 3], [x, y, z]: [i16; 3]) -> [i64; 3] {
    [a as i64 - x as i64, b as i64 - y as i64, c as i64 - z as i64]
}

const fn cross([a, b, c]: [i64; 3], [x, y, z]: [i64; 3]) -> [i64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// Scales a vector to a length, rounding towards zero.
const fn unit([x, y, z]: [i64; 3], length: i64) -> [i16; 3] {
    // Scaled by 2¹⁰ so that the root of a short vector keeps its precision; |v| < 2²⁰ here.
    let [x, y, z] = [x << 10, y << 10, z << 10];
    let root = (x * x + y * y + z * z).isqrt() + 1; // so nothing exceeds `length`
    [(x * length / root) as i16, (y * length / root) as i16, (z * length / root) as i16]
}
