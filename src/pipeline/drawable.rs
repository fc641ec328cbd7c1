//! Which shaders, strokes and sprites a target can show.
//!
//! Each draw call asks for one of these traits, so that an ink that reads pixels and a target that cannot give them meet in the
//! caller's line.

use crate::color::InkKind;
use crate::shading::{SpanShader, SpriteSource, Stroke};
use crate::surface::{Gives, Surface};

/// A [`SpanShader`] for a target: of its colour type, and with an [`Ink`](crate::color::Ink) that reads pixels only if the target's lie in
/// [memory](Surface::memory). Implemented for every such shader.
#[diagnostic::on_unimplemented(
    message = "faces of `{T}` cannot be filled with `{Self}`",
    label = "not a color of the target or a shader for it",
    note = "return the target's color type, a shader such as `Flat`, `Gouraud`, `Lit` or `texture.at(corners)`, or implement `Shader` and `SpanShader` for your own; the fog of `Fogged` has the target's color type, too"
)]
pub trait ShaderFor<T: Surface>: SpanShader<T::Color> {}

impl<T: Surface, S: SpanShader<T::Color>> ShaderFor<T> for S where
    T::Store: Gives<<S::Ink as InkKind<T::Color>>::Access>
{
}

/// A [`Stroke`] for a target: of its colour type, and anti-aliased only if the target's pixels lie in [memory](Surface::memory).
/// Implemented for every such stroke.
#[diagnostic::on_unimplemented(
    message = "lines of `{T}` cannot be drawn with `{Self}`",
    label = "not a color of the target or a stroke for it",
    note = "pass the target's color type, or `AntiAliased` of it"
)]
pub trait StrokeFor<T: Surface>: Stroke<T::Color> {}

impl<T: Surface, K: Stroke<T::Color>> StrokeFor<T> for K where T::Store: Gives<K::Access> {}

/// A [`SpriteSource`] for a target: of its colour type, and with an [`Ink`](crate::color::Ink) that reads pixels only if the target's lie in
/// [memory](Surface::memory). Implemented for every such picture.
#[diagnostic::on_unimplemented(
    message = "`{T}` cannot show sprites of `{Self}`",
    label = "not a picture in the target's colors",
    note = "pass `Texels`, `SpriteImage::new(&image)` of an embedded-graphics image, or `SolidTexel`, in the target's color type"
)]
pub trait SpriteFor<T: Surface>: SpriteSource<Color = T::Color> {}

impl<T: Surface, S: SpriteSource<Color = T::Color>> SpriteFor<T> for S where
    T::Store: Gives<<S::Ink as InkKind<T::Color>>::Access>
{
}
