//! Fewer triangles: with the feature, and without it.

use pinhole_import::{import, Options};
use std::path::{Path, PathBuf};

/// A square of 40 × 40 squares in a plane, with 3200 triangles.
fn plane(name: &str) -> PathBuf {
    let mut text = String::new();
    for y in 0..=40 {
        for x in 0..=40 {
            text += &format!("v {x} {y} 3\n");
        }
    }
    for y in 0..40 {
        for x in 0..40 {
            let a = 41 * y + x + 1;
            text += &format!("f {} {} {} {}\n", a, a + 1, a + 42, a + 41);
        }
    }
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).unwrap();
    path
}

#[cfg(feature = "decimate")]
#[test]
fn a_plane_loses_triangles_and_nothing_else() {
    let options = Options { decimate: Some(200), ..Options::default() };
    let mesh = import(&plane("plane.obj"), &options).unwrap();
    assert!(mesh.faces.len() <= 200 && mesh.faces.len() + mesh.report.decimated == 3200, "{:?}", mesh.report);
    assert_eq!(mesh.report.unused, 0);
    // It is still that square: its area, by the vertices, and its height.
    let step = 2f64.powi(i32::from(mesh.exponent));
    let area: f64 = mesh
        .faces
        .iter()
        .map(|face| {
            let [a, b, c] = face.map(|v| mesh.vertices[usize::from(v)].map(|c| f64::from(c) * step));
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
        })
        .sum();
    // Positions are whole numbers, and the grid holds those about the centre exactly.
    assert_eq!((area, mesh.report.error), (1600.0, 0.0));
    assert!(mesh.vertices.iter().all(|v| v[2] == 0));
    // An estimate, which counts moves within the plane a little: a hundredth of a square.
    assert!(mesh.report.decimation_error < 0.01, "{}", mesh.report.decimation_error);
}

#[cfg(feature = "decimate")]
#[test]
fn what_is_not_reduced_as_far_as_wanted_is_said_and_only_that() {
    // Sixteen triangles, each on its own: here all but four go. No shape is known that keeps more than was wanted.
    let mut text = String::new();
    for i in 0..16 {
        text += &format!("v {} 0 0\nv {} 0 0\nv {} 1 0\nf -3 -2 -1\n", 2 * i, 2 * i + 1, 2 * i);
    }
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("islands.obj");
    std::fs::write(&path, text).unwrap();
    let mesh = import(&path, &Options { decimate: Some(4), ..Options::default() }).unwrap();
    let said = mesh.warnings.iter().any(|w| w.to_string().contains("the shape allows no fewer"));
    assert_eq!(said, mesh.faces.len() > 4, "{} {:?}", mesh.faces.len(), mesh.warnings);
}

#[cfg(feature = "decimate")]
#[test]
fn none_left_is_said_of_the_number_and_not_of_the_model() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tetrahedron.obj");
    std::fs::write(&path, text).unwrap();
    let error = import(&path, &Options { decimate: Some(1), ..Options::default() }).unwrap_err();
    assert!(
        error.to_string().ends_with(": decimation to so few triangles leaves none: allow more"),
        "{error}"
    );
}

#[cfg(not(feature = "decimate"))]
#[test]
fn a_build_without_it_says_how_to_get_it() {
    let error =
        import(&plane("plain.obj"), &Options { decimate: Some(200), ..Options::default() }).unwrap_err();
    assert!(
        error.to_string().contains("install it with the feature `decimate`, which needs a C++ compiler"),
        "{error}"
    );
}
