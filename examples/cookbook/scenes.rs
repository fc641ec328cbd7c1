//! Stand-ins for the displays and inputs of the programs, up to the moment of the picture.

use super::book::{epaper, gauge, hud, logo, orbit, round, samples, scope, walk};
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use pinhole::{Angle, Point3, Scalar};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::still;
use std::error::Error;

/// The name of a program, and its picture as a PNG file.
pub(crate) type Picture = (&'static str, Vec<u8>);

pub(crate) fn all() -> Result<[Picture; 9], Box<dyn Error>> {
    // Off and on, as an OLED and as e-paper show them, each pixel twice or three times as large.
    let oled = [Rgb888::new(8, 10, 14), Rgb888::new(190, 230, 255)];
    let paper = [Rgb888::new(28, 28, 32), Rgb888::new(226, 224, 216)];
    Ok([
        ("logo", png(&logo()?, Rgb888::from, 1)?),
        ("gauge", png(&gauge()?, |c| oled[usize::from(c.is_on())], 3)?),
        ("walk", png(&walk()?, Rgb888::from, 1)?),
        ("orbit", png(&orbit()?, Rgb888::from, 1)?),
        ("hud", png(&hud()?, Rgb888::from, 1)?),
        ("epaper", png(&epaper()?, |c| paper[usize::from(c.is_on())], 2)?),
        ("scope", png(&scope()?, Rgb888::from, 1)?),
        ("round", png(&round()?, Rgb888::from, 1)?),
        ("samples", png(&samples()?, Rgb888::from, 1)?),
    ])
}

/// The PNG file of a display, each pixel `scale` × `scale` large.
fn png<C: PixelColor>(
    display: &Canvas<C>,
    seen: impl Fn(C) -> Rgb888,
    scale: usize,
) -> Result<Vec<u8>, Box<dyn Error>> {
    let rows = display.pixels().chunks(display.size().width as usize);
    let wide = rows.map(|row| row.iter().flat_map(|&c| vec![seen(c); scale]).collect::<Vec<_>>());
    let pixels: Vec<Rgb888> = wide.flat_map(|row| row.repeat(scale)).collect();
    still::png(display.size() * scale as u32, &pixels)
}

fn colour_display(width: u32, height: u32) -> Canvas<Rgb565> {
    Canvas::new(Size::new(width, height), Rgb565::MAGENTA) // no program shows this colour
}

fn logo() -> Result<Canvas<Rgb565>, Box<dyn Error>> {
    let mut display = colour_display(240, 240);
    logo::draw(Angle::degrees(-35), &mut logo::Memory::default(), &mut display)?;
    Ok(display)
}

/// Speeds up to 62.
fn gauge() -> Result<Canvas<BinaryColor>, Box<dyn Error>> {
    let mut display = Canvas::new(Size::new(128, 64), BinaryColor::On);
    let mut gauge = gauge::Gauge::new();
    for value in (0..=62).step_by(2) {
        gauge.set(value, &mut display)?;
    }
    Ok(display)
}

/// Along the street, looking a little to the left.
fn walk() -> Result<Canvas<Rgb565>, Box<dyn Error>> {
    let mut display = colour_display(320, 240);
    let eye = Point3::new(Scalar::ZERO, Scalar::from_ratio(9, 5), Scalar::from_int(25));
    walk::draw(&walk::build(), (eye, Angle::degrees(8)), &mut display)?;
    Ok(display)
}

/// A month's bar is touched after a few clicks of the encoder.
fn orbit() -> Result<Canvas<Rgb565>, Box<dyn Error>> {
    let mut display = colour_display(240, 240);
    let values = [62, 55, 48, 35, 24, 18, 15, 17, 26, 38, 51, 60];
    let mut chart = orbit::Chart { values, yaw: Angle::ZERO, picked: None };
    chart.turn(3);
    chart.turn(-1);
    chart.touch(Point::new(150, 120));
    chart.draw(&mut display)?;
    Ok(display)
}

/// Frames of 16 to 38 ms.
fn hud() -> Result<Canvas<Rgb565>, Box<dyn Error>> {
    let mut display = colour_display(240, 240);
    let mut hud = hud::Hud::new();
    for frame in 0..60 {
        let (_, wave) = Angle::turns(frame, 40).sin_cos();
        let micros = 22_000 + (wave >> 18) as u32 * u32::from(wave > 0) * 3;
        hud.draw(Angle::degrees(frame - 39), micros, &mut display)?;
    }
    Ok(display)
}

fn epaper() -> Result<Canvas<BinaryColor>, Box<dyn Error>> {
    let mut display = Canvas::new(Size::new(200, 200), BinaryColor::Off);
    epaper::draw(Angle::degrees(5), [BinaryColor::Off, BinaryColor::On], &mut display)?;
    Ok(display)
}

/// Two tones over noise; the louder one wanders.
fn scope() -> Result<Canvas<Rgb565>, Box<dyn Error>> {
    let mut display = colour_display(320, 240);
    let mut scope = scope::Scope::new();
    for row in 0..40 {
        scope.push(spectrum(row), &mut display)?;
    }
    Ok(display)
}

/// Its corners are dark.
fn round() -> Result<Canvas<Rgb565>, Box<dyn Error>> {
    let mut display = Canvas::new(Size::new(240, 240), Rgb565::BLACK);
    round::draw(Angle::degrees(20), &mut round::Memory::default(), &mut display)?;
    Ok(display)
}

fn samples() -> Result<Canvas<Rgb565>, Box<dyn Error>> {
    let mut display = colour_display(160, 128);
    samples::draw(Angle::degrees(30), &mut samples::Memory::default(), &mut display)?;
    Ok(display)
}

/// A spectrum of 32 bands, in integers.
pub(crate) fn spectrum(row: u32) -> [u8; 32] {
    // −2¹⁰ … 2¹⁰
    let wave = |period| Angle::turns(row as i32, period).sin_cos().0 >> 20;
    // Positions and widths in 1/256 of a band.
    let peak = |band: usize, at: i32, height: i32, width: i32| {
        let near = (width - (256 * band as i32 - at).abs()).max(0) * 256 / width;
        height * ((near * near * (768 - 2 * near)) >> 16) / 256
    };
    core::array::from_fn(|band| {
        let noise = (row * 37 + band as u32 * 101).wrapping_mul(2_654_435_761) >> 28;
        let tones = peak(band, 2400 + wave(44), 230, 1400) + peak(band, 5900, 100 + wave(31) / 14, 1100);
        tones as u8 + noise as u8 // at most 230 + 15 and 173 + 15: the tones do not meet
    })
}
