//! A contact sheet of a house under every named projection, with vanishing points:
//!
//! ```text
//! cargo run --release --example gallery -- --help
//! ```

mod cell;
mod house;
mod views;

use embedded_graphics::mono_font::iso_8859_1::{FONT_5X8, FONT_6X10};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{Line, PrimitiveStyle, Rectangle};
use pinhole::{Camera, Viewport};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::generated::Generated;
use pinhole_apps_support::sheet::{write, BACKGROUND, FAINT, INK};
use pinhole_apps_support::{command, still};
use std::error::Error;
use std::process::ExitCode;

/// Size of a picture, and the space between two.
const PICTURE: u32 = 160;
const GAP: u32 = 8;
const CAPTION: u32 = 34;
const COLUMNS: u32 = 6;

fn main() -> ExitCode {
    command::run(|| {
        let about = "Draws a contact sheet of a house under every named projection";
        let file = Generated::arguments("--example gallery", about, "docs/projections.png")?;
        file.finish(&sheet().map_err(|e| e.to_string())?)
    })
}

/// The sheet as a PNG file.
fn sheet() -> Result<Vec<u8>, Box<dyn Error>> {
    let picture = Size::new_equal(PICTURE);
    let views = views::all(picture)?;
    let cells = u32::try_from(views.len())? + 1; // the last one explains
    let step = Size::new(PICTURE + GAP, PICTURE + CAPTION + GAP);
    let rows = cells.div_ceil(COLUMNS);
    let size = Size::new(COLUMNS * step.width + GAP, rows * step.height + GAP);
    let mut sheet = Canvas::new(size, BACKGROUND);
    let corner = |index: u32| {
        let (column, row) = (index % COLUMNS, index / COLUMNS);
        Point::new_equal(GAP as i32) + Point::new((column * step.width) as i32, (row * step.height) as i32)
    };
    for (index, view) in (0..).zip(&views) {
        let corner = corner(index);
        sheet.fill_solid(&Rectangle::new(corner, picture), cell::PAPER)?;
        let viewport = Viewport::new(corner, picture)?;
        let camera = Camera::new(&view.viewing, &view.projection, &viewport);
        cell::draw(&camera, &viewport, &mut sheet)?;
        let below = corner + Point::new(0, PICTURE as i32 + 3);
        write(view.name, below, &FONT_6X10, INK, &mut sheet);
        for (line, details) in (0..).zip(view.details) {
            write(details, below + Point::new(0, 12 + 9 * line), &FONT_5X8, FAINT, &mut sheet);
        }
    }
    legend(corner(cells - 1), &mut sheet)?;
    still::png(size, sheet.pixels())
}

/// The legend.
fn legend(corner: Point, sheet: &mut Canvas<Rgb888>) -> Result<(), Box<dyn Error>> {
    let line = |row: i32| corner + Point::new(4, 8 + 14 * row);
    let middle = |row: i32| (line(row) + Point::new(0, 5), line(row) + Point::new(20, 5));
    let words = Point::new(28, 0);
    write("pinhole: one house,", line(0), &FONT_6X10, INK, sheet);
    write("every projection", line(1), &FONT_6X10, INK, sheet);
    let axes = ["edge on the x axis", "edge on the y axis", "edge on the z axis"];
    for (row, (name, colour)) in (3..).zip(axes.into_iter().zip(cell::AXES)) {
        let (from, to) = middle(row);
        Line::new(from, to).into_styled(PrimitiveStyle::with_stroke(colour, 1)).draw(sheet)?;
        write(name, line(row) + words, &FONT_6X10, INK, sheet);
    }
    let rest = [("hidden edge", 2, 2), ("on to where they meet", 1, 2)];
    for (row, (name, on, off)) in (6..).zip(rest) {
        let (from, to) = middle(row);
        let mut dashed = cell::Dashed { target: sheet, on, off, at: 0 };
        Line::new(from, to).into_styled(PrimitiveStyle::with_stroke(INK, 1)).draw(&mut dashed)?;
        write(name, line(row) + words, &FONT_6X10, INK, sheet);
    }
    cell::mark(line(8) + Point::new(10, 5), INK, sheet)?;
    write("vanishing point", line(8) + words, &FONT_6X10, INK, sheet);
    sheet.fill_solid(&Rectangle::new(line(9) + Point::new(4, 0), Size::new(12, 10)), house::MARKED)?;
    write("the front, z = 0", line(9) + words, &FONT_6X10, INK, sheet);
    Ok(())
}
