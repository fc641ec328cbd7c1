//! Two cores draw the bands of scenes of several objects, and halves of vertices at their limits. Random meshes are in
//! `properties/two_cores.rs`; that all types can be sent to another core, in `format.rs`.

use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use pinhole::{draw::BinnedScene, prelude::*, target::BufferError};
use std::thread;
use support::bridge::draw::{cube_camera, room_faces, CUBE, CUBE_FACES};
use support::bridge::pair::{ModelBits, Step, ONE};
use support::bridge::rectangle;
use support::bridge::ways::memory;

const SIZE: u32 = 64;
const ROWS: u32 = 16;
const STRIP: usize = (SIZE * ROWS) as usize;
/// What the bands of one core show, one after the other: those whose bit in `bands` is set.
fn draw(bands: u32, mut draw_band: impl FnMut(&mut pinhole::bands::Band<'_, Gray8>)) -> Vec<(u32, Vec<u8>)> {
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
            let _ = instance.split_transform_depth(&mut cache, |ours, theirs| {
                if done & 1 != 0 {
                    ours();
                }
                if done & 2 != 0 {
                    theirs();
                }
            });
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
    let (mut bins, mut edge_bins) = ([0; 27], [0; 27]);
    let mut binned_faces = transformed.bin_faces(&mut bins).expect("room");
    let mut binned_edges = transformed.bin_edges(&mut edge_bins).expect("room");
    for given in 0..2 {
        let error = BufferError::Bins { needed: 2, given };
        assert_eq!(binned_faces.fork(&mut vec![0; given]).map(drop), Err(error));
        assert_eq!(binned_edges.fork(&mut vec![0; given]).map(drop), Err(error));
    }
    assert!(binned_faces.fork(&mut [0; 2]).is_ok() && binned_edges.fork(&mut [0; 2]).is_ok());

    let mut scene = pinhole::draw::Scene::<(), 2>::new();
    for _ in 0..2 {
        scene.add(Object::new(&mesh, ModelBits(vec![]).library(), ())).expect("room");
    }
    let camera = cube_camera((0, 0, SIZE, SIZE)).library();
    let (placed, mut bins) = (scene.place(&camera), [0; 54]);
    let mut binned: BinnedScene<'_, '_, _, 2> = placed.bin_faces(&mut [], &mut bins).expect("room");
    assert_eq!(binned.fork(&mut [0; 3]).map(drop), Err(BufferError::Bins { needed: 2, given: 1 }));
    assert!(binned.fork(&mut [0; 4]).is_ok());
}

/// Objects that overlap in every band, each placed by its own transform: the forks of a scene draw its picture.
#[test]
fn a_scene_of_several_objects_is_complete() {
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).expect("a mesh");
    let mut scene = pinhole::draw::Scene::<u8, 3>::new();
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
    let whole = memory(rectangle(0, 0, SIZE, SIZE), Gray8::BLACK, &mut |target, depth| {
        let Ok(_) = placed.draw(shade, &mut [], &mut target.depth_tested(depth));
    });
    let whole: Vec<u8> = whole.into_iter().map(|color| color.luma()).collect();
    assert!(whole.iter().any(|&luma| luma > 120), "the third object is not seen");

    let (mut cache, mut bins, mut cursor) = ([ScreenVertex::EMPTY; 24], [0; 51], [0; 3]);
    let mut binned = placed.bin_faces(&mut cache, &mut bins).expect("room");
    for assignment in 0..1 << (SIZE / ROWS) {
        let forks = binned.fork(&mut cursor).expect("room");
        let mut drawn: Vec<_> = thread::scope(|scope| {
            let cores = [assignment, !assignment].into_iter().zip(forks).map(|(bands, mut objects)| {
                scope.spawn(move || {
                    draw(bands, |band| {
                        let mut storage = [0; STRIP];
                        let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
                        let Ok(()) = objects.draw(shade, &mut band.pixels().depth_tested(&mut depth));
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
                |band: Option<pinhole::bands::Band<'_, Gray8>>| band.map(|b| (b.area(), b.bytes().to_vec()));
            assert_eq!(bytes_of(by_number), bytes_of(one_after), "band {index} of {height} rows");
        }
        assert!(frame.nth_band(u32::MAX, &mut strip).expect("a row").is_none());
    }
    let frame = Frame::new(rectangle(0, 0, 9, 9), Gray8::BLACK);
    let error = frame.nth_band(3, &mut [0; 8]).map(drop);
    assert_eq!(
        error,
        Err(pinhole::target::BufferError::Strip { of: "a strip of one row", needed: 9, given: 8 })
    );
}
