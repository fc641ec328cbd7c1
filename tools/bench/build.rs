//! Makes the models of `scenes.json` into constants: vertices of 16 bits in a power-of-two unit, and what follows from
//! the faces; and the lists of lines and triangles that lie in the picture's plane.

mod meshes;

use pinhole::Mesh;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{Debug, Write};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    println!("cargo::rerun-if-changed=scenes.json");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=meshes.rs");
    let scenes: Value = serde_json::from_str(&std::fs::read_to_string("scenes.json")?)?;
    let mut text = format!("pub(crate) const LIGHT: [i32; 3] = {:?};\n", bits(&triple(&scenes["light"])?));
    for name in ["cube", "torus", "ico"] {
        write_model(&mut text, &name.to_uppercase(), &scenes["models"][name])?;
    }
    let out = std::env::var("OUT_DIR")?;
    std::fs::write(format!("{out}/models.rs"), text)?;
    std::fs::write(format!("{out}/lists.rs"), lists(&scenes)?)?;
    std::fs::write(format!("{out}/shapes.rs"), shapes(&scenes)?)?;
    // The memory.x of Arm's board.
    println!("cargo::rustc-link-search={}/board", env!("CARGO_MANIFEST_DIR"));
    // The memory.x of RISC-V's board; the flag that names it is in the root's configuration.
    let here = std::path::PathBuf::from(std::env::var("CARGO_MANIFEST_DIR")?);
    let root = here.ancestors().nth(2).ok_or("the project's root")?;
    println!("cargo::rustc-link-search={}", root.display());
    Ok(())
}

fn write_model(text: &mut String, name: &str, model: &Value) -> Result<()> {
    let faces = list(&model["faces"], indices::<3>)?;
    let (k, vertices) = quantised(&list(&model["vertices"], triple)?)?;
    let normals = normals(&vertices, &faces);
    let edges = list(&model["edges"], indices::<2>)?;
    let [x, y, z] = {
        let rows = list(&model["model_rotation"], triple)?;
        let [x, y, z] = rows.as_slice() else { return Err("three rows".into()) };
        // Columns: the images of the axes.
        [0, 1, 2].map(|i| bits(&[x[i], y[i], z[i]]))
    };
    let distance = bits(&[number(&model["distance"])?, 0.0, 0.0])[0];
    let planes = planes(&vertices, k, &faces, &normals)?;
    writeln!(text, "pub static {name}: Model = Model {{")?;
    writeln!(
        text,
        "mesh: mesh({}, -{k}, {}, {}, {}),",
        slice(&vertices),
        slice(&faces),
        slice(&normals),
        slice(&edges)
    )?;
    writeln!(text, "axes: {:?}, distance: {distance} }};", [x, y, z])?;
    writeln!(
        text,
        "pub static {name}_BY_PLANES: Model<WithPlanes> = by_planes(&{name}, {});",
        slice(&planes)
    )?;
    Ok(())
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

fn planes(vertices: &[[i16; 3]], k: u32, faces: &[[u16; 3]], normals: &[[i16; 3]]) -> Result<Vec<i16>> {
    let mesh = Mesh::new(vertices, -i8::try_from(k)?, faces)?.with_normals(normals)?;
    Ok((0..faces.len()).map(|face| mesh.face_plane(face)).collect())
}

/// Meshes of all sizes, and those of the scenes with the faces beside their edges.
fn shapes(scenes: &Value) -> Result<String> {
    let mut text = String::new();
    let made = [
        ("TORUS_24", meshes::torus(4, 3)),
        ("TORUS_96", meshes::torus(8, 6)),
        ("TORUS_320", meshes::torus(16, 10)),
        ("TORUS_1024", meshes::torus(32, 16)),
        ("TORUS_4096", meshes::torus(64, 32)),
        ("TORUS_20000", meshes::torus(125, 80)),
        ("SPHERE_10", meshes::sphere(5, 2)),
        ("SPHERE_224", meshes::sphere(16, 8)),
        ("SPHERE_720", meshes::sphere(24, 16)),
        ("SHEET_800", meshes::sheet(20)),
        ("SHEET_3200", meshes::sheet(40)),
    ];
    let mut shapes: Vec<_> =
        made.into_iter().map(|(name, (vertices, faces))| (name, vertices, edges_of(&faces), faces)).collect();
    for (name, model) in [("S2_CUBE", "cube"), ("S3_TORUS", "torus"), ("S4_ICO", "ico")] {
        let model = &scenes["models"][model];
        let (edges, faces) = (list(&model["edges"], indices::<2>)?, list(&model["faces"], indices::<3>)?);
        let edges = if edges.is_empty() { edges_of(&faces) } else { edges };
        shapes.push((name, list(&model["vertices"], triple)?, edges, faces));
    }
    for (name, vertices, edges, faces) in shapes {
        let (k, vertices) = quantised(&vertices)?;
        let normals = normals(&vertices, &faces);
        let beside = beside(&edges, &faces);
        writeln!(
            text,
            "pub(super) static {name}: Shape = Shape {{ exponent: -{k}, vertices: &{vertices:?}, faces: &{faces:?},"
        )?;
        writeln!(text, "normals: &{normals:?}, edges: &{edges:?}, beside: &{beside:?} }};")?;
    }
    Ok(text)
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
fn lists(scenes: &Value) -> Result<String> {
    let normals = list(&scenes["models"]["torus"]["vertices"], triple)?.into_iter().map(torus_normal);
    let normals: Vec<[i16; 3]> = normals.map(|normal| normal.map(unit)).collect::<Result<_>>()?;
    let edges = edges_of(&list(&scenes["models"]["torus"]["faces"], indices::<3>)?);
    let lines = list(&scenes["lines"], integers::<4>)?;
    let triangles = list(&scenes["tris2d"], integers::<7>)?;
    let corners: Vec<_> = triangles.iter().map(|t| &t[..6]).collect();
    let colours: Vec<_> = triangles.iter().map(|t| t[6]).collect();
    let screen = integers::<6>(&scenes["full_screen_triangle"])?;
    let [normal_count, edge_count, line_count, triangle_count] =
        [normals.len(), edges.len(), lines.len(), triangles.len()];
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

fn slice(list: &[impl Debug]) -> String {
    format!("&{list:?}")
}

/// A vector in 2⁻¹⁶.
fn bits(v: &[f64; 3]) -> [i32; 3] {
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

fn list<T>(value: &Value, item: fn(&Value) -> Result<T>) -> Result<Vec<T>> {
    value.as_array().ok_or("a list")?.iter().map(item).collect()
}

fn number(value: &Value) -> Result<f64> {
    Ok(value.as_f64().ok_or("a number")?)
}

fn triple(value: &Value) -> Result<[f64; 3]> {
    <[f64; 3]>::try_from(list(value, number)?).map_err(|_| "three numbers".into())
}

fn integers<const N: usize>(value: &Value) -> Result<[i64; N]> {
    let integer = |value: &Value| Ok(value.as_i64().ok_or("an integer")?);
    <[i64; N]>::try_from(list(value, integer)?).map_err(|_| "another number of integers".into())
}

fn indices<const N: usize>(value: &Value) -> Result<[u16; N]> {
    let index = |value: &Value| Ok(u16::try_from(value.as_u64().ok_or("an index")?)?);
    <[u16; N]>::try_from(list(value, index)?).map_err(|_| "another number of corners".into())
}
