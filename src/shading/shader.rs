//! The traits of shaders: what a face is filled with.

use super::CornerValues;
use crate::clip::Varying;
use crate::color::{Ink, InkKind};
use crate::raster::{Gradient, Span, Triangle};
use crate::shading::TableShader;
use core::iter::{once, repeat};
use embedded_graphics_core::pixelcolor::PixelColor;

/// What a face is filled with: a colour, or colours that vary over the face. Every draw call takes a closure that returns a
/// shader for each face. A shader also implements [`SpanShader`], which computes the colours of pixels.
///
/// Every `PixelColor` is a shader, at no extra cost. [`Flat`](crate::shading::Flat) and [`Gouraud`](crate::shading::Gouraud) take `Rgb888`
/// colours for targets of any colour type, dithered or not; [`ShadeTable::lit`](crate::shading::ShadeTable::lit) looks colours up in 256
/// levels of light.
///
/// One colour for the mesh, one per face, and one per vertex differ only in the closure:
///
/// ```
/// use embedded_graphics::{pixelcolor::{Rgb565, Rgb888}, prelude::*};
/// use pinhole::{prelude::*, Angle};
/// // A roof: two faces that meet in an edge, with normals of the faces and of the vertices.
/// const VERTICES: [[i16; 3]; 4] = [[0, -4, 0], [0, 4, 0], [-4, 0, -3], [4, 0, -3]];
/// const FACES: [[u16; 3]; 2] = [[0, 1, 2], [1, 0, 3]];
/// const NORMALS: [[i16; 3]; 2] = [[-19660, 0, 26214], [19660, 0, 26214]];
/// const VERTEX_NORMALS: [[i16; 3]; 4] = [[0, 0, 32767], [0, 0, 32767], NORMALS[0], NORMALS[1]];
/// let mesh = Mesh::new(&VERTICES, 0, &FACES)?.with_normals(&NORMALS)?.with_vertex_normals(&VERTEX_NORMALS)?;
/// let viewport = Viewport::new(Point::zero(), Size::new(48, 48))?;
/// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(60), Angle::ZERO, Angle::ZERO)?;
/// let model = Affine::<Model, World>::identity();
/// let instance = camera.place(&mesh, &model);
/// let light = Lambert::new(&model, Vector3::from_ints(-1, 0, 2), 64)?;
/// let mut levels = [0; VERTICES.len()];
/// light.levels(mesh.vertex_normals(), &mut levels);
/// let (paint, heights) = ([Rgb565::RED, Rgb565::WHITE], [Rgb888::RED, Rgb888::RED, Rgb888::BLUE, Rgb888::GREEN]);
/// let mut pixels = [Rgb565::BLACK; 48 * 48];
/// let mut picture = Picture::new(&mut pixels, viewport.size())?;
///
/// // The mesh in one colour.
/// instance.faces(|_| Rgb565::CYAN).draw(&mut picture.pixels())?;
/// // A colour for each face, at the light of its normal.
/// instance.faces(|face| paint[face].dim(light.level(mesh.normals()[face]))).draw(&mut picture.pixels())?;
/// // The light at each vertex, computed once; smooth in between.
/// let smooth = |face| Dithered(Gouraud::lit(Rgb888::CSS_GOLD, mesh.corners_of(face, &levels)));
/// instance.faces(smooth).draw(&mut picture.pixels())?;
/// // A colour for each vertex.
/// instance.faces(|face| Gouraud::new(mesh.corners_of(face, &heights))).draw(&mut picture.pixels())?;
/// # let shown: std::collections::BTreeSet<_> = pixels.iter().map(|c| c.into_storage()).collect();
/// # assert!(shown.len() > 16);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "faces cannot be filled with `{Self}`",
    label = "not a color or a shader",
    note = "return the target's color type, a shader such as `Flat`, `Gouraud`, `Lit` or `Dithered`, or implement `Shader` and `SpanShader` for your own"
)]
pub trait Shader: Copy {
    /// The varying of a corner: what clipping interpolates where a plane cuts an edge of the face. Use `()` if nothing varies
    /// from corner to corner, [`Barycentric`](crate::shading::Barycentric) to get the weights of the new corners, or your own
    /// type.
    type Varying: Varying;

