//! Three custom shaders, written with the public interface of `pinhole` alone.

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use pinhole::raster::{Gradient, Span, Triangle};
use pinhole::shading::Barycentric;
use pinhole::{
    color::{BlendMode, Mixed},
    shading::{CornerValues, Shader, SpanShader},
};

/// A perspective-correct checkerboard: tiles are squares in space, so u/w, v/w and 1/w are interpolated on the screen.
#[derive(Clone, Copy)]
pub(crate) struct Checkerboard {
    /// The texture coordinates of the corners, in 2⁻¹⁶ of the board's width and height: 0 … 2¹⁶.
    uv: [[i32; 2]; 3],
    /// Numbers proportional to 1/w at the corners, at most 2²⁴.
    inverse_w: [i32; 3],
    /// The number of tiles along each side.
    tiles: u32,
    colors: [Rgb888; 2],
}

impl Checkerboard {
    pub(crate) fn new(uv: [[i32; 2]; 3], tiles: u32, colors: [Rgb888; 2]) -> Self {
        Self { uv, inverse_w: [0; 3], tiles, colors }
    }
}

impl Shader for Checkerboard {
    type Varying = Barycentric;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        let weighted = |weights: [i32; 3], i: usize| {
            let sum: i64 = weights.iter().zip(self.uv).map(|(&w, uv)| i64::from(w) * i64::from(uv[i])).sum();
            ((sum + (1 << 29)) >> 30).clamp(0, 1 << 16) as i32
        };
        Self { uv: corners.map(|corner| [0, 1].map(|i| weighted(corner.weights(), i))), ..*self }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { inverse_w: corners.inverse_w().map(|w| w >> 7), ..*self }
    }
}

impl SpanShader<Rgb888> for Checkerboard {
    type Ink = Rgb888;
    type Setup = ([Gradient; 3], u32, [Rgb888; 2]);
    type FastPath = ();

    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup {
        // u/w and v/w are at most 1/w.
        let over_w = |i: usize| {
            let products =
                [0, 1, 2].map(|corner| i64::from(self.uv[corner][i]) * i64::from(self.inverse_w[corner]));
            triangle.gradient(products.map(|product| (product >> 16) as u32))
        };
        let inverse_w = triangle.gradient(self.inverse_w.map(|w| w as u32));
        ([over_w(0), over_w(1), inverse_w], self.tiles, self.colors)
    }

    fn span((gradients, tiles, colors): &Self::Setup, span: Span) -> impl Iterator<Item = Rgb888> {
        (span.x..).map(move |x| {
            let [u, v, inverse_w] = gradients.map(|gradient| u64::from(gradient.at(x, span.y)));
            // A division per coordinate and pixel is exact, but slow.
            let tile = |over_w: u64| over_w * u64::from(*tiles) / inverse_w.max(1);
            colors[((tile(u) + tile(v)) % 2) as usize]
        })
    }
}

/// A colour that fades into fog with depth.
#[derive(Clone, Copy)]
pub(crate) struct Fog {
    pub(crate) color: Rgb888,
    pub(crate) fog: Rgb888,
    /// The depths at which fog begins and at which it hides the colour, in steps of the depth buffer.
    pub(crate) range: [u16; 2],
    depths: [i32; 3],
}

impl Fog {
    pub(crate) fn new(color: Rgb888, fog: Rgb888, range: [u16; 2]) -> Self {
        Self { color, fog, range, depths: [0; 3] }
    }
}

impl Shader for Fog {
    type Varying = ();
    const NEEDS_DEPTH: bool = true;

    fn sub_face(&self, _: [(); 3]) -> Self {
        *self
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { depths: corners.depths(), ..*self }
    }
}

impl SpanShader<Rgb888> for Fog {
    type Ink = Rgb888;
    type Setup = (Gradient, Fog);
    type FastPath = ();

    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup {
        (triangle.gradient(self.depths.map(|depth| depth as u32)), *self)
    }

    fn span((depth, fog): &Self::Setup, span: Span) -> impl Iterator<Item = Rgb888> {
        let [begin, end] = fog.range.map(i64::from);
        (span.x..).map(move |x| {
            let depth = i64::from(depth.at(x, span.y) >> 8); // in 1/256 of a step
            let share = ((depth - (begin << 8)) / (end - begin)).clamp(0, 256); // of 256
            let mix = |own: u8, fog: u8| {
                ((i64::from(own) * (256 - share) + i64::from(fog) * share + 128) >> 8) as u8
            };
            let (own, fog) = (fog.color, fog.fog);
            Rgb888::new(mix(own.r(), fog.r()), mix(own.g(), fog.g()), mix(own.b(), fog.b()))
        })
    }
}

/// Glass: half of its own colour, half of the stored pixel.
#[derive(Clone, Copy)]
pub(crate) struct Glass(pub(crate) Rgb888);

impl Shader for Glass {
    type Varying = ();

    fn sub_face(&self, _: [(); 3]) -> Self {
        *self
    }
}

impl SpanShader<Rgb888> for Glass {
    type Ink = Mixed<Rgb888, Halves>;
    type Setup = Rgb888;
    type FastPath = ();

    fn set_up(&self, _: &Triangle<'_>) -> Rgb888 {
        self.0
    }

    fn span(color: &Rgb888, _: Span) -> impl Iterator<Item = Self::Ink> {
        core::iter::repeat(Mixed::new(*color, Halves))
    }
}

/// Half of the shader's own colour, half of the stored pixel.
#[derive(Clone, Copy)]
pub(crate) struct Halves;

impl BlendMode<Rgb888> for Halves {
    fn blend(self, own: Rgb888, stored: Rgb888) -> Rgb888 {
        let half = |a: u8, b: u8| (u16::from(a) + u16::from(b)).div_ceil(2) as u8;
        let [r, g, b] = [RgbColor::r, RgbColor::g, RgbColor::b].map(|of| half(of(&own), of(&stored)));
        Rgb888::new(r, g, b)
    }
}
