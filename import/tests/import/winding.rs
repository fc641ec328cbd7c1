//! Which side of a face is its front: backs, and what is shown. Warnings and repairs are in `cases.txt`.

use crate::common::{file, obj as import, said};
use pinhole_apps_support::bodies::{cuboid, moved, obj, reversed, stl, torus};
use pinhole_import::{preview, Axis, Edges, ImportedMesh, Options, Remedy};

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
    let fix = Options { fix_winding: true, ..Options::default() };
    let mesh = import(&text, &fix).unwrap();
    assert_eq!(mesh.report.reversed, 0);
    let doubts = said(&mesh);
    assert_eq!((doubts.len(), mesh.topology().twisted), (2, 1), "{doubts:?}");
    assert!(
        doubts[1].ends_with("; the surface is one-sided, like a Möbius strip: use --two-sided"),
        "{doubts:?}"
    );
    // Both sides of it are one closed surface.
    let both = import(&text, &Options { two_sided: true, ..fix }).unwrap();
    assert_eq!((both.faces.len(), said(&both).len()), (96, 0));
}

/// Positions, for comparing faces of different meshes.
fn triangles(mesh: &ImportedMesh) -> Vec<[[i16; 3]; 3]> {
    mesh.faces.iter().map(|face| face.map(|v| mesh.vertices[usize::from(v)])).collect()
}

#[test]
fn two_sided_adds_the_backs_of_what_can_be_seen_from_behind() {
    // A closed box, and a sheet of two triangles beside it.
    let [a, b, c, d] = [[9.0, 0.0, 0.0], [12.0, 0.0, 0.0], [12.0, 4.0, 0.0], [9.0, 4.0, 0.0]];
    let text = obj(&[cuboid([4.0; 3]), vec![[a, b, c], [a, c, d]]].concat());
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
    let mesh = two.mesh().unwrap();
    assert_eq!((mesh.faces().len(), mesh.planes().len()), (16, 16));
    // Without vertex normals both sides share the vertices.
    let lean = import(&text, &Options { two_sided: true, ..Options::default() }).unwrap();
    assert_eq!(lean.vertices.len(), 12);
    assert_eq!(lean.edges.len(), import(&text, &Options::default()).unwrap().edges.len());
}

#[test]
fn a_preview_is_the_mesh_in_the_axes_of_the_file() {
    // Two boxes, one mixed and one inside out, a sheet, a duplicate of a face that is reversed, and a sliver.
    let mut mixed = cuboid([4.0; 3]);
    mixed[4..6].iter_mut().for_each(|corners| corners.reverse());
    let other = moved(&cuboid([1.0, 2.0, 3.0]), |corner| corner.map(|c| c + 6.0));
    let text = obj(&[mixed.clone(), reversed(&other), vec![mixed[4]]].concat());
    let text = format!("{text}v 9 0 0\nv 12 0 0\nv 12 4 0\nf -3 -2 -1\nf 1 1 2\n");
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
    let path = file("winding-vast", "vast.stl", stl(&torus(3.0, 1.0, 300, 300)));
    let error = pinhole_import::import(&path, &Options::default()).unwrap_err();
    let decimate = Remedy::Decimate(0);
    let problem =
        format!("has 90000 vertices, more than the 65536 of a mesh: {decimate}, or split the model");
    assert_eq!(error.problem.to_string(), problem);
    let shown = preview(&path, &Options::default()).unwrap();
    assert_eq!(shown.triangles.faces.len(), 180_000);
    let doubts: Vec<_> = shown.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(doubts, [format!("not for firmware: {problem}")]);
}
