//! Random values, dense in those where rasterizers and fixed-point numbers go wrong.

use proptest::prelude::*;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::chain;

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
