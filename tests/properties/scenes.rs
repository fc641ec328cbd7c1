//! Random scenes through camera, clipping and rasterizer: at once and in bands, from caches of any length, onto any part of a display.

use crate::cases;
use embedded_graphics_core::pixelcolor::{Gray4, Gray8, GrayColor};
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{draw::ActiveFace, prelude::*};
use proptest::prelude::*;
use std::collections::BTreeMap;
use support::bridge::draw::in_one_piece;
pub(crate) use support::bridge::draw::{Way, WAYS};
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::rectangle;
use support::bridge::ways::{bands, by_every_call, lines_by_every_call};
use support::oracle::chain;
use support::oracle::target::Recorder;

/// An angle: quarter turns and their neighbours, small ones, any.
pub(crate) fn angle() -> impl Strategy<Value = u32> {
    prop_oneof![
        (0u32..8, -2i32..=2).prop_map(|(k, d)| (k << 29).wrapping_add(d as u32)),
        0u32..100_000,
        any::<u32>(),
    ]
}

/// A shift along an axis: none, a unit of 2⁻¹⁶, large, any.
pub(crate) fn shift(reach: i32) -> impl Strategy<Value = i32> {
    prop_oneof![Just(0), -2i32..=2, Just(reach * ONE), Just(-reach * ONE), -reach * ONE..=reach * ONE]
}

/// A rotation about any axis by any constructor, made of three turns.
pub(crate) fn turn() -> impl Strategy<Value = ModelBits> {
    (angle(), angle(), angle()).prop_map(|(a, b, c)| ModelBits(vec![Step::Z(a), Step::X(b), Step::Z(c)]))
}

/// A mesh before a camera: what `scenes` draws.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    pub(crate) camera: CameraBits,
    pub(crate) model: ModelBits,
    pub(crate) vertices: Vec<[i16; 3]>,
    pub(crate) faces: Vec<[u16; 3]>,
    pub(crate) edges: Vec<[u16; 2]>,
}

/// Of the vertices: units of 2⁻¹³, so that they reach ±4.
pub(crate) const EXPONENT: i8 = -13;

pub(crate) const WIDTH: u32 = 32;
pub(crate) const HEIGHT: u32 = 24;

/// Eight faces and edges over up to ten vertices; the eye is among them, or looks at them from so far away that all lie
/// before it.
pub(crate) fn scene() -> impl Strategy<Value = Scene> {
    let c = || {
        prop_oneof![
            1 => prop::sample::select(vec![i16::MIN, -i16::MAX, -1, 0, 1, i16::MAX, 8192, -8192]),
            3 => any::<i16>(),
        ]
    };
    let projection = prop_oneof![
        3 => (1u32 << 27..1 << 30, 1i32..2 * ONE).prop_map(|(fov, near)| {
            ProjectionBits::Perspective(fov, (WIDTH, HEIGHT), near, 1000 * ONE)
        }),
        1 => (ONE / 2..8 * ONE).prop_map(|w| {
            ProjectionBits::Orthographic([-w, w, -w, w], ONE / 4, 1000 * ONE)
        }),
    ];
    let eye = [shift(3), shift(3), shift(3)];
    let gaze = [angle(), angle()].prop_map(|[yaw, pitch]| {
        let ((sy, cy), (sp, cp)) = (chain::sin_cos(yaw), chain::sin_cos(pitch));
        [sy * cp, sp, cy * cp].map(|v| (v * 65536.0) as i32)
    });
    let vertices = prop::collection::vec([c(), c(), c()], 3..10);
    let indices = prop::collection::vec(any::<[prop::sample::Index; 3]>(), 8);
    let far = prop_oneof![Just([0; 3]), [shift(20_000), shift(20_000), shift(20_000)]];
    let away = prop_oneof![Just(0), 12i32..40];
    (projection, eye, gaze, away, vertices, indices, turn(), far)
        .prop_filter("up is along the gaze", |(_, _, gaze, ..)| gaze[0].abs().max(gaze[2].abs()) > 1000)
        .prop_map(|(projection, eye, gaze, away, vertices, indices, mut model, far)| {
            model.0.push(Step::Move(far));
            let eye = core::array::from_fn(|i| eye[i] + far[i] - away * gaze[i]);
            let faces: Vec<_> = indices.iter().map(|f| f.map(|i| i.index(vertices.len()) as u16)).collect();
            let edges = faces.iter().map(|f| [f[0], f[1]]).collect();
            let camera = CameraBits {
                view: ViewBits::LookAlong(eye, gaze, [0, ONE, 0]),
                projection,
                viewport: (0, 0, WIDTH, HEIGHT),
            };
            Scene { camera, model, vertices, faces, edges }
        })
}

