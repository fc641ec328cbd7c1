//! The result of a reader: triangles, where each is in the file, and doubtful points.

use crate::materials::Pictures;
use crate::{Place, Problem, Triangles, Warning};
use std::path::PathBuf;

/// A model as it is in its file.
#[derive(Debug, Default)]
pub(crate) struct Model {
    pub(crate) triangles: Triangles,
    pub(crate) places: Places,
    pub(crate) warnings: Vec<Warning>,
    /// The ends of lines that are no sides of faces.
    pub(crate) lines: Vec<[[f64; 3]; 2]>,
    /// The colours of the triangles, if the file has any.
    pub(crate) colors: Option<Colors>,
    /// The texture coordinates of the triangles' corners, if the file has any.
    pub(crate) texture: Option<TextureFaces>,
    /// The pictures that materials name.
    pub(crate) pictures: Pictures,
    /// Files beside the model.
    pub(crate) files: Vec<PathBuf>,
}

impl Model {
    /// Refuses a model that is invalid, or has nothing to draw.
    pub(crate) fn check(&self) -> Result<(), Problem> {
        let Triangles { positions, faces } = &self.triangles;
        if faces.iter().flatten().any(|&i| i >= positions.len()) {
            return Err(Problem::NoSuchVertex);
        }
        if positions.iter().flatten().any(|c| !c.is_finite()) {
            return Err(Problem::NotFinite);
        }
        if faces.is_empty() && self.lines.is_empty() {
            return Err(Problem::NoFaces);
        }
        Ok(())
    }
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

impl Colors {
    /// For each triangle its item of a list that has one for each colour, or is empty.
    pub(crate) fn of_faces(&self, list: &[[u8; 3]]) -> Vec<[u8; 3]> {
        self.faces.iter().filter_map(|&color| list.get(usize::from(color)).copied()).collect()
    }
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
    /// A triangle's place.
    pub(crate) fn of(&self, triangle: usize) -> Place {
        match self {
            Places::Lines(lines) => {
                lines.get(triangle).map_or(Place::Unknown, |&line| Place::Line(line as usize))
            }
            Places::Records if triangle != NOWHERE => Place::Triangle(triangle + 1),
            _ => Place::Unknown,
        }
    }
}

/// The number of a triangle or vertex that is none of the file's.
pub(crate) const NOWHERE: usize = usize::MAX;
