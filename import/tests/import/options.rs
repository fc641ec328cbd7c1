//! What can be chosen, each against its definition in `f64`.

use crate::common::{obj, position};
use pinhole_apps_support::bodies;
use pinhole_import::{Centre, Edges, ImportedMesh, Options, Warning};
use std::collections::HashSet;
use support::oracle::chain::{cross, dot, normalise};
use support::oracle::rng::Rng;
use support::solids::beside;

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

/// The angle in degrees between the normals of two faces, by their vertices.
fn angle(mesh: &ImportedMesh, faces: &[u16]) -> f64 {
    let normal = |face: u16| {
        let [a, b, c] = mesh.faces[usize::from(face)].map(|v| position(mesh, v));
        let [p, q] = [b, c].map(|to| [0, 1, 2].map(|i| to[i] - a[i]));
        normalise(cross(p, q))
    };
    dot(normal(faces[0]), normal(faces[1])).clamp(-1.0, 1.0).acos().to_degrees()
}

#[test]
fn feature_edges_are_those_where_the_surface_turns_or_ends() {
    let feature = |text: &str, degrees| {
        obj(text, &Options { edges: Edges::Feature { degrees }, ..Options::default() }).unwrap()
    };
    // The ball: every edge by its own angle, where that is not within rounding of the limit.
    let ball = ball(12, 16);
    for degrees in [5.0, 14.0, 17.0] {
        let mesh = feature(&ball, degrees);
        let edges: HashSet<_> = mesh.edges.iter().copied().collect();
        let (mut sharp, mut blunt) = (0, 0);
        for (edge, faces) in beside(&mesh.faces) {
            let turn = angle(&mesh, &faces);
            if (turn - degrees).abs() > 1e-6 {
                assert_eq!(edges.contains(&edge), turn > degrees, "{turn} {degrees}");
                *if turn > degrees { &mut sharp } else { &mut blunt } += 1;
            }
        }
        assert!(sharp > 10 && blunt > 10, "{degrees}: {sharp} {blunt}");
    }
}

/// As many of a ball's edges come first as it has features, and then all others; also with lines that no face has, and with backs.
#[test]
fn creases_come_first() {
    let mut text = ball(8, 10);
    text += "v 9 9 9\nv 9 9 8\nv 9 8 9\nf -3 -2 -1\nl 1 2\n"; // a sheet and a line
    let options = |edges, edge_faces| Options { edges, edge_faces, two_sided: true, ..Options::default() };
    for (degrees, edge_faces) in [(0.0, true), (17.0, true), (17.0, false), (180.0, true)] {
        let [all, features, sorted] =
            [Edges::All, Edges::Feature { degrees }, Edges::CreasesFirst { degrees }]
                .map(|edges| obj(&text, &options(edges, edge_faces)).unwrap());
        assert_eq!((all.creases, features.creases), (None, None));
        let list = |mesh: &ImportedMesh| -> Vec<([u16; 2], Option<[u16; 2]>)> {
            let beside = |edge: usize| mesh.edge_faces.get(edge).copied();
            mesh.edges.iter().enumerate().map(|(edge, &ends)| (ends, beside(edge))).collect()
        };
        let (features, mut others) = (list(&features), list(&all));
        others.retain(|edge| !features.contains(edge));
        assert_eq!(sorted.creases, Some(features.len()));
        assert_eq!(list(&sorted), [features, others].concat());
    }
    // The diagonal of a flat sheet, whose faces have the mean colours of their corners.
    let sheet = |blue: i32| {
        let text =
            format!("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 1 1 0 1 0 {blue}\nf 1 2 3\nf 2 4 3\n");
        obj(&text, &options(Edges::CreasesFirst { degrees: 0.0 }, true)).unwrap().creases
    };
    assert_eq!([sheet(0), sheet(1)], [Some(8), Some(10)]); // with the backs
}

#[test]
fn the_faces_beside_edges_are_all_there() {
    let options = Options { edge_faces: true, ..Options::default() };
    let mesh = obj(&ball(8, 10), &options).unwrap();
    assert_eq!(mesh.mesh().unwrap().edge_faces(), mesh.edge_faces);
    let expected = beside(&mesh.faces);
    assert_eq!(mesh.edges.len(), expected.len());
    for (edge, faces) in mesh.edges.iter().zip(&mesh.edge_faces) {
        assert_eq!(expected[edge], faces);
    }
    // An open edge has one face, and where three meet, the edge is there twice; as pinhole's own function has it.
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    let fan = obj(text, &options).unwrap();
    let edges: [[u16; 2]; 8] = fan.edges[..].try_into().unwrap();
    assert_eq!(edges[..2], [[0, 1], [0, 1]]);
    assert_eq!(fan.edge_faces, pinhole::mesh::edge_faces(&edges, &fan.faces));
    assert_eq!(fan.edge_faces[1], [2, u16::MAX]);
    // Faces of feature edges only.
    let options = Options { edges: Edges::Feature { degrees: 30.0 }, ..options };
    let mesh = obj(BLOCK, &options).unwrap();
    assert_eq!(mesh.edge_faces.len(), 12);
    let expected = beside(&mesh.faces);
    assert!(mesh.edges.iter().zip(&mesh.edge_faces).all(|(edge, beside)| expected[edge] == beside));
}

