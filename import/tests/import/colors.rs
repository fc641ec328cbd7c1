//! Colours of vertices (OBJ) and of facets (STL), and what materials have that a mesh has not.

use crate::common::{obj_beside as import, said};
use pinhole_import::{import_bytes, Element, ImportedMesh, Options, Place, Warning};

const FACES: &str = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const GREY: [u8; 3] = [204; 3];

/// A tetrahedron with its vertices' colours.
fn tetrahedron(colors: [&str; 4]) -> String {
    let [a, b, c, d] = colors;
    format!("v 0 0 0 {a}\nv 1 0 0 {b}\nv 0 1 0 {c}\nv 0 0 1 {d}\n{FACES}")
}

/// The colour of each face, in the file's order.
fn colors(mesh: &ImportedMesh) -> Vec<[u8; 3]> {
    mesh.face_colors.iter().map(|&color| mesh.palette[usize::from(color)]).collect()
}

#[test]
fn a_face_has_the_mean_of_its_corners() {
    // A third of 255 is 85.
    let expected = [[85, 85, 0], [85, 0, 85], [85, 85, 85], [0, 85, 85]];
    let ones = tetrahedron(["0 0 0", "1 0 0", "0 1 0", "0 0 1"]);
    let bytes = tetrahedron(["0 0 0", "255 0 0", "0 255 0", "0 0 255"]);
    for text in [&ones, &bytes] {
        let mesh = import(text, &[], &Options::default());
        assert_eq!((colors(&mesh), &mesh.warnings[..]), (expected.to_vec(), &[][..]));
        let refused = import(text, &[], &Options { materials_only: true, ..Options::default() });
        assert_eq!((&refused.palette[..], &refused.warnings[..]), (&[][..], &[][..]));
        assert_eq!(refused.faces, mesh.faces);
    }
    // Of the corners that have a colour, wherever those are; and what no number is counts as none.
    let some = import(&tetrahedron(["", "1 0 0", "", "x 0 0"]), &[], &Options::default());
    assert_eq!(colors(&some), [[255, 0, 0], [255, 0, 0], [255, 0, 0], GREY]);
}

#[test]
fn more_colours_than_a_palette_holds_are_a_warning() {
    let mut text = String::new();
    for i in 0..300 {
        text += &format!(
            "v {i} 0 0 {0} 0 0\nv {i} 1 0 {0} 0 1\nv {i} 0 1 {0} 1 0\nf -3 -2 -1\n",
            f64::from(i) / 300.0
        );
    }
    let mesh = import(&text, &[], &Options { two_sided: true, ..Options::default() });
    let levels = (0..300).map(|i| (f64::from(i) / 300.0 * 255.0).round() as u8);
    let count = levels.collect::<std::collections::HashSet<_>>().len();
    assert!(count == 255 || count == 256, "{count}");
    assert_eq!((mesh.palette.len(), mesh.face_colors.len()), (count, 600));
}

#[test]
fn a_materials_colour_comes_first() {
    let text = tetrahedron(["0 0 0", "1 0 0", "0 1 0", "0 0 1"]);
    let library = "newmtl paint\nKd 0 0 1\nnewmtl bare\nNs 3\n";
    let (start, faces) = text.split_at(text.find('f').unwrap());
    let text = format!("mtllib m.mtl\n{start}usemtl paint\n{}usemtl bare\n{}", &faces[..8], &faces[8..]);
    let mesh = import(&text, &[("m.mtl", library)], &Options::default());
    assert_eq!(colors(&mesh), [[0, 0, 255], [85, 0, 85], [85, 85, 85], [0, 85, 85]]);
    let covered = Warning::LeftOut { what: Element::CoveredColors, count: 1, first: Place::Unknown };
    assert_eq!(mesh.warnings, [covered]);
    // A library that is not there leaves the colours of vertices.
    let mesh = import(&text, &[], &Options::default());
    assert_eq!(colors(&mesh), [[85, 85, 0], [85, 0, 85], [85, 85, 85], [0, 85, 85]]);
}

#[test]
fn transparency_and_pictures_are_said() {
    let library = "newmtl a\nKd 1 0 0\nd 0.5\nnewmtl b\nTr 0.2\nnewmtl c\nTr 1\nd 1.0\nnewmtl d\nd -halo 0.1\nmap_Kd skin.png\nnewmtl unused\nd 0\n";
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    let [a, b, c, d] = ["f 1 3 2\n", "f 1 2 4\n", "f 2 3 4\n", "f 3 1 4\n"];
    let text = format!("mtllib m.mtl\n{vertices}usemtl a\n{a}usemtl b\n{b}usemtl c\n{c}usemtl d\n{d}");
    let mesh = import(&text, &[("m.mtl", library)], &Options::default());
    assert_eq!(
        said(&mesh),
        [
            "transparent materials: 3, the first a; their faces are opaque",
            "pictures of materials: 1, the first skin.png; left out, as there are no texture coordinates",
        ]
    );
    let with_coords = text.replace("f 3 1 4", "vt 0 0\nf 3/1 1/1 4/1");
    let mesh = import(&with_coords, &[("m.mtl", library)], &Options::default());
    let said = mesh.warnings.last().unwrap().to_string();
    assert_eq!(said, "pictures of materials: 1, the first skin.png; left out: use --texture 16");
}

/// A binary STL of the tetrahedron, with the last two bytes of its facets.
fn stl(header: &[u8], attributes: [u16; 4]) -> Vec<u8> {
    let corners = [[0.0f32, 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend(4u32.to_le_bytes());
    for (face, attribute) in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].into_iter().zip(attributes) {
        let numbers = [0.0f32; 3].into_iter().chain(face.into_iter().flat_map(|i: usize| corners[i]));
        bytes.extend(numbers.flat_map(f32::to_le_bytes));
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
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
    let viscam = stl(b"a scan", [top | red, top | green | 16, red, top]);
    assert_eq!(import(viscam.clone(), &all), [[255, 0, 0], [0, 255, 132], GREY, [0, 0, 0]]);
    assert_eq!(import(viscam, &Options { materials_only: true, ..Options::default() }), [[0; 3]; 0]);
    // No colour, whatever these bits mean.
    assert_eq!(import(stl(b"a scan", [red, 1, 2, 3]), &all), [[0; 3]; 0]);
    // Magics: red in the lower bits, and the top bit set where the colour is that of the whole.
    let header = b"made by hand COLOR=\x0a\x14\x1e\xff,MATERIAL=";
    let magics = stl(header, [red, green | 16, top | red, blue]);
    assert_eq!(import(magics, &all), [[0, 0, 255], [132, 255, 0], [10, 20, 30], [255, 0, 0]]);
    assert_eq!(import(stl(header, [0; 4]), &all), [[10, 20, 30]; 4]);
}

#[test]
fn colours_of_ascii_stl_are_said() {
    let facet = "facet normal 0 0 0\ncolor 1 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let text = format!("solid a\n{facet}{}endsolid a\n", facet.replace("0 1 0", "0 0 1"));
    let mesh = import_bytes(text.into(), "model.stl".as_ref(), &[], &Options::default()).unwrap();
    assert_eq!(mesh.warnings[0].to_string(), "`color` lines: 2, the first at line 3; left out");
}
