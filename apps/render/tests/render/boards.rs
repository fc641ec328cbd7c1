//! The templates for boards draw one picture: the `picture.rs` that three share and that of the RP2040, compiled here, draw the same
//! models, at angles of a turn, on displays whose heights are and are not multiples of the strip's rows. All pixels must be equal.

#![allow(dead_code, unreachable_pub)] // the files of the templates, which are right as files of their own

use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{draw::Statistics, Angle};
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::ImportedMesh;
use pinhole_render::firmware::{self, Buffers};
use std::ops::ControlFlow::{Break, Continue};
use std::path::Path;

#[path = "../../../../boards/rp2040-st7789/src/picture.rs"]
mod rp2040;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// A colour that no template draws.
const UNSENT: Rgb565 = Rgb565::MAGENTA;

/// The picture of a template whose `draw` takes a DrawTarget.
fn sent_by_driver(model: &ImportedMesh, size: Size, turn: Angle) -> (Canvas<Rgb565>, Statistics) {
    let mut canvas = Canvas::new(size, UNSENT);
    let statistics = firmware::draw(model, turn, &mut canvas).unwrap();
    (canvas, statistics)
}

/// The picture of the RP2040's template: its bands go through a window of the panel in wire order, two strips by turns.
fn sent_by_dma(model: &ImportedMesh, size: Size, turn: Angle) -> (Canvas<Rgb565>, Statistics) {
    let screen = Rectangle::new(Point::zero(), size);
    let mesh = model.mesh().unwrap();
    let colors = model.colors().unwrap().unwrap();
    let color = |face: usize, level: u16| colors.lit(face, level);
    let Buffers { mut cache, mut bins, mut strip, mut depths } = Buffers::new(&mesh, size.width);
    let mut other = strip.clone();
    let whole = strip.len();
    let (mut free, mut sent): (&mut [u8], &mut [u8]) = (&mut strip, &mut other);
    let mut canvas = Canvas::new(size, UNSENT);
    let mut picture = rp2040::Picture::new(&mesh, screen, &mut cache, &mut bins, &mut depths).unwrap();
    // A frame that was given up leaves nothing behind.
    let _ = picture.turned(Angle::degrees(77)).unwrap().band_or_strip(color, free).unwrap();
    let mut turned = picture.turned(turn).unwrap();
    loop {
        match turned.band_or_strip(color, free).unwrap() {
            Break(strip) => {
                assert_eq!(strip.len(), whole, "a strip that is shorter would draw ever shorter bands");
                break;
            }
            Continue(band) => {
                let (area, bytes) = (band.area(), band.into_bytes());
                let colors =
                    bytes.as_chunks().0.iter().map(|pair| RawU16::new(u16::from_be_bytes(*pair)).into());
                canvas.fill_contiguous(&area, colors).unwrap();
                (free, sent) = (sent, bytes);
            }
        }
    }
    let statistics = turned.statistics();
    (canvas, statistics)
}

/// Whether the templates draw one picture of a model, each pixel of it, and neither an empty nor a full one.
fn compare(model: &str) {
    let model = pinhole_import::import(
        &Path::new(ROOT).join(model),
        &pinhole_import::Options { fit: Some(2.0), ..pinhole_import::Options::default() },
    );
    let mut model = model.unwrap();
    // A colour for each of 253 faces that follow each other.
    model.palette = (0..253).map(|face: u8| [face % 31 * 8 + 7, 255, (face >> 5) * 32 + 3]).collect();
    model.face_colors = (0..model.faces.len()).map(|face| (face % 253) as u8).collect();
    for (width, height) in [(240, 240), (96, 61), (61, 96), (320, 5)] {
        let size = Size::new(width, height);
        for degrees in [0, 33, 123, 270] {
            let turn = Angle::degrees(degrees);
            let (first, counted) = sent_by_driver(&model, size, turn);
            let (other, statistics) = sent_by_dma(&model, size, turn);
            let differing = first.pixels().iter().zip(other.pixels()).filter(|(a, b)| a != b).count();
            assert_eq!((differing, statistics), (0, counted), "{size:?}, {degrees} degrees");
            let pixels = first.pixels();
            let background = pixels.iter().filter(|color| **color == Rgb565::BLACK).count();
            assert!(!pixels.contains(&UNSENT) && (1..pixels.len()).contains(&background), "{size:?}");
        }
    }
}

#[test]
fn the_templates_draw_one_picture_of_a_gear() {
    compare("boards/any-cortex-m/model.stl");
}

#[test]
fn the_templates_draw_one_picture_of_a_teapot() {
    compare("assets/teapot.obj");
}

/// The preview counts frames as these templates do; the STM32F411's, whose bus is slow, turns in fewer.
#[test]
fn the_templates_turn_in_as_many_frames_as_the_preview() {
    let wanted = format!("\nconst FRAMES: u32 = {};\n", firmware::FRAMES);
    for board in ["any-cortex-m", "rp2040-st7789"] {
        let main =
            std::fs::read_to_string(Path::new(ROOT).join("boards").join(board).join("src/main.rs")).unwrap();
        assert!(main.contains(&wanted), "{board}");
    }
}

/// Which code draws a model with `--firmware`: that of the project it lies in, unless it is the template that is compiled in.
#[test]
fn a_model_is_drawn_by_the_project_that_it_lies_in() {
    let of = |file: &str| firmware::project(&Path::new(ROOT).join(file));
    assert_eq!(of("boards/any-cortex-m/model.stl"), None);
    assert_eq!(of("assets/teapot.obj"), None);
    let rp2040 = Path::new(ROOT).join("boards/rp2040-st7789").canonicalize().unwrap();
    assert_eq!(of("boards/rp2040-st7789/model.stl"), Some(rp2040));
    // A copy, and then one with another colour.
    let copy = Path::new(env!("CARGO_TARGET_TMPDIR")).join("boards-copy");
    std::fs::create_dir_all(copy.join("src")).unwrap();
    std::fs::create_dir_all(copy.join("parts")).unwrap();
    for file in ["build.rs", "model.stl", "src/picture.rs"] {
        std::fs::copy(Path::new(ROOT).join("boards/any-cortex-m").join(file), copy.join(file)).unwrap();
    }
    std::fs::copy(copy.join("model.stl"), copy.join("parts/gear.stl")).unwrap();
    for file in ["model.stl", "parts/gear.stl"] {
        assert_eq!(firmware::project(&copy.join(file)), None);
    }
    let picture = std::fs::read_to_string(copy.join("src/picture.rs")).unwrap();
    std::fs::write(copy.join("src/picture.rs"), picture.replace("CSS_GOLD", "CSS_TEAL")).unwrap();
    for file in ["model.stl", "parts/gear.stl"] {
        assert_eq!(firmware::project(&copy.join(file)), Some(copy.canonicalize().unwrap()));
    }
}
