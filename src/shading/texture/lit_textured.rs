//! The shader of a face that shows a texture in light of its own at each corner.

use super::mapping::Textured;
use super::texels::Texels;
use super::textured::TextureGradients;
use crate::clip::Barycentric;
use crate::color::Color;
use crate::math::unrolled::map3;
use crate::raster::{Gradient, Span, Triangle};
use crate::shading::levels::weighted_mean;
use crate::shading::{CornerValues, FastPath, Shader, SpanShader};

/// A texture on a face, with light of its own at each corner, linear on the screen between the corners: [`Textured::lit`] makes
/// it.
///
/// **Error.** The texel is that of [`Textured`]. Its light is rounded to the nearest of the levels that the texels have, after an
/// error of 2⁻⁹ of a level.
///
/// **Clipped faces** have the light of [`Gouraud`](crate::shading::Gouraud): new corners' light is interpolated in space, and rounded to
/// 2⁻¹⁸ of full light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LitTextured<S> {
    face: Textured<S>,
    /// In 2⁻¹⁰ of 1/256 of all levels: see [`of_level`].
    light: [i32; 3],
}

impl<S: Texels<Color: Color>> Textured<S> {
    /// This face with a level of light at each corner, 0 … 256 (more counts as 256), in the order of the face's vertices.
    /// [`Light::levels`](crate::light::Light::levels) computes levels, [`Mesh::corners_of`](crate::Mesh::corners_of) picks those of a
    /// face.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::{Gray8, GrayColor}, prelude::*};
    /// use pinhole::{camera::Window, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let (one, two) = (Scalar::from_int(1), Scalar::from_int(2));
    /// let window = Window { left: -two, right: two, bottom: -two, top: two };
    /// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), two, Angle::ZERO, Angle::ZERO);
    /// let camera = Camera::new(&view, &Projection::orthographic(window, one, Scalar::from_int(9))?, &viewport);
    /// // A square that fills a picture of 64 pixels, with full light on the left and none on the right.
    /// const UV: [[i16; 2]; 4] = [[0, 128], [128, 128], [128, 0], [0, 0]];
    /// const LEVELS: [u16; 4] = [256, 0, 0, 256]; // `Light::levels` computes them
    /// let mesh = Mesh::new(&[[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]], 0, &[[0, 1, 2], [0, 2, 3]])?;
    /// let texture = Texture::new(&[[Gray8::WHITE; 8]; 8]);
    /// let mut pixels = [Gray8::BLACK; 64 * 64];
    /// let mut picture = Picture::new(&mut pixels, viewport.size())?;
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let shade = |face| texture.at(mesh.corners_of(face, &UV)).lit(mesh.corners_of(face, &LEVELS));
    /// instance.faces(shade).draw(&mut picture.pixels())?;
    /// // 255 · (1 − (x + ½)/64)
    /// assert_eq!([0, 31, 63].map(|x: usize| pixels[x].luma()), [253, 129, 2]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn lit(self, levels: [u16; 3]) -> LitTextured<S> {
        LitTextured { face: self, light: map3(levels, |level| of_level(level, S::LEVEL_BITS)) }
    }
}

/// The light of a level, 0 … 256, such that [`Gradient::of_light`], which adds half of 1/256, has the nearest of 2^`bits` levels in
/// its upper bits: ((2^bits − 1)·level/256 + ½)·256/2^bits − ½, in 2⁻¹⁰. 0 … 255·2¹⁰.
#[inline(always)]
const fn of_level(level: u16, bits: u32) -> i32 {
    let level = if level > 256 { 256 } else { level as u32 };
    // 1 … 255.
    let levels = (1u32 << (bits & 31)) - 1;
    // Below 2²⁷, rounded down by less than one unit.
    ((((level * levels) << 10) + (1 << 17)) >> (bits & 31)) as i32 - (1 << 9)
}

impl<S: Texels> Shader for LitTextured<S> {
    type Varying = Barycentric;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        let light = corners.map(|corner| weighted_mean(self.light, corner.weights(), 255 << 10));
        Self { face: self.face.sub_face(corners), light }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { face: self.face.with_corners(corners), ..*self }
    }
}

impl<S: Texels<Color: Color>> SpanShader<S::Color> for LitTextured<S> {
    type Ink = S::Ink;
    type Setup = (TextureGradients<S>, Gradient);
    type FastPath = Self;

    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup {
        (self.face.set_up(triangle), Gradient::of_light(triangle, &self.light))
    }

    fn span(setup: &Self::Setup, span: Span) -> impl Iterator<Item = S::Ink> {
        Self::runs(setup, span).flat_map(|(width, colors)| colors.take(width as usize))
    }
}

impl<S: Texels<Color: Color>> FastPath<S::Color, Self> for LitTextured<S> {
    #[inline(always)]
    fn runs(
        (texture, light): &(TextureGradients<S>, Gradient),
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = S::Ink>)> {
        let (mut next, step) = (light.at(span.x, span.y), light.step());
        texture.coordinates(span).map(move |(width, line, texels)| {
            let mut light = next;
            next = next.wrapping_add(step.wrapping_mul(width as u32));
            let colors = line.map(move |[u, v]| {
                let level = light >> (32u32.wrapping_sub(S::LEVEL_BITS) & 31);
                light = light.wrapping_add(step);
                texels.lit_texel(u, v, level)
            });
            (width, colors)
        })
    }
}
