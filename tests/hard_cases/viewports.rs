//! E9: no pixel outside viewport ∩ target is written, wherever the two lie.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{camera::CameraError, Viewport};
use support::bridge;
use support::bridge::draw::{cube_camera as camera, turned_cube as draw, Way, WAYS};
use support::oracle::target::{area, Recorder};

#[test]
fn e9_viewports_are_refused_exactly_outside_the_guard_band() {
    let new = |x, y, w, h| Viewport::new(Point::new(x, y), Size::new(w, h));
    for (w, h) in [(0, 0), (0, 5), (5, 0)] {
        assert_eq!(new(0, 0, w, h), Err(CameraError::Viewport));
        assert!(new(-9000, 0, w, h).is_err());
    }
    // One pixel inside and one outside the guard band, on each side.
    for (x, y, w, h, ok) in [
        (0, 0, 1, 1, true),
        (-8192, -8192, 16384, 16384, true),
        (-8193, 0, 10, 10, false),
        (0, -8193, 10, 10, false),
        (8182, 0, 10, 10, true),
        (8183, 0, 10, 10, false),
        (0, 8182, 10, 10, true),
        (0, 8183, 10, 10, false),
        (-8192, -8192, 16385, 1, false),
        (i32::MIN, i32::MIN, u32::MAX, u32::MAX, false),
        (i32::MAX, 0, 1, 1, false),
        (0, 0, u32::MAX, 1, false),
        (i32::MAX, i32::MAX, u32::MAX, u32::MAX, false),
    ] {
        let viewport = new(x, y, w, h);
        if ok {
            assert!(viewport.is_ok(), "{x} {y} {w} {h}");
        } else {
            assert_eq!(viewport, Err(CameraError::Viewport), "{x} {y} {w} {h}");
        }
    }
}

#[test]
fn e9_every_target_and_viewport_show_a_crop() {
    // Bounds of the target for a viewport of 40 × 30 at the origin, and viewports for a target of that size.
    let targets = [
        (0, 0, 40, 30, true),
        (-7, -9, 30, 30, true), // negative origin
        (12, 11, 9, 8, true),
        (20, 15, 1, 1, true),
        (20, 0, 1, 30, true),
        (0, 15, 40, 1, true),
        (0, 0, 0, 0, false), // empty
        (20, 15, 0, 5, false),
        (20, 15, 5, 0, false),
        (100, 100, 50, 50, false), // elsewhere
        (-60, 3, 50, 50, false),
        (40, 0, 10, 30, false),
        (0, -30, 40, 30, false),
        (-8192, -8192, 16384, 16384, true),
        (i32::MIN, i32::MIN, u32::MAX, u32::MAX, true), // huge
        (0, 0, u32::MAX, u32::MAX, true),
        (i32::MIN, 0, u32::MAX, 30, true),
        (i32::MIN, i32::MIN, 5, 5, false),
        (i32::MAX, i32::MAX, u32::MAX, u32::MAX, false),
        (i32::MAX, 0, 7, 7, false),
    ];
    let viewports = [
        (-10, -10, 40, 30, true),
        (20, 15, 40, 30, true),
        (-20, 5, 80, 10, true),
        (40, 0, 40, 30, false),
        (-40, 0, 40, 30, false),
        (0, -3000, 40, 30, false),
        (3, 4, 1, 1, true),
        (-300, -225, 640, 480, true), // 16 times larger
        (-8192, -8192, 40, 30, false),
        (8152, 8162, 40, 30, false),
    ];
    let all =
        targets.map(|target| (target, false)).into_iter().chain(viewports.map(|viewport| (viewport, true)));
    for ((x, y, w, h, seen), is_viewport) in all.into_iter() {
        for way in WAYS {
            let count = match is_viewport {
                true => crop(way, (x, y, w, h), bridge::rectangle(0, 0, 40, 30)),
                false => crop(way, (0, 0, 40, 30), bridge::rectangle(x, y, w, h)),
            };
            // Lines may miss a small target.
            if !matches!(way, Way::Wireframe | Way::DepthLines | Way::HiddenLines) || !seen {
                assert_eq!(count > 0, seen, "{way:?} {x} {y} {w} {h}, viewport: {is_viewport}");
            }
        }
    }
}

/// Draws onto `bounds` and onto a target that holds everything: the one is a crop of the other.
fn crop(way: Way, viewport: (i32, i32, u32, u32), bounds: Rectangle) -> usize {
    let camera = camera(viewport);
    let holds = |rectangle: Rectangle, &(x, y): &(i32, i32)| area(rectangle).contains(x.into(), y.into());
    let mut whole = Recorder::new(bridge::rectangle(-9000, -9000, 18000, 18000));
    draw(way, &camera, &mut whole).expect("no error");
    assert_eq!(whole.outside, 0);
    assert!(whole.pixels.keys().all(|at| holds(camera.area(), at)), "{way:?} leaves {viewport:?}");
    let mut target = Recorder::new(bounds);
    draw(way, &camera, &mut target).expect("no error");
    assert_eq!(target.outside, 0, "{way:?} leaves the target {bounds:?}");
    whole.pixels.retain(|at, _| holds(bounds, at));
    assert_eq!(target.pixels, whole.pixels, "{way:?} {viewport:?} {bounds:?}");
    if target.pixels.is_empty() {
        assert!(target.calls.is_empty(), "{way:?} sends fills of nothing");
    }
    target.pixels.len()
}
