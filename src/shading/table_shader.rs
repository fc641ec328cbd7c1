//! Colours that are looked up in a [`ShadeTable`](crate::shading::ShadeTable) along a span.

use super::levels::weighted_mean;
use super::shader::{FastPath, Shader, SpanShader};
use super::table::TableShader;
use crate::clip::Barycentric;
use crate::raster::{Gradient, Span, Triangle};
use core::iter::repeat_with;
use embedded_graphics_core::pixelcolor::PixelColor;

impl<C: PixelColor> Shader for TableShader<'_, C> {
    type Varying = Barycentric;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        let light = corners.map(|corner| weighted_mean(self.light, corner.weights(), 255 << 10));
        Self { light, ..*self }
    }
}

impl<'t, C: PixelColor> SpanShader<C> for TableShader<'t, C> {
    type Ink = C;
    type Setup = (&'t [C; 256], Gradient);
    type FastPath = Self;

    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup {
        (self.colors, Gradient::of_light(triangle, &self.light))
    }

    #[inline(always)]
    fn span((colors, light): &Self::Setup, Span { x, y, .. }: Span) -> impl Iterator<Item = C> {
        let (mut light, step) = (light.at(x, y), light.step());
        repeat_with(move || {
            let color = Self::look_up(colors, light);
            light = light.wrapping_add(step);
            color
        })
    }
}

impl<C: PixelColor> FastPath<C, Self> for TableShader<'_, C> {
    #[inline(always)]
    fn table(shader: &Self) -> Option<TableShader<'_, C>> {
        Some(*shader)
    }
}
