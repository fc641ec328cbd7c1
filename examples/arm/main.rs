//! One cycle of a robot arm: a hierarchy of joints, two meshes for ten nodes, the tool's path as a poly-line, and a shadow of
//! the parts projected to the floor. Writes an animated GIF and a contact sheet:
//!
//! ```text
//! cargo run --release --example arm -- --help
//! ```

mod meshes;
mod robot;

use clap::Command;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use pinhole::space::World;
use pinhole::{
    Affine, Angle, Camera, Cull, Dim, Hierarchy, Lambert, Mesh, Painter, Point3, Projection, Scalar,
    Statistics, Vector3, ViewTransform, Viewport,
};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::command::Film;
use pinhole_apps_support::{command, film};
use robot::{Form, Paint};
use std::collections::BTreeMap;
use std::error::Error;
use std::process::ExitCode;

const BACKGROUND: Rgb565 = Rgb565::new(3, 8, 6);
const FLOOR: Rgb565 = Rgb565::new(7, 17, 10);
const GRID: Rgb565 = Rgb565::new(10, 24, 14);
const SHADOW: Rgb565 = Rgb565::new(4, 10, 6);
const PATH: Rgb565 = Rgb565::new(10, 54, 31);
const STEEL: Rgb565 = Rgb565::new(22, 46, 25);
const ORANGE: Rgb565 = Rgb565::new(31, 36, 4);
const RUBBER: Rgb565 = Rgb565::new(12, 26, 14);

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, Box<dyn Error>> {
        let about = "Moves a robot arm through one cycle: an animated GIF and a contact sheet";
        let command = Command::new("arm").about(about);
        let command = Film::arguments(command, "Frames of the cycle, 2 to 720", "60", "target/arm");
        film(&Film::from(&mut command::matches(command)?))?;
        Ok(ExitCode::SUCCESS)
    })
}

fn film(arguments: &Film) -> Result<(), Box<dyn Error>> {
    let (size, frames) = (Size::new_equal(arguments.size), arguments.frames);
    let out = &arguments.out;
    command::folder(out)?;

    let camera = camera(size)?;
    let mut nodes = robot::nodes();
    let mut robot = Hierarchy::new(&mut nodes)?;
    let phase = |frame: u32| Angle::turns(frame as i32, frames);
    // The path is closed: its last point is its first.
    let path: Vec<[Scalar; 3]> = (0..=frames)
        .map(|frame| {
            robot::pose(&mut robot, phase(frame));
            let tip = robot::tip(&robot);
            [tip.x(), tip.y(), tip.z()]
        })
        .collect();

    let mut total = Statistics::default();
    let mut pictures = Vec::new();
    for frame in 0..frames {
        let mut canvas = Canvas::new(size, BACKGROUND);
        robot::pose(&mut robot, phase(frame));
        total = total.and(draw(&robot, &path, &camera, &mut canvas)?);
        pictures.push(canvas);
    }

    let (gif, sheet) = (out.join("arm.gif"), out.join("contact-sheet.png"));
    let mut film = film::Gif::create(&gif, size, &palette(&pictures))?;
    for picture in &pictures {
        film.add(picture.pixels())?;
    }
    film.finish()?;
    let sample = (0..).zip(pictures).filter(|(frame, _)| film::on_sheet(*frame, frames, 12));
    film::write_sheet(&sheet, size, &sample.map(|(_, picture)| picture).collect::<Vec<_>>())?;
    command::say(gif.display())?;
    command::say(sheet.display())?;
    let Statistics { drawn, culled, clipped, outside, degenerate } = total;
    command::say(format_args!(
        "{} nodes; {frames} frames: {drawn} faces drawn, {culled} culled, {clipped} clipped, {outside} outside, \
         {degenerate} degenerate",
        robot.nodes().len(),
    ))?;
    Ok(())
}

/// The camera: in front of the robot, to its right and above.
fn camera(size: Size) -> Result<Camera, Box<dyn Error>> {
    let viewing = ViewTransform::look_at(
        Point3::from_f32(6.4, 4.2, 4.9)?,
        Point3::from_f32(0.25, 1.2, 0.15)?,
        Vector3::from_ints(0, 1, 0),
    )?;
    let projection =
        Projection::perspective(Angle::degrees(34), size, Scalar::from_int(2), Scalar::from_int(20))?;
    Ok(Camera::new(&viewing, &projection, &Viewport::new(Point::zero(), size)?))
}

/// Draws floor, shadow, path and robot. Later ones cover earlier ones, which is wrong only for parts of the path in front of
/// the robot.
fn draw(
    robot: &Hierarchy<'_>,
    path: &[[Scalar; 3]],
    camera: &Camera,
    canvas: &mut Canvas<Rgb565>,
) -> Result<Statistics, Box<dyn Error>> {
    let (drum, beam) = (meshes::drum()?, meshes::beam()?);
    let mesh = |form: Form| match form {
        Form::Drum => &drum,
        Form::Beam => &beam,
    };
    let towards_light = Vector3::from_ints(1, 4, 3);

    let floor = meshes::floor()?;
    let floor = camera.place(&floor, &Affine::identity());
    floor.solid(|_| FLOOR, &mut [], canvas)?;
    // Projects along the light onto y = 0.
    let flat = Affine::<World, World>::from_frame(
        Vector3::from_ints(1, 0, 0),
        Vector3::from_f32(-0.25, 0.0, -0.75)?,
        Vector3::from_ints(0, 0, 1),
        Point3::from_ints(0, 0, 0),
    );
    for part in robot::parts(robot) {
        let shadow = camera.place(mesh(part.form), &part.place.then(&flat)).with_cull(Cull::None);
        shadow.solid(|_| SHADOW, &mut [], canvas)?;
    }
    floor.wireframe(GRID, &mut [], canvas)?;

    let path = Mesh::from_fixed(path, &[])?;
    camera.place(&path, &Affine::identity()).polyline(PATH, canvas)?;

    let mut painter = Painter::<Rgb565, 512, 512>::new();
    let mut statistics = Statistics::default();
    for part in robot::parts(robot) {
        let mesh = mesh(part.form);
        let light = Lambert::new(&part.place, towards_light, 72)?;
        let colour = match part.paint {
            Paint::Steel => STEEL,
            Paint::Orange => ORANGE,
            Paint::Rubber => RUBBER,
        };
        // Light in steps of 8, so that a palette of 256 holds all colours.
        let shade = |face: usize| colour.dim(light.level(mesh.normals()[face]) & !7);
        painter.add(&camera.place(mesh, &part.place), shade)?;
        if part.carries {
            // The base is drawn first: its large faces would sort wrongly among the small faces of other parts.
            statistics = statistics.and(painter.draw(canvas)?);
        }
    }
    Ok(statistics.and(painter.draw(canvas)?))
}

/// Every colour of the frames.
fn palette(pictures: &[Canvas<Rgb565>]) -> Vec<Rgb565> {
    let colours: BTreeMap<_, _> =
        pictures.iter().flat_map(Canvas::pixels).map(|&c| (c.into_storage(), c)).collect();
    colours.into_values().collect()
}
