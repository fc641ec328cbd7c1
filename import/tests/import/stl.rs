//! STL files, both kinds.

use crate::common::file;
use pinhole_import::{
    import_bytes, read, read_stl, read_triangles, ImportError, ImportedMesh, Options, Problem, Warning,
};
use std::path::Path;

/// Of a tetrahedron, counter-clockwise from outside.
const FACES: [[[f32; 3]; 3]; 4] = [
    [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.]],
    [[0., 0., 0.], [1., 0., 0.], [0., 0., 1.]],
    [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
    [[0., 1., 0.], [0., 0., 0.], [0., 0., 1.]],
];

/// A binary file, with the last two bytes of each facet.
fn painted(header: &[u8], attributes: [u16; 4]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((FACES.len() as u32).to_le_bytes());
    for (face, attribute) in FACES.into_iter().zip(attributes) {
        let numbers = [[0.0; 3], face[0], face[1], face[2]];
        bytes.extend(numbers.iter().flatten().flat_map(|c: &f32| c.to_le_bytes()));
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
}

fn binary(header: &[u8]) -> Vec<u8> {
    painted(header, [0; 4])
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

#[test]
fn text_in_utf16_is_read() {
    let good = read_stl(&ascii(), Path::new("model.stl")).unwrap();
    let ascii = ascii();
    let units = || "\u{feff}".encode_utf16().chain(ascii.iter().map(|&byte| u16::from(byte)));
    let little: Vec<u8> = units().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = units().flat_map(u16::to_be_bytes).collect();
    for bytes in [little, big] {
        assert_eq!(read_stl(&bytes, Path::new("model.stl")).unwrap(), good);
    }
    // A binary file may begin with these two bytes.
    assert_eq!(read_stl(&binary(b"\xff\xfe"), Path::new("model.stl")).unwrap().faces, good.faces);
}

#[test]
fn a_file_cut_short_names_the_first_byte_missing() {
    // Also one that begins as text.
    for (header, lengths) in
        [(&b""[..], &[283, 100, 84, 83, 10, 0][..]), (b"solid made by a program", &[283, 200, 84])]
    {
        let whole = binary(header);
        for &length in lengths {
            let error = import(&whole[..length]).unwrap_err();
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

fn import(bytes: impl AsRef<[u8]>) -> Result<ImportedMesh, ImportError> {
    read_stl(bytes.as_ref(), Path::new("model.stl"))
}

/// A facet whose first corner lies at this z.
fn facet(z: u32) -> String {
    format!(
        "facet normal 0 0 1\nouter loop\nvertex 0 0 {z}\nvertex 1 0 {z}\nvertex 0 1 {z}\nendloop\nendfacet\n"
    )
}

#[test]
fn text_is_read_as_people_write_it() {
    let tetrahedron = String::from_utf8(ascii()).unwrap();
    let good = import(tetrahedron.as_str()).unwrap();
    assert!(good.warnings.is_empty(), "closed, and outside out: {:?}", good.warnings);
    let same = [
        ("upper case", tetrahedron.to_uppercase()),
        ("no name", tetrahedron.replace(" tetrahedron", "")),
        ("a name like a facet", tetrahedron.replace("tetrahedron", "facet normal")),
        ("carriage returns and indents", tetrahedron.replace('\n', "\r\n\t  ")),
        ("a mark of UTF-8", format!("\u{feff}{tetrahedron}")),
        ("a line before", format!("\n  {tetrahedron}")),
        ("normals that are none", tetrahedron.replace("0 0 0\nouter", "nan -nan(ind) 1,5\nouter")),
        ("no normals", tetrahedron.replace(" normal 0 0 0", "")),
        ("carriage returns alone", tetrahedron.replace('\n', "\r")),
        ("one line", tetrahedron.replace('\n', " ")),
        ("one line, and no name", tetrahedron.replace(" tetrahedron", "").replace('\n', "  ")),
        ("no `solid`", tetrahedron.replace("solid tetrahedron\nfacet", "facet")),
        ("facets in a line", tetrahedron.replace("\nouter", " outer").replace("\nvertex", "  vertex")),
        ("a comment first", format!("# by hand\r\n\n  # twice\n{tetrahedron}")),
        (
            "comments",
            tetrahedron.replace("facet\n", "facet # 1\n# facet\n").replace("vertex 1 ", "# x\nvertex 1 "),
        ),
        ("text after endfacet", tetrahedron.replace("endfacet", "endfacet colour 31")),
        (
            "text after the others",
            tetrahedron.replace("loop", "loop 5").replace("vertex 0 0 0", "vertex 0 0 0 1 red"),
        ),
        ("end solid", tetrahedron.replace("endsolid", "end solid")),
        (
            "end loop, and end facet",
            tetrahedron.replace("endloop", "END LOOP").replace("endfacet", "end\tfacet"),
        ),
        (
            "colours",
            tetrahedron
                .replace("facet normal", "color 1 0 0\nfacet normal")
                .replace("outer", "  COLOUR 1 0 0\nouter"),
        ),
        ("a zero at the end", format!("{tetrahedron}\0")),
        ("Ctrl-Z and zeros at the end", format!("{tetrahedron}\x1a\0\0")),
        ("a name like half a facet", tetrahedron.replace("tetrahedron", "outer facet")),
        ("a name like a loop", tetrahedron.replace("tetrahedron", "outer loop vertex endsolid")),
        ("a name with signs", tetrahedron.replace("tetrahedron", "box #1 color")),
        ("exponents", tetrahedron.replace("vertex 1 ", "vertex +10.0E-1 ")),
    ];
    for (what, text) in same {
        let mut mesh = import(text).unwrap_or_else(|error| panic!("{what}: {error}"));
        // Colours are left out, and said to be: `colors.rs`.
        mesh.warnings.retain(|warning| !matches!(warning, Warning::LeftOut { .. }));
        assert_eq!(mesh, good, "{what}");
    }
    // An end that does not say so is taken, and doubted.
    let mesh = import(tetrahedron.replace("endsolid tetrahedron\n", "")).unwrap();
    let last = 1 + 4 * 7;
    let doubt = format!("no `endsolid` after line {last}: perhaps the file was cut short");
    assert_eq!(mesh.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(), [doubt]);
    assert_eq!((mesh.warnings[0].line(), &mesh.faces), (Some(last), &good.faces));
    // Several solids are one model.
    let (first, second) = (facet(0), facet(1));
    let two = import(format!("solid a\n{first}endsolid a\nsolid b\n{second}endsolid b\n")).unwrap();
    assert_eq!((two.faces.len(), two.vertices.len()), (2, 6));
    // Named and not first in their lines.
    let run_on = import(
        format!("solid a\n{first} endsolid a b\nsolid b\n{second}").replace("endfacet\n ", "endfacet "),
    )
    .unwrap();
    assert_eq!((run_on.faces.len(), run_on.vertices.len()), (2, 6));
    let one_line = format!("solid a\n{first}endsolid a\nsolid b c\n{second}endsolid b").replace('\n', " ");
    let one_line = import(one_line).unwrap();
    assert!(
        one_line.warnings.iter().all(|w| w.to_string().starts_with("open edges: ")),
        "{:?}",
        one_line.warnings
    );
    assert_eq!(one_line, ImportedMesh { warnings: one_line.warnings.clone(), ..two.clone() });
    let unended = import(format!("solid a\n{first}solid b\n{second}")).unwrap();
    assert_eq!(unended, ImportedMesh { warnings: unended.warnings.clone(), ..two });
}

#[test]
fn binary_numbers_that_are_none_are_named_by_their_byte() {
    for (byte, number) in [(100, f32::NAN), (84 + 50 + 44, f32::NEG_INFINITY)] {
        let mut bytes = binary(b"");
        bytes[byte..byte + 4].copy_from_slice(&number.to_le_bytes());
        let error = import(bytes).unwrap_err();
        let message = format!("model.stl: the coordinate at byte {byte} is not a finite number: repair or export the model again");
        assert_eq!(error.to_string(), message);
    }
    // Nobody needs the normal.
    let mut bytes = binary(b"");
    bytes[84..88].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(import(bytes).unwrap(), import(binary(b"")).unwrap());
}

#[test]
fn an_empty_binary_file_has_no_faces_and_a_long_one_is_doubted() {
    let mut empty = vec![b' '; 80];
    empty.extend([0; 4]);
    assert_eq!(import(empty).unwrap_err().to_string(), "model.stl: has no faces: export the model as a mesh");
    let mut long = binary(b"");
    long.extend([7; 5]);
    let mesh = import(long).unwrap();
    assert_eq!(mesh.faces.len(), 4);
    let warnings: Vec<_> = mesh.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings, ["5 bytes after the last triangle are passed over"]);
}

const OPEN_6: &str =
    "open edges: 6, the first at line 2; faces show nothing from behind: close the surface, or use --two-sided";

#[test]
fn doubtful_triangles_are_named_by_line_or_number() {
    let sliver = facet(0).replace("vertex 0 1 0", "vertex 2 0 0");
    let text = format!("solid a\n{}{sliver}{}{}endsolid\n", facet(0), facet(0), facet(1));
    let mesh = import(text).unwrap();
    let expected = [
        (Some(9), "faces without area: 1, the first at line 9; dropped, which changes no picture"),
        (Some(16), "duplicate faces: 1, the first at line 16; dropped, which changes no picture"),
        (Some(2), OPEN_6),
    ];
    let warnings: Vec<_> = mesh.warnings.iter().map(|w| (w.line(), w.to_string())).collect();
    assert_eq!(warnings, expected.map(|(line, message)| (line, message.to_string())));

    let mut bytes = binary(b"");
    bytes.drain(84..134); // the first face
    bytes[80] = 3;
    let mesh = import(bytes).unwrap();
    let open = "open edges: 3, the first at triangle 1; faces show nothing from behind: close the surface, or use --two-sided";
    assert_eq!(mesh.warnings.len(), 1);
    assert_eq!((mesh.warnings[0].line(), mesh.warnings[0].to_string().as_str()), (None, open));
}

/// Random finite numbers (Knuth, "The Art of Computer Programming" 2, section 3.3.4, table 1, line 16), as binary and as text.
#[test]
fn both_kinds_have_all_bits_of_their_numbers() {
    let mut bits = 1u32;
    let mut numbers = std::iter::repeat_with(move || {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f32::from_bits(bits)
    });
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

/// The colour of each face, in the file's order.
fn colors(mesh: &ImportedMesh) -> Vec<[u8; 3]> {
    mesh.face_colors.iter().map(|&color| mesh.palette[usize::from(color)]).collect()
}

#[test]
fn facets_of_stl_files_have_colours_by_both_conventions() {
    let import = |bytes: Vec<u8>, options: &Options| {
        let mesh = import_bytes(bytes, "model.stl".as_ref(), &[], options).unwrap();
        assert_eq!(mesh.warnings, []);
        colors(&mesh)
    };
    let all = Options::default();
    // VisCAM and SolidView: red in the upper bits, and the top bit set where there is a colour.
    let (red, green, blue) = (31 << 10, 31 << 5, 31);
    let top = 1 << 15;
    let viscam = painted(b"a scan", [top | red, top | green | 16, red, top]);
    assert_eq!(import(viscam.clone(), &all), [[255, 0, 0], [0, 255, 132], [204; 3], [0, 0, 0]]);
    assert_eq!(import(viscam, &Options { materials_only: true, ..Options::default() }), [[0; 3]; 0]);
    // No colour, whatever these bits mean.
    assert_eq!(import(painted(b"a scan", [red, 1, 2, 3]), &all), [[0; 3]; 0]);
    // Magics: red in the lower bits, and the top bit set where the colour is that of the whole.
    let header = b"made by hand COLOR=\x0a\x14\x1e\xff,MATERIAL=";
    let magics = painted(header, [red, green | 16, top | red, blue]);
    assert_eq!(import(magics, &all), [[0, 0, 255], [132, 255, 0], [10, 20, 30], [255, 0, 0]]);
    assert_eq!(import(painted(header, [0; 4]), &all), [[10, 20, 30]; 4]);
}