    /// Whether the shader needs the depths of a triangle's corners, in [`with_corners`](Self::with_corners). If true, draw calls in one
    /// piece transform vertices with depth and clip at the far plane; in bands, faces of `transform` do not build with it.
    const NEEDS_DEPTH: bool = false;

    /// Whether the shader needs 1/w of a triangle's corners, in [`with_corners`](Self::with_corners), for perspective-correct
    /// interpolation.
    const NEEDS_W: bool = false;

    /// The shader of a sub-face, one triangle of a clipped face, from the varyings of the sub-face's corners.
    #[must_use]
    fn sub_face(&self, corners: [Self::Varying; 3]) -> Self;

    /// The shader of a triangle (a face or a sub-face) with the depths and 1/w of its corners. Called only if
    /// [`NEEDS_DEPTH`](Self::NEEDS_DEPTH) or [`NEEDS_W`](Self::NEEDS_W) is true: once for each triangle, after
    /// [`sub_face`](Self::sub_face) and before [`set_up`](SpanShader::set_up). A [`Painter`](crate::draw::Painter) stores the shader
    /// that this returns.
    #[must_use]
    fn with_corners(&self, corners: &CornerValues) -> Self {
        let _ = corners;
        *self
    }
}

/// A [`Shader`] for targets whose pixels have the colour type `C`. It is set up once for each triangle and then returns the
/// colours of each span.
///
/// Example of a custom shader, which interpolates a grey value from corner to corner; [`span`](Self::span) has one that leaves out pixels, and
/// `examples/shader` three more: a
/// perspective-correct checkerboard, depth fog, and a blend with the stored pixels.
///
/// ```
/// use embedded_graphics::{pixelcolor::{Gray8, GrayColor}, prelude::*};
/// use pinhole::{draw::fill_triangle, raster::{Gradient, ScreenPoint, Span, Triangle}};
/// use pinhole::{shading::{Barycentric, Shader, SpanShader}, target::Picture};
/// #[derive(Clone, Copy)]
/// struct Ramp([u8; 3]);
///
/// impl Shader for Ramp {
///     type Varying = Barycentric;
///     fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
///         Self(corners.map(|corner| {
///             let sum: i64 = corner.weights().iter().zip(self.0).map(|(&w, c)| i64::from(w) * i64::from(c)).sum();
///             (sum >> 30) as u8
///         }))
///     }
/// }
///
/// impl SpanShader<Gray8> for Ramp {
///     type Ink = Gray8;
///     type Setup = Gradient;
///     type FastPath = ();
///     fn set_up(&self, triangle: &Triangle) -> Gradient {
///         triangle.gradient(self.0.map(|c| u32::from(c) << 16)) // 8.16 at the corners, 8.24 at pixels
///     }
///     fn span(gradient: &Gradient, span: Span) -> impl Iterator<Item = Gray8> {
///         (span.x..).map(move |x| Gray8::new((gradient.at(x, span.y) >> 24) as u8))
///     }
/// }
/// let mut pixels = [Gray8::BLACK; 32 * 32];
/// let mut picture = Picture::new(&mut pixels, Size::new(32, 32))?;
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let Ok(()) = fill_triangle([corner(0, 0), corner(0, 32), corner(32, 0)], Ramp([40, 240, 140]), &mut picture.pixels());
/// assert_eq!([0, 16 * 32, 16, 10 * 32 + 10].map(|i: usize| pixels[i].luma()), [44, 144, 94, 138]);
/// # Ok::<(), pinhole::target::BufferError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "faces of a target of `{C}` cannot be filled with `{Self}`",
    label = "not `{C}` or a shader for it",
    note = "return `{C}`, the target's color type, from the closure; for other colors return `Flat::from` of them or a `Gouraud`, which convert to the target's"
)]
pub trait SpanShader<C: PixelColor>: Shader {
    /// What the shader gives for a pixel: `C` itself, `Option<C>` if it leaves out pixels, [`Mixed`](crate::color::Mixed) if its colours are
    /// mixed with the stored pixels.
    type Ink: Ink<C>;

