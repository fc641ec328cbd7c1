//! The error of smoothed edges and of supersampling against 16 × 16 samples a pixel, docs/data/smooth.json, and a picture for the README.

use clap::{ArgMatches, Command};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::generated::Generated;
use pinhole_apps_support::still;
use pinhole_render::import;
use pinhole_render::model::{self, Fit, Look};
use pinhole_render::paint::{Mode, Style, Subject};
use pinhole_render::picture::{picture, Format};
use pinhole_render::projections::Named;
use pinhole_render::quantised::Quantised;
use serde_json::json;
use std::path::Path;
use std::process::ExitCode;
use support::bridge::pair::{ProjectionBits, Step};
use support::smooth_scenes::{camera, reference, scenes, Scene, NO_CREASES};
use support::ROOT;

const PROGRAM: &str = "-p pinhole-measure -- smooth";
const SIZES: [[u32; 2]; 2] = [[240, 240], [128, 64]];

/// How edges are anti-aliased.
enum Method {
    /// This many samples across and down.
    Samples([u32; 2]),
    /// A sample in the middle of a pixel, and a share of those in its corners.
    Quincunx,
    /// Smoothed silhouettes, and with creases if it is set.
    Smooth(bool),
}

const METHODS: [(&str, Method); 7] = [
    ("none", Method::Samples([1, 1])),
    ("1×2", Method::Samples([1, 2])),
    ("2×2", Method::Samples([2, 2])),
    ("quincunx", Method::Quincunx),
    ("4×4", Method::Samples([4, 4])),
    ("silhouettes", Method::Smooth(false)),
    ("creases", Method::Smooth(true)),
];

pub(crate) fn command() -> Command {
    Generated::command("smooth", "Measures the errors of smoothed edges, and draws some", "docs")
}

pub(crate) fn run(given: &mut ArgMatches) -> Result<ExitCode, String> {
    let folder = Generated::from(PROGRAM, given);
    let mut rows = Vec::new();
    for mut scene in scenes() {
        let changes = changes_over_a_turn(&mut scene);
        for size in SIZES {
            let (mesh, camera) = (scene.mesh(), camera(size[0], size[1]).library());
            let reference = reference(&scene, &camera.place(&mesh, &scene.model.library()), size);
            let plain = METHODS[0].1.picture(&scene, size);
            for ((name, method), change) in METHODS.iter().zip(changes) {
                if scene.is_smooth && matches!(method, Method::Smooth(true)) {
                    continue; // a surface that is shaded smoothly has no creases
                }
                let (rms, far, worse) = reference.errors(&method.picture(&scene, size), &plain);
                let [rms, far] = [rms, far].map(|error| (10.0 * error).round() / 10.0);
                let mut row = json!({"scene": scene.name, "width": size[0], "height": size[1], "method": name, "rms": rms,
                    "over_20_percent": far, "worse": worse});
                if size == SIZES[1] {
                    row["largest_change"] = (change.round() as u32).into();
                }
                rows.push(row.to_string());
            }
        }
    }
    let text = format!(
        "{{\n\"command\": \"cargo run --release {PROGRAM}\",\n\"rows\": [\n{}\n]\n}}\n",
        rows.join(",\n")
    );
    let data = folder.within("data/smooth.json").finish_page(&text)?;
    let picture = folder.within("smooth.png").finish(&gear()?)?;
    Ok(if data == ExitCode::SUCCESS { picture } else { data })
}

/// The largest change of the error of a pixel from frame to frame while a scene turns by 0.1° a frame, for each method, in the smaller size.
fn changes_over_a_turn(scene: &mut Scene) -> [f64; METHODS.len()] {
    const FRAMES: u32 = 32;
    const STEP: u32 = u32::MAX / 3600;
    let (size, model) = (SIZES[1], scene.model.0.clone());
    let (mut last, mut changes) = (None::<[Vec<f64>; METHODS.len()]>, [0.0_f64; METHODS.len()]);
    for frame in 0..FRAMES {
        scene.model.0 = [vec![Step::Y(frame * STEP)], model.clone()].concat();
        let (mesh, camera) = (scene.mesh(), camera(size[0], size[1]).library());
        let reference = reference(scene, &camera.place(&mesh, &scene.model.library()), size);
        let errors = METHODS.each_ref().map(|(_, method)| {
            let picture = method.picture(scene, size);
            picture
                .iter()
                .zip(&reference.means)
                .map(|(color, mean)| f64::from(color.r()) - mean)
                .collect::<Vec<_>>()
        });
        for ((change, before), now) in changes.iter_mut().zip(last.iter().flatten()).zip(&errors) {
            *change =
                before.iter().zip(now).map(|(before, now)| (now - before).abs()).fold(*change, f64::max);
        }
        last = Some(errors);
    }
    scene.model.0 = model;
    changes
}

