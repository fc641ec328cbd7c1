//! Makes constants of the models of `scenes.json` and `growth.json`: vertices of 16 bits in a power-of-two unit, and what follows from
//! the faces; the lists of lines and triangles that lie in the picture's plane; and the cases of growth.

mod meshes;

use pinhole::Mesh;
use serde::Deserialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

#[derive(Deserialize)]
struct Scenes {
    light: [f64; 3],
    models: BTreeMap<String, Model>,
    lines: Vec<[i16; 4]>,
    tris2d: Vec<[i64; 7]>,
    full_screen_triangle: [i16; 6],
}

#[derive(Deserialize)]
struct Model {
    vertices: Vec<[f64; 3]>,
    faces: Vec<[u16; 3]>,
    edges: Vec<[u16; 2]>,
    model_rotation: [[f64; 3]; 3],
    distance: f64,
}

#[derive(Deserialize)]
struct Growth {
    /// Name, kind, and one or two numbers of parts.
    shapes: Vec<(String, String, [u16; 2])>,
    /// The fields of each, as Rust has them but for names of shapes and of `Cull`.
    cases: Vec<BTreeMap<String, Value>>,
}

fn main() -> Result<()> {
    let here = std::path::PathBuf::from(std::env::var("CARGO_MANIFEST_DIR")?);
    for file in ["scenes.json", "growth.json", "build.rs", "meshes.rs"] {
        println!("cargo::rerun-if-changed={file}");
    }
    let scenes: Scenes = serde_json::from_str(&std::fs::read_to_string("scenes.json")?)?;
    let growth: Growth = serde_json::from_str(&std::fs::read_to_string("growth.json")?)?;
    let out = std::env::var("OUT_DIR")?;
    std::fs::write(format!("{out}/models.rs"), models(&scenes)?)?;
    std::fs::write(format!("{out}/lists.rs"), lists(&scenes)?)?;
    std::fs::write(format!("{out}/shapes.rs"), shapes(&scenes, &growth)?)?;
    // The memory.x of Arm's board.
    println!("cargo::rustc-link-search={}/board", here.display());
    // The memory.x of RISC-V's board; the flag that names it is in the root's configuration.
    let root = here.ancestors().nth(2).ok_or("the project's root")?;
    println!("cargo::rustc-link-search={}", root.display());
    Ok(())
}

fn models(scenes: &Scenes) -> Result<String> {
    let mut text = format!("pub(crate) const LIGHT: [i32; 3] = {:?};\n", bits(scenes.light));
    for (name, model) in &scenes.models {
        let Model { vertices, faces, edges, model_rotation, distance } = model;
        let name = name.to_uppercase();
        let (k, vertices) = quantised(vertices)?;
        let normals = normals(&vertices, faces);
        let mesh = Mesh::new(&vertices, -i8::try_from(k)?, faces)?.with_normals(&normals)?;
        let planes: Vec<i16> = (0..faces.len()).map(|face| mesh.face_plane(face)).collect();
        // Columns: the images of the axes.
        let axes = [0, 1, 2].map(|i| bits(model_rotation.map(|row| row[i])));
        let [distance, ..] = bits([*distance, 0.0, 0.0]);
        write!(text, "pub static {name}: Model = Model {{ axes: {axes:?}, distance: {distance}, ")?;
        writeln!(text, "mesh: mesh(&{vertices:?}, -{k}, &{faces:?}, &{normals:?}, &{edges:?}) }};")?;
        writeln!(text, "pub static {name}_BY_PLANES: Model = by_planes(&{name}, &{planes:?});")?;
    }
    Ok(text)
}

/// The vertices in the finest unit 2^−k in which all fit 16 bits, and k.
fn quantised(vertices: &[[f64; 3]]) -> Result<(u32, Vec<[i16; 3]>)> {
    let largest = vertices.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs()));
    let k = (0..31).rev().find(|&k| largest * f64::from(1u32 << k) <= 32767.0).ok_or("too large")?;
    Ok((k, vertices.iter().map(|v| v.map(|c| (c * f64::from(1u32 << k)).round() as i16)).collect()))
}

fn normals(vertices: &[[i16; 3]], faces: &[[u16; 3]]) -> Vec<[i16; 3]> {
    let corner = |i: u16| vertices[usize::from(i)].map(f64::from);
    faces.iter().map(|face| unit(normal(face.map(corner)))).collect()
}

