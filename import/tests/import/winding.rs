//! Which side of a face is its front: warnings, `flip`, `fix_winding` and `two_sided`.

use crate::common::{file, obj as import, position, said};
use pinhole_import::{preview, Axis, Edges, ImportedMesh, Options, Remedy, Topology};

/// Vertices and quads.
type Body = (Vec<[f64; 3]>, Vec<[usize; 4]>);

/// A box, counter-clockwise seen from outside.
fn cuboid([x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> Body {
    let at = |i: usize| [x + a * (i & 1) as f64, y + b * (i >> 1 & 1) as f64, z + c * (i >> 2) as f64];
    let sides = [[4, 5, 7, 6], [1, 0, 2, 3], [5, 1, 3, 7], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4]];
    ((0..8).map(at).collect(), sides.to_vec())
}

/// Text of an OBJ file, by bodies. The first face of the first body is in line `8 · bodies + 1`.
fn obj(bodies: &[Body]) -> String {
    let (mut vertices, mut faces, mut first) = (String::new(), String::new(), 1);
    for (positions, quads) in bodies {
        for [x, y, z] in positions {
            vertices += &format!("v {x} {y} {z}\n");
        }
        for [a, b, c, d] in quads {
            faces += &format!("f {} {} {} {}\n", first + a, first + b, first + c, first + d);
        }
        first += positions.len();
    }
    vertices + &faces
}

fn reversed((positions, mut quads): Body) -> Body {
    quads.iter_mut().for_each(|quad| quad.reverse());
    (positions, quads)
}

fn fix() -> Options {
    Options { fix_winding: true, ..Options::default() }
}

/// Whether each face's normal points away from the centre of its own box, which is the one of `boxes` that it touches.
fn points_outwards(mesh: &ImportedMesh, boxes: &[([f64; 3], [f64; 3])]) -> Vec<bool> {
    let of = |(face, normal): (&[u16; 3], &[i16; 3])| {
        let corners = face.map(|v| position(mesh, v));
        let middle = [0, 1, 2].map(|axis| corners.iter().map(|c| c[axis]).sum::<f64>() / 3.0);
        let is_in = |(low, side): &&([f64; 3], [f64; 3])| {
            corners.iter().all(|c| (0..3).all(|i| c[i] > low[i] - 0.01 && c[i] < low[i] + side[i] + 0.01))
        };
        // The smallest box, where one is in another.
        let smallest = boxes.iter().filter(is_in).min_by(|a, b| a.1[0].total_cmp(&b.1[0])).unwrap();
        let (low, side) = smallest;
        (0..3).map(|i| f64::from(normal[i]) * (middle[i] - low[i] - side[i] / 2.0)).sum::<f64>() > 0.0
    };
    mesh.faces.iter().zip(&mesh.normals).map(of).collect()
}

#[test]
fn faces_against_their_neighbours_are_found_and_reversed() {
    // A box with two of six quads reversed, the second of them the first of the file that shares an edge with it.
    let (low, side) = ([1.0, 2.0, 3.0], [4.0, 2.0, 1.0]);
    let mut body = cuboid(low, side);
    body.1[1].reverse();
    body.1[4].reverse();
    let text = obj(&[body]);
    let mixed = import(&text, &Options::default()).unwrap();
    // Each of the two quads has four neighbours, and one edge between them, along which they agree: 6 edges differ.
    assert_eq!(mixed.topology(), Topology { twisted: 6, ..Topology::default() });
    let wanted = "edges between faces of opposite winding: 6, the first at line 11; \
        some faces will be culled: use --fix-winding";
    assert_eq!(said(&mixed), [wanted]);
    let fixed = import(&text, &fix()).unwrap();
    assert_eq!((fixed.topology(), said(&fixed)), (Topology::default(), vec![]));
    assert_eq!(fixed.report.reversed, 4, "the triangles of two quads");
    assert!(points_outwards(&fixed, &[(low, side)]).iter().all(|outwards| *outwards));
    assert!((fixed.volume() - 8.0).abs() < 1e-3);
    // Fixed or not, what is right stays as it is.
    let sound = obj(&[cuboid(low, side)]);
    assert_eq!(import(&sound, &fix()).unwrap(), import(&sound, &Options::default()).unwrap());
}

#[test]
fn most_of_the_faces_reversed_is_outwards_all_the_same() {
    let mut body = cuboid([0.0; 3], [3.0, 2.0, 1.0]);
    body.1[..5].iter_mut().for_each(|quad| quad.reverse());
    let fixed = import(&obj(&[body]), &fix()).unwrap();
    assert!((fixed.volume() - 6.0).abs() < 1e-3, "{}", fixed.volume());
    assert_eq!(fixed.report.reversed, 10);
}

#[test]
fn one_of_two_bodies_inside_out_is_not_hidden_by_the_other() {
    let (small, large) = (([0.0; 3], [1.0; 3]), ([5.0, 0.0, 0.0], [4.0; 3]));
    let text = obj(&[cuboid(large.0, large.1), reversed(cuboid(small.0, small.1))]);
    let mesh = import(&text, &Options::default()).unwrap();
    assert!(mesh.volume() > 0.0, "both together");
    // 16 vertices, 6 faces of the first body.
    let wanted =
        "parts inside out: 1 of 2, the first at line 23; their outside shows nothing: use --fix-winding";
    assert_eq!(said(&mesh), [wanted]);
    let fixed = import(&text, &fix()).unwrap();
    assert_eq!((said(&fixed), fixed.report.reversed), (vec![], 12));
    assert!(points_outwards(&fixed, &[small, large]).iter().all(|outwards| *outwards));
    // Reversed all, it is the other one that is wrong; and fixed as well it is right again.
    let flipped = import(&text, &Options { flip: true, ..Options::default() }).unwrap();
    assert_eq!(said(&flipped), [wanted.replace("23", "17") + " instead of --flip"]);
    let again = import(&text, &Options { flip: true, ..fix() }).unwrap();
    assert_eq!((said(&again), again.report.reversed), (vec![], 12));
    assert!(points_outwards(&again, &[small, large]).iter().all(|outwards| *outwards));
}

#[test]
fn cavities_point_inwards_and_what_is_in_a_frame_is_none() {
    // A closed box in a closed box: a cavity, as solid modellers write it.
    let (outer, inner) = (([0.0; 3], [4.0; 3]), ([1.0; 3], [2.0; 3]));
    let text = obj(&[cuboid(outer.0, outer.1), reversed(cuboid(inner.0, inner.1))]);
    let mesh = import(&text, &Options::default()).unwrap();
    assert_eq!(said(&mesh), Vec::<String>::new());
    assert_eq!(import(&text, &fix()).unwrap(), mesh);
    // A body within the cavity points outwards again.
    let core = ([1.5; 3], [1.0; 3]);
    let bodies =
        [cuboid(outer.0, outer.1), reversed(cuboid(inner.0, inner.1)), reversed(cuboid(core.0, core.1))];
    let text = obj(&bodies);
    let fixed = import(&text, &fix()).unwrap();
    assert_eq!(fixed.report.reversed, 12);
    let outwards = points_outwards(&fixed, &[outer, inner, core]);
    assert!(outwards[..12].iter().all(|o| *o) && outwards[12..24].iter().all(|o| !o));
    assert!(outwards[24..].iter().all(|o| *o));
    // In the bounding box of an L, but outside of it: no cavity.
    let section = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 4.0], [0.0, 4.0]];
    let corners = [0.0, 4.0].iter().flat_map(|&z| section.map(|[x, y]| [x, y, z])).collect();
    let mut quads = vec![[3, 2, 1, 0], [5, 4, 3, 0], [6, 7, 8, 9], [6, 9, 10, 11]];
    quads.extend((0..6).map(|i| [i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6]));
    let block = reversed(cuboid([2.0; 3], [1.0; 3]));
    let text = obj(&[(corners, quads), block]);
    let mesh = import(&text, &Options::default()).unwrap();
    assert_eq!((mesh.topology(), mesh.warnings.len()), (Topology::default(), 1), "{:?}", mesh.warnings);
    assert!(mesh.warnings[0].to_string().starts_with("parts inside out: 1 of 2, "), "{:?}", mesh.warnings);
    let fixed = import(&text, &fix()).unwrap();
    assert!((fixed.volume() - (4.0 * 7.0 + 1.0)).abs() < 0.01, "{}", fixed.volume());
}