impl Method {
    fn picture(&self, scene: &Scene, [width, height]: [u32; 2]) -> Vec<Rgb888> {
        let (mesh, model, usual) = (scene.mesh(), scene.model.library(), camera(width, height));
        let draw = |camera: &support::bridge::pair::CameraBits, contrast| {
            let (_, _, width, height) = camera.viewport;
            scene.picture(&camera.library().place(&mesh, &model), [width, height], contrast)
        };
        match *self {
            Self::Smooth(creases) => draw(&usual, Some(if creases { scene.contrast() } else { NO_CREASES })),
            Self::Samples([across, down]) => {
                let mut larger = usual;
                larger.viewport = (0, 0, width * across, height * down);
                let samples = draw(&larger, None);
                let at = |x, y, i| {
                    samples[((y * down + i / across) * width * across + x * across + i % across) as usize]
                };
                averaged([width, height], |x, y| (0..across * down).map(|i| (at(x, y, i), 1)).collect())
            }
            Self::Quincunx => {
                // One column and row more, in a window that is larger by half a pixel on each side: their middles are corners.
                let mut corners = usual;
                let ProjectionBits::Perspective(angle, _, near, far) = usual.projection else {
                    return Vec::new();
                };
                let tangent = (f64::from(angle) / 4_294_967_296.0 * std::f64::consts::PI).tan();
                let half = (tangent * f64::from(height + 1) / f64::from(height)).atan();
                let angle = (half / std::f64::consts::PI * 4_294_967_296.0).round() as u32;
                corners.projection = ProjectionBits::Perspective(angle, (width + 1, height + 1), near, far);
                corners.viewport = (0, 0, width + 1, height + 1);
                let (middles, corners) = (draw(&usual, None), draw(&corners, None));
                averaged([width, height], |x, y| {
                    let corner = |i| (corners[((y + i / 2) * (width + 1) + x + i % 2) as usize], 1);
                    (0..4u32).map(corner).chain([(middles[(y * width + x) as usize], 4)]).collect()
                })
            }
        }
    }
}

/// A picture of greys, each the weighted mean of samples.
fn averaged([width, height]: [u32; 2], samples: impl Fn(u32, u32) -> Vec<(Rgb888, u32)>) -> Vec<Rgb888> {
    let mean = |samples: Vec<(Rgb888, u32)>| {
        let (sum, weights) = samples.iter().fold((0, 0), |(sum, weights), (color, weight)| {
            (sum + u32::from(color.r()) * weight, weights + weight)
        });
        let level = ((sum + weights / 2) / weights) as u8;
        Rgb888::new(level, level, level)
    };
    (0..width * height).map(|i| mean(samples(i % width, i / width))).collect()
}

/// A gear without and with smooth edges, at true size and magnified.
fn gear() -> Result<Vec<u8>, String> {
    const SIZE: [u32; 2] = [144, 84];
    const TIMES: u32 = 4;
    /// The left upper corner of the part that is magnified.
    const PART: [u32; 2] = [0, 26];
    const GAP: u32 = 8;
    let size = Size::new(4 * (SIZE[0] + GAP) - GAP, SIZE[1]);
    let mut sheet = Canvas::new(size, Rgb888::WHITE);
    let mut model = import::read(&Path::new(ROOT).join("boards/common/all/model.stl"), &Default::default())?;
    let projection = Named::ALL[0];
    let look = Look {
        projection,
        yaw: projection.yaw,
        pitch: projection.pitch,
        field_of_view: projection.field_of_view(),
        width: SIZE[0],
        height: SIZE[1],
        up: model.up,
        fit: Fit::Outline,
    };
    let triangles = std::mem::take(&mut model.triangles);
    let (quantised, scene) = Quantised::settle(&model::scene(triangles, import::colors(&mut model), &look)?)?;
    for (place, smooth_faces) in [(0, false), (2, true)] {
        let style = Style { smooth_faces, ..Style::chosen(Mode::Solid, Format::Rgb565, None, None, false) };
        let (subject, from) = (Subject::new(&scene, &style), (&scene, &quantised));
        let pixels = picture(&subject, from, &style, Format::Rgb565)?.0;
        let [width, height] = SIZE;
        let magnified = |i: u32| {
            let (x, y) = (PART[0] + i % width / TIMES, PART[1] + i / width / TIMES);
            pixels[(y * width + x) as usize]
        };
        let magnified = (0..width * height).map(magnified).collect();
        for (place, pixels) in (place..).zip([pixels, magnified]) {
            let area = Rectangle::new(Point::new(place * (width + GAP) as i32, 0), Size::new(width, height));
            let Ok(()) = sheet.fill_contiguous(&area, pixels);
        }
    }
    still::png(size, sheet.pixels()).map_err(|e| e.to_string())
}
