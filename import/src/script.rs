//! For build scripts.

use crate::host::shown;
use crate::{host, import, rust, ImportError, Options, Problem};
use std::path::{Path, PathBuf};

/// Imports a model in a `build.rs`: writes `$OUT_DIR/NAME.rs`, with the name in lower case, which has the constant `NAME`,
/// a `pinhole::Mesh<'static>`; asks cargo to run the script again when the model changes; and passes on what is doubtful as
/// cargo's warnings, which name the fields of [`Options`] that help.
///
/// If the model cannot be imported, or `name` is not the name of a constant ([`is_constant_name`](crate::is_constant_name)), cargo
/// shows one error message and fails the build after the script has ended.
///
/// ```no_run
/// // build.rs
/// use std::path::Path;
/// use pinhole_import::{build, Options};
/// fn main() {
///     build(Path::new("bracket.stl"), "BRACKET", &Options::default());
/// }
/// // and in main.rs: include!(concat!(env!("OUT_DIR"), "/bracket.rs"));
/// ```
pub fn build(model: &Path, name: &str, options: &Options) {
    if let Err(error) = write(model, name, options) {
        println!("cargo::error={}: {}", error.location(), error.problem.said().in_script());
    }
}

fn write(model: &Path, name: &str, options: &Options) -> Result<(), ImportError> {
    println!("cargo::rerun-if-changed={}", model.display());
    let mesh = import(model, options)?;
    for file in &mesh.files {
        println!("cargo::rerun-if-changed={}", file.display());
    }
    let source = mesh
        .to_rust_mesh(name, model, "pinhole_import::build")
        .ok_or_else(|| Problem::Options(rust::NOT_A_NAME).at(model, None))?;
    for warning in &mesh.warnings {
        println!("cargo::warning={}: {}", shown(&model.to_string_lossy()), warning.said().in_script());
    }
    let folder = std::env::var_os("OUT_DIR").map(PathBuf::from).ok_or_else(|| {
        let missing = std::io::Error::new(std::io::ErrorKind::NotFound, "no OUT_DIR: this is for build.rs");
        Problem::Write(missing).at(model, None)
    })?;
    let file = folder.join(format!("{}.rs", name.to_lowercase()));
    host::write(&file, source.as_bytes()).map_err(|e| Problem::Write(e).at(&file, None))
}
