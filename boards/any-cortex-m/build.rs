//! Converts the model, and tells the linker where `memory.x` and the linker scripts are.

use pinhole_import::{build, Axis, Edges, Options};
use std::path::Path;

/// The model, and which way is up in it: STL files from CAD programs mostly have z up, OBJ files y.
const MODEL: (&str, Axis) = ("model.stl", Axis::Z);

/// What the firmware asks of the importer: a mesh 2 units long, which suits the camera whatever the file's unit is, with
/// the normals of its faces for the light, and without edges, which this picture does not draw.
fn options(up: Axis) -> Options {
    Options { up, fit: Some(2.0), edges: Edges::None, ..Options::default() }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Writes model.rs with the constant MODEL, which src/main.rs includes.
    build(Path::new(MODEL.0), "MODEL", &options(MODEL.1))?;

    println!("cargo::rustc-link-search={}", std::env::var("CARGO_MANIFEST_DIR")?);
    println!("cargo::rerun-if-changed=memory.x");
    // The linker scripts of cortex-m-rt or riscv-rt, and of defmt. A script must be given once: the configuration of a
    // folder around this one may pass link.x already.
    if !std::env::var("CARGO_ENCODED_RUSTFLAGS").is_ok_and(|flags| flags.contains("-Tlink.x")) {
        println!("cargo::rustc-link-arg-bins=-Tlink.x");
    }
    println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
    Ok(())
}
