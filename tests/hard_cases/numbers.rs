//! E1, E2, E4, E6, E7: numbers that overflow naive formats, and numbers that drift.

use crate::near_plane;
use pinhole::space::{Model, World};
use pinhole::{prelude::*, Angle};
use support::bridge::compare::{close3, HALF};
use support::bridge::draw::{solid, wireframe, Shader, CUBE, CUBE_EDGES, CUBE_FACES};
use support::bridge::pair::{bits, ints, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::{point, reals, scalar, vector};
use support::oracle::chain::{self, fx3, V3};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

#[test]
fn e7_angles_wrap() {
    assert_eq!(Angle::turns(1, 4), Angle::degrees(90));
    assert_eq!(Angle::turns(-3, 4), Angle::degrees(90));
    assert_eq!(Angle::turns(9, 4), Angle::degrees(90));
    assert_eq!(Angle::turns(5, 0), Angle::ZERO);
    assert_eq!(Angle::degrees(180), Angle::degrees(180));
    assert_eq!(Angle::degrees(-270), Angle::degrees(90));
    assert_eq!(Angle::degrees(90) + Angle::degrees(180), -Angle::degrees(90));
    assert_eq!(Angle::ZERO - Angle::degrees(180), Angle::degrees(180));
    let thirds = [1, 2].map(|n| Angle::turns(n, 3).bits());
    assert_eq!((thirds, Angle::turns(i32::MIN, u32::MAX).bits()), ([0x5555_5555, 0xaaaa_aaab], 0x7fff_ffff));
    assert_eq!(Angle::from_degrees_f32(45.0), Ok(Angle::turns(1, 8)));
}

#[test]
fn e2_apply_saturates_and_never_wraps() {
    let far = Affine::<Model, World>::translation(Vector3::from_ints(32767, -32768, 0));
    let p = reals(far.apply(Point3::from_ints(32767, -32768, 32767)));
    let top = 32768.0 - 1.0 / 65536.0;
    assert_eq!(p, [top, -32768.0, 32767.0]);
    let large = Affine::<Model, World>::scale(scalar(i32::MAX));
    assert_eq!(reals(large.apply(Point3::from_ints(32767, -32768, 0))), [top, -32768.0, 0.0]);
    let larger = large.then(&Affine::<World, World>::scale(scalar(i32::MIN)));
    assert_eq!(reals(larger.apply(Point3::from_ints(1, -1, 0))), [-32768.0, top, 0.0]);
    let view =
        ViewTransform::from_reference(point([i32::MIN; 3]), vector(ints(0, 0, 1)), vector(ints(0, 1, 0)));
    assert_eq!(reals(view.expect("a view").apply(point([i32::MAX; 3]))), [top; 3]);
}

#[test]
fn e1_a_scene_at_20000_is_the_scene_at_the_origin() {
    // A translation computed from a rounded rotation would be up to 453 px off here; the library's is exact.
    let mut rng = Rng::new(0xE11);
    let mut covered = 0;
    for _ in 0..200 {
        let eye = rng.direction().map(|c| 4.0 * c);
        let gaze: V3 = core::array::from_fn(|i| rng.real(-0.7, 0.7) - eye[i]);
        let (eye, gaze) = (bits(eye).expect("in range"), bits(gaze).expect("in range"));
        if gaze[0].abs().max(gaze[2].abs()) < 1000 {
            continue;
        }
        let turn = ModelBits::random_rotation(&mut rng);
        let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).and_then(|m| m.with_edges(&CUBE_EDGES)).expect("a mesh");
        let far = [0; 3].map(|_| {
            let side = if rng.one_in(2) { 20_000.0 } else { -20_000.0 };
            ((side + rng.real(-9.0, 9.0)) * 65536.0) as i32
        });
        let draw = |offset: [i32; 3]| {
            let c = CameraBits {
                view: ViewBits::LookAlong(core::array::from_fn(|i| eye[i] + offset[i]), gaze, [0, ONE, 0]),
                projection: ProjectionBits::Perspective((1 << 31) / 3, (48, 32), ONE / 4, 100 * ONE),
                viewport: (0, 0, 48, 32),
            };
            let mut model = turn.clone();
            model.0.push(Step::Move(offset));
            // What one ray a pixel sees, in f64.
            let tally = near_plane::compare(&c, &model, &CUBE, 0, &CUBE_FACES, 1.0 / 64.0);
            let (mut faces, mut edges) =
                (Recorder::<Shader>::sized(48, 32), Recorder::<Shader>::sized(48, 32));
            let (library, model) = (c.library(), model.library());
            let instance = library.place(&mesh, &model);
            solid(&instance, &mut faces).expect("no error");
            wireframe(&instance, &mut edges).expect("no error");
            let points: Vec<_> = (0..8).map(|v| instance.project(v)).collect();
            (tally.covered, faces.calls, edges.calls, points)
        };
        let (near, away) = (draw([0; 3]), draw(far));
        covered += away.0;
        assert!(near == away, "{eye:?} {gaze:?} {turn:?} {far:?}");
    }
    assert!(covered > 10_000, "{covered}");
}

