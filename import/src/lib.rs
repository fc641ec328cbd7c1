//! Turns models into meshes for `pinhole`, on the host: from a program, from `build.rs`, or by the command
//! `pinhole-import MODEL -o OUT.rs`.
//!
//! ```
//! let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
//! let model = pinhole_import::read_obj(text, "tetrahedron.obj".as_ref())?;
//! assert_eq!((model.vertices.len(), model.edges.len(), model.faces.len()), (4, 6, 4));
//! let mesh = model.mesh().expect("what is imported is a mesh");
//! # let _ = mesh;
//! # Ok::<(), pinhole_import::ImportError>(())
//! ```
//!
//! A reader gives [`Triangles`]; everything after that is the same for all formats:
//!
//! 1. equal positions are welded, degenerate and duplicate faces dropped, vertices that no face uses left out;
//! 2. the centre of the bounding box is subtracted ([`ImportedMesh::offset`]; give it back in the model transform);
//! 3. coordinates are rounded to the finest power-of-two grid on which they fit ±32767, so each lies within 1/65000 of
//!    the largest extent ([`quantise`] has the derivation);
//! 4. positions that fell together are welded as in 1;
//! 5. edges and face normals are derived from what is left.

mod error;
mod mesh;
mod obj;
mod rust;
mod stl;
mod weld;

pub use error::{ImportError, Problem};
pub use mesh::{quantise, ImportedMesh, Report, Topology};

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

/// Reads a model and makes a mesh of it; the extension of the file says its format (`.obj`, `.stl`).
///
/// # Errors
///
/// [`ImportError`] names the file, the line if there is one, and what is wrong.
pub fn read(file: &Path) -> Result<ImportedMesh, ImportError> {
    quantise(&read_triangles(file)?).map_err(|problem| problem.at(file, None))
}

/// Reads a model as it is: all triangles in the file's order, nothing welded, dropped or rounded.
///
/// # Errors
///
/// As [`read`].
pub fn read_triangles(file: &Path) -> Result<Triangles, ImportError> {
    let reader = match file.extension().and_then(|e| e.to_str()) {
        Some(e) if e.eq_ignore_ascii_case("obj") => obj::read,
        Some(e) if e.eq_ignore_ascii_case("stl") => stl::read,
        _ => return Err(Problem::UnknownFormat.at(file, None)),
    };
    let bytes = std::fs::read(file).map_err(|e| Problem::Read(e).at(file, None))?;
    reader(&bytes, file)
}

/// Reads the text of an OBJ file; `file` is only named in errors.
///
/// Vertices and faces are read; polygons become fans; groups and objects become one mesh; materials, texture
/// coordinates and the file's own normals are passed over.
///
/// # Errors
///
/// As [`read`].
pub fn read_obj(text: &[u8], file: &Path) -> Result<ImportedMesh, ImportError> {
    quantise(&obj::read(text, file)?).map_err(|problem| problem.at(file, None))
}
