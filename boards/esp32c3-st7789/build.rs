//! Converts the model, and tells the linker which scripts there are.

use pinhole_import::{build, Edges, Options};
use std::path::Path;

/// An STL file, which has z up, or an OBJ file, which has y up: if the model lies on its side, add
/// `up: Some(pinhole_import::Axis::Y)`, or another axis, to the options below.
const FILE: &str = "../common/all/model.stl";

/// What the importer makes of the file: a mesh 2 units long, which suits the camera whatever the file's unit is, with the
/// normals of its faces for the light, and without edges, which this picture does not draw.
pub fn options() -> Options {
    Options { fit: Some(2.0), edges: Edges::None, ..Options::default() }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Writes model.rs with the constant MODEL, which src/main.rs includes.
    build(Path::new(FILE), "MODEL", &options());

    // The linker scripts of esp-hal and of defmt.
    println!("cargo::rustc-link-arg=-Tlinkall.x");
    println!("cargo::rustc-link-arg=-Tdefmt.x");
    // What riscv-stack paints: all above the word that esp-hal guards.
    println!("cargo::rustc-link-arg=--defsym=_hart_stack_size=_stack_start-__stack_chk_guard-4");
    Ok(())
}
