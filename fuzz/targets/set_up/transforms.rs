//! Affine transforms: chains, rotations, inverses, each within an error that follows from the documented
//! rounding of its parts.

use super::views::triple;
use crate::bridge::pair::{ModelBits, Step, ONE};
use crate::bridge::{point, reals, scalar, vector};
use crate::bytes::Bytes;
use crate::oracle::chain::{self, cross, dot, fx3, length, M3, V3};
use pinhole::space::{Model, World};
use pinhole::{Affine, Angle, AxisError, InverseError, MatrixError, Quaternion, QuaternionError};

pub(crate) fn angle(b: &mut Bytes<'_>) -> u32 {
    match b.byte() {
        k @ 0..=127 => u32::from(k) << 27,
        k @ 128..=191 => (u32::from(k) << 29).wrapping_add(b.i8() as u32),
        _ => b.u32(),
    }
}

pub(crate) fn turn(b: &mut Bytes<'_>) -> Step {
    match b.byte() % 3 {
        0 => Step::X(angle(b)),
        1 => Step::Y(angle(b)),
        _ => Step::Z(angle(b)),
    }
}

/// Up to `most` steps of any kind.
pub(crate) fn steps(b: &mut Bytes<'_>, most: usize) -> ModelBits {
    let count = b.below(most + 1);
    let step = |b: &mut Bytes<'_>| match b.byte() {
        0..=95 => turn(b),
        96..=159 => Step::Move(triple(b, [ONE; 3])),
        160..=191 => Step::Scale([b.wild(); 3]),
        192..=223 => Step::Scale([0; 3].map(|_| b.i8() as i32 * ONE / 16)),
        _ => Step::Scale(triple(b, [ONE; 3])),
    };
    ModelBits((0..count).map(|_| step(b)).collect())
}

fn largest(v: impl IntoIterator<Item = f64>) -> f64 {
    v.into_iter().fold(0.0, |m, c| c.abs().max(m))
}

/// A chain so far and how far the library's may be off: its coefficients, and its translation.
struct Chain {
    exact: chain::Affine,
    linear: f64,
    offset: f64,
}

impl Chain {
    /// One more step: `error` of each of its coefficients. The product is rounded to 2⁻³¹ of its largest
    /// coefficient, which is at most what the bounds give, and the translation to 2⁻³³.
    fn then(&self, step: &chain::Affine, error: f64) -> Self {
        let (b, a) = (largest(step.m.into_iter().flatten()), largest(self.exact.m.into_iter().flatten()));
        let exact = self.exact.then(step);
        let linear = 3.0 * (b * self.linear + error * (a + self.linear));
        let reach = largest(exact.m.into_iter().flatten()) + linear;
        let offset = 3.0 * (b * self.offset + error * (largest(self.exact.t) + self.offset));
        Self { exact, linear: linear + reach * 2f64.powi(-30), offset: offset + 2f64.powi(-30) }
    }

    /// Of an image within ±32768.
    fn error(&self, p: V3) -> f64 {
        let f64s = 2f64.powi(-48)
            * (largest(self.exact.m.into_iter().flatten()) * largest(p) + largest(self.exact.t));
        3.0 * self.linear * largest(p) + self.offset + 2f64.powi(-17) + f64s
    }
}

/// Each coordinate within `error`, or saturated where the exact one is out of range.
fn close(got: V3, wanted: V3, error: f64, what: &dyn core::fmt::Debug) {
    for (got, wanted) in got.into_iter().zip(wanted) {
        let wanted = wanted.clamp(-32_768.0, 32_768.0);
        assert!(
            (got - wanted).abs() <= error + 2f64.powi(-16),
            "{got} for {wanted}, {error} allowed: {what:?}"
        );
    }
}

pub(crate) fn chain(b: &mut Bytes<'_>) {
    let steps = steps(b, 4);
    let ours = steps.library();
    let p = triple(b, [ONE; 3]);
    let mut so_far = Chain { exact: chain::IDENTITY, linear: 0.0, offset: 0.0 };
    for step in &steps.0 {
        let one = ModelBits(vec![*step]).exact();
        let error = match step {
            Step::X(_) | Step::Y(_) | Step::Z(_) => 2f64.powf(-29.5),
            Step::Scale(_) => largest(one.m.into_iter().flatten()) * 2f64.powi(-30),
            Step::Move(_) => 0.0,
        };
        so_far = so_far.then(&one, error);
        if largest(so_far.exact.t) + so_far.offset > 2f64.powi(29) {
            return; // translations saturate at 2³⁰
        }
    }
    let so_far = so_far.then(&chain::IDENTITY, 0.0);
    let got = ours.apply(point::<Model>(p));
    let at = so_far.exact.apply(fx3(p));
    if largest(so_far.exact.m.into_iter().flatten()) * largest(fx3(p)) < 2f64.powi(27) {
        close(reals(got), at, so_far.error(fx3(p)), &steps);
    }
}

