//! The README's first command: what its film shows, and its messages for bad input.

#[allow(unreachable_pub, unused_imports)]
#[path = "../../examples/spin/scene.rs"]
mod scene;

use crate::{example, folder};
use embedded_graphics::pixelcolor::{raw::RawU24, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::prelude::*;
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::testing;
use scene::Turntable;
use std::collections::BTreeSet;
use std::fs::{self, File};
use teapot::VERTICES;

const SIZE: Size = Size::new_equal(240);
const FRAMES: u32 = 48;

/// The colour of the background, which no face has.
const NOTHING: Rgb888 = Rgb888::WHITE;

/// How many pixels show another face in painter's order than with a depth buffer, and how many show a face at all.
fn misordered<const CORNERS: usize, const FACES: usize>(
    painter: &mut Painter<Rgb888, CORNERS, FACES>,
    instances: &[MeshInstance<'_>; 2],
    size: Size,
) -> Result<(usize, usize), Box<dyn std::error::Error>> {
    // A face's colour is its index.
    let colour = |face: usize| RawU24::new(face as u32).into();
    let [mut painted, mut nearest] = [(); 2].map(|()| Canvas::new(size, NOTHING));
    scene::paint(painter, instances, colour, &mut painted)?;

    let mut storage = vec![0; painted.pixels().len()];
    let mut depth = DepthBuffer::new(Rectangle::new(Point::zero(), size), &mut storage)?;
    let [outside, inside] = instances;
    let first_inside = outside.mesh().faces().len();
    outside.faces(colour).draw(&mut nearest.depth_tested(&mut depth))?;
    inside.faces(|face| colour(first_inside + face)).draw(&mut nearest.depth_tested(&mut depth))?;

    let pairs = || painted.pixels().iter().zip(nearest.pixels());
    let differing = pairs().filter(|(painted, nearest)| painted != nearest).count();
    Ok((differing, pairs().filter(|(_, nearest)| **nearest != NOTHING).count()))
}

/// `src/book/visibility.md` says so.
#[test]
fn painters_order_shows_the_nearest_face_but_in_one_pixel_of_a_hundred() {
    let mut painter = Box::new(Painter::<Rgb888, 1024, 1024>::new());
    let turntable = Turntable::new(SIZE).unwrap();
    let (mut pixels, mut of) = (0, 0);
    for frame in 0..FRAMES / 2 {
        let instances = turntable.place(&Turntable::model(frame, FRAMES));
        let (differing, covered) = misordered(&mut painter, &instances, SIZE).unwrap();
        (pixels, of) = (pixels + differing, of + covered);
    }
    println!("{pixels} of {of} pixels show another face than a depth buffer would");
    assert!(of > 100_000 && pixels * 100 < of, "{pixels} of {of}");
}

#[test]
fn the_teapot_is_not_mirrored() {
    let table = Turntable::new(SIZE).unwrap();
    let end = |axis: usize| (0..VERTICES.len()).max_by_key(|&v| VERTICES[v][axis]).unwrap();
    let (spout, knob) = (end(0), end(1));
    let at = |frame, vertex| {
        let [outside, _] = table.place(&Turntable::model(frame, FRAMES));
        let pinhole::camera::Projected { point, depth } = outside.project(vertex).unwrap();
        (point.x() >> 8, point.y() >> 8, depth)
    };
    let (middle, middle_depth) = (120, at(0, knob).2);
    // The spout starts on the right, comes near, goes to the left and away; the knob stays above.
    assert!(at(0, spout).0 > 220);
    assert!(at(FRAMES / 4, spout).2 < middle_depth && at(FRAMES / 4, spout).0.abs_diff(middle) < 3);
    assert!(at(FRAMES / 2, spout).0 < 20);
    assert!(at(FRAMES * 3 / 4, spout).2 > middle_depth);
    for frame in 0..FRAMES {
        assert!(at(frame, knob).1 < 90);
    }
}

/// A film has its frames, which differ; another path may be given.
#[test]
fn the_film_has_its_frames() {
    let file = folder("spin", "film").join("below/turn.gif");
    let done = example("spin", &["--out", file.to_str().unwrap()]);
    assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
    let mut gif = gif::DecodeOptions::new().read_info(File::open(&file).unwrap()).unwrap();
    assert_eq!((u32::from(gif.width()), u32::from(gif.height())), (SIZE.width, SIZE.height));
    let mut found = BTreeSet::new();
    while let Some(frame) = gif.read_next_frame().unwrap() {
        found.insert(frame.buffer.to_vec());
    }
    assert_eq!(found.len(), FRAMES as usize, "each frame differs");
    let checked = example("spin", &["--check", "--out", file.to_str().unwrap()]);
    assert!(checked.status.success(), "{checked:?}");
}

#[test]
fn bad_input_is_one_line_exit_code_2_and_no_output() {
    let to = folder("spin", "refused");
    fs::write(to.join("file"), "").unwrap();
    let below = to.join("file/below.gif");
    for (arguments, named) in
        [(["--film", "x"], "--film"), (["--out", below.to_str().unwrap()], "refused/file")]
    {
        let said = testing::refusal(&example("spin", &arguments));
        assert!(said.contains(named), "{said}");
    }
}
