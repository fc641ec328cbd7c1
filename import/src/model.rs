//! The result of a reader: triangles, where each is in the file, and doubtful points.

use crate::materials::Pictures;
use crate::Triangles;
use std::fmt;
use std::path::PathBuf;

/// A model as it is in its file.
#[derive(Debug, Default)]
pub(crate) struct Model {
    pub(crate) triangles: Triangles,
    pub(crate) places: Places,
    pub(crate) warnings: Vec<Warning>,
    /// The colours of the triangles, if the file has materials.
    pub(crate) colors: Option<Colors>,
    /// The texture coordinates of the triangles' corners, if the file has any.
    pub(crate) texture: Option<TextureFaces>,
    /// The pictures that materials name.
    pub(crate) pictures: Pictures,
    /// The file, beside which pictures are looked for.
    pub(crate) file: PathBuf,
    /// Files read beside the model.
    pub(crate) libraries: Vec<PathBuf>,
}

/// Colours of triangles.
#[derive(Debug, Default)]
pub(crate) struct Colors {
    /// At most 256 colours.
    pub(crate) palette: Vec<[u8; 3]>,
    /// The light that a triangle of each colour emits; or nothing, where none emits any.
    pub(crate) emission: Vec<[u8; 3]>,
    /// The colour of each triangle.
    pub(crate) faces: Vec<u8>,
}

/// Texture coordinates in sides of the texture, u to the right and v down, and those of each triangle's corners.
#[derive(Debug, Default)]
pub(crate) struct TextureFaces {
    pub(crate) coords: Vec<[f64; 2]>,
    pub(crate) faces: Vec<[usize; 3]>,
}

/// Where the triangles are in the file.
#[derive(Debug, Default)]
pub(crate) enum Places {
    /// Nowhere: they come from a program.
    #[default]
    Unknown,
    /// In the lines with these numbers, from 1.
    Lines(Vec<u32>),
    /// In a binary file, one after the other.
    Records,
}

impl Places {
    /// A triangle's place in words, if it is known, and its line.
    fn of(&self, triangle: usize) -> (Option<String>, Option<usize>) {
        match self {
            Places::Unknown => (None, None),
            Places::Lines(lines) => {
                let line = lines.get(triangle).map(|&line| line as usize);
                (line.map(|line| format!("line {line}")), line)
            }
            Places::Records if triangle == NOWHERE => (None, None),
            Places::Records => (Some(format!("triangle {}", triangle + 1)), None),
        }
    }
}

/// The place of a triangle that is none of the file's.
pub(crate) const NOWHERE: usize = usize::MAX;

/// Something doubtful about a model that could be read. Its `Display` is one line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// The line of the file, counted from 1, where it is seen first, if that is known.
    pub line: Option<usize>,
    /// A message that says what looks wrong in the file, and what to do.
    pub message: String,
}

impl Warning {
    /// A warning about several triangles: what is doubtful, the place of the first, and what follows from it and what to do.
    pub(crate) fn at(what: &str, places: &Places, first: usize, then: &str) -> Self {
        let (place, line) = places.of(first);
        let place = place.map_or_else(String::new, |at| format!(", the first at {at}"));
        Warning { line, message: format!("{what}{place}; {then}") }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}
