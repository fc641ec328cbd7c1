//! Translucent faces: colors mixed with the stored pixels.

use super::{Blend, CornerValues, Shader, SpanShader};
use crate::raster::{Span, Triangle};

/// A translucent shader: half of its color, half of the stored pixel. A pixel takes an addition of both colors, where
/// [`Blended`] multiplies.
///
/// It reads pixels, so it draws into [memory](crate::Target::memory) alone: a [`Picture`](crate::Picture), or the pixels of a
/// [`Band`](crate::Band). With another target it does not compile; [`ScreenDoor`](crate::ScreenDoor) draws into every target.
///
/// **Order.** What is behind has to be drawn before: opaque faces first, then translucent ones from far to near, by a
/// [`Painter`](crate::Painter) (with a depth buffer, of [`DepthTested`](crate::DepthTested) shaders) or object by object. Depth is tested and not stored, so a translucent face hides nothing. Of a
/// convex object, the faces seen from behind ([`Cull::Front`](crate::Cull)) and then those seen from the front are in order.
///
/// **Error.** At most ½ level of each channel: see [`Blend::half`].
///
/// ```
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
/// use pinhole::{fill_triangle, raster::ScreenPoint, HalfBlended, Picture};
/// let mut pixels = [Rgb565::new(0, 20, 30); 16];
/// let mut picture = Picture::new(&mut pixels, Size::new(4, 4))?;
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let glass = HalfBlended::new(Rgb565::new(10, 20, 0));
/// fill_triangle([corner(0, 0), corner(4, 0), corner(0, 4)], glass, &mut picture.pixels())?;
/// assert_eq!(picture.colors()[0], Rgb565::new(5, 20, 15));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// The pixels of a display cannot be read, so this does not compile:
///
/// ```compile_fail
/// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
/// # use pinhole::{fill_triangle, raster::ScreenPoint, HalfBlended};
/// # let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// # let corners = [corner(0, 0), corner(4, 0), corner(0, 4)];
/// let mut display = MockDisplay::<Rgb565>::new();
/// fill_triangle(corners, HalfBlended::new(Rgb565::RED), &mut display)?;
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HalfBlended<S>(S);

impl<S> HalfBlended<S> {
    /// A shader whose colors are mixed with the stored pixels in equal parts.
    pub const fn new(shader: S) -> Self {
        Self(shader)
    }

    /// The shader whose colors are mixed with the stored pixels.
    #[inline(always)]
    pub(super) const fn shader(&self) -> &S {
        &self.0
    }
}

impl<S: Shader> Shader for HalfBlended<S> {
    type Varying = S::Varying;
    const NEEDS_DEPTH: bool = S::NEEDS_DEPTH;
    const NEEDS_W: bool = S::NEEDS_W;

    fn sub_face(&self, corners: [S::Varying; 3]) -> Self {
        Self(self.0.sub_face(corners))
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self(self.0.with_corners(corners))
    }
}

impl<C: Blend, S: SpanShader<C>> SpanShader<C> for HalfBlended<S> {
    type Setup = S::Setup;
    const LEAVES_OUT: bool = S::LEAVES_OUT;
    const WRITES_DEPTH: bool = false;
    const BLENDS: bool = true;

    fn set_up(&self, triangle: &Triangle<'_>) -> S::Setup {
        const { assert!(!S::READS_PIXELS && !S::BLENDS, "this shader is translucent already") };
        self.0.set_up(triangle)
    }

    #[inline(always)]
    fn span(setup: &S::Setup, span: Span) -> impl Iterator<Item = C> {
        S::span(setup, span)
    }

    #[inline(always)]
    fn kept(setup: &S::Setup, span: Span) -> impl Iterator<Item = (i32, impl Iterator<Item = Option<C>>)> {
        S::kept(setup, span)
    }

    #[inline(always)]
    fn blend(_: &S::Setup, own: C, stored: C) -> C {
        own.half(stored)
    }

    #[inline(always)]
    fn blender(_: &S::Setup) -> impl Fn(C, C) -> C + Copy {
        C::half
    }

    #[inline(always)]
    fn solid_color(&self) -> Option<C> {
        self.0.solid_color()
    }
}

/// A translucent shader: `alpha` 32nds of its color, and the rest of the stored pixel.
///
/// What [`HalfBlended`] says of targets, order and depth is so here, too.
///
/// **Error.** At most ½ level of each channel: see [`Blend::mix`].
///
/// ```
/// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
/// use pinhole::{fill_triangle, raster::ScreenPoint, Blended, Picture};
/// let mut pixels = [Gray8::new(100); 16];
/// let mut picture = Picture::new(&mut pixels, Size::new(4, 4))?;
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let smoke = Blended::new(Gray8::new(200), 8); // a quarter
/// fill_triangle([corner(0, 0), corner(4, 0), corner(0, 4)], smoke, &mut picture.pixels())?;
/// assert_eq!([picture.colors()[0], picture.colors()[15]], [Gray8::new(125), Gray8::new(100)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Blended<S> {
    shader: S,
    /// 0 … 32.
    alpha: u8,
}

impl<S> Blended<S> {
    /// A shader whose colors are mixed with the stored pixels by `alpha`, in 1/32: 0 leaves the stored pixels as they are, 32 is
    /// the shader itself (more counts as 32).
    pub const fn new(shader: S, alpha: u8) -> Self {
        Self { shader, alpha: if alpha < 32 { alpha } else { 32 } }
    }

    /// The shader whose colors are mixed with the stored pixels.
    #[inline(always)]
    pub(super) const fn shader(&self) -> &S {
        &self.shader
    }

    /// The part of the shader's color: 0 … 32.
    #[inline(always)]
    pub(super) const fn alpha(&self) -> u8 {
        self.alpha
    }
}

impl<S: Shader> Shader for Blended<S> {
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

/// A [`Blended`] shader set up for a triangle.
#[derive(Clone, Copy, Debug)]
pub struct BlendedSetup<P> {
    own: P,
    alpha: u8,
}

impl<C: Blend, S: SpanShader<C>> SpanShader<C> for Blended<S> {
    type Setup = BlendedSetup<S::Setup>;
    const LEAVES_OUT: bool = S::LEAVES_OUT;
    const WRITES_DEPTH: bool = false;
    const BLENDS: bool = true;

    fn set_up(&self, triangle: &Triangle<'_>) -> BlendedSetup<S::Setup> {
        const { assert!(!S::READS_PIXELS && !S::BLENDS, "this shader is translucent already") };
        BlendedSetup { own: self.shader.set_up(triangle), alpha: self.alpha }
    }

    #[inline(always)]
    fn span(setup: &BlendedSetup<S::Setup>, span: Span) -> impl Iterator<Item = C> {
        S::span(&setup.own, span)
    }

    #[inline(always)]
    fn kept(
        setup: &BlendedSetup<S::Setup>,
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = Option<C>>)> {
        S::kept(&setup.own, span)
    }

    #[inline(always)]
    fn blend(setup: &BlendedSetup<S::Setup>, own: C, stored: C) -> C {
        own.mix(stored, setup.alpha)
    }

    #[inline(always)]
    fn blender(setup: &BlendedSetup<S::Setup>) -> impl Fn(C, C) -> C + Copy {
        let alpha = setup.alpha;
        move |own, stored| own.mix(stored, alpha)
    }

    #[inline(always)]
    fn solid_color(&self) -> Option<C> {
        self.shader.solid_color()
    }
}
