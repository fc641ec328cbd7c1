//! Writes a scene as JSON with every digit of its numbers.

use crate::light::{Lamp, Lights};
use crate::scene::{Matrix, Scene};
use std::fmt::{Display, Write};
use std::path::Path;

pub(crate) fn json(scene: &Scene) -> String {
    let Scene { width, height, viewport, .. } = scene;
    let vertices = list(scene.vertices.iter().map(|v| list(v.iter().map(|&c| decimal(c)))));
    let triangles = list(scene.triangles.iter().map(|t| list(t.iter())));
    let matrix = |m: &Matrix| list(m.iter().map(|row| list(row.iter().map(|&c| decimal(c)))));
    let (model, view, projection) = (matrix(&scene.model), matrix(&scene.view), matrix(&scene.projection));
    let (viewport, cull) = (list(viewport.iter()), if scene.cull { "back" } else { "none" });
    let colors = [("colors", &scene.colors.faces), ("emission", &scene.colors.emission)]
        .into_iter()
        .filter(|(_, colors)| !colors.is_empty())
        .map(|(name, colors)| {
            format!(",\n\"{name}\": {}", list(colors.iter().map(|color| list(color.iter()))))
        })
        .collect::<String>();
    let texture = match &scene.texture {
        None => String::new(),
        Some(texture) => {
            let pair = |uv: &[f64; 2]| list(uv.iter().map(|&c| decimal(c)));
            let uv = list(texture.uv.iter().map(|corners| list(corners.iter().map(pair))));
            let picture = match &texture.picture {
                Some((_, file)) => path(file),
                None => list(texture.size.iter()),
            };
            let wrap = if texture.clamped { ", \"wrap\": \"clamp\"" } else { "" };
            format!(",\n\"texture\": {picture}, \"uv\": {uv}{wrap}")
        }
    };
    let fog = scene.fog.and_then(|fog| fog.range).map_or(String::new(), |range| {
        format!(",\n\"fog\": {}", list(range.iter().map(|&distance| decimal(distance))))
    });
    let lights = match scene.lights == Lights::default() {
        true => String::new(),
        false => {
            let ambient = format!("{{\"ambient\": {}}}", scene.lights.ambient);
            let lamps = scene.lights.lamps.iter().map(|Lamp { towards, is_of_camera, level }| {
                let towards = list(towards.iter().map(|&c| decimal(c)));
                let from = if *is_of_camera { "camera" } else { "world" };
                format!("{{\"towards\": {towards}, \"from\": \"{from}\", \"level\": {level}}}")
            });
            format!(",\n\"lights\": {}", list(std::iter::once(ambient).chain(lamps)))
        }
    };
    let sprites = match &scene.sprites[..] {
        [] => String::new(),
        sprites => format!(",\n\"sprites\": {}", list(sprites.iter().map(|entry| entry.json(decimal, path)))),
    };
    format!(
        "{{\"vertices\": {vertices},\n\"triangles\": {triangles},\n\"model\": {model},\n\"view\": {view},\n\
         \"projection\": {projection},\n\
         \"width\": {width}, \"height\": {height}, \"viewport\": {viewport}, \"cull\": \"{cull}\"{colors}{texture}{lights}{fog}{sprites}}}\n"
    )
}

/// The path of a file from this folder, wherever the scene is written to.
fn path(file: &Path) -> String {
    let file = file.canonicalize().unwrap_or_else(|_| file.to_path_buf());
    serde_json::Value::from(file.to_string_lossy()).to_string()
}

fn list(items: impl Iterator<Item = impl Display>) -> String {
    let mut text = String::from("[");
    for (index, item) in items.enumerate() {
        let comma = if index > 0 { ", " } else { "" };
        let _ = write!(text, "{comma}{item}"); // a String takes all
    }
    text.push(']');
    text
}

/// A number with all its decimal digits: exact, unlike the shortest representation.
fn decimal(v: f64) -> String {
    // v = odd · 2^exponent needs −exponent digits after the point.
    let bits = v.to_bits();
    let field = (bits >> 52 & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let mantissa = if field == 0 { fraction } else { fraction | 1 << 52 };
    if mantissa == 0 {
        return "0".into();
    }
    let exponent = field.max(1) - 1075 + mantissa.trailing_zeros() as i32;
    format!("{v:.*}", (-exponent).max(0) as usize)
}
