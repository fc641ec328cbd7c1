//! The number of the texel in each pixel.

use super::faces::{self, Seen};
use pinhole::{Statistics, Texels, Texture};
use pinhole_render::quantised::Quantised;
use pinhole_render::scene::Scene;

/// Texels that show their own number, row by row.
#[derive(Clone, Copy)]
struct Numbered([usize; 2]);

impl Texels for Numbered {
    type Color = Seen;

    fn size_bits(&self) -> [u32; 2] {
        self.0.map(usize::ilog2)
    }

    fn texel(&self, u: u32, v: u32) -> Seen {
        let [w, h] = self.size_bits();
        Seen::number((v >> (32 - h)) << w | u >> (32 - w))
    }
}

/// For each pixel the number of its texel, with bit 15 set, or 0 where no face is drawn.
pub(super) fn numbers(scene: &Scene, quantised: &Quantised) -> Result<(Vec<u16>, Statistics), String> {
    let none = "--texels: the scene has no texture: give it \"uv\" and \"texture\"";
    let (scene_texture, coords) = scene.texture.as_ref().zip(quantised.texture.as_ref()).ok_or(none)?;
    let [w, h] = scene_texture.size;
    if w * h > 1 << 15 {
        return Err(format!(
            "--texels: the texture has {w} x {h} texels, of which 15 bits number 32768 at most"
        ));
    }
    let texture = Texture::new(Numbered([w, h])).with_exponent(coords.exponent).map_err(|e| e.to_string())?;
    let drawn = match scene_texture.clamped {
        false => faces::draw(scene, quantised, |face| texture.at(coords.uv[face]))?,
        true => faces::draw(scene, quantised, |face| texture.clamped_at(coords.uv[face]))?,
    };
    let number = |seen: &Seen| u16::try_from(seen.index()).map_or(0, |number| number | 1 << 15);
    Ok((drawn.ids.pixels().iter().map(number).collect(), drawn.statistics))
}
