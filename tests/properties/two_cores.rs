//! Two threads draw the bands of one frame, from one transformed and binned mesh: whoever draws which band, and in whatever
//! order, the picture is that of the immediate functions, which draw it at once.

use crate::bands::{banded, colour, record_by, reference, Recorded, Stages, BACKGROUND, WAYS};
use crate::cases;
use crate::strategies::{scene, EXPONENT, HEIGHT, WIDTH};
use embedded_graphics_core::pixelcolor::Gray8;
use embedded_graphics_core::prelude::PointsIter;
use pinhole::{BinError, BinnedFaces, Cull, Frame, Mesh, MeshInstance, ScreenVertex, TransformedMesh};
use proptest::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use support::bridge;
use support::oracle::target::Recorder;

/// The bands that a core draws, in this order.
type Bands<'a> = Box<dyn Iterator<Item = u32> + Send + 'a>;

/// Each core draws its bands on a thread of its own. The picture is put together from all of them.
fn by_cores<const N: usize>(forks: [Recorded<'_>; N], rows: u32, bands: [Bands<'_>; N]) -> Vec<u8> {
    let frame = Frame::new(bridge::rectangle(0, 0, WIDTH, HEIGHT), BACKGROUND);
    let draw = |mut recorded: Recorded<'_>, bands: Bands<'_>| {
        let mut strip = vec![0xaa; Frame::<Gray8>::strip_bytes(WIDTH, rows)];
        let mut drawn = Vec::new();
        for index in bands {
            let band = frame.nth_band(index, &mut strip).expect("a row");
            let mut band = band.expect("a band of the frame");
            recorded.draw(&mut band);
            drawn.push((index, band.bytes().to_vec()));
        }
        drawn
    };
    let mut drawn: Vec<_> = std::thread::scope(|scope| {
        let cores: Vec<_> =
            forks.into_iter().zip(bands).map(|(fork, bands)| scope.spawn(|| draw(fork, bands))).collect();
        cores.into_iter().flat_map(|core| core.join().expect("no panic")).collect()
    });
    drawn.sort();
    drawn.into_iter().flat_map(|(_, bytes)| bytes).collect()
}

/// Half of the vertices, and half of the faces, on each of two threads.
struct TwoCores;

/// Both halves of a stage, each on a thread of its own.
macro_rules! both {
    ($split:ident, $run:ident) => {{
        let [ours, theirs] = $split.halves();
        std::thread::scope(|scope| {
            scope.spawn(|| theirs.$run());
            ours.$run();
        });
        $split.finish()
    }};
}

impl Stages for TwoCores {
    fn transform<'a>(instance: &'a MeshInstance<'_>, cache: &'a mut [ScreenVertex]) -> TransformedMesh<'a> {
        let mut split = instance.split_transform(cache);
        both!(split, transform)
    }

    fn transform_depth<'a>(
        instance: &'a MeshInstance<'_>,
        cache: &'a mut [ScreenVertex],
    ) -> TransformedMesh<'a, i16, true> {
        let mut split = instance.split_transform_depth(cache);
        both!(split, transform)
    }

    fn bin_faces<'a, const DEPTH: bool>(
        mesh: TransformedMesh<'a, i16, DEPTH>,
        bin_storage: &'a mut [u16],
    ) -> Result<BinnedFaces<'a, i16, DEPTH>, BinError> {
        let mut split = mesh.split_bin_faces(bin_storage);
        both!(split, count)
    }
}

fn count(rows: u32) -> u32 {
    HEIGHT.div_ceil(rows)
}

