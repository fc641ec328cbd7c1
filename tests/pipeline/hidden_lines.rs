//! Hidden-line removal, with one bit per pixel, against an oracle that compares the edge with every face.

use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::BinaryColor;
use pinhole::{mesh::edge_faces, prelude::*};
use support::bridge;
use support::bridge::pair::{CameraBits, ModelBits, Step, ViewBits, ONE};
use support::bridge::ways::{bands, screen};
use support::oracle::hidden::{self, Vertex};
use support::oracle::line;
use support::oracle::rng::Rng;
use support::solids::{self, Solid};

/// The drawn part of each edge.
#[derive(Debug, Default)]
struct Score {
    /// Edges of which a pixel is in sight, and the sum of the shares of these pixels that are not drawn.
    edges: u32,
    missing: f64,
    /// Edges that lack more than a tenth of their pixels in sight.
    poor: u32,
    /// Drawn pixels, and those that no edge in sight passes, nor any pixel around them.
    drawn: u32,
    hidden: u32,
}

impl Score {
    fn add(&mut self, other: &Self) {
        self.edges += other.edges;
        self.missing += other.missing;
        self.poor += other.poor;
        self.drawn += other.drawn;
        self.hidden += other.hidden;
    }
}

const WIDTH: u32 = 240;
const HEIGHT: u32 = 240;

/// The hidden lines of a mesh, one bit a pixel, in bands of this many rows.
fn in_bands(instance: &MeshInstance<'_>, rows: u32) -> Vec<BinaryColor> {
    let mesh = instance.mesh();
    let mut corners = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
    let projected = instance.transform_depth(&mut corners);
    let (mut bin_storage, mut more) = (vec![0; mesh.face_bins_len()], vec![0; mesh.edge_bins_len()]);
    let mut faces = projected.bin_faces(&mut bin_storage).expect("room");
    let mut edges = projected.bin_edges(&mut more).expect("room");
    let picture =
        bands(bridge::rectangle(0, 0, WIDTH, HEIGHT), BinaryColor::Off, rows, &mut |band, depth| {
            faces.depth_only(depth);
            let Ok(()) = edges.hidden_line(BinaryColor::On, &mut band.depth_tested(depth));
        });
    assert_eq!(faces.statistics().clipped + faces.statistics().outside, 0);
    picture
}

/// Draws a solid and judges each edge. `is_convex`: an edge with a front face beside it is in sight, and no other.
fn score(solid: &Solid, is_convex: bool, camera: &CameraBits, model: &ModelBits) -> Score {
    let beside = solid.edge_faces();
    let mesh = Mesh::new(&solid.vertices, solid.exponent, &solid.faces)
        .and_then(|m| m.with_edges(&solid.edges))
        .and_then(|m| m.with_edge_faces(&beside))
        .expect("a mesh");
    let (library, model) = (camera.library(), model.library());
    let instance = library.place(&mesh, &model);
    let picture = in_bands(&instance, 16);
    // The library finds the faces beside an edge itself, in all of its faces.
    let unlisted = Mesh::new(&solid.vertices, solid.exponent, &solid.faces)
        .and_then(|m| m.with_edges(&solid.edges))
        .expect("a mesh");
    assert!(in_bands(&library.place(&unlisted, &model), HEIGHT) == picture);
    let exact = |i| instance.project_unsnapped(i).expect("in view").map(|v| v as f64 / 4_294_967_296.0);
    let vertices: Vec<Vertex> = (0..solid.vertices.len()).map(exact).collect();
    let front = hidden::front_faces(&solid.faces, &vertices);
    let seen = solid.edges.iter().map(|&edge| {
        let pixels = edge_pixels(&instance, edge);
        let seen = match is_convex {
            true => vec![front.iter().any(|face| face.has_edge(edge)); pixels.len()],
            false => hidden::in_sight(edge, &pixels, &vertices, &front),
        };
        (pixels, seen)
    });
    let seen: Vec<_> = seen.collect();
    let at = |(x, y): (i64, i64)| (y * i64::from(WIDTH) + x) as usize;
    let mut score = Score::default();
    let (mut of_edges, mut in_sight) = (vec![false; picture.len()], vec![false; picture.len()]);
    for (pixels, seen) in &seen {
        // Next to a pixel where the edge is hidden, either may be drawn.
        let is_sure =
            |&i: &usize| seen[i.saturating_sub(1)..(i + 2).min(seen.len())].iter().all(|&seen| seen);
        let sure: Vec<_> = (0..seen.len()).filter(is_sure).map(|i| at(pixels[i])).collect();
        let missing = sure.iter().filter(|&&at| !picture[at].is_on()).count();
        score.edges += u32::from(!sure.is_empty());
        score.missing += missing as f64 / sure.len().max(1) as f64;
        score.poor += u32::from(missing * 10 > sure.len());
        for (&(x, y), &seen) in pixels.iter().zip(seen) {
            of_edges[at((x, y))] = true;
            for around in (0..9).map(|i| (x + i % 3 - 1, y + i / 3 - 1)).filter(|_| seen) {
                in_sight[at(around)] = true;
            }
        }
    }
    for (at, _) in picture.iter().enumerate().filter(|(_, color)| color.is_on()) {
        assert!(of_edges[at], "only pixels of edges");
        score.drawn += 1;
        score.hidden += u32::from(!in_sight[at]);
    }
    score
}

