//! Random scenes through camera, clipping and rasterizer.

use crate::bands::{draw, mesh, Way, WAYS};
use crate::cases;
use crate::strategies::{scene, Scene, HEIGHT, WIDTH};
use embedded_graphics_core::pixelcolor::Gray8;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::Cull;
use proptest::prelude::*;
use std::collections::BTreeMap;
use support::bridge::{self, compare};
use support::oracle::coverage::Area;
use support::oracle::target::Recorder;

type Picture = BTreeMap<(i32, i32), (Gray8, u32)>;

fn picture(scene: &Scene, way: Way, bounds: Rectangle) -> Picture {
    let mut target = Recorder::new(bounds);
    draw(scene, way, 16, &mut target);
    assert_eq!(target.outside, 0);
    target.pixels
}

fn whole() -> Rectangle {
    bridge::rectangle(0, 0, WIDTH, HEIGHT)
}

/// The snapped vertices, where they have an image.
fn points(scene: &Scene) -> Vec<Option<(i64, i64)>> {
    let (camera, model, mesh) = (scene.camera.library(), scene.model.library(), mesh(scene));
    let instance = camera.place(&mesh, &model);
    (0..scene.vertices.len())
        .map(|v| instance.project(v).ok().map(|seen| (seen.point.x().into(), seen.point.y().into())))
        .collect()
}

proptest! {
    #![proptest_config(cases(3000))]

    #[test]
    fn caches_of_any_length_draw_the_same(scene in scene(), length in 0usize..12) {
        for way in WAYS {
            let (mut all, mut none, mut some) =
                (Recorder::new(whole()), Recorder::new(whole()), Recorder::new(whole()));
            let counted = [(16, &mut all), (0, &mut none), (length, &mut some)]
                .map(|(length, target)| draw(&scene, way, length, target));
            prop_assert!(counted[0] == counted[1] && counted[0] == counted[2], "{way:?} {counted:?}");
            prop_assert!(all.calls == none.calls && all.calls == some.calls, "{way:?}");
        }
    }

    #[test]
    fn two_half_viewports_add_up_to_the_full_picture(scene in scene(), cut in 0u32..=WIDTH, down in prop::bool::ANY) {
        let cut = if down { cut.min(HEIGHT) } else { cut };
        let halves = if down {
            [bridge::rectangle(0, 0, WIDTH, cut), bridge::rectangle(0, cut as i32, WIDTH, HEIGHT - cut)]
        } else {
            [bridge::rectangle(0, 0, cut, HEIGHT), bridge::rectangle(cut as i32, 0, WIDTH - cut, HEIGHT)]
        };
        for way in WAYS {
            let mut both = picture(&scene, way, halves[0]);
            both.extend(picture(&scene, way, halves[1]));
            prop_assert!(both == picture(&scene, way, whole()), "{way:?}");
        }
    }

    #[test]
    fn a_smaller_target_shows_a_crop(scene in scene(), x in -5i32..40, y in -5i32..30, w in 0u32..40, h in 0u32..30) {
        for way in WAYS {
            let mut wanted = picture(&scene, way, whole());
            wanted.retain(|&(px, py), _| px >= x && py >= y && px < x + w as i32 && py < y + h as i32);
            let mut seen = picture(&scene, way, bridge::rectangle(x, y, w, h));
            // The target may reach beyond the viewport, where nothing is.
            prop_assert!(seen == wanted, "{way:?}");
            seen.retain(|&(px, py), _| px < 0 || py < 0 || px >= WIDTH as i32 || py >= HEIGHT as i32);
            prop_assert!(seen.is_empty());
        }
    }

    /// The viewport's centre is added after the divide, in integers: nothing is rounded anew.
    #[test]
    fn a_viewport_moved_by_whole_pixels_moves_the_picture(scene in scene(), dx in -200i32..200, dy in -200i32..200) {
        let mut moved = scene.clone();
        moved.camera.viewport = (dx, dy, WIDTH, HEIGHT);
        let (here, there) = (points(&scene), points(&moved));
        for (a, b) in here.iter().zip(&there) {
            if let (Some(a), Some(b)) = (a, b) {
                prop_assert_eq!(*b, (a.0 + 256 * i64::from(dx), a.1 + 256 * i64::from(dy)));
            } else {
                // Only what lies next to the guard band, which stays, may leave it or enter.
                let band = 256 * (8192 - 201);
                prop_assert!([a, b].into_iter().flatten().all(|p| p.0.abs() > band || p.1.abs() > band));
            }
        }
        // Where it cuts faces, they are cut elsewhere now: compare scenes that lie before it whole.
        if here.iter().chain(&there).all(Option::is_some) {
            for way in WAYS {
                let there = picture(&moved, way, bridge::rectangle(dx, dy, WIDTH, HEIGHT));
                let back: Picture = there.into_iter().map(|((x, y), color)| ((x - dx, y - dy), color)).collect();
                prop_assert!(back == picture(&scene, way, whole()), "{way:?}");
            }
        }
    }

    /// Faces whose corners have an image cover exactly what the rules say.
    #[test]
    fn faces_are_the_exact_coverage_of_their_corners(scene in scene()) {
        let points = points(&scene);
        let area = Area::new(0, 0, WIDTH.into(), HEIGHT.into());
        for &face in &scene.faces {
            let [Some(a), Some(b), Some(c)] = face.map(|i| points[usize::from(i)]) else { continue };
            compare::triangle([a, b, c], area);
            let mut one = scene.clone();
            one.faces = vec![face; 8]; // as many as the edges name
            let drawn = picture(&one, Way::Solid(Cull::None), whole());
            let exact = bridge::triangle([a, b, c], area);
            prop_assert_eq!(drawn.len() as u64, exact.total());
            for &(x, y) in drawn.keys() {
                prop_assert_eq!(exact.at(x.into(), y.into()), 1);
            }
        }
    }
}
