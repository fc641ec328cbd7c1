//! Two cores draw the bands of meshes that the near plane and the guard band cut: solid, with depth, their edges and their
//! visible lines. Random scenes are in `properties/two_cores.rs`; that all types can be sent to another core, in `format.rs`.

use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use embedded_graphics_core::prelude::PointsIter;
use pinhole::{
    edge_faces, BinError, BinnedScene, Cull, DepthBuffer, Frame, Mesh, MeshInstance, Object, ProjectError,
    ScreenVertex, Statistics,
};
use std::thread;
use support::bridge::draw::{cube_camera, room_faces, CUBE, CUBE_EDGES};
use support::bridge::pair::{ModelBits, ViewBits, ONE};
use support::bridge::rectangle;
use support::oracle::target::Recorder;

const SIZE: u32 = 64;
const ROWS: u32 = 16;
const STRIP: usize = (SIZE * ROWS) as usize;
const LINE: Gray8 = Gray8::new(250);

fn colour(face: usize) -> Gray8 {
    Gray8::new(face as u8 + 1)
}

#[derive(Clone, Copy, Debug)]
enum Way {
    Solid,
    Depth,
    Edges,
    HiddenLines,
}

/// In one piece, by the immediate functions.
fn whole(instance: &MeshInstance<'_>, way: Way) -> Vec<u8> {
    let (area, mut storage) = (rectangle(0, 0, SIZE, SIZE), vec![0; (SIZE * SIZE) as usize]);
    let (mut target, mut cache) = (Recorder::new(area), [ScreenVertex::EMPTY; 8]);
    let mut depth = DepthBuffer::new(area, &mut storage).expect("storage");
    match way {
        Way::Solid => instance.solid(colour, &mut cache, &mut target),
        Way::Depth => instance.depth_tested(colour, &mut cache, &mut depth, &mut target),
        Way::Edges => instance.wireframe(LINE, &mut cache, &mut target),
        Way::HiddenLines => {
            instance.depth_only(&mut cache, &mut depth);
            instance.hidden_line(LINE, &mut cache, &mut depth, &mut target)
        }
    }
    .expect("no error");
    area.points().map(|p| target.colour(p.x, p.y).map_or(0, |color| color.luma())).collect()
}