fn camera() -> CameraBits {
    CameraBits {
        view: ViewBits::LookAt([0, 0, 11 * ONE], [0; 3], [0, ONE, 0]),
        ..CameraBits::perspective(1 << 29, (WIDTH, HEIGHT), ONE, 30 * ONE)
    }
}

fn any_turn(rng: &mut Rng) -> ModelBits {
    ModelBits(vec![Step::Y(rng.next() as u32), Step::X(rng.next() as u32)])
}

/// Every pixel of every edge with a front face beside it, however little of that face shows.
#[test]
fn all_edges_of_a_convex_object_are_drawn_whole() {
    let mut rng = Rng::new(11);
    let mut all = Score::default();
    for turn in 0..300 {
        let corners = 5 + rng.below(8);
        let solid = match turn % 3 {
            0 => solids::block(&mut rng),
            1 => solids::hull(&mut rng, corners),
            _ => solids::prism(&mut rng),
        };
        let score = score(&solid, true, &camera(), &any_turn(&mut rng));
        assert!(score.missing == 0.0 && score.hidden == 0, "{turn}: {score:?}");
        all.add(&score);
    }
    assert!(all.edges > 4_000, "{all:?}");
}

/// The documented bounds, edge by edge.
#[test]
fn edges_in_sight_are_drawn_and_hidden_ones_are_not() {
    let mut rng = Rng::new(5);
    let mut all = Score::default();
    for turn in 0..10 {
        let solids = [
            solids::torus(25, 20),
            solids::torus(9, 5),
            solids::gear(),
            solids::pot(),
            solids::village(&mut rng),
            solids::splinters(&mut rng),
            solids::crossing(&mut rng),
        ];
        for (number, solid) in solids.iter().enumerate() {
            let score = score(solid, false, &camera(), &any_turn(&mut rng));
            println!("{number} {turn}: {score:?}");
            all.add(&score);
        }
    }
    println!("{all:?}");
    let drawn = 1.0 - all.missing / f64::from(all.edges);
    assert!(
        drawn >= 0.9995 && all.poor * 1_000 <= all.edges && all.hidden * 2_000 <= all.drawn,
        "{drawn} {all:?}"
    );
}

/// An edge of a face that the eye sees almost edge-on, from 0.09 units above its plane.
#[test]
fn an_edge_of_a_face_seen_edge_on_is_drawn_whole() {
    let solid = solids::blocks(&[([0.0; 3], [38.0, 41.0, 84.0])]);
    let mesh = Mesh::new(&solid.vertices, -6, &solid.faces)
        .and_then(|m| m.with_edges(&solid.edges))
        .expect("a mesh");
    let at = |yaw: f64, pitch: f64, distance: f64| {
        let [(s, c), (t, d)] = [yaw, pitch].map(|angle| angle.to_radians().sin_cos());
        [s * d, t, c * d].map(|v| (v * distance * f64::from(ONE)).round() as i32)
    };
    let mut edge_on = 0;
    // All around it, and in small steps past the plane of the lower face.
    let coarse = (-900..900).map(|step| f64::from(step) / 100.0);
    for pitch in coarse.chain((0..1_800).map(|step| f64::from(step) / 5_000.0 - 6.31)) {
        let camera = CameraBits {
            view: ViewBits::LookAt(at(324.37, pitch, 6.0), [0; 3], [0, ONE, 0]),
            ..CameraBits::perspective(1 << 29, (160, 120), ONE, 20 * ONE)
        };
        let library = camera.library();
        let instance = library.place(&mesh, &ModelBits::default().library());
        let (target, _) = screen(bridge::rectangle(0, 0, 160, 120), &mut |target, depth| {
            instance.depth_only(&mut [], depth);
            let Ok(_) = instance.edges(|_| BinaryColor::On).hidden_line(&mut target.depth_tested(depth));
        });
        let exact = |i| instance.project_unsnapped(i).expect("in view").map(|v| v as f64 / 4_294_967_296.0);
        let vertices: Vec<Vertex> = (0..8).map(exact).collect();
        let front = hidden::front_faces(&solid.faces, &vertices);
        for &edge in solid.edges.iter().filter(|&&edge| front.iter().any(|face| face.has_edge(edge))) {
            let pixels = edge_pixels(&instance, edge);
            let is_drawn = |&(x, y): &(i64, i64)| target.at(Point::new(x as i32, y as i32)).is_some();
            assert!(pixels.iter().all(is_drawn), "pitch {pitch}, {edge:?}");
            edge_on += 1;
        }
    }
    assert!(edge_on > 3_600 * 6, "{edge_on}");
}

