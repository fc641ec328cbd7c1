//! Sprites of scenes: pictures that face the viewer, at points of the world.

use crate::json::Field;
use crate::picture_file;
use crate::scene::LARGEST;
use embedded_graphics::geometry::{AnchorPoint, Point};
use embedded_graphics::primitives::{Circle, ContainsPoint};
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

pub const SHAPES: [(&str, Shape); 2] = [("square", Shape::Square), ("disc", Shape::Disc)];

pub const ANCHORS: [(&str, AnchorPoint); 9] = [
    ("center", AnchorPoint::Center),
    ("top-left", AnchorPoint::TopLeft),
    ("top-center", AnchorPoint::TopCenter),
    ("top-right", AnchorPoint::TopRight),
    ("center-left", AnchorPoint::CenterLeft),
    ("center-right", AnchorPoint::CenterRight),
    ("bottom-left", AnchorPoint::BottomLeft),
    ("bottom-center", AnchorPoint::BottomCenter),
    ("bottom-right", AnchorPoint::BottomRight),
];

/// The sprites of a scene file in this folder. The error names the field.
pub(crate) fn read(sprites: &Field<'_>, folder: &Path) -> Result<Vec<SceneSprites>, String> {
    sprites.list()?.map(|entry| read_entry(&entry, folder)).collect()
}

fn read_entry(entry: &Field<'_>, folder: &Path) -> Result<SceneSprites, String> {
    let [at, picture, color, key, pixels, size, height, anchor, alpha, depth] = entry
        .fields(["at", "picture", "color", "key", "pixels", "size", "height", "anchor", "alpha", "depth"])?;
    let at = at.ok_or_else(|| {
        entry.error("at is missing: give a point of the world, [x, y, z], or a list of points")
    })?;
    let picture = read_picture(entry, [picture, color, key], folder)?;
    let whole = |low, high| move |field: Field<'_>| field.integer(low, high);
    let size = match [pixels, size, height] {
        [None, None, None] => SpriteSize::Pixels(1),
        [Some(pixels), None, None] => SpriteSize::Pixels(pixels.integer(1, 255)? as u8),
        [None, Some(size), None] => SpriteSize::World(size.array(positive)?),
        [None, None, Some(height)] => SpriteSize::Height(positive(height)?),
        [pixels, size, height] => {
            let all = [pixels, size, height].into_iter().flatten();
            let message = "is given together with another size: give one of pixels, size and height";
            return Err(all.last().map_or_else(String::new, |field| field.error(message)));
        }
    };
    let anchor = match anchor {
        None => Anchor::Named(AnchorPoint::Center),
        Some(anchor) if anchor.list().is_ok() => {
            Anchor::Texel(anchor.array(whole(0, LARGEST.into()))?.map(|number| number as u32))
        }
        Some(anchor) => Anchor::Named(anchor.one_of(&ANCHORS)?),
    };
    Ok(SceneSprites {
        picture,
        points: read_points(&at)?,
        size,
        anchor,
        alpha: alpha.map(whole(0, 32)).transpose()?.map(|alpha| alpha as u8),
        depth_tested: depth.map_or(Ok(true), |depth| depth.one_of(&[("test", true), ("none", false)]))?,
    })
}

/// A point, or a list of points.
fn read_points(at: &Field<'_>) -> Result<Vec<[f64; 3]>, String> {
    let Some(first) = at.list()?.next() else {
        return Err(at.error("has no points: give [x, y, z], or a list of points"));
    };
    let is_list = first.list().is_ok();
    match is_list {
        true => at.list()?.map(|point| point.vector()).collect(),
        false => Ok(vec![at.vector()?]),
    }
}

fn positive(field: Field<'_>) -> Result<f64, String> {
    let number = field.number()?;
    match number > 0.0 {
        true => Ok(number),
        false => Err(field.error(format_args!("{number} is not more than 0"))),
    }
}

fn read_picture(
    entry: &Field<'_>,
    [picture, color, key]: [Option<Field<'_>>; 3],
    folder: &Path,
) -> Result<SpritePicture, String> {
    let ready = |name: &str| SHAPES.iter().find(|(known, _)| *known == name).map(|(_, shape)| *shape);
    let name = picture.as_ref().map(Field::text).transpose()?;
    match (name.map_or(Some(Shape::Square), ready), picture) {
        (None, Some(file)) => match color {
            None => read_file(&file, key.as_ref(), folder),
            Some(color) => {
                let message =
                    "is for \"square\" and \"disc\", and picture names a file: leave one of them out";
                Err(color.error(message))
            }
        },
        (shape, picture) => {
            if let Some(key) = key {
                return Err(
                    key.error("is the transparent colour of a file, and picture names none: leave it out")
                );
            }
            let missing = match picture {
                None => "picture and color are missing: give a file, or the colour of a square",
                Some(_) => "color is missing: give the colour of the picture, [r, g, b]",
            };
            let color = color.ok_or_else(|| entry.error(missing))?;
            Ok(SpritePicture::Ready(shape.unwrap_or(Shape::Square), color.color()?))
        }
    }
}

/// A picture from a file, whose pixels are transparent where they are less than half opaque or have the colour `key`.
fn read_file(picture: &Field<'_>, key: Option<&Field<'_>>, folder: &Path) -> Result<SpritePicture, String> {
    let name = picture.text()?;
    let path = folder.join(name);
    let (size, pixels) = picture_file::read(&path, LARGEST).map_err(|e| picture.error(e))?;
    let color = key.map(Field::color).transpose()?;
    let is_key = |&[r, g, b, _]: &[u8; 4]| color == Some([r, g, b]);
    if let (Some(key), Some([r, g, b])) = (key, color) {
        if !pixels.iter().any(is_key) {
            return Err(key.error(format_args!("no pixel of {name} has the colour [{r}, {g}, {b}]")));
        }
    }
    let texel = |pixel: &[u8; 4]| {
        let [r, g, b, opacity] = *pixel;
        (opacity >= 128 && !is_key(pixel)).then_some([r, g, b])
    };
    let texels: Arc<[_]> = pixels.iter().map(texel).collect();
    if texels.iter().all(Option::is_none) {
        return Err(picture.error(format_args!("{name} shows nothing: all of its pixels are transparent")));
    }
    Ok(SpritePicture::File { path, size: size.map(|side| side as u32), texels, key: color })
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
