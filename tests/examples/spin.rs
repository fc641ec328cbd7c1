//! The README's first command: what its film shows, and its messages for bad input.

#[allow(unreachable_pub, unused_imports)]
#[path = "../../examples/spin/scene.rs"]
mod scene;

use crate::example;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use pinhole::draw::Painter;
use pinhole_apps_support::testing;
use scene::Turntable;
use std::path::{Path, PathBuf};
use teapot::VERTICES;

const SIZE: Size = Size::new_equal(240);
const FRAMES: u32 = 48;

#[test]
fn painters_order_shows_the_nearest_face_but_in_one_pixel_of_a_hundred() {
    let mut painter = Box::new(Painter::<Rgb888, 1024, 1024>::new());
    let turntable = Turntable::new(SIZE).unwrap();
    let (mut pixels, mut of) = (0, 0);
    for frame in 0..FRAMES / 2 {
        let instances = turntable.place(&Turntable::model(frame, FRAMES));
        let (differing, covered) = scene::misordered(&mut painter, &instances, SIZE).unwrap();
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

/// A path that no other test file has.
fn scratch(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("spin-{name}"))
}

#[test]
fn bad_input_is_one_line_exit_code_2_and_no_output() {
    let (file, out) = (scratch("file"), scratch("never"));
    std::fs::write(&file, "").unwrap();
    let unwritable = file.join("below");
    for (arguments, named) in [
        (["--size", "0"], "--size"),
        (["--size", "2049"], "--size"),
        (["--size", "many"], "--size"),
        (["--frames", "1"], "--frames"),
        (["--film", "x"], "--film"),
        (["--out", unwritable.to_str().unwrap()], "file/below"),
    ] {
        let mut arguments = arguments.to_vec();
        if arguments[0] != "--out" {
            arguments.extend(["--out", out.to_str().unwrap()]);
        }
        let said = testing::refusal(&example("spin", &arguments));
        assert!(said.contains(named), "{said}");
        assert!(!out.exists());
    }
}
