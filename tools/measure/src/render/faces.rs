//! The visible triangle of each pixel, its depth, and its texel.

use embedded_graphics::pixelcolor::raw::RawU32;
use embedded_graphics::prelude::*;
use pinhole::{prelude::*, shading::SpanShader};
use pinhole_render::parts::parts;
use pinhole_render::quantised::Quantised;
use pinhole_render::scene::Scene;
use support::bridge::texels::{Numbered, Shown};
use support::oracle::target::Screen;

/// A "colour" that holds the index of the visible triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Seen(pub(super) i32);

impl PixelColor for Seen {
    type Raw = RawU32;
}

pub(super) struct Drawn<C> {
    pub(super) pixels: Vec<Option<C>>,
    pub(super) depth: Vec<u16>,
    pub(super) statistics: Statistics,
}

/// Draws the index of each triangle.
pub(super) fn indices(scene: &Scene, quantised: &Quantised) -> Result<Drawn<Seen>, String> {
    draw(scene, quantised, |face| Seen(face as i32)) // a scene of 2^31 triangles has no room in memory
}

/// Draws all triangles with depth test, each with the shader of its index.
fn draw<C: PixelColor, S: SpanShader<C, Ink = C>>(
    scene: &Scene,
    quantised: &Quantised,
    shader: impl Fn(usize) -> S,
) -> Result<Drawn<C>, String> {
    let mut screen = Screen::sized(scene.width, scene.height);
    let mut storage = vec![0; screen.pixels.len()];
    let mut depth = DepthBuffer::new(screen.bounding_box(), &mut storage).map_err(|e| e.to_string())?;
    let cull = if scene.cull { Cull::Back } else { Cull::None };
    let camera = quantised.camera();
    let mut statistics = Statistics::default();
    for part in parts(&scene.vertices, &scene.triangles) {
        let vertices = part.vertices(&quantised.vertices);
        let mesh = Mesh::from_fixed(&vertices, &part.faces).map_err(|e| e.to_string())?;
        let mut corners = vec![ScreenVertex::EMPTY; vertices.len()];
        let id = |face: usize| shader(part.first + face);
        let instance = camera.place(&mesh, &quantised.model).with_cull(cull);
        let Ok(drawn) = instance.faces(id).cached(&mut corners).draw(&mut screen.depth_tested(&mut depth));
        statistics = statistics + drawn;
    }
    Ok(Drawn { pixels: screen.pixels, depth: storage, statistics })
}

/// For each pixel the number of its texel, with bit 15 set, or 0 where no face is drawn.
pub(super) fn texels(scene: &Scene, quantised: &Quantised) -> Result<(Vec<u16>, Statistics), String> {
    let none = "--texels: the scene has no texture: give it \"uv\" and \"texture\"";
    let (scene_texture, coords) = scene.texture.as_ref().zip(quantised.texture.as_ref()).ok_or(none)?;
    let [w, h] = scene_texture.size;
    if w * h > 1 << 15 {
        return Err(format!(
            "--texels: the texture has {w} x {h} texels, of which 15 bits number 32768 at most"
        ));
    }
    let [w, h] = [w, h].map(usize::ilog2);
    let texture = Texture::new(Numbered([w, h])).with_exponent(coords.exponent).map_err(|e| e.to_string())?;
    let drawn = match scene_texture.clamped {
        false => draw(scene, quantised, |face| texture.at(coords.uv[face]))?,
        true => draw(scene, quantised, |face| texture.clamped_at(coords.uv[face]))?,
    };
    // Row by row, of 15 bits.
    let number = |Shown([u, v]): Shown| 1 << 15 | ((v >> (32 - h)) << w | u >> (32 - w)) as u16;
    Ok((drawn.pixels.into_iter().map(|shown| shown.map_or(0, number)).collect(), drawn.statistics))
}
