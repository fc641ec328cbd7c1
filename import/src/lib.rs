//! Turns models into meshes for `pinhole`, on the host: from a program, from `build.rs`, or by the command
//! `pinhole-import MODEL -o OUT.rs`.
//!
//! ```
//! let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
//! let model = pinhole_import::read_obj(text, "tetrahedron.obj".as_ref())?;
//! assert_eq!((model.vertices.len(), model.edges.len(), model.faces.len()), (4, 6, 4));
//! let mesh = model.mesh().expect("what is imported is a mesh");
//! # Ok::<(), pinhole_import::ImportError>(())
//! ```
//!
//! A reader gives [`Triangles`]; all further steps are equal for all formats, and most of them are chosen by [`Options`]:
//!
//! 1. equal positions are welded, degenerate and duplicate faces dropped, vertices that no face uses left out; where a
//!    degenerate face joined its neighbours, these are cut at its corners, so that a closed surface stays closed;
//! 2. the model is turned, scaled and decimated, on request;
//! 3. the centre of the bounding box is subtracted ([`ImportedMesh::offset`]; give it back in the model transform);
//! 4. coordinates are rounded to the finest power-of-two grid on which they fit ±32767, so each lies within 1/65000 of
//!    the largest extent ([`quantise`] has the derivation);
//! 5. positions that became equal are welded as in step 1;
//! 6. faces and vertices are put in an order in which neighbours follow each other, on request;
//! 7. faces are wound outwards and get backs, on request;
//! 8. edges, the faces beside them, normals, and the planes of faces are derived.
//!
//! The diffuse colours and texture coordinates of OBJ files stand beside the mesh: [`ImportedMesh::colors`],
//! [`ImportedMesh::texture`]; and, if [`Options::texture`] asks for it, the picture that its materials name:
//! [`ImportedMesh::picture`].
//!
//! Invalid input is an [`ImportError`]; doubtful input is imported, and listed in [`ImportedMesh::warnings`].

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod arguments;
mod attributes;
mod beside;
mod bodies;
mod boxes;
mod clusters;
mod decimate;
mod derive;
mod edges;
mod error;
mod exact;
mod grid;
#[doc(hidden)]
pub mod host;
mod materials;
mod mesh;
mod model;
mod mtl;
mod normals;
mod obj;
mod options;
mod order;
mod parts;
mod picture;
mod pipeline;
#[cfg(feature = "textures")]
mod pixels;
mod polygon;
mod preview;
mod remedy;
mod rounded;
mod rust;
mod script;
mod slivers;
mod stl;
mod surface;
mod text;
mod warning;
mod weld;
mod winding;

pub use beside::Unread;
pub use error::{ImportError, Problem};
pub use mesh::{ImportedMesh, Report, Topology};
pub use options::{Axis, Centre, Edges, Options, TextureFormat};
pub use picture::IndexedPicture;
pub use pipeline::quantise;
pub use preview::{preview, Preview};
pub use remedy::Remedy;
pub use rust::is_constant_name;
pub use script::build;
#[doc(hidden)]
pub use text::number;
pub use warning::{Element, Place, Warning};

/// The code of the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

use beside::Beside;
use model::Model;
use std::io::Read;
use std::path::Path;

/// A model as a reader delivers it: positions in model units and triangles of indices into them, counter-clockwise seen
/// from outside. The indices must be in range.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Triangles {
    /// The vertices.
    pub positions: Vec<[f64; 3]>,
    /// The triangles.
    pub faces: Vec<[usize; 3]>,
}

/// What [`import_with`] is about to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Step {
    /// Read and understand the file.
    Read,
    /// Weld equal positions.
    Weld,
    /// Take triangles away.
    Decimate,
    /// Round to the grid, and weld again.
    Quantise,
    /// Order faces and vertices.
    Order,
    /// Derive edges, normals and planes.
    Derive,
}

/// The most bytes a file may have.
const LARGEST_FILE: u64 = 1 << 30;

/// Reads a model and makes a mesh of it, by the default [`Options`]; the extension of the file says its format (`.obj`,
/// `.stl`).
///
/// # Errors
///
/// [`ImportError`] names the file, the line if there is one, and what is wrong.
pub fn read(file: &Path) -> Result<ImportedMesh, ImportError> {
    let options = &Options::default();
    finish(read_model(file, options)?, file, options, &mut |_| ())
}

/// Reads a model and makes a mesh of it that [`pinhole::Mesh`] takes, as the options say.
///
/// ```
/// use pinhole_import::{import, Edges, Options, Place, Warning};
/// let file = std::env::temp_dir().join(format!("pinhole-import-doc-{}.obj", std::process::id()));
/// std::fs::write(&file, "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n")?;
/// let options = Options { fit: Some(1.0), edges: Edges::Feature { degrees: 30.0 }, ..Options::default() };
/// let sheet = import(&file, &options)?;
/// assert_eq!(sheet.report.extent, 1.0);
/// assert_eq!(sheet.edges.len(), 4, "the diagonal is no feature");
/// assert!(matches!(sheet.warnings[0], Warning::OpenEdges { count: 4, first: Place::Line(5) }));
/// std::fs::remove_file(&file)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// As [`read`]; and [`Problem::Exponent`] where the model's unit is too large or too small for a mesh,
/// [`Problem::Options`], [`Problem::TooManyFaces`], [`Problem::NoClusters`], [`Problem::NoDecimation`].
pub fn import(file: &Path, options: &Options) -> Result<ImportedMesh, ImportError> {
    import_with(file, options, |_| ())
}

