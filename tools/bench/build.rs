//! Makes the models of `scenes.json` into constants: vertices of 16 bits in a power-of-two unit, and what follows from
//! the faces; and the lists of lines and triangles that lie in the picture's plane.

use serde_json::Value;
use std::fmt::{Debug, Write};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    println!("cargo::rerun-if-changed=scenes.json");
    println!("cargo::rerun-if-changed=build.rs");
    let scenes: Value = serde_json::from_str(&std::fs::read_to_string("scenes.json")?)?;
    let mut text = format!("pub(crate) const LIGHT: [i32; 3] = {:?};\n", bits(&triple(&scenes["light"])?));
    for name in ["cube", "torus", "ico"] {
        write_model(&mut text, &name.to_uppercase(), &scenes["models"][name])?;
    }
    let out = std::env::var("OUT_DIR")?;
    std::fs::write(format!("{out}/models.rs"), text)?;
    std::fs::write(format!("{out}/lists.rs"), lists(&scenes)?)?;
    // Of RISC-V's board; the flag that names it is in the root's configuration.
    let root =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).ok_or("the project's root")?;
    println!("cargo::rustc-link-search={}", root.display());
    Ok(())
}

fn write_model(text: &mut String, name: &str, model: &Value) -> Result<()> {
    let vertices = list(&model["vertices"], triple)?;
    let largest = vertices.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs()));
    // The finest unit 2^−k with which all fit.
    let k = (0..31).rev().find(|&k| largest * f64::from(1u32 << k) <= 32767.0).ok_or("too large")?;
    let vertices: Vec<[f64; 3]> =
        vertices.iter().map(|v| v.map(|c| (c * f64::from(1u32 << k)).round())).collect();
    let faces = list(&model["faces"], indices::<3>)?;
    let normals = faces.iter().map(|&face| normal(face.map(|i| vertices[usize::from(i)])));
    let normals: Vec<[i16; 3]> = normals.collect();
    let edges = list(&model["edges"], indices::<2>)?;
    let [x, y, z] = {
        let rows = list(&model["model_rotation"], triple)?;
        let [x, y, z] = rows.as_slice() else { return Err("three rows".into()) };
        // Columns: the images of the axes.
        [0, 1, 2].map(|i| bits(&[x[i], y[i], z[i]]))
    };
    let distance = bits(&[number(&model["distance"])?, 0.0, 0.0])[0];
    let reference = ["front", "writes_front"].map(|name| model["reference"][name].as_u64());
    let [Some(front), Some(writes)] = reference else { return Err("a reference".into()) };
    let vertices: Vec<[i16; 3]> = vertices.iter().map(|v| v.map(|c| c as i16)).collect();
    writeln!(text, "pub static {name}: Model = Model {{")?;
    writeln!(
        text,
        "mesh: mesh({}, -{k}, {}, {}, {}),",
        slice(&vertices),
        slice(&faces),
        slice(&normals),
        slice(&edges)
    )?;
    writeln!(text, "axes: {:?}, distance: {distance}, reference: [{front}, {writes}] }};", [x, y, z])?;
    Ok(())
}

/// The torus's normals at its vertices, and what is 2D.
fn lists(scenes: &Value) -> Result<String> {
    let normals = list(&scenes["models"]["torus"]["vertices"], triple)?.into_iter().map(torus_normal);
    let normals = normals.collect::<Result<Vec<_>>>()?;
    let lines = list(&scenes["lines"], integers::<4>)?;
    let triangles = list(&scenes["tris2d"], integers::<7>)?;
    let corners: Vec<_> = triangles.iter().map(|t| &t[..6]).collect();
    let colours: Vec<_> = triangles.iter().map(|t| t[6]).collect();
    let screen = integers::<6>(&scenes["full_screen_triangle"])?;
    let (normal_count, line_count, triangle_count) = (normals.len(), lines.len(), triangles.len());
    Ok(format!(
        "pub static TORUS_NORMALS: [[i16; 3]; {normal_count}] = {normals:?};\n\
         pub static LINES: [[i16; 4]; {line_count}] = {lines:?};\n\
         pub static TRIANGLES: [[i16; 6]; {triangle_count}] = {corners:?};\n\
         pub static COLOURS: [u16; {triangle_count}] = {colours:?};\n\
         pub static SCREEN: [i16; 6] = {screen:?};\n"
    ))
}

/// The analytic one, in 2⁻¹⁵: away from the circle of radius 1 about z, on which the tube's centre runs.
fn torus_normal([x, y, z]: [f64; 3]) -> Result<[i16; 3]> {
    let from_axis = x.hypot(y);
    let away = [x - x / from_axis, y - y / from_axis, z];
    let length = away.iter().map(|c| c * c).sum::<f64>().sqrt();
    if (length - 0.42).abs() > 1e-6 {
        return Err("the torus's tube has a radius of 0.42".into());
    }
    Ok(away.map(|c| (c / length * 32767.0).round() as i16))
}

fn slice(list: &[impl Debug]) -> String {
    format!("&{list:?}")
}

/// In 2⁻¹⁶.
fn bits(v: &[f64; 3]) -> [i32; 3] {
    v.map(|c| (c * 65536.0).round() as i32)
}

/// The unit normal of a counter-clockwise face, in 2⁻¹⁵.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [i16; 3] {
    let side = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let (u, v) = (side(b), side(c));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
    n.map(|c| (c / length * 32767.0).round() as i16)
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
