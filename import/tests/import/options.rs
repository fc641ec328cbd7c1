//! What can be chosen, each against its definition in `f64`.

use crate::common::{obj, position, said};
use pinhole::MeshError;
use pinhole_import::{Axis, Centre, Edges, ImportedMesh, Options, Problem};
use std::collections::{HashMap, HashSet};

/// A block of 4 × 2 × 1 from the origin, with z upwards, of quads, counter-clockwise seen from outside.
const BLOCK: &str = "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 0 0 1\nv 4 0 1\nv 4 2 1\nv 0 2 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

/// A ball of triangles, about (5, 0, 0), with a radius of 3; its faces in the order of a shuffled pack.
fn ball(rings: usize, sides: usize) -> String {
    let mut text = String::from("v 5 0 3\nv 5 0 -3\n");
    for ring in 1..rings {
        for side in 0..sides {
            let (a, b) = (ring as f64 / rings as f64, side as f64 / sides as f64);
            let (a, b) = (a * std::f64::consts::PI, b * std::f64::consts::TAU);
            text += &format!(
                "v {} {} {}\n",
                5.0 + 3.0 * a.sin() * b.cos(),
                3.0 * a.sin() * b.sin(),
                3.0 * a.cos()
            );
        }
    }
    let at = |ring: usize, side: usize| match ring {
        0 => 1,
        r if r == rings => 2,
        _ => 3 + (ring - 1) * sides + side % sides,
    };
    let mut faces = Vec::new();
    for ring in 0..rings {
        for side in 0..sides {
            let [a, b] = [at(ring, side), at(ring + 1, side)];
            let [c, d] = [at(ring + 1, side + 1), at(ring, side + 1)];
            faces.extend((b != c).then(|| format!("f {a} {b} {c}\n")));
            faces.extend((a != d).then(|| format!("f {a} {c} {d}\n")));
        }
    }
    // Every face once: the step has no factor in common with their number.
    let (count, step) = (faces.len(), 7919);
    assert_ne!(count % step, 0);
    text.extend((0..count).map(|i| faces[i * step % count].as_str()));
    text
}

/// The largest and the smallest of each coordinate.
fn bounds(mesh: &ImportedMesh) -> [[f64; 3]; 2] {
    let all: Vec<_> = (0..mesh.vertices.len()).map(|v| position(mesh, v as u16)).collect();
    let fold = |pick: fn(f64, f64) -> f64| {
        [0, 1, 2].map(|axis| all.iter().map(|p| p[axis]).reduce(pick).unwrap_or(f64::NAN))
    };
    [fold(f64::min), fold(f64::max)]
}

/// A tetrahedron with edges of 1, and a face far away whose corners lie on one line.
#[test]
fn faces_on_a_line_decide_nothing() {
    for far in [1e3, 1e9, 1e-9, 1e150] {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
        let text = format!("{text}v {far} 0 0\nv {} 0 0\nf 1 5 6\n", 2.0 * far);
        let mesh = obj(&text, &Options { fit: Some(2.0), ..Options::default() }).unwrap();
        let report = mesh.report;
        assert_eq!((mesh.faces.len(), report.degenerate, report.unused), (4, 1, 2), "{far:e}");
        assert_eq!((report.extent, report.scale, mesh.offset), (2.0, 2.0, [1.0; 3]), "{far:e}");
        let wanted = "faces without area: 1, the first at line 11; dropped, which changes no picture";
        assert!(said(&mesh).contains(&wanted.into()), "{:?}", mesh.warnings);
    }
}

/// A box along x, as text.
fn rod([x, y, z]: [f64; 3]) -> String {
    let corner =
        |i: usize| format!("v {} {} {}\n", (i & 1) as f64 * x, (i >> 1 & 1) as f64 * y, (i >> 2) as f64 * z);
    let sides = ["5 6 8 7", "2 1 3 4", "6 2 4 8", "1 5 7 3", "7 8 4 3", "1 2 6 5"];
    (0..8).map(corner).collect::<String>() + &sides.map(|side| format!("f {side}\n")).concat()
}