pub(crate) fn rotation(b: &mut Bytes<'_>) {
    let (through, axis, angle) = (triple(b, [ONE; 3]), triple(b, [ONE; 3]), angle(b));
    let got = match Affine::<World, World>::rotation(point(through), vector(axis), Angle::from_bits(angle)) {
        Err(error) => return assert!(error == AxisError::ZeroAxis && axis == [0; 3]),
        Ok(got) => got,
    };
    assert!(axis != [0; 3]);
    let p = fx3(triple(b, through));
    let bits = p.map(|c| (c * 65_536.0) as i32);
    // Rodrigues.
    let (s, c) = chain::sin_cos(angle);
    let k = chain::normalise(axis.map(f64::from));
    let away: V3 = core::array::from_fn(|i| p[i] - fx3(through)[i]);
    let (side, along) = (cross(k, away), dot(k, away));
    let wanted =
        core::array::from_fn(|i| fx3(through)[i] + away[i] * c + side[i] * s + k[i] * along * (1.0 - c));
    // Three coefficients within 2⁻²⁸; the fixed point is brought back by the same ones.
    let error = 3.0 * 2f64.powi(-28) * (largest(p) + largest(fx3(through))) + 2f64.powi(-17);
    close(reals(got.apply(point(bits))), wanted, error, &(through, axis, angle));
}

pub(crate) fn quaternion(b: &mut Bytes<'_>) {
    let parts =
        if b.byte() & 1 == 0 { [0; 4].map(|_| b.wild()) } else { [0; 4].map(|_| b.i8() as i32 * ONE / 16) };
    let [w, x, y, z] = parts.map(scalar);
    let got = match Quaternion::new(w, x, y, z) {
        Err(error) => return assert!(error == QuaternionError::Zero && parts == [0; 4]),
        Ok(got) => Affine::<Model, World>::from_quaternion(got),
    };
    assert!(parts != [0; 4]);
    let norm = parts.map(|c| f64::from(c).powi(2)).iter().sum::<f64>().sqrt();
    let [w, x, y, z] = parts.map(|c| f64::from(c) / norm);
    let p = triple(b, [ONE; 3]);
    let at = fx3(p);
    // p + 2w(v × p) + 2v × (v × p)
    let v = [x, y, z];
    let once = cross(v, at);
    let twice = cross(v, once);
    let wanted = core::array::from_fn(|i| at[i] + 2.0 * (w * once[i] + twice[i]));
    close(reals(got.apply(point(p))), wanted, 3.0 * 2f64.powi(-27) * largest(at) + 2f64.powi(-17), &parts);
    // A rotation has a rigid inverse.
    assert!(got.rigid_inverse().is_ok());
}

/// A frame whose axes span at most 30 bits, so that it is exact, and its inverses.
pub(crate) fn inverse(b: &mut Bytes<'_>) {
    let narrow = b.byte();
    let axis = |b: &mut Bytes<'_>, i: usize| {
        let mut axis = triple(b, [ONE; 3]).map(|c| c >> 1);
        if narrow & 3 == 0 {
            // Nearly a unit axis.
            axis = axis.map(|c| c >> 27);
            axis[i] += ONE;
        }
        axis
    };
    let axes = [axis(b, 0), axis(b, 1), axis(b, 2)];
    let origin = triple(b, [ONE; 3]);
    let frame =
        Affine::<Model, World>::from_frame(vector(axes[0]), vector(axes[1]), vector(axes[2]), point(origin));
    // The axes are columns.
    let m: [[i128; 3]; 3] = core::array::from_fn(|i| core::array::from_fn(|j| axes[j][i].into()));
    let part = |a: [i128; 3], b: [i128; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let cofactors = [part(m[1], m[2]), part(m[2], m[0]), part(m[0], m[1])];
    let det: i128 = (0..3).map(|k| m[0][k] * cofactors[0][k]).sum(); // < 2⁹³
    let lengths = m.map(|row| length(row.map(|c| c as f64)));
    let volume = lengths.iter().product::<f64>();
    let flatness = if volume > 0.0 { det.unsigned_abs() as f64 / volume } else { 0.0 };
    let (long, short) = (largest(lengths), lengths.iter().copied().fold(f64::INFINITY, f64::min));
    // Lengths are rounded to 2⁻²⁹ of the largest coefficient, and cofactors to 2⁻³⁰ of the largest one.
    let blur = 8.0 * 2f64.powi(-29) * long / short.max(1e-9);
    let bound = 2f64.powi(-24);
    let back = match frame.inverse() {
        Err(error) => {
            assert_eq!(error, InverseError::Singular);
            return assert!(flatness <= bound * (1.0 + blur) + blur, "{axes:?}");
        }
        Ok(back) => back,
    };
    assert!(flatness >= bound * (1.0 - blur) - blur, "{axes:?}");
    if det == 0 {
        return;
    }
    let inverse: M3 =
        core::array::from_fn(|i| core::array::from_fn(|j| cofactors[j][i] as f64 / det as f64 * 65_536.0));
    let frobenius = |m: &M3| m.iter().flatten().map(|c| c * c).sum::<f64>().sqrt();
    let exact: M3 = m.map(|row| row.map(|c| c as f64 / 65_536.0));
    // The condition number is at most the product of the norms. The frame rounds the axes to 2⁻³⁰ of the largest number:
    // where the smallest singular value is not much larger, the inverse belongs to a different matrix.
    let ratio = frobenius(&exact) * frobenius(&inverse);
    let error = 2f64.powi(-26) * ratio * largest(inverse.into_iter().flatten());
    let p = triple(b, origin);
    let (at, o) = (fx3(p), fx3(origin));
    let wanted = chain::mul3(&inverse, core::array::from_fn(|i| at[i] - o[i]));
    let reach = largest(inverse.into_iter().flatten());
    if ratio < 2f64.powi(26) && reach * (largest(at) + largest(o)) < 2f64.powi(27) {
        let error = 3.0 * error * (largest(at) + largest(o)) + 2f64.powi(-17);
        close(reals(back.apply(point(p))), wanted, error, &(axes, origin, p));
    }
    rigid(&frame, m, at, &inverse, o);
}

