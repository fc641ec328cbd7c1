//! OBJ files as they come, sound and broken.

use crate::common::Random;
use pinhole_import::{quantise, read, read_obj, ImportError, ImportedMesh, Problem, Remedy, Triangles};
use std::collections::HashSet;
use std::path::Path;

fn import(text: &str) -> Result<ImportedMesh, ImportError> {
    read_obj(text.as_bytes(), Path::new("model.obj"))
}

/// A cube of side 2 of quads, counter-clockwise seen from outside, with eight vertices.
const CUBE: &str = "
v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8
";

/// `CUBE`, with four separate vertices for each quad.
fn cube_of_loose_quads() -> String {
    let vertices: Vec<&str> = CUBE.lines().filter(|l| l.starts_with('v')).collect();
    let mut text = String::new();
    for face in CUBE.lines().filter_map(|l| l.strip_prefix("f ")) {
        for index in face.split(' ') {
            text += vertices[index.parse::<usize>().unwrap() - 1];
            text += "\n";
        }
        text += "f -4 -3 -2 -1\n";
    }
    text
}

fn assert_is_the_cube(cube: &ImportedMesh) {
    let counts = (cube.vertices.len(), cube.edges.len(), cube.faces.len());
    assert_eq!(counts, (8, 18, 12), "Euler: 8 - 18 + 12 = 2");
    assert_eq!(cube.topology(), Default::default());
    // A half extent of 1 is 2^14 steps of 2^-14, the most that fits.
    assert_eq!(cube.exponent, -14);
    assert!(cube.vertices.iter().flatten().all(|c| c.abs() == 16384));
    assert_eq!(cube.volume(), 8.0);
    assert_eq!(cube.offset, [0.0; 3]);
    assert_eq!(cube.report.error, 0.0);
    for axis in 0..3 {
        for sign in [-1, 1] {
            let mut normal = [0; 3];
            normal[axis] = sign * 32767;
            assert_eq!(cube.normals.iter().filter(|n| **n == normal).count(), 2);
        }
    }
    for (face, normal) in cube.faces.iter().zip(&cube.normals) {
        let axis = normal.iter().position(|&c| c != 0).unwrap();
        for &corner in face {
            let side = cube.vertices[usize::from(corner)][axis].signum();
            assert_eq!(side, normal[axis].signum(), "normals point outwards");
        }
    }
}

#[test]
fn text_in_utf16_is_read() {
    let units = || "\u{feff}".encode_utf16().chain(CUBE.encode_utf16());
    let little: Vec<u8> = units().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = units().flat_map(u16::to_be_bytes).collect();
    for bytes in [little, big] {
        assert_is_the_cube(&read_obj(&bytes, Path::new("model.obj")).unwrap());
    }
}

#[test]
fn a_cube_is_welded_and_its_edges_are_unique() {
    let cube = import(CUBE).unwrap();
    assert_is_the_cube(&cube);
    assert_eq!(cube.report.welded, 0);
    let loose = import(&cube_of_loose_quads()).unwrap();
    assert_is_the_cube(&loose);
    assert_eq!((loose.report.vertices_read, loose.report.welded), (24, 16));

    assert!(cube.edges.iter().all(|[a, b]| a < b));
    assert!(cube.edges.is_sorted());
    assert_eq!(cube.edges.iter().collect::<HashSet<_>>().len(), 18);
    let mesh = cube.mesh().unwrap();
    assert_eq!(mesh.faces(), cube.faces);
}

#[test]
fn both_zeros_are_one_position() {
    let mesh = import("v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 -0.0 0\nv 0 0 1\nf 1 2 3\nf 4 5 2\n").unwrap();
    assert_eq!((mesh.vertices.len(), mesh.report.welded), (4, 1));
}