/// What the bands of one core show, one after the other: those whose bit in `bands` is set.
fn draw(bands: u32, mut draw_band: impl FnMut(&mut pinhole::Band<'_, Gray8>)) -> Vec<(u32, Vec<u8>)> {
    let frame = Frame::new(rectangle(0, 0, SIZE, SIZE), Gray8::BLACK);
    let mut strip = [0; STRIP];
    let own = (0..SIZE / ROWS).filter(|band| bands >> band & 1 != 0);
    own.map(|index| {
        let mut band = frame.nth_band(index, &mut strip).expect("a row").expect("a band");
        draw_band(&mut band);
        (index, band.bytes().to_vec())
    })
    .collect()
}

/// Two threads transform half of the vertices each and draw the bands of `assignment`: bits that are set are those of the first.
fn by_two_cores(instance: &MeshInstance<'_>, way: Way, assignment: u32) -> (Vec<u8>, Statistics) {
    let (mut cache, mut bins, mut edge_bins) = ([ScreenVertex::EMPTY; 8], [0; 32], [0; 32]);
    let (mut cursor, mut edge_cursor) = ([0; 1], [0; 1]);
    macro_rules! transform {
        ($split:expr) => {{
            let mut split = $split;
            let halves = split.halves();
            thread::scope(|scope| drop(halves.map(|half| scope.spawn(|| half.transform()))));
            split.finish()
        }};
    }
    macro_rules! both {
        ($forks:expr, |$own:ident, $band:ident| $draw:expr) => {
            thread::scope(|scope| {
                let cores = [assignment, !assignment];
                let mut cores = cores.into_iter().zip($forks).map(|(bands, mut $own)| {
                    scope.spawn(move || draw(bands, |$band: &mut pinhole::Band<'_, Gray8>| $draw))
                });
                let cores = [cores.next(), cores.next()];
                cores
                    .into_iter()
                    .flatten()
                    .flat_map(|core| core.join().expect("no panic"))
                    .collect::<Vec<_>>()
            })
        };
    }
    let (mut drawn, statistics) = match way {
        Way::Solid => {
            let mut faces =
                transform!(instance.split_transform(&mut cache)).bin_faces(&mut bins).expect("room");
            let forks = faces.fork(&mut cursor).expect("room");
            let drawn = both!(forks, |faces, band| {
                let Ok(()) = faces.solid(colour, &mut band.pixels());
            });
            (drawn, faces.statistics())
        }
        Way::Depth => {
            let transformed = transform!(instance.split_transform_depth(&mut cache));
            let mut faces = transformed.bin_faces(&mut bins).expect("room");
            let forks = faces.fork(&mut cursor).expect("room");
            let drawn = both!(forks, |faces, band| {
                let mut storage = [0; STRIP];
                let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
                let Ok(()) = faces.depth_tested(colour, &mut depth, &mut band.pixels());
            });
            (drawn, faces.statistics())
        }
        Way::Edges => {
            let mut edges =
                transform!(instance.split_transform(&mut cache)).bin_edges(&mut bins).expect("room");
            let forks = edges.fork(&mut cursor).expect("room");
            let drawn = both!(forks, |edges, band| {
                let Ok(()) = edges.draw(LINE, &mut band.pixels());
            });
            (drawn, edges.statistics())
        }
        Way::HiddenLines => {
            let transformed = transform!(instance.split_transform_depth(&mut cache));
            let mut faces = transformed.bin_faces(&mut bins).expect("room");
            let mut edges = transformed.bin_edges(&mut edge_bins).expect("room");
            let faces_of_cores = faces.fork(&mut cursor).expect("room").into_iter();
            let forks = faces_of_cores.zip(edges.fork(&mut edge_cursor).expect("room"));
            let drawn = both!(forks, |own, band| {
                let (faces, edges) = &mut own;
                let mut storage = [0; STRIP];
                let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
                faces.depth_only(&mut depth);
                let Ok(()) = edges.hidden_line(LINE, &mut depth, &mut band.pixels());
            });
            (drawn, edges.statistics())
        }
    };
    drawn.sort();
    (drawn.into_iter().flat_map(|(_, bytes)| bytes).collect(), statistics)
}

fn every_assignment(instance: &MeshInstance<'_>) {
    for way in [Way::Solid, Way::Depth, Way::Edges, Way::HiddenLines] {
        let whole = whole(instance, way);
        assert!(whole.iter().filter(|&&luma| luma != 0).count() > 60, "{way:?}: hardly anything is seen");
        for assignment in 0..1 << (SIZE / ROWS) {
            let (picture, statistics) = by_two_cores(instance, way, assignment);
            assert!(statistics.clipped > 0, "{way:?}");
            assert!(picture == whole, "{way:?}, bands {assignment:04b}");
        }
    }
}

/// Seen from inside: the near plane cuts walls and their edges in every band.
#[test]
fn a_room_that_the_near_plane_cuts_is_complete() {
    let faces = room_faces();
    let beside = edge_faces(&CUBE_EDGES, &faces);
    let mesh = Mesh::new(&CUBE, 1, &faces).and_then(|mesh| mesh.with_edges(&CUBE_EDGES));
    let mesh = mesh.and_then(|mesh| mesh.with_edge_faces(&beside)).expect("a mesh");
    let mut camera = cube_camera((0, 0, SIZE, SIZE));
    camera.view = ViewBits::LookAlong([0, ONE / 2, ONE], [ONE / 3, -ONE / 5, -ONE], [0, ONE, 0]);
    let instance = camera.library().place(&mesh, &ModelBits(vec![]).library());
    let before = |index| instance.project(index) == Err(ProjectError::BeforeNear);
    assert!((0..8).any(before));
    every_assignment(&instance);
}

/// Two triangles before the eye, of which one corner lies beyond the guard band.
#[test]
fn faces_that_reach_beyond_the_guard_band_are_complete() {
    const EDGES: [[u16; 2]; 5] = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]];
    let vertices = [[-2, -1, -5], [2000, 0, -5], [0, 2, -5], [-2000, 30, -7]];
    let faces = [[0, 1, 2], [0, 2, 3]];
    let beside = edge_faces(&EDGES, &faces);
    let mesh = Mesh::new(&vertices, 0, &faces).and_then(|mesh| mesh.with_edges(&EDGES));
    let mesh = mesh.and_then(|mesh| mesh.with_edge_faces(&beside)).expect("a mesh");
    let mut camera = cube_camera((0, 0, SIZE, SIZE));
    camera.view = ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]);
    let instance = camera.library().place(&mesh, &ModelBits(vec![]).library()).with_cull(Cull::None);
    assert_eq!(instance.project(1), Err(ProjectError::OutsideGuardBand));
    every_assignment(&instance);
}