/// [`import`] that reports each step as it begins, for a progress bar.
///
/// # Errors
///
/// As [`import`].
pub fn import_with(
    file: &Path,
    options: &Options,
    mut begins: impl FnMut(Step),
) -> Result<ImportedMesh, ImportError> {
    begins(Step::Read);
    let mesh = finish(read_model(file, options)?, file, options, &mut begins)?;
    fits(mesh).map_err(|problem| problem.at(file, None))
}

/// [`import`] from the bytes of a file, for programs without files, such as in a browser. The extension of `file` says the
/// format, and messages name `file`. Its material libraries and pictures are
/// looked for in `beside`, names and bytes of files, and then in its folder.
///
/// ```
/// use pinhole_import::{import_bytes, Axis, Options};
/// let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n".to_vec();
/// let options = Options { up: Some(Axis::Z), fit: Some(2.0), ..Options::default() };
/// let model = import_bytes(text, "tetrahedron.obj".as_ref(), &[], &options)?;
/// assert_eq!((model.faces.len(), model.report.extent), (4, 2.0));
/// # Ok::<(), pinhole_import::ImportError>(())
/// ```
///
/// # Errors
///
/// As [`import`].
pub fn import_bytes(
    bytes: Vec<u8>,
    file: &Path,
    beside: &[(String, Vec<u8>)],
    options: &Options,
) -> Result<ImportedMesh, ImportError> {
    let beside = Beside { model: file, given: beside, options };
    let mesh = finish(model_of(bytes, beside)?, file, options, &mut |_| ())?;
    fits(mesh).map_err(|problem| problem.at(file, None))
}

/// The width and the height of the picture in a PNG or BMP file, and red, green, blue and opacity of each pixel, row by row. For the
/// programs of pinhole's repository.
///
/// # Errors
///
/// The reason that follows the name of the file in a message.
#[cfg(feature = "textures")]
#[doc(hidden)]
#[allow(clippy::type_complexity)] // two parts of one picture
pub fn read_picture(file: &[u8]) -> Result<([usize; 2], Vec<[u8; 4]>), String> {
    pixels::read(file).map(|picture| ([picture.width, picture.height], picture.colors))
}

/// Reads a model as it is: all triangles in the file's order, nothing welded, dropped or rounded.
///
/// # Errors
///
/// As [`read`].
pub fn read_triangles(file: &Path) -> Result<Triangles, ImportError> {
    Ok(read_model(file, &Options::default())?.triangles)
}

/// Reads the text of an OBJ file; `file` is only named in errors.
///
/// Vertices with their colours, faces, lines and texture coordinates are read, and diffuse colours from the material libraries that
/// the text names, in the folder of `file`. Polygons become triangles, concave ones too; groups and objects become one mesh; the
/// file's own normals are passed over.
///
/// # Errors
///
/// As [`read`].
pub fn read_obj(text: &[u8], file: &Path) -> Result<ImportedMesh, ImportError> {
    let options = &Options::default();
    finish(obj::read(text, &Beside { model: file, given: &[], options })?, file, options, &mut |_| ())
}

/// Reads the bytes of an STL file, binary or ASCII; `file` is only named in errors. Colours in the last two bytes of facets are
/// read by the conventions of VisCAM and SolidView and, with `COLOR=` in the header, of Materialise Magics.
///
/// # Errors
///
/// As [`read`].
pub fn read_stl(bytes: &[u8], file: &Path) -> Result<ImportedMesh, ImportError> {
    let options = Options::default();
    finish(stl::read(bytes.to_vec(), file, &options)?, file, &options, &mut |_| ())
}

/// The mesh, if its unit is one that a [`pinhole::Mesh`] may have.
fn fits(mesh: ImportedMesh) -> Result<ImportedMesh, Problem> {
    // The only thing left to go wrong.
    match mesh.exponent {
        -32..=15 => Ok(mesh),
        exponent => Err(Problem::Exponent(exponent)),
    }
}

fn read_model(file: &Path, options: &Options) -> Result<Model, ImportError> {
    Format::of(file)?; // before a large file is read
    model_of(bytes(file)?, Beside { model: file, given: &[], options })
}

fn model_of(bytes: Vec<u8>, beside: Beside<'_>) -> Result<Model, ImportError> {
    match Format::of(beside.model)? {
        Format::Obj => obj::read(&bytes, &beside),
        Format::Stl => stl::read(bytes, beside.model, beside.options),
    }
}

/// A format that is read.
enum Format {
    Obj,
    Stl,
}

impl Format {
    /// The format that the extension of a file says.
    fn of(file: &Path) -> Result<Self, ImportError> {
        match file.extension().unwrap_or_default().to_ascii_lowercase().to_str() {
            Some("obj") => Ok(Self::Obj),
            Some("stl") => Ok(Self::Stl),
            _ => Err(Problem::UnknownFormat.at(file, None)),
        }
    }
}

/// All of a file, if it is not too large.
fn bytes(file: &Path) -> Result<Vec<u8>, ImportError> {
    let problem = |e| Problem::Read(e).at(file, None);
    let opened = std::fs::File::open(file).map_err(problem)?;
    let mut bytes = Vec::new();
    if opened.metadata().map_err(problem)?.len() <= LARGEST_FILE {
        opened.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(problem)?;
        if bytes.len() as u64 <= LARGEST_FILE {
            return Ok(bytes);
        }
    }
    Err(Problem::TooLarge.at(file, None))
}

fn finish(
    model: Model,
    file: &Path,
    options: &Options,
    begins: &mut dyn FnMut(Step),
) -> Result<ImportedMesh, ImportError> {
    let up = options.up.unwrap_or(Axis::of_file(file));
    let made = pipeline::make(model, up, options, begins).map_err(|problem| problem.at(file, None))?;
    let mesh = made.mesh.map_err(|problem| problem.at(file, None))?;
    Ok(ImportedMesh { warnings: made.warnings, ..mesh })
}
