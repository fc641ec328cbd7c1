//! A closed surface stays closed, also where faces lie on a line, and its picture has no holes.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::{Gray8, GrayColor};
use pinhole::{prelude::*, Angle};
use pinhole_import::{import_bytes, quantise, ImportedMesh, Options, Triangles};
use std::collections::HashMap;
use support::oracle::chain::{cross, length};
use support::oracle::rng::Rng;

/// A box of twelve triangles, turned about an axis by an angle in radians.
fn turned_box(size: [f64; 3], angle: f64) -> Triangles {
    let (sin, cos) = angle.sin_cos();
    let position = |i: usize| {
        let [x, y, z] = [0, 1, 2].map(|axis| size[axis] * if i >> axis & 1 == 1 { 0.5 } else { -0.5 });
        [x * cos - y * sin, x * sin + y * cos, z]
    };
    let sides = [[4, 5, 7, 6], [1, 0, 2, 3], [5, 1, 3, 7], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4]];
    let faces = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Triangles { positions: (0..8).map(position).collect(), faces }
}

/// Cuts a face in two at a point of one of its sides, and closes the gap to its neighbour by a face on a line. The neighbour may
/// be such a face itself.
fn add_sliver(solid: &mut Triangles, random: &mut Rng) {
    let (face, side) = (random.below(solid.faces.len()), random.below(3));
    let [a, b, c] = [0, 1, 2].map(|i| solid.faces[face][(side + i) % 3]);
    let along = [0.5, 0.25, random.unit()][random.below(3)];
    let [from, to] = [a, b].map(|vertex| solid.positions[vertex]);
    let middle = solid.positions.len();
    solid.positions.push([0, 1, 2].map(|axis| from[axis] * (1.0 - along) + to[axis] * along));
    solid.faces[face] = [a, middle, c];
    solid.faces.extend([[middle, b, c], [a, b, middle]]);
}

/// Solids with slivers, of which some lie exactly on a line and some only nearly so.
fn solids() -> impl Iterator<Item = Triangles> {
    let mut random = Rng::new(7);
    (0..400).map(move |number| {
        let size = [0; 3].map(|_| (1.0 + 63.0 * random.unit()).round());
        let angle = if number % 2 == 0 { 0.0 } else { random.unit() };
        let mut solid = turned_box(size, angle);
        // On the sides of a box that is not turned, some of the slivers lie on a line on the grid, too.
        for _ in 0..1 + random.below(60) {
            add_sliver(&mut solid, &mut random);
        }
        solid
    })
}