    /// The result of [`set_up`](Self::set_up), usually gradients.
    type Setup;

    /// Write `()`: only shaders of this crate have faster twins of [`span`](Self::span) for targets whose pixels lie in memory.
    type FastPath: FastPath<C, Self>;

    /// Whether draw calls with a depth buffer store the depth of the pixels that they draw. If false, they only test it: for
    /// translucent faces, behind which others may still be seen. The default is false for inks that are mixed.
    const WRITES_DEPTH: bool = !<Self::Ink as InkKind<C>>::READS;

    /// Sets up the shader for a triangle, whose corners are in the order of the face's vertices.
    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup;

    /// The inks of a span, one row high, from left to right: at least `span.width` of them. Spans contain only pixels that
    /// the triangle covers. May be called more than once for a pixel, and must give equal inks.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor};
    /// use pinhole::{draw::fill_triangle, raster::{ScreenPoint, Span, Triangle}, shading::{Shader, SpanShader}};
    /// /// Every third column of a face.
    /// #[derive(Clone, Copy)]
    /// struct Bars;
    /// impl Shader for Bars {
    ///     type Varying = ();
    ///     fn sub_face(&self, _: [(); 3]) -> Self {
    ///         *self
    ///     }
    /// }
    /// impl SpanShader<BinaryColor> for Bars {
    ///     type Ink = Option<BinaryColor>;
    ///     type Setup = ();
    ///     type FastPath = ();
    ///     fn set_up(&self, _: &Triangle<'_>) {}
    ///     fn span(_: &(), span: Span) -> impl Iterator<Item = Option<BinaryColor>> {
    ///         (span.x..).map(|x| (x % 3 == 0).then_some(BinaryColor::On))
    ///     }
    /// }
    /// let mut display = MockDisplay::new();
    /// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
    /// fill_triangle([corner(0, 0), corner(7, 0), corner(0, 7)], Bars, &mut display)?;
    /// display.assert_pattern(&["#  # ", "#  # ", "#  # ", "#    ", "#    ", "#    "]);
    /// # Ok::<(), core::convert::Infallible>(())
    /// ```
    fn span(setup: &Self::Setup, span: Span) -> impl Iterator<Item = Self::Ink>;

    /// The ink of all pixels, if the shader has only one. Then [`span`](Self::span) is not called, and neither is
    /// [`set_up`](Self::set_up) if the ink is a colour: faces are filled faster.
    #[inline(always)]
    fn solid(&self) -> Option<Self::Ink> {
        None
    }
}

/// The fast paths of the shader `S`: inks equal to those of [`SpanShader::span`], computed in less time. `()` has none.
pub trait FastPath<C: PixelColor, S: SpanShader<C>> {
    /// The inks of a span as runs, from left to right: the width of each run, and its inks, at least that many. Override it
    /// if inks are cheap to compute within a run but not from run to run. For targets whose pixels lie in memory it is called
    /// instead of `span`, and must give equal inks.
    #[inline(always)]
    fn runs(setup: &S::Setup, span: Span) -> impl Iterator<Item = (i32, impl Iterator<Item = S::Ink>)> {
        once((span.width, S::span(setup, span)))
    }

    /// The ink of a pixel as a function of the numbers that [`lines`](Self::lines) returns, if inks are such: texels at texture
    /// coordinates. Then targets whose pixels lie in memory take `lines` instead of [`runs`](Self::runs), and write colours eight at a
    /// time. Inks must equal those of `runs`.
    #[inline(always)]
    fn look_up(setup: &S::Setup) -> Option<impl Fn([u32; 2]) -> S::Ink + Copy> {
        let _ = setup;
        None::<fn([u32; 2]) -> S::Ink>
    }

    /// Whether the function that [`look_up`](Self::look_up) returns differs from run to run: see
    /// [`look_up_in_run`](Self::look_up_in_run).
    const BY_RUN: bool = false;

    /// [`look_up`](Self::look_up) for a run, given the second number at its first pixel. Called if [`BY_RUN`](Self::BY_RUN).
    #[inline(always)]
    fn look_up_in_run(setup: &S::Setup, second: u32) -> Option<impl Fn([u32; 2]) -> S::Ink + Copy> {
        let _ = second;
        Self::look_up(setup)
    }

