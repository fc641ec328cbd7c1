//! Colours that are looked up in a [`ShadeTable`](crate::shading::ShadeTable) along a span.

use super::levels::weighted_mean;
use super::shader::{Shader, SpanShader};
use super::table::TableShader;
use crate::clip::Barycentric;
use crate::raster::{Gradient, Span, Triangle};
use core::iter::repeat_with;
use embedded_graphics_core::pixelcolor::PixelColor;

impl<C: PixelColor> Shader for TableShader<'_, C> {
    type Varying = Barycentric;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        let light = corners.map(|corner| weighted_mean(*self.light(), corner.weights(), 255 << 10));
        self.with_light(light)
    }
}

impl<'t, C: PixelColor> SpanShader<C> for TableShader<'t, C> {
    type Ink = C;
    type Setup = TableGradient<'t, C>;

    fn set_up(&self, triangle: &Triangle<'_>) -> TableGradient<'t, C> {
        TableGradient { colors: self.colors(), light: Gradient::of_light(triangle, self.light()) }
    }

    #[inline(always)]
    fn span(setup: &TableGradient<'t, C>, Span { x, y, .. }: Span) -> impl Iterator<Item = C> {
        let (mut light, step) = (setup.light.at(x, y), setup.light.step());
        repeat_with(move || {
            let color = Self::look_up(setup.colors, light);
            light = light.wrapping_add(step);
            color
        })
    }

    #[inline(always)]
    fn table(&self) -> Option<TableShader<'_, C>> {
        Some(*self)
    }
}

/// A [`TableShader`] set up for a triangle.
#[derive(Debug)]
pub struct TableGradient<'t, C> {
    colors: &'t [C; 256],
    light: Gradient,
}
