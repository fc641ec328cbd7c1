//! Which shader each face of a scene has.

use crate::bands::Colour;
use crate::brush::Brush;
use crate::light::Light;
use crate::parts::Part;
use crate::quantised::Quantised;
use crate::scene::Scene;
use crate::style::{Mode, Style};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use pinhole::{prelude::*, shading::Dithered, texture::TexelSlice};

/// The shaders of a scene's faces in a style.
pub(crate) struct Shades<'a, C> {
    scene: &'a Scene,
    style: &'a Style,
    light: Light,
    /// At the corners of the scene's triangles.
    normals: &'a [[[i16; 3]; 3]],
    /// The number that each triangle has in the scene, if they are sorted.
    order: Option<&'a [usize]>,
    texture: Option<FacePicture<'a, C>>,
}

/// A picture on faces, and where its texels are on each.
struct FacePicture<'a, C> {
    texture: Texture<TexelSlice<'a, C>>,
    uv: &'a [[[i16; 2]; 3]],
    clamped: bool,
}

impl<'a, C: Colour> Shades<'a, C> {
    /// Without `texels` no face shows a picture.
    pub(crate) fn new(
        (scene, quantised): (&'a Scene, &'a Quantised),
        style: &'a Style,
        normals: &'a [[[i16; 3]; 3]],
        order: Option<&'a [usize]>,
        texels: Option<&'a [C]>,
    ) -> Result<Self, String> {
        let texture = texels.zip(scene.texture.as_ref()).zip(quantised.texture.as_ref());
        let texture = texture.map(|((texels, of_scene), coords)| {
            let [width, height] = of_scene.size;
            let texels = TexelSlice::new(texels, width, height).map_err(|e| e.to_string())?;
            let texture = Texture::new(texels).with_exponent(coords.exponent).map_err(|e| e.to_string())?;
            Ok::<_, String>(FacePicture { texture, uv: &coords.uv, clamped: of_scene.clamped })
        });
        let light = Light::new(scene, quantised);
        Ok(Self { scene, style, light, normals, order, texture: texture.transpose()? })
    }

    /// The shader of a face, given its part and its number there.
    pub(crate) fn brush(&self, part: &Part, face: usize) -> Brush<'a, C> {
        let at = part.first + face;
        let triangle = self.order.and_then(|order| order.get(at)).copied().unwrap_or(at);
        let levels = self.light.corners(triangle, self.normals);
        let Some(FacePicture { texture, uv, clamped }) = &self.texture else {
            return self.plain(triangle, levels);
        };
        match (*clamped, self.style.lit_texture) {
            _ if self.is_bare(triangle) => self.plain(triangle, levels),
            (false, false) => Brush::Texture(texture.at(uv[triangle])),
            (true, false) => Brush::ClampedTexture(texture.clamped_at(uv[triangle])),
            (false, true) => Brush::LitTexture(texture.at(uv[triangle]).lit(levels)),
            (true, true) => Brush::LitClampedTexture(texture.clamped_at(uv[triangle]).lit(levels)),
        }
    }

    /// The shader of a triangle without a picture.
    fn plain(&self, triangle: usize, levels: [u16; 3]) -> Brush<'a, C> {
        let of = |colors: &[[u8; 3]]| colors.get(triangle).filter(|_| self.style.own_colours).copied();
        let color = of(&self.scene.colors.faces).map_or(self.style.colour, rgb);
        let emission = of(&self.scene.colors.emission).map(rgb);
        let smooth = || Gouraud::lit(color, levels);
        match (self.style.mode == Mode::Flat, emission, self.style.dither) {
            (true, emission, dither) => {
                let flat = Flat::lit(color, levels[0]).emitting(emission.unwrap_or(Rgb888::BLACK));
                if dither {
                    Brush::FlatDithered(Dithered(flat))
                } else {
                    Brush::Flat(flat)
                }
            }
            (false, None, false) => Brush::Smooth(smooth()),
            (false, None, true) => Brush::SmoothDithered(Dithered(smooth())),
            (false, Some(emission), false) => Brush::Glowing(smooth().emitting(emission)),
            (false, Some(emission), true) => Brush::GlowingDithered(Dithered(smooth().emitting(emission))),
        }
    }

    /// Whether an edge is to be smoothed though no face beside it is hidden: where the surface is not shaded smoothly, or its colour
    /// changes, or the picture ends. Of triangles that are not sorted.
    pub(crate) fn is_crease(&self, part: &Part, edge: usize) -> bool {
        let of_face = |face: usize| {
            let own = self.scene.colors.faces.get(face).filter(|_| self.style.own_colours);
            (own, self.is_bare(face))
        };
        let [one, other] = part.triangles_beside(edge).map(|face| face.map_or((None, false), of_face));
        part.is_feature(edge) || one != other
    }

    /// Whether a triangle shows its own colour in place of the picture.
    fn is_bare(&self, triangle: usize) -> bool {
        self.scene.texture.as_ref().is_some_and(|it| it.bare.get(triangle) == Some(&true))
    }
}

fn rgb([r, g, b]: [u8; 3]) -> Rgb888 {
    Rgb888::new(r, g, b)
}
