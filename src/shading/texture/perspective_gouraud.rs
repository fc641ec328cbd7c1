//! Gouraud shading in perspective: the weights of a face's corners are its texture coordinates.

use super::linear::{is_linear, range};
use super::mapping::{Accuracy, FaceCoords, FRACTION};
use super::perspective::Perspective;
use super::runs::{AboutColumn, PerspectiveRuns};
use crate::clip::Barycentric;
use crate::color::Color;
use crate::math::num::{leading_zeros, mul_wide};
use crate::math::unrolled::map3;
use crate::raster::{Gradient, GradientSetup, Span, Triangle};
use crate::shading::gouraud::{Rounding, SpanColors, SATURATING_BITS};
use crate::shading::levels::{each, fraction_bits, levels};
use crate::shading::{Bayer, CornerValues, Dithered, FastPath, Gouraud, Nearest, Shader, SpanShader};

/// Gouraud shading in perspective: a colour at each corner of a face, interpolated in space. [`Gouraud::in_perspective`] makes it.
///
/// **Error.** A channel of a pixel is that of a point of the face within 1/64 pixel of the pixel's centre, rounded to the nearest level
/// of the target: off by at most ½ + ¼ + 1/64 level, asserted up to a ratio of 1200 between the largest and the least w of a face; from there on, the
/// error of the planes that [`Texture`](crate::texture::Texture) states may add 2⁻¹² level times this ratio.
///
/// Where linear interpolation is off by less than ¼ level, it is used. Elsewhere, the weights of two corners are interpolated as [`Texture`](crate::texture::Texture) interpolates texture coordinates: divided by 1/w at both
/// ends of a run of pixels over which the colour departs from a line by at most ¼ level.
///
/// A floor over a picture of 240 × 240 pixels takes 1.17 times the instructions of [`Gouraud`] on a Cortex-M3 (cells X2 `gouraud` and
/// `perspective`), 13.5 a pixel.
///
/// **Clipped faces** have the colours of the whole face, rounded to 1/256 of a step of `Rgb888` at new corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PerspectiveGouraud {
    corners: Gouraud,
    /// w of the corners, in any unit: equal until a draw call passes the corners' own.
    w: [i32; 3],
}

impl Gouraud {
    /// The shader of a face whose colours are interpolated in perspective, for faces that reach close to the eye.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::{Gray8, GrayColor, Rgb888}, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// // A floor below the eye, black at a distance of 1 and white at 9.
    /// let mesh = Mesh::new(&[[-9, -1, -1], [9, -1, -1], [9, -1, -9], [-9, -1, -9]], 0, &[[0, 1, 2], [0, 2, 3]])?;
    /// const COLORS: [Rgb888; 4] = [Rgb888::BLACK, Rgb888::BLACK, Rgb888::WHITE, Rgb888::WHITE];
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let (eye, ahead) = (Point3::from_ints(0, 0, 0), Point3::from_ints(0, 0, -1));
    /// let camera = Camera::new(
    ///     &ViewTransform::look_at(eye, ahead, Vector3::from_ints(0, 1, 0))?,
    ///     &Projection::perspective(Angle::degrees(90), viewport.size(), Scalar::from_ratio(1, 2), Scalar::from_int(20))?,
    ///     &viewport,
    /// );
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let shade = |face| Gouraud::new(mesh.corners_of(face, &COLORS)).in_perspective();
    /// let mut pixels = [Gray8::BLACK; 64 * 64];
    /// instance.faces(shade).draw(&mut Picture::new(&mut pixels, viewport.size())?.pixels())?;
    /// // Row 47 shows a distance of 32/15.5: 255 · 1.06/8. Interpolated on the screen, 255 · 0.58.
    /// assert_eq!(pixels[47 * 64 + 32], Gray8::new(34));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub const fn in_perspective(self) -> PerspectiveGouraud {
        PerspectiveGouraud { corners: self, w: [1; 3] }
    }
}

impl Shader for PerspectiveGouraud {
    type Varying = Barycentric;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        Self { corners: self.corners.sub_face(corners), ..*self }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { w: corners.w, ..*self }
    }
}

/// The fractional bits of weights, whose side is 2⁷: 32 times a weight, the most by which a column beside the triangle may show it,
/// has 31 bits with the sign.
const WEIGHT_BITS: u32 = 25;

/// The levels of the channels over a triangle, without their [`SATURATING_BITS`].
#[derive(Clone, Copy, Debug)]
pub enum LevelGradients {
    /// Linear on the screen.
    Linear([Gradient; 3]),
    /// Linear over each row.
    Rows(Weights),
    /// In runs.
    Perspective(Weights),
}

/// The weights of the second and the third corner over a triangle, as u and v, and the levels of each channel at the first corner
/// and from there to these two: 24 bits, and the sign.
#[derive(Clone, Copy, Debug)]
pub struct Weights {
    planes: Perspective,
    channels: [[i32; 3]; 3],
}

