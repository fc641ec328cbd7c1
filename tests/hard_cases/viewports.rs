//! E9: no pixel outside viewport ∩ target is written, wherever the two lie.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Viewport, ViewportError};
use support::bridge;
use support::bridge::draw::{cube_camera as camera, turned_cube as draw, Way, WAYS};
use support::bridge::pair::{CameraBits, ProjectionBits, ViewBits, ONE};
use support::oracle::target::Recorder;

#[test]
fn e9_viewports_are_refused_exactly_outside_the_guard_band() {
    let new = |x, y, w, h| Viewport::new(Point::new(x, y), Size::new(w, h));
    for (w, h) in [(0, 0), (0, 5), (5, 0)] {
        assert_eq!(new(0, 0, w, h), Err(ViewportError::Empty));
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
            assert_eq!(viewport, Err(ViewportError::OutsideGuardBand), "{x} {y} {w} {h}");
        }
    }
}

#[test]
fn e9_targets_with_any_bounding_box_show_a_crop() {
    for way in WAYS {
        let viewport = (0, 0, 40, 30);
        for (x, y, w, h, seen) in [
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
        ] {
            let count = crop(way, viewport, bridge::rectangle(x, y, w, h));
            if way != Way::Wireframe || w > 1 {
                assert_eq!(count > 0, seen, "{way:?} {x} {y} {w} {h}");
            }
        }
    }
}

#[test]
fn e9_viewports_partly_or_fully_outside_the_target_show_a_crop() {
    for way in WAYS {
        let bounds = bridge::rectangle(0, 0, 40, 30);
        for (x, y, w, h, seen) in [
            (-10, -10, 40, 30, true),
            (20, 15, 40, 30, true),
            (-20, 5, 80, 10, true),
            (39, 0, 40, 30, false),
            (40, 0, 40, 30, false),
            (-40, 0, 40, 30, false),
            (0, -3000, 40, 30, false),
            (3, 4, 1, 1, true),
            (-300, -225, 640, 480, true), // 16 times larger
            (-8192, -8192, 40, 30, false),
            (8152, 8162, 40, 30, false),
        ] {
            let count = crop(way, (x, y, w, h), bounds);
            if !seen {
                assert!(count == 0 || x == 39, "{way:?} {x} {y} {w} {h}");
            } else if way != Way::Wireframe {
                assert!(count > 0, "{way:?} {x} {y} {w} {h}");
            }
        }
    }
}

#[test]
fn e9_a_scene_larger_than_the_viewport_stays_inside_it() {
    // Inside the cube's shell, so that faces and edges reach over every border.
    let close = |viewport| CameraBits {
        view: ViewBits::LookAt([0, ONE / 8, 5 * ONE / 3], [0; 3], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, (4, 3), ONE / 4, 50 * ONE),
        viewport,
    };
    for way in WAYS {
        for viewport in [(5, 6, 20, 15), (-5, -6, 20, 15), (30, 20, 20, 15), (0, 0, 40, 30)] {
            let mut target = Recorder::sized(40, 30);
            draw(way, &close(viewport), &mut target).expect("no error");
            let (x, y, w, h) = viewport;
            assert_eq!(target.outside, 0);
            for &(px, py) in target.pixels.keys() {
                assert!(px >= x && py >= y && px < x + w as i32 && py < y + h as i32);
            }
            if way != Way::Wireframe {
                assert!(target.pixels.len() > 10, "{way:?} {viewport:?}");
            }
        }
    }
}

/// Draws onto `bounds` and onto a target that holds everything: the one is a crop of the other.
fn crop(way: Way, viewport: (i32, i32, u32, u32), bounds: Rectangle) -> usize {
    let camera = camera(viewport);
    let (x, y, w, h) = viewport;
    let inside_viewport =
        |(px, py): &(i32, i32)| *px >= x && *py >= y && *px < x + w as i32 && *py < y + h as i32;
    let mut whole = Recorder::new(bridge::rectangle(-9000, -9000, 18000, 18000));
    draw(way, &camera, &mut whole).expect("no error");
    assert_eq!(whole.outside, 0);
    assert!(whole.pixels.keys().all(inside_viewport), "{way:?} leaves {viewport:?}");
    let mut target = Recorder::new(bounds);
    draw(way, &camera, &mut target).expect("no error");
    assert_eq!(target.outside, 0, "{way:?} leaves the target {bounds:?}");
    let inside_target = |(px, py): &(i32, i32)| {
        let (dx, dy) =
            (i64::from(*px) - i64::from(bounds.top_left.x), i64::from(*py) - i64::from(bounds.top_left.y));
        dx >= 0 && dy >= 0 && dx < i64::from(bounds.size.width) && dy < i64::from(bounds.size.height)
    };
    whole.pixels.retain(|at, _| inside_target(at));
    assert_eq!(target.pixels, whole.pixels, "{way:?} {viewport:?} {bounds:?}");
    if target.pixels.is_empty() {
        assert!(target.calls.is_empty(), "{way:?} sends fills of nothing");
    }
    target.pixels.len()
}