/// How much more often faces run along sides in one direction than in the other: 0 if the surface is closed.
fn unbalanced(faces: &[[u16; 3]]) -> i32 {
    let mut sides = HashMap::<[u16; 2], i32>::new();
    for &[a, b, c] in faces {
        for [a, b] in [[a, b], [b, c], [c, a]] {
            *sides.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
    }
    sides.values().map(|sum| sum.abs()).sum()
}

fn area(corners: [[f64; 3]; 3]) -> f64 {
    let [u, v] = [1, 2].map(|to| [0, 1, 2].map(|axis| corners[to][axis] - corners[0][axis]));
    length(cross(u, v)) / 2.0
}

fn area_of(mesh: &ImportedMesh) -> f64 {
    let step = 2f64.powi(i32::from(mesh.exponent));
    let corner = |vertex: u16| mesh.vertices[usize::from(vertex)].map(|c| f64::from(c) * step);
    mesh.faces.iter().map(|face| area(face.map(corner))).sum()
}

#[test]
fn closed_surfaces_stay_closed() {
    let mut dropped = 0;
    for (number, solid) in solids().enumerate() {
        let mesh = quantise(&solid).unwrap();
        assert_eq!(unbalanced(&mesh.faces), 0, "solid {number}");
        assert_eq!(mesh.topology().open, 0, "solid {number}");
        assert!(mesh.normals.iter().all(|normal| *normal != [0; 3]));
        let wanted: f64 =
            solid.faces.iter().map(|face| area(face.map(|vertex| solid.positions[vertex]))).sum();
        assert!((area_of(&mesh) / wanted - 1.0).abs() < 1e-3, "solid {number}: {} {wanted}", area_of(&mesh));
        dropped += mesh.report.degenerate;
    }
    assert!(dropped > 5000, "{dropped}");
}

/// A block with a cavity under its upper face that is thinner than a step of the grid: the cavity's floor becomes the upper face a
/// second time, and its ceiling the back of both.
#[test]
fn faces_that_rounding_makes_equal_do_not_open_a_surface() {
    let mut solid = turned_box([2.0; 3], 0.0);
    let cavity = turned_box([2.0, 2.0, 1e-6], 0.0);
    solid.positions.extend(cavity.positions.iter().map(|&[x, y, z]| [x, y, z + 1.0 - 2e-6]));
    solid.faces.extend(cavity.faces.iter().map(|&[a, b, c]| [a + 8, c + 8, b + 8]));
    let mesh = quantise(&solid).unwrap();
    assert_eq!((mesh.faces.len(), mesh.report.duplicate, unbalanced(&mesh.faces)), (16, 0, 0));
    // Two equal blocks, less than a step apart, are one block on the grid.
    let mut twice = turned_box([2.0; 3], 0.0);
    twice.positions.extend(twice.positions.clone().iter().map(|p| p.map(|c| c + 1e-6)));
    twice.faces.extend(twice.faces.clone().iter().map(|face| face.map(|vertex| vertex + 8)));
    let mesh = quantise(&twice).unwrap();
    assert_eq!((mesh.faces.len(), mesh.report.duplicate, unbalanced(&mesh.faces)), (12, 12, 0));
}

/// A thousand faces on one side of a thousand faces on a line, each of which has another corner.
#[test]
fn no_file_has_its_faces_cut_to_pieces_without_number() {
    let mut fan = Triangles { positions: vec![[0.0; 3], [2000.0, 0.0, 0.0]], faces: Vec::new() };
    for i in 1..1000 {
        let first = fan.positions.len();
        let x = f64::from(i);
        fan.positions.extend([[x, 0.0, 0.0], [x, 1000.0, 9.0], [x, x, 1000.0]]);
        fan.faces.extend([[0, first, 1], [first, 0, first + 1], [1, 0, first + 2]]);
    }
    let report = quantise(&fan).unwrap().report;
    assert_eq!((report.degenerate, report.cut), (999, 0));
}

const SIZE: Size = Size::new(120, 90);

/// The pixels between the first and the last drawn one of a row that are not drawn: none, if the solid is convex.
fn holes(mesh: &Mesh<'_>, extent: f64, yaw: Angle, by_planes: bool) -> usize {
    let number = |v: f64| Scalar::try_from(v).unwrap();
    let viewport = Viewport::new(Point::zero(), SIZE).unwrap();
    let view = ViewTransform::look_at(
        Point3::new(number(0.3 * extent), number(0.7 * extent), number(1.6 * extent)),
        Point3::from_ints(0, 0, 0),
        Vector3::from_ints(0, 1, 0),
    );
    let lens = Projection::perspective(Angle::degrees(60), SIZE, number(0.1 * extent), number(4.0 * extent));
    let camera = Camera::new(&view.unwrap(), &lens.unwrap(), &viewport);
    let mut drawn = vec![Gray8::BLACK; (SIZE.width * SIZE.height) as usize];
    let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
    let instance = camera.place(mesh, &Affine::rotation_y(yaw));
    let mut picture = Picture::new(&mut drawn, SIZE).unwrap();
    let faces = instance.faces(|_| Gray8::WHITE).cached(&mut cache);
    let Ok(_) = match by_planes {
        true => faces.culled_by_planes().draw(&mut picture.pixels()),
        false => faces.draw(&mut picture.pixels()),
    };
    let rows = drawn.chunks(SIZE.width as usize);
    let holes = rows.map(|row| {
        let is_drawn = |pixel: &Gray8| *pixel == Gray8::WHITE;
        let first = row.iter().position(is_drawn).unwrap_or(row.len());
        let last = row.iter().rposition(is_drawn).unwrap_or(0);
        (first..last).filter(|&x| !is_drawn(&row[x])).count()
    });
    holes.sum()
}

/// A box whose upper face is a square on one side of its diagonal and a fan on the other.
#[test]
fn culling_by_planes_opens_nothing_either() {
    const CORNERS: usize = 62;
    let mut solid = turned_box([20.0, 4.0, 20.0], 0.0);
    let upper =
        solid.faces.iter().position(|face| face.iter().all(|&i| solid.positions[i][1] > 0.0)).unwrap();
    let [a, b, c] = solid.faces[upper];
    let mut last = a;
    for i in 1..=CORNERS {
        solid.positions.push([0, 1, 2].map(|axis| {
            let [from, to] = [a, c].map(|vertex| solid.positions[vertex][axis]);
            from + (to - from) * i as f64 / 64.0
        }));
        let next = solid.positions.len() - 1;
        solid.faces.extend([[last, b, next], [a, last, next]]);
        last = next;
    }
    solid.faces[upper] = [last, b, c];
    // A face on a line with all of its neighbours on the fan's side.
    solid.faces.retain(|&[p, q, _]| p != q);
    solid.faces.push([a, last, c]);
    let mut mesh = quantise(&solid).unwrap();
    assert_eq!((mesh.report.degenerate, mesh.topology().open), (CORNERS, 0));
    mesh.planes = (0..mesh.faces.len()).map(|face| mesh.mesh().unwrap().face_plane(face)).collect();
    for frame in 0..120 {
        let yaw = Angle::degrees(3 * frame);
        for by_planes in [false, true] {
            assert_eq!(holes(&mesh.mesh().unwrap(), 20.0, yaw, by_planes), 0, "{frame}, planes: {by_planes}");
        }
    }
}

#[test]
fn pieces_of_a_face_have_its_texture() {
    // A square and a triangle below it, with a point of the side between them that only the triangle has. All texture coordinates
    // are the position over 4.
    let text = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 0 0\nv 0 -4 0\n\
        vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.25 0\nvt 0 -1\n\
        f 1/1 2/2 3/3 4/4\nf 5/5 1/1 6/6\nf 2/2 5/5 6/6\nf 2/2 1/1 5/5\n";
    for (flip, fix_winding, two_sided) in
        [(false, false, false), (true, false, false), (false, true, true), (true, true, true)]
    {
        let options = Options { flip, fix_winding, two_sided, ..Options::default() };
        let mesh = import_bytes(text.into(), "square.obj".as_ref(), &[], &options).unwrap();
        assert_eq!((mesh.report.degenerate, mesh.report.cut), (1, 1));
        assert_eq!(mesh.faces.len(), if two_sided { 10 } else { 5 });
        let unit = 2f64.powi(i32::from(mesh.texture_exponent));
        let step = 2f64.powi(i32::from(mesh.exponent));
        for (face, coords) in mesh.faces.iter().zip(&mesh.texture_faces) {
            for (&vertex, &coord) in face.iter().zip(coords) {
                let at = |axis: usize| {
                    f64::from(mesh.vertices[usize::from(vertex)][axis]) * step + mesh.offset[axis]
                };
                let [u, v] = mesh.texture_coords[usize::from(coord)].map(|c| f64::from(c) * unit);
                assert_eq!([4.0 * u, 4.0 * (1.0 - v)], [at(0), at(1)], "{options:?}");
            }
        }
    }
}
