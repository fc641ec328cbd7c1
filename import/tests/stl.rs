//! STL files, both kinds.

use pinhole_import::{read, read_triangles, Problem};
use std::path::PathBuf;

/// Of a tetrahedron, counter-clockwise from outside.
const FACES: [[[f32; 3]; 3]; 4] = [
    [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.]],
    [[0., 0., 0.], [1., 0., 0.], [0., 0., 1.]],
    [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
    [[0., 1., 0.], [0., 0., 0.], [0., 0., 1.]],
];

fn binary(header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((FACES.len() as u32).to_le_bytes());
    for face in FACES {
        let numbers = [[0.0; 3], face[0], face[1], face[2]];
        bytes.extend(numbers.iter().flatten().flat_map(|c: &f32| c.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

fn ascii() -> Vec<u8> {
    let mut text = String::from("solid tetrahedron\n");
    for face in FACES {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in face {
            text.push_str(&format!("vertex {x} {y} {z}\n"));
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str("endsolid tetrahedron\n");
    text.into()
}

fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

#[test]
fn both_kinds_give_the_files_triangles_in_order() {
    let files = [
        file("binary.stl", &binary(b"made by hand")),
        file("solid.STL", &binary(b"solid is what many binary files begin with")),
        file("ascii.stl", &ascii()),
    ];
    for path in files {
        let triangles = read_triangles(&path).unwrap();
        let corners: Vec<_> = triangles.faces.iter().map(|f| f.map(|i| triangles.positions[i])).collect();
        assert_eq!(corners, FACES.map(|f| f.map(|p| p.map(f64::from))), "{}", path.display());
        assert_eq!(triangles.positions.len(), 4);
        let mesh = read(&path).unwrap();
        assert_eq!((mesh.vertices.len(), mesh.faces.len(), mesh.edges.len()), (4, 4, 6));
        assert!((mesh.volume() - 1.0 / 6.0).abs() < 1e-4);
    }
}

#[test]
fn a_file_cut_short_names_the_first_byte_missing() {
    let whole = binary(b"");
    for length in [whole.len() - 1, 100, 84, 83, 10, 0] {
        let error = read(&file("short.stl", &whole[..length])).unwrap_err();
        let needed = if length < 84 { 84 } else { whole.len() as u64 };
        assert!(
            matches!(error.problem, Problem::Truncated { needed: n, given } if n == needed && given == length as u64),
            "{error}"
        );
        assert!(error.to_string().contains(&format!("before byte {length}:")), "{error}");
    }
}
