//! A model as large as they come, in a process of its own, whose memory is measured.

use pinhole_apps_support::bodies::{stl, torus};
use pinhole_import::{import, Edges, Options, Remedy};
use std::path::Path;

#[test]
fn a_hundred_thousand_triangles_take_little_memory() {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("torus.stl");
    // 100 000 triangles: 125 rings of 400 quads.
    std::fs::write(&file, stl(&torus(50.0, 20.0, 125, 400))).unwrap();
    let options = Options { reorder: true, edges: Edges::All, vertex_normals: true, ..Options::default() };
    let mesh = import(&file, &options).unwrap();
    // A torus: V − E + F = 0.
    assert_eq!((mesh.vertices.len(), mesh.edges.len(), mesh.faces.len()), (50_000, 150_000, 100_000));
    // 6 bytes a vertex and its normal, a face and its normal, and 4 an edge.
    let bytes = 12 * 50_000 + 12 * 100_000 + 4 * 150_000;
    let decimate = Remedy::Decimate(0).to_string();
    let wanted = format!(
        "size in flash: {bytes} bytes, 600000 of them for edges; if that is too much, use pinhole-import --edges none, or {}",
        decimate.strip_prefix("use pinhole-import ").unwrap()
    );
    let bands = format!(
        "100000 faces, more than the 65535 that can be drawn in bands: {decimate}, or split the model"
    );
    assert_eq!(mesh.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(), [wanted, bands]);
    let source = mesh.to_rust_mesh("TORUS", &file, "a test").unwrap();
    let elements = source.lines().filter(|line| line.starts_with("        ["));
    let elements: usize = elements.map(|line| line.matches("],").count()).sum();
    assert_eq!(elements, 50_000 + 150_000 + 100_000 + 100_000 + 50_000);
    if let Some(peak) = peak_memory() {
        println!("peak memory: {} MB", peak >> 20);
        assert!(peak < 300 << 20, "{peak} bytes");
    }
}

/// The most bytes that this process has had in memory, where the system says so.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}