    /// Whether [`look_up`](Self::look_up) needs the first number alone, so that a wrapper may put the second one to a use of its own, as
    /// fog does.
    const ONE_NUMBER: bool = false;

    /// The runs of a span for [`look_up`](Self::look_up), from left to right: the width of each, two numbers at its first pixel, and
    /// their changes from a pixel to the next, to be added wrapping.
    #[inline(always)]
    fn lines(setup: &S::Setup, span: Span) -> impl Iterator<Item = (i32, [[u32; 2]; 2])> {
        let _ = (setup, span);
        core::iter::empty()
    }

    /// The gradient of the first number of [`lines`](Self::lines), if the ink of each pixel of the triangle is
    /// [`look_up`](Self::look_up) of it and any second number. Small triangles are then filled faster.
    #[inline(always)]
    fn ramp(setup: &S::Setup) -> Option<&Gradient> {
        let _ = setup;
        None
    }

    /// A [`TableShader`] that draws equal pixels, if there is one. Targets with memory draw it by a faster
    /// loop, instead of calling `set_up` and `span`.
    #[inline(always)]
    fn table(shader: &S) -> Option<TableShader<'_, C>> {
        let _ = shader;
        None
    }

    /// The colours of all pixels by their depths, if they depend on nothing else. Targets whose pixels lie in memory fill each row
    /// level by level, instead of calling `set_up` and `span`, which must find equal levels, by
    /// `Triangle::depth_gradient`.
    #[inline(always)]
    fn levels(shader: &S) -> Option<DepthLevels<'_, impl Fn(u8) -> C + Copy>> {
        let _ = shader;
        None::<DepthLevels<'_, fn(u8) -> C>>
    }

    /// A shader that draws equal pixels in less time, if there is one: of a wrapper that changes nothing over this triangle, the
    /// shader inside. Targets whose pixels lie in memory draw it instead.
    #[inline(always)]
    fn inner(shader: &S) -> Option<&impl SpanShader<C, Ink = S::Ink>> {
        let _ = shader;
        None::<&S>
    }
}

impl<C: PixelColor, S: SpanShader<C>> FastPath<C, S> for () {}

/// Colours by depth, in levels, as [`FastPath::levels`] returns them: the fog of [`Fogged`](crate::fog::Fogged).
#[derive(Clone, Copy, Debug)]
pub struct DepthLevels<'t, F> {
    /// At the triangle's corners, in 16.8, as [`CornerValues::depths`] has them.
    pub depths: [i32; 3],
    /// Level l is seen from depth `bounds[l]` on and before `bounds[l + 1]`: depths at pixels in 16.16, in ascending order, from 0 to
    /// `u32::MAX`. There are 33 levels, of which any may be empty.
    pub bounds: &'t [u32; 34],
    /// Any level of the triangle, where the search for others begins: 0 … 32.
    pub first: u8,
    /// The colour of a level.
    pub color: F,
}

defmt_format!([F] DepthLevels<'_, F>, self, "colours by depths {} from {}/2^16", self.depths, self.bounds);

/// Calls [`Shader::with_corners`] of a wrapped shader; a shader that asks for nothing is returned as it is.
#[inline(always)]
pub(super) fn inner_with_corners<S: Shader>(shader: &S, corners: &CornerValues) -> S {
    match S::NEEDS_DEPTH || S::NEEDS_W {
        true => shader.with_corners(corners),
        false => *shader,
    }
}

impl<C: PixelColor> Shader for C {
    type Varying = ();

    fn sub_face(&self, _: [(); 3]) -> Self {
        *self
    }
}

impl<C: PixelColor> SpanShader<C> for C {
    type Ink = C;
    type Setup = C;
    type FastPath = ();

    #[inline(always)]
    fn set_up(&self, _: &Triangle<'_>) -> C {
        *self
    }

    #[inline(always)]
    fn span(color: &C, _: Span) -> impl Iterator<Item = C> {
        repeat(*color)
    }

    #[inline(always)]
    fn solid(&self) -> Option<C> {
        Some(*self)
    }
}
