//! A contact sheet of one scene in seven pixel formats, rounded and dithered:
//!
//! ```text
//! cargo run --release --example colours -- --help
//! ```

mod scene;

use embedded_graphics::mono_font::iso_8859_1::{FONT_6X10, FONT_6X13_BOLD};
use embedded_graphics::pixelcolor::{BinaryColor, Gray2, Gray4, Gray8, Rgb565, Rgb666, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{Channels, Dithered, Gouraud, Lit, PixelFormat, SpanShader};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::generated::Generated;
use pinhole_apps_support::sheet::{write, BACKGROUND, FAINT, INK};
use pinhole_apps_support::{command, still};
use scene::{Scene, Shaders};
use std::error::Error;
use std::process::ExitCode;

const PICTURE: Size = Size::new(168, 128);
const GAP: u32 = 8;
const CAPTION: u32 = 17;
const HEADER: u32 = 24;

/// Rows of a band.
const ROWS: u32 = 8;

fn main() -> ExitCode {
    command::run(|| {
        let about = "Draws a contact sheet of one scene in seven pixel formats, rounded and dithered";
        let file = Generated::arguments("--example colours", about, "docs/colours.png")?;
        file.finish(&sheet().map_err(|e| e.to_string())?)
    })
}

/// A pixel format: its name, its bits, and the rounded and the dithered picture.
type Row = (&'static str, &'static str, [Vec<Rgb888>; 2]);

/// All the pictures as a PNG file.
fn sheet() -> Result<Vec<u8>, Box<dyn Error>> {
    let scene = Scene::new(PICTURE)?;
    let formats: [Row; 7] = [
        ("Rgb888", "24 bits", pictures::<Rgb888>(&scene)?),
        ("Rgb666", "18 bits", pictures::<Rgb666>(&scene)?),
        ("Rgb565", "16 bits", pictures::<Rgb565>(&scene)?),
        ("Gray8", "8 bits", pictures::<Gray8>(&scene)?),
        ("Gray4", "4 bits", pictures::<Gray4>(&scene)?),
        ("Gray2", "2 bits", pictures::<Gray2>(&scene)?),
        ("BinaryColor", "1 bit", pictures::<BinaryColor>(&scene)?),
    ];
    // Four columns and two rows of pairs; the last cell is the legend.
    let pair = Size::new(PICTURE.width + GAP, 2 * (PICTURE.height + CAPTION) + GAP);
    let size = Size::new(4 * pair.width + GAP, HEADER + 2 * pair.height + GAP);
    let mut sheet = Canvas::new(size, BACKGROUND);
    let title = format!("pinhole: one scene in every colour, drawn in bands of {ROWS} rows");
    write(&title, Point::new(GAP as i32, 7), &FONT_6X13_BOLD, INK, &mut sheet);
    let corner = |cell: u32| {
        let offset = Size::new(cell % 4, cell / 4).component_mul(pair);
        Point::new(GAP as i32, HEADER as i32) + offset
    };
    for (cell, (name, bits, pictures)) in (0..).zip(formats) {
        let mut at = corner(cell);
        for (picture, how) in pictures.into_iter().zip(["rounded", "dithered"]) {
            sheet.fill_contiguous(&Rectangle::new(at, PICTURE), picture)?;
            let below = at + Point::new(0, PICTURE.height as i32 + 3);
            write(name, below, &FONT_6X10, INK, &mut sheet);
            let details = format!("{bits}, {how}");
            let aside = below + Point::new(6 * (name.len() as i32 + 1), 0);
            write(&details, aside, &FONT_6X10, FAINT, &mut sheet);
            at.y += (PICTURE.height + CAPTION) as i32;
        }
    }
    let lines = [
        "Gouraud shading: light at",
        "the vertices, from above",
        "and the left, and linear",
        "between them; a wall with",
        "a colour at each corner.",
        "",
        "Rounded: to the nearest",
        "level of each channel.",
        "Dithered: 8 x 8 Bayer,",
        "63 more shades between",
        "any two levels.",
    ];
    for (line, text) in (0..).zip(lines) {
        write(text, corner(7) + Point::new(4, 4 + 13 * line), &FONT_6X10, FAINT, &mut sheet);
    }
    still::png(size, sheet.pixels())
}

fn pictures<C: Channels + PixelFormat + Into<Rgb888>>(
    scene: &Scene,
) -> Result<[Vec<Rgb888>; 2], Box<dyn Error>>
where
    Gouraud: SpanShader<C>,
    Lit: SpanShader<C>,
    Dithered<Gouraud>: SpanShader<C>,
    Dithered<Lit>: SpanShader<C>,
{
    let nearest = picture::<C, _, _>(scene, (|shader| shader, |shader| shader))?;
    Ok([nearest, picture::<C, _, _>(scene, (Gouraud::dithered, Lit::dithered))?])
}

/// The scene in one pixel format, drawn in bands.
fn picture<C, I, L>(scene: &Scene, shaders: Shaders<I, L>) -> Result<Vec<Rgb888>, Box<dyn Error>>
where
    C: Channels + PixelFormat + Into<Rgb888>,
    I: SpanShader<C>,
    L: SpanShader<C>,
{
    let mut pixels = Vec::new();
    scene.draw(ROWS, shaders, |band| pixels.extend(band.colors().map(Into::into)))?;
    Ok(pixels)
}