#[test]
fn vertex_normals_of_a_ball_point_outwards() {
    let options = Options { vertex_normals: true, normals: false, ..Options::default() };
    // A ball's point outwards, as well as the angles of its triangles allow.
    let mesh = obj(&ball(24, 32), &options).unwrap();
    for vertex in 0..mesh.vertices.len() {
        let outwards = position(&mesh, vertex as u16);
        let outwards = [outwards[0] - 5.0, outwards[1], outwards[2]].map(|c| c / 3.0);
        let normal = mesh.vertex_normals[vertex].map(|c| f64::from(c) / 32767.0);
        let cosine: f64 = outwards.iter().zip(normal).map(|(a, b)| a * b).sum();
        assert!(cosine > 1f64.to_radians().cos(), "{vertex}: {cosine}");
    }
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
    let expected = beside(&after.faces);
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

    // The whole ball, and a fin on the first edge of its first face: the third face of that edge is the file's last.
    let text = ball(10, 12);
    let first: Vec<&str> = text.lines().find(|line| line.starts_with('f')).unwrap().split(' ').collect();
    let text = format!("{text}v 5 9 9\nf {} {} -1\n", first[1], first[2]);
    let mesh = obj(&text, &options).unwrap();
    let crowded = mesh.warnings.iter().find(|w| matches!(w, Warning::CrowdedEdges { count: 1, .. }));
    assert_eq!(crowded.unwrap().line(), Some(text.lines().count()));
}

#[test]
fn planes_are_those_of_the_finished_mesh() {
    let options = Options { reorder: true, planes: true, ..Options::default() };
    let made = obj(BLOCK, &options).unwrap();
    let mesh = made.mesh().unwrap();
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
    assert!(plain.mesh().unwrap().planes().is_empty() && !Options::default().planes);
}

/// By the definition of `Mesh::with_planes`; and on a ball they are small.
#[test]
fn clusters_are_close_around_their_faces() {
    for step in [None, Some(1.0 / 64.0)] {
        let made = obj(&ball(24, 32), &Options { clusters: true, step, ..Options::default() }).unwrap();
        let (mesh, count) = (made.mesh().unwrap(), made.faces.len());
        assert_eq!((mesh.planes(), mesh.clusters().len()), (&made.planes[..count], count.div_ceil(32)));
        let largest = made.vertices.iter().flatten().map(|c| c.unsigned_abs()).max().unwrap();
        let unit = 32768.0 / f64::from((largest + 1).next_power_of_two());
        let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
        let mut radii = 0.0;
        for (at, &[x, y, z, radius, a, b, c, errors]) in mesh.clusters().iter().enumerate() {
            let (centre, axis) = ([x, y, z].map(f64::from), [a, b, c].map(f64::from));
            let (radius, m, e) = (f64::from(radius as u16), errors as u16 >> 8, errors as u16 & 255);
            for face in (32 * at..count).take(32) {
                let corners =
                    made.faces[face].map(|v| made.vertices[usize::from(v)].map(|c| unit * f64::from(c)));
                assert!(corners.iter().all(|corner| apart(*corner, centre) <= radius));
                let normal = made.normals[face].map(f64::from);
                assert!(apart(normal, axis) <= f64::from(m + 1) * 128.0);
                let along: f64 = normal.iter().zip(centre).map(|(n, c)| n * c / 32768.0).sum();
                let off = (along - 2.0 * f64::from(made.planes[face])).abs();
                assert!(off <= f64::from(e + 1) / 256.0 * radius + 1.0, "{off}");
            }
            assert!(m < 200 && e < 200, "{m} {e}");
            radii += radius / unit * 2f64.powi(i32::from(made.exponent));
        }
        let mean = radii / mesh.clusters().len() as f64;
        assert!(mean < 1.3, "{mean} of a ball of 3");
    }
    assert!(obj(BLOCK, &Options { clusters: true, normals: false, ..Options::default() }).is_err());
}

/// The positions of vertices in units of 2^-48, exactly.
fn positions(mesh: &ImportedMesh) -> Vec<[i128; 3]> {
    let bits = |number: f64| {
        let scaled = number * 2f64.powi(48);
        assert_eq!(scaled.fract(), 0.0);
        scaled as i128
    };
    let at = |vertex: &[i16; 3]| {
        [0, 1, 2].map(|axis| (i128::from(vertex[axis]) << (mesh.exponent + 48)) + bits(mesh.offset[axis]))
    };
    mesh.vertices.iter().map(at).collect()
}

