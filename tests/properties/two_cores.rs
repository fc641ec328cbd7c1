//! Threads draw the bands of one frame, from one transformed and binned mesh: whoever draws which band, and in whatever order, the picture
//! is that of the immediate functions, which draw it at once.

use crate::cases;
use crate::scenes::{
    colour, draw, place, scene, whole, Way, BACKGROUND, EXPONENT, HEIGHT, LINE, WAYS, WIDTH,
};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use embedded_graphics_core::prelude::PointsIter;
use pinhole::prelude::*;
use proptest::prelude::*;
use support::oracle::target::Recorder;

/// What a core draws into each of its bands.
type Core<'a> = Box<dyn FnMut(&mut Band<'_, Gray8>) + Send + 'a>;

/// Both halves of a stage, each on a thread of its own.
fn both(ours: &mut (dyn FnMut() + Send), theirs: &mut (dyn FnMut() + Send)) {
    std::thread::scope(|scope| {
        scope.spawn(theirs);
        ours();
    });
}

/// Calls `$draw` with three cores that draw binned faces or edges, or both, into a band, each by cursors of its own: one of two forks is
/// forked. Twice, as the forks are gone then.
macro_rules! three {
    ([$($binned:ident),+], $draw:ident, |$band:ident| $into_band:expr) => {
        for _ in 0..2 {
            $(
                let (mut cursor, mut other) = ([0xffff], [0xffff]);
                let [mut first, third] = $binned.fork(&mut cursor).expect("room");
                let [first, second] = first.fork(&mut other).expect("room");
                let mut $binned = [first, second, third].into_iter();
            )+
            $draw(core::array::from_fn(|_| -> Core<'_> {
                $(let mut $binned = $binned.next().expect("three");)+
                Box::new(move |$band| $into_band)
            }));
        }
    };
}

/// Calls `draw` with a depth buffer of a band.
fn with_depth(band: &mut Band<'_, Gray8>, draw: impl FnOnce(&mut DepthBuffer<'_>, &mut Band<'_, Gray8>)) {
    let area = band.area();
    let mut storage = vec![0; (area.size.width * area.size.height) as usize];
    draw(&mut DepthBuffer::new(area, &mut storage).expect("storage"), band);
}

/// Transforms and bins a mesh on two threads, and calls `draw` with three cores that draw it.
fn by_three(
    instance: &MeshInstance<'_>,
    way: Way,
    cache: &mut [ScreenVertex],
    draw: &dyn Fn([Core<'_>; 3]),
) -> Statistics {
    let (mut bins, mut more) = ([0; 13], [0; 13]);
    match way {
        Way::Solid(cull) => {
            let instance = instance.with_cull(cull);
            let transformed = instance.split_transform(cache, both);
            let mut faces = transformed.split_bin_faces(&mut bins, both).expect("room");
            three!([faces], draw, |band| {
                let Ok(()) = faces.draw(colour, band);
            });
            faces.statistics()
        }
        Way::Depth(cull) => {
            let instance = instance.with_cull(cull);
            let transformed = instance.split_transform_depth(cache, both);
            let mut faces = transformed.split_bin_faces(&mut bins, both).expect("room");
            three!([faces], draw, |band| with_depth(band, |depth, band| {
                let Ok(()) = faces.draw(colour, &mut band.depth_tested(depth));
            }));
            faces.statistics()
        }
        Way::Wireframe => {
            let transformed = instance.split_transform(cache, both);
            let mut edges = transformed.bin_edges(&mut bins).expect("room");
            three!([edges], draw, |band| {
                let Ok(()) = edges.draw(LINE, band);
            });
            edges.statistics()
        }
        Way::DepthLines | Way::HiddenLines => {
            let transformed = instance.split_transform_depth(cache, both);
            let mut faces = transformed.split_bin_faces(&mut bins, both).expect("room");
            let mut edges = transformed.bin_edges(&mut more).expect("room");
            three!([faces, edges], draw, |band| with_depth(band, |depth, band| {
                faces.depth_only(depth);
                let Ok(()) = match way {
                    Way::HiddenLines => edges.hidden_line(LINE, &mut band.depth_tested(depth)),
                    _ => edges.draw(LINE, &mut band.depth_tested(depth)),
                };
            }));
            edges.statistics()
        }
        Way::Painter => {
            let mut painter = Box::new(Painter::<Gray8, 128, 64>::new());
            instance.faces(colour).sorted(&mut painter).expect("room");
            let order = painter.order();
            draw([order; 3].map(|order| -> Core<'_> {
                Box::new(move |band| {
                    let Ok(()) = order.draw(band);
                })
            }));
            order.statistics()
        }
    }
}

proptest! {
    #![proptest_config(cases(300))]

    /// Bands of any height, dealt out at random and drawn in any order. The vertex cache is shorter than the mesh's vertex list at times.
    #[test]
    fn bands_dealt_out_at_random_give_the_picture(
        scene in scene(),
        length in prop_oneof![2 => Just(16usize), 1 => 0usize..9],
        rows in 1..HEIGHT,
        cores in prop::collection::vec(0usize..3, HEIGHT as usize),
        order in Just((0..HEIGHT).collect::<Vec<_>>()).prop_shuffle(),
    ) {
        let (area, mut cache) = (whole(), vec![ScreenVertex::EMPTY; length]);
        let frame = Frame::new(area, BACKGROUND);
        for way in WAYS {
            let mut target = Recorder::new(area);
            let statistics = draw(&scene, way, 16, &mut target);
            let wanted: Vec<u8> =
                area.points().map(|at| target.colour(at.x, at.y).unwrap_or(BACKGROUND).luma()).collect();
            let check = |drawn: [Core<'_>; 3]| {
                let draw = |(core, mut draw): (usize, Core<'_>)| {
                    let mut strip = vec![0xaa; Frame::<Gray8>::strip_bytes(WIDTH, rows)];
                    let is_own = |band: &&u32| **band < HEIGHT.div_ceil(rows) && cores[**band as usize] == core;
                    let bytes = |&index: &u32| {
                        let mut band = frame.nth_band(index, &mut strip).expect("a row").expect("a band");
                        draw(&mut band);
                        (index, band.bytes().to_vec())
                    };
                    order.iter().filter(is_own).map(bytes).collect::<Vec<_>>()
                };
                let mut bands: Vec<_> = std::thread::scope(|scope| {
                    let cores: Vec<_> =
                        drawn.into_iter().enumerate().map(|core| scope.spawn(move || draw(core))).collect();
                    cores.into_iter().flat_map(|core| core.join().expect("no panic")).collect()
                });
                bands.sort();
                assert!(bands.into_iter().flat_map(|(_, bytes)| bytes).eq(wanted.iter().copied()), "{way:?}, {rows} rows");
            };
            let counted = place(&scene, |instance| by_three(instance, way, &mut cache, &check));
            prop_assert_eq!(counted, statistics);
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
        let in_halves = transformed.split_bin_faces(&mut halves, |ours, theirs| match order {
            0 => {}
            1 => ours(),
            2 => theirs(),
            3 => {
                theirs();
                ours();
                theirs();
            }
            _ => both(ours, theirs),
        });
        // All fields, and so all numbers of the bins and of the vertex cache.
        prop_assert_eq!(format!("{in_halves:?}"), format!("{in_one_piece:?}"));
    }
}
