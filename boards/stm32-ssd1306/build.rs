//! Converts the model, and tells the linker where `memory.x` and the linker scripts are.

use pinhole_import::{build, Edges, Options};
use std::path::Path;

/// An STL file, which has z up, or an OBJ file, which has y up: if the model lies on its side, add
/// `up: Some(pinhole_import::Axis::Y)`, or another axis, to the options below.
const FILE: &str = "../common/all/model.stl";

/// What the importer makes of the file: a mesh 2 units long, which suits the camera whatever the file's unit is, and the edges at
/// which its surface turns by more than 30 degrees, with the faces beside each: without these, hidden lines are drawn more slowly.
pub fn options() -> Options {
    Options {
        fit: Some(2.0),
        edges: Edges::Feature { degrees: 30.0 },
        edge_faces: true,
        ..Options::default()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Writes model.rs with the constant MODEL, which src/main.rs includes.
    build(Path::new(FILE), "MODEL", &options());

    println!("cargo::rustc-link-search={}", std::env::var("CARGO_MANIFEST_DIR")?);
    println!("cargo::rerun-if-changed=memory.x");
    // The linker scripts of cortex-m-rt and of defmt. A script must be given once: the configuration of a
    // folder around this one may pass link.x already.
    if !std::env::var("CARGO_ENCODED_RUSTFLAGS").is_ok_and(|flags| flags.contains("-Tlink.x")) {
        println!("cargo::rustc-link-arg=-Tlink.x");
    }
    println!("cargo::rustc-link-arg=-Tdefmt.x");
    // No gaps between the sections in flash.
    println!("cargo::rustc-link-arg=--nmagic");
    Ok(())
}
