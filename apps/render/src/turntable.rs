//! A film of a mesh that turns once, as a GIF.

use crate::model::{self, Fit, Look};
use crate::paint::{Style, Subject};
use crate::palette::Palette;
use crate::picture::{picture, Format};
use crate::quantised::Quantised;
use crate::scene::{Colors, Scene};
use crate::texture::SceneTexture;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use pinhole_apps_support::animation::Animation;
use pinhole_import::Triangles;
use std::error::Error;

/// Duration of a turn in 1/100 s.
const TURN: u32 = 400;

pub(crate) fn gif(
    (mesh, colors, texture): (&Triangles, &Colors, Option<&SceneTexture>),
    look: &Look,
    style: &Style,
    format: Format,
    least_turn: Option<f64>,
    frames: u32,
) -> Result<Vec<u8>, String> {
    let mut pictures = Vec::new();
    let mut subject = None;
    for frame in 0..frames {
        // The camera moves left, so that the mesh appears to turn right.
        let yaw = look.yaw - 360.0 * f64::from(frame) / f64::from(frames);
        // A sphere has one size from all sides; an outline must fit from all sides.
        let fit = if look.fit == Fit::Outline { Fit::Turn } else { look.fit };
        let look = Look { yaw, fit, ..*look };
        let scene = model::scene(mesh.clone(), colors.clone(), &look)?;
        let (quantised, used) = Quantised::settle(&Scene { texture: texture.cloned(), ..scene })?;
        let subject = subject.get_or_insert_with(|| Subject::with_edges(&used, style.mode, least_turn));
        pictures.push(picture(subject, (&used, &quantised), style, format)?.0);
    }
    film(Size::new(look.width, look.height), &pictures)
}

/// A film of pictures, which lasts one [`TURN`].
pub(crate) fn film(size: Size, pictures: &[Vec<Rgb888>]) -> Result<Vec<u8>, String> {
    encode(size, pictures, &Palette::of(pictures.iter().flatten().map(channels))).map_err(|e| e.to_string())
}

fn encode(size: Size, pictures: &[Vec<Rgb888>], palette: &Palette) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut film = Animation::new(Vec::new(), size, &palette.colours)?;
    // Frame times are rounded from the start of the film, so that any number of frames lasts one TURN.
    let moment = |frame: usize| frame as u32 * TURN / pictures.len() as u32;
    for (frame, pixels) in pictures.iter().enumerate() {
        let delay = (moment(frame + 1) - moment(frame)).max(2) as u16; // players take less for 10
        film.add(pixels.iter().map(|&colour| palette.index(channels(&colour))).collect(), delay)?;
    }
    Ok(film.finish()?)
}

fn channels(colour: &Rgb888) -> [u8; 3] {
    [colour.r(), colour.g(), colour.b()]
}