/// Half of 60 000 is less than 32 767, so the step is 1, and coordinates are halves of the sides, rounded.
#[test]
fn shapes_that_rounding_changes_are_named() {
    const HELP: &str = "split the model, or leave out parts that lie far from the others";
    let start = "rounding to a grid of at most 65535 steps along the longest side changes the shape: ";
    for (sides, what) in [
        ([60000.0, 100.0, 100.0], None),
        // Sides of 1 become 2.
        ([60000.0, 1.0, 1.0], Some("0 of 12 faces have no area on it, and the area of all is 200")),
        // Four faces of 60000 by 1 or 0.9 and two small ones become two of 60000 by 2.
        ([60000.0, 1.0, 0.9], Some("8 of 12 faces have no area on it, and the area of all is 105")),
    ] {
        let mesh = obj(&rod(sides), &Options::default()).unwrap();
        let found: Vec<_> = said(&mesh).into_iter().filter(|text| text.starts_with("rounding")).collect();
        let wanted = what.map(|what| format!("{start}{what} % of that in the file: {HELP}"));
        assert_eq!(found, Vec::from_iter(wanted));
    }
    let error = obj(&rod([60000.0, 0.9, 0.9]), &Options::default()).unwrap_err();
    let problem = format!("has no face with an area on a grid of at most 65535 steps along its longest side, as all 12 are thinner than a step: {HELP}");
    assert!(error.to_string().ends_with(&problem), "{error}");
}

#[test]
fn small_and_large_faces_have_an_area() {
    // Their squares are beyond f64.
    for size in [1e-170, 1e200] {
        let text = format!("v 0 0 0\nv {size:e} 0 0\nv 0 {size:e} 0\nf 1 2 3\n");
        let options = Options { fit: Some(1.0), ..Options::default() };
        let mesh = obj(&text, &options).unwrap();
        assert_eq!((mesh.faces.len(), mesh.report.extent), (1, 1.0));
    }
}

#[test]
fn the_axis_that_points_upwards_becomes_y_and_nothing_is_mirrored() {
    let whole = obj(BLOCK, &Options::default()).unwrap();
    let axes = [
        (Axis::X, [1.0, 0.0, 0.0]),
        (Axis::Y, [0.0, 1.0, 0.0]),
        (Axis::Z, [0.0, 0.0, 1.0]),
        (Axis::MinusX, [-1.0, 0.0, 0.0]),
        (Axis::MinusY, [0.0, -1.0, 0.0]),
        (Axis::MinusZ, [0.0, 0.0, -1.0]),
    ];
    for (up, axis) in axes {
        let mesh = obj(BLOCK, &Options { up: Some(up), ..Options::default() }).unwrap();
        // Faces are unchanged and in unchanged order, so comparing vertices checks the rotation.
        assert_eq!(mesh.faces, whole.faces);
        for vertex in 0..8 {
            let (before, after) = (position(&whole, vertex), position(&mesh, vertex));
            let height: f64 = before.iter().zip(axis).map(|(c, a)| c * a).sum();
            assert_eq!(after[1], height, "{up:?}");
            let square = |p: [f64; 3]| p.iter().map(|c| c * c).sum::<f64>();
            assert_eq!(square(after), square(before), "a turn about the origin");
        }
        assert!((mesh.volume() - 8.0).abs() < 1e-3, "no mirror: {}", mesh.volume());
    }
}

#[test]
fn a_model_is_made_as_long_as_wanted() {
    for (fit, scale) in [(1.0, 0.25), (0.001, 0.00025), (30000.0, 7500.0)] {
        let mesh = obj(BLOCK, &Options { fit: Some(fit), ..Options::default() }).unwrap();
        assert_eq!((mesh.report.scale, mesh.report.extent), (scale, fit));
        let [low, high] = bounds(&mesh);
        for (axis, side) in [4.0, 2.0, 1.0].into_iter().enumerate() {
            assert!(
                (low[axis]).abs() <= mesh.report.error && (high[axis] - side * scale).abs() <= fit / 32000.0
            );
        }
    }
    for fit in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = obj(BLOCK, &Options { fit: Some(fit), ..Options::default() }).unwrap_err();
        assert!(
            error.to_string().ends_with("model.obj: the length to fit is not a positive number"),
            "{error}"
        );
    }
}