#[test]
fn open_surfaces_point_away_from_their_middle() {
    // A box without its lid, inside out.
    let mut body = reversed(cuboid([0.0; 3], [3.0, 2.0, 1.0]));
    body.1.remove(4);
    let text = obj(&[body]);
    let mesh = import(&text, &Options::default()).unwrap();
    assert_eq!(mesh.topology().open, 4);
    let doubts = said(&mesh);
    assert!(doubts.len() == 2 && doubts[0].starts_with("open edges: 4, "), "{doubts:?}");
    assert!(
        doubts[1].starts_with("parts inside out: 1 of 1, ") && doubts[1].contains("use --flip"),
        "{doubts:?}"
    );
    let fixed = import(&text, &fix()).unwrap();
    assert!(points_outwards(&fixed, &[([0.0; 3], [3.0, 2.0, 1.0])]).iter().all(|outwards| *outwards));
    // A sheet has no inside: it stays as it lies.
    let sheet = "v 0 0 0\nv 1 0 0\nv 1 1 0.01\nv 0 1 0\nf 4 3 2 1\n";
    let fixed = import(sheet, &fix()).unwrap();
    assert_eq!((fixed.report.reversed, said(&fixed).len()), (0, 1));
}

/// A strip of `n` quads that is turned by half and closed.
fn strip(n: usize) -> String {
    let mut text = String::new();
    for i in 0..n {
        let turn = std::f64::consts::TAU * i as f64 / n as f64;
        for side in [-1.0, 1.0] {
            let (r, z) = (3.0 + side * (turn / 2.0).cos(), side * (turn / 2.0).sin());
            text += &format!("v {} {} {z}\n", r * turn.cos(), r * turn.sin());
        }
    }
    for i in 0..n {
        let [a, b] = [2 * i + 1, 2 * i + 2];
        let [c, d] = if i + 1 < n { [a + 2, b + 2] } else { [2, 1] }; // the half turn
        text += &format!("f {a} {c} {d} {b}\n");
    }
    text
}

