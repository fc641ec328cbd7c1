//! Every stated bound of a numeric function holds, and is at most twice the largest error measured.
//!
//! `src/math` is compiled into this test, because its functions are private.

use crate::math::{num, quaternion, unit};
use embedded_graphics_core::geometry::{Point, Size};
use pinhole::space::{Model, View, World};
use pinhole::{prelude::*, Angle};
use support::bridge::pair::{random_view, window, CameraBits, ModelBits, ProjectionBits, Step, ViewBits};
use support::bridge::{self, point, reals, scalar, vector};
use support::oracle::chain::{self, cross, dot, fx, fx3, length, normalise, M3, M4, V3};
use support::oracle::rng::Rng;

/// As in `src/lib.rs`: without its feature.
macro_rules! defmt_format {
    ($($text:tt)*) => {};
}

#[allow(dead_code, unreachable_pub, unused_imports, clippy::wrong_self_convention)]
#[path = "../src/math/mod.rs"]
mod math;
#[allow(dead_code, unreachable_pub)]
#[path = "../src/space.rs"]
mod space;

/// Measured quantities: the name of each, the bound that the documentation states, and the largest error over seeded inputs against f64
/// or exact integers.
#[derive(Default)]
struct Errors(Vec<(&'static str, f64, f64)>);

impl Errors {
    fn add(&mut self, what: &'static str, bound: f64, error: f64) {
        match self.0.iter_mut().find(|(name, ..)| core::ptr::eq(*name, what)) {
            Some((.., largest)) => *largest = largest.max(error),
            None => self.0.push((what, bound, error.max(0.0))),
        }
    }

    fn hold(self) {
        for (what, bound, error) in self.0 {
            println!("{what}: {error:e} of {bound:e}");
            assert!(error <= bound, "{what}: {error:e} beyond {bound:e}");
            assert!(bound <= 2.0 * error, "{what}: {error:e} is far below {bound:e}");
        }
    }
}

macro_rules! bounds {
    ($($test:ident: $measured:ident)*) => {$(
        #[test]
        fn $test() {
            let mut errors = Errors::default();
            $measured(&mut errors);
            errors.hold();
        }
    )*};
}

bounds! {
    e7_sine_and_cosine: sines
    e7_angles: angles
    e8_reciprocal: reciprocals
    square_root: roots
    e4_unit_vectors: unit_vectors
    s2_rotations: rotations
    s2_compositions_and_inverses: compositions
    s2_normals: normals
    s3_views: views
    s4_projections: projections
    s4_planes_and_vanishing_points: planes
    s4_reference_volumes: volumes
    s6_viewports: viewports
}

/// 1/√2, 1/√3 and 1/√6, to 2⁻³².
#[test]
fn s4_isometric_rows() {
    let (half, third, sixth) = (0.5f64.sqrt(), (1.0f64 / 3.0).sqrt(), (1.0f64 / 6.0).sqrt());
    let exact = [[half, 0.0, -half], [-sixth, 2.0 * sixth, -sixth], [third, third, third]];
    let rows = ViewTransform::isometric(Point3::from_ints(0, 0, 0)).to_matrix();
    let mut worst = 0f64;
    for (row, exact) in rows.iter().zip(exact) {
        for (got, exact) in row.iter().zip(exact) {
            worst = worst.max((got - exact).abs() * 1_073_741_824.0);
        }
    }
    assert!((0.125..=0.25).contains(&worst), "{worst}");
}

/// Rounding moves a matrix that is barely rigid, to either side of the limit: what is taken is taken again.
#[test]
fn s3_a_view_rigid_to_the_limit_goes_back() {
    let mut rng = Rng::new(0x5F);
    let mut taken = 0;
    for i in 0..50_000 {
        let exact = random_view(&mut rng).exact();
        // A row's square is 4·10⁻⁶ off, but for some 10⁻¹⁰.
        let long = (1.0 + 4e-6 - (f64::from(i) - 25_000.0) * 1e-13).sqrt();
        let mut matrix = [[0.0; 4]; 4];
        for (row, axis) in matrix.iter_mut().zip(exact.rows) {
            row[..3].copy_from_slice(&axis);
        }
        matrix[i as usize % 3].iter_mut().for_each(|c| *c *= long);
        matrix[3][3] = 1.0;
        if let Ok(view) = ViewTransform::from_matrix(&matrix) {
            assert_eq!(ViewTransform::from_matrix(&view.to_matrix()), Ok(view), "{matrix:?}");
            taken += 1;
        }
    }
    assert!((10_000..40_000).contains(&taken), "{taken}");
}

/// All vertices lie inside, and the radius is at most √3 times half the longest side of their box, which no
/// sphere round them falls short of; rounded up by at most 9·2⁻¹⁶ and 2⁻²⁸ of itself.
#[test]
fn s5_bounding_spheres() {
    let mut rng = Rng::new(0x60);
    let (mut widest, mut steps) = (0f64, 0f64);
    for k in 0..20_000 {
        let (sphere, places) = if k % 2 == 0 {
            let exponent = rng.int(-15, 0) as i8;
            let reach = rng.int(1, 32_767);
            let mut any = || [0; 3].map(|_| rng.int(-reach, reach) as i16);
            let vertices: [[i16; 3]; 6] = core::array::from_fn(|_| any());
            let mesh = Mesh::new(&vertices, exponent, &[]).expect("a mesh");
            (mesh.bounding_sphere(), vertices.map(|v| chain::vertex(v, exponent)))
        } else {
            // Two corners of a cube, and what lies between: no sphere is smaller than √3 times half a side.
            let side = rng.log(1.0, 1e9) as i64;
            let low = rng.int(-1_000_000_000, 1_000_000_000);
            let between = [0; 3].map(|_| (low + rng.int(0, side)) as i32);
            let vertices = [low as i32, (low + side) as i32].map(|c| [c; 3]);
            let vertices = [vertices[0], vertices[1], between, between, between, between];
            let fixed = vertices.map(|v| v.map(Scalar::from_bits));
            let mesh = Mesh::from_fixed(&fixed, &[]).expect("a mesh");
            (mesh.bounding_sphere(), vertices.map(|v| v.map(chain::fx)))
        };
        let (centre, radius) = (bridge::reals(sphere.centre), chain::fx(sphere.radius.to_bits()));
        let mut longest = 0f64;
        for i in 0..3 {
            let side = places.iter().fold((f64::MAX, f64::MIN), |(a, b), p| (a.min(p[i]), b.max(p[i])));
            longest = longest.max((side.1 - side.0) / 2.0);
        }
        if sphere.radius == Scalar::MAX {
            assert!(3f64.sqrt() * longest > 32_767.0, "{places:?}");
            continue; // stands for any radius: `camera` and `view_volume` test that
        }
        for p in places {
            let away = chain::length(core::array::from_fn(|i| p[i] - centre[i]));
            assert!(away <= radius, "{away} of {radius}: {places:?}");
        }
        let least = 3f64.sqrt() * longest + radius * 2f64.powi(-28);
        steps = steps.max((radius - least) * 65_536.0);
        assert!(steps <= 9.0, "{steps}: {radius} of {least}: {places:?}");
        widest = widest.max(radius / least);
    }
    assert!(widest >= 0.5, "{widest}");
    assert!(steps >= 4.5, "{steps} of 9");
}

fn two(power: f64) -> f64 {
    power.exp2()
}

/// A 2⁻³⁰ integer as a number.
fn q30(v: i32) -> f64 {
    f64::from(v) / 1_073_741_824.0
}

fn sines(errors: &mut Errors) {
    let mut rng = Rng::new(0x51);
    for k in 0..1u32 << 22 {
        // Every table angle and its neighbours, the midpoints between them, and random angles.
        let near = ((k >> 4) % 512) << 23;
        let angle = match k % 16 {
            0 => near,
            1 => near.wrapping_add(rng.bits() >> 20),
            2 => near.wrapping_sub(rng.bits() >> 20),
            _ => rng.bits(),
        };
        let (s, c) = Angle::from_bits(angle).sin_cos();
        let (es, ec) = chain::sin_cos(angle);
        let off = (q30(s) - es).abs().max((q30(c) - ec).abs());
        errors.add("`Angle::sin_cos`, and so `rotation_x`, `_y`, `_z`", two(-29.5), off);
        // Exact: 62 bits.
        let square = i64::from(s) * i64::from(s) + i64::from(c) * i64::from(c);
        let off = (square - (1 << 60)).unsigned_abs() as f64 / two(60.0);
        errors.add("– sin² + cos² against 1", two(-28.0), off);
    }
    for k in 0..4 {
        let (s, c) = Angle::turns(k, 4).sin_cos();
        let (es, ec) = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][k as usize];
        errors.add("– at the quarter turns", 0.0, (q30(s) - es).abs().max((q30(c) - ec).abs()));
    }
}

fn angles(errors: &mut Errors) {
    let mut rng = Rng::new(0x52);
    let full = 4_294_967_296.0;
    for _ in 0..1 << 18 {
        let (n, d) = (rng.bits() as i32 >> rng.below(31), (rng.bits() >> rng.below(31)).max(1));
        // In exact integers: bits · d differs from n·2³² by at most half of d.
        let got = i128::from(Angle::turns(n, d).bits()) * i128::from(d);
        let off = ((i128::from(n) << 32) - got).rem_euclid(i128::from(d) << 32);
        let off = off.min((i128::from(d) << 32) - off) as f64 / f64::from(d);
        errors.add("`Angle::turns`, `Angle::degrees`, in units of 2⁻³² turn", 0.5, off);
        let degrees = rng.real(-1_048_576.0, 1_048_576.0) as f32 / (1u32 << rng.below(21)) as f32;
        let got = Angle::from_degrees_f32(degrees).map_or(f64::NAN, |a| f64::from(a.bits()));
        let off = (f64::from(degrees) * full / 360.0 - got).rem_euclid(full);
        let off = off.min(full - off);
        errors.add("`Angle::from_degrees_f32`, in units of 2⁻³² turn", 0.5 + two(-10.0), off);
    }
}

fn reciprocals(errors: &mut Errors) {
    let mut check = |v: i32| {
        let r = num::reciprocal(v);
        assert!(r.mantissa >= 1 << 30, "{v}: {r:?}");
        let got = f64::from(r.mantissa) * two(f64::from(r.shift) - 61.0);
        errors.add("reciprocal (1/w), in units of itself", two(-29.0), (got * f64::from(v) - 1.0).abs());
    };
    for v in (1 << 30..i32::MAX - 100).step_by(97) {
        check(v);
    }
    for k in 0..31 {
        for d in -1..=1 {
            check((1i32 << k).wrapping_add(d).max(1));
        }
    }
    check(i32::MAX);
}

fn roots(errors: &mut Errors) {
    let mut rng = Rng::new(0x53);
    let mut check = |v: u64| {
        // √v − r = (v − r²)/(√v + r), the numerator exact.
        let r = num::sqrt(v);
        assert!(u32::try_from(v).is_ok_and(|v| num::sqrt_word(v) == r) || v >> 32 > 0);
        let off = i128::from(v) - i128::from(r) * i128::from(r);
        if v > 0 {
            errors.add("square root", 0.5, (off as f64 / ((v as f64).sqrt() + f64::from(r))).abs());
        }
    };
    for k in 0..64 {
        for _ in 0..2000 {
            check((rng.next() >> k).min(u64::MAX - (1 << 32)));
        }
    }
    // On both sides of the values at which the rounding changes.
    for _ in 0..100_000 {
        let r = u64::from(rng.bits() >> rng.below(31)).min(u64::from(u32::MAX) - 1);
        check(r * r + r);
        check(r * r + r + 1);
    }
    // The roots that round up to 2³² and to 2¹⁶.
    assert_eq!((num::sqrt(u64::MAX), num::sqrt_word(u32::MAX)), (u32::MAX, 1 << 16));
}

fn unit_vector_error(v: [i64; 3]) -> f64 {
    let real = v.map(|c| c as f64);
    let exact = normalise(real);
    let got = unit::normalise(&v);
    (0..3).map(|i| (q30(got[i]) - exact[i]).abs()).fold(0.0, f64::max)
}

fn unit_vectors(errors: &mut Errors) {
    let mut rng = Rng::new(0x54);
    for k in 0..400_000 {
        let v = match k % 3 {
            0 => [0; 3].map(|_| rng.int(-1000, 1000)),
            1 => [0; 3].map(|_| rng.next() as i64 >> (2 + rng.below(60))),
            _ => [0; 3].map(|_| rng.next() as i64 >> 20),
        };
        if v != [0; 3] {
            let off = unit_vector_error(v);
            errors.add("unit vectors (`ViewTransform`, `Lambert`, axes)", 1.5 * two(-30.0), off);
        }
    }
    assert_eq!([[0, 0, -7], [0; 3]].map(|v| unit::normalise(&v)), [[0, 0, -(1 << 30)], [0; 3]]);
}

fn linear(m: &M4) -> M3 {
    [m[0], m[1], m[2]].map(|r| [r[0], r[1], r[2]])
}

fn largest(m: &M3) -> f64 {
    m.iter().flatten().fold(0.0, |a, c| a.max(c.abs()))
}

fn gap(a: &M3, b: &M3) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Rodrigues' formula.
fn rodrigues(axis: V3, angle: u32) -> M3 {
    let a = normalise(axis);
    let (s, c) = chain::sin_cos(angle);
    let across = [[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]];
    core::array::from_fn(|i| {
        core::array::from_fn(|j| c * f64::from(u8::from(i == j)) + (1.0 - c) * a[i] * a[j] + s * across[i][j])
    })
}

fn random_axis(rng: &mut Rng) -> [i32; 3] {
    loop {
        let v = match rng.below(3) {
            0 => [0; 3].map(|_| rng.int(-9, 9) as i32),
            1 => [0; 3].map(|_| rng.bits() as i32 >> rng.below(31)),
            _ => [0; 3].map(|_| rng.bits() as i32),
        };
        if v != [0; 3] {
            return v;
        }
    }
}

fn rotations(errors: &mut Errors) {
    let mut rng = Rng::new(0x55);
    for k in 0..300_000 {
        let (axis, angle) = (random_axis(&mut rng), rng.bits());
        // With so few bits that f64 holds all products.
        let through = [0; 3].map(|_| (rng.bits() as i32 >> 1) & !0xfff);
        let turn = Affine::<Model, World>::rotation(point(through), vector(axis), Angle::from_bits(angle));
        let (got, exact) = (turn.map(|t| t.to_matrix()).unwrap_or_default(), rodrigues(fx3(axis), angle));
        errors.add("`Affine::rotation` about any line", two(-27.0), gap(&linear(&got), &exact));
        // The translation follows from the matrix as stored: through − R·through.
        for (row, at) in got.iter().zip(through) {
            let wanted = fx(at) - dot([row[0], row[1], row[2]], fx3(through));
            errors.add("– its translation, given its rotation", two(-33.0), (row[3] - wanted).abs());
        }
        let q = match k % 2 {
            0 => [0; 4].map(|_| rng.bits() as i32),
            _ => [0; 4].map(|_| rng.int(-9, 9) as i32),
        };
        if q == [0; 4] {
            continue;
        }
        let real = q.map(f64::from);
        let square = real.iter().map(|c| c * c).sum::<f64>();
        let kept = quaternion::unit(q.map(i64::from)).unwrap_or_default();
        for (got, exact) in kept.iter().zip(real) {
            let off = (q30(*got) - exact / square.sqrt()).abs();
            errors.add("`Affine::from_quaternion`, each part of the unit quaternion", 2.5 * two(-30.0), off);
        }
        let ours = Affine::<Model, World>::from_quaternion(q.map(scalar));
        let got = linear(&ours.map(|turn| turn.to_matrix()).unwrap_or_default());
        let [w, x, y, z] = real;
        // The sandwich product of the quaternion as stored, over its norm.
        let exact = [
            [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ];
        let off = gap(&got, &exact.map(|row| row.map(|c| c / square)));
        errors.add("`Affine::from_quaternion`", two(-27.0), off);
    }
}

/// A rotation by three angles, in f64.
fn any_turn(rng: &mut Rng) -> M3 {
    ModelBits(vec![Step::X(rng.bits()), Step::Y(rng.bits()), Step::Z(rng.bits())]).exact().m
}

fn transposed(m: &M3) -> M3 {
    core::array::from_fn(|i| core::array::from_fn(|j| m[j][i]))
}

fn with_translation(m: &M3, t: V3) -> M4 {
    core::array::from_fn(|i| match m.get(i) {
        Some(row) => [row[0], row[1], row[2], t[i]],
        None => [0.0, 0.0, 0.0, 1.0],
    })
}

/// Rotation · stretches · rotation.
fn stretched(rng: &mut Rng, stretches: V3) -> M3 {
    let (u, v) = (any_turn(rng), any_turn(rng));
    let scaled = core::array::from_fn(|i| core::array::from_fn(|j| stretches[i] * v[i][j]));
    chain::matmul3(&u, &scaled)
}

/// The inverse by cofactors.
fn inverse_of(m: &M3) -> M3 {
    let c = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
    let determinant = dot(m[0], c[0]);
    transposed(&c).map(|row| row.map(|v| v / determinant))
}

fn compositions(errors: &mut Errors) {
    let mut rng = Rng::new(0x56);
    for _ in 0..100_000 {
        // Two matrices of any size.
        let mut any = || {
            let stretch = rng.log(1e-3, 1e3);
            let m: M3 = [[0.0; 3]; 3].map(|row| row.map(|_| stretch * rng.real(-1.0, 1.0)));
            let t: V3 = [0.0; 3].map(|_| rng.real(-1000.0, 1000.0));
            let ours =
                Affine::<World, World>::from_matrix(&with_translation(&m, t)).unwrap_or(Affine::identity());
            let stored = ours.to_matrix();
            errors.add("`Affine::from_matrix`", two(-30.0), gap(&linear(&stored), &m) / largest(&m));
            // What was rounded once stays.
            let again = Affine::from_matrix(&stored);
            assert!(again == Ok(ours) || stored.iter().flatten().any(|c| c.abs().log2().fract() == 0.0));
            ours
        };
        let (a, b) = (any(), any());
        // The exact product of the two as stored.
        let (product, exact) = (a.then(&b).to_matrix(), chain::matmul4(&b.to_matrix(), &a.to_matrix()));
        let off = gap(&linear(&product), &linear(&exact)) / largest(&linear(&exact));
        errors.add("`Affine::then`", two(-30.0), off);
        // Only where f64 resolves the difference: products below 2¹⁰.
        let (t, m) = (a.to_matrix(), b.to_matrix());
        for i in 0..3 {
            if (0..3).all(|k| (m[i][k] * t[k][3]).abs() < 1024.0) {
                errors.add("– its translation", two(-33.0), (product[i][3] - exact[i][3]).abs());
            }
        }
        let p = [0; 3].map(|_| rng.bits() as i32 >> rng.below(31));
        let wanted = chain::mul4(&a.to_matrix(), [fx(p[0]), fx(p[1]), fx(p[2]), 1.0]);
        if wanted.iter().all(|c| c.abs() < 32_767.0) {
            for (got, wanted) in reals(a.apply(point(p))).iter().zip(wanted) {
                let what = "`Affine::apply`, the matrix as stored, in units of 2⁻¹⁶";
                errors.add(what, 0.5 + two(-17.0), (got - wanted).abs() * 65_536.0);
            }
        }
        // The inverse of a matrix as stored, whose stretches are known.
        let size = rng.log(0.01, 100.0);
        let stretches = [size, size * rng.log(1.0, 100.0), size * rng.log(1.0, 100.0)];
        let (least, most) = stretches.iter().fold((f64::MAX, 0f64), |(a, b), &s| (a.min(s), b.max(s)));
        let there = with_translation(&stretched(&mut rng, stretches), [0.0; 3]);
        let ours = Affine::<Model, World>::from_matrix(&there).unwrap_or(Affine::identity());
        let back = inverse_of(&linear(&ours.to_matrix()));
        let got = ours.inverse().map(|i| i.to_matrix()).unwrap_or_default();
        let what = "`Affine::inverse`, in units of largest coefficient × ratio of stretches";
        errors.add(what, two(-28.0), gap(&linear(&got), &back) / largest(&back) / (most / least));
        let turn = ModelBits(vec![Step::X(rng.bits()), Step::Y(rng.bits()), Step::Z(rng.bits())]).library();
        let got = turn.inverse().map(|i| i.to_matrix()).unwrap_or_default();
        errors.add(what, two(-28.0), gap(&linear(&got), &inverse_of(&linear(&turn.to_matrix()))));
    }
}

fn normals(errors: &mut Errors) {
    let mut rng = Rng::new(0x57);
    let mut add = |off: f64| errors.add("`NormalMatrix::apply`", two(-15.0), off.abs());
    for _ in 0..200_000 {
        let stretches = [0; 3].map(|_| rng.log(0.1, 10.0));
        let m = stretched(&mut rng, stretches);
        let ours = math::Affine::<space::Model, space::World>::from_matrix(&with_translation(&m, [0.0; 3]));
        let n = rng.direction().map(|c| (c * 32_767.0).round() as i16);
        let exact = normalise(chain::mul3(&transposed(&inverse_of(&m)), n.map(f64::from)));
        let got = ours.map_or([0; 3], |map| map.normals().apply(n));
        for (got, exact) in got.iter().zip(exact) {
            add(f64::from(*got) / 32_768.0 - exact);
        }
    }
    // +1 itself is not representable in steps of 2⁻¹⁵.
    let ours = math::Affine::<space::Model, space::World>::identity().normals().apply([0, 0, i16::MAX]);
    add(f64::from(ours[2]) / 32_768.0 - 1.0);
}

fn views(errors: &mut Errors) {
    let mut rng = Rng::new(0x58);
    for k in 0..300_000 {
        // Anywhere, by any constructor; or with components that differ by orders of magnitude.
        let view = match k % 2 {
            0 => random_view(&mut rng),
            _ => {
                let mut any = || [0; 3].map(|_| rng.bits() as i32 >> rng.below(32));
                ViewBits::Reference(any(), any(), any())
            }
        };
        let (Ok(ours), exact) = (view.library(), view.exact()) else { continue };
        let (back, up) = match view {
            ViewBits::LookAt(e, t, up) => (core::array::from_fn(|i| f64::from(e[i]) - f64::from(t[i])), up),
            ViewBits::LookAlong(_, gaze, up) => (gaze.map(|c| -f64::from(c)), up),
            ViewBits::Reference(_, n, up) => (n.map(f64::from), up),
        };
        let up = up.map(f64::from);
        let sine = length(cross(back, up)) / (length(back) * length(up));
        let got = linear(&ours.to_matrix());
        let what = "`ViewTransform`: u, v, n, in units of 1 ÷ sine of VUP and VPN";
        errors.add(what, two(-28.0), gap(&got, &exact.rows) * sine);
        // A point of the view as stored.
        let p = [0; 3].map(|_| rng.bits() as i32);
        let wanted = chain::mul3(&got, core::array::from_fn(|i| fx(p[i]) - exact.eye[i]));
        for (got, wanted) in reals(ours.apply(point(p))).iter().zip(wanted) {
            if wanted.abs() < 32_767.0 {
                let what = "`ViewTransform::apply`, the view as stored, in units of 2⁻¹⁶";
                errors.add(what, 0.5 + two(-17.0), (got - wanted).abs() * 65_536.0);
            }
        }
    }
}

/// The largest error of a row's three coefficients, relative to the largest of them. Constants are measured by themselves.
fn projection_error(got: &M4, exact: &M4) -> f64 {
    let mut worst = 0f64;
    for row in [0, 1, 3] {
        let (g, e) = (got[row], exact[row]);
        let scale = e[..3].iter().fold(0f64, |a, c| a.max(c.abs()));
        for i in 0..3 {
            if scale > 0.0 {
                worst = worst.max((g[i] - e[i]).abs() / scale);
            }
        }
    }
    worst
}

/// The error of the coefficient of z in (z + w)/2, the row that the library stores, relative to itself.
fn depth_error(got: &M4, exact: &M4) -> f64 {
    let d = |m: &M4| (m[2][2] + m[3][2]) / 2.0;
    (d(got) / d(exact) - 1.0).abs()
}

/// The matrix times the power of two that the library left out.
fn matched(got: M4, exact: &M4) -> M4 {
    let size = |row: &[f64; 4]| row.iter().fold(0f64, |a, c| a.max(c.abs()));
    let factor = two((size(&exact[3]) / size(&got[3])).log2().round());
    got.map(|row| row.map(|c| c * factor))
}

fn projections(errors: &mut Errors) {
    let mut rng = Rng::new(0x59);
    for _ in 0..100_000 {
        let near = rng.int(1 << 8, 1 << 22) as i32;
        let far = near.saturating_add(rng.int(1 << 10, 1 << 30) as i32);
        let fov = rng.int(1 << 20, (1 << 31) - (1 << 20)) as u32;
        let mut side = || {
            let (low, wide) = (rng.int(-1 << 24, 1 << 24), rng.int(1 << 10, 1 << 24));
            [low, low + wide].map(|c| c as i32)
        };
        let ([l, r], [b, t]) = (side(), side());
        let (s, c) = chain::sin_cos(fov / 2);
        for bits in [
            ProjectionBits::Perspective(fov, (480, 320), near, far),
            ProjectionBits::Frustum([l, r, b, t], near, far),
            ProjectionBits::Orthographic([l, r, b, t], near, far),
        ] {
            let (Ok(ours), exact) = (bits.library(), bits.exact()) else { continue };
            let matrix = matched(ours.to_matrix(), &exact);
            let error = projection_error(&matrix, &exact);
            match bits {
                // Half the sine of the field of view.
                ProjectionBits::Perspective(..) => {
                    let what = "`Projection::perspective`: cot(fov/2), in units of itself ÷ sin(fov)";
                    errors.add(what, two(-27.0), error * 2.0 * s * c);
                }
                _ => errors.add("`Projection::frustum`, `orthographic`", two(-29.0), error),
            }
            let what = "`perspective`, `frustum`, `orthographic`: (z + w)/2, in units of itself";
            errors.add(what, two(-30.0), depth_error(&matrix, &exact));
            for row in [0, 1] {
                let (got, exact) = (matrix[row][3], exact[row][3]);
                let what = "– their constants in x and y, in units of itself and ⅛";
                errors.add(what, two(-30.0), (got - exact).abs() / (exact.abs() + 0.125));
            }
            // A point of the projection as stored.
            let p = [0; 3].map(|_| rng.bits() as i32 >> rng.below(24));
            let wanted = chain::mul4(&matrix, [fx(p[0]), fx(p[1]), fx(p[2]), 1.0]);
            let point = ours.apply(Point3::<View>::new(scalar(p[0]), scalar(p[1]), scalar(p[2])));
            let most = wanted.iter().fold(0f64, |a, c| a.max(c.abs()));
            let [x, y, z, w] = wanted;
            let Some(image) = point else { continue };
            for (got, c) in reals(image).iter().zip([x, y, z]) {
                let exact = c / w;
                if exact.abs() < 32_767.0 {
                    // Beyond the half step of the result: the errors of c and w, each in units of largest of x, y, z, w, and 2.
                    let off = ((got - exact).abs() - two(-17.0)) * w / ((1.0 + exact.abs()) * (most + 2.0));
                    errors.add("`Projection::apply`, the matrix as stored", two(-30.0), off);
                }
            }
        }
        // A box whose depth recedes.
        let (angle, factor) = (rng.bits(), rng.bits() as i32 >> (8 + rng.below(8)));
        let oblique = ProjectionBits::Oblique([l, r, b, t], near, far, angle, factor);
        let exact = oblique.exact();
        let ours = matched(oblique.library().map(|p| p.to_matrix()).unwrap_or_default(), &exact);
        let what = "`Projection::oblique`, in units of row's largest coefficient × (1 + factor)";
        errors.add(what, two(-29.0), projection_error(&ours, &exact) / (1.0 + fx(factor).abs()));
        // Any matrix at all.
        let far_off = two(rng.real(0.0, 30.0));
        let any: M4 = [[0.0; 4]; 4].map(|row| row.map(|_| rng.real(-1.0, 1.0)));
        let any = any.map(|[x, y, z, w]| [x, y, z, w * far_off]);
        let ours = Projection::from_matrix(&any).map(|p| p.to_matrix()).unwrap_or_default();
        let ours = matched(ours, &any);
        errors.add("`Projection::from_matrix`", two(-30.0), projection_error(&ours, &any));
        let coefficient = any.iter().flat_map(|row| &row[..3]).fold(0f64, |a, c| a.max(c.abs()));
        let constant = any.iter().fold(0f64, |a, row| a.max(row[3].abs()));
        for row in [0, 1, 3] {
            let error = (ours[row][3] - any[row][3]).abs();
            let what = "– its constants, in units of largest coefficient, or 2⁻¹⁶ of the largest constant";
            errors.add(what, two(-42.0), error / coefficient.max(constant / 65_536.0));
        }
    }
}

fn planes(errors: &mut Errors) {
    let mut rng = Rng::new(0x5C);
    for _ in 0..200_000 {
        // The projector through the point, cut by the plane z = z_p.
        let z_p = rng.int(-20 << 16, 20 << 16) as i32;
        let q = rng.int(1 << 16, 200 << 16) as i32;
        let d = random_axis(&mut rng);
        let p = [0; 3].map(|_| rng.bits() as i32 >> (5 + rng.below(10)));
        let unit = normalise(fx3(d));
        if unit[2].abs() < 1e-3 {
            continue;
        }
        let (c, at) = ([0, 1, 2].map(|i| fx(q) * unit[i] + [0.0, 0.0, fx(z_p)][i]), fx3(p));
        // Without a centre the projectors are parallel.
        let away = (c[2] - at[2]) / (c[2] - fx(z_p));
        for (q, along, w) in [(Some(q), [0, 1, 2].map(|i| at[i] - c[i]), away), (None, unit, 1.0)] {
            let cut = |i: usize| at[i] + along[i] * (fx(z_p) - at[2]) / along[2];
            let size = [at[0], at[1], at[2], fx(z_p), cut(0), cut(1)];
            let size = size.into_iter().fold(0f64, |a, b| a.max(b.abs()));
            if size >= 32_767.0 {
                continue;
            }
            // A window of −1 … 1 shows the plane's own coordinates; near and far lie a step in front of the plane and behind it.
            let square = window([-1 << 16, 1 << 16, -1 << 16, 1 << 16]);
            let (near, far) = (scalar(-z_p - 1), scalar(-z_p + 1));
            let lens = Projection::planar(scalar(z_p), q.map(scalar), vector(d), square, near, far);
            let Ok(lens) = lens else { continue };
            let [x, y, _, z] = chain::mul4(&lens.to_matrix(), [at[0], at[1], at[2], 1.0]);
            for (got, wanted) in [x / z, y / z].iter().zip([cut(0), cut(1)]) {
                let what = "`Projection::planar`, in units of largest of point, plane and image, ÷ (w · dz)";
                errors.add(what, two(-28.0), (got - wanted).abs() / (size / (w * unit[2]).abs()));
            }
        }
    }
    for _ in 0..30_000 {
        // The vanishing point of a world axis, and how far it moves when the axis turns.
        let bits = CameraBits {
            view: random_view(&mut rng),
            projection: ProjectionBits::Perspective(
                rng.int(310_189_739, 1_431_655_765) as u32,
                (480, 320),
                1 << 16,
                1 << 20,
            ),
            viewport: (0, 0, 480, 320),
        };
        let exact = bits.exact();
        let focal = exact.projection[1][1] * 160.0;
        for (axis, found) in bits.library().vanishing_points().into_iter().enumerate() {
            let [x, y, z] = exact.view.rows.map(|row| row[axis]);
            let Some(found) = found else { continue };
            let (wx, wy) = (240.0 - focal * x / z, 160.0 + focal * y / z);
            if wx.abs().max(wy.abs()) < 4e6 {
                let [x, y] = found.map(|c| f64::from(c) / 256.0);
                let off = (x - wx).abs().max((y - wy).abs());
                let what = "`Camera::vanishing_points`, beyond 1/512 px, in units of how far it moves when the axis turns by 1 rad";
                errors.add(what, two(-28.0), (off - 1.0 / 512.0) * z * z / focal);
            }
        }
    }
}

/// View to canonical coordinates, by the geometry of the volume; beside them the size of what is added up.
fn canonical(p: V3, prp: V3, window: [f64; 4], (front, back): (f64, f64), parallel: bool) -> [(f64, f64); 3] {
    let depth = if parallel { front - back } else { prp[2] - back };
    let side = |i: usize, low: f64, high: f64| {
        // The centre line runs from the PRP through the window's centre at n = 0.
        let centre = (low + high) / 2.0;
        let slope = (prp[i] - centre) / prp[2];
        let line = centre + slope * p[2];
        let scale = if parallel { 2.0 / (high - low) } else { 2.0 * prp[2] / (high - low) / depth };
        let reach = slope.abs().max(1.0) * p[2].abs().max(p[i].abs());
        ((p[i] - line) * scale, reach.max(centre.abs()) * scale)
    };
    let from = if parallel { front } else { prp[2] };
    let z = ((p[2] - from) / depth, p[2].abs().max(from.abs()) / depth);
    [side(0, window[0], window[1]), side(1, window[2], window[3]), z]
}

fn volumes(errors: &mut Errors) {
    let mut rng = Rng::new(0x5D);
    for k in 0..200_000 {
        let any = |rng: &mut Rng| rng.bits() as i32 >> (6 + rng.below(10));
        let prp = [any(&mut rng), any(&mut rng), rng.int(1 << 8, 1 << 24) as i32];
        let front = prp[2] - rng.int(1, 1 << 20) as i32;
        let back = front - rng.int(1 << 8, 1 << 24) as i32;
        let (l, b) = (any(&mut rng), any(&mut rng));
        let w = [l, l + rng.int(1 << 8, 1 << 24) as i32, b, b + rng.int(1 << 8, 1 << 24) as i32];
        let parallel = k % 2 == 0;
        let (at, area, f, to) = (point(prp), window(w), scalar(front), scalar(back));
        let ours = match parallel {
            true => Projection::parallel_from_reference(at, area, f, to),
            false => Projection::perspective_from_reference(at, area, f, to),
        };
        let Ok(ours) = ours else { continue };
        let p = [any(&mut rng), any(&mut rng), any(&mut rng)];
        let wanted = canonical(fx3(p), fx3(prp), w.map(fx), (fx(front), fx(back)), parallel);
        // The rows x and y, and −z: of a parallel volume from (z + w)/2, of a perspective w. Both have a factor in common.
        let matrix = ours.to_matrix();
        let [x, y, z, w] = chain::mul4(&matrix, [fx(p[0]), fx(p[1]), fx(p[2]), 1.0]);
        let (unit, depth) = match parallel {
            true => (matrix[3][3], (z + w) / 2.0),
            false => (-matrix[3][2] * fx(prp[2] - back), w),
        };
        for (got, (wanted, size)) in [x, y, -depth].map(|c| c / unit).iter().zip(wanted) {
            if wanted.abs() < 32_767.0 {
                let what = "`Projection::perspective_from_reference`, `parallel_from_reference`";
                errors.add(what, two(-28.0), (got - wanted).abs() / (size + 0.125));
            }
        }
    }
}

fn viewports(errors: &mut Errors) {
    let mut rng = Rng::new(0x5A);
    for _ in 0..200_000 {
        let (x, y) = (rng.int(-8192, 8000) as i32, rng.int(-8192, 8000) as i32);
        let (w, h) = (rng.int(1, i64::from(8192 - x)) as u32, rng.int(1, i64::from(8192 - y)) as u32);
        let Ok(viewport) = Viewport::new(Point::new(x, y), Size::new(w, h)) else { continue };
        let p = [0; 3].map(|_| rng.int(-65_536, 65_536) as i32);
        let got = viewport.apply(point(p));
        let (ex, ey) = chain::Viewport::new(x, y, w, h).apply(fx3(p));
        let off = (f64::from(got.x()) - ex * 256.0).abs().max((f64::from(got.y()) - ey * 256.0).abs());
        errors.add("`Viewport::apply`, in units of 1/256 px", 0.5, off);
    }
}