#[test]
fn the_origin_may_be_the_centre_or_the_files() {
    let centred = obj(BLOCK, &Options::default()).unwrap();
    assert_eq!(centred.offset, [2.0, 1.0, 0.5]);
    let mesh = obj(BLOCK, &Options { centre: Centre::Origin, ..Options::default() }).unwrap();
    assert_eq!(mesh.offset, [0.0; 3]);
    assert_eq!(bounds(&mesh), [[0.0; 3], [4.0, 2.0, 1.0]]);
    // Half the range is not used: a step twice as long.
    assert_eq!(mesh.exponent, centred.exponent + 1);
}

#[test]
fn faces_are_turned_over() {
    let mesh = obj(BLOCK, &Options { flip: true, ..Options::default() }).unwrap();
    assert_eq!(mesh.volume(), -8.0);
    let doubt = said(&mesh);
    let wanted = "parts inside out: 1 of 1, the first at line 9; the outside shows nothing: leave out --flip, unless it is a room seen from inside";
    assert_eq!(doubt, [wanted]);
}

/// For each edge of the faces, by its vertices, the faces that have it, in order.
fn faces_by_edge(mesh: &ImportedMesh) -> HashMap<[u16; 2], Vec<u16>> {
    let mut beside: HashMap<_, Vec<u16>> = HashMap::new();
    for (face, corners) in mesh.faces.iter().enumerate() {
        for i in 0..3 {
            let mut edge = [corners[i], corners[(i + 1) % 3]];
            edge.sort_unstable();
            beside.entry(edge).or_default().push(face as u16);
        }
    }
    beside
}

/// The angle in degrees between the normals of two faces, by their vertices.
fn angle(mesh: &ImportedMesh, faces: &[u16]) -> f64 {
    let normal = |face: u16| {
        let [a, b, c] = mesh.faces[usize::from(face)].map(|v| position(mesh, v));
        let (p, q) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
        let n = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
        n.map(|c| c / n.iter().map(|c| c * c).sum::<f64>().sqrt())
    };
    let (m, n) = (normal(faces[0]), normal(faces[1]));
    m.iter().zip(n).map(|(a, b)| a * b).sum::<f64>().clamp(-1.0, 1.0).acos().to_degrees()
}

#[test]
fn feature_edges_are_those_where_the_surface_turns_or_ends() {
    let feature = |text: &str, degrees| {
        obj(text, &Options { edges: Edges::Feature { degrees }, ..Options::default() }).unwrap()
    };
    // What turns by 90°, or by 0°, does not turn by more. Coplanar triangles of different size: their border alone.
    assert_eq!([89.0, 90.0, 91.0].map(|degrees| feature(BLOCK, degrees).edges.len()), [12, 0, 0]);
    let plane = "v 0 0 0\nv 16 -8 0\nv 21 -3 -5\nv 15 0 -5\nf 1 2 3 4\n";
    assert_eq!([0.0, 30.0].map(|degrees| feature(plane, degrees).edges.len()), [4, 4]);
    // The block: its twelve, not the six diagonals, which a triangle's normals do not see.
    for degrees in [0.5, 30.0, 89.9] {
        let mesh = feature(BLOCK, degrees);
        let of_block = |&[a, b]: &[u16; 2]| {
            let (p, q) = (position(&mesh, a), position(&mesh, b));
            (0..3).filter(|&axis| (p[axis] - q[axis]).abs() > 0.5).count() == 1
        };
        assert!(mesh.edges.len() == 12 && mesh.edges.iter().all(of_block), "{degrees}");
    }
    assert!(feature(BLOCK, 90.1).edges.is_empty());
    // An open lid: the rim stays, whatever the angle.
    let sheet = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    assert_eq!(feature(sheet, 180.0).edges.len(), 4);
    // Three sheets at an edge, and two of opposite winding, are always edges.
    let fan = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 1 1e-3\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    assert_eq!(feature(fan, 180.0).edges.len(), 7);
    let twist = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nf 1 2 3\nf 1 2 4\n";
    assert_eq!(feature(twist, 180.0).edges.len(), 5);

    // The ball: every edge by its own angle, where that is not within rounding of the limit.
    let ball = ball(12, 16);
    for degrees in [5.0, 14.0, 17.0] {
        let mesh = feature(&ball, degrees);
        let edges: HashSet<_> = mesh.edges.iter().copied().collect();
        let (mut sharp, mut blunt) = (0, 0);
        for (edge, faces) in faces_by_edge(&mesh) {
            let turn = angle(&mesh, &faces);
            if (turn - degrees).abs() > 1e-6 {
                assert_eq!(edges.contains(&edge), turn > degrees, "{turn} {degrees}");
                *if turn > degrees { &mut sharp } else { &mut blunt } += 1;
            }
        }
        assert!(sharp > 10 && blunt > 10, "{degrees}: {sharp} {blunt}");
    }
    for degrees in [-1.0, 181.0, f64::NAN] {
        let options = Options { edges: Edges::Feature { degrees }, ..Options::default() };
        assert!(matches!(obj(BLOCK, &options).unwrap_err().problem, Problem::Options(_)));
    }
    assert!(obj(BLOCK, &Options { edges: Edges::None, ..Options::default() }).unwrap().edges.is_empty());
}

