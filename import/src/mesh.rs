use crate::weld::weld;
use crate::{Problem, Triangles};
use pinhole::{Mesh, MeshError};
use std::collections::HashMap;

/// A mesh as `pinhole` draws it, owned, with what is known of its making.
///
/// A position in model units is `vertex * 2^exponent + offset`.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedMesh {
    /// The vertices, each position once, within ±32767.
    pub vertices: Vec<[i16; 3]>,
    /// The power of two that is the step of the vertices, in model units.
    pub exponent: i8,
    /// The triangles, counter-clockwise seen from outside if they are so in the file.
    pub faces: Vec<[u16; 3]>,
    /// The edges, each once, the lower index first, in ascending order.
    pub edges: Vec<[u16; 2]>,
    /// The unit normal of each face, 32767 = 1, computed from the quantised vertices; it points to where the face is
    /// seen counter-clockwise.
    pub normals: Vec<[i16; 3]>,
    /// The centre of the model's bounding box, in model units, which was subtracted from all vertices. Where `I16F16`
    /// can hold it, it is rounded to that (see [`quantise`]).
    pub offset: [f64; 3],
    /// What was done to the model.
    pub report: Report,
}

/// What importing a model did to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Vertices that the file's faces name.
    pub vertices_read: usize,
    /// Triangles of the file, after polygons were cut into triangles.
    pub faces_read: usize,
    /// Vertices dropped because they stood exactly where another one stands.
    pub welded: usize,
    /// Vertices dropped because quantising put them where another one stands.
    pub welded_by_quantising: usize,
    /// Faces dropped because their corners are fewer than three positions, or lie on a line.
    pub degenerate: usize,
    /// Faces dropped because the same face, with the same winding, is there already.
    pub duplicate: usize,
    /// Vertices dropped because only dropped faces named them.
    pub unused: usize,
    /// The longest side of the bounding box, in model units.
    pub extent: f64,
    /// The largest error of a coordinate by quantising, in model units; at most `extent / 65000`.
    pub error: f64,
}

/// How the faces hang together: an edge belongs to two faces that run along it in opposite directions where a surface is
/// closed and oriented.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Topology {
    /// Edges of one face: the rim of a hole.
    pub open: usize,
    /// Edges of three and more faces.
    pub crowded: usize,
    /// Edges along which two faces run in the same direction: one of them is seen from its back.
    pub twisted: usize,
}

impl ImportedMesh {
    /// The mesh, borrowed.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if the exponent is beyond what a mesh may have (a model that is very large or very small in its
    /// units), or if the fields were changed to something that is no mesh.
    pub fn mesh(&self) -> Result<Mesh<'_>, MeshError> {
        Mesh::new(&self.vertices, self.exponent, &self.faces)?
            .with_edges(&self.edges)?
            .with_normals(&self.normals)
    }

    /// Counts the edges at which the surface is not closed or not oriented.
    pub fn topology(&self) -> Topology {
        let mut topology = Topology::default();
        for (forward, backward) in edge_uses(&self.faces).into_values() {
            match (forward, backward) {
                (1, 1) => {}
                (1, 0) | (0, 1) => topology.open += 1,
                (2, 0) | (0, 2) => topology.twisted += 1,
                _ => topology.crowded += 1,
            }
        }
        topology
    }

    /// The volume that the faces enclose, in model units: positive if a closed surface is counter-clockwise seen from
    /// outside, negative if it is turned inside out.
    pub fn volume(&self) -> f64 {
        let corner = |i: u16| self.vertices[usize::from(i)].map(i128::from);
        let six_volumes = |&[a, b, c]: &[u16; 3]| {
            let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) = (corner(a), corner(b), corner(c));
            ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        };
        let sum: i128 = self.faces.iter().map(six_volumes).sum();
        sum as f64 / 6.0 * power_of_two(self.exponent).powi(3)
    }
}

