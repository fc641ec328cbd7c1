//! The templates for boards draw one picture: the `picture.rs` that three share and that of the RP2040, compiled here, draw the same
//! models, at angles of a turn, on displays whose heights are and are not multiples of the strip's rows. All pixels must be equal.

#![allow(dead_code, unreachable_pub)] // the files of the templates, which are right as files of their own

use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{Angle, Dim, Frame, Mesh, ScreenVertex, Statistics};
use pinhole_apps_support::canvas::Canvas;
use std::ops::ControlFlow::{Break, Continue};
use std::path::Path;

#[path = "../../../boards/any-cortex-m/src/picture.rs"]
mod any_cortex_m;
#[path = "../../../boards/rp2040-st7789/src/picture.rs"]
mod rp2040;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const ROWS: u32 = 8;
/// A colour that no template draws.
const UNSENT: Rgb565 = Rgb565::MAGENTA;

/// A colour for each face.
fn color(face: usize, level: u16) -> Rgb565 {
    Rgb565::new(face as u8 % 31 + 1, 63, (face >> 5) as u8 % 32).dim(level)
}

struct Buffers {
    cache: Vec<ScreenVertex>,
    bins: Vec<u16>,
    strip: Vec<u8>,
    depths: Vec<u16>,
}

impl Buffers {
    fn new(mesh: &Mesh<'_>, size: Size) -> Self {
        Self {
            cache: vec![ScreenVertex::EMPTY; mesh.cache_len()],
            bins: vec![0; mesh.face_bins_len()],
            strip: vec![0; Frame::<Rgb565>::strip_bytes(size.width, ROWS)],
            depths: vec![0; (size.width * ROWS) as usize],
        }
    }
}

/// The picture of a template whose `draw` takes a DrawTarget.
fn sent_by_driver(mesh: &Mesh<'_>, size: Size, turn: Angle) -> (Canvas<Rgb565>, Statistics) {
    let Buffers { mut cache, mut bins, mut strip, mut depths } = Buffers::new(mesh, size);
    let mut memory = any_cortex_m::Memory::new(&mut cache, &mut bins, &mut strip, &mut depths);
    let mut canvas = Canvas::new(size, UNSENT);
    let camera = any_cortex_m::camera(mesh, Rectangle::new(Point::zero(), size)).unwrap();
    let drawn = any_cortex_m::draw(mesh, color, &camera, turn, &mut memory, &mut canvas).unwrap();
    assert_eq!(drawn.bytes, size.width * size.height * 2, "each pixel once");
    (canvas, drawn.statistics)
}

/// The picture of the RP2040's template: its bands go through a window of the panel in wire order, two strips by turns.
fn sent_by_dma(mesh: &Mesh<'_>, size: Size, turn: Angle) -> (Canvas<Rgb565>, Statistics) {
    let screen = Rectangle::new(Point::zero(), size);
    let Buffers { mut cache, mut bins, mut strip, mut depths } = Buffers::new(mesh, size);
    let mut other = strip.clone();
    let whole = strip.len();
    let (mut free, mut sent): (&mut [u8], &mut [u8]) = (&mut strip, &mut other);
    let mut canvas = Canvas::new(size, UNSENT);
    let mut picture = rp2040::Picture::new(mesh, screen, &mut cache, &mut bins, &mut depths).unwrap();
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
    let model = model.unwrap();
    let mesh = model.mesh().unwrap();
    for (width, height) in [(240, 240), (96, 61), (61, 96), (320, 5)] {
        let size = Size::new(width, height);
        for degrees in [0, 33, 123, 270] {
            let turn = Angle::degrees(degrees);
            let (first, counted) = sent_by_driver(&mesh, size, turn);
            let (other, statistics) = sent_by_dma(&mesh, size, turn);
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
    let wanted = format!("\nconst FRAMES: u32 = {};\n", pinhole_render::firmware::FRAMES);
    for board in ["any-cortex-m", "rp2040-st7789"] {
        let main =
            std::fs::read_to_string(Path::new(ROOT).join("boards").join(board).join("src/main.rs")).unwrap();
        assert!(main.contains(&wanted), "{board}");
    }
}

/// Which code draws a model with `--firmware`: that of the project it lies in, unless it is the template that is compiled in.
#[test]
fn a_model_is_drawn_by_the_project_that_it_lies_in() {
    let of = |file: &str| pinhole_render::firmware::project(&Path::new(ROOT).join(file));
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
        assert_eq!(pinhole_render::firmware::project(&copy.join(file)), None);
    }
    let picture = std::fs::read_to_string(copy.join("src/picture.rs")).unwrap();
    std::fs::write(copy.join("src/picture.rs"), picture.replace("CSS_GOLD", "CSS_TEAL")).unwrap();
    for file in ["model.stl", "parts/gear.stl"] {
        assert_eq!(pinhole_render::firmware::project(&copy.join(file)), Some(copy.canonicalize().unwrap()));
    }
}