#[test]
fn a_one_sided_surface_has_no_right_winding_and_says_so() {
    let text = strip(24);
    let mesh = import(&text, &fix()).unwrap();
    assert_eq!(mesh.report.reversed, 0);
    let doubts = said(&mesh);
    assert_eq!((doubts.len(), mesh.topology().twisted), (2, 1), "{doubts:?}");
    assert!(
        doubts[1].ends_with("; the surface is one-sided, like a Möbius strip: use --two-sided"),
        "{doubts:?}"
    );
    // Both sides of it are one closed surface.
    let both = import(&text, &Options { two_sided: true, ..fix() }).unwrap();
    assert_eq!((both.faces.len(), said(&both).len()), (96, 0));
}

/// Positions, for comparing faces of different meshes.
fn triangles(mesh: &ImportedMesh) -> Vec<[[i16; 3]; 3]> {
    mesh.faces.iter().map(|face| face.map(|v| mesh.vertices[usize::from(v)])).collect()
}

#[test]
fn two_sided_adds_the_backs_of_what_can_be_seen_from_behind() {
    // A closed box, and a sheet of two triangles beside it.
    let sheet =
        (vec![[9.0, 0.0, 0.0], [12.0, 0.0, 0.0], [12.0, 4.0, 0.0], [9.0, 4.0, 0.0]], vec![[0, 1, 2, 3]]);
    let text = obj(&[cuboid([0.0; 3], [4.0; 3]), sheet]);
    let all = Options {
        edge_faces: true,
        planes: true,
        vertex_normals: true,
        edges: Edges::Feature { degrees: 30.0 },
        ..Options::default()
    };
    let one = import(&text, &all).unwrap();
    let two = import(&text, &Options { two_sided: true, ..all.clone() }).unwrap();
    assert_eq!((one.faces.len(), two.faces.len(), two.report.backs), (14, 16, 2));
    assert_eq!((said(&one).len(), said(&two)), (1, vec![]));
    assert_eq!((two.topology(), two.volume()), (one.topology(), one.volume()), "of the fronts");
    // The fronts are what they were; each back has its front's corners, reversed, and the opposite normal and plane.
    let (fronts, backs) = (triangles(&one), triangles(&two));
    assert_eq!(backs[..14], fronts);
    for (front, back) in [(12, 14), (13, 15)] {
        let [a, b, c] = fronts[front];
        assert_eq!(backs[back], [a, c, b]);
        assert_eq!(two.normals[back], two.normals[front].map(|c| -c));
        assert!((two.planes[back] + two.planes[front]).abs() <= 1);
        for corner in 0..3 {
            let [v, w] = [(front, [0, 2, 1][corner]), (back, corner)]
                .map(|(face, corner)| usize::from(two.faces[face][corner]));
            assert_eq!(two.vertex_normals[w], two.vertex_normals[v].map(|c| -c));
        }
    }
    // Edges of the sheet are listed with its fronts and with its backs, and the diagonal is still no crease.
    let sheet_edges = |mesh: &ImportedMesh| {
        let beside = |face: u16| mesh.edge_faces.iter().filter(|two| two.contains(&face)).count();
        (12..mesh.faces.len() as u16).map(beside).collect::<Vec<_>>()
    };
    assert_eq!((sheet_edges(&one), sheet_edges(&two)), (vec![2, 2], vec![2, 2, 2, 2]));
    assert_eq!((one.edges.len(), two.edges.len()), (16, 20));
    let mesh = two.mesh_with_planes().unwrap();
    assert_eq!((mesh.faces().len(), mesh.planes().len()), (16, 16));
    // Without vertex normals both sides share the vertices.
    let lean = import(&text, &Options { two_sided: true, ..Options::default() }).unwrap();
    assert_eq!(lean.vertices.len(), 12);
    assert_eq!(lean.edges.len(), import(&text, &Options::default()).unwrap().edges.len());
}