/// Four faces at one edge, which no other face hides: its pixels are drawn in all views, whether the mesh lists the faces of edges
/// or not.
#[test]
fn an_edge_of_four_faces_is_drawn_whole() {
    let (vertices, faces) = blades(&[0.0, 90.0, 180.0, 276.0], 0);
    let faces: Vec<_> = faces.into_iter().step_by(2).collect();
    let beside = edge_faces(&[[0, 1]], &faces);
    let plain = Mesh::new(&vertices, -13, &faces).and_then(|m| m.with_edges(&[[0, 1]])).expect("a mesh");
    let listed = plain.with_edge_faces(&beside).expect("two faces");
    let mut rng = Rng::new(3);
    for view in 0..72 {
        let model =
            ModelBits(vec![Step::Y(view << 26 | rng.bits() >> 6), Step::X(rng.bits() >> 4)]).library();
        for mesh in [&plain, &listed] {
            let library = camera().library();
            let instance = library.place(mesh, &model).with_cull(Cull::None);
            let pixels = edge_pixels(&instance, [0, 1]);
            let drawn = in_bands(&instance, 1).iter().filter(|color| color.is_on()).count();
            assert_eq!(drawn, pixels.len(), "view {view}");
        }
    }
}

/// An axis and blades about it, each of two faces: back faces are culled.
fn blades(degrees: &[f64], rise: i16) -> (Vec<[i16; 3]>, Vec<[u16; 3]>) {
    let (mut vertices, mut faces) = (vec![[0, -9_000, 0], [0, 9_000, 0]], Vec::new());
    for (i, degrees) in (0..).zip(degrees) {
        let (s, c) = degrees.to_radians().sin_cos();
        vertices.push([(12_000.0 * c) as i16, rise * i, (12_000.0 * s) as i16]);
        faces.extend([[0, 1, i as u16 + 2], [1, 0, i as u16 + 2]]);
    }
    (vertices, faces)
}

/// The pixels of an edge in view.
fn edge_pixels(instance: &MeshInstance<'_>, edge: [u16; 2]) -> Vec<(i64, i64)> {
    let [a, b] = edge.map(|i| {
        let pixel = Point::from(instance.project(i.into()).expect("in view").point);
        (i64::from(pixel.x), i64::from(pixel.y))
    });
    line::pixels(a, b)
}

/// Seven blades about one axis, which is listed once for every two of their faces, or once with a request to search.
#[test]
fn an_edge_of_many_faces_is_drawn_if_any_of_them_shows_it() {
    let (vertices, faces) = blades(&core::array::from_fn::<_, 7, _>(|i| 360.0 * i as f64 / 7.0 + 11.5), 500);
    let mut blades = Solid::new(vertices, -13, faces);
    let axis = [0, 1];
    blades.edges.extend([axis; 6]); // fourteen faces
    blades.edges.sort_unstable();
    let mut all = Score::default();
    let mut rng = Rng::new(9);
    for _ in 0..8 {
        let model = ModelBits(vec![Step::Y(rng.next() as u32), Step::X(rng.next() as u32 >> 4)]);
        let score = score(&blades, false, &camera(), &model);
        println!("{score:?}");
        all.add(&score);
    }
    assert!(all.edges > 80 && all.missing * 1_000.0 <= f64::from(all.edges) && all.hidden == 0, "{all:?}");
}

/// The index that means "no face" is no face in a mesh that has a face of this number either: the wall hides the edge
/// behind it.
#[test]
fn an_edge_without_faces_stays_so_in_large_meshes() {
    let vertices = [[-4, -4, 0], [4, -4, 0], [4, 4, 0], [-4, 4, 0], [-2, 0, -2], [2, 1, -2]];
    let (edges, beside) = ([[4, 5]], [[Mesh::<i16>::NO_FACE; 2]]);
    let camera = CameraBits {
        view: ViewBits::LookAt([0, 0, 8 * ONE], [0; 3], [0, ONE, 0]),
        ..CameraBits::perspective(1 << 30, (64, 64), ONE, 20 * ONE)
    }
    .library();
    let model = ModelBits::default().library();
    for count in [2, 65_535, 65_536, 65_537] {
        // Face 65535 is one of the wall's, if there is one.
        let mut faces = vec![[0, 0, 0]; count];
        let last = (count - 1).min(65_535);
        (faces[last - 1], faces[last]) = ([0, 1, 2], [0, 2, 3]);
        let mesh = Mesh::new(&vertices, 0, &faces)
            .and_then(|m| m.with_edges(&edges))
            .and_then(|m| m.with_edge_faces(&beside))
            .expect("a mesh");
        let instance = camera.place(&mesh, &model);
        let mut drawn = 0;
        let (target, _) = screen(bridge::rectangle(0, 0, 64, 64), &mut |target, depth| {
            instance.depth_only(&mut [], depth);
            let Ok(statistics) =
                instance.edges(|_| BinaryColor::On).hidden_line(&mut target.depth_tested(depth));
            drawn = statistics.drawn;
        });
        assert_eq!((drawn, target.drawn().count()), (1, 0), "{count} faces");
    }
}

