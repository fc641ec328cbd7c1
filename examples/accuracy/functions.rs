//! The numeric functions one by one: the largest error over seeded inputs, against f64 or exact integers, and
//! the bound that their documentation states. `tests/bounds.rs` asserts each of them.

use crate::bridge::pair::{random_view, ModelBits, ProjectionBits, Step};
use crate::bridge::{point, scalar, vector};
use crate::num;
use crate::oracle::chain::{self, cross, dot, fx, fx3, length, normalise, M3, M4, V3};
use crate::oracle::rng::Rng;
use crate::unit;
use pinhole::space::{Model, World};
use pinhole::{Affine, Angle, Projection, Quaternion};

/// What a bound is and what was found.
pub(crate) struct Measured {
    pub(crate) what: &'static str,
    /// Of what the error is a part.
    pub(crate) unit: &'static str,
    pub(crate) error: f64,
    pub(crate) bound: f64,
    /// The test in `tests/bounds.rs`.
    pub(crate) test: &'static str,
    /// Why the bound is more than twice the error, where it is.
    pub(crate) slack: Option<&'static str>,
}

impl Measured {
    fn new(what: &'static str, unit: &'static str, error: f64, bound: f64, test: &'static str) -> Self {
        Self { what, unit, error, bound, test, slack: None }
    }
}

fn two(power: f64) -> f64 {
    power.exp2()
}

/// A 2⁻³⁰ integer as a number.
fn q30(v: i32) -> f64 {
    f64::from(v) / 1_073_741_824.0
}

pub(crate) fn sines() -> [Measured; 3] {
    let mut rng = Rng::new(0x51);
    let (mut worst, mut circle, mut quarters) = (0f64, 0f64, 0f64);
    for k in 0..1u32 << 22 {
        // Every table angle and its neighbours, the half ways between them, and any.
        let near = ((k >> 4) % 512) << 23;
        let angle = match k % 16 {
            0 => near,
            1 => near.wrapping_add(rng.bits() >> 20),
            2 => near.wrapping_sub(rng.bits() >> 20),
            _ => rng.bits(),
        };
        let (s, c) = Angle::from_bits(angle).sin_cos();
        let (es, ec) = chain::sin_cos(angle);
        worst = worst.max((q30(s) - es).abs()).max((q30(c) - ec).abs());
        // Exact: 62 bits.
        let square = i64::from(s) * i64::from(s) + i64::from(c) * i64::from(c);
        circle = circle.max((square - (1 << 60)).unsigned_abs() as f64 / two(60.0));
    }
    for k in 0..4 {
        let (s, c) = Angle::turns(k, 4).sin_cos();
        let (es, ec) = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][k as usize];
        quarters = quarters.max((q30(s) - es).abs()).max((q30(c) - ec).abs());
    }
    let test = "e7_sine_and_cosine";
    [
        Measured::new("`Angle::sin_cos`, and so `rotation_x`, `_y`, `_z`", "1", worst, two(-29.5), test),
        Measured::new("– at the quarter turns", "1", quarters, 0.0, test),
        Measured::new("– sin² + cos² against 1", "1", circle, two(-28.0), test),
    ]
}

pub(crate) fn angles() -> [Measured; 2] {
    let mut rng = Rng::new(0x52);
    let (mut turns, mut floats) = (0f64, 0f64);
    let full = 4_294_967_296.0;
    for _ in 0..1 << 18 {
        let (n, d) = (rng.bits() as i32 >> rng.below(31), (rng.bits() >> rng.below(31)).max(1));
        // Exactly: what is missing to n·2³² is at most half of d.
        let got = i128::from(Angle::turns(n, d).bits()) * i128::from(d);
        let off = ((i128::from(n) << 32) - got).rem_euclid(i128::from(d) << 32);
        turns = turns.max(off.min((i128::from(d) << 32) - off) as f64 / f64::from(d));
        let degrees = rng.real(-1_048_576.0, 1_048_576.0) as f32 / (1u32 << rng.below(21)) as f32;
        let got = Angle::from_degrees_f32(degrees).map_or(f64::NAN, |a| f64::from(a.bits()));
        let off = (f64::from(degrees) * full / 360.0 - got).rem_euclid(full);
        floats = floats.max(off.min(full - off));
    }
    let test = "e7_angles";
    [
        Measured::new("`Angle::turns`, `Angle::degrees`", "2⁻³² turn", turns, 0.5, test),
        Measured::new("`Angle::from_degrees_f32`", "2⁻³² turn", floats, 0.5 + two(-10.0), test),
    ]
}

