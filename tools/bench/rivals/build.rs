//! Makes the models of `scenes.json` into constants of the types that embedded-3dgfx takes.

#[path = "../scenes.rs"]
#[allow(dead_code)] // shared
mod scenes;

use scenes::{edges_of, indices, list, normal, number, torus_normal, triple, Result};
use serde_json::Value;
use std::fmt::Write;

fn main() -> Result<()> {
    println!("cargo::rerun-if-changed=../scenes.json");
    println!("cargo::rerun-if-changed=../scenes.rs");
    println!("cargo::rerun-if-changed=build.rs");
    let scenes: Value = serde_json::from_str(&std::fs::read_to_string("../scenes.json")?)?;
    let mut text = format!("pub const LIGHT: [f32; 3] = {:?};\n", short(&[triple(&scenes["light"])?])[0]);
    for name in ["cube", "torus", "ico"] {
        write_model(&mut text, name, &scenes["models"][name])?;
    }
    std::fs::write(format!("{}/models.rs", std::env::var("OUT_DIR")?), text)?;
    Ok(())
}

fn write_model(text: &mut String, name: &str, model: &Value) -> Result<()> {
    let vertices = list(&model["vertices"], triple)?;
    let faces = list(&model["faces"], indices::<3>)?;
    let edges = match name {
        "torus" => edges_of(&faces),
        _ => list(&model["edges"], indices::<2>)?,
    };
    let normals: Vec<[f64; 3]> =
        faces.iter().map(|&face| normal(face.map(|i| vertices[usize::from(i)]))).collect();
    let vertex_normals: Vec<[f64; 3]> = match name {
        "torus" => vertices.iter().map(|&vertex| torus_normal(vertex)).collect::<Result<_>>()?,
        _ => Vec::new(),
    };
    let rotation = list(&model["model_rotation"], triple)?;
    let distance = number(&model["distance"])? as f32;
    let (vertices, normals, vertex_normals) = (short(&vertices), short(&normals), short(&vertex_normals));
    let rotation = short(&rotation);
    writeln!(
        text,
        "pub static {}: Model = Model {{ vertices: &{vertices:?}, faces: &{faces:?}, edges: &{edges:?}, \
         normals: &{normals:?}, vertex_normals: &{vertex_normals:?}, rotation: {rotation:?}, distance: {distance:?} }};",
        name.to_uppercase()
    )?;
    Ok(())
}

fn short(list: &[[f64; 3]]) -> Vec<[f32; 3]> {
    list.iter().map(|v| v.map(|c| c as f32)).collect()
}
