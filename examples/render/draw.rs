//! From a scene in the crate's formats to pictures.

use crate::canvas::Canvas;
use crate::quantised::Quantised;
use crate::scene::Scene;
use embedded_graphics::pixelcolor::raw::RawU32;
use embedded_graphics::pixelcolor::{PixelColor, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{Corner, Cull, DepthBuffer, Dim, Lambert, Mesh, Scalar, Statistics, Vector3};
use std::collections::{BTreeMap, HashMap};

const BACKGROUND: Rgb888 = Rgb888::new(12, 18, 26);
const CLAY: Rgb888 = Rgb888::new(248, 178, 112);
const WIRE: Rgb888 = Rgb888::new(116, 226, 252);
/// The light that is everywhere; of 256.
const AMBIENT: u16 = 56;
/// Towards the light, in view coordinates: from the left, above, behind the camera.
const LIGHT: [f64; 3] = [-0.45, 0.6, 0.66];

/// The colour of a pixel is the triangle seen in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Seen(u32);

impl PixelColor for Seen {
    type Raw = RawU32;
}

impl Seen {
    const NONE: Self = Self(u32::MAX);

    /// -1 for none.
    pub(crate) fn index(self) -> i32 {
        self.0 as i32 // a scene of 2^31 triangles has no room in memory
    }
}

/// A part of the mesh whose vertices and faces 16-bit numbers can name.
struct Part {
    vertices: Vec<[Scalar; 3]>,
    faces: Vec<[u16; 3]>,
    /// The number of its first triangle.
    first: usize,
}

impl Part {
    /// The sides of the faces, each once, or once for every two of the faces beside it; with those.
    fn edges(&self) -> Vec<([u16; 2], [u16; 2])> {
        let mut edges = BTreeMap::<[u16; 2], Vec<u16>>::new();
        for (number, &[a, b, c]) in self.faces.iter().enumerate() {
            for [a, b] in [[a, b], [b, c], [c, a]] {
                edges.entry([a.min(b), a.max(b)]).or_default().push(number as u16);
                // see MOST_FACES
            }
        }
        let pair = |faces: &[u16]| [0, 1].map(|i| faces.get(i).copied().unwrap_or(Mesh::<Scalar>::NO_FACE));
        edges.iter().flat_map(|(edge, faces)| faces.chunks(2).map(|two| (*edge, pair(two)))).collect()
    }
}

const MOST: usize = 65_536;
const MOST_FACES: usize = 65_535;

/// The mesh in parts. A format is chosen for each mesh by its largest coordinate: all parts get the
/// vertex that has it, so that what they share lands on the same place.
fn parts(vertices: &[[Scalar; 3]], triangles: &[[usize; 3]]) -> Vec<Part> {
    let largest =
        vertices.iter().max_by_key(|v| v.map(|c| c.to_bits() ^ (c.to_bits() >> 31)).into_iter().max());
    let empty = |first| Part { vertices: largest.copied().into_iter().collect(), faces: Vec::new(), first };
    let mut parts = Vec::new();
    let (mut part, mut places) = (empty(0), HashMap::new());
    for (number, triangle) in triangles.iter().enumerate() {
        if part.vertices.len() + 3 > MOST || part.faces.len() == MOST_FACES {
            parts.push(std::mem::replace(&mut part, empty(number)));
            places.clear();
        }
        part.faces.push(triangle.map(|index| {
            *places.entry(index).or_insert_with(|| {
                part.vertices.push(vertices[index]);
                (part.vertices.len() - 1) as u16 // at most MOST
            })
        }));
    }
    parts.push(part);
    parts
}

pub(crate) struct Solid {
    pub(crate) ids: Canvas<Seen>,
    pub(crate) depth: Vec<u16>,
    pub(crate) statistics: Statistics,
}

/// All triangles, depth-tested.
pub(crate) fn solid(scene: &Scene, quantised: &Quantised) -> Result<Solid, String> {
    let size = Size::new(scene.width, scene.height);
    let mut ids = Canvas::new(size, Seen::NONE);
    let mut storage = vec![0; ids.pixels().len()];
    let mut depth =
        DepthBuffer::new(Rectangle::new(Point::zero(), size), &mut storage).map_err(|e| e.to_string())?;
    let cull = if scene.cull { Cull::Back } else { Cull::None };
    let camera = quantised.camera();
    let mut statistics = Statistics::default();
    for part in parts(&quantised.vertices, &scene.triangles) {
        let mesh = Mesh::from_fixed(&part.vertices, &part.faces).map_err(|e| e.to_string())?;
        let mut corners = vec![Corner::EMPTY; part.vertices.len()];
        let id = |face: usize| Seen((part.first + face) as u32);
        let placed = camera.place(&mesh, &quantised.model).with_cull(cull);
        let Ok(drawn) = placed.depth_tested(id, &mut corners, &mut depth, &mut ids);
        statistics = statistics.and(drawn);
    }
    Ok(Solid { ids, depth: storage, statistics })
}

/// The edges, each once; those that triangles hide only where asked.
pub(crate) fn edges(
    scene: &Scene,
    quantised: &Quantised,
    less_hidden: bool,
) -> Result<(Vec<Rgb888>, Statistics), String> {
    let size = Size::new(scene.width, scene.height);
    let mut picture = Canvas::new(size, BACKGROUND);
    let mut storage = vec![0; if less_hidden { picture.pixels().len() } else { 0 }];
    let area = Rectangle::new(Point::zero(), if less_hidden { size } else { Size::zero() });
    let mut depth = DepthBuffer::new(area, &mut storage).map_err(|e| e.to_string())?;
    let cull = if scene.cull { Cull::Back } else { Cull::None };
    let camera = quantised.camera();
    let parts = parts(&quantised.vertices, &scene.triangles);
    let mut corners = vec![Corner::EMPTY; parts.iter().map(|p| p.vertices.len()).max().unwrap_or(0)];
    if less_hidden {
        // Every part may hide any other.
        for part in &parts {
            let mesh = Mesh::from_fixed(&part.vertices, &part.faces).map_err(|e| e.to_string())?;
            camera.place(&mesh, &quantised.model).with_cull(cull).depth_only(&mut corners, &mut depth);
        }
    }
    let mut statistics = Statistics::default();
    for part in &parts {
        let (edges, beside): (Vec<_>, Vec<_>) = part.edges().into_iter().unzip();
        let mesh = Mesh::from_fixed(&part.vertices, &part.faces)
            .and_then(|mesh| mesh.with_edges(&edges))
            .and_then(|mesh| mesh.with_edge_faces(&beside))
            .map_err(|e| e.to_string())?;
        let placed = camera.place(&mesh, &quantised.model).with_cull(cull);
        let Ok(drawn) = if less_hidden {
            placed.hidden_line(WIRE, &mut corners, &mut depth, &mut picture)
        } else {
            placed.wireframe(WIRE, &mut corners, &mut picture)
        };
        statistics = statistics.and(drawn);
    }
    Ok((picture.pixels().to_vec(), statistics))
}

/// The triangles seen, in their light; both sides alike.
pub(crate) fn shaded(scene: &Scene, quantised: &Quantised, ids: &[Seen]) -> Vec<Rgb888> {
    let [u, v, n, _] = scene.view;
    let towards = [0, 1, 2].map(|i| (u[i] * LIGHT[0] + v[i] * LIGHT[1] + n[i] * LIGHT[2]) as f32);
    let [x, y, z] = towards;
    let light = Vector3::from_f32(x, y, z).ok().and_then(|l| Lambert::new(&quantised.model, l, AMBIENT).ok());
    let colour = |triangle: &[usize; 3]| {
        // A model that flattens the mesh has no light.
        let Some(light) = &light else { return CLAY };
        let normal = normal(triangle.map(|i| scene.vertices[i]));
        CLAY.dim(light.level(normal).max(light.level(normal.map(|c| -c))))
    };
    let colours: Vec<_> = scene.triangles.iter().map(colour).collect();
    ids.iter().map(|seen| colours.get(seen.0 as usize).copied().unwrap_or(BACKGROUND)).collect()
}

/// The unit normal in 2⁻¹⁵; zero for a triangle without area.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [i16; 3] {
    let (p, q) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
    let normal = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| p[i] * q[j] - p[j] * q[i]);
    let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
    normal.map(|c| if length > 0.0 { (c / length * 32_767.0).round() as i16 } else { 0 })
}