/// A half that no core transforms is transformed by `finish`, and halves of a cache longer than the mesh, or without room for it,
/// are those of the vertices that fit.
#[test]
fn a_half_that_was_left_out_is_transformed_at_the_end() {
    let faces = room_faces();
    let mesh = Mesh::new(&CUBE, 0, &faces).expect("a mesh");
    let instance = cube_camera((0, 0, SIZE, SIZE)).library().place(&mesh, &ModelBits(vec![]).library());
    for length in [0, 1, 3, 8, 20] {
        let mut expected = vec![ScreenVertex::EMPTY; length];
        let _ = instance.transform_depth(&mut expected);
        for done in 0..4u32 {
            let mut cache = vec![ScreenVertex::EMPTY; length];
            let mut split = instance.split_transform_depth(&mut cache);
            for (index, half) in split.halves().into_iter().enumerate() {
                if done >> index & 1 != 0 {
                    half.transform();
                }
            }
            let _ = split.finish();
            assert!(cache == expected, "{length} vertices, halves {done:02b}");
        }
    }
}

/// 17 faces and 17 edges take a cursor of two numbers.
#[test]
fn a_cursor_too_short_says_what_it_needs() {
    let (faces, edges) = ([[0, 2, 1]; 17], [[0, 1]; 17]);
    let mesh = Mesh::new(&CUBE, 0, &faces).and_then(|mesh| mesh.with_edges(&edges)).expect("a mesh");
    let instance = cube_camera((0, 0, SIZE, SIZE)).library().place(&mesh, &ModelBits(vec![]).library());
    let transformed = instance.transform(&mut []);
    let (mut bins, mut edge_bins) = ([0; 19], [0; 19]);
    let mut binned_faces = transformed.bin_faces(&mut bins).expect("room");
    let mut binned_edges = transformed.bin_edges(&mut edge_bins).expect("room");
    for given in 0..2 {
        let error = BinError::Storage { needed: 2, given };
        assert_eq!(binned_faces.fork(&mut vec![0; given]).map(drop), Err(error));
        assert_eq!(binned_edges.fork(&mut vec![0; given]).map(drop), Err(error));
    }
    assert!(binned_faces.fork(&mut [0; 2]).is_ok() && binned_edges.fork(&mut [0; 2]).is_ok());

    let mut scene = pinhole::Scene::<(), 2>::new();
    for _ in 0..2 {
        scene.add(Object::new(&mesh, ModelBits(vec![]).library(), ())).expect("room");
    }
    let camera = cube_camera((0, 0, SIZE, SIZE)).library();
    let (placed, mut bins) = (scene.place(&camera), [0; 38]);
    let mut binned: BinnedScene<'_, '_, _, 2> = placed.bin_faces(&mut [], &mut bins).expect("room");
    assert_eq!(binned.fork(&mut [0; 3]).map(drop), Err(BinError::Storage { needed: 2, given: 1 }));
    assert!(binned.fork(&mut [0; 4]).is_ok());
}