/// Faces that the near plane cuts to several triangles: an edge is drawn where it is as near as the stored depth, and where
/// the visible face is adjacent to it, whichever of its triangles that is. Edges and faces drawn one by one give both. Few other
/// pixels are drawn: those that a plane reaches beyond its face.
#[test]
fn hidden_lines_draw_the_edges_of_clipped_faces() {
    const SIDE: u32 = 64;
    let area = bridge::rectangle(0, 0, SIDE, SIDE);
    let mut rng = Rng::new(0x4c);
    let (mut cut, mut by_face, mut beyond, mut drawn) = (0, 0u32, 0u32, 0u32);
    for round in 0..200 {
        let solid = if round % 2 == 0 { solids::splinters(&mut rng) } else { solids::cube() };
        let solid = Solid::new(solid.vertices, solid.exponent, solid.faces);
        let whole = Mesh::new(&solid.vertices, solid.exponent, &solid.faces).expect("a mesh");
        let eye = rng.direction().map(|c| (c * rng.real(1.5, 3.0) * f64::from(ONE)) as i32);
        let to = [0; 3].map(|_| rng.int(-i64::from(ONE), i64::from(ONE)) as i32);
        let camera = CameraBits {
            view: ViewBits::LookAt(eye, to, [0, ONE, ONE / 7]),
            ..CameraBits::perspective(1 << 30, (SIDE, SIDE), ONE, 20 * ONE)
        }
        .library();
        let model = ModelBits(vec![Step::X(rng.bits()), Step::Y(rng.bits())]).library();
        let depths_of = |mesh: &Mesh<'_>, cut: &mut u32| {
            let (_, depths) = screen::<BinaryColor>(area, &mut |_, depth| {
                *cut += camera.place(mesh, &model).depth_only(&mut [], depth).clipped;
            });
            depths
        };
        let alone: Vec<Vec<u16>> = (solid.faces.iter())
            .map(|&face| {
                depths_of(&Mesh::new(&solid.vertices, solid.exponent, &[face]).expect("a face"), &mut cut)
            })
            .collect();
        let held = depths_of(&whole, &mut 0);
        for (edge, pair) in solid.edges.iter().zip(&solid.edge_faces()) {
            let (edges, beside) = ([*edge], [*pair]);
            let unlisted = whole.with_edges(&edges).expect("an edge");
            let listed = unlisted.with_edge_faces(&beside).expect("two faces");
            let (line, own) = screen(area, &mut |target, depth| {
                let instance = camera.place(&listed, &model);
                let Ok(_) = instance.edges(|_| BinaryColor::On).draw(&mut target.depth_tested(depth));
            });
            let [target, found] = [&listed, &unlisted].map(|mesh| {
                let (target, depths) = screen(area, &mut |target, depth| {
                    camera.place(&whole, &model).depth_only(&mut [], depth);
                    let Ok(_) = camera
                        .place(mesh, &model)
                        .edges(|_| BinaryColor::On)
                        .hidden_line(&mut target.depth_tested(depth));
                });
                assert_eq!(depths, held, "depth is looked at only");
                target
            });
            assert_eq!(found, target, "faces that are found, not listed: round {round}, {edge:?}");
            for at in (0..held.len()).filter(|&at| line.pixels[at].is_some()) {
                let (is_drawn, nearer) = (target.pixels[at].is_some(), own[at] <= held[at]);
                let is_face =
                    |&face: &u16| alone.get(usize::from(face)).is_some_and(|face| face[at] == held[at]);
                let face = held[at] != DepthBuffer::NOTHING && pair.iter().any(is_face);
                assert!(is_drawn || !(nearer || face), "round {round}, {edge:?}: pixel {at} is missing");
                drawn += u32::from(is_drawn);
                by_face += u32::from(!nearer && face);
                beyond += u32::from(is_drawn && !nearer && !face);
            }
            assert!(target.drawn().all(|(at, _)| line.at(at).is_some()), "beside the line");
        }
    }
    println!("{cut} faces cut; of {drawn} pixels {by_face} by a face, {beyond} beyond it");
    assert!(cut > 1000 && by_face > 1000 && beyond * 50 < drawn, "{cut} {by_face} {beyond} {drawn}");
}