impl Weights {
    /// The levels of the channels at the first pixel of a run, and their changes from a pixel to the next.
    #[inline(always)]
    fn line<C: Color>(&self, AboutColumn { at, step, by }: AboutColumn) -> [[u32; 3]; 2] {
        let change = |[u, v]: [u32; 2], [_, to_second, to_third]: [i32; 3]| {
            // Below 2³¹ · 2²⁵; levels wrap where no pixel is shown.
            let product = mul_wide(u as i32, to_second) + mul_wide(v as i32, to_third);
            (product >> (WEIGHT_BITS - 8 + SATURATING_BITS)) as u32
        };
        let steps = each::<C, _, _>(self.channels, |channel, _| change(step, channel));
        let about = each::<C, _, _>(self.channels, |channel @ [first, ..], _| {
            ((first as u32) << (8 - SATURATING_BITS)).wrapping_add(change(at, channel))
        });
        let ([a, b, c], [d, e, f]) = (about, steps);
        let along = |(level, step): (u32, u32), _| level.wrapping_add(step.wrapping_mul(by as u32));
        [each::<C, _, _>([(a, d), (b, e), (c, f)], along), steps]
    }
}

impl PerspectiveGouraud {
    #[inline(never)] // its stack frame is gone when it returns
    fn gradients<C: Color>(&self, triangle: &Triangle<'_>) -> LevelGradients {
        let Gouraud(colors) = self.corners;
        let [[a, d, g], [b, e, h], [c, f, i]] = map3(colors, levels::<C>);
        let corners = [[a, b, c], [d, e, f], [g, h, i]];
        // With 16 fractional bits.
        let fractions = |value: i32, max: u8| (value >> (fraction_bits(max) - 24)) as u32;
        let most = |of: &dyn Fn([i32; 3]) -> i32| {
            let [a, b, c] = each::<C, _, _>(corners, |values, max| fractions(of(values), max));
            a.max(b).max(c)
        };
        let extent = most(&|values| range(&values).1);
        let (nearest, apart) = range(&self.w);
        // |ΔL·Δw| ≤ w, in 2²⁸: the level is off by ¼ at most.
        if is_linear(extent, apart as u32, nearest, 12) {
            let setup = GradientSetup::called(triangle);
            let less = |value: i32| (value + (1 << SATURATING_BITS >> 1)) >> SATURATING_BITS;
            return LevelGradients::Linear(each::<C, _, _>(corners, |values, _| {
                setup.through(&map3(values, less))
            }));
        }
        let channels = map3(corners, |[a, b, c]| [a, b - a, c - a]);
        let change = most(&|[a, b, c]| (b - a).abs() + (c - a).abs());
        // Weights off by 2^−(bits + 2) of a weight, which Quarter is of a side of 2⁷ with `bits` + 7, move levels by less than ¼.
        let bits = 32 - leading_zeros(change >> 16); // 0 … 9
        let one = 1 << (WEIGHT_BITS + FRACTION - 16);
        let coords = FaceCoords {
            uv: [[0, 0], [one, 0], [0, one]],
            w: self.w,
            unit: [16; 2],
            accuracy: Accuracy::Quarter,
        };
        Perspective::set_up(&coords, [bits as u8 + 7; 2], triangle, |is_by_rows, planes| {
            let weights = Weights { planes, channels };
            match is_by_rows {
                true => LevelGradients::Rows(weights),
                false => LevelGradients::Perspective(weights),
            }
        })
    }
}

#[inline(always)]
fn runs<C: Color, R: Rounding>(
    gradients: &LevelGradients,
    span: Span,
) -> impl Iterator<Item = (i32, SpanColors<C, R, true>)> {
    let Span { x, y, width, .. } = span;
    let (mut only, mut several) = match gradients {
        LevelGradients::Linear(levels) => {
            (Some([map3(*levels, |level| level.at(x, y)), map3(*levels, |level| level.step())]), None)
        }
        LevelGradients::Rows(weights) => {
            (Some(weights.line::<C>(AboutColumn::by_row(&weights.planes, span))), None)
        }
        LevelGradients::Perspective(weights) => {
            (None, Some((weights, PerspectiveRuns::new(&weights.planes, span))))
        }
    };
    let mut next = x;
    core::iter::from_fn(move || {
        let (width, [levels, steps]) = match &mut several {
            Some((weights, runs)) => {
                let (width, about) = runs.next_about_middle()?;
                (width, weights.line::<C>(about))
            }
            None => (width, only.take()?),
        };
        let colors = SpanColors::new(levels, steps, (next, y));
        next += width;
        Some((width, colors))
    })
}

macro_rules! in_perspective {
    ($shader:ty, $rounding:ty, |$own:ident| $corners:expr) => {
        impl<C: Color> SpanShader<C> for $shader {
            type Ink = C;
            type Setup = LevelGradients;
            type FastPath = Self;

            fn set_up(&self, triangle: &Triangle<'_>) -> LevelGradients {
                let $own = self;
                $corners.gradients::<C>(triangle)
            }

            fn span(gradients: &LevelGradients, span: Span) -> impl Iterator<Item = C> {
                runs::<C, $rounding>(gradients, span).flat_map(|(width, colors)| colors.take(width as usize))
            }
        }

        impl<C: Color> FastPath<C, Self> for $shader {
            #[inline(always)]
            fn runs(
                gradients: &LevelGradients,
                span: Span,
            ) -> impl Iterator<Item = (i32, impl Iterator<Item = C>)> {
                runs::<C, $rounding>(gradients, span)
            }
        }
    };
}

in_perspective!(PerspectiveGouraud, Nearest, |own| own);
in_perspective!(Dithered<PerspectiveGouraud>, Bayer, |own| own.0);
