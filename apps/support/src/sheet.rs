//! The look of contact sheets: colours and captions.

use crate::canvas::Canvas;
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::text::{Baseline, Text};

/// The sheet.
pub const BACKGROUND: Rgb888 = Rgb888::new(233, 230, 222);
/// Titles and lines.
pub const INK: Rgb888 = Rgb888::new(38, 42, 52);
/// Captions.
pub const FAINT: Rgb888 = Rgb888::new(110, 108, 104);

/// Draws text whose top-left corner is at a point.
pub fn write(text: &str, at: Point, font: &MonoFont<'_>, colour: Rgb888, sheet: &mut Canvas<Rgb888>) {
    let Ok(_) = Text::with_baseline(text, at, MonoTextStyle::new(font, colour), Baseline::Top).draw(sheet);
}