#[test]
fn positions_that_quantising_joins_are_one_vertex() {
    // Two corners at a distance of a hundredth of a step.
    let text = "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0.0003 0 0\nv 0 0 1000\nf 1 2 3\nf 4 5 2\n";
    let mesh = import(text).unwrap();
    assert_eq!((mesh.vertices.len(), mesh.edges.len()), (4, 5));
    assert_eq!((mesh.report.welded, mesh.report.welded_by_quantising), (0, 1));
}

#[test]
fn degenerate_and_duplicate_faces_go_and_are_counted() {
    let text = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 2 0 0\nv 0 0 0\nv 9 9 9\nv 4 4 0\n\
        f 1 2 3\n\
        f 2 3 1\n\
        f 5 2 3\n\
        f 1 3 2\n\
        f 1 2 2\n\
        f 1 5 3\n\
        f 1 4 2\n\
        f 1 2\n\
        f 2 7 3\n";
    let mesh = import(text).unwrap();
    // The face with its corners turned (2 3 1), and with the second vertex at the origin (5 2 3), is a duplicate; seen from
    // the other side (1 3 2) it is not.
    assert_eq!(mesh.report.duplicate, 2);
    // 1 2 2 repeats an index, 1 5 3 a position, 1 4 2 is a line, 1 2 has two corners.
    assert_eq!(mesh.report.degenerate, 4);
    assert_eq!(mesh.faces.len(), 3);
    // Vertex 5 is welded, 4 only in a face that is gone, 6 in none, so it is not even read.
    assert_eq!(mesh.vertices.len(), 4);
    assert_eq!((mesh.report.vertices_read, mesh.report.welded, mesh.report.unused), (6, 1, 1));
    assert_eq!(mesh.report.extent, 4.0);
}

#[test]
fn open_crowded_and_twisted_edges_are_counted() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\n";
    let topology = |faces: &str| import(&format!("{vertices}{faces}")).unwrap().topology();
    let sheet = topology("f 1 2 3\nf 2 1 4\n");
    assert_eq!((sheet.open, sheet.crowded, sheet.twisted), (4, 0, 0));
    let twisted = topology("f 1 2 3\nf 1 2 4\n");
    assert_eq!((twisted.open, twisted.crowded, twisted.twisted), (4, 0, 1));
    let fan = topology("f 1 2 3\nf 2 1 4\nf 1 2 5\n");
    assert_eq!((fan.open, fan.crowded, fan.twisted), (6, 1, 0));
}

