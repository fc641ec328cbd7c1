//! What contact sheets look like: paper, ink, and words.

use crate::canvas::Canvas;
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::text::{Baseline, Text};

pub(crate) const BACKGROUND: Rgb888 = Rgb888::new(233, 230, 222);
pub(crate) const INK: Rgb888 = Rgb888::new(38, 42, 52);
pub(crate) const FAINT: Rgb888 = Rgb888::new(110, 108, 104);

/// Words whose upper left corner is at a point.
pub(crate) fn write(text: &str, at: Point, font: &MonoFont<'_>, colour: Rgb888, sheet: &mut Canvas<Rgb888>) {
    let Ok(_) = Text::with_baseline(text, at, MonoTextStyle::new(font, colour), Baseline::Top).draw(sheet);
}
