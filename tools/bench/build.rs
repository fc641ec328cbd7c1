//! Makes constants of the models of `scenes.json` and `growth.json`: vertices of 16 bits in a power-of-two unit, and what follows from
//! the faces; the lists of lines and triangles that lie in the picture's plane; and the cases of growth.

mod meshes;

use pinhole::Mesh;
use pinhole_import::{import_bytes, Centre, Options};
use serde::Deserialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{Debug, Write};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

#[derive(Deserialize)]
struct Scenes {
    light: [f64; 3],
    models: BTreeMap<String, Model>,
    /// Flat sides of meshes: a corner, the two sides of a field at it, and the numbers of fields along them.
    sided: BTreeMap<String, Vec<meshes::Side>>,
    lines: Vec<[i16; 4]>,
    tris2d: Vec<[i64; 7]>,
    full_screen_triangle: [i16; 6],
}

#[derive(Clone, Default, Deserialize)]
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
    let package = std::path::PathBuf::from(std::env::var("CARGO_MANIFEST_DIR")?);
    // `tools/scenes` has a manifest alone.
    let is_library = package.ends_with("scenes");
    let here = if is_library { package.join("../bench") } else { package };
    std::env::set_current_dir(&here)?;
    for file in ["build.rs", "meshes.rs", "scenes.json", "growth.json", "cells.json"] {
        println!("cargo::rerun-if-changed={}/{file}", here.display());
    }
    let (scenes, growth): (Scenes, Growth) = (read("scenes.json")?, read("growth.json")?);
    let out = std::env::var("OUT_DIR")?;
    std::fs::write(format!("{out}/models.rs"), models(&scenes)?)?;
    std::fs::write(format!("{out}/lists.rs"), lists(&scenes)?)?;
    std::fs::write(format!("{out}/shapes.rs"), shapes(&scenes, &growth)?)?;
    std::fs::write(format!("{out}/cells.rs"), cells(&read("cells.json")?))?;
    let version = std::process::Command::new(std::env::var("RUSTC")?).arg("--version").output()?.stdout;
    println!("cargo::rustc-env=BENCH_COMPILER={}", String::from_utf8(version)?.trim());
    if is_library {
        return Ok(());
    }
    // The memory.x of Arm's board.
    println!("cargo::rustc-link-search={}/board", here.display());
    // The memory.x of RISC-V's board; the flag that names it is in the root's configuration.
    let root = here.ancestors().nth(2).ok_or("the project's root")?;
    println!("cargo::rustc-link-search={}", root.display());
    Ok(())
}

fn read<T: serde::de::DeserializeOwned>(file: &str) -> Result<T> {
    Ok(serde_json::from_str(&std::fs::read_to_string(file)?)?)
}

/// Of groups of cells: scene, variant, memory and drawing, as Rust has them.
fn cells(groups: &BTreeMap<String, Vec<[String; 4]>>) -> String {
    let row = |[scene, variant, memory, draw]: &[String; 4]| {
        format!("{scene:?} {variant:?}: {memory}, |m| {draw};\n")
    };
    let rows: String = groups.values().flatten().map(row).collect();
    format!("cells! {{ {rows} }}")
}

