//! The programs of the book's cookbook: their pictures, what they do with their inputs, and what the book says about them.

#[path = "../../examples/cookbook/book.rs"]
mod book;
#[path = "../../examples/cookbook/scenes.rs"]
mod scenes;

use crate::{example, folder};
use book::{epaper, gauge, hud, logo, orbit, round, samples, scope, walk};
use embedded_graphics::pixelcolor::{raw::RawU16, BinaryColor, Rgb565};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::meshes::{CUBE, TORUS};
use pinhole::{
    draw::{BinnedScene, PlacedScene},
    prelude::*,
    Angle,
};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::testing;
use std::convert::Infallible;
use std::fs;
use std::path::Path;
use support::oracle::rng::Rng;
use support::ROOT;

const PROGRAMS: [&str; 9] = ["logo", "gauge", "walk", "orbit", "hud", "epaper", "scope", "round", "samples"];

/// A display that counts the pixels that it receives.
struct Counting<C> {
    shown: Canvas<C>,
    received: usize,
}

impl<C: PixelColor> Counting<C> {
    fn new(width: u32, height: u32, colour: C) -> Self {
        Self { shown: Canvas::new(Size::new(width, height), colour), received: 0 }
    }
}

impl<C: PixelColor> OriginDimensions for Counting<C> {
    fn size(&self) -> Size {
        self.shown.size()
    }
}

impl<C: PixelColor> DrawTarget for Counting<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let received = &mut self.received;
        self.shown.draw_iter(pixels.into_iter().inspect(|_| *received += 1))
    }
}

fn rgb(width: u32, height: u32) -> Canvas<Rgb565> {
    Canvas::new(Size::new(width, height), Rgb565::MAGENTA)
}

#[test]
fn pictures_are_those_of_the_book() {
    let folder = Path::new(ROOT).join("docs/cookbook");
    let pictures = scenes::all().unwrap();
    assert_eq!(pictures.each_ref().map(|(name, _)| *name), PROGRAMS);
    for (name, png) in pictures {
        let file = folder.join(name).with_extension("png");
        assert!(fs::read(&file).unwrap() == png, "{name}: cargo run --release --example cookbook");
    }
    assert_eq!(fs::read_dir(folder).unwrap().count(), PROGRAMS.len());
}

#[test]
fn a_picture_that_is_out_of_date_is_found() {
    let to = folder("cookbook", "check");
    let run = |more: &[&str]| {
        let arguments = [&["--out", to.to_str().unwrap()], more].concat();
        example("cookbook", &arguments)
    };
    assert!(run(&[]).status.success());
    let current = run(&["--check"]);
    assert!(current.status.success() && current.stderr.is_empty(), "{current:?}");
    fs::copy(to.join("hud.png"), to.join("logo.png")).unwrap();
    let old = run(&["--check"]);
    let said = String::from_utf8_lossy(&old.stderr).into_owned();
    assert_eq!(old.status.code(), Some(1), "{said}");
    assert!(said.contains("logo.png: out of date") && said.lines().count() == 1, "{said}");
    fs::remove_file(to.join("logo.png")).unwrap();
    testing::refusal(&run(&["--check"]));
}

/// Lines beside comments and imports.
#[test]
fn each_program_has_at_most_60_lines_and_needs_no_std() {
    for name in PROGRAMS {
        let text = fs::read_to_string(Path::new(ROOT).join(format!("src/book/cookbook/{name}.rs"))).unwrap();
        let code = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//"));
        let lines = code.filter(|line| !line.starts_with("use ")).count();
        assert!((20..=60).contains(&lines), "{name}: {lines} lines");
        for word in ["std::", "alloc::", "vec!", "format!", "Box", "f32", "f64", "unsafe", "static mut"] {
            assert!(!text.contains(word), "{name}: {word}");
        }
    }
}

#[test]
fn the_book_shows_each_program_with_its_picture_and_its_memory() {
    let chapter = fs::read_to_string(Path::new(ROOT).join("src/book/mod.rs")).unwrap();
    for name in PROGRAMS {
        let source = format!("\n//! ```\n#![doc = include_str!(\"cookbook/{name}.rs\")]\n//! ```\n");
        assert_eq!(chapter.matches(&source).count(), 1, "{name}");
        assert!(chapter.contains(&format!("][docs/cookbook/{name}.png]")), "{name}");
    }

    // The arrays and values that each program declares, but single numbers.
    let cubes = |n| n * (size_of::<ScreenVertex>() * CUBE.vertices().len() + 2 * CUBE.face_bins_len());
    let strip = |width: usize, rows: usize| width * rows * 4; // colours and depths
    let memory = [
        size_of::<logo::Memory>(),
        size_of::<gauge::Gauge>()
            + size_of_val(&mesh_buffers!(gauge::NEEDLE))
            + size_of_val(&strip_buffers!(BinaryColor, 128, 16, no depth)),
        size_of::<walk::Town>()
            + size_of::<PlacedScene<'_, '_, Rgb565, 50>>()
            + size_of::<BinnedScene<'_, '_, Rgb565, 50>>()
            + cubes(50)
            + strip(320, 8),
        size_of::<orbit::Chart>()
            + size_of::<pinhole::draw::Scene<'_, usize, 12>>()
            + size_of::<PlacedScene<'_, '_, usize, 12>>()
            + size_of::<BinnedScene<'_, '_, usize, 12>>()
            + cubes(12)
            + strip(240, 8),
        size_of::<hud::Hud>() + 2 * TORUS.vertices().len(),
        size_of::<ScreenVertex>() * epaper::PAWN.vertices().len() + 2 * 200 * 20,
        size_of::<scope::Scope>() + size_of_val(scope::AT_REST.vertices()),
        size_of::<round::Memory>(),
        size_of::<samples::Memory>(),
    ];
    let rows: Vec<&str> = chapter.lines().filter(|line| line.starts_with("//! | [")).collect();
    assert_eq!(rows.len(), memory.len());
    let said = rows.iter().map(|row| row.split('|').nth(3).unwrap().replace(' ', "").parse().unwrap());
    assert_eq!(said.collect::<Vec<usize>>(), memory, "{PROGRAMS:?}");
}

