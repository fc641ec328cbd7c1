//! Lines of OBJ files as edges of the mesh, and what is left out beside them.

use crate::common::{obj as import, position, said};
use pinhole_import::{Edges, Element, ImportedMesh, Options, Place, Problem, Warning};
use std::collections::BTreeSet;

const NO_FACE: u16 = pinhole::Mesh::<i16>::NO_FACE;

/// The corners of a box, and its six sides.
const CORNERS: &str = "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 0 0 2\nv 4 0 2\nv 4 2 2\nv 0 2 2\n";
const SIDES: &str = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";

/// The ends of the edges in the file's units, the lower one first.
fn edges(mesh: &ImportedMesh) -> BTreeSet<[[i32; 3]; 2]> {
    let end = |vertex: u16| position(mesh, vertex).map(|c| c.round() as i32);
    mesh.edges.iter().map(|&[a, b]| [end(a).min(end(b)), end(a).max(end(b))]).collect()
}

#[test]
fn a_file_of_lines_alone_is_a_wireframe() {
    let lines = "l 1 2 3 4 1\nl 5 6 7 8 5\nl 1 5\nl 2/7 6\nl -6 -2\nl 4 \\\n8\nl 8 4\n";
    let sides: BTreeSet<_> = (0..8usize)
        .flat_map(|corner| [1, 2, 4].map(|bit| (corner, corner | bit)))
        .filter(|(from, to)| from != to)
        .map(|(from, to)| {
            [from, to].map(|corner| [corner & 1, corner >> 1 & 1, corner >> 2].map(|c| 2 * c as i32))
        })
        .map(|ends| ends.map(|[x, y, z]| [2 * x, y, z]))
        .collect();
    assert_eq!(sides.len(), 12);
    for options in [
        Options::default(),
        Options { edges: Edges::Feature { degrees: 30.0 }, edge_faces: true, ..Options::default() },
        Options {
            reorder: true,
            two_sided: true,
            fix_winding: true,
            vertex_normals: true,
            ..Options::default()
        },
    ] {
        let mesh = import(&format!("{CORNERS}{lines}"), &options).unwrap();
        assert_eq!((mesh.vertices.len(), mesh.edges.len(), mesh.faces.len()), (8, 12, 0));
        assert_eq!((edges(&mesh), mesh.warnings.len()), (sides.clone(), 0), "{:?}", mesh.warnings);
        assert!(mesh.edge_faces.iter().all(|beside| *beside == [NO_FACE; 2]));
        assert!(mesh.mesh().is_ok());
    }
    let none = Options { edges: Edges::None, ..Options::default() };
    let error = import(&format!("{CORNERS}{lines}"), &none).unwrap_err();
    assert!(matches!(error.problem, Problem::NoFaces), "{error}");
}

#[test]
fn lines_beside_faces_are_edges() {
    // To a point above the box, along the diagonal of a side, and along a side's edge.
    let lines = "v 2 1 6\nl 7 9\nl 5 9\nl 5 7\nl 1 2\n";
    let text = format!("{CORNERS}{SIDES}{lines}");
    let without = import(&format!("{CORNERS}{SIDES}"), &Options::default()).unwrap();
    let mesh = import(&text, &Options::default()).unwrap();
    let [above, corner, far] = [[2, 1, 6], [0, 0, 2], [4, 2, 2]];
    let lone = [[corner.min(above), corner.max(above)], [above, far]];
    assert_eq!(edges(&mesh), &edges(&without) | &BTreeSet::from(lone));
    assert_eq!((mesh.vertices.len(), mesh.report.extent), (9, 6.0));

    let feature = Options { edges: Edges::Feature { degrees: 30.0 }, edge_faces: true, ..Options::default() };
    let mesh = import(&text, &feature).unwrap();
    assert_eq!(mesh.edges.len(), 12 + 3, "the lines, and no diagonal but the one that is a line");
    assert!(mesh.edges.is_sorted() && mesh.mesh().is_ok());
    let lone = mesh.edge_faces.iter().filter(|beside| **beside == [NO_FACE; 2]).count();
    assert_eq!((lone, mesh.edge_faces.iter().flatten().filter(|&&face| face == NO_FACE).count()), (2, 4));

    let none = import(&text, &Options { edges: Edges::None, ..Options::default() }).unwrap();
    assert_eq!((none.vertices.len(), none.edges.len()), (8, 0));
}

#[test]
fn what_is_left_out_is_said_with_its_count() {
    let rest = "p 1\np 2 3\nl 1 99\nl 1 x\nl 0 1\ncurv 0 1 1 2\nsurf 0 1 0 1 1 2 3\np 1\n";
    let mesh = import(&format!("{CORNERS}{SIDES}{rest}"), &Options::default()).unwrap();
    let left = |what, count, line| Warning::LeftOut { what, count, first: Place::Line(line) };
    assert_eq!(
        mesh.warnings,
        [left(Element::Points, 3, 15), left(Element::Lines, 3, 17), left(Element::Curves, 2, 20)]
    );
    assert_eq!(said(&mesh)[0], "points (`p`): 3, the first at line 15; left out");
    assert_eq!(mesh.edges.len(), 18);
}
