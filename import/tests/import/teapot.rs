//! The teapot of the repository, and the Rust source made of it.

use pinhole_import::{read, ImportedMesh, Topology};
use std::path::Path;

fn teapot() -> ImportedMesh {
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/teapot.obj")).unwrap()
}

#[test]
fn is_as_documented() {
    let teapot = teapot();
    let report = teapot.report;
    assert_eq!((report.vertices_read, report.faces_read), (792, 992));
    assert_eq!((report.welded, report.welded_by_quantising), (263, 0));
    assert_eq!((report.degenerate, report.duplicate, report.unused), (0, 0, 0));
    let counts = (teapot.vertices.len(), teapot.edges.len(), teapot.faces.len());
    assert_eq!(counts, (529, 1520, 992));
    // Six rims of the model itself: pot, lid, spout (both ends), handle (both ends). No seam is left.
    let rims = Topology { open: 64, ..Topology::default() };
    assert_eq!(teapot.topology(), rims);
    assert!((teapot.volume() - 3172.5).abs() < 0.5, "counter-clockwise seen from outside");
    assert!(report.error <= report.extent / 65000.0);
}

#[test]
fn generated_source_is_current() {
    let command = "pinhole-import teapot.obj -o teapot.rs --arrays --keep-order";
    let source = include_str!("../../../assets/teapot.rs");
    assert!(
        teapot().to_rust(command) == source,
        "assets/teapot.rs is not what this makes: cargo run -p pinhole-import -- assets/teapot.obj -o assets/teapot.rs --arrays --keep-order"
    );
}
