//! Sprites by their definition in docs/spec.md: a pixel shows the texel that holds its centre.

use crate::harness::{numbers, used, Drawn};
use serde_json::Value;

/// The columns and rows of the file `picture.png`, and red, green, blue and opacity of a texel.
pub(crate) const SIZE: [u32; 2] = [6, 4];

pub(crate) fn texel(column: u32, row: u32) -> [u8; 4] {
    let opacity = if (column + 2 * row) % 5 == 3 { 127 } else { 128 };
    [40 * column as u8, 60 * row as u8, 200 - 10 * (column * row) as u8, opacity]
}

/// [`texel`] where it is opaque.
fn opaque(column: u32, row: u32) -> Option<[u8; 3]> {
    let [red, green, blue, opacity] = texel(column, row);
    (opacity >= 128).then_some([red, green, blue])
}

/// The picture without opacity: magenta where it is transparent.
pub(crate) fn keyed(column: u32, row: u32) -> [u8; 4] {
    let [red, green, blue] = opaque(column, row).unwrap_or([255, 0, 255]);
    [red, green, blue, 255]
}

/// A sprite: where its rectangle begins and how large it is, in pixels; its distance; and what it shows.
struct Sprite<'t> {
    low: [f64; 2],
    size: [f64; 2],
    distance: f64,
    entry: &'t Value,
}

/// The distance of the scenes' triangle.
const FACE: f64 = 4.0;
const SKY: [u8; 3] = [0, 0, 255];

/// A colour over another, `alpha` of 32 parts.
fn mix(own: [u8; 3], below: [u8; 3], alpha: u32) -> [u8; 3] {
    [0, 1, 2].map(|i| ((u32::from(own[i]) * alpha + u32::from(below[i]) * (32 - alpha) + 16) / 32) as u8)
}

/// The picture of a scene whose eye is at the origin, from that of the scene without its sprites; `law` is that of the scene's fog.
pub(crate) fn over(base: &Drawn, scene: &Value, law: &str, discs: &Value) -> Vec<[u8; 3]> {
    let exact = used(&base.used);
    let mut sprites = Vec::new();
    for entry in scene["sprites"].as_array().unwrap() {
        for at in entry["at"].as_array().unwrap().iter().map(numbers::<3>) {
            let [x, y, _, w] = exact.clip(at);
            let sides = [exact.width, exact.height].map(|side| side as f64 / 2.0);
            let screen = [(1.0 + x / w) * sides[0], (1.0 - y / w) * sides[1]];
            let unit = exact.projection[0][0] * sides[0] / w;
            let texels = texels(entry).map(f64::from);
            let size = match (&entry["size"], entry["height"].as_f64(), is_file(entry)) {
                (Value::Array(_), ..) => numbers(&entry["size"]).map(|side: f64| side * unit),
                (_, Some(height), _) => [texels[0] / texels[1], 1.0].map(|side| side * height * unit),
                (_, None, true) => texels.map(|side| side * entry["pixels"].as_f64().unwrap()),
                (_, None, false) => texels,
            };
            // The part of the picture that lies before the point.
            let name = entry["anchor"].as_str().unwrap_or("center");
            let part = |axis: usize, ends: [&str; 2]| match entry["anchor"][axis].as_f64() {
                Some(texel) => texel.min(texels[axis]) / texels[axis],
                None => ends.iter().position(|end| name.contains(end)).map_or(0.5, |end| end as f64),
            };
            let part = [part(0, ["left", "right"]), part(1, ["top", "bottom"])];
            let low = [0, 1].map(|i| screen[i] - part[i] * size[i]);
            sprites.push(Sprite { low, size, distance: -at[2], entry });
        }
    }
    // Sprites whose depth is stored come first, in the file's order; then the translucent sprites from far to near.
    sprites.sort_by(|a, b| {
        let key =
            |sprite: &Sprite<'_>| if sprite.entry["alpha"].is_null() { f64::MIN } else { -sprite.distance };
        key(a).total_cmp(&key(b))
    });
    let mut pixels = base.picture.clone();
    for (index, pixel) in pixels.iter_mut().enumerate() {
        let mut stored = if base.ids[index] < 0 { f64::INFINITY } else { FACE };
        for sprite in &sprites {
            let center = [index % base.width, index / base.width].map(|c| c as f64 + 0.5);
            let Some(color) = sprite.color(center, discs) else { continue };
            if sprite.entry["depth"] != "none" && sprite.distance >= stored {
                continue;
            }
            let color = mix(color, SKY, fog(scene, law, sprite.distance));
            match sprite.entry["alpha"].as_u64() {
                Some(alpha) => *pixel = mix(color, *pixel, alpha as u32),
                None => (*pixel, stored) = (color, sprite.distance),
            }
        }
    }
    pixels
}

/// What fog leaves of a colour, in 32nds.
fn fog(scene: &Value, law: &str, distance: f64) -> u32 {
    if scene["fog"].is_null() {
        return 32;
    }
    let [start, end] = numbers(&scene["fog"]);
    let part = ((distance - start) / (end - start)).max(0.0);
    let left = match () {
        () if law.contains("exponential") => 64f64.powf(-part),
        () if law.contains("squared") => 64f64.powf(-part * part),
        () => 1.0 - part.min(1.0),
    };
    (32.0 * left).round() as u32
}

fn is_file(entry: &Value) -> bool {
    entry["picture"] == "picture.png"
}

/// The texels of a file; of a ready picture there is one for each pixel.
fn texels(entry: &Value) -> [u32; 2] {
    if is_file(entry) {
        SIZE
    } else {
        [entry["pixels"].as_u64().unwrap() as u32; 2]
    }
}

impl Sprite<'_> {
    fn color(&self, center: [f64; 2], discs: &Value) -> Option<[u8; 3]> {
        let part = [0, 1].map(|i| (center[i] - self.low[i]) / self.size[i]);
        if part.iter().any(|part| !(0.0..1.0).contains(part)) {
            return None;
        }
        let texels = texels(self.entry);
        let [column, row] = [0, 1].map(|i| (part[i] * f64::from(texels[i])).floor() as u32);
        if is_file(self.entry) {
            return opaque(column, row);
        }
        let disc = &discs[texels[0].to_string()];
        let shown = disc[row as usize].as_str().is_some_and(|line| line.as_bytes()[column as usize] == b'#');
        let is_square = self.entry["picture"] != "disc";
        (is_square || shown).then(|| numbers(&self.entry["color"]).map(|c| c as u8))
    }
}
