//! The error of smoothed edges and of supersampling against 16 × 16 samples a pixel, docs/data/smooth.json, and a picture for the README.

use clap::{value_parser, Arg, ArgMatches, Command};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::generated::Generated;
use pinhole_apps_support::{files, still};
use pinhole_render::import;
use pinhole_render::model::{self, Fit, Look};
use pinhole_render::paint::Subject;
use pinhole_render::picture::{picture, Format};
use pinhole_render::projections::Named;
use pinhole_render::quantised::Quantised;
use pinhole_render::style::{Mode, Style};
use serde_json::json;
use std::path::{Path, PathBuf};
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
    let sheet = Arg::new("sheet").long("sheet").value_name("FILE").value_parser(value_parser!(PathBuf));
    Generated::command("smooth", "Measures the errors of smoothed edges, and draws some", "docs")
        .arg(sheet.help("Write a contact sheet of all scenes and methods, too"))
}

pub(crate) fn run(given: &mut ArgMatches) -> Result<ExitCode, String> {
    let sheet: Option<PathBuf> = given.remove_one("sheet");
    let folder = Generated::from(PROGRAM, given);
    let (mut rows, mut pictures) = (Vec::new(), Vec::new());
    for mut scene in scenes() {
        let changes = changes_over_a_turn(&mut scene);
        for size in SIZES {
            let poses = errors_over_poses(&mut scene, size);
            let (mesh, camera) = (scene.mesh(), camera(size[0], size[1]).library());
            let reference = reference(&scene, &camera.place(&mesh, &scene.model.library()), size);
            let plain = METHODS[0].1.picture(&scene, size);
            for (((name, method), change), over_poses) in METHODS.iter().zip(changes).zip(poses) {
                let has_creases = method.is_for(&scene);
                let picture = if has_creases { method.picture(&scene, size) } else { plain.clone() };
                let (rms, far, worse) = reference.errors(&picture, &plain);
                let [rms, far, over_poses] =
                    [rms, far, over_poses].map(|error| (10.0 * error).round() / 10.0);
                let mut row = json!({"scene": scene.name, "width": size[0], "height": size[1], "method": name, "rms": rms,
                    "rms_over_poses": over_poses, "over_20_percent": far, "worse": worse});
                if size == SIZES[1] {
                    row["largest_change"] = (change.round() as u32).into();
                }
                rows.extend(has_creases.then(|| row.to_string()));
                pictures.push((size, picture));
            }
        }
    }
    if let Some(file) = sheet {
        pictures.retain(|(size, _)| *size == SIZES[1]);
        let pictures: Vec<_> = pictures.into_iter().map(|(_, picture)| picture).collect();
        files::write(&[(&*file, in_rows(&pictures, SIZES[1], METHODS.len(), 2)?)])?;
    }
    let text = format!(
        "{{\n\"command\": \"cargo run --release {PROGRAM}\",\n\"rows\": [\n{}\n]\n}}\n",
        rows.join(",\n")
    );
    let data = folder.within("data/smooth.json").finish_page(&text)?;
    let picture = folder.within("smooth.png").finish(&gear()?)?;
    Ok(if data == ExitCode::SUCCESS { picture } else { data })
}

/// The errors of each method, root mean square, over poses of a full turn.
fn errors_over_poses(scene: &mut Scene, size: [u32; 2]) -> [f64; METHODS.len()] {
    const POSES: u32 = 20;
    /// The first pose, about 1° from the one that is measured alone.
    const FIRST: u32 = 12_345_678;
    let (model, mut squares) = (scene.model.0.clone(), [0.0; METHODS.len()]);
    for pose in 0..POSES {
        scene.model.0 = [vec![Step::Y(FIRST + pose * (u32::MAX / POSES))], model.clone()].concat();
        let (mesh, camera) = (scene.mesh(), camera(size[0], size[1]).library());
        let reference = reference(scene, &camera.place(&mesh, &scene.model.library()), size);
        for ((_, method), square) in
            METHODS.iter().zip(&mut squares).filter(|((_, method), _)| method.is_for(scene))
        {
            let picture = method.picture(scene, size);
            *square += reference.errors(&picture, &picture).0.powi(2);
        }
    }
    scene.model.0 = model;
    squares.map(|square| (square / f64::from(POSES)).sqrt())
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
    /// Whether the scene has what is smoothed: a surface that is shaded smoothly has no creases.
    fn is_for(&self, scene: &Scene) -> bool {
        !scene.is_smooth || !matches!(self, Self::Smooth(true))
    }

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
    let mut pictures = Vec::new();
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
    for smooth_faces in [false, true] {
        let style = Style { smooth_faces, ..Style::chosen(Mode::Solid, Format::Rgb565, None, None, false) };
        let (subject, from) = (Subject::new(&scene, &style), (&scene, &quantised));
        let pixels = picture(&subject, from, &style, Format::Rgb565)?.0;
        let [width, height] = SIZE;
        let magnified = |i: u32| {
            let (x, y) = (PART[0] + i % width / TIMES, PART[1] + i / width / TIMES);
            pixels[(y * width + x) as usize]
        };
        let magnified = (0..width * height).map(magnified).collect();
        pictures.extend([pixels, magnified]);
    }
    in_rows(&pictures, SIZE, 4, 1)
}

/// Pictures of one size in rows, each magnified, as a PNG file.
fn in_rows(
    pictures: &[Vec<Rgb888>],
    [width, height]: [u32; 2],
    columns: usize,
    times: u32,
) -> Result<Vec<u8>, String> {
    const GAP: u32 = 8;
    let cell = Size::new(width, height) * times + Size::new_equal(GAP);
    let rows = pictures.len().div_ceil(columns);
    let size = Size::new(columns as u32, rows as u32).component_mul(cell) - Size::new_equal(GAP);
    let mut sheet = Canvas::new(size, Rgb888::WHITE);
    for (place, pixels) in (0..).zip(pictures) {
        let at = Size::new(place % columns as u32, place / columns as u32).component_mul(cell);
        let area = Rectangle::new(Point::zero() + at, Size::new(width, height) * times);
        let wide = width * times;
        let colour = |i: u32| pixels[(i / wide / times * width + i % wide / times) as usize];
        let Ok(()) = sheet.fill_contiguous(&area, (0..wide * height * times).map(colour));
    }
    still::png(size, sheet.pixels()).map_err(|e| e.to_string())
}