#[test]
fn the_faces_beside_edges_are_all_there() {
    let options = Options { edge_faces: true, ..Options::default() };
    let mesh = obj(&ball(8, 10), &options).unwrap();
    assert_eq!(mesh.mesh().unwrap().edge_faces(), mesh.edge_faces);
    let expected = faces_by_edge(&mesh);
    assert_eq!(mesh.edges.len(), expected.len());
    for (edge, beside) in mesh.edges.iter().zip(&mesh.edge_faces) {
        assert_eq!(expected[edge], beside);
    }
    // An open edge has one face, and where three meet, the edge is there twice; as pinhole's own function has it.
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    let fan = obj(text, &options).unwrap();
    let edges: [[u16; 2]; 8] = fan.edges[..].try_into().unwrap();
    assert_eq!(edges[..2], [[0, 1], [0, 1]]);
    assert_eq!(fan.edge_faces, pinhole::edge_faces(&edges, &fan.faces));
    assert_eq!(fan.edge_faces[1], [2, u16::MAX]);
    // Faces of feature edges only.
    let options = Options { edges: Edges::Feature { degrees: 30.0 }, ..options };
    let mesh = obj(BLOCK, &options).unwrap();
    assert_eq!(mesh.edge_faces.len(), 12);
    let expected = faces_by_edge(&mesh);
    assert!(mesh.edges.iter().zip(&mesh.edge_faces).all(|(edge, beside)| expected[edge] == beside));
}

#[test]
fn vertex_normals_do_not_depend_on_how_a_surface_is_cut() {
    let options = Options { vertex_normals: true, normals: false, ..Options::default() };
    // A cube, cut so that a corner has four, five or six triangles: its normals lie along the space diagonals.
    let cube = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
        f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";
    let mesh = obj(cube, &options).unwrap();
    assert!(mesh.normals.is_empty());
    assert_eq!(mesh.mesh().unwrap().vertex_normals().len(), 8);
    let third = (32767.0 / 3f64.sqrt()).round() as i16;
    for (vertex, normal) in mesh.vertices.iter().zip(&mesh.vertex_normals) {
        assert_eq!(*normal, vertex.map(|c| c.signum() * third));
    }
    // A ball's point outwards, as well as the angles of its triangles allow.
    let mesh = obj(&ball(24, 32), &options).unwrap();
    for vertex in 0..mesh.vertices.len() {
        let outwards = position(&mesh, vertex as u16);
        let outwards = [outwards[0] - 5.0, outwards[1], outwards[2]].map(|c| c / 3.0);
        let normal = mesh.vertex_normals[vertex].map(|c| f64::from(c) / 32767.0);
        let cosine: f64 = outwards.iter().zip(normal).map(|(a, b)| a * b).sum();
        assert!(cosine > 1f64.to_radians().cos(), "{vertex}: {cosine}");
    }
    // Two sides of a sheet cancel: the first face's.
    let sheet = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n";
    let mesh = obj(sheet, &options).unwrap();
    assert_eq!(mesh.vertex_normals, [[0, 0, 32767]; 3]);
}

/// Vertices fetched for a face through a cache of 16, first in, first out, as a list.
fn fetched(mesh: &ImportedMesh) -> f64 {
    let (mut cache, mut fetched) = (Vec::new(), 0);
    for vertex in mesh.faces.iter().flatten() {
        if !cache.contains(vertex) {
            fetched += 1;
            cache.insert(0, *vertex);
            cache.truncate(16);
        }
    }
    f64::from(fetched) / mesh.faces.len() as f64
}