#[test]
fn a_preview_is_the_mesh_in_the_axes_of_the_file() {
    // Two boxes, one mixed and one inside out, a sheet, a duplicate of a face that is reversed, and a sliver.
    let mut mixed = cuboid([0.0; 3], [4.0; 3]);
    mixed.1[2].reverse();
    let text = obj(&[mixed, reversed(cuboid([6.0; 3], [1.0, 2.0, 3.0]))]);
    let duplicate = text.lines().filter(|line| line.starts_with('f')).nth(2).unwrap();
    let text = format!("{text}{duplicate}\nv 9 0 0\nv 12 0 0\nv 12 4 0\nf -3 -2 -1\nf 1 1 2\n");
    let path = file("winding-preview", "preview.obj", &text);
    for two_sided in [false, true] {
        for (flip, fix_winding) in [(false, false), (false, true), (true, false), (true, true)] {
            for (_, up) in Axis::ALL {
                let options = Options { two_sided, flip, fix_winding, up: Some(up), ..Options::default() };
                let (mesh, preview) = (import(&text, &options).unwrap(), preview(&path, &options).unwrap());
                assert_eq!((preview.warnings, preview.backs), (mesh.warnings.clone(), mesh.report.backs));
                let step = 2f64.powi(i32::from(mesh.exponent));
                let at = |v: [i16; 3]| [0, 1, 2].map(|i| f64::from(v[i]) * step + mesh.offset[i]);
                let of_mesh = triangles(&mesh).into_iter().map(|corners| corners.map(at));
                let shown = &preview.triangles;
                let of_preview = shown.faces.iter().map(|face| face.map(|v| up.to_y(shown.positions[v])));
                assert!(of_mesh.eq(of_preview), "{options:?}");
            }
        }
    }
}

#[test]
fn what_no_mesh_holds_can_be_shown_and_says_so() {
    // 300 × 300 vertices.
    let mut text = String::new();
    for (x, y) in (0..300).flat_map(|y| (0..300).map(move |x| (x, y))) {
        text += &format!("v {x} {y} {}\n", (x * y) as f64 / 90000.0);
    }
    for a in (0..299).flat_map(|y| (0..299).map(move |x| 300 * y + x + 1)) {
        text += &format!("f {} {} {} {}\n", a, a + 1, a + 301, a + 300);
    }
    let path = file("winding-field", "field.obj", &text);
    let error = import(&text, &Options::default()).unwrap_err();
    let decimate = Remedy::Decimate(0);
    let problem =
        format!("has 90000 vertices, more than the 65536 of a mesh: {decimate}, or split the model");
    assert_eq!(error.to_string(), format!("model.obj: {problem}"));
    let shown = preview(&path, &Options::default()).unwrap();
    assert_eq!(shown.triangles.faces.len(), 2 * 299 * 299);
    let doubts: Vec<_> = shown.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(doubts.len(), 2, "{doubts:?}");
    assert!(doubts[0].starts_with("open edges: 1196, "));
    assert_eq!(doubts[1], format!("not for firmware: {problem}"));
}
