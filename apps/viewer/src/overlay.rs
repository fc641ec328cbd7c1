//! Overlays: rectangles sent, statistics, keys.

use crate::frame::Shown;
use crate::state::{State, KEYS};
use embedded_graphics::mono_font::{ascii::FONT_6X10, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{PrimitiveStyle, Rectangle};
use embedded_graphics::text::{Baseline, Text};
use pinhole::draw::Statistics;
use pinhole_render::picture::Format;
use pinhole_render::style::Mode;
use std::time::Duration;

const BOX: Rgb888 = Rgb888::new(20, 24, 34);
const TEXT: Rgb888 = Rgb888::new(226, 232, 240);
const KEY: Rgb888 = Rgb888::new(255, 196, 90);
const SENT: Rgb888 = Rgb888::new(236, 40, 120);
/// Height of a line and width of a character.
const LINE: i32 = 11;
const CHARACTER: i32 = 6;

pub(crate) fn draw<D: DrawTarget<Color = Rgb888>>(
    state: &State,
    shown: &Shown,
    time: Option<Duration>,
    notice: Option<&str>,
    target: &mut D,
) -> Result<(), D::Error> {
    if state.outlines {
        for area in &shown.areas {
            area.into_styled(PrimitiveStyle::with_stroke(SENT, 1)).draw(target)?;
        }
    }
    let keys = KEYS.iter().map(|(keys, what)| format!("{keys:13} {what}")).collect();
    let information = || information(state, shown, time);
    let blocks = [
        notice.map(|notice| (wrapped(notice), KEY)),
        state.information.then(|| (information(), TEXT)),
        state.help.then_some((keys, TEXT)),
    ];
    let mut top = 0;
    for (lines, colour) in blocks.into_iter().flatten() {
        paper(top, &lines, target)?;
        for line in &lines {
            write(line, Point::new(3, top + 2), colour, target)?;
            top += LINE;
        }
        top += 4;
    }
    // The keys are the last block.
    let first = top - 4 - LINE * KEYS.len() as i32;
    for (place, (keys, _)) in (0..).zip(KEYS.iter().filter(|_| state.help)) {
        write(keys, Point::new(3, first + LINE * place + 2), KEY, target)?;
    }
    Ok(())
}

/// Draws the background of lines of text.
fn paper<D: DrawTarget<Color = Rgb888>>(top: i32, lines: &[String], target: &mut D) -> Result<(), D::Error> {
    let longest = lines.iter().map(String::len).max().unwrap_or_default() as i32;
    let size = Size::new((longest * CHARACTER + 6) as u32, (lines.len() as i32 * LINE + 3) as u32);
    target.fill_solid(&Rectangle::new(Point::new(0, top), size), BOX)
}

fn write<D: DrawTarget<Color = Rgb888>>(
    text: &str,
    at: Point,
    colour: Rgb888,
    target: &mut D,
) -> Result<(), D::Error> {
    let style = MonoTextStyle::new(&FONT_6X10, colour);
    Text::with_baseline(text, at, style, Baseline::Top).draw(target)?;
    Ok(())
}

/// The name of a mode or a format.
fn name<T: PartialEq>(all: &[(&'static str, T)], one: T) -> &'static str {
    all.iter().find(|(_, other)| *other == one).map_or("", |(name, _)| name)
}

/// A message in lines of at most 48 characters, which is the width of a small display.
fn wrapped(message: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in message.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.chars().count() + word.chars().count() < 48 => *line += &format!(" {word}"),
            _ => lines.push(word.into()),
        }
    }
    lines
}

fn information(state: &State, shown: &Shown, time: Option<Duration>) -> Vec<String> {
    let dithered = if state.dither && !state.mode.of_lines() { " dithered" } else { "" };
    let Statistics { drawn, culled, clipped, outside, degenerate, .. } = shown.statistics;
    let what = if state.mode.of_lines() { "edges" } else { "faces" };
    let mut lines = vec![
        format!(
            "{}, {}, {}{dithered}",
            state.projection.map_or("own camera", |named| named.name),
            name(&Mode::ALL, state.mode),
            name(&Format::ALL, state.format),
        ),
        format!("{what}: {drawn} drawn, {culled} culled, {clipped} cut, {} dropped", outside + degenerate),
    ];
    let Statistics { drawn, outside, degenerate, .. } = shown.sprites;
    if drawn + outside + degenerate > 0 {
        lines.push(format!("sprites: {drawn} drawn, {} dropped", outside + degenerate));
    }
    let rows = state.rows.map_or("all".into(), |rows| rows.to_string());
    let Shown { bands, pixels, bytes, .. } = shown;
    lines.push(format!("{bands} bands of {rows} rows: {pixels} px, {bytes} bytes"));
    if let Some(time) = time {
        lines.push(format!("{:.2} ms a frame; h: help", time.as_secs_f64() * 1e3));
    }
    lines
}