proptest! {
    #![proptest_config(cases(300))]

    /// Bands of any height, dealt out at random and drawn in any order. The vertex cache is shorter than the mesh's vertex list
    /// at times.
    #[test]
    fn bands_dealt_out_at_random_give_the_picture(
        scene in scene(),
        length in prop_oneof![2 => Just(16usize), 1 => 0usize..9],
        rows in 1..HEIGHT,
        cores in prop::collection::vec(0u32..2, HEIGHT as usize),
        order in Just((0..HEIGHT).collect::<Vec<_>>()).prop_shuffle(),
    ) {
        let area = bridge::rectangle(0, 0, WIDTH, HEIGHT);
        for way in WAYS {
            let (whole, statistics) = reference(&scene, way, area);
            let mut corners = vec![ScreenVertex::EMPTY; length];
            record_by::<TwoCores, _>(&scene, way, &mut corners, |recorded| -> Result<(), TestCaseError> {
                prop_assert_eq!(recorded.statistics(), statistics);
                let mut cursors = [[0xffff]; 2];
                let cores = &cores;
                let bands = [0, 1].map(|core| -> Bands<'_> {
                    let own = move |band: &u32| *band < count(rows) && cores.get(*band as usize) == Some(&core);
                    Box::new(order.iter().copied().filter(own))
                });
                let picture = by_cores(recorded.fork(&mut cursors), rows, bands);
                prop_assert!(picture == whole, "{way:?}, {rows} rows");
                // One core draws it again, from the binned primitives whose forks are gone.
                prop_assert!(banded(recorded, area, &[rows]) == whole, "{way:?}, after all forks");
                Ok(())
            })?;
        }
    }

    /// Each of three cores takes the next band that none has, as firmware does by an atomic counter: one of the forks is forked.
    #[test]
    fn bands_taken_from_a_counter_give_the_picture(scene in scene(), rows in 1u32..6) {
        let area = bridge::rectangle(0, 0, WIDTH, HEIGHT);
        for way in WAYS {
            let whole = reference(&scene, way, area).0;
            let mut corners = vec![ScreenVertex::EMPTY; 16];
            record_by::<TwoCores, _>(&scene, way, &mut corners, |recorded| -> Result<(), TestCaseError> {
                let (mut cursors, mut more, next) = ([[0xffff]; 2], [[0xffff]; 2], AtomicU32::new(0));
                let bands = [(); 3].map(|()| -> Bands<'_> {
                    let free = || Some(next.fetch_add(1, Relaxed)).filter(|&band| band < count(rows));
                    Box::new(std::iter::from_fn(free))
                });
                let [mut first, third] = recorded.fork(&mut cursors);
                let [first, second] = first.fork(&mut more);
                prop_assert!(by_cores([first, second, third], rows, bands) == whole, "{way:?}, {rows} rows");
                Ok(())
            })?;
        }
    }

    /// Meshes of up to 160 faces, in two halves that are counted by two threads, by one in either order, or not at all before the
    /// end: the bins are those of one core, to the last number, and so is the error for storage that is too short.
    #[test]
    fn faces_counted_in_halves_are_binned_as_in_one_piece(
        scene in scene(),
        copies in 1usize..=20,
        cull in prop::sample::select(vec![Cull::Back, Cull::None]),
        missing in prop_oneof![3 => Just(0usize), 1 => 1usize..200],
        order in 0u32..6,
    ) {
        let faces = scene.faces.repeat(copies);
        let mesh = Mesh::new(&scene.vertices, EXPONENT, &faces).expect("a mesh");
        let (camera, model) = (scene.camera.library(), scene.model.library());
        let instance = camera.place(&mesh, &model).with_cull(cull);
        let mut cache = [ScreenVertex::EMPTY; 16];
        let transformed = instance.transform_depth(&mut cache);
        let length = mesh.face_bins_len().saturating_sub(missing);
        let (mut whole, mut halves) = (vec![0xaaaa; length], vec![0xaaaa; length]);
        let in_one_piece = transformed.bin_faces(&mut whole);
        let in_halves = {
            let mut split = transformed.split_bin_faces(&mut halves);
            let [ours, theirs] = split.halves();
            match order {
                0 => {}
                1 => ours.count(),
                2 => theirs.count(),
                3 => {
                    theirs.count();
                    ours.count();
                }
                _ => std::thread::scope(|scope| {
                    scope.spawn(|| theirs.count());
                    ours.count();
                }),
            }
            split.finish()
        };
        // All fields, and so all numbers of the bins and of the vertex cache.
        prop_assert_eq!(format!("{in_halves:?}"), format!("{in_one_piece:?}"));
        let Ok(mut faces) = in_halves else { return Ok(()) };
        let area = bridge::rectangle(0, 0, WIDTH, HEIGHT);
        let mut target = Recorder::new(area);
        instance.solid(colour, &mut [], &mut target).expect("no error");
        let mut strip = vec![0; Frame::<Gray8>::strip_bytes(WIDTH, HEIGHT)];
        let mut band = Frame::new(area, BACKGROUND).nth_band(0, &mut strip).expect("a row").expect("a band");
        let Ok(()) = faces.solid(colour, &mut band);
        for (pixel, color) in area.points().zip(band.colors()) {
            prop_assert_eq!(color, target.colour(pixel.x, pixel.y).unwrap_or(BACKGROUND));
        }
    }
}