pub(crate) const BACKGROUND: Gray8 = Gray8::new(200);
pub(crate) const LINE: Gray8 = Gray8::new(77);

pub(crate) fn colour(face: usize) -> Gray8 {
    Gray8::new(face as u8)
}

/// Edge k is a side of face k, as the strategy makes them.
const BESIDE: [[u16; 2]; 8] = [[0, 1], [1, 1], [2, 0], [3, 3], [4, 65_535], [5, 5], [6, 7], [7, 6]];

/// Calls `with` for the mesh of a scene before its camera.
pub(crate) fn place<R>(scene: &Scene, with: impl FnOnce(&MeshInstance<'_>) -> R) -> R {
    let mesh = Mesh::new(&scene.vertices, EXPONENT, &scene.faces)
        .and_then(|m| m.with_edges(&scene.edges))
        .and_then(|m| m.with_edge_faces(&BESIDE))
        .expect("a mesh");
    with(&scene.camera.library().place(&mesh, &scene.model.library()))
}

/// Draws a scene in one piece, with a vertex cache of so many entries, onto a target that is not the library's.
pub(crate) fn draw(scene: &Scene, way: Way, cache: usize, target: &mut Recorder<Gray8>) -> Statistics {
    let area = scene.camera.area();
    place(scene, |instance| in_one_piece(way, instance, (area, cache), &colour, LINE, target))
        .expect("no error")
}

type Picture = BTreeMap<(i32, i32), (Gray8, u32)>;

fn picture(scene: &Scene, way: Way, bounds: Rectangle) -> Picture {
    let mut target = Recorder::new(bounds);
    draw(scene, way, 16, &mut target);
    assert_eq!(target.outside, 0);
    target.pixels
}

pub(crate) fn whole() -> Rectangle {
    rectangle(0, 0, WIDTH, HEIGHT)
}

/// The snapped vertices, where they have an image.
fn points(scene: &Scene) -> Vec<Option<(i64, i64)>> {
    place(scene, |instance| {
        let point = |v| instance.project(v).ok().map(|seen| (seen.point.x().into(), seen.point.y().into()));
        (0..scene.vertices.len()).map(point).collect()
    })
}

/// By all draw calls, in bands of these heights, of any part of the display.
fn by_all_calls(scene: &Scene, area: Rectangle, heights: &[u32]) {
    place(scene, |instance| {
        for cull in [Cull::Back, Cull::None] {
            let instance = &instance.with_cull(cull);
            let (drawn, _) = by_every_call(instance, area, BACKGROUND, heights, &colour);
            for &rows in heights {
                let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 16], [0; 13]);
                let (mesh, mut list) = (instance.transform(&mut cache), [ActiveFace::EMPTY; 3]);
                let mut faces = mesh.bin_faces(&mut bins).expect("room").with_active_faces(&mut list);
                let found = bands(area, BACKGROUND, rows, &mut |band, _| {
                    let Ok(()) = faces.draw(colour, &mut band.pixels());
                });
                assert!(found == drawn.solid, "active faces without depth, {rows} rows");
            }
        }
        lines_by_every_call(instance, area, BACKGROUND, heights, LINE, None);
    });
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn bands_of_every_height_add_up_to_the_full_picture(scene in scene()) {
        by_all_calls(&scene, whole(), &(1..=HEIGHT).collect::<Vec<u32>>());
    }

    /// Frames of any part of the display, also outside the viewport.
    #[test]
    fn bands_of_any_rectangle_add_up(scene in scene(), rows in 1u32..9, x in -40i32..60, y in -40i32..60, w in 1u32..60, h in 1u32..60) {
        by_all_calls(&scene, rectangle(x, y, w, h), &[rows]);
    }

    /// Nothing is drawn outside the bounds, which lie in the picture.
    #[test]
    fn bounds_contain_every_drawn_pixel(scene in scene()) {
        let (faces, edges) = place(&scene, |instance| {
            let (mut cache, mut bins, mut more) = ([ScreenVertex::EMPTY; 16], [0; 13], [0; 13]);
            let transformed = instance.transform(&mut cache);
            let faces = transformed.bin_faces(&mut bins).expect("room").bounds();
            (faces, transformed.bin_edges(&mut more).expect("room").bounds())
        });
        for (way, bounds) in [(Way::Solid(Cull::Back), faces), (Way::Wireframe, edges)] {
            prop_assert_eq!(bounds.intersection(&whole()), bounds);
            for &(x, y) in picture(&scene, way, whole()).keys() {
                prop_assert!(bounds.contains(Point::new(x, y)), "{way:?} ({x}, {y})");
            }
        }
    }

    /// Colours as the wire has them, sent on with one call a band.
    #[test]
    fn a_band_sends_what_it_holds(scene in scene(), height in 1u32..9) {
        let area = rectangle(0, 0, WIDTH - 1, HEIGHT);
        let gray = |face: usize| Gray4::new(face as u8 + 1);
        let (mut whole, mut display) = (Recorder::new(area), Recorder::new(area));
        place(&scene, |instance| {
            instance.faces(gray).draw(&mut whole).expect("no error");
            let mut frame = Frame::new(area, Gray4::BLACK);
            let mut strip = vec![0; Frame::<Gray4>::strip_bytes(WIDTH - 1, height)];
            while let Some(mut band) = frame.next_band(&mut strip).expect("a row") {
                instance.faces(gray).draw(&mut band).expect("no error");
                let colors: Vec<Gray4> = band.colors().collect();
                let bytes = colors.chunks(WIDTH as usize - 1).flat_map(|row| {
                    row.chunks(2).map(|p| (p[0].luma() << 4) | p.get(1).map_or(0, |c| c.luma()))
                });
                assert!(bytes.eq(band.bytes().iter().copied()));
                band.send(&mut display).expect("no error");
            }
        });
        prop_assert_eq!(display.calls.len() as u32, HEIGHT.div_ceil(height));
        for pixel in area.points() {
            let wanted = whole.colour(pixel.x, pixel.y).unwrap_or(Gray4::BLACK);
            prop_assert_eq!(display.colour(pixel.x, pixel.y), Some(wanted));
            prop_assert_eq!(display.count(pixel.x, pixel.y), 1);
            prop_assert_eq!(Gray4::from_bits(wanted.to_bits()), wanted);
        }
    }
}