/// Objects that overlap in every band, each placed by its own transform: the forks of a scene draw its picture.
#[test]
fn a_scene_of_several_objects_is_complete() {
    use support::bridge::draw::CUBE_FACES;
    use support::bridge::pair::Step;
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).expect("a mesh");
    let mut scene = pinhole::Scene::<u8, 3>::new();
    for (number, at) in [[0, 0, 0], [ONE, ONE / 2, -ONE], [-ONE, -ONE / 3, ONE]].into_iter().enumerate() {
        let model = ModelBits(vec![Step::Y(number as u32 * (1 << 28)), Step::Move(at)]).library();
        scene.add(Object::new(&mesh, model, number as u8)).expect("room");
    }
    let camera = cube_camera((0, 0, SIZE, SIZE)).library();
    let placed = scene.place(&camera);
    let shade = |_: usize, object: &Object<'_, u8>| {
        let own = object.material;
        move |face: usize| Gray8::new(own * 60 + face as u8 + 1)
    };
    let area = rectangle(0, 0, SIZE, SIZE);
    let (mut target, mut storage) = (Recorder::new(area), vec![0; (SIZE * SIZE) as usize]);
    let mut depth = DepthBuffer::new(area, &mut storage).expect("storage");
    placed.depth_tested(shade, &mut [], &mut depth, &mut target).expect("no error");
    let whole: Vec<u8> =
        area.points().map(|p| target.colour(p.x, p.y).map_or(0, |color| color.luma())).collect();
    assert!(whole.iter().any(|&luma| luma > 120), "the third object is not seen");

    let (mut cache, mut bins, mut cursor) = ([ScreenVertex::EMPTY; 24], [0; 39], [0; 3]);
    let mut binned = placed.bin_faces(&mut cache, &mut bins).expect("room");
    for assignment in 0..1 << (SIZE / ROWS) {
        let forks = binned.fork(&mut cursor).expect("room");
        let mut drawn: Vec<_> = thread::scope(|scope| {
            let cores = [assignment, !assignment].into_iter().zip(forks).map(|(bands, mut objects)| {
                scope.spawn(move || {
                    draw(bands, |band| {
                        let mut storage = [0; STRIP];
                        let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
                        let Ok(()) = objects.depth_tested(shade, &mut depth, &mut band.pixels());
                    })
                })
            });
            cores.collect::<Vec<_>>().into_iter().flat_map(|core| core.join().expect("no panic")).collect()
        });
        drawn.sort();
        let picture: Vec<u8> = drawn.into_iter().flat_map(|(_, bytes)| bytes).collect();
        assert!(picture == whole, "bands {assignment:04b}");
    }
}

/// Bands by number have the rows that the frame's next bands have; below the frame, and of a frame without pixels, there is none.
#[test]
fn bands_by_number_are_the_bands_one_after_the_other() {
    for (height, rows) in [(0, 1), (1, 1), (16, 4), (17, 4), (19, 4), (3, 4), (240, 7)] {
        let area = rectangle(-3, 5, 9, height);
        let (frame, mut next) = (Frame::new(area, Gray8::WHITE), Frame::new(area, Gray8::WHITE));
        let (mut strip, mut other) = (vec![0; 9 * rows], vec![0; 9 * rows]);
        for index in 0..height + 2 {
            let by_number = frame.nth_band(index, &mut strip).expect("a row");
            let one_after = next.next_band(&mut other).expect("a row");
            let bytes_of =
                |band: Option<pinhole::Band<'_, Gray8>>| band.map(|b| (b.area(), b.bytes().to_vec()));
            assert_eq!(bytes_of(by_number), bytes_of(one_after), "band {index} of {height} rows");
        }
        assert!(frame.nth_band(u32::MAX, &mut strip).expect("a row").is_none());
    }
    let frame = Frame::new(rectangle(0, 0, 9, 9), Gray8::BLACK);
    let error = frame.nth_band(3, &mut [0; 8]).map(drop);
    assert_eq!(error, Err(pinhole::BandError { needed: 9, given: 8 }));
}