#[test]
fn neighbours_follow_each_other_and_nothing_else_changes() {
    let text = ball(40, 50);
    let options = Options { edge_faces: true, vertex_normals: true, ..Options::default() };
    let before = obj(&text, &options).unwrap();
    let after = obj(&text, &Options { reorder: true, ..options }).unwrap();
    assert_eq!(before.report.fetches, [fetched(&before); 2]);
    assert_eq!(after.report.fetches, [fetched(&before), fetched(&after)]);
    // Sander, Nehab and Barczak report 0.6 to 0.7 for caches of 12 to 24; a shuffled pack has nearly 3.
    assert!(fetched(&before) > 2.9 && fetched(&after) < 0.72, "{} {}", fetched(&before), fetched(&after));
    // Vertices by their first use.
    let mut next = 0;
    for &vertex in after.faces.iter().flatten() {
        assert!(vertex <= next);
        next += u16::from(vertex == next);
    }
    assert_eq!(usize::from(next), after.vertices.len());

    // Faces are equal if the positions and normals of their vertices are.
    let faces = |mesh: &ImportedMesh| {
        let of = |face: usize| {
            let [a, b, c] = mesh.faces[face].map(usize::from);
            ([a, b, c].map(|v| (mesh.vertices[v], mesh.vertex_normals[v])), mesh.normals[face])
        };
        let mut all: Vec<_> = (0..mesh.faces.len()).map(of).collect();
        all.sort_unstable();
        all
    };
    // Vertex normals are sums, in another order: equal but for rounding.
    let (a, b) = (faces(&before), faces(&after));
    assert_eq!(a.len(), b.len());
    for ((a, m), (b, n)) in a.into_iter().zip(b) {
        assert_eq!(m, n);
        for ((p, m), (q, n)) in a.into_iter().zip(b) {
            assert_eq!(p, q);
            assert!(m.iter().zip(n).all(|(m, n)| (m - n).abs() <= 1));
        }
    }
    let expected = faces_by_edge(&after);
    assert!(after.edges.iter().zip(&after.edge_faces).all(|(edge, beside)| expected[edge] == beside));
    assert_eq!(after.edges.len(), before.edges.len());
}

#[test]
fn lines_are_right_after_faces_were_ordered() {
    // The ball without one face: the hole is beside the face that the warning names.
    let text = ball(10, 12);
    let cut = text.rfind("f ").unwrap();
    let gone: HashSet<&str> = text[cut..].split_whitespace().skip(1).collect();
    let expected = text.lines().position(|line| {
        let corners: HashSet<_> = line.split_whitespace().skip(1).collect();
        line.starts_with('f') && gone.intersection(&corners).count() == 2
    });
    let expected = expected.unwrap() + 1;
    let text = &text[..cut];
    let options = Options { reorder: true, ..Options::default() };
    let mesh = obj(text, &options).unwrap();
    let warning = &mesh.warnings[0];
    assert!(warning.to_string().starts_with("open edges: 3, the first at line "), "{warning}");
    let line = text.lines().nth(warning.line().unwrap() - 1).unwrap();
    let corners: HashSet<_> = line.split_whitespace().skip(1).collect();
    assert_eq!(gone.intersection(&corners).count(), 2, "a neighbour of the hole");
    assert_eq!(warning.line(), Some(expected), "the first in the file");
}

#[test]
fn the_third_face_of_an_edge_is_that_of_the_file() {
    // The ball, and a fin on the first edge of its first face.
    let text = ball(10, 12);
    let face = text.lines().find(|line| line.starts_with('f')).unwrap();
    let corners: Vec<&str> = face.split_whitespace().collect();
    let text = format!("{text}v 5 9 9\nf {} {} -1\n", corners[1], corners[2]);
    let options = Options { reorder: true, ..Options::default() };
    let mesh = obj(&text, &options).unwrap();
    let crowded = mesh
        .warnings
        .iter()
        .find(|w| w.to_string().starts_with("edges of more than two faces: 1, "))
        .unwrap();
    assert_eq!(crowded.line(), Some(text.lines().count()));
}