pub(crate) fn reciprocals() -> [Measured; 1] {
    let mut worst = 0f64;
    let mut check = |v: i32| {
        let r = num::reciprocal(v);
        let got = f64::from(r.mantissa) * two(f64::from(r.shift) - 61.0);
        worst = worst.max((got * f64::from(v) - 1.0).abs());
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
    [Measured::new("reciprocal (1/w)", "itself", worst, two(-28.0), "e8_reciprocal")]
}

pub(crate) fn roots() -> [Measured; 1] {
    let mut rng = Rng::new(0x53);
    let mut worst = 0f64;
    let mut check = |v: u64| {
        // √v − r = (v − r²)/(√v + r), the numerator exact.
        let r = num::sqrt(v);
        let off = i128::from(v) - i128::from(r) * i128::from(r);
        if v > 0 {
            worst = worst.max((off as f64 / ((v as f64).sqrt() + f64::from(r))).abs());
        }
    };
    for k in 0..64 {
        for _ in 0..2000 {
            check((rng.next() >> k).min(u64::MAX - (1 << 32)));
        }
    }
    // On both sides of where the rounding turns.
    for _ in 0..100_000 {
        let r = u64::from(rng.bits() >> rng.below(31)).min(u64::from(u32::MAX) - 1);
        check(r * r + r);
        check(r * r + r + 1);
    }
    [Measured::new("square root", "1", worst, 0.5, "square_root")]
}

fn unit_vector_error(v: [i64; 3]) -> f64 {
    let real = v.map(|c| c as f64);
    let exact = normalise(real);
    let got = unit::normalise(v).unwrap_or_default();
    (0..3).map(|i| (q30(got[i]) - exact[i]).abs()).fold(0.0, f64::max)
}

pub(crate) fn unit_vectors() -> [Measured; 1] {
    let mut rng = Rng::new(0x54);
    let mut worst = 0f64;
    for k in 0..400_000 {
        let v = match k % 3 {
            0 => [0; 3].map(|_| rng.int(-1000, 1000)),
            1 => [0; 3].map(|_| rng.next() as i64 >> (2 + rng.below(60))),
            _ => [0; 3].map(|_| rng.next() as i64 >> 20),
        };
        if v != [0; 3] {
            worst = worst.max(unit_vector_error(v));
        }
    }
    [Measured::new("unit vectors (`Viewing`, `Lambert`, axes)", "1", worst, two(-30.0), "e4_unit_vectors")]
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
        core::array::from_fn(|j| {
            c * f64::from(u8::from(i == j)) + (1.0 - c) * a[i] * a[j] + s * across[i][j]
        })
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

pub(crate) fn rotations() -> [Measured; 3] {
    let mut rng = Rng::new(0x55);
    let (mut about, mut quaternion, mut shift) = (0f64, 0f64, 0f64);
    for k in 0..300_000 {
        let (axis, angle) = (random_axis(&mut rng), rng.bits());
        let through = [0; 3].map(|_| rng.bits() as i32 >> 1);
        let turn = Affine::<Model, World>::rotation(point(through), vector(axis), Angle::from_bits(angle));
        let (got, exact) = (turn.map(|t| t.to_matrix()).unwrap_or_default(), rodrigues(fx3(axis), angle));
        about = about.max(gap(&linear(&got), &exact));
        // The translation follows from the matrix: through − R·through, R as it is.
        for (row, at) in got.iter().zip(through) {
            let wanted = fx(at) - dot([row[0], row[1], row[2]], fx3(through));
            shift = shift.max((row[3] - wanted).abs());
        }
        let q = if k % 2 == 0 {
            [0; 4].map(|_| rng.bits() as i32)
        } else {
            [0; 4].map(|_| rng.int(-3, 3) as i32)
        };
        let [w, x, y, z] = q.map(scalar);
        let Ok(quaternion_of) = Quaternion::new(w, x, y, z) else { continue };
        let got = linear(&Affine::<Model, World>::from_quaternion(quaternion_of).to_matrix());
        let q = q.map(f64::from);
        let n = q.iter().map(|c| c * c).sum::<f64>();
        let [w, x, y, z] = q;
        // The sandwich product of the unscaled quaternion over its norm.
        let exact = [
            [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
        .map(|row| row.map(|c| c / n));
        quaternion = quaternion.max(gap(&got, &exact));
    }
    [
        Measured::new("`Affine::rotation` about any line", "1", about, two(-28.0), "s2_rotations"),
        Measured::new("– its translation, given its rotation", "1", shift, two(-31.0), "s2_rotations"),
        Measured::new("`Affine::from_quaternion`", "1", quaternion, two(-27.0), "s2_rotations"),
    ]
}

/// A rotation by three angles, as f64 has it.
fn any_turn(rng: &mut Rng) -> M3 {
    ModelBits(vec![Step::X(rng.bits()), Step::Y(rng.bits()), Step::Z(rng.bits())]).exact().m
}

fn transposed(m: &M3) -> M3 {
    core::array::from_fn(|i| core::array::from_fn(|j| m[j][i]))
}

pub(crate) fn compositions() -> [Measured; 4] {
    let mut rng = Rng::new(0x56);
    let (mut then, mut inverse, mut rigid, mut door) = (0f64, 0f64, 0f64, 0f64);
    for _ in 0..100_000 {
        // Two matrices of any size.
        let mut any = || {
            let stretch = rng.log(1e-3, 1e3);
            let m: M3 = [[0.0; 3]; 3].map(|row| row.map(|_| stretch * rng.real(-1.0, 1.0)));
            let t: V3 = [0.0; 3].map(|_| rng.real(-1000.0, 1000.0));
            let rows: M4 = core::array::from_fn(|i| match m.get(i) {
                Some(row) => [row[0], row[1], row[2], t[i]],
                None => [0.0, 0.0, 0.0, 1.0],
            });
            let ours = Affine::<World, World>::from_matrix(&rows).unwrap_or(Affine::identity());
            door = door.max(gap(&linear(&ours.to_matrix()), &m) / largest(&m));
            ours
        };
        let (a, b) = (any(), any());
        // The exact product of the two as they are.
        let exact = chain::matmul3(&linear(&b.to_matrix()), &linear(&a.to_matrix()));
        then = then.max(gap(&linear(&a.then(&b).to_matrix()), &exact) / largest(&exact));
        // U·S·V with known stretches: the inverse is Vᵀ·S⁻¹·Uᵀ.
        let size = rng.log(0.01, 100.0);
        let stretches = [size, size * rng.log(1.0, 30.0), size * rng.log(1.0, 30.0)];
        let least = stretches.iter().fold(f64::MAX, |a, &b| a.min(b));
        let most = stretches.iter().fold(0.0f64, |a, &b| a.max(b));
        let (u, v) = (any_turn(&mut rng), any_turn(&mut rng));
        let scaled = |m: &M3, by: V3| -> M3 {
            core::array::from_fn(|i| core::array::from_fn(|j| by[i] * m[i][j]))
        };
        let there = chain::matmul3(&u, &scaled(&v, stretches));
        let back = chain::matmul3(&transposed(&v), &scaled(&transposed(&u), stretches.map(|s| 1.0 / s)));
        let rows: M4 = core::array::from_fn(|i| match there.get(i) {
            Some(row) => [row[0], row[1], row[2], 0.0],
            None => [0.0, 0.0, 0.0, 1.0],
        });
        let ours = Affine::<Model, World>::from_matrix(&rows).unwrap_or(Affine::identity());
        let got = ours.inverse().map(|i| i.to_matrix()).unwrap_or_default();
        inverse = inverse.max(gap(&linear(&got), &back) / largest(&back) / (most / least));
        let turn = ModelBits(vec![Step::X(rng.bits()), Step::Y(rng.bits()), Step::Z(rng.bits())]).library();
        let got = turn.rigid_inverse().map(|i| i.to_matrix()).unwrap_or_default();
        rigid = rigid.max(gap(&linear(&got), &transposed(&linear(&turn.to_matrix()))));
    }
    let of = "the largest coefficient";
    let test = "s2_compositions_and_inverses";
    [
        Measured::new("`Affine::then`", of, then, two(-30.0), test),
        Measured::new("`Affine::from_matrix`", of, door, two(-30.0), test),
        Measured::new(
            "`Affine::inverse`",
            "the largest coefficient × the ratio of stretches",
            inverse,
            two(-26.0),
            test,
        ),
        Measured::new("`Affine::rigid_inverse`, the rotation", "1", rigid, 0.0, test),
    ]
}

pub(crate) fn normals() -> [Measured; 1] {
    let mut rng = Rng::new(0x57);
    let mut worst = 0f64;
    for _ in 0..200_000 {
        let turns = (any_turn(&mut rng), any_turn(&mut rng));
        let s = [0; 3].map(|_| rng.log(0.1, 10.0));
        let m: M3 = chain::matmul3(
            &turns.0,
            &core::array::from_fn(|i| core::array::from_fn(|j| s[i] * turns.1[i][j])),
        );
        let rows: M4 = core::array::from_fn(|i| match m.get(i) {
            Some(row) => [row[0], row[1], row[2], 0.0],
            None => [0.0, 0.0, 0.0, 1.0],
        });
        let ours = Affine::<Model, World>::from_matrix(&rows).unwrap_or(Affine::identity());
        let n = rng.direction().map(|c| (c * 32_767.0).round() as i16);
        let cofactors = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
        let exact = normalise(chain::mul3(&cofactors, n.map(f64::from)));
        let got = ours.normals().apply(n);
        for (got, exact) in got.iter().zip(exact) {
            worst = worst.max((f64::from(*got) / 32_768.0 - exact).abs());
        }
    }
    // +1 itself has no place in 2⁻¹⁵.
    let ours = Affine::<Model, World>::identity().normals().apply([0, 0, i16::MAX]);
    worst = worst.max((f64::from(ours[2]) / 32_768.0 - 1.0).abs());
    [Measured::new("`NormalMap::apply`", "1", worst, two(-15.0), "s2_normals")]
}

pub(crate) fn views() -> [Measured; 2] {
    let mut rng = Rng::new(0x58);
    let (mut rows, mut column) = (0f64, 0f64);
    for k in 0..200_000 {
        let view = random_view(&mut rng);
        let (Ok(ours), exact) = (view.library(), view.exact()) else { continue };
        // The angle between VPN and VUP, from the view as given.
        let (back, up) = match view {
            crate::bridge::pair::ViewBits::LookAt(e, t, up) => {
                (core::array::from_fn(|i| f64::from(e[i]) - f64::from(t[i])), up)
            }
            crate::bridge::pair::ViewBits::LookAlong(_, g, up) => (g.map(|c| -f64::from(c)), up),
            crate::bridge::pair::ViewBits::Reference(_, n, up) => (n.map(f64::from), up),
        };
        let up = up.map(f64::from);
        let sine = length(cross(back, up)) / (length(back) * length(up));
        let got = linear(&ours.to_matrix());
        rows = rows.max(gap(&got, &exact.rows) * sine);
        if k % 4 == 0 {
            for (got, row) in ours.translation().iter().zip(exact.rows) {
                column = column.max((*got as f64 / 4_294_967_296.0 + dot(row, exact.eye)).abs());
            }
        }
    }
    let test = "s3_views";
    [
        Measured::new("`Viewing`, u, v, n", "1 ÷ sine of the angle of VUP and VPN", rows, two(-28.0), test),
        Measured::new("`Viewing::translation`", "1", column, two(-13.0), test),
    ]
}

/// The coefficients of each row against the largest of the row's three, and the constant against itself.
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

/// (z + w)/2, which the library keeps: its coefficient of z against itself.
fn depth_error(got: &M4, exact: &M4) -> f64 {
    let d = |m: &M4| (m[2][2] + m[3][2]) / 2.0;
    (d(got) / d(exact) - 1.0).abs()
}

/// The matrix times what brings w's row to the exact one's size.
fn matched(got: M4, w: f64) -> M4 {
    let own = got[3].iter().fold(0f64, |a, c| a.max(c.abs()));
    got.map(|row| row.map(|c| c * w / own))
}

pub(crate) fn projections() -> [Measured; 4] {
    let mut rng = Rng::new(0x59);
    let mut worst = [0f64; 4];
    let size = (480, 320);
    for _ in 0..100_000 {
        let near = rng.int(1 << 8, 1 << 22) as i32;
        let far = near.saturating_add(rng.int(1 << 10, 1 << 30) as i32);
        let fov = rng.int(1 << 20, (1 << 31) - (1 << 20)) as u32;
        let (low, wide) = (rng.int(-1 << 24, 1 << 24), rng.int(1 << 10, 1 << 24));
        let (below, high) = (rng.int(-1 << 24, 1 << 24), rng.int(1 << 10, 1 << 24));
        let window = [low, low + wide, below, below + high].map(|c| c as i32);
        let (s, c) = chain::sin_cos(fov / 2);
        let cases = [
            (ProjectionBits::Perspective(fov, size, near, far), 0),
            (ProjectionBits::Frustum(window, near, far), 1),
            (ProjectionBits::Orthographic(window, near, far), 1),
        ];
        for (bits, k) in cases {
            let (Ok(ours), exact) = (bits.library(), bits.exact()) else { continue };
            let got = matched(ours.to_matrix(), 1.0);
            // A field of view's cotangent is as good as its sine and cosine.
            let allowance = if k == 0 { s * c } else { 1.0 };
            worst[k] = worst[k].max(projection_error(&got, &exact) * allowance);
            worst[2] = worst[2].max(depth_error(&got, &exact));
        }
        // Any matrix: each row against its own largest.
        let any: M4 = [[0.0; 4]; 4].map(|row| row.map(|_| rng.real(-1.0, 1.0)));
        if let Ok(ours) = Projection::from_matrix(&any) {
            let w = any[3].iter().fold(0f64, |a, c| a.max(c.abs()));
            let got = matched(ours.to_matrix(), w);
            worst[3] = worst[3].max(projection_error(&got, &any));
        }
    }
    let test = "s4_projections";
    let own = "the row's largest coefficient";
    [
        Measured::new(
            "`Projection::perspective`, cot(fov/2)",
            "itself ÷ (sine · cosine of fov/2)",
            worst[0],
            two(-29.0),
            test,
        ),
        Measured::new("`Projection::frustum`, `orthographic`", own, worst[1], two(-29.0), test),
        Measured::new("– and their (z + w)/2", "itself", worst[2], two(-29.0), test),
        Measured::new("`Projection::from_matrix`", own, worst[3], two(-29.0), test),
    ]
}

/// All of them, in the page's order.
pub(crate) fn all() -> Vec<Measured> {
    let mut all = Vec::new();
    all.extend(sines());
    all.extend(angles());
    all.extend(reciprocals());
    all.extend(roots());
    all.extend(unit_vectors());
    all.extend(rotations());
    all.extend(compositions());
    all.extend(normals());
    all.extend(views());
    all.extend(projections());
    all
}

