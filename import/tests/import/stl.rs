//! STL files, both kinds. `cases.txt` has how people write them.

use crate::common::file;
use pinhole_import::{import_bytes, read, read_stl, read_triangles, Options, Problem};
use std::path::Path;
use support::oracle::rng::Rng;

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
        bytes.extend([0; 12].into_iter().chain(face.as_flattened().iter().flat_map(|c| c.to_le_bytes())));
        bytes.extend([0; 2]);
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

#[test]
fn both_kinds_give_the_files_triangles_in_order() {
    let files = [
        file("stl-binary", "a.stl", binary(b"made by hand")),
        file("stl-solid", "a.STL", binary(b"solid is what many binary files begin with")),
        file("stl-ascii", "a.stl", ascii()),
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

/// STL and OBJ text, with its bytes in either order.
#[test]
fn text_in_utf16_is_read() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    for (name, text) in [("model.obj", obj), ("model.stl", std::str::from_utf8(&ascii()).unwrap())] {
        let import = |bytes| import_bytes(bytes, name.as_ref(), &[], &Options::default()).unwrap();
        let units = || "\u{feff}".encode_utf16().chain(text.encode_utf16());
        let both =
            [units().flat_map(u16::to_le_bytes).collect(), units().flat_map(u16::to_be_bytes).collect()];
        assert_eq!(both.map(import), [(); 2].map(|()| import(text.into())), "{name}");
    }
}

#[test]
fn a_file_cut_short_names_the_first_byte_missing() {
    // Also one that begins as text.
    for (header, lengths) in
        [(&b""[..], &[283, 100, 84, 83, 10, 0][..]), (b"solid made by a program", &[283, 200, 84])]
    {
        let whole = binary(header);
        for &length in lengths {
            let error = read_stl(&whole[..length], Path::new("model.stl")).unwrap_err();
            let needed = if length < 84 { 84 } else { whole.len() as u64 };
            assert!(
                matches!(error.problem, Problem::Truncated { needed: n, given } if n == needed && given == length as u64),
                "{error}"
            );
            let said = match length {
                0 => " is empty:".to_string(),
                _ => format!(
                    " ends before byte {length}, but should have {needed} bytes: copy or export it again"
                ),
            };
            assert!(error.to_string().contains(&said), "{error}");
        }
    }
}

/// Random finite numbers, as binary and as text.
#[test]
fn both_kinds_have_all_bits_of_their_numbers() {
    let mut rng = Rng::new(1);
    let mut numbers = std::iter::repeat_with(|| f32::from_bits(rng.bits()));
    let mut number = || numbers.find(|number| number.is_finite()).unwrap();
    let corners: Vec<[f32; 3]> = (0..1500).map(|_| [(); 3].map(|()| number())).collect();
    let mut bytes = [&[b' '; 80][..], &500u32.to_le_bytes()].concat();
    let mut text = String::from("solid random\n");
    for (facet, corners) in corners.chunks(3).enumerate() {
        bytes.extend([0; 12].into_iter().chain(corners.as_flattened().iter().flat_map(|c| c.to_le_bytes())));
        bytes.extend([1, 2]);
        text += "facet normal 0 0 1\nouter loop\n";
        for [x, y, z] in corners {
            text += &match facet % 2 {
                0 => format!("vertex {x} {y} {z}\n"),
                _ => format!("vertex {x:e} {y:E} {z}\n"),
            };
        }
        text += "endloop\nendfacet\n";
    }
    text += "endsolid random\n";
    for bytes in [bytes, text.into_bytes()] {
        let read = read_triangles(&file("stl-random", "a.stl", &bytes)).unwrap();
        let found: Vec<[f64; 3]> = read.faces.iter().flatten().map(|&at| read.positions[at]).collect();
        assert_eq!(found, corners.iter().map(|corner| corner.map(f64::from)).collect::<Vec<_>>());
        assert_eq!(read.faces.len(), 500);
    }
}
