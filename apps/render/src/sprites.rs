//! Sprites of scenes: pictures that face the viewer, at points of the world.

use crate::json::{self, at, Color, Names, Whole};
use crate::picture;
use crate::scene::LARGEST;
use embedded_graphics::geometry::{AnchorPoint, Point};
use embedded_graphics::primitives::{Circle, ContainsPoint};
use serde::Deserialize;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// One entry of a scene's `"sprites"`: points that show one picture.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSprites {
    pub picture: SpritePicture,
    /// Points of the world.
    pub points: Vec<[f64; 3]>,
    pub size: SpriteSize,
    pub anchor: Anchor,
    /// 32nds of the picture that are mixed with what is behind it; `None` stores its colours and depth.
    pub alpha: Option<u8>,
    /// Whether faces hide sprites, and sprites each other.
    pub depth_tested: bool,
}

#[derive(Clone, Debug, PartialEq)]
pub enum SpritePicture {
    /// The texels of a file row by row, `None` where they are transparent.
    File { path: PathBuf, size: [u32; 2], texels: Arc<[Option<[u8; 3]>]>, key: Option<[u8; 3]> },
    /// A ready shape of one colour.
    Ready(Shape, [u8; 3]),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Square,
    Disc,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpriteSize {
    /// Pixels for each texel of a file; the side of a ready shape.
    Pixels(u8),
    /// Width and height in world units.
    World([f64; 2]),
    /// Height in world units, with the width of square texels.
    Height(f64),
}

/// The point of the picture that lies at the point of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    Named(AnchorPoint),
    /// The upper left corner of the texel in a column and a row.
    Texel([u32; 2]),
}

/// Texels of a disc whose size is given in world units.
const DISC: u32 = 64;

impl Names for Shape {
    fn names() -> impl Iterator<Item = (&'static str, Self)> {
        [("square", Self::Square), ("disc", Self::Disc)].into_iter()
    }
}

impl Names for AnchorPoint {
    fn names() -> impl Iterator<Item = (&'static str, Self)> {
        [
            ("center", AnchorPoint::Center),
            ("top-left", AnchorPoint::TopLeft),
            ("top-center", AnchorPoint::TopCenter),
            ("top-right", AnchorPoint::TopRight),
            ("center-left", AnchorPoint::CenterLeft),
            ("center-right", AnchorPoint::CenterRight),
            ("bottom-left", AnchorPoint::BottomLeft),
            ("bottom-center", AnchorPoint::BottomCenter),
            ("bottom-right", AnchorPoint::BottomRight),
        ]
        .into_iter()
    }
}

/// An entry of a scene's `"sprites"`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Entry {
    at: Option<Value>,
    picture: Option<String>,
    color: Option<Color>,
    key: Option<Color>,
    pixels: Option<Whole<1, 255>>,
    size: Option<[f64; 2]>,
    height: Option<f64>,
    anchor: Option<Value>,
    alpha: Option<Whole<0, 32>>,
    depth: Option<Depth>,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Depth {
    Test,
    None,
}

/// The sprites of a scene file in this folder. The error names the field.
pub(crate) fn read(entries: Vec<Entry>, folder: &Path) -> Result<Vec<SceneSprites>, String> {
    let entry = |(index, entry)| read_entry(entry, &format!("sprites[{index}]"), folder);
    entries.into_iter().enumerate().map(entry).collect()
}

fn read_entry(entry: Entry, place: &str, folder: &Path) -> Result<SceneSprites, String> {
    let points = read_points(entry.at.unwrap_or_default(), &at(place, "at"))?;
    let picture = read_picture(entry.picture.as_deref(), entry.color, entry.key, place, folder)?;
    let positive = |number: f64, field: &str| match number > 0.0 {
        true => Ok(number),
        false => Err(format!("{}: {number} is not more than 0", at(place, field))),
    };
    let size = match (entry.pixels, entry.size, entry.height) {
        (pixels, None, None) => SpriteSize::Pixels(pixels.map_or(1, |pixels| pixels.0 as u8)),
        (None, Some([width, height]), None) => {
            SpriteSize::World([positive(width, "size[0]")?, positive(height, "size[1]")?])
        }
        (None, None, Some(height)) => SpriteSize::Height(positive(height, "height")?),
        _ => return Err(format!("{place}: has more than one size: give one of pixels, size and height")),
    };
    let anchor = match entry.anchor {
        None => Anchor::Named(AnchorPoint::Center),
        Some(Value::String(name)) => {
            let named = AnchorPoint::named(&name);
            Anchor::Named(named.map_err(|problem| format!("{}: {problem}", at(place, "anchor")))?)
        }
        Some(texel) => {
            let texel: [Whole<0, { LARGEST as i32 }>; 2] = json::field(texel, &at(place, "anchor"))?;
            Anchor::Texel(texel.map(|number| number.0 as u32))
        }
    };
    Ok(SceneSprites {
        picture,
        points,
        size,
        anchor,
        alpha: entry.alpha.map(|alpha| alpha.0 as u8),
        depth_tested: entry.depth != Some(Depth::None),
    })
}

