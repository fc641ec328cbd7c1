//! Shaders for a display whose format is known only when the page runs. All formats share one copy of the code that draws faces,
//! so that the library for browsers is small: a colour is stored as its bits, and a shader is set up for its format by a call at
//! run time.

use crate::display::{Format, Shown};
use crate::tricolor::Tricolor;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::pixelcolor::raw::RawU16;
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray2, Gray4, PixelColor, Rgb565, Rgb888};
use pinhole::draw::SmoothEdges;
use pinhole::raster::{Span, Triangle};
use pinhole::shading::{Barycentric, Lit};
use pinhole::{
    prelude::*,
    shading::{CornerValues, Shader, SpanShader},
    texture::{IndexedTexels, LitTextured, Texels},
};

/// The bits of a display's colour, of at most 16.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stored(u16);

impl PixelColor for Stored {
    type Raw = RawU16;
}

impl Color for Stored {
    const FORMAT: pinhole::color::Format = pinhole::color::Format::indexed(16, [0; 3]);

    fn to_bits(self) -> u32 {
        self.0.into()
    }

    fn from_bits(bits: u32) -> Self {
        Self(bits as u16) // of 16 bits
    }
}

impl Stored {
    fn of(color: impl Color) -> Self {
        Self(color.to_bits() as u16) // no format of a display here has more bits
    }
}

/// Calls a generic function with the colour type of a format.
macro_rules! by_format {
    ($format:expr, $color:ident => $call:expr) => {
        by_format!($format, $color => $call, Rgb565 Rgb565, Mono BinaryColor, Gray2 Gray2, Gray4 Gray4, Tricolor Tricolor)
    };
    ($format:expr, $color:ident => $call:expr, $($variant:ident $type:ty),*) => {
        match $format {$(
            Format::$variant => {
                type $color = $type;
                $call
            }
        )*}
    };
}

impl Format {
    /// The bits of the nearest colour.
    pub(crate) fn store(self, color: Rgb888) -> Stored {
        by_format!(self, C => Stored::of(C::from(color)))
    }

    /// The colour that bits show.
    pub(crate) fn shown(self, color: Stored) -> Rgb888 {
        by_format!(self, C => C::from_bits(color.to_bits()).into())
    }

    /// The bytes of `rows` rows of `width` pixels.
    pub(crate) fn bytes(self, width: u32, rows: u32) -> usize {
        by_format!(self, C => pinhole::bands::Frame::<C>::strip_bytes(width, rows))
    }

    /// The nearest colour at a level of light. Formats of few colours have no shades, so their colours are not dimmed.
    pub(crate) fn dimmed(self, color: Rgb888, level: u16) -> Stored {
        match self {
            Self::Rgb565 => Stored::of(Rgb565::from(color).dim(level)),
            Self::Gray2 => Stored::of(Gray2::from(color).dim(level)),
            Self::Gray4 => Stored::of(Gray4::from(color).dim(level)),
            Self::Mono | Self::Tricolor => self.store(color),
        }
    }
}

/// Smooths edges in a picture of bits, in the display's own colours.
fn smooth<C: Shown>(
    edges: &mut SmoothEdges<'_>,
    picture: &mut Band<'_, Stored>,
    depth: &mut DepthBuffer<'_>,
) {
    let (area, colors) = (picture.area(), picture.colors().map(|color| C::from_bits(color.to_bits())));
    let mut pixels: Vec<C> = colors.collect();
    if let Ok(mut own) = pinhole::target::Picture::new(&mut pixels, area.size) {
        own.pixels().depth_tested(depth).smooth(|pass| edges.draw(pass));
    }
    let Ok(()) = picture.fill_contiguous(&area, pixels.into_iter().map(Stored::of));
}

