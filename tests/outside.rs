//! A foreign DrawTarget: what it refuses comes back unchanged, whenever it does; nothing outside
//! viewport ∩ target is written; everything leaves as fills.

mod bridge;
mod oracle;

use bridge::draw::{Ink, CUBE, CUBE_EDGES, CUBE_FACES};
use bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use embedded_graphics_core::primitives::Rectangle;
use oracle::target::{Call, Recorder, Refused};
use pinhole::{Corner, DepthBuffer, Mesh, Painter, Statistics};

fn camera(viewport: (i32, i32, u32, u32)) -> CameraBits {
    CameraBits {
        view: ViewBits::LookAt([0, ONE, 3 * ONE], [0; 3], [0, ONE, 0]),
        projection: ProjectionBits::Perspective((1 << 31) / 3, (viewport.2, viewport.3), ONE / 2, 50 * ONE),
        viewport,
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Wireframe,
    Solid,
    Painter,
    Depth,
}

const WAYS: [Way; 4] = [Way::Wireframe, Way::Solid, Way::Painter, Way::Depth];

/// A turned cube, any way, onto a target.
fn draw(way: Way, camera: &CameraBits, target: &mut Recorder<Ink>) -> Result<Statistics, Refused> {
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).and_then(|m| m.with_edges(&CUBE_EDGES)).expect("a mesh");
    let model = ModelBits(vec![Step::Y(1 << 29), Step::X(1 << 28)]).library();
    let (x, y, width, height) = camera.viewport;
    let area = bridge::rectangle(x, y, width, height);
    let camera = camera.library();
    let placed = camera.place(&mesh, &model);
    let mut cache = [Corner::default(); 8];
    match way {
        Way::Wireframe => placed.wireframe(Ink(7), &mut cache, target),
        Way::Solid => placed.solid(|face| Ink(face as u16), &mut cache, target),
        Way::Painter => {
            let mut painter = Painter::<Ink, 64, 64>::new();
            painter.add(&placed, |face| Ink(face as u16)).expect("enough room");
            painter.draw(target)
        }
        Way::Depth => {
            let mut storage = vec![0; (area.size.width * area.size.height) as usize];
            let mut depth = DepthBuffer::new(area, &mut storage).expect("storage for all pixels");
            placed.depth_tested(|face| Ink(face as u16), &mut cache, &mut depth, target)
        }
    }
}

#[test]
fn what_the_target_refuses_comes_back_at_every_call() {
    let camera = camera((0, 0, 40, 30));
    for way in WAYS {
        let mut whole = Recorder::sized(40, 30);
        draw(way, &camera, &mut whole).expect("no error");
        let calls = whole.calls.len();
        assert!(calls > 10, "{way:?}");
        for n in 0..calls {
            let mut target = Recorder::failing(40, 30, n);
            assert_eq!(draw(way, &camera, &mut target).err(), Some(Refused(n)), "{way:?}");
            // It stops right there, and what came before is the same.
            assert_eq!(target.calls, whole.calls[..=n], "{way:?}");
        }
        let mut target = Recorder::failing(40, 30, calls);
        assert!(draw(way, &camera, &mut target).is_ok());
    }
}

#[test]
fn everything_leaves_as_fills() {
    for way in WAYS {
        let mut target = Recorder::sized(40, 30);
        draw(way, &camera((0, 0, 40, 30)), &mut target).expect("no error");
        assert!(!target.pixel_by_pixel(), "{way:?}");
        for call in &target.calls {
            match call {
                Call::Solid(area, _) => {
                    assert!(area.size.width >= 1 && area.size.height >= 1, "{area:?}");
                }
                Call::Contiguous(area, n) => {
                    assert_eq!(area.size.width as usize * area.size.height as usize, *n);
                }
                other => panic!("{way:?}: {other:?}"),
            }
        }
    }
}

#[test]
fn a_painter_serves_again_after_a_target_failed() {
    let camera = camera((0, 0, 40, 30));
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).expect("a mesh");
    let model = ModelBits::default().library();
    let camera = camera.library();
    let placed = camera.place(&mesh, &model);
    let mut painter = Painter::<Ink, 64, 64>::new();
    painter.add(&placed, |_| Ink(1)).expect("enough room");
    let mut whole = Recorder::sized(40, 30);
    let statistics = painter.draw(&mut whole).expect("no error");
    for n in 0..whole.calls.len() {
        painter.clear();
        painter.add(&placed, |_| Ink(1)).expect("enough room");
        let mut target = Recorder::failing(40, 30, n);
        assert_eq!(painter.draw(&mut target).err(), Some(Refused(n)));
    }
    painter.clear();
    painter.add(&placed, |_| Ink(1)).expect("enough room");
    let mut target = Recorder::sized(40, 30);
    assert_eq!(painter.draw(&mut target), Ok(statistics));
    assert_eq!(target.calls, whole.calls);
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

#[test]
fn e9_targets_with_any_bounding_box() {
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
fn e9_viewports_partly_and_wholly_outside_the_target() {
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
fn nothing_outside_the_viewport_though_the_scene_is_larger() {
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
