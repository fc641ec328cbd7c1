//! The visible triangle of each pixel, its depth, and its texel.

use embedded_graphics::pixelcolor::raw::RawU32;
use embedded_graphics::pixelcolor::PixelColor;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{prelude::*, shading::SpanShader, texture::Texels};
use pinhole_apps_support::canvas::Canvas;
use pinhole_render::parts::parts;
use pinhole_render::quantised::Quantised;
use pinhole_render::scene::Scene;

/// A "colour" that holds the index of the visible triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Seen(u32);

impl PixelColor for Seen {
    type Raw = RawU32;
}

impl Seen {
    const NONE: Self = Self(u32::MAX);

    /// The number, such as the triangle's index; -1 for none.
    pub(super) fn index(self) -> i32 {
        self.0 as i32 // a scene of 2^31 triangles has no room in memory
    }
}

pub(super) struct Drawn {
    pub(super) ids: Canvas<Seen>,
    pub(super) depth: Vec<u16>,
    pub(super) statistics: Statistics,
}

/// Draws the index of each triangle.
pub(super) fn indices(scene: &Scene, quantised: &Quantised) -> Result<Drawn, String> {
    draw(scene, quantised, |face| Seen(face as u32))
}

/// Draws all triangles with depth test, each with the shader of its index.
fn draw<S: SpanShader<Seen, Ink = Seen>>(
    scene: &Scene,
    quantised: &Quantised,
    shader: impl Fn(usize) -> S,
) -> Result<Drawn, String> {
    let size = Size::new(scene.width, scene.height);
    let mut ids = Canvas::new(size, Seen::NONE);
    let mut storage = vec![0; ids.pixels().len()];
    let mut depth =
        DepthBuffer::new(Rectangle::new(Point::zero(), size), &mut storage).map_err(|e| e.to_string())?;
    let cull = if scene.cull { Cull::Back } else { Cull::None };
    let camera = quantised.camera();
    let mut statistics = Statistics::default();
    for part in parts(&scene.vertices, &scene.triangles) {
        let vertices = part.vertices(&quantised.vertices);
        let mesh = Mesh::from_fixed(&vertices, &part.faces).map_err(|e| e.to_string())?;
        let mut corners = vec![ScreenVertex::EMPTY; vertices.len()];
        let id = |face: usize| shader(part.first + face);
        let instance = camera.place(&mesh, &quantised.model).with_cull(cull);
        let Ok(drawn) = instance.faces(id).cached(&mut corners).draw(&mut ids.depth_tested(&mut depth));
        statistics = statistics + drawn;
    }
    Ok(Drawn { ids, depth: storage, statistics })
}

/// Texels that show their own number, row by row.
#[derive(Clone, Copy)]
struct Numbered([usize; 2]);

impl Texels for Numbered {
    type Color = Seen;
    type Ink = Seen;
    type FastPath = ();

    fn size_bits(&self) -> [u32; 2] {
        self.0.map(usize::ilog2)
    }

    fn texel(&self, u: u32, v: u32) -> Seen {
        let [w, h] = self.size_bits();
        Seen((v >> (32 - h)) << w | u >> (32 - w))
    }
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
    let texture = Texture::new(Numbered([w, h])).with_exponent(coords.exponent).map_err(|e| e.to_string())?;
    let drawn = match scene_texture.clamped {
        false => draw(scene, quantised, |face| texture.at(coords.uv[face]))?,
        true => draw(scene, quantised, |face| texture.clamped_at(coords.uv[face]))?,
    };
    let number = |seen: &Seen| u16::try_from(seen.index()).map_or(0, |number| number | 1 << 15);
    Ok((drawn.ids.pixels().iter().map(number).collect(), drawn.statistics))
}