fn models(scenes: &Scenes) -> Result<String> {
    let mut text = format!("pub(crate) const LIGHT: [i32; 3] = {:?};\n", bits(scenes.light));
    let mut models = scenes.models.clone();
    for (name, sides) in &scenes.sided {
        let (vertices, faces) = meshes::sided(sides);
        models.insert(name.clone(), Model { vertices, faces, ..Model::default() });
    }
    for (name, model) in &models {
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
        let mut add = |by: &str, mesh: String| {
            let mesh = format!("match {mesh} {{ Ok(mesh) => mesh, Err(_) => panic!() }}");
            writeln!(text, "pub static {name}_BY_{by}: Model = Model {{ mesh: {mesh}, ..{name} }};")
        };
        add("PLANES", format!("{name}.mesh.with_planes(&{planes:?})"))?;
        let mut obj: String = model.vertices.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
        obj.extend(faces.iter().map(|&[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1)));
        let options = Options { centre: Centre::Origin, clusters: true, ..Options::default() };
        let made = import_bytes(obj.into(), "model.obj".as_ref(), &[], &options)?;
        let (vertices, k, faces, normals) = (made.vertices, made.exponent, made.faces, made.normals);
        let mesh = format!("mesh(&{vertices:?}, {k}, &{faces:?}, &{normals:?}, &[])");
        add("CLUSTERS", format!("{mesh}.with_planes(&{:?})", made.planes))?;
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
        write!(text, "pub(crate) static {name}: Shape = Shape {{ exponent: -{k}, vertices: &{vertices:?}, ")?;
        write!(text, "faces: &{faces:?}, normals: &{normals:?}, ")?;
        Ok(writeln!(text, "edges: &{edges:?}, beside: &{beside:?} }};")?)
    };
    for (name, kind, parts) in &growth.shapes {
        let (vertices, faces) = meshes::named(kind, *parts).ok_or_else(|| format!("growth.json: {kind}"))?;
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

/// The torus's vertex normals, edges and texture coordinates, the lists of 2D lines and triangles, and pictures.
fn lists(scenes: &Scenes) -> Result<String> {
    let torus = scenes.models.get("torus").ok_or("no torus")?;
    let normals: Vec<[i16; 3]> = torus.vertices.iter().map(|&vertex| unit(torus_normal(vertex))).collect();
    let (_, vertices) = quantised(&torus.vertices)?;
    let tenth: Vec<_> = vertices.iter().step_by(10).collect();
    // 173 has no factor of their number: each vertex comes once at most, near ones after far ones and before them.
    let scattered: Vec<_> = (0..200).map(|i| vertices[173 * i % vertices.len()]).collect();
    // A picture of 64 × 64 texels once round 25 rings of 20 vertices, in 1/16 texel.
    let uv = meshes::quads(25, 20, |i, j| [1024 * u32::from(i) / 25, 1024 * u32::from(j) / 20]);
    let corners: Vec<_> = scenes.tris2d.iter().map(|t| &t[..6]).collect();
    let colours: Vec<_> = scenes.tris2d.iter().map(|t| t[6]).collect();
    // In halves of a texel from the middle.
    let is_in = |x: usize, y: usize, end: usize| {
        (2 * x).abs_diff(end).pow(2) + (2 * y).abs_diff(end).pow(2) < end * end
    };
    Ok([
        format!("pub static SCREEN: [i16; 6] = {:?};\n", scenes.full_screen_triangle),
        list("TORUS_NORMALS", "[i16; 3]", &normals),
        list("TORUS_EDGES", "[u16; 2]", &edges_of(&torus.faces)),
        list("TORUS_BESIDE", "[u16; 2]", &beside(&edges_of(&torus.faces), &torus.faces)),
        list("TORUS_UV", "[[i16; 2]; 3]", &uv),
        list("POINTS", "[i16; 3]", &tenth),
        list("MANY_POINTS", "[i16; 3]", &scattered),
        list("LINES", "[i16; 4]", &scenes.lines),
        list("TRIANGLES", "[i16; 6]", &corners),
        list("COLOURS", "u16", &colours),
        list("TEXELS", "u8", &(0..64 * 64).map(|at| (at % 64 + 3 * (at / 64)) as u8).collect::<Vec<_>>()),
        picture("PALETTE", 16, |x, y| [2 * y + x / 8, 4 * y + x / 4, 31 - 2 * y - x / 8]),
        picture("PICTURE", 64, |x, y| [x / 2, y, 31 - (x + y) / 4]),
        // Each row of the reduced copies as that in the middle of the rows that it is for.
        picture("COPIES", 64, |x, y| [x / 2, (y + 1).min(63), 31 - (x + (y + 1).min(63)) / 4]),
        picture("DISC", 16, |x, y| if is_in(x, y, 15) { [31, 2 * y, 2 * x] } else { [31, 0, 31] }),
        picture("SMALL_DISC", 8, |x, y| if is_in(x, y, 7) { [31, 8 * y + x, 3] } else { [31, 0, 31] }),
    ]
    .concat())
}

fn list<T: Debug>(name: &str, of: &str, values: &[T]) -> String {
    format!("pub static {name}: [{of}; {}] = {values:?};\n", values.len())
}

/// A picture of red, green and blue by columns and rows.
fn picture(name: &str, side: usize, texel: impl Fn(usize, usize) -> [usize; 3]) -> String {
    let texel = |x, y| format!("Rgb565::new{:?}", <(usize, usize, usize)>::from(texel(x, y)));
    let rows: Vec<_> =
        (0..side).map(|y| (0..side).map(|x| texel(x, y)).collect::<Vec<_>>().join(", ")).collect();
    format!("pub static {name}: [[Rgb565; {side}]; {side}] = [[{}]];\n", rows.join("], ["))
}

/// A normal of unit length in 2⁻¹⁵.
fn unit(normal: [f64; 3]) -> [i16; 3] {
    let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
    normal.map(|c| (c / length * 32767.0).round() as i16)
}

/// A vector in 2⁻¹⁶.
fn bits(v: [f64; 3]) -> [i32; 3] {
    v.map(|c| (c * 65536.0).round() as i32)
}

/// The normal of the torus: away from the circle of radius 1 about z, the centre line of the tube.
fn torus_normal([x, y, z]: [f64; 3]) -> [f64; 3] {
    let from_axis = x.hypot(y);
    [x - x / from_axis, y - y / from_axis, z]
}

/// The normal of a counter-clockwise face.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let side = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let (u, v) = (side(b), side(c));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// All edges of the faces, each once.
fn edges_of(faces: &[[u16; 3]]) -> Vec<[u16; 2]> {
    let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: BTreeSet<_> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.into_iter().collect()
}
