//! What the tests share.

use pinhole_import::{import_bytes, ImportError, ImportedMesh, Options};
use std::path::{Path, PathBuf};

/// Imports the text of an OBJ file.
pub(crate) fn obj(text: &str, options: &Options) -> Result<ImportedMesh, ImportError> {
    import_bytes(text.into(), "model.obj".as_ref(), &[], options)
}

/// Imports the text of an OBJ file with other files beside it.
pub(crate) fn obj_beside(text: &str, beside: &[(&str, &str)], options: &Options) -> ImportedMesh {
    let beside: Vec<_> =
        beside.iter().map(|(name, text)| (name.to_string(), text.as_bytes().into())).collect();
    import_bytes(text.into(), "model.obj".as_ref(), &beside, options).unwrap()
}

/// The warnings in words.
pub(crate) fn said(mesh: &ImportedMesh) -> Vec<String> {
    mesh.warnings.iter().map(ToString::to_string).collect()
}

/// An empty folder that no other test has.
pub(crate) fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("import").join(test);
    let _ = std::fs::remove_dir_all(&folder); // of an earlier run
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// A file in a folder of the test's own.
pub(crate) fn file(test: &str, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder(test).join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

/// A vertex in the file's units.
pub(crate) fn position(mesh: &ImportedMesh, vertex: u16) -> [f64; 3] {
    let step = 2f64.powi(mesh.exponent.into());
    let at = mesh.vertices[usize::from(vertex)];
    [0, 1, 2].map(|axis| f64::from(at[axis]) * step + mesh.offset[axis])
}