proptest! {
    #![proptest_config(cases(3000))]

    #[test]
    fn caches_of_any_length_draw_the_same(scene in scene(), length in 0usize..12) {
        for way in WAYS {
            let [all, none, some] = [16, 0, length].map(|length| {
                let mut target = Recorder::new(whole());
                (draw(&scene, way, length, &mut target), target.calls)
            });
            prop_assert!(all == none && all == some, "{way:?}");
        }
    }

    /// The target may reach beyond the viewport, where nothing is.
    #[test]
    fn a_smaller_target_shows_a_crop(scene in scene(), x in -5i32..40, y in -5i32..30, w in 0u32..40, h in 0u32..30) {
        for way in WAYS {
            let mut wanted = picture(&scene, way, whole());
            wanted.retain(|&(px, py), _| px >= x && py >= y && px < x + w as i32 && py < y + h as i32);
            prop_assert!(picture(&scene, way, rectangle(x, y, w, h)) == wanted, "{way:?}");
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
                let there = picture(&moved, way, rectangle(dx, dy, WIDTH, HEIGHT));
                let back: Picture = there.into_iter().map(|((x, y), color)| ((x - dx, y - dy), color)).collect();
                prop_assert!(back == picture(&scene, way, whole()), "{way:?}");
            }
        }
    }
}
