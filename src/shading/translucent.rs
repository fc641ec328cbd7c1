//! Translucent faces: colours mixed with the stored pixels.

use super::{CornerValues, FastPath, Shader, SpanShader};
use crate::color::{BlendMode, Unmixed, UnmixedInk};
use crate::raster::{Span, Triangle};
use embedded_graphics_core::pixelcolor::PixelColor;

/// A translucent shader, or a translucent picture of a sprite: its colours are mixed with the stored pixels by a [`BlendMode`]:
/// [`Half`](crate::color::Half), [`Alpha`](crate::color::Alpha), or any function.
///
/// It reads pixels, so it draws into [memory](crate::target::Surface::memory) alone: a [`Picture`](crate::target::Picture), or the pixels of a
/// [`Band`](crate::bands::Band). With another target it does not compile; [`ScreenDoor`](crate::shading::ScreenDoor) draws into every target.
///
/// **Order.** What is behind must be drawn before: opaque faces first, then translucent ones from far to near, by a
/// [`Painter`](crate::draw::Painter) or object by object. Among opaque faces, use a depth buffer and a `Painter` of
/// [`DepthTested`](crate::shading::DepthTested) shaders. Depth is tested and not stored, so a translucent face hides nothing. A convex
/// object needs no painter: draw its back faces ([`Cull::Front`](crate::draw::Cull::Front)), then its front faces.
///
/// **Error.** At most ½ level of each channel: see [`Half`](crate::color::Half) and
/// [`Color::mix`](crate::color::Color::mix).
///
/// ```
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
/// use pinhole::{color::{Alpha, Half}, draw::fill_triangle, prelude::*, raster::ScreenPoint, shading::Translucent};
/// let mut pixels = [Rgb565::new(0, 20, 30); 16];
/// let mut picture = Picture::new(&mut pixels, Size::new(4, 4))?;
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let glass = Translucent::new(Rgb565::new(10, 20, 0), Half);
/// fill_triangle([corner(0, 0), corner(4, 0), corner(0, 4)], glass, &mut picture.pixels())?;
/// assert_eq!(picture.colors()[0], Rgb565::new(5, 20, 15));
///
/// let smoke = Translucent::new(Rgb565::new(1, 4, 31), Alpha::new(8)); // a quarter
/// fill_triangle([corner(0, 0), corner(4, 0), corner(0, 4)], smoke, &mut picture.pixels())?;
/// assert_eq!(picture.colors()[0], Rgb565::new(4, 16, 19));
///
/// let light = Translucent::new(Rgb565::RED, |own: Rgb565, stored: Rgb565| stored.emitting(own));
/// fill_triangle([corner(0, 0), corner(4, 0), corner(0, 4)], light, &mut picture.pixels())?;
/// assert_eq!(picture.colors()[0], Rgb565::new(31, 16, 19));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// The pixels of a display cannot be read, so this does not compile:
///
/// ```compile_fail,E0277
/// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
/// # use pinhole::{color::Half, draw::fill_triangle, raster::ScreenPoint, shading::Translucent};
/// # pub fn draw(corners: [ScreenPoint; 3], display: &mut MockDisplay<Rgb565>) {
/// let Ok(_) = fill_triangle(corners, Translucent::new(Rgb565::RED, Half), display);
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Translucent<S, M> {
    pub(super) shader: S,
    pub(super) mode: M,
}

impl<S, M> Translucent<S, M> {
    /// A shader or picture whose colours are mixed with the stored pixels by a [`BlendMode`].
    pub const fn new(shader: S, mode: M) -> Self {
        Self { shader, mode }
    }
}

impl<S: Shader, M: Copy> Shader for Translucent<S, M> {
    type Varying = S::Varying;
    const NEEDS_DEPTH: bool = S::NEEDS_DEPTH;
    const NEEDS_W: bool = S::NEEDS_W;

    fn sub_face(&self, corners: [S::Varying; 3]) -> Self {
        Self { shader: self.shader.sub_face(corners), ..*self }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { shader: self.shader.with_corners(corners), ..*self }
    }
}

impl<C: PixelColor, S: SpanShader<C, Ink: Unmixed<C>>, M: BlendMode<C>> SpanShader<C> for Translucent<S, M> {
    type Ink = <S::Ink as UnmixedInk<C>>::Mixed<M>;
    type Setup = Translucent<S::Setup, M>;
    type FastPath = Self;

    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup {
        Translucent { shader: self.shader.set_up(triangle), mode: self.mode }
    }

    #[inline(always)]
    fn span(setup: &Self::Setup, span: Span) -> impl Iterator<Item = Self::Ink> {
        let mode = setup.mode; // a copy, in registers
        S::span(&setup.shader, span).map(move |ink| ink.mixed(mode))
    }

    #[inline(always)]
    fn solid(&self) -> Option<Self::Ink> {
        Some(self.shader.solid()?.mixed(self.mode))
    }
}

impl<C: PixelColor, S: SpanShader<C, Ink: Unmixed<C>>, M: BlendMode<C>> FastPath<C, Self>
    for Translucent<S, M>
{
    #[inline(always)]
    fn runs(
        setup: &Translucent<S::Setup, M>,
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = <S::Ink as UnmixedInk<C>>::Mixed<M>>)> {
        let mode = setup.mode; // a copy, in registers
        S::FastPath::runs(&setup.shader, span)
            .map(move |(width, run)| (width, run.map(move |ink| ink.mixed(mode))))
    }
}
