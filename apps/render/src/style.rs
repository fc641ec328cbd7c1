//! What faces and edges look like.

use crate::fog::FogStyle;
use crate::json::Names;
use crate::picture::{luma, Format};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// Smooth shading, except over sharp edges.
    Solid,
    /// One colour per face.
    Flat,
    /// Smooth shading over all edges.
    Gouraud,
    Wireframe,
    HiddenLine,
}

impl Mode {
    pub const ALL: [(&'static str, Self); 5] = [
        ("solid", Self::Solid),
        ("flat", Self::Flat),
        ("gouraud", Self::Gouraud),
        ("wireframe", Self::Wireframe),
        ("hidden-line", Self::HiddenLine),
    ];

    /// Whether the mode draws edges instead of faces.
    pub const fn of_lines(self) -> bool {
        matches!(self, Self::Wireframe | Self::HiddenLine)
    }

    /// The degrees by which the surface turns at an edge that is drawn, at least; `None` draws all edges. Where hidden lines are
    /// left out, the diagonals of flat faces are, too: they are edges of the triangles, not of the model.
    pub const fn least_turn(self) -> Option<f64> {
        match self {
            Self::HiddenLine => Some(1.0),
            _ => None,
        }
    }

    /// The crease angle in degrees, up to which shading is smooth.
    pub(crate) fn crease(self) -> f64 {
        match self {
            Self::Solid => 50.0,
            Self::Gouraud => 180.0,
            Self::Flat | Self::Wireframe | Self::HiddenLine => 0.0,
        }
    }
}

impl Names for Mode {
    fn names() -> impl Iterator<Item = (&'static str, Self)> {
        Self::ALL.into_iter()
    }
}

/// How much of what is behind a face is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Translucency {
    #[default]
    Opaque,
    /// The pixels that are drawn of each 64.
    Door(u8),
    /// The mean of the face and what is behind it.
    Half,
    /// The face's part, in 32nds.
    Alpha(u8),
}

impl Translucency {
    /// Whether faces are mixed with what is behind them, so that farther ones must be drawn first.
    pub const fn blends(self) -> bool {
        matches!(self, Self::Half | Self::Alpha(_))
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub mode: Mode,
    /// Colour of faces in full light, or of edges.
    pub colour: Rgb888,
    /// Whether faces have the colours of the scene instead, if it has any.
    pub own_colours: bool,
    pub background: Rgb888,
    pub dither: bool,
    /// Whether a texture is lit as a face without one is.
    pub lit_texture: bool,
    pub translucency: Translucency,
    /// Whether lines are anti-aliased.
    pub smooth_lines: bool,
    /// Whether the edges of opaque faces are anti-aliased.
    pub smooth_faces: bool,
    /// Fog on faces, instead of the scene's.
    pub fog: Option<FogStyle>,
}

const PAPER: Rgb888 = Rgb888::new(236, 235, 230);
const CLAY: Rgb888 = Rgb888::new(240, 160, 98);
const INK: Rgb888 = Rgb888::new(34, 48, 72);
const CHALK: Rgb888 = Rgb888::new(214, 240, 250);

impl Style {
    /// The chosen style of opaque faces, unlit textures and plain lines, with defaults that are visible in the format. A chosen
    /// colour replaces the model's own.
    pub fn chosen(
        mode: Mode,
        format: Format,
        colour: Option<Rgb888>,
        background: Option<Rgb888>,
        dither: bool,
    ) -> Self {
        let background = background.unwrap_or(if format.is_grey() { Rgb888::BLACK } else { PAPER });
        let usual = match (mode.of_lines(), luma(background) > 127) {
            (true, true) => INK,
            (true, false) => CHALK,
            (false, _) if format.is_grey() => Rgb888::WHITE,
            (false, _) => CLAY,
        };
        let own_colours = colour.is_none();
        Self {
            mode,
            colour: colour.unwrap_or(usual),
            own_colours,
            background,
            dither,
            lit_texture: false,
            translucency: Translucency::Opaque,
            smooth_lines: false,
            smooth_faces: false,
            fog: None,
        }
    }

    /// Whether the edges of faces are smoothed: those of opaque ones.
    pub(crate) fn smooths(&self) -> bool {
        self.smooth_faces && self.translucency == Translucency::Opaque && !self.mode.of_lines()
    }
}