/// A point, or a list of points.
fn read_points(at: Value, place: &str) -> Result<Vec<[f64; 3]>, String> {
    match &at {
        Value::Array(points) if points.first().is_some_and(Value::is_array) => json::field(at, place),
        Value::Array(numbers) if !numbers.is_empty() => Ok(vec![json::field(at, place)?]),
        _ => Err(format!("{place}: give a point of the world, [x, y, z], or a list of points")),
    }
}

fn read_picture(
    name: Option<&str>,
    color: Option<Color>,
    key: Option<Color>,
    place: &str,
    folder: &Path,
) -> Result<SpritePicture, String> {
    let shape = name.map_or(Some(Shape::Square), |name| Shape::named(name).ok());
    match (shape, name, color, key) {
        (None, Some(name), None, key) => {
            let path = folder.join(name);
            read_file(name, path, key.map(|key| key.0)).map_err(|problem| format!("{place}.{problem}"))
        }
        (None, _, Some(_), _) => Err(format!(
            "{place}.color: is for \"square\" and \"disc\", and picture names a file: leave one of them out"
        )),
        (Some(_), _, _, Some(_)) => Err(format!(
            "{place}.key: is the transparent colour of a file, and picture names none: leave it out"
        )),
        (Some(shape), _, Some(color), None) => Ok(SpritePicture::Ready(shape, color.0)),
        _ => Err(format!("{place}: color is missing: give the colour of the picture, [r, g, b], or a file")),
    }
}

/// A picture from a file, whose pixels are transparent where they are less than half opaque or have the colour `key`.
fn read_file(name: &str, path: PathBuf, key: Option<[u8; 3]>) -> Result<SpritePicture, String> {
    let (size, pixels) = picture::read_file(&path, LARGEST).map_err(|e| format!("picture: {e}"))?;
    let is_key = |&[r, g, b, _]: &[u8; 4]| key == Some([r, g, b]);
    if let Some(key) = key.filter(|_| !pixels.iter().any(is_key)) {
        return Err(format!("key: no pixel of {name} has the colour {key:?}"));
    }
    let texel = |pixel: &[u8; 4]| {
        let [r, g, b, opacity] = *pixel;
        (opacity >= 128 && !is_key(pixel)).then_some([r, g, b])
    };
    let texels: Arc<[_]> = pixels.iter().map(texel).collect();
    if texels.iter().all(Option::is_none) {
        return Err(format!("picture: {name} shows nothing: all of its pixels are transparent"));
    }
    Ok(SpritePicture::File { path, size: size.map(|side| side as u32), texels, key })
}

impl SceneSprites {
    /// The size of the picture and its texels.
    pub(crate) fn texels(&self) -> ([u32; 2], Vec<Option<[u8; 3]>>) {
        match &self.picture {
            SpritePicture::File { size, texels, .. } => (*size, texels.to_vec()),
            SpritePicture::Ready(Shape::Square, color) => ([1, 1], vec![Some(*color)]),
            SpritePicture::Ready(Shape::Disc, color) => {
                let side = match self.size {
                    SpriteSize::Pixels(side) => side.into(),
                    SpriteSize::World(_) | SpriteSize::Height(_) => DISC,
                };
                let disc = Circle::new(Point::zero(), side);
                let at = |index: u32| Point::new((index % side) as i32, (index / side) as i32); // below 256
                let texel = |index| disc.contains(at(index)).then_some(*color);
                ([side; 2], (0..side * side).map(texel).collect())
            }
        }
    }

    /// The file of the picture.
    pub fn file(&self) -> Option<&Path> {
        match &self.picture {
            SpritePicture::File { path, .. } => Some(path),
            SpritePicture::Ready(..) => None,
        }
    }

    /// Pixels for each texel, unless the size is in world units.
    pub(crate) fn magnification(&self) -> Option<u8> {
        match (self.size, &self.picture) {
            (SpriteSize::Pixels(_), SpritePicture::Ready(Shape::Disc, _)) => Some(1),
            (SpriteSize::Pixels(pixels), _) => Some(pixels),
            _ => None,
        }
    }

    /// The numbers in world units: those of points, then those of the size.
    pub(crate) fn world_numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let size = match self.size {
            SpriteSize::Pixels(_) => [0.0; 2],
            SpriteSize::World(size) => size,
            SpriteSize::Height(height) => [height; 2],
        };
        self.points.iter().flatten().copied().chain(size)
    }

    /// These sprites at other points.
    pub fn at(&self, point: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        Self { points: self.points.iter().map(|&from| point(from)).collect(), ..self.clone() }
    }

    /// These sprites with each number in world units replaced.
    pub(crate) fn map_numbers(&self, number: impl Fn(f64) -> f64) -> Self {
        let size = match self.size {
            SpriteSize::Pixels(pixels) => SpriteSize::Pixels(pixels),
            SpriteSize::World(size) => SpriteSize::World(size.map(&number)),
            SpriteSize::Height(height) => SpriteSize::Height(number(height)),
        };
        Self { points: self.points.iter().map(|point| point.map(&number)).collect(), size, ..self.clone() }
    }
}
