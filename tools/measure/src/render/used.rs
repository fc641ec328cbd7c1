//! Writes a scene as JSON with every digit of its numbers.

use pinhole_render::json::Names;
use pinhole_render::light::Lights;
use pinhole_render::scene::{Matrix, Scene};
use pinhole_render::sprites::{Anchor, SceneSprites, SpritePicture, SpriteSize};
use std::fmt::Display;
use std::path::Path;

pub(super) fn json(scene: &Scene) -> String {
    let matrix = |m: &Matrix| list(m.map(numbers));
    let picture = [
        field("width", scene.width),
        field("height", scene.height),
        field("viewport", list(scene.viewport)),
        field("cull", if scene.cull { "\"back\"" } else { "\"none\"" }),
    ];
    let mut lines = vec![
        field("vertices", list(scene.vertices.iter().map(|&vertex| numbers(vertex)))),
        field("triangles", list(scene.triangles.iter().map(list))),
        field("model", matrix(&scene.model)),
        field("view", matrix(&scene.view)),
        field("projection", matrix(&scene.projection)),
        picture.join(", "),
    ];
    for (name, colors) in [("colors", &scene.colors.faces), ("emission", &scene.colors.emission)] {
        lines.extend((!colors.is_empty()).then(|| field(name, list(colors.iter().map(list)))));
    }
    if let Some(texture) = &scene.texture {
        let picture = texture.picture.as_ref().map_or_else(|| list(texture.size), |(_, file)| path(file));
        let uv = list(texture.uv.iter().map(|corners| list(corners.map(numbers))));
        let wrap = if texture.clamped { ", \"wrap\": \"clamp\"" } else { "" };
        lines.push(format!("{}, {}{wrap}", field("texture", picture), field("uv", uv)));
    }
    if scene.lights != Lights::default() {
        let lamps = scene.lights.lamps.iter().map(|lamp| {
            let from = if lamp.is_of_camera { "camera" } else { "world" };
            let (towards, level) = (numbers(lamp.towards), lamp.level);
            format!("{{\"towards\": {towards}, \"from\": \"{from}\", \"level\": {level}}}")
        });
        let ambient = format!("{{{}}}", field("ambient", scene.lights.ambient));
        lines.push(field("lights", list(std::iter::once(ambient).chain(lamps))));
    }
    lines.extend(scene.fog.and_then(|fog| fog.range).map(|range| field("fog", numbers(range))));
    if !scene.sprites.is_empty() {
        lines.push(field("sprites", list(scene.sprites.iter().map(sprites))));
    }
    format!("{{{}}}\n", lines.join(",\n"))
}

/// An entry of `"sprites"`.
fn sprites(entry: &SceneSprites) -> String {
    let mut fields = match &entry.picture {
        SpritePicture::File { path: file, key, .. } => {
            [field("picture", path(file))].into_iter().chain(key.map(|key| field("key", list(key)))).collect()
        }
        SpritePicture::Ready(shape, color) => {
            vec![field("picture", name(*shape)), field("color", list(color))]
        }
    };
    fields.push(match entry.size {
        SpriteSize::Pixels(pixels) => field("pixels", pixels),
        SpriteSize::World(size) => field("size", numbers(size)),
        SpriteSize::Height(height) => field("height", decimal(height)),
    });
    fields.push(match entry.anchor {
        Anchor::Named(anchor) => field("anchor", name(anchor)),
        Anchor::Texel(texel) => field("anchor", list(texel)),
    });
    fields.extend(entry.alpha.map(|alpha| field("alpha", alpha)));
    fields.extend((!entry.depth_tested).then(|| field("depth", "\"none\"")));
    fields.push(field("at", list(entry.points.iter().map(|&point| numbers(point)))));
    format!("{{{}}}", fields.join(", "))
}

fn field(name: &str, value: impl Display) -> String {
    format!("\"{name}\": {value}")
}

/// The text that stands for a value.
fn name<T: Names + PartialEq>(value: T) -> String {
    let name = T::names().find(|(_, known)| *known == value).map_or("", |(name, _)| name);
    format!("\"{name}\"")
}

/// The path of a file from this folder, wherever the scene is written to.
fn path(file: &Path) -> String {
    let file = file.canonicalize().unwrap_or_else(|_| file.to_path_buf());
    serde_json::Value::from(file.to_string_lossy()).to_string()
}

fn list<T: ToString>(items: impl IntoIterator<Item = T>) -> String {
    let items: Vec<_> = items.into_iter().map(|item| item.to_string()).collect();
    format!("[{}]", items.join(", "))
}

fn numbers<const N: usize>(numbers: [f64; N]) -> String {
    list(numbers.map(decimal))
}

/// A number with all its decimal digits, one for each bit of its fraction: exact, unlike the shortest representation.
fn decimal(v: f64) -> String {
    let (mut scaled, mut digits) = (v, 0);
    while scaled.fract() != 0.0 {
        (scaled, digits) = (scaled * 2.0, digits + 1); // exact
    }
    format!("{:.digits$}", v + 0.0) // no negative zero
}