/// Makes a mesh of triangles: welds, centres, quantises, derives edges and normals.
///
/// **Error.** Let E be the largest extent and h = E/2 the largest distance of a coordinate from the centre. The exponent
/// is the least with `round(h / 2^exponent) <= 32767`, so one less would have given `h / 2^(exponent-1) >= 32767.5`, that
/// is `2^exponent <= 2h / 32767.5 = E / 32767.5`. Rounding errs by half a step: **E / 65535 for each coordinate**. The
/// centre is first rounded to 2⁻¹⁶ model units, so that an `I16F16` holds exactly what was subtracted; that moves it by
/// at most 2⁻¹⁷ and makes h larger by as much. It is only done where E ≥ 2⁻⁶: the error stays below
/// `(E + 2⁻¹⁶) / 65535 <= E / 65471`, less than E / 65000. (All this up to the 53 bits of `f64`.)
///
/// # Errors
///
/// [`Problem::NotFinite`], [`Problem::NoFaces`], [`Problem::NoSuchVertex`], [`Problem::TooManyVertices`],
/// [`Problem::Extent`].
pub fn quantise(model: &Triangles) -> Result<ImportedMesh, Problem> {
    let vertices_read = model.positions.len();
    if model.faces.iter().flatten().any(|&i| i >= vertices_read) {
        return Err(Problem::NoSuchVertex);
    }
    if model.positions.iter().flatten().any(|c| !c.is_finite()) {
        return Err(Problem::NotFinite);
    }
    // Adding 0.0 makes one of the two zeros.
    let bits: Vec<_> = model.positions.iter().map(|p| p.map(|c| (c + 0.0).to_bits())).collect();
    let exact = weld(&bits, &model.faces, |_| false);
    let positions: Vec<[f64; 3]> = exact.vertices.iter().map(|&v| model.positions[v]).collect();

    let grid = Grid::around(&positions)?;
    let rounded: Vec<[i16; 3]> = positions.iter().map(|p| grid.round(p)).collect();
    let last = weld(&rounded, &exact.faces, |corners| cross(corners) == [0, 0, 0]);
    if last.faces.is_empty() {
        return Err(Problem::NoFaces);
    }
    if last.vertices.len() > 1 << 16 {
        return Err(Problem::TooManyVertices(last.vertices.len()));
    }

    let error = positions.iter().zip(&rounded).map(|(p, r)| grid.error(p, r)).fold(0.0, f64::max);
    let vertices: Vec<[i16; 3]> = last.vertices.iter().map(|&v| rounded[v]).collect();
    // In range: there are at most 65536 vertices.
    let faces: Vec<[u16; 3]> = last.faces.iter().map(|f| f.map(|i| i as u16)).collect();
    let mut edges: Vec<[u16; 2]> = edge_uses(&faces).into_keys().collect();
    edges.sort_unstable();
    let normals = faces.iter().map(|f| unit(cross(f.map(|i| vertices[usize::from(i)])))).collect();
    Ok(ImportedMesh {
        vertices,
        exponent: grid.exponent,
        faces,
        edges,
        normals,
        offset: grid.centre,
        report: Report {
            vertices_read,
            faces_read: model.faces.len(),
            welded: exact.welded,
            welded_by_quantising: last.welded,
            degenerate: exact.degenerate + last.degenerate,
            duplicate: exact.duplicate + last.duplicate,
            unused: exact.unused + last.unused,
            extent: grid.extent,
            error,
        },
    })
}

/// The grid onto which a model is rounded.
struct Grid {
    extent: f64,
    centre: [f64; 3],
    exponent: i8,
    /// `2^exponent`.
    step: f64,
}

impl Grid {
    fn around(positions: &[[f64; 3]]) -> Result<Grid, Problem> {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for p in positions {
            for axis in 0..3 {
                low[axis] = low[axis].min(p[axis]);
                high[axis] = high[axis].max(p[axis]);
            }
        }
        let extent = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
        if extent == 0.0 {
            return Err(Problem::NoFaces);
        }
        let mut centre = [0, 1, 2].map(|axis| low[axis] / 2.0 + high[axis] / 2.0);
        if extent >= 1.0 / 64.0 && centre.iter().all(|c| c.abs() < 32767.0) {
            centre = centre.map(|c| (c * 65536.0).round() / 65536.0);
        }
        let half =
            (0..3).map(|axis| (high[axis] - centre[axis]).max(centre[axis] - low[axis])).fold(0.0, f64::max);
        let exponent = (i8::MIN..=i8::MAX)
            .find(|&e| (half / power_of_two(e)).round() <= 32767.0)
            .filter(|&e| e > i8::MIN)
            .ok_or(Problem::Extent(extent))?;
        Ok(Grid { extent, centre, exponent, step: power_of_two(exponent) })
    }

    /// The nearest grid point. Every difference fits ±32767 by the choice of the exponent.
    fn round(&self, position: &[f64; 3]) -> [i16; 3] {
        [0, 1, 2].map(|axis| ((position[axis] - self.centre[axis]) / self.step).round() as i16)
    }

    /// The largest distance along an axis between a position and its grid point.
    fn error(&self, position: &[f64; 3], rounded: &[i16; 3]) -> f64 {
        (0..3)
            .map(|axis| position[axis] - self.centre[axis] - f64::from(rounded[axis]) * self.step)
            .fold(0.0, |largest, e| e.abs().max(largest))
    }
}

/// `2^exponent`, exactly.
fn power_of_two(exponent: i8) -> f64 {
    2f64.powi(i32::from(exponent))
}

/// For each undirected edge, the lower index first, how many faces run along it upwards and how many downwards.
fn edge_uses(faces: &[[u16; 3]]) -> HashMap<[u16; 2], (usize, usize)> {
    let mut uses = HashMap::with_capacity(faces.len() * 3 / 2);
    for &[a, b, c] in faces {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let (up, down) = uses.entry([from.min(to), from.max(to)]).or_insert((0, 0));
            *if from < to { up } else { down } += 1;
        }
    }
    uses
}

/// `(b − a) × (c − a)`, exactly: differences have 17 bits, products 34.
fn cross([a, b, c]: [[i16; 3]; 3]) -> [i64; 3] {
    let d = |p: [i16; 3], axis: usize| i64::from(p[axis]) - i64::from(a[axis]);
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| d(b, i) * d(c, j) - d(b, j) * d(c, i))
}

/// The direction of a vector that is not zero, 32767 = 1.
fn unit(vector: [i64; 3]) -> [i16; 3] {
    let vector = vector.map(|c| c as f64);
    let length = vector.iter().map(|c| c * c).sum::<f64>().sqrt();
    vector.map(|c| (c / length * 32767.0).round() as i16)
}