/// Meshes of all sizes, and those of the scenes, with the faces beside their edges; and the cases that show them.
fn shapes(scenes: &Scenes, growth: &Growth) -> Result<String> {
    let mut text = String::new();
    let mut add = |name: &str, vertices: &[[f64; 3]], edges: &[[u16; 2]], faces: &[[u16; 3]]| -> Result<()> {
        let (k, vertices) = quantised(vertices)?;
        let (normals, beside) = (normals(&vertices, faces), beside(edges, faces));
        write!(text, "static {name}: Shape = Shape {{ exponent: -{k}, vertices: &{vertices:?}, ")?;
        write!(text, "faces: &{faces:?}, normals: &{normals:?}, ")?;
        Ok(writeln!(text, "edges: &{edges:?}, beside: &{beside:?} }};")?)
    };
    for (name, kind, [m, n]) in &growth.shapes {
        let (vertices, faces) = match kind.as_str() {
            "torus" => meshes::torus(*m, *n),
            "sphere" => meshes::sphere(*m, *n),
            "sheet" => meshes::sheet(*m),
            _ => return Err(format!("growth.json: {kind}").into()),
        };
        add(name, &vertices, &edges_of(&faces), &faces)?;
    }
    for (name, Model { vertices, edges, faces, .. }) in &scenes.models {
        let edges = if edges.is_empty() { &edges_of(faces) } else { edges };
        add(&name.to_uppercase(), vertices, edges, faces)?;
    }
    writeln!(text, "pub const CASES: &[Case] = &[")?;
    for case in &growth.cases {
        let field = |(name, value): (&String, &Value)| match (name.as_str(), value.as_str()) {
            ("shape", Some(shape)) => format!("shape: &{shape}"),
            ("cull", Some(cull)) => format!("cull: Cull::{cull}"),
            _ => format!("{name}: {value}"),
        };
        writeln!(text, "Case {{ {} }},", case.iter().map(field).collect::<Vec<_>>().join(", "))?;
    }
    Ok(text + "];")
}

/// The two faces beside each edge, or [`Mesh::NO_FACE`].
fn beside(edges: &[[u16; 2]], faces: &[[u16; 3]]) -> Vec<[u16; 2]> {
    let mut found: BTreeMap<[u16; 2], Vec<u16>> = BTreeMap::new();
    for (face, &[a, b, c]) in (0..).zip(faces) {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            found.entry([from.min(to), from.max(to)]).or_default().push(face);
        }
    }
    let of_edge = |&[from, to]: &[u16; 2]| {
        let faces = found.get(&[from.min(to), from.max(to)]);
        [0, 1].map(|at| faces.and_then(|faces| faces.get(at)).copied().unwrap_or(<Mesh<'_>>::NO_FACE))
    };
    edges.iter().map(of_edge).collect()
}

/// The torus's vertex normals and edges, and the lists of 2D lines and triangles.
fn lists(scenes: &Scenes) -> Result<String> {
    let torus = scenes.models.get("torus").ok_or("no torus")?;
    let normals = torus.vertices.iter().map(|&vertex| torus_normal(vertex).map(unit));
    let normals: Vec<[i16; 3]> = normals.collect::<Result<_>>()?;
    let (edges, lines, screen) = (edges_of(&torus.faces), &scenes.lines, &scenes.full_screen_triangle);
    let corners: Vec<_> = scenes.tris2d.iter().map(|t| &t[..6]).collect();
    let colours: Vec<_> = scenes.tris2d.iter().map(|t| t[6]).collect();
    let [normal_count, edge_count, line_count, triangle_count] =
        [normals.len(), edges.len(), lines.len(), corners.len()];
    Ok(format!(
        "pub static TORUS_NORMALS: [[i16; 3]; {normal_count}] = {normals:?};\n\
         pub static TORUS_EDGES: [[u16; 2]; {edge_count}] = {edges:?};\n\
         pub static LINES: [[i16; 4]; {line_count}] = {lines:?};\n\
         pub static TRIANGLES: [[i16; 6]; {triangle_count}] = {corners:?};\n\
         pub static COLOURS: [u16; {triangle_count}] = {colours:?};\n\
         pub static SCREEN: [i16; 6] = {screen:?};\n"
    ))
}

/// A unit normal in 2⁻¹⁵.
fn unit(normal: [f64; 3]) -> [i16; 3] {
    normal.map(|c| (c * 32767.0).round() as i16)
}

/// A vector in 2⁻¹⁶.
fn bits(v: [f64; 3]) -> [i32; 3] {
    v.map(|c| (c * 65536.0).round() as i32)
}

/// The unit normal of the torus: away from the circle of radius 1 about z, the centre line of the tube.
fn torus_normal([x, y, z]: [f64; 3]) -> Result<[f64; 3]> {
    let from_axis = x.hypot(y);
    let away = [x - x / from_axis, y - y / from_axis, z];
    let length = away.iter().map(|c| c * c).sum::<f64>().sqrt();
    if (length - 0.42).abs() > 1e-6 {
        return Err("the torus's tube has a radius of 0.42".into());
    }
    Ok(away.map(|c| c / length))
}

/// The unit normal of a counter-clockwise face.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let side = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let (u, v) = (side(b), side(c));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
    n.map(|c| c / length)
}

/// All edges of the faces, each once.
fn edges_of(faces: &[[u16; 3]]) -> Vec<[u16; 2]> {
    let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: BTreeSet<_> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.into_iter().collect()
}