/// The largest distance along an axis from a position to its vertex, by search.
fn measured_error(model: &Triangles, mesh: &ImportedMesh) -> f64 {
    let step = 2f64.powi(i32::from(mesh.exponent));
    let distance = |p: &[f64; 3], v: &[i16; 3]| {
        (0..3).map(|i| (p[i] - (f64::from(v[i]) * step + mesh.offset[i])).abs()).fold(0.0, f64::max)
    };
    let nearest = |p| mesh.vertices.iter().map(|v| distance(p, v)).fold(f64::INFINITY, f64::min);
    model.positions.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn quantisation_is_within_a_65000th_of_the_largest_extent() {
    let mut random = Random(2);
    let mut worst = 0.0_f64;
    for round in 0..2000 {
        // Extents around the places where the exponent changes (where the error is largest), and anywhere; centres near
        // and far; tiny models, whose centre is not rounded.
        let half = match round % 4 {
            0 => 32767.5 * (1.0 - 1e-9),
            1 => 32767.5 * (1.0 + 1e-9),
            2 => 32767.5 * (1.0 + 1e-3 * (random.unit() - 0.5)),
            _ => 16384.0 * (1.0 + random.unit()),
        } * 2f64.powi((random.unit() * 40.0) as i32 - 35);
        let centre = [0; 3].map(|_| (random.unit() - 0.5) * half * 8.0);
        let mut model = Triangles::default();
        for corner in 0..60 {
            let mut p = [0; 3].map(|_| (random.unit() * 2.0 - 1.0) * half);
            if corner < 2 {
                p[round % 3] = if corner == 0 { half } else { -half };
            }
            model.positions.push([0, 1, 2].map(|i| centre[i] + p[i]));
        }
        model.faces = (0..58).map(|i| [i, i + 1, i + 2]).collect();
        let mesh = quantise(&model).unwrap();
        assert_eq!(mesh.report.welded, 0);
        let error = measured_error(&model, &mesh) / mesh.report.extent;
        assert!(error <= 1.0 / 65000.0, "round {round}: 1/{}", 1.0 / error);
        let reported = mesh.report.error / mesh.report.extent;
        assert!((reported - error).abs() < 1e-9, "{reported} {error}");
        assert!(mesh.vertices.iter().flatten().all(|c| c.unsigned_abs() <= 32767));
        worst = worst.max(error);
    }
    // The bound is no idle one.
    assert!(worst > 1.0 / 66000.0, "1/{}", 1.0 / worst);
}

#[test]
fn normals_are_of_unit_length_to_their_rounding() {
    let mut random = Random(3);
    let model = Triangles {
        positions: (0..300).map(|_| [0; 3].map(|_| random.unit())).collect(),
        faces: (0..298).map(|i| [i, i + 1, i + 2]).collect(),
    };
    for n in quantise(&model).unwrap().normals {
        let length = n.map(f64::from).iter().map(|c| c * c).sum::<f64>().sqrt();
        assert!((length - 32767.0).abs() <= 0.5 * 3f64.sqrt(), "{n:?}");
    }
}

#[test]
fn what_a_mesh_does_not_use_cannot_be_wrong() {
    let text =
        "\u{feff}mtllib nowhere.mtl\no first\nv 0 0 0 1 0 0\nv 2 0 0 2\nv 0 1 0\nvt nonsense\nvn 1\nusemtl\n\
        f 1/7/9 2/-5 3//-8\ng second\nv 0 0 1\nl 1 77\np 99\ns off\nf 1 3 4 # a tail\n";
    let mesh = import(text).unwrap();
    assert_eq!((mesh.vertices.len(), mesh.faces.len()), (4, 2));
    assert_eq!(mesh.report.extent, 1.0, "2 / w = 1");
}

/// Asserts what the error of a text says.
#[track_caller]
fn refused(text: &str, message: &str) {
    assert_eq!(import(text).unwrap_err().to_string(), format!("model.obj:{message}"), "{text}");
}

#[test]
fn a_broken_line_is_named() {
    const THREE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let numbers = "a vertex needs three numbers";
    let commas = "a vertex needs three numbers such as `1.5 0 2`, without commas: replace them, or export the model again";
    let face = "a face is a list of indices v, v/vt, v//vn or v/vt/vn";
    for (text, line, message) in [
        ("v 0 0 0\n# fine\nv 1 zwei 3\n", 3, numbers),
        ("v 0 0", 1, numbers),
        ("v 0 0 0\nv 1,5 0 0\nv 0 0 1,5\nv 0 0\n", 2, commas),
        ("v 0 0 0\nv 1, 0, 0\nv 0 0\n", 2, commas),
        ("v 0,5 0 0 # 1\nv 0 0", 1, commas),
        ("# 1,5\nv 0 0\n", 2, numbers),
        ("v 0 0 0 0\n", 1, "the w of the vertex is zero"),
        ("v 0 0 0 1 1\n", 1, "a vertex is x y z, x y z w or x y z r g b"),
        ("v 0 0 0\n\nf 1 1 b\n", 3, face),
        ("v 0 0 0\nf\n", 2, "the face has no corners"),
        // A vertex may stand below its face, but a negative index counts upwards.
        (&format!("f -1 -2 -3\n{THREE}"), 1, "the face names a vertex that does not exist"),
        (&format!("{THREE}v 1e300 0 0 1e-300\nf 1 2 4\n"), 4, NOT_FINITE),
    ] {
        refused(text, &format!("{line}: {message}"));
        assert_eq!(import(text).unwrap_err().line, Some(line));
    }
    assert!(import(&format!("f 1 2 3\n{THREE}")).is_ok());
    for corner in ["4", "0", "-4", "-9223372036854775808", "9223372036854775807"] {
        let text = format!("{THREE}f 1 2 3\nf 1 2 {corner}/1/1\n");
        refused(&text, "5: the face names a vertex that does not exist");
    }
    for number in ["NaN", "inf", "-infinity", "1e999"] {
        refused(&format!("{THREE}v 0 {number} 0\nf 1 2 4\n"), &format!("4: {NOT_FINITE}"));
        // One that no face names is no part of the model.
        let text = format!("{THREE}v 0 {number} 0\nf 1 2 3\n");
        assert_eq!(import(&text).unwrap().vertices, import(&format!("{THREE}f 1 2 3\n")).unwrap().vertices);
    }
}

const NOT_FINITE: &str = "a coordinate is not a finite number: repair or export the model again";

#[test]
fn a_model_without_faces_is_an_error() {
    for text in ["", "\u{1}PNG\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "o a\nl 1 2\n"] {
        refused(text, " has no faces: export the model as a mesh");
    }
    for text in ["v 1 1 1\nf 1 1 1\n", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "v 0 0 0\nv 1 0 0\nf 1 2\n"] {
        refused(text, " has no face with an area, as all 1 are points or lines: export the model as a mesh");
    }
}

#[test]
fn a_mesh_has_at_most_65536_vertices() {
    // A strip of triangles with one vertex after the other.
    let strip = |count: usize| Triangles {
        positions: (0..count).map(|i| [(i / 2 % 256) as f64, (i % 2) as f64, (i / 512) as f64]).collect(),
        faces: (0..count - 2).map(|i| [i, i + 1, i + 2]).collect(),
    };
    let full = quantise(&strip(1 << 16)).unwrap();
    assert_eq!(full.vertices.len(), 1 << 16);
    assert!(full.mesh().is_ok());
    let problem = quantise(&strip((1 << 16) + 1)).unwrap_err();
    assert!(matches!(problem, Problem::TooManyVertices(65537)), "{problem:?}");
    assert_eq!(
        problem.to_string(),
        format!(
            "has 65537 vertices, more than the 65536 of a mesh: {}, or split the model",
            Remedy::Decimate(0)
        )
    );
}

#[test]
fn extents_beyond_an_exponent_are_an_error() {
    let triangle = |size: f64| {
        quantise(&Triangles {
            positions: vec![[0.0; 3], [size, 0.0, 0.0], [0.0, -size, 0.0]],
            faces: vec![[0, 1, 2]],
        })
    };
    assert_eq!(triangle(1e-30).unwrap().vertices.len(), 3);
    for size in [1e-40, 1e60, f64::MAX] {
        assert!(matches!(triangle(size), Err(Problem::Extent(_))), "{size}");
    }
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let missing = read(Path::new("no/such/model.obj")).unwrap_err();
    assert_eq!(format!("{missing:?}"), missing.to_string()); // what `main` of a build.rs prints
    assert!(matches!(missing.problem, Problem::Read(_)));
    let message = missing.to_string();
    assert!(message.starts_with("no/such/model.obj: cannot be read: "), "{message}");
    assert_eq!(message.lines().count(), 1);

    let unknown = read(Path::new("model.blend")).unwrap_err();
    assert_eq!(unknown.to_string(), "model.blend: is not a model this program reads: export .obj or .stl");
}

#[test]
fn indices_out_of_range_are_an_error_from_any_reader() {
    let model = Triangles { positions: vec![[0.0; 3]; 3], faces: vec![[0, 1, 3]] };
    assert!(matches!(quantise(&model), Err(Problem::NoSuchVertex)));
}

/// The warnings of an import.
fn warnings(text: &str) -> Vec<(Option<usize>, String)> {
    import(text).unwrap().warnings.into_iter().map(|w| (w.line(), w.to_string())).collect()
}

#[test]
fn carriage_returns_alone_end_lines_too() {
    let text = "v 0 0 0\nv 1 0 0\n# a remark\nv 0 1 0\nf 1 2 3\n";
    assert_eq!(import(&text.replace('\n', "\r")).unwrap(), import(text).unwrap());
    let text = text.replace("v 1 0 0", "v 1 0").replace('\n', "\r");
    refused(&text, "2: a vertex needs three numbers");
}

#[test]
fn lines_go_on_after_a_backslash() {
    let whole = import(CUBE).unwrap();
    let broken = CUBE.replace("f 4 3 2 1", "f 4 \\\n3 2\\ \n 1").replace("v -1 -1 -1", "v -1\\\n-1 -1 # \\");
    assert_eq!(import(&broken).unwrap(), whole);
    // The line of an error is the one where the statement begins.
    let text = "v 0 0 \\\n0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 \\\n3\nf 1 2 \\\n 9\n";
    refused(text, "8: the face names a vertex that does not exist");
    // A comment does not go on, nor does what a mesh does not use; nothing follows the last line.
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let text = format!("# C:\\models\\\nmtllib C:\\models\\\n{three}f 1 2 3 \\");
    assert_eq!(import(&text).unwrap(), import(&format!("\n\n{three}f 1 2 3")).unwrap());
}

/// What a mesh has no use for may stand where other readers take it, too.
#[test]
fn what_stands_behind_indices_is_passed_over() {
    let plain = import(CUBE).unwrap();
    for corner in ["1/", "1//", "1/0", "1/0/0", "1//7", "1//x", "1/2/3/4"] {
        assert_eq!(import(&CUBE.replace("f 1 ", &format!("f {corner} "))).unwrap(), plain, "{corner}");
    }
    assert_eq!(import(&CUBE.replace("\nf", " # x\n\tf ")).unwrap(), plain);
}

/// Twice the area of a mesh in the plane of x and y that is seen from +z, and from −z.
fn fronts_and_backs(mesh: &ImportedMesh) -> [f64; 2] {
    let mut areas = [0.0; 2];
    for face in &mesh.faces {
        let [a, b, c] = face.map(|vertex| {
            mesh.vertices[usize::from(vertex)].map(|c| f64::from(c) * 2f64.powi(i32::from(mesh.exponent)))
        });
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        areas[usize::from(area < 0.0)] += area.abs();
    }
    areas
}

#[test]
fn concave_polygons_cover_each_point_once() {
    // An L, from a corner that sees all of it and from one that does not.
    let l = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
    // A square of 4 with a hole of 2, to which a cut goes from corner 1 and back.
    let hole = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\n";
    for (vertices, faces, area) in [
        (l, "1 2 3 4 5 6", 3.0),
        (l, "2 3 4 5 6 1", 3.0),
        (l, "6 1 2 3 4 5 6", 3.0),
        (hole, "1 2 3 4 1 5 6 7 8 5", 12.0),
        (hole, "8 5 1 2 3 4 1 5 6 7 8", 12.0),
    ] {
        let mesh = import(&format!("{vertices}f {faces}\n")).unwrap();
        assert_eq!(fronts_and_backs(&mesh), [2.0 * area, 0.0], "{faces}");
        let open = format!("open edges: {}, ", vertices.lines().count());
        assert!(mesh.warnings.iter().any(|w| w.to_string().starts_with(&open)), "{:?}", mesh.warnings);
        assert!(mesh.warnings.iter().all(|w| !w.to_string().contains("cross")), "{:?}", mesh.warnings);
    }
    // The texture lies on the polygon as on a fan: all coordinates are the position over 2.
    let mapped = "vt 0 0\nvt 1 0\nvt 1 .5\nvt .5 .5\nvt .5 1\nvt 0 1\nf 2/2 3/3 4/4 5/5 6/6 1/1\n";
    let mesh = import(&format!("{l}{mapped}")).unwrap();
    for (face, coords) in mesh.faces.iter().zip(&mesh.texture_faces) {
        for (&vertex, &coord) in face.iter().zip(coords) {
            let [x, y, _] = mesh.vertices[usize::from(vertex)]
                .map(|c| f64::from(c) * 2f64.powi(i32::from(mesh.exponent)) / 2.0 + 0.5);
            let [u, v] = mesh.texture_coords[usize::from(coord)]
                .map(|c| f64::from(c) * 2f64.powi(i32::from(mesh.texture_exponent)));
            assert_eq!([u, 1.0 - v], [x, y]);
        }
    }
}

#[test]
fn polygons_that_cross_themselves_are_named() {
    let doubt = warnings("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\nf 1 2 3 4\n");
    let named =
        "faces that cross themselves: 1, the first at line 6; their triangles overlap: export triangles";
    assert!(doubt.contains(&(Some(6), named.into())), "{doubt:?}");
}

#[test]
fn faces_of_one_and_two_corners_have_no_area_and_are_named() {
    let doubt = warnings("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\nf 3\nf 3 2 1\n");
    assert_eq!(
        doubt,
        [(Some(5), "faces without area: 2, the first at line 5; dropped, which changes no picture".into())]
    );
}

#[test]
fn what_is_no_surface_is_named_with_its_line() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\n";
    let fan = warnings(&format!("{vertices}f 1 2 3\nf 2 1 4\nf 1 2 5\n"));
    let crowded =
        "edges of more than two faces: 1, the first at line 8; inside and outside are unclear there: \
        separate the bodies, or use --two-sided";
    assert!(fan.contains(&(Some(8), crowded.into())), "{fan:?}");
    let twisted = warnings(&format!("{vertices}f 1 2 3\n\nf 1 2 4\n"));
    let opposite =
        "edges between faces of opposite winding: 1, the first at line 8; some faces will be culled: \
        use --fix-winding";
    assert!(twisted.contains(&(Some(8), opposite.into())), "{twisted:?}");
    assert_eq!(warnings(CUBE), []);
    let inside_out = CUBE.lines().map(|line| match line.strip_prefix("f ") {
        Some(corners) => format!("f {}\n", corners.split(' ').rev().collect::<Vec<_>>().join(" ")),
        None => format!("{line}\n"),
    });
    let doubt = warnings(&inside_out.collect::<String>());
    assert!(doubt.len() == 1 && doubt[0].1.contains("inside out"), "{doubt:?}");
}

