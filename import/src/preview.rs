//! A model for programs that show it before it is in a firmware.

use crate::normals::on_one_line;
use crate::{
    fits, pipeline, read_model, Axis, ImportError, ImportedMesh, Options, Problem, Triangles, Warning,
};
use std::path::{Path, PathBuf};

/// A model as [`import`](crate::import) makes it, in the axes and units of its file: for programs that show what a firmware will
/// draw, and show a model that no firmware can hold, too.
#[derive(Debug)]
pub struct Preview {
    /// The triangles that the mesh has, on its grid, in the file's axes and units; the last of them are the backs that
    /// [`Options::two_sided`] adds.
    pub triangles: Triangles,
    /// The colour of each triangle, as the mesh's palette has it; or nothing, where the file has no materials.
    pub colors: Vec<[u8; 3]>,
    /// The light that each triangle emits; or nothing, where none emits any.
    pub emission: Vec<[u8; 3]>,
    /// The texture coordinates of the corners of each triangle, u to the right and v down, in sides of a texture; or nothing, where
    /// the file has none. The mesh has the picture, if any: where it has one, the coordinates are NaN for triangles whose material names none.
    pub texture: Vec<[[f64; 2]; 3]>,
    /// Files beside the model: material libraries and, with the feature `textures`, the pictures that its materials name.
    pub files: Vec<PathBuf>,
    /// How many of the triangles are backs.
    pub backs: usize,
    /// The axis of the file that points upwards.
    pub up: Axis,
    /// The mesh, or why no mesh can hold the model.
    pub mesh: Result<ImportedMesh, Problem>,
    /// What [`import`](crate::import) warns about, and why no mesh can hold the model.
    pub warnings: Vec<Warning>,
}

/// Reads a model and changes it as the options say, for programs that show it. Orders and decimates nothing.
///
/// ```
/// use pinhole_import::{preview, Axis, Options};
/// let file = std::env::temp_dir().join(format!("pinhole-preview-doc-{}.obj", std::process::id()));
/// std::fs::write(&file, "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n")?;
/// let sheet = preview(&file, &Options { two_sided: true, ..Options::default() })?;
/// assert_eq!((sheet.triangles.faces.len(), sheet.backs, sheet.up), (4, 2, Axis::Y));
/// std::fs::remove_file(&file)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// As [`import`](crate::import), but for problems that concern a mesh alone ([`Problem::TooManyVertices`],
/// [`Problem::TooManyFaces`], [`Problem::Exponent`]): these are in [`Preview::mesh`].
pub fn preview(file: &Path, options: &Options) -> Result<Preview, ImportError> {
    let options = Options { reorder: false, decimate: None, ..options.clone() };
    let up = options.up.unwrap_or(Axis::of_file(file));
    let model = read_model(file, &options)?;
    let mut made =
        pipeline::make(model, up, &options, &mut |_| ()).map_err(|problem| problem.at(file, None))?;
    made.mesh = made.mesh.and_then(fits);
    made.warnings.extend(made.mesh.as_ref().err().map(Problem::as_warning));
    Ok(made)
}

impl Triangles {
    /// The positions of the vertices of all triangles that have an area: those that a mesh keeps, and that a camera frames.
    /// Each once, in the order of the list.
    pub fn seen(&self) -> Vec<[f64; 3]> {
        let mut is_seen = vec![false; self.positions.len()];
        for face in &self.faces {
            if !on_one_line(face.map(|vertex| self.positions[vertex])) {
                face.iter().for_each(|&vertex| is_seen[vertex] = true);
            }
        }
        self.positions.iter().zip(is_seen).filter(|(_, is_seen)| *is_seen).map(|(p, _)| *p).collect()
    }
}
