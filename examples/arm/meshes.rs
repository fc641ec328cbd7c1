//! The two meshes of which the robot consists, each from −1 to 1 along every axis, and the floor.

use pinhole::{Mesh, MeshError};

const EXPONENT: i8 = -14;
const ONE: i16 = 1 << 14;
/// The corners of a regular dodecagon, counter-clockwise from x towards y.
const DODECAGON: [[i16; 2]; 12] = {
    const A: i16 = 14_189; // cos 30°
    const B: i16 = 8_192; // sin 30°
    [
        [ONE, 0],
        [A, B],
        [B, A],
        [0, ONE],
        [-B, A],
        [-A, B],
        [-ONE, 0],
        [-A, -B],
        [-B, -A],
        [0, -ONE],
        [B, -A],
        [A, -B],
    ]
};
/// Directions halfway between neighbouring corners, in 2⁻¹⁵.
const BETWEEN: [[i16; 2]; 12] = {
    const A: i16 = 31_650; // cos 15°
    const B: i16 = 23_170; // cos 45°
    const C: i16 = 8_481; // cos 75°
    [
        [A, C],
        [B, B],
        [C, A],
        [-C, A],
        [-B, B],
        [-A, C],
        [-A, -C],
        [-B, -B],
        [-C, -A],
        [C, -A],
        [B, -B],
        [A, -C],
    ]
};
/// Segments of a beam along y: short faces sort better than long ones.
const SEGMENTS: usize = 4;

/// A shape's data.
struct Data<const VERTICES: usize, const FACES: usize> {
    vertices: [[i16; 3]; VERTICES],
    faces: [[u16; 3]; FACES],
    normals: [[i16; 3]; FACES],
}

/// Twelve sides about the y axis; the first 24 vertices are the lower and the upper corners in turn.
static DRUM: Data<26, 48> = {
    let mut vertices = [[0; 3]; 26];
    let mut faces = [[0; 3]; 48];
    let mut normals = [[0; 3]; 48];
    let (mut k, mut i) = (0, 0);
    while k < 12 {
        // From z towards x seen from above, so that y is the axis of the screw.
        let [z, x] = DODECAGON[k];
        vertices[2 * k] = [x, -ONE, z];
        vertices[2 * k + 1] = [x, ONE, z];
        let (low, next) = (2 * k as u16, 2 * ((k as u16 + 1) % 12));
        faces[i] = [low, next, next + 1];
        faces[i + 1] = [low, next + 1, low + 1];
        faces[i + 2] = [24, next, low];
        faces[i + 3] = [25, low + 1, next + 1];
        let [z, x] = BETWEEN[k];
        normals[i] = [x, 0, z];
        normals[i + 1] = [x, 0, z];
        normals[i + 2] = [0, -i16::MAX, 0];
        normals[i + 3] = [0, i16::MAX, 0];
        k += 1;
        i += 4;
    }
    vertices[24] = [0, -ONE, 0];
    vertices[25] = [0, ONE, 0];
    Data { vertices, faces, normals }
};

/// Four sides about the y axis.
static BEAM: Data<{ 4 * (SEGMENTS + 1) }, { 8 * SEGMENTS + 4 }> = {
    let mut vertices = [[0; 3]; 4 * (SEGMENTS + 1)];
    let mut faces = [[0; 3]; 8 * SEGMENTS + 4];
    let mut normals = [[0; 3]; 8 * SEGMENTS + 4];
    // From z towards x, and the side that follows each corner.
    let corners = [[ONE, ONE], [ONE, -ONE], [-ONE, -ONE], [-ONE, ONE]];
    let outwards = [[i16::MAX, 0, 0], [0, 0, -i16::MAX], [-i16::MAX, 0, 0], [0, 0, i16::MAX]];
    let (mut ring, mut i) = (0, 0);
    while ring <= SEGMENTS {
        let mut k = 0;
        while k < 4 {
            let [x, z] = corners[k];
            let here = 4 * ring + k;
            let y = -(ONE as i32) + 2 * ONE as i32 * ring as i32 / SEGMENTS as i32;
            vertices[here] = [x, y as i16, z];
            if ring < SEGMENTS {
                let (low, next) = (here as u16, (4 * ring + (k + 1) % 4) as u16);
                faces[i] = [low, next, next + 4];
                faces[i + 1] = [low, next + 4, low + 4];
                normals[i] = outwards[k];
                normals[i + 1] = outwards[k];
                i += 2;
            }
            k += 1;
        }
        ring += 1;
    }
    let top = 4 * SEGMENTS as u16;
    faces[i] = [0, 2, 1];
    faces[i + 1] = [0, 3, 2];
    faces[i + 2] = [top, top + 1, top + 2];
    faces[i + 3] = [top, top + 2, top + 3];
    normals[i] = [0, -i16::MAX, 0];
    normals[i + 1] = [0, -i16::MAX, 0];
    normals[i + 2] = [0, i16::MAX, 0];
    normals[i + 3] = [0, i16::MAX, 0];
    Data { vertices, faces, normals }
};

pub(crate) fn drum() -> Result<Mesh<'static>, MeshError> {
    Mesh::new(&DRUM.vertices, EXPONENT, &DRUM.faces)?.with_normals(&DRUM.normals)
}

pub(crate) fn beam() -> Result<Mesh<'static>, MeshError> {
    Mesh::new(&BEAM.vertices, EXPONENT, &BEAM.faces)?.with_normals(&BEAM.normals)
}

/// Half the floor's side.
const REACH: i16 = 4;
const LINES: usize = 2 * REACH as usize + 1;

/// The ends of the lines along x, then of those along z, a unit apart.
static FLOOR_VERTICES: [[i16; 3]; 4 * LINES] = {
    let mut vertices = [[0; 3]; 4 * LINES];
    let mut i = 0;
    while i < LINES {
        let across = i as i16 - REACH;
        vertices[2 * i] = [-REACH, 0, across];
        vertices[2 * i + 1] = [REACH, 0, across];
        vertices[2 * (LINES + i)] = [across, 0, -REACH];
        vertices[2 * (LINES + i) + 1] = [across, 0, REACH];
        i += 1;
    }
    vertices
};
static FLOOR_EDGES: [[u16; 2]; 2 * LINES] = {
    let mut edges = [[0; 2]; 2 * LINES];
    let mut i = 0;
    while i < 2 * LINES {
        edges[i] = [2 * i as u16, 2 * i as u16 + 1];
        i += 1;
    }
    edges
};
/// The floor's faces, visible from above.
static FLOOR_FACES: [[u16; 3]; 2] = {
    let far = 2 * (LINES as u16 - 1);
    [[far, far + 1, 1], [far, 1, 0]]
};

/// A square with a grid.
pub(crate) fn floor() -> Result<Mesh<'static>, MeshError> {
    Mesh::new(&FLOOR_VERTICES, 0, &FLOOR_FACES)?.with_edges(&FLOOR_EDGES)
}