/// Rigid to 2⁻²⁰: the tolerance goes with the block's exponent, 2⁻²² to 2⁻¹⁸.
fn rigid(frame: &Affine<Model, World>, m: [[i128; 3]; 3], at: V3, inverse: &M3, o: V3) {
    let gram = |i: usize, j: usize| -> f64 {
        let sum: i128 = (0..3).map(|k| m[i][k] * m[j][k]).sum();
        (sum - if i == j { 1 << 32 } else { 0 }) as f64 * 2f64.powi(-32)
    };
    let off = largest((0..9).map(|k| gram(k / 3, k % 3)));
    match frame.rigid_inverse() {
        Err(error) => {
            assert_eq!(error, InverseError::NotRigid);
            assert!(off >= 2f64.powi(-22), "{m:?}");
        }
        Ok(back) => {
            assert!(off <= 2f64.powi(-18), "{m:?}");
            // The transpose is the inverse to as much as the rows are rigid.
            let wanted = chain::mul3(inverse, core::array::from_fn(|i| at[i] - o[i]));
            let error = 3.0 * (2.0 * off + 2f64.powi(-28)) * (largest(at) + largest(o)) + 2f64.powi(-17);
            let bits = at.map(|c| (c * 65_536.0) as i32);
            close(reals(back.apply(point(bits))), wanted, error, &m);
        }
    }
}

/// Any numbers at all; what is accepted is kept to its rounding.
pub(crate) fn matrix(b: &mut Bytes<'_>) {
    let mut m = [[0.0; 4]; 4];
    m[3][3] = 1.0;
    let size = 2f64.powi(b.i8() as i32 / 4);
    for c in m.iter_mut().take(3).flatten() {
        *c = match b.byte() {
            0..=127 => f64::from(b.i16()) * size,
            128..=191 => f64::from(b.wild()) / 65_536.0,
            192..=223 => 0.0,
            _ => b.f64(),
        };
    }
    if b.byte() == 255 {
        m[3][b.below(4)] = b.f64();
    }
    let linear: Vec<f64> = m[..3].iter().flat_map(|row| &row[..3]).copied().collect();
    let shift = [m[0][3], m[1][3], m[2][3]];
    let finite = linear.iter().chain(&shift).all(|c| c.is_finite());
    let far = shift.iter().any(|c| c.abs() > 2f64.powi(30));
    match Affine::<Model, World>::from_matrix(&m) {
        Err(MatrixError::NotAffine) => assert!(m[3] != [0.0, 0.0, 0.0, 1.0], "{m:?}"),
        Err(MatrixError::OutOfRange) => assert!(far, "{m:?}"),
        Err(MatrixError::NotFinite) => assert!(!finite, "{m:?}"),
        Err(other) => panic!("{other:?}: {m:?}"),
        Ok(affine) => {
            assert!(m[3] == [0.0, 0.0, 0.0, 1.0] && finite && !far, "{m:?}");
            let back = affine.to_matrix();
            let limit = linear.iter().fold(0f64, |a, c| a.max(c.abs())) * 2f64.powi(-30);
            if limit > 1e290 {
                return; // rounding may carry it beyond f64
            }
            for (row, given) in back.iter().zip(&m).take(3) {
                for (ours, wanted) in row.iter().zip(given).take(3) {
                    assert!((ours - wanted).abs() <= limit * 1.000_001, "{m:?}");
                }
                // 2⁻³³, and f64's own step where that is larger.
                let error = (row[3] - given[3]).abs();
                assert!(error <= 2f64.powi(-33) + given[3].abs() * 2f64.powi(-52), "{m:?}");
            }
        }
    }
}
