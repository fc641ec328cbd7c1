//! Default colours.

use crate::paint::{Mode, Style, Translucency};
use crate::picture::{luma, Format};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};

const PAPER: Rgb888 = Rgb888::new(236, 235, 230);
const CLAY: Rgb888 = Rgb888::new(240, 160, 98);
const INK: Rgb888 = Rgb888::new(34, 48, 72);
const CHALK: Rgb888 = Rgb888::new(214, 240, 250);

/// The chosen style of opaque faces, unlit textures and plain lines, with defaults that are visible in the format. A chosen
/// colour replaces the model's own.
pub fn chosen(
    mode: Mode,
    format: Format,
    colour: Option<Rgb888>,
    background: Option<Rgb888>,
    dither: bool,
) -> Style {
    let background = background.unwrap_or(if format.is_grey() { Rgb888::BLACK } else { PAPER });
    let usual = match (mode.of_lines(), luma(background) > 127) {
        (true, true) => INK,
        (true, false) => CHALK,
        (false, _) if format.is_grey() => Rgb888::WHITE,
        (false, _) => CLAY,
    };
    let own_colours = colour.is_none();
    Style {
        mode,
        colour: colour.unwrap_or(usual),
        own_colours,
        background,
        dither,
        lit_texture: false,
        translucency: Translucency::Opaque,
        smooth_lines: false,
        fog: None,
    }
}
