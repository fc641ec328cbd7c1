//! Turns the teapot once, half of the turn solid and half as a wireframe, and writes an animated GIF:
//!
//! ```text
//! cargo run --release --example spin -- --help
//! ```
//!
//! Your own model: `cargo run --release -p pinhole-render -- MODEL.stl --gif turn.gif`.

mod scene;

use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use pinhole::prelude::*;
use pinhole_apps_support::animation::Animation;
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::command;
use pinhole_apps_support::generated::Generated;
use scene::Turntable;
use std::error::Error;
use std::process::ExitCode;
use teapot::{NORMALS, VERTICES};

const SIZE: Size = Size::new_equal(240);
const FRAMES: u32 = 48;

const BACKGROUND: Rgb565 = Rgb565::new(1, 4, 5);
const CLAY: Rgb565 = Rgb565::new(31, 44, 14);
const WIRE: Rgb565 = Rgb565::new(14, 56, 31);
/// Ambient light, also for the inside; 256 is full.
const AMBIENT: u16 = 48;

fn main() -> ExitCode {
    command::run(|| {
        let about = "Turns a teapot once, drawn as on a microcontroller, and writes an animated GIF";
        let file = Generated::arguments("--example spin", about, "target/spin/spin.gif")?;
        file.finish(&film().map_err(|e| e.to_string())?)
    })
}

/// The animation as a GIF file, 6/100 s a frame.
fn film() -> Result<Vec<u8>, Box<dyn Error>> {
    let table = Turntable::new(SIZE)?;
    let palette = palette();
    let colours: Vec<_> = palette.iter().map(|&c| Rgb888::from(c)).map(|c| [c.r(), c.g(), c.b()]).collect();
    let mut animation =
        Animation::new(Vec::new(), [SIZE.width, SIZE.height].map(|side| side as u16), &colours)?;
    // All memory that drawing needs; firmware has smaller sizes.
    let mut painter = Box::new(Painter::<Rgb565, 65_536, 65_535>::new());
    let mut cache = vec![ScreenVertex::default(); VERTICES.len()];
    for frame in 0..FRAMES {
        let mut canvas = Canvas::new(SIZE, BACKGROUND);
        let model = Turntable::model(frame, FRAMES);
        let instances = table.place(&model);
        if frame < FRAMES / 2 {
            let light = Lambert::new(&model, Vector3::from_ints(-2, 3, 4), AMBIENT)?;
            let shade = |face: usize| match NORMALS.get(face) {
                Some(&normal) => CLAY.dim(light.level(normal)),
                None => CLAY.dim(AMBIENT), // the inside
            };
            scene::paint(&mut painter, &instances, shade, &mut canvas)?;
        } else {
            instances[0].edges(|_| WIRE).cached(&mut cache).draw(&mut canvas)?;
        }
        let index = |c: &Rgb565| palette.iter().position(|other| other == c).map(|place| place as u8);
        let indices: Option<Vec<u8>> = canvas.pixels().iter().map(index).collect();
        animation.add(indices.ok_or("a colour is missing in the palette")?, None, 6)?;
    }
    Ok(animation.finish()?)
}

/// All colours of the frames, fewer than 256.
fn palette() -> Vec<Rgb565> {
    let mut palette = vec![BACKGROUND, WIRE];
    palette.extend((0..=256).map(|level| CLAY.dim(level)));
    palette.sort_unstable_by_key(|c| c.into_storage());
    palette.dedup();
    palette
}
