//! The meshes of a scene file: lists of numbers or files, each with a place of its own, as one list of triangles.

use crate::json::{Field, Json};
use crate::scene::{Colors, Matrix, IDENTITY};
use pinhole_import::{Options, Triangles};
use std::path::{Path, PathBuf};

/// The colour of a face that has none, beside faces that have one: the importer's for faces without a material.
const GREY: [u8; 3] = [204; 3];

/// Triangles and what the files that they come from say about them.
#[derive(Default)]
pub(crate) struct Meshes {
    pub(crate) triangles: Triangles,
    pub(crate) colors: Colors,
    /// The files that were read.
    pub(crate) files: Vec<PathBuf>,
}

impl Meshes {
    /// The mesh that an object of a scene has in the fields `mesh`, or `vertices` and `triangles`. `problem` names the scene in an
    /// error; errors in the file of a mesh name that file.
    pub(crate) fn one(
        object: &Field<'_>,
        [mesh, vertices, triangles]: [Option<Field<'_>>; 3],
        folder: &Path,
        problem: &impl Fn(String) -> String,
    ) -> Result<Self, String> {
        match (mesh, vertices, triangles) {
            (Some(mesh), None, None) => {
                let name = mesh.text().map_err(problem)?;
                if name.is_empty() {
                    return Err(problem(mesh.error("is empty and should name a file")));
                }
                Self::of_file(folder.join(name))
            }
            (None, vertices, triangles) => {
                let triangles = lists(object, vertices, triangles).map_err(problem)?;
                Ok(Self { triangles, ..Self::default() })
            }
            _ => Err(problem(object.error("mesh: is given together with vertices or triangles"))),
        }
    }

    /// The meshes of a list of objects, one behind the other, each where its matrix places it.
    pub(crate) fn several(
        list: &Field<'_>,
        folder: &Path,
        problem: &impl Fn(String) -> String,
    ) -> Result<Self, String> {
        let mut all = Self::default();
        for object in list.list().map_err(problem)? {
            let known = ["mesh", "vertices", "triangles", "model", "colors", "emission"];
            let [mesh, vertices, triangles, model, colors, emission] =
                object.fields(known).map_err(problem)?;
            let mut one = Self::one(&object, [mesh, vertices, triangles], folder, problem)?;
            one.set_colors([colors, emission]).map_err(problem)?;
            let model = model.map_or(Ok(IDENTITY), |model| affine(&model)).map_err(problem)?;
            for vertex in &mut one.triangles.positions {
                let [x, y, z] = *vertex;
                *vertex =
                    [0, 1, 2].map(|i| model[i][0] * x + model[i][1] * y + model[i][2] * z + model[i][3]);
            }
            all.add(one);
        }
        match all.triangles.faces.is_empty() {
            true => Err(problem(list.error("has no meshes"))),
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

    /// Takes the colours that an object states, and light that it emits, instead of those of materials.
    pub(crate) fn set_colors(&mut self, fields: [Option<Field<'_>>; 2]) -> Result<(), String> {
        if fields.iter().any(Option::is_some) {
            let [faces, emission] = fields.map(|field| colors_of(&self.triangles.faces, field));
            self.colors = Colors { faces: faces?, emission: emission? };
        }
        Ok(())
    }

    /// Reads a mesh of any format, as it is in the file: the scene says how it lies and whether back faces are culled.
    fn of_file(file: PathBuf) -> Result<Self, String> {
        if file.extension().is_some_and(|e| e.eq_ignore_ascii_case("json")) {
            let json = parse(&file)?;
            let root = Field::root(&json);
            let triangles = root
                .fields(["vertices", "triangles"])
                .and_then(|[vertices, triangles]| lists(&root, vertices, triangles))
                .map_err(|e| format!("{}: {e}", file.display()))?;
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
            all.files.extend(model.libraries);
        }
        Ok(all)
    }
}

/// Parses a JSON file.
pub(crate) fn parse(file: &Path) -> Result<Json, String> {
    let text = std::fs::read(file).map_err(|e| format!("{}: cannot be read: {e}", file.display()))?;
    Json::parse(&text).map_err(|e| format!("{}: {e}", file.display()))
}

pub(crate) fn matrix(field: &Field<'_>) -> Result<Matrix, String> {
    field.array(|row| row.array(|f| f.number()))
}

/// A matrix that places a mesh.
fn affine(field: &Field<'_>) -> Result<Matrix, String> {
    let matrix = matrix(field)?;
    match matrix[3] == IDENTITY[3] {
        true => Ok(matrix),
        false => Err(field.error("the last row is not [0, 0, 0, 1]")),
    }
}

/// A colour for each triangle, or nothing.
fn colors_of(triangles: &[[usize; 3]], field: Option<Field<'_>>) -> Result<Vec<[u8; 3]>, String> {
    let Some(field) = field else { return Ok(Vec::new()) };
    let colors = field.list()?.map(|color| color.color()).collect::<Result<Vec<_>, _>>()?;
    if colors.len() != triangles.len() {
        let (colors, triangles) = (colors.len(), triangles.len());
        return Err(field.error(format_args!("has {colors} colours, but there are {triangles} triangles")));
    }
    Ok(colors)
}

fn lists(
    object: &Field<'_>,
    vertices: Option<Field<'_>>,
    triangles: Option<Field<'_>>,
) -> Result<Triangles, String> {
    let vertices = object.needed(vertices, "vertices")?;
    let positions = vertices.list()?.map(|vertex| vertex.vector()).collect::<Result<Vec<_>, _>>()?;
    let corner = |f: Field<'_>| match positions.len() {
        0 => Err(f.error("names a vertex, and there are none")),
        count => f.integer(0, count as i64 - 1).map(|i| i as usize), // not negative
    };
    let triangles = object.needed(triangles, "triangles")?;
    let faces = triangles.list()?.map(|t| t.array(corner)).collect::<Result<Vec<_>, _>>()?;
    if faces.is_empty() {
        return Err(triangles.error("has no faces"));
    }
    Ok(Triangles { positions, faces })
}
