//! The meshes of a scene file: lists of numbers or files, each with a place of its own, as one list of triangles.

use crate::json::{self, at, Color, Whole};
use crate::scene::{in_the_world, Colors, Matrix, IDENTITY};
use pinhole_import::{Options, Triangles};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// The colour of a face that has none, beside faces that have one: the importer's for faces without a material.
const GREY: [u8; 3] = [204; 3];

/// The indices of a triangle's vertices.
pub(crate) type Face = [Whole<0, { i32::MAX }>; 3];

/// A mesh in a scene file: a file, or lists.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Entry {
    pub(crate) mesh: Option<String>,
    pub(crate) vertices: Option<Vec<[f64; 3]>>,
    pub(crate) triangles: Option<Vec<Face>>,
    pub(crate) model: Option<Matrix>,
    pub(crate) colors: Option<Vec<Color>>,
    pub(crate) emission: Option<Vec<Color>>,
}

/// The lists of a mesh in a file of their own, and texts that are ignored.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Lists {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<Face>,
    #[serde(rename = "name")]
    _name: Option<String>,
    #[serde(rename = "source")]
    _source: Option<String>,
    #[serde(rename = "licence")]
    _licence: Option<String>,
}

/// Triangles and what the files that they come from say about them.
#[derive(Default)]
pub(crate) struct Meshes {
    pub(crate) triangles: Triangles,
    pub(crate) colors: Colors,
    /// The files that were read.
    pub(crate) files: Vec<PathBuf>,
}

impl Meshes {
    /// The mesh of an entry in the field `place`. `problem` names the scene in an error; errors in the file of a mesh name that file.
    pub(crate) fn one(
        entry: Entry,
        place: &str,
        folder: &Path,
        problem: &impl Fn(String) -> String,
    ) -> Result<Self, String> {
        let mut one = match (entry.mesh, entry.vertices, entry.triangles) {
            (Some(name), None, None) if name.is_empty() => {
                return Err(problem(format!("{}: is empty and should name a file", at(place, "mesh"))));
            }
            (Some(name), None, None) => Self::of_file(folder.join(name))?,
            (None, vertices, triangles) => {
                let missing = |field| problem(format!("{}: is missing", at(place, field)));
                let vertices = vertices.ok_or_else(|| missing("vertices"))?;
                let triangles = triangles.ok_or_else(|| missing("triangles"))?;
                let triangles = lists(vertices, &triangles, &at(place, "triangles")).map_err(problem)?;
                Self { triangles, ..Self::default() }
            }
            _ => {
                let mesh = at(place, "mesh");
                return Err(problem(format!("{mesh}: is given together with vertices or triangles")));
            }
        };
        one.set_colors([entry.colors, entry.emission], place).map_err(problem)?;
        if let Some(model) = &entry.model {
            if model[3] != IDENTITY[3] {
                return Err(problem(format!("{}: the last row is not [0, 0, 0, 1]", at(place, "model"))));
            }
            one.triangles.positions.iter_mut().for_each(|vertex| *vertex = in_the_world(model, *vertex));
        }
        Ok(one)
    }

    /// Takes the colours that an entry states, and light that it emits, instead of those of materials.
    pub(crate) fn set_colors(&mut self, colors: [Option<Vec<Color>>; 2], place: &str) -> Result<(), String> {
        if colors.iter().all(Option::is_none) {
            return Ok(());
        }
        let triangles = self.triangles.faces.len();
        for (colors, field) in colors.iter().zip(["colors", "emission"]) {
            let count = colors.as_ref().map_or(triangles, Vec::len);
            if count != triangles {
                let place = at(place, field);
                return Err(format!("{place}: has {count} colours, but there are {triangles} triangles"));
            }
        }
        let [faces, emission] =
            colors.map(|colors| colors.into_iter().flatten().map(|color| color.0).collect());
        self.colors = Colors { faces, emission };
        Ok(())
    }

    /// Meshes one behind the other, each where its matrix places it.
    pub(crate) fn several(
        entries: Vec<Entry>,
        folder: &Path,
        problem: &impl Fn(String) -> String,
    ) -> Result<Self, String> {
        let mut all = Self::default();
        for (index, entry) in entries.into_iter().enumerate() {
            all.add(Self::one(entry, &format!("meshes[{index}]"), folder, problem)?);
        }
        match all.triangles.faces.is_empty() {
            true => Err(problem("meshes: has no meshes".into())),
            false => Ok(all),
        }
    }

    fn add(&mut self, other: Self) {
        let (before, more) = (self.triangles.faces.len(), other.triangles.faces.len());
        let first = self.triangles.positions.len();
        self.triangles.positions.extend(other.triangles.positions);
        self.triangles
            .faces
            .extend(other.triangles.faces.iter().map(|face| face.map(|vertex| vertex + first)));
        let lists = [
            (&mut self.colors.faces, other.colors.faces, GREY),
            (&mut self.colors.emission, other.colors.emission, [0; 3]),
        ];
        for (all, of_other, usual) in lists {
            if !(all.is_empty() && of_other.is_empty()) {
                all.resize(before, usual);
                all.extend(of_other);
                all.resize(before + more, usual);
            }
        }
        self.files.extend(other.files);
    }

    /// Reads a mesh of any format, as it is in the file: the scene says how it lies and whether back faces are culled.
    fn of_file(file: PathBuf) -> Result<Self, String> {
        if file.extension().is_some_and(|e| e.eq_ignore_ascii_case("json")) {
            let Lists { vertices, triangles, .. } = json::read(&file)?;
            let triangles = lists(vertices, &triangles, "triangles")
                .map_err(|problem| format!("{}: {problem}", file.display()))?;
            return Ok(Self { triangles, files: vec![file], ..Self::default() });
        }
        let triangles = pinhole_import::read_triangles(&file).map_err(|e| e.to_string())?;
        if triangles.faces.is_empty() {
            // The importer's message.
            return Err(format!("{}: has no faces: export the model as a mesh", file.display()));
        }
        let mut all = Self { triangles, files: vec![file.clone()], ..Self::default() };
        // Faces that no firmware can have have no colours either.
        if let Ok(model) = pinhole_import::preview(&file, &Options::default()) {
            all.colors = Colors { faces: model.colors, emission: model.emission };
            all.files.extend(model.files);
        }
        Ok(all)
    }
}

fn lists(positions: Vec<[f64; 3]>, triangles: &[Face], place: &str) -> Result<Triangles, String> {
    if triangles.is_empty() {
        return Err(format!("{place}: has no faces"));
    }
    let faces: Vec<_> = triangles.iter().map(|face| face.map(|vertex| vertex.0 as usize)).collect();
    for (index, face) in faces.iter().enumerate() {
        if let Some(corner) = face.iter().position(|&vertex| vertex >= positions.len()) {
            let (vertex, count) = (face[corner], positions.len());
            return Err(format!("{place}[{index}][{corner}]: names vertex {vertex}, and there are {count}"));
        }
    }
    Ok(Triangles { positions, faces })
}