#[test]
fn the_gauge_sends_what_has_changed_and_nothing_else() {
    let mut display = Counting::new(128, 64, BinaryColor::On);
    let mut gauge = gauge::Gauge::new();
    for (value, most) in [(0, 128 * 64), (3, 4000), (50, 8000), (50, 0), (51, 4000), (100, 8000), (100, 0)] {
        display.received = 0;
        let Ok(()) = gauge.set(value, &mut display);
        assert!(display.received <= most, "{value}: {} pixels", display.received);
        let mut whole = Counting::new(128, 64, BinaryColor::On);
        let Ok(()) = gauge::Gauge::new().set(value, &mut whole);
        assert_eq!(whole.received, 128 * 64);
        assert!(display.shown.pixels() == whole.shown.pixels(), "{value}");
    }
}

#[test]
fn a_touch_picks_the_bar_that_is_seen() {
    let mut chart = orbit::Chart {
        values: [9, 60, 21, 0, 44, 50, 12, 30, 7, 61, 33, 20],
        yaw: Angle::ZERO,
        picked: None,
    };
    let (mut bars, mut nothing) = (0, 0);
    for clicks in [0, 5, -9] {
        chart.turn(clicks);
        chart.picked = None;
        let mut none = rgb(240, 240);
        let Ok(()) = chart.draw(&mut none);
        for at in Rectangle::new(Point::new(0, 30), Size::new(12, 11)).points() {
            let at = Point::new(20 * at.x + 3, 30 + 20 * (at.y - 30));
            chart.touch(at);
            let mut shown = rgb(240, 240);
            let Ok(()) = chart.draw(&mut shown);
            let (before, after) = (*none.pixel(at), *shown.pixel(at));
            if before == Rgb565::new(3, 6, 6) {
                assert_eq!((chart.picked, after), (None, before), "{at}");
                nothing += 1;
            } else {
                // Steel blue becomes orange.
                assert!(chart.picked.is_some() && before.b() >= before.r() && after.r() > after.b(), "{at}");
                bars += 1;
            }
        }
    }
    assert!(bars > 50 && nothing > 50, "{bars} on bars, {nothing} beside them");
}

/// A pixel is on the glass if its corner that is the nearest to the middle is.
#[test]
fn a_chord_has_all_pixels_of_its_rows_on_the_glass_and_no_column_more() {
    for rows in [1, 2, 8, 40] {
        for top in (0..240).step_by(rows as usize) {
            let chord = round::chord(top, rows);
            let middle = |at: i32| (at - 120).abs().min((at - 119).abs());
            let is_shown = |x: i32| {
                (top as i32..(top + rows) as i32).any(|y| middle(x).pow(2) + middle(y).pow(2) < 120 * 120)
            };
            let columns = chord.columns();
            let shown = (0..240).filter(|x| is_shown(*x)).collect::<Vec<_>>();
            assert_eq!(chord.rows(), top as i32..(top + rows) as i32);
            assert!(shown.iter().all(|x| columns.contains(x)), "{top}, {rows} rows");
            assert!(columns.len() <= shown.len() + 2, "{top}, {rows} rows");
        }
    }
}

#[test]
fn four_samples_become_their_mean() {
    let mut rng = Rng::new(47);
    for _ in 0..10_000 {
        let samples: [u16; 4] = std::array::from_fn(|_| rng.below(65_536) as u16);
        let colors = samples.map(|bits| Rgb565::from(RawU16::new(bits)));
        let bytes = samples.map(u16::to_be_bytes);
        let [upper, lower] = [0, 2].map(|i| [bytes[i][0], bytes[i][1], bytes[i + 1][0], bytes[i + 1][1]]);
        let mean = |channel: fn(&Rgb565) -> u8| {
            (colors.iter().map(|color| u32::from(channel(color))).sum::<u32>() + 2) / 4
        };
        let wanted = [mean(Rgb565::r), mean(Rgb565::g), mean(Rgb565::b)].map(|level| level as u8);
        let found = samples::mean((&upper, &lower));
        assert_eq!([found.r(), found.g(), found.b()], wanted, "{samples:x?}");
    }
}
