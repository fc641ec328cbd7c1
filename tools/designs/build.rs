//! Makes the torus of the benchmark's scenes into constants: vertices of 16 bits in a power-of-two unit.

use serde_json::Value;
use std::fmt::Write;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const SCENES: &str = "../bench/scenes.json";

fn main() -> Result<()> {
    println!("cargo::rerun-if-changed={SCENES}");
    println!("cargo::rerun-if-changed=build.rs");
    let scenes: Value = serde_json::from_str(&std::fs::read_to_string(SCENES)?)?;
    let torus = &scenes["models"]["torus"];
    let vertices = list(&torus["vertices"], triple)?;
    let largest = vertices.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs()));
    // The finest unit 2^−k with which all fit.
    let k = (0..31).rev().find(|&k| largest * f64::from(1u32 << k) <= 32767.0).ok_or("too large")?;
    let vertices: Vec<_> =
        vertices.iter().map(|v| v.map(|c| (c * f64::from(1u32 << k)).round() as i16)).collect();
    let faces = list(&torus["faces"], |face| {
        let index = |value: &Value| Ok(u16::try_from(value.as_u64().ok_or("an index")?)?);
        <[u16; 3]>::try_from(list(face, index)?).map_err(|_| "three corners".into())
    })?;
    let rows = list(&torus["model_rotation"], triple)?;
    let bits: Vec<_> = rows.iter().map(|row| row.map(|c| (c * 65536.0).round() as i32)).collect();
    let distance = (number(&torus["distance"])? * 65536.0).round() as i32;
    let mut text = String::new();
    writeln!(text, "pub const EXPONENT: i8 = -{k};\npub const DISTANCE: i32 = {distance};")?;
    writeln!(text, "pub const ROTATION: [[i32; 3]; 3] = {bits:?};")?;
    writeln!(text, "pub static VERTICES: [[i16; 3]; {}] = {vertices:?};", vertices.len())?;
    writeln!(text, "pub static FACES: [[u16; 3]; {}] = {faces:?};", faces.len())?;
    std::fs::write(format!("{}/torus.rs", std::env::var("OUT_DIR")?), text)?;
    Ok(())
}

fn list<T>(value: &Value, item: impl Fn(&Value) -> Result<T>) -> Result<Vec<T>> {
    value.as_array().ok_or("a list")?.iter().map(item).collect()
}

fn number(value: &Value) -> Result<f64> {
    Ok(value.as_f64().ok_or("a number")?)
}

fn triple(value: &Value) -> Result<[f64; 3]> {
    <[f64; 3]>::try_from(list(value, number)?).map_err(|_| "three numbers".into())
}