#[test]
fn e6_a_million_turns_of_a_tenth_of_a_degree_do_not_drift() {
    // An angle made from the frame's number is the nearest of 2³² for each of them, the millionth as the first.
    let mut worst = 0;
    for i in 0..=1_000_000i32 {
        let exact = i128::from(i) << 32; // times 3600
        let ours = i128::from(Angle::turns(i, 3600).bits()) * 3600;
        let off = (exact - ours).rem_euclid(3600 << 32);
        worst = worst.max(off.min((3600 << 32) - off));
        assert!(Angle::turns(i, 3600) == Angle::turns(i % 3600, 3600), "{i}");
    }
    assert!(2 * worst <= 3600, "{worst}");
    // A matrix rebuilt from it is that of the first turn, bit for bit; 10⁶ is 2800/3600 and 277 whole turns.
    let at = |i: i32| Affine::<Model, World>::rotation_z(Angle::turns(i, 3600));
    assert_eq!(at(1_000_000), at(2800));
    let p = point::<Model>(ints(30_000, 100, 7));
    let (s, c) = chain::sin_cos((2800u64 * (1 << 32) / 3600) as u32);
    let [x, y, z] = fx3(ints(30_000, 100, 7));
    close3(
        reals(at(1_000_000).apply(p)),
        [c * x - s * y, s * x + c * y, z],
        HALF + 30_100.0 * 2f64.powi(-29),
        "turned",
    );
    // What adding up a rounded tenth of a degree makes of it instead: 0.039° off.
    let step = Angle::turns(1, 3600).bits();
    let off = Angle::turns(1_000_000, 3600).bits().wrapping_sub(step.wrapping_mul(1_000_000)) as i32;
    let degrees = f64::from(off).abs() * 360.0 / 4_294_967_296.0;
    assert!((0.039..0.040).contains(&degrees), "{degrees}");
}

#[test]
fn e6_accumulated_matrices_drift_as_documented() {
    // The documentation of `Affine` says by how much: 0.037 % longer and 0.057° behind.
    let step = Affine::<World, World>::rotation_z(Angle::turns(1, 3600));
    let mut all = Affine::<World, World>::identity();
    for _ in 0..1_000_000 {
        all = all.then(&step);
    }
    let [x, y, _] = reals(all.apply(point(ints(30_000, 0, 0))));
    let stretch = (x * x + y * y).sqrt() / 30_000.0 - 1.0;
    // 10⁶ tenths of a degree end at 280°.
    let behind = (280.0 - y.atan2(x).to_degrees()).rem_euclid(360.0);
    assert!((100.0 * stretch - 0.037).abs() < 0.0005, "{stretch}");
    assert!((behind - 0.057).abs() < 0.0005, "{behind}");
}
