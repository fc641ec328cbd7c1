//! Random values, dense in those where rasterizers and fixed-point numbers go wrong.

use proptest::prelude::*;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::cases::{FARTHEST, GUARD};
use support::oracle::chain;
use support::oracle::coverage::{Area, P};

/// A sub-pixel coordinate near a picture of 32 px: centres, corners, a unit beside them, or any.
pub(crate) fn near() -> impl Strategy<Value = i64> {
    prop_oneof![
        4 => (-6i64..70).prop_map(|k| 128 * k),
        2 => (-6i64..70, -2i64..=2).prop_map(|(k, d)| 128 * k + d),
        3 => -768i64..8960,
    ]
}

/// Anywhere in the guard band: its border, powers of two, zero, any; or near the picture.
pub(crate) fn coordinate() -> impl Strategy<Value = i64> {
    prop_oneof![
        5 => near(),
        2 => (prop::bool::ANY, 0i64..3).prop_map(|(minus, d)| if minus { d - GUARD } else { GUARD - d }),
        1 => (0u32..21, -1i64..=1, prop::bool::ANY).prop_map(|(k, d, minus)| ((1 << k) + d) * if minus { -1 } else { 1 }),
        1 => (-GUARD / 128..=GUARD / 128).prop_map(|k| 128 * k),
        1 => -GUARD..=GUARD,
    ]
}

pub(crate) fn triangle() -> impl Strategy<Value = [P; 3]> {
    prop_oneof![
        2 => [(near(), near()), (near(), near()), (near(), near())],
        2 => [(coordinate(), coordinate()), (coordinate(), coordinate()), (coordinate(), coordinate())],
        // Slivers: the third vertex beside the line through the others.
        1 => ((coordinate(), coordinate()), (coordinate(), coordinate()), 0i64..=8, -2i64..=2, -2i64..=2).prop_map(
            |(a, b, k, dx, dy)| {
                let c = |a: i64, b: i64, d: i64| (a + (b - a) * k / 8 + d).clamp(-GUARD, GUARD);
                [a, b, (c(a.0, b.0, dx), c(a.1, b.1, dy))]
            }
        ),
    ]
}

/// The end of a line, in pixels.
pub(crate) fn pixel() -> impl Strategy<Value = P> {
    let c = || {
        prop_oneof![
            4 => -8i64..40,
            1 => -300i64..300,
            1 => prop::sample::select(vec![-FARTHEST, 1 - FARTHEST, -1, 0, 1, FARTHEST - 1, FARTHEST]),
            1 => -FARTHEST..=FARTHEST,
        ]
    };
    (c(), c())
}

/// The picture that most of these values lie in.
pub(crate) const PICTURE: Area = Area { left: -3, top: -3, right: 36, bottom: 36 };

/// A part of the picture, often empty or a single row.
pub(crate) fn part() -> impl Strategy<Value = Area> {
    let range = || (-3i64..=36, -3i64..=36).prop_map(|(a, b)| (a.min(b), a.max(b)));
    (range(), range()).prop_map(|((l, r), (t, b))| Area::new(l, t, r, b))
}

/// An angle: quarter turns and their neighbours, small ones, any.
pub(crate) fn angle() -> impl Strategy<Value = u32> {
    prop_oneof![
        (0u32..8, -2i32..=2).prop_map(|(k, d)| (k << 29).wrapping_add(d as u32)),
        0u32..100_000,
        any::<u32>(),
    ]
}

/// A factor within 2⁻⁸ … 2⁸: one and its neighbours, powers of two, any.
pub(crate) fn factor() -> impl Strategy<Value = i32> {
    prop_oneof![(-2i32..=2).prop_map(|d| ONE + d), (8u32..=24).prop_map(|k| 1 << k), (256i32..=1 << 24),]
}

/// A shift along an axis: none, a unit of 2⁻¹⁶, large, any.
pub(crate) fn shift(reach: i32) -> impl Strategy<Value = i32> {
    prop_oneof![Just(0), -2i32..=2, Just(reach * ONE), Just(-reach * ONE), -reach * ONE..=reach * ONE]
}

pub(crate) fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        angle().prop_map(Step::X),
        angle().prop_map(Step::Y),
        angle().prop_map(Step::Z),
        factor().prop_map(|f| Step::Scale([f; 3])),
        [shift(2000), shift(2000), shift(2000)].prop_map(Step::Move),
    ]
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
