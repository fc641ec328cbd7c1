//! A height field in integers: the ripples of a drop, computed for every frame.

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use pinhole::{Angle, Mesh, MeshError};

/// Vertices along a side, and what lies between two of them, in units of 2⁻¹³.
const SIDE: usize = 33;
const STEP: i32 = 1024;
const EXPONENT: i8 = -13;
pub(crate) const VERTICES: usize = SIDE * SIDE;

/// Between 33 vertices lie 32 squares of two triangles; every fourth line of the grid is drawn.
const LINES: usize = 9;
pub(crate) const FACES: [[u16; 3]; 2 * (SIDE - 1) * (SIDE - 1)] = faces();
pub(crate) const EDGES: [[u16; 2]; 2 * LINES * (SIDE - 1)] = edges();

const fn index(x: usize, y: usize) -> u16 {
    (y * SIDE + x) as u16
}

const fn faces() -> [[u16; 3]; 2 * (SIDE - 1) * (SIDE - 1)] {
    let mut faces = [[0; 3]; 2 * (SIDE - 1) * (SIDE - 1)];
    let mut square = 0;
    while square < faces.len() / 2 {
        let (x, y) = (square % (SIDE - 1), square / (SIDE - 1));
        let (a, b) = (index(x, y), index(x + 1, y + 1));
        faces[2 * square] = [a, index(x + 1, y), b];
        faces[2 * square + 1] = [a, b, index(x, y + 1)];
        square += 1;
    }
    faces
}

const fn edges() -> [[u16; 2]; 2 * LINES * (SIDE - 1)] {
    let mut edges = [[0; 2]; 2 * LINES * (SIDE - 1)];
    let mut edge = 0;
    while edge < edges.len() / 2 {
        let (along, line) = (edge % (SIDE - 1), edge / (SIDE - 1) * 4);
        edges[2 * edge] = [index(along, line), index(along + 1, line)];
        edges[2 * edge + 1] = [index(line, along), index(line, along + 1)];
        edge += 1;
    }
    edges
}

/// Data that change with every frame: 12 bytes per vertex.
pub(crate) struct Water {
    vertices: [[i16; 3]; VERTICES],
    normals: [[i16; 3]; VERTICES],
}

/// Distance from the centre, in units.
fn place(i: usize) -> i32 {
    (i as i32 - SIDE as i32 / 2) * STEP
}

/// The height at a point: a wave that runs outwards and fades.
fn height(x: i32, y: i32, phase: Angle) -> i32 {
    let distance = (x * x + y * y).isqrt();
    let wave = Angle::from_bits((distance as u32) << 19) - phase; // one in 8192 units
    let (sine, _) = wave.sin_cos(); // in 2⁻³⁰
    let strength = 3600 * 8192 / (8192 + distance);
    ((i64::from(sine) * i64::from(strength)) >> 30) as i32
}

impl Water {
    pub(crate) fn new() -> Self {
        Self { vertices: [[0; 3]; VERTICES], normals: [[0; 3]; VERTICES] }
    }

    /// Moves all vertices.
    pub(crate) fn ripple(&mut self, phase: Angle) {
        for (i, (vertex, normal)) in self.vertices.iter_mut().zip(&mut self.normals).enumerate() {
            let (x, y) = (place(i % SIDE), place(i / SIDE));
            let at = |dx: i32, dy: i32| height(x + dx, y + dy, phase);
            *vertex = [x, y, at(0, 0)].map(|c| c as i16); // within ±16384
            let steep = [at(-STEP, 0) - at(STEP, 0), at(0, -STEP) - at(0, STEP), 2 * STEP];
            let length = steep.iter().map(|c| c * c).sum::<i32>().isqrt();
            *normal = steep.map(|c| (c * 32_767 / (length + 1)) as i16);
        }
    }

    pub(crate) fn mesh(&self) -> Result<Mesh<'_>, MeshError> {
        Mesh::new(&self.vertices, EXPONENT, &FACES)?.with_edges(&EDGES)?.with_vertex_normals(&self.normals)
    }

    /// Vertex by vertex.
    pub(crate) fn heights(&self) -> impl Iterator<Item = i16> + '_ {
        self.vertices.iter().map(|&[_, _, z]| z)
    }
}

/// Colours from valleys to crests.
pub(crate) fn colour(height: i16) -> Rgb888 {
    const STOPS: [Rgb888; 5] = [
        Rgb888::new(30, 30, 150),
        Rgb888::new(20, 120, 200),
        Rgb888::new(60, 210, 140),
        Rgb888::new(250, 220, 80),
        Rgb888::new(255, 120, 60),
    ];
    // 1024 units from stop to stop, the middle one at rest.
    let level = (i32::from(height) + 2048).clamp(0, 4095);
    let (stop, part) = (level as usize / 1024, level % 1024);
    let mix = |of: fn(&Rgb888) -> u8| {
        let [a, b] = [stop, stop + 1].map(|i| i32::from(of(&STOPS[i])));
        (a + (b - a) * part / 1024) as u8
    };
    Rgb888::new(mix(Rgb888::r), mix(Rgb888::g), mix(Rgb888::b))
}
