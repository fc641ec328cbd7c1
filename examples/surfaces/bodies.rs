//! The bodies of the sheet, and the picture of a ball.

use embedded_graphics::pixelcolor::Rgb888;
use pinhole::{mesh::MeshError, Mesh};
use std::f64::consts::TAU;

/// The lists of a mesh, with a normal and texture coordinates, in 1/16 texel, for each vertex.
pub(crate) struct Body {
    pub(crate) vertices: Vec<[i16; 3]>,
    pub(crate) normals: Vec<[i16; 3]>,
    pub(crate) uv: Vec<[i16; 2]>,
    pub(crate) faces: Vec<[u16; 3]>,
    /// The exponent of the vertices' unit.
    exponent: i8,
}

impl Body {
    pub(crate) fn mesh(&self) -> Result<Mesh<'_>, MeshError> {
        Mesh::new(&self.vertices, self.exponent, &self.faces)
    }

    /// The two triangles of each field of a grid of vertices, `across` + 1 to a row, counter-clockwise if the next row is to the
    /// right of the next vertex.
    fn grid(mut self, rows: usize, across: usize) -> Self {
        let at = |row: usize, column: usize| (row * (across + 1) + column) as u16; // below 2¹⁶
        for (row, column) in (0..rows).flat_map(|row| (0..across).map(move |column| (row, column))) {
            let [a, b] = [at(row, column), at(row, column + 1)];
            let [c, d] = [at(row + 1, column + 1), at(row + 1, column)];
            self.faces.extend([[a, c, b], [a, d, c]]);
        }
        self
    }

    fn empty(exponent: i8) -> Self {
        Self { vertices: Vec::new(), normals: Vec::new(), uv: Vec::new(), faces: Vec::new(), exponent }
    }
}

/// A tube of radius 0.34 around a circle of radius 0.72 about the y axis. Bricks of 64 texels go six times around it, and twice
/// around the tube; the vertices of the seam are there twice.
pub(crate) fn torus(around: usize, across: usize) -> Body {
    let mut body = Body::empty(-14);
    for (i, j) in (0..=around).flat_map(|i| (0..=across).map(move |j| (i, j))) {
        let [(si, ci), (sj, cj)] =
            [(i, around), (j, across)].map(|(i, n)| (TAU * i as f64 / n as f64).sin_cos());
        let normal = [ci * cj, sj, -si * cj];
        let middle = [0.72 * ci, 0.0, -0.72 * si];
        body.vertices.push([0, 1, 2].map(|k| ((middle[k] + 0.34 * normal[k]) * 16384.0).round() as i16));
        body.normals.push(normal.map(|c| (c * 32767.0).round() as i16));
        let part = |i: usize, n: usize, texels: f64| (i as f64 / n as f64 * texels * 16.0).round() as i16;
        body.uv.push([part(i, around, 384.0), part(j, across, -128.0)]);
    }
    body.grid(around, across)
}

/// A square floor y = 0 of `fields` × `fields`, from −`half` to `half`, with so many texels along each side.
pub(crate) fn floor(fields: usize, half: f64, texels: i32) -> Body {
    let mut body = Body::empty(-8);
    for (i, j) in (0..=fields).flat_map(|i| (0..=fields).map(move |j| (i, j))) {
        let [x, z] = [i, j].map(|i| 2.0 * i as f64 / fields as f64 - 1.0);
        body.vertices.push([x * half * 256.0, 0.0, -z * half * 256.0].map(|c| c.round() as i16));
        body.normals.push([0, 32_767, 0]);
        body.uv.push([x, -z].map(|c| (c * f64::from(texels) * 8.0).round() as i16));
    }
    body.grid(fields, fields)
}

/// The picture of a chrome ball: a bright sky, a dark horizon, and a warm ground.
pub(crate) fn ball() -> [[Rgb888; 64]; 64] {
    let mut texels = [[Rgb888::new(0, 0, 0); 64]; 64];
    for (row, line) in texels.iter_mut().enumerate() {
        for (column, texel) in line.iter_mut().enumerate() {
            let [x, y] = [column, 63 - row].map(|c| (c as f64 + 0.5) / 32.0 - 1.0);
            let away = (x * x + y * y).min(1.0);
            // The reflected ray's height: from −1 below to 1 above.
            let height = 2.0 * y * (1.0 - away).sqrt();
            let mix = |a: [f64; 3], b: [f64; 3], part: f64| [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part);
            let sky = mix([250.0, 250.0, 255.0], [60.0, 120.0, 210.0], height.clamp(0.0, 1.0));
            let ground = mix([46.0, 30.0, 24.0], [222.0, 176.0, 120.0], (-height).clamp(0.0, 1.0));
            let color = if height > 0.0 { sky } else { ground };
            let glint = (1.0 - ((x + 0.35).powi(2) + (y - 0.5).powi(2)) * 14.0).max(0.0);
            let [r, g, b] = mix(color, [255.0; 3], glint).map(|c| c.round() as u8);
            *texel = Rgb888::new(r, g, b);
        }
    }
    texels
}