#[test]
fn binary_files_are_no_obj() {
    let error = read_obj(b"\x7fELF\x02\x01\x01\0\0>", Path::new("model.obj")).unwrap_err();
    assert_eq!(error.to_string(), "model.obj: is binary, not text, as byte 7 is zero: export .obj or .stl");
    // What old programs and copies of memory leave at the end is not the file's.
    for end in ["\0", "\x1a", "\r\n\x1a\0\0\0"] {
        assert_eq!(import(&format!("{CUBE}{end}")).unwrap(), import(CUBE).unwrap(), "{end:?}");
    }
    let nothing = read_obj(&[0; 9], Path::new("model.obj")).unwrap_err();
    assert!(matches!(nothing.problem, Problem::NotText { byte: 0 }), "{nothing}");
    // Latin-1 in a comment is none of our business.
    assert!(read_obj(b"# \xe9t\xe9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Path::new("a.obj")).is_ok());
}

#[test]
fn files_beyond_a_gibibyte_are_not_even_read() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("huge.obj");
    // Sparse: it takes no room.
    std::fs::File::create(&path).unwrap().set_len((1 << 30) + 1).unwrap();
    let error = read(&path).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    assert!(matches!(error.problem, Problem::TooLarge), "{error}");
    assert!(error.to_string().contains("has more than 1 GiB"), "{error}");
}
