//! The ready meshes: closed, turned outwards and of the shape that their documentation says.

use pinhole::meshes::{ARROW, AXES, CUBE, CYLINDER, GRID, SPHERE, TORUS};
use pinhole::Mesh;
use std::collections::{BTreeMap, BTreeSet};
use support::oracle::chain::{cross, dot, length, normalise};

const CLOSED: [(&str, Mesh<'static>, i64); 5] = [
    ("cube", CUBE, 2),
    ("sphere", SPHERE, 2),
    ("torus", TORUS, 0),
    ("cylinder", CYLINDER, 2),
    ("arrow", ARROW, 2),
];
const OPEN: [(&str, Mesh<'static>); 1] = [("grid", GRID)];

fn vertex(mesh: &Mesh<'_>, index: u16) -> [f64; 3] {
    mesh.vertices()[usize::from(index)].map(|c| f64::from(c) * f64::from(mesh.exponent()).exp2())
}

fn corners(mesh: &Mesh<'_>, face: [u16; 3]) -> [[f64; 3]; 3] {
    face.map(|index| vertex(mesh, index))
}

/// Twice the area of a face, along its normal.
fn face_normal(mesh: &Mesh<'_>, face: [u16; 3]) -> [f64; 3] {
    let [a, b, c] = corners(mesh, face);
    let side = |to: [f64; 3]| [0, 1, 2].map(|i| to[i] - a[i]);
    cross(side(b), side(c))
}

fn volume(mesh: &Mesh<'_>) -> f64 {
    mesh.faces().iter().map(|&face| dot(corners(mesh, face)[0], face_normal(mesh, face)) / 6.0).sum()
}

#[test]
fn closed_meshes_are_closed_and_of_their_genus() {
    for (name, mesh, euler) in CLOSED {
        let sides = mesh.faces().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let mut count = BTreeMap::new();
        sides.for_each(|side| *count.entry(side).or_insert(0) += 1);
        for (&[a, b], &times) in &count {
            assert_eq!((times, count.get(&[b, a])), (1, Some(&1)), "{name}: side {a}–{b}");
        }
        let edges = count.len() as i64 / 2;
        assert_eq!(mesh.vertices().len() as i64 - edges + mesh.faces().len() as i64, euler, "{name}");
        let used: BTreeSet<u16> = mesh.faces().iter().flatten().copied().collect();
        assert_eq!(used.len(), mesh.vertices().len(), "{name}: a vertex without a face");
        let distinct: BTreeSet<[i16; 3]> = mesh.vertices().iter().copied().collect();
        assert_eq!(distinct.len(), mesh.vertices().len(), "{name}: two vertices in one place");
    }
}

/// By the formulas of the solids: prisms and frustums with regular polygons as their sections.
#[test]
fn volumes_are_those_of_the_shapes() {
    use std::f64::consts::PI;
    let polygon = |sides: f64, radius: f64| sides / 2.0 * (2.0 * PI / sides).sin() * radius * radius;
    assert_eq!(volume(&CUBE), 8.0);
    let near = |mesh: &Mesh<'_>, exact: f64| {
        let found = volume(mesh);
        assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
    };
    near(&CYLINDER, 2.0 * polygon(16.0, 1.0));
    near(&ARROW, 0.7 * polygon(10.0, 0.05) + 0.3 / 3.0 * polygon(10.0, 0.125));
    // Pyramids at the poles, and frustums between rings.
    let ring = |k: i32| (f64::from(k) * PI / 8.0).sin_cos();
    let sphere: f64 = (0..8)
        .map(|k| {
            let ((r, y), (s, z)) = (ring(k), ring(k + 1));
            (y - z) / 3.0 * polygon(16.0, 1.0) * (r * r + r * s + s * s)
        })
        .sum();
    near(&SPHERE, sphere);
    // Pappus, for the decagon turned in 20 steps: the mean radius of its area is 0.7, by symmetry.
    let chord = 20.0 * (PI / 20.0).sin() * 2.0 * (PI / 20.0).cos() / (2.0 * PI);
    near(&TORUS, polygon(10.0, 0.3) * 2.0 * PI * 0.7 * chord);
}

/// Each face's normal is that of its vertices, points away from the mesh's middle or tube, and its plane is that of the library.
#[test]
fn normals_are_those_of_the_faces() {
    for (name, mesh) in CLOSED.map(|(name, mesh, _)| (name, mesh)).into_iter().chain(OPEN) {
        for (&face, normal) in mesh.faces().iter().zip(mesh.normals()) {
            let exact = normalise(face_normal(&mesh, face));
            for (found, exact) in normal.iter().zip(exact) {
                assert!((f64::from(*found) / 32_768.0 - exact).abs() < 1.1 / 32_768.0, "{name} {face:?}");
            }
        }
        let planes = if matches!(name, "sphere" | "torus") { mesh.faces().len() } else { 0 };
        assert_eq!(mesh.planes().len(), planes);
        for (face, &plane) in mesh.planes().iter().enumerate() {
            assert_eq!(plane, mesh.face_plane(face), "{name} {face}");
        }
        for (index, normal) in mesh.vertex_normals().iter().enumerate() {
            let found = normal.map(|c| f64::from(c) / 32_768.0);
            let [x, y, z] = vertex(&mesh, index as u16);
            let exact = match name {
                "sphere" => [x, y, z],
                "grid" => [0.0, 1.0, 0.0],
                _ => {
                    // From the nearest point of the circle in the tube.
                    let from_axis = 0.7 / x.hypot(z);
                    [x - x * from_axis, y, z - z * from_axis]
                }
            };
            let off = [0, 1, 2].map(|i| found[i] - normalise(exact)[i]);
            assert!(length(off) < 4e-4, "{name} {index}: {off:?}");
        }
    }
    assert!(GRID.normals().iter().all(|&normal| normal == [0, 32_767, 0]), "the floor is seen from above");
    assert_eq!([SPHERE, TORUS].map(|mesh| mesh.vertex_normals().len()), [114, 200]);
    assert_eq!(GRID.vertex_normals().len(), 81);
}

#[test]
fn edges_are_sides_of_their_two_faces() {
    for (name, mesh) in CLOSED.map(|(name, mesh, _)| (name, mesh)).into_iter().chain(OPEN) {
        let distinct: BTreeSet<[u16; 2]> = mesh.edges().iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        assert_eq!(distinct.len(), mesh.edges().len(), "{name}: an edge twice");
        assert_eq!(mesh.edge_faces().len(), mesh.edges().len());
        let mut borders = 0;
        for (edge, beside) in mesh.edges().iter().zip(mesh.edge_faces()) {
            for &face in beside {
                match mesh.faces().get(usize::from(face)) {
                    Some(corners) => assert!(edge.iter().all(|end| corners.contains(end)), "{name} {edge:?}"),
                    None => borders += 1,
                }
            }
            assert_ne!(beside[0], beside[1]);
        }
        assert_eq!(borders, if name == "grid" { 32 } else { 0 }, "{name}");
    }
}

#[test]
fn sizes_are_documented() {
    let text = include_str!("../../src/meshes.rs");
    for (name, mesh, low, high) in [
        ("CUBE", CUBE, [-1.0; 3], [1.0; 3]),
        ("SPHERE", SPHERE, [-1.0; 3], [1.0; 3]),
        ("TORUS", TORUS, [-1.0, -0.3, -1.0], [1.0, 0.3, 1.0]),
        ("CYLINDER", CYLINDER, [-1.0; 3], [1.0; 3]),
        ("ARROW", ARROW, [-0.125, 0.0, -0.125], [0.125, 1.0, 0.125]),
        ("GRID", GRID, [-1.0, 0.0, -1.0], [1.0, 0.0, 1.0]),
        ("AXES", AXES, [0.0; 3], [1.0; 3]),
    ] {
        let all: Vec<_> = (0..mesh.vertices().len() as u16).map(|index| vertex(&mesh, index)).collect();
        for axis in 0..3 {
            let [least, most] =
                [f64::min, f64::max].map(|of| all.iter().map(|v| v[axis]).reduce(of).expect("vertices"));
            // Polygons of 10 and 20 sides do not touch each axis.
            let is_near = (least - low[axis]).abs() < 0.016 && (most - high[axis]).abs() < 0.016;
            assert!(is_near, "{name} {axis}: {least} {most}");
        }
        let (v, f, e) = (mesh.vertices().len(), mesh.faces().len(), mesh.edges().len());
        let bytes = 6 * (v + f)
            + 6 * mesh.normals().len()
            + 2 * mesh.planes().len()
            + 8 * e
            + 6 * mesh.vertex_normals().len();
        let size =
            if bytes < 100 { format!("{bytes} B") } else { format!("{:.1} KB", bytes as f64 / 1024.0) };
        let row = format!("| [`{name}`] | {v}, {f}, {e} | {size} |");
        assert!(text.contains(&row), "src/meshes.rs needs the row {row}");
    }
}