impl Format {
    /// Smooths edges in a picture with its depths, if the format [mixes](Self::mixes) colours.
    pub(crate) fn smooth(
        self,
        edges: &mut SmoothEdges<'_>,
        picture: &mut Band<'_, Stored>,
        depth: &mut DepthBuffer<'_>,
    ) {
        match self {
            Self::Rgb565 => smooth::<Rgb565>(edges, picture, depth),
            // Levels are mixed as numbers, however many there are.
            Self::Gray2 | Self::Gray4 => smooth::<Gray4>(edges, picture, depth),
            Self::Mono | Self::Tricolor => {}
        }
    }
}

/// The texels of a picture, in the colours of a display.
#[derive(Clone, Copy)]
pub(crate) struct Picture<'t> {
    pub(crate) texels: IndexedTexels<'t, Rgb888, 8>,
    pub(crate) format: Format,
}

impl Texels for Picture<'_> {
    type Color = Stored;
    type Ink = Stored;
    type FastPath = ();

    fn size_bits(&self) -> [u32; 2] {
        self.texels.size_bits()
    }

    fn texel(&self, u: u32, v: u32) -> Stored {
        self.format.store(self.texels.texel(u, v))
    }

    fn lit_texel(&self, u: u32, v: u32, level: u32) -> Stored {
        // As the library dims texels: the level becomes 0 … 256, at most ½ from level·256/255.
        self.format.dimmed(self.texels.texel(u, v), (level + (level >> 7)) as u16)
    }
}

/// The content of a face.
#[derive(Clone, Copy)]
pub(crate) enum Paint<'t> {
    Plain(Stored),
    Dithered(Format, Flat),
    Smooth(Format, Lit),
    SmoothDithered(Format, Lit),
    Textured(LitTextured<Picture<'t>>),
}

impl Shader for Paint<'_> {
    type Varying = Barycentric;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        match *self {
            Self::Plain(_) | Self::Dithered(..) => *self,
            Self::Smooth(format, lit) => Self::Smooth(format, lit.sub_face(corners)),
            Self::SmoothDithered(format, lit) => Self::SmoothDithered(format, lit.sub_face(corners)),
            Self::Textured(textured) => Self::Textured(textured.sub_face(corners)),
        }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        match *self {
            Self::Textured(textured) => Self::Textured(textured.with_corners(corners)),
            _ => *self,
        }
    }
}

/// The colours of a span.
type Colors<'t> = Box<dyn Fn(Span) -> Vec<Stored> + 't>;

/// Sets up a shader for a triangle of a display with colours of type `C`.
fn set_up<'t, C: Shown + 't, S: SpanShader<C, Ink = C, Setup: 't> + 't>(
    shader: S,
    triangle: &Triangle<'_>,
) -> Colors<'t> {
    let setup = shader.set_up(triangle);
    Box::new(move |span| S::span(&setup, span).take(span.width as usize).map(Stored::of).collect())
}

impl<'t> SpanShader<Stored> for Paint<'t> {
    type Ink = Stored;
    type Setup = Colors<'t>;
    type FastPath = ();

    fn set_up(&self, triangle: &Triangle<'_>) -> Colors<'t> {
        match *self {
            Self::Plain(color) => Box::new(move |span| vec![color; span.width as usize]),
            Self::Dithered(format, flat) => {
                by_format!(format, C => set_up::<C, _>(Dithered(flat), triangle))
            }
            Self::Smooth(format, lit) => match format {
                Format::Rgb565 => set_up::<Rgb565, _>(lit, triangle),
                Format::Gray2 => set_up::<Gray2, _>(lit, triangle),
                Format::Gray4 => set_up::<Gray4, _>(lit, triangle),
                // They always dither.
                Format::Mono | Format::Tricolor => Self::SmoothDithered(format, lit).set_up(triangle),
            },
            Self::SmoothDithered(format, lit) => {
                by_format!(format, C => set_up::<C, _>(Dithered(lit), triangle))
            }
            Self::Textured(textured) => {
                let setup = textured.set_up(triangle);
                Box::new(move |span| LitTextured::span(&setup, span).take(span.width as usize).collect())
            }
        }
    }

    fn span(colors: &Colors<'t>, span: Span) -> impl Iterator<Item = Stored> {
        colors(span).into_iter()
    }
}