#[test]
fn what_a_mesh_cannot_hold_says_what_to_do() {
    let tiny = "v 0 0 0\nv 1e-20 0 0\nv 0 1e-20 0\nf 1 2 3\n";
    let error = obj(tiny, &Options::default()).unwrap_err();
    assert!(matches!(error.problem, Problem::Exponent(-82)), "{error}"); // half of 1e-20 is 24178 · 2^-82
    assert!(
        error.to_string().contains(
            "needs a step of 2^-82, but a mesh has 2^-32 to 2^15: use another unit, or pinhole-import --fit"
        ),
        "{error}"
    );
    assert!(obj(tiny, &Options { fit: Some(1.0), ..Options::default() }).is_ok());
    let error = obj(tiny, &Options { planes: true, ..Options::default() }).unwrap_err();
    assert!(matches!(error.problem, Problem::Exponent(-82)), "{error}");
}

#[test]
fn flash_is_counted() {
    let all = Options { edge_faces: true, planes: true, vertex_normals: true, ..Options::default() };
    let mesh = obj(BLOCK, &all).unwrap();
    // 8 vertices with normals, 12 faces with normals and planes, 18 edges with their faces.
    assert_eq!(mesh.flash_bytes(), 8 * (6 + 6) + 12 * (6 + 6 + 2) + 18 * (4 + 4));
}

#[test]
fn planes_are_those_of_the_finished_mesh() {
    let options = Options { reorder: true, planes: true, ..Options::default() };
    let made = obj(BLOCK, &options).unwrap();
    let mesh = made.mesh_with_planes().unwrap();
    assert_eq!(mesh.planes(), mesh.face_planes::<12>());
    assert_eq!(mesh.planes(), made.planes);

    // By the definition: half of n·v, where a vertex and a normal of 2^15 stand for 1.
    let text = ball(12, 16);
    let made = obj(&text, &options).unwrap();
    assert_eq!(made.planes.len(), made.faces.len());
    for ((face, normal), &plane) in made.faces.iter().zip(&made.normals).zip(&made.planes) {
        let corner = made.vertices[usize::from(face[0])];
        let along: f64 = corner.iter().zip(normal).map(|(&c, &n)| f64::from(c) * f64::from(n)).sum();
        assert!((along / 65536.0 - f64::from(plane)).abs() <= 0.5, "{along} {plane}");
        // 3 from the centre, but for the sag of a face.
        let distance = f64::from(plane) * 2.0 * 2f64.powi(i32::from(made.exponent));
        assert!((2.9..3.001).contains(&distance), "{distance}");
    }

    // Nothing else is different, and by default there are none.
    let plain = obj(&text, &Options { planes: false, ..options }).unwrap();
    assert_eq!(plain, ImportedMesh { planes: Vec::new(), ..made });
    assert_eq!(
        plain.mesh_with_planes().unwrap_err(),
        MeshError::PlaneCount { faces: plain.faces.len(), planes: 0 }
    );
    assert!(plain.mesh().unwrap().planes().is_empty() && !Options::default().planes);
}

#[test]
fn planes_want_the_normals_of_faces() {
    for vertex_normals in [false, true] {
        let options = Options { normals: false, planes: true, vertex_normals, ..Options::default() };
        let error = obj(BLOCK, &options).unwrap_err();
        assert!(matches!(error.problem, Problem::Options(_)), "{error}");
        assert!(
            error.to_string().ends_with("planes belong to the normals of faces: ask for these too"),
            "{error}"
        );
    }
}

/// The offset that is written is what was subtracted, or it is not written.
#[test]
fn offsets_are_what_was_subtracted() {
    let small = "v .30001 .4 .5\nv .30601 .4 .5\nv .30001 .407 .5\nv .30001 .4 .508\n";
    let far = "v 32767.3 0 0\nv 32767.9 1 0\nv 32767.5 .5 .3\nv 32767.4 .2 .1\n";
    let plain = "v 1 2 3\nv 5 2 3\nv 1 9 3\nv 1 2 4\n";
    for (name, vertices, is_held) in [("small", small, false), ("far", far, false), ("plain", plain, true)] {
        let text = format!("{vertices}f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
        let mesh = obj(&text, &Options::default()).unwrap();
        let written = mesh.to_rust("a test").contains("pub const OFFSET");
        assert_eq!(
            (written, mesh.to_rust_mesh("M", "model.obj".as_ref(), "a test").unwrap().contains("M_OFFSET")),
            (is_held, is_held),
            "{name}"
        );
    }
}