/// Of two boxes that share the corners of a side, these have equal positions, on each of many grids.
#[test]
fn parts_of_one_step_share_their_corners() {
    let mut random = Rng::new(1);
    for case in 0..400 {
        let exponent = -(case % 26);
        let step = 2f64.powi(exponent);
        let mut steps = |most: f64| match case % 4 {
            0 => (random.unit() * most).floor(),
            _ => random.unit() * most,
        };
        // In some cases all corners lie half way between grid points.
        let low = [(); 3].map(|()| (steps(1e4) - 5e3 + 0.5) * step);
        let wide = (steps(5e3) + 1.0) * step;
        let shared = low[0] + wide;
        let part = |size: [f64; 3], low: [f64; 3]| {
            bodies::obj(&bodies::moved(&bodies::cuboid(size), |at| {
                [0, 1, 2].map(|axis| low[axis] + at[axis])
            }))
        };
        let left = part([wide; 3], low);
        let right = part([3.0 * wide, wide, wide], [shared, low[1], low[2]]);
        for centre in [Centre::Box, Centre::Origin] {
            let options = Options { step: Some(step), centre, ..Options::default() };
            let [left, right] = [&left, &right].map(|text| obj(text, &options).unwrap());
            assert_eq!([left.exponent, right.exponent], [exponent as i8; 2]);
            let (left_positions, right_positions) = (positions(&left), positions(&right));
            let both = left_positions.iter().filter(|position| right_positions.contains(position)).count();
            assert_eq!(both, 4, "{options:?}: {left_positions:?} {right_positions:?}");
            assert!(left.report.error <= step / 2.0 && right.report.error <= step / 2.0);
        }
    }
}

/// A square of 40 × 40 squares in a plane, with 3200 triangles.
fn plane() -> String {
    let mut text = String::new();
    for y in 0..=40 {
        for x in 0..=40 {
            text += &format!("v {x} {y} 3\n");
        }
    }
    for y in 0..40 {
        for x in 0..40 {
            let a = 41 * y + x + 1;
            text += &format!("f {} {} {} {}\n", a, a + 1, a + 42, a + 41);
        }
    }
    text
}

#[cfg(feature = "decimate")]
#[test]
fn a_plane_loses_triangles_and_nothing_else() {
    let options = Options { decimate: Some(200), ..Options::default() };
    let mesh = obj(&plane(), &options).unwrap();
    assert!(mesh.faces.len() <= 200 && mesh.faces.len() + mesh.report.decimated == 3200, "{:?}", mesh.report);
    assert_eq!(mesh.report.unused, 0);
    // It is still that square: its area, by the vertices, and its height.
    let step = 2f64.powi(i32::from(mesh.exponent));
    let area: f64 = mesh
        .faces
        .iter()
        .map(|face| {
            let [a, b, c] = face.map(|v| mesh.vertices[usize::from(v)].map(|c| f64::from(c) * step));
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
        })
        .sum();
    // Positions are whole numbers, and the grid holds those about the centre exactly.
    assert_eq!((area, mesh.report.error), (1600.0, 0.0));
    assert!(mesh.vertices.iter().all(|v| v[2] == 0));
    // An estimate, which counts moves within the plane a little: a hundredth of a square.
    assert!(mesh.report.decimation_error < 0.01, "{}", mesh.report.decimation_error);
}

#[cfg(feature = "decimate")]
#[test]
fn what_is_not_reduced_as_far_as_wanted_is_said_and_only_that() {
    // Sixteen triangles, each on its own: here all but four go.
    let mut text = String::new();
    for i in 0..16 {
        text += &format!("v {} 0 0\nv {} 0 0\nv {} 1 0\nf -3 -2 -1\n", 2 * i, 2 * i + 1, 2 * i);
    }
    let mesh = obj(&text, &Options { decimate: Some(4), ..Options::default() }).unwrap();
    let said = mesh.warnings.iter().any(|w| w.to_string().contains("the shape allows no fewer"));
    assert_eq!(said, mesh.faces.len() > 4, "{} {:?}", mesh.faces.len(), mesh.warnings);
}

#[cfg(feature = "decimate")]
#[test]
fn colours_are_left_out_even_if_no_triangle_can_be_taken_away() {
    // All triangles between five points: each edge has three.
    let mut text = String::from("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nv 1 1 1\n").replace('\n', " 1 0 0\n");
    for (a, b, c) in (1..6).flat_map(|a| (1..a).flat_map(move |b| (1..b).map(move |c| (a, b, c)))) {
        text += &format!("f {a} {b} {c}\n");
    }
    let mesh = obj(&text, &Options { decimate: Some(1), two_sided: true, ..Options::default() }).unwrap();
    assert_eq!((mesh.faces.len() - mesh.report.backs, mesh.report.decimated), (10, 0));
    assert_eq!(mesh.warnings, [Warning::DecimatedLess { faces: 10 }, Warning::DecimatedMaterials]);
    assert!(mesh.face_colors.is_empty());
}

#[cfg(feature = "decimate")]
#[test]
fn none_left_is_said_of_the_number_and_not_of_the_model() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let error = obj(text, &Options { decimate: Some(1), ..Options::default() }).unwrap_err().to_string();
    assert!(error.ends_with(": decimation to so few triangles leaves none: allow more"), "{error}");
}

#[cfg(not(feature = "decimate"))]
#[test]
fn a_build_without_it_says_how_to_get_it() {
    let options = Options { decimate: Some(200), ..Options::default() };
    let error = obj(&plane(), &options).unwrap_err().to_string();
    assert!(error.contains("install it with the feature `decimate`, which needs a C++ compiler"), "{error}");
}
