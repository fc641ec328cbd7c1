//! A model for programs that show it before it is in a firmware.

use crate::normals::on_one_line;
use crate::{
    fits, quantise, read_model, Axis, ImportError, ImportedMesh, Options, Problem, Triangles, Warning,
};
use std::path::{Path, PathBuf};

/// A model as [`import`](crate::import) makes it, but with the triangles of the file: for programs that show what a firmware
/// will draw, and show a model that no firmware can hold, too.
#[derive(Debug)]
pub struct Preview {
    /// All triangles in the file's order, in its axes and units, wound as the mesh's are; after them the backs that
    /// [`Options::two_sided`] adds. With back faces culled they look as the mesh does.
    pub triangles: Triangles,
    /// The colour of each triangle, as the mesh's palette has it; or nothing, where the file has no materials.
    pub colors: Vec<[u8; 3]>,
    /// The light that each triangle emits; or nothing, where none emits any.
    pub emission: Vec<[u8; 3]>,
    /// The texture coordinates of the corners of each triangle, u to the right and v down, in sides of a texture; or nothing, where
    /// the file has none. The mesh has the picture.
    pub texture: Vec<[[f64; 2]; 3]>,
    /// The pictures that the materials name (`map_Kd`), in the order of their first use, whether or not the mesh has one.
    pub pictures: Vec<String>,
    /// Files that were read beside the model: material libraries.
    pub libraries: Vec<PathBuf>,
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
/// # let file = std::env::temp_dir().join(format!("pinhole-preview-doc-{}.obj", std::process::id()));
/// std::fs::write(&file, "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n")?;
/// let sheet = preview(&file, &Options { two_sided: true, ..Options::default() })?;
/// assert_eq!((sheet.triangles.faces.len(), sheet.backs, sheet.up), (4, 2, Axis::Y));
/// # std::fs::remove_file(&file)?;
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
    let mut triangles = model.triangles.clone();
    let pictures = model.pictures.names.clone();
    let mut texture: Vec<[[f64; 2]; 3]> = match &model.texture {
        Some(texture) => texture.faces.iter().map(|face| face.map(|i| texture.coords[i])).collect(),
        None => Vec::new(),
    };
    let mut colors: [Vec<[u8; 3]>; 2] = match &model.colors {
        Some(colors) => [&colors.palette, &colors.emission].map(|of| match of.is_empty() {
            true => Vec::new(),
            false => colors.faces.iter().map(|&color| of[usize::from(color)]).collect(),
        }),
        None => Default::default(),
    };
    let made = quantise::make(model, up, &options, &mut |_| ()).map_err(|problem| problem.at(file, None))?;
    for (face, is_reversed) in triangles.faces.iter_mut().zip(made.reversed.iter().copied()) {
        if is_reversed {
            *face = reversed(*face);
        }
    }
    for (coords, &is_reversed) in texture.iter_mut().zip(&made.reversed) {
        if is_reversed {
            *coords = reversed(*coords);
        }
    }
    if !texture.is_empty() {
        texture.extend(made.backs.iter().map(|&face| reversed(texture[face])).collect::<Vec<_>>());
    }
    let backs: Vec<_> = made.backs.iter().map(|&face| reversed(triangles.faces[face])).collect();
    for colors in colors.iter_mut().filter(|colors| !colors.is_empty()) {
        colors.extend(made.backs.iter().map(|&face| colors[face]).collect::<Vec<_>>());
    }
    let [colors, emission] = colors;
    let count = backs.len();
    triangles.faces.extend(backs);
    let libraries = made.libraries;
    let mesh = made.mesh.and_then(fits);
    let mut warnings = made.warnings;
    if let Err(problem) = &mesh {
        warnings.push(problem.as_warning());
    }
    Ok(Preview {
        triangles,
        colors,
        emission,
        texture,
        pictures,
        libraries,
        backs: count,
        up,
        mesh,
        warnings,
    })
}

fn reversed<T>([a, b, c]: [T; 3]) -> [T; 3] {
    [a, c, b]
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
