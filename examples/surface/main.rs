//! Ripples on water: a height field whose vertices change in every frame, coloured by height, lit and dithered to eight
//! bits a pixel, under a hidden-line grid, drawn in bands; an animated GIF and a contact sheet:
//!
//! ```text
//! cargo run --release --example surface -- --help
//! ```

mod rgb332;
mod water;

use clap::Command;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use pinhole::space::{Model, World};
use pinhole::{
    edge_faces, Affine, Angle, Camera, Channels, DepthBuffer, Flat, Frame, Gouraud, Lambert, PixelFormat,
    Point3, Projection, Scalar, ScreenVertex, Statistics, Vector3, ViewTransform, Viewport,
};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::command::Film;
use pinhole_apps_support::{command, film};
use rgb332::Rgb332;
use std::error::Error;
use std::process::ExitCode;
use water::Water;

/// Rows of a band.
const ROWS: u32 = 16;

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, Box<dyn Error>> {
        let about =
            "Draws ripples on a height field that changes in every frame: an animated GIF and a contact sheet";
        let command = Command::new("surface").about(about);
        let command =
            Film::arguments(command, "Frames of a ripple's period, 2 to 720", "24", "target/surface");
        film(&Film::from(&mut command::matches(command)?))?;
        Ok(ExitCode::SUCCESS)
    })
}

fn film(arguments: &Film) -> Result<(), Box<dyn Error>> {
    let (size, frames) = (Size::new_equal(arguments.size), arguments.frames);
    let out = &arguments.out;
    command::folder(out)?;

    // All memory that a microcontroller needs: the surface, its transformed vertices, bin storage and two strips.
    let mut water = Water::new();
    let beside = edge_faces(&water::EDGES, &water::FACES);
    let mut memory = Memory::new(size);
    let camera = camera(size)?;
    let (gif, sheet) = (out.join("surface.gif"), out.join("contact-sheet.png"));
    let palette: Vec<Rgb565> = Rgb332::all().map(Rgb565::from).collect();
    let mut film = film::Gif::create(&gif, size, &palette)?;
    let (mut total, mut sample) = (Statistics::default(), Vec::new());
    for frame in 0..frames {
        water.ripple(Angle::turns(frame as i32, frames));
        let mut canvas = Canvas::new(size, Rgb565::BLACK);
        total = total.and(draw(&water, &beside, &camera, &mut memory, &mut canvas)?);
        film.add(canvas.pixels())?;
        if film::on_sheet(frame, frames, 4) {
            sample.push(canvas);
        }
    }
    film.finish()?;
    film::write_sheet(&sheet, size, &sample)?;
    command::say(gif.display())?;
    command::say(sheet.display())?;
    let Statistics { drawn, culled, .. } = total;
    command::say(format_args!(
        "{frames} frames in bands of {ROWS} rows: {drawn} faces drawn, {culled} culled"
    ))?;
    Ok(())
}

/// Buffers that the library uses during a frame.
struct Memory {
    corners: Vec<ScreenVertex>,
    faces: Vec<u16>,
    edges: Vec<u16>,
    strip: Vec<u8>,
    depth: Vec<u16>,
}

impl Memory {
    fn new(size: Size) -> Self {
        Self {
            corners: vec![ScreenVertex::EMPTY; water::VERTICES],
            faces: vec![0; water::FACES.len() + water::FACES.len().div_ceil(16)],
            edges: vec![0; water::EDGES.len() + water::EDGES.len().div_ceil(16)],
            strip: vec![0; Frame::<Rgb332>::strip_bytes(size.width, ROWS)],
            depth: vec![0; (size.width * ROWS) as usize],
        }
    }
}

fn draw(
    water: &Water,
    beside: &[[u16; 2]],
    camera: &Camera,
    memory: &mut Memory,
    display: &mut Canvas<Rgb565>,
) -> Result<Statistics, Box<dyn Error>> {
    let model = Affine::<Model, World>::identity();
    let mesh = water.mesh()?.with_edge_faces(beside)?;
    let mut levels = [0; water::VERTICES];
    Lambert::new(&model, Vector3::from_ints(-2, 1, 3), 90)?.levels(mesh.vertex_normals(), &mut levels);
    // Vertex colours: by height, dimmed by light.
    let mut colours = [Flat::default(); water::VERTICES];
    for (colour, (height, level)) in colours.iter_mut().zip(water.heights().zip(levels)) {
        *colour = Flat::lit(water::colour(height), level);
    }

    let instance = camera.place(&mesh, &model);
    let projected = instance.transform_depth(&mut memory.corners);
    let mut faces = projected.bin_faces(&mut memory.faces)?;
    let mut grid = projected.bin_edges(&mut memory.edges)?;
    let mut frame = Frame::new(display.bounding_box(), Rgb332::from_channels([1, 1, 1]));
    while let Some(mut band) = frame.next_band(&mut memory.strip)? {
        let mut depth = DepthBuffer::new(band.area(), &mut memory.depth)?;
        let smooth = |face| Gouraud::new(mesh.corners_of(face, &colours)).dithered();
        faces.depth_tested(smooth, &mut depth, &mut band)?;
        grid.hidden_line(Rgb332::decode(0), &mut depth, &mut band)?;
        // For a display with this pixel format: band.send(display).
        display.fill_contiguous(&band.area(), band.colors().map(Rgb565::from))?;
    }
    Ok(faces.statistics())
}

/// From above, with z up.
fn camera(size: Size) -> Result<Camera, Box<dyn Error>> {
    let viewing = ViewTransform::look_at(
        Point3::from_f32(2.6, -5.2, 4.4)?,
        Point3::from_f32(-0.15, 0.0, -0.3)?,
        Vector3::from_ints(0, 0, 1),
    )?;
    let projection =
        Projection::perspective(Angle::degrees(41), size, Scalar::from_int(2), Scalar::from_int(14))?;
    Ok(Camera::new(&viewing, &projection, &Viewport::new(Point::zero(), size)?))
}
