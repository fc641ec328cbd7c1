//! Projections: why one is refused, in exact integers where the limits are exact.

use super::camera::angle;
use super::views::triple;
use crate::fuzzed::Bytes;
use pinhole::camera::CameraError;
use support::bridge::pair::{ProjectionBits, ONE};
use support::definition::Projectors;
use support::oracle::chain::fx;
use CameraError as E;

/// Limits that are computed with 30 bits are left out so near to them.
const NEAR: f64 = 1e-6;
const LIMIT: f64 = (1u32 << 30) as f64;

fn pair(b: &mut Bytes<'_>) -> [i32; 2] {
    match b.byte() {
        0..=63 => [b.wild(), b.wild()],
        64..=127 => {
            // As far apart as is wanted, from one step on.
            let low = b.wild();
            [low, low.wrapping_add(1 << (b.byte() & 31)).wrapping_add(b.i8() as i32)]
        }
        128..=191 => {
            let (middle, half) = (b.i8() as i32 * ONE / 16, (1 + i32::from(b.byte())) * ONE / 16);
            [middle - half, middle + half]
        }
        _ => [ONE / 4, ONE * (1 + i32::from(b.byte()))],
    }
}

pub(crate) fn any(b: &mut Bytes<'_>) -> ProjectionBits {
    let kind = b.byte();
    let ([l, r], [bottom, t], [n, f]) = (pair(b), pair(b), pair(b));
    let w = [l, r, bottom, t];
    match kind % 10 {
        0 => {
            let fov = match b.byte() {
                0..=127 => u32::from(b.u16()) << 15,
                128..=159 => (1u32 << 20).wrapping_add(b.i8() as u32),
                160..=191 => (1u32 << 31).wrapping_sub(1 << 20).wrapping_add(b.i8() as u32),
                _ => b.u32(),
            };
            let side =
                |b: &mut Bytes<'_>| if b.byte() & 1 == 0 { u32::from(b.byte()) } else { b.wild() as u32 };
            ProjectionBits::Perspective(fov, (side(b), side(b)), n, f)
        }
        1 => ProjectionBits::Frustum(w, n, f),
        2 => ProjectionBits::Orthographic(w, n, f),
        3 => ProjectionBits::Oblique(w, n, f, angle(b), b.wild()),
        4 => ProjectionBits::Reference(triple(b, [ONE; 3]), w, f, n),
        5 => ProjectionBits::ReferenceParallel(triple(b, [ONE; 3]), w, f, n),
        6 => ProjectionBits::EyeAtOrigin(b.wild(), w, n, f),
        7 => ProjectionBits::OriginInPlane(b.wild(), w, n, f),
        8 => ProjectionBits::PlanarParallel(w, n, f),
        _ => {
            let distance = if b.byte() & 1 == 0 { None } else { Some(b.wild()) };
            ProjectionBits::General(b.wild(), distance, triple(b, [0, 0, ONE]), w, n, f)
        }
    }
}

/// What speaks against a set-up: surely, and perhaps where rounding decides.
#[derive(Default)]
struct Reasons {
    surely: Vec<E>,
    perhaps: Vec<E>,
}

impl Reasons {
    fn when(&mut self, condition: bool, error: E) {
        if condition {
            self.surely.push(error);
        }
    }

    /// `value` must stay below `limit`.
    fn below(&mut self, value: f64, limit: f64, error: E) {
        if value >= limit * (1.0 + NEAR) {
            self.surely.push(error);
        } else if value >= limit * (1.0 - NEAR) || value.is_nan() {
            // NaN is a quotient by zero, which has its own reason.
            self.perhaps.push(error);
        }
    }

    fn window(&mut self, [l, r, b, t]: [i32; 4]) {
        self.when(l >= r || b >= t, E::EmptyWindow);
    }

    fn central(&mut self, n: i32, f: i32) {
        self.when(n <= 0, E::NearNotPositive);
        self.when(n >= f, E::NearNotBeforeFar);
        if n > 0 && n < f {
            let size = fx(n) * fx(f) / (f64::from(f) - f64::from(n)) * 65_536.0;
            self.below(size, LIMIT, E::NearNotBeforeFar);
        }
    }

    /// A box: its centre, and near, against its extents.
    fn parallel(&mut self, [l, r, b, t]: [i32; 4], near: i64, far: i64) {
        self.window([l, r, b, t]);
        self.when(near >= far, E::NearNotBeforeFar);
        for (low, high) in [(l, r), (b, t)] {
            if low < high {
                let (low, high) = (f64::from(low), f64::from(high));
                self.below((low + high).abs() / (high - low), LIMIT, E::EmptyWindow);
            }
        }
        if near < far {
            let (n, f) = (near as f64, far as f64);
            self.below(n.abs() / (f - n), LIMIT, E::NearNotBeforeFar);
        }
    }

    fn check(&self, got: &Result<impl Sized, E>, what: &dyn core::fmt::Debug) {
        match got {
            Ok(_) => assert!(self.surely.is_empty(), "{:?}: {what:?}", self.surely),
            Err(error) => assert!(
                self.surely.contains(error) || self.perhaps.contains(error),
                "{error:?} is not among {:?} and {:?}: {what:?}",
                self.surely,
                self.perhaps
            ),
        }
    }
}

fn reasons(family: &ProjectionBits) -> Reasons {
    let mut all = Reasons::default();
    match *family {
        ProjectionBits::Perspective(fov, (w, h), n, f) => {
            all.when(!(1 << 20..=(1 << 31) - (1 << 20)).contains(&fov), E::FieldOfView);
            all.when(w == 0 || h == 0, E::Viewport);
            all.central(n, f);
        }
        ProjectionBits::Frustum(w, n, f) => {
            all.window(w);
            all.central(n, f);
        }
        ProjectionBits::Orthographic(w, n, f) | ProjectionBits::Oblique(w, n, f, ..) => {
            all.parallel(w, n.into(), f.into())
        }
        ProjectionBits::Reference([_, _, pn], w, front, back) => {
            all.when(pn <= 0, E::NoViewPlane);
            all.when(front >= pn, E::NearNotPositive);
            all.when(back >= front, E::NearNotBeforeFar);
            all.window(w);
            let depth = f64::from(front) - f64::from(back);
            all.below((f64::from(pn) - f64::from(front)) / depth, LIMIT, E::NearNotBeforeFar);
            for (low, high) in [(w[0], w[1]), (w[2], w[3])] {
                let (low, high) = (f64::from(low), f64::from(high));
                all.below((low + high).abs() / (high - low) * fx(pn), LIMIT, E::EmptyWindow);
            }
        }
        ProjectionBits::ReferenceParallel([_, _, pn], w, front, back) => {
            all.when(pn <= 0, E::NoViewPlane);
            // Places on the n axis, where near and far lie the other way round.
            all.parallel(w, -i64::from(front), -i64::from(back));
        }
        ProjectionBits::EyeAtOrigin(d, w, n, f) => {
            all.when(d == 0, E::NoViewPlane);
            planar_reasons(&mut all, family, d != 0, w, n, f);
        }
        ProjectionBits::OriginInPlane(d, w, n, f) => {
            all.when(d == 0, E::NoViewPlane);
            planar_reasons(&mut all, family, d != 0, w, n, f);
        }
        ProjectionBits::PlanarParallel(w, n, f) => planar_reasons(&mut all, family, true, w, n, f),
        ProjectionBits::General(_, q, direction, w, n, f) => {
            let none = direction[2] == 0 || q == Some(0);
            all.when(none, E::NoViewPlane);
            planar_reasons(&mut all, family, !none, w, n, f);
        }
    }
    all
}

/// What a planar projection's rows are made of: w = `constant` + `slope`·z, 1 in the plane, and where the
/// projectors' slant puts the origin's image, times w.
struct Planar {
    slope: f64,
    constant: f64,
    image: [f64; 2],
}

fn terms(family: &ProjectionBits) -> Planar {
    let picture = family.picture();
    match picture.projectors {
        Projectors::From(c) => {
            let reach = c[2] - picture.plane;
            let image = [0, 1].map(|i| c[i] * picture.plane / reach);
            Planar { slope: -1.0 / reach, constant: c[2] / reach, image }
        }
        Projectors::Along(d) => {
            let image = [0, 1].map(|i| d[i] / d[2] * picture.plane);
            Planar { slope: 0.0, constant: 1.0, image }
        }
    }
}

/// Whether a planar projection's own numbers reach 2³⁰, where they saturate: what follows is not the
/// definition's then.
pub(crate) fn saturates(family: &ProjectionBits) -> bool {
    let (n, f) = match *family {
        ProjectionBits::EyeAtOrigin(_, _, n, f)
        | ProjectionBits::OriginInPlane(_, _, n, f)
        | ProjectionBits::General(_, _, _, _, n, f) => (n, f),
        _ => return false,
    };
    let Planar { slope, constant, image } = terms(family);
    let numbers =
        [constant, constant * family.picture().plane, image[0], image[1], slope * fx(n), slope * fx(f)];
    numbers.iter().any(|c| c.abs() >= LIMIT / 2.0)
}

/// What the rows x and y are made of, along z and without it, where that is more than what is left of it: of a
/// planar projection's picture the image's part and the window's, which may cancel but for their rounding.
pub(crate) fn parts(family: &ProjectionBits) -> [[f64; 2]; 2] {
    let w = match *family {
        ProjectionBits::EyeAtOrigin(_, w, ..)
        | ProjectionBits::OriginInPlane(_, w, ..)
        | ProjectionBits::General(_, _, _, w, ..) => w.map(fx),
        // Sine and cosine are within 2⁻²⁹·⁵, whatever they are, times the factor.
        ProjectionBits::Oblique(w, _, _, _, factor) => {
            let [l, r, b, t] = w.map(fx);
            return [r - l, t - b].map(|extent| [2.0 * fx(factor).abs() / extent, 0.0]);
        }
        _ => return [[0.0; 2]; 2],
    };
    let (Planar { slope, constant, image }, picture) = (terms(family), family.picture());
    let slant = |axis: usize| match picture.projectors {
        Projectors::From(c) => c[axis] / (c[2] - picture.plane),
        Projectors::Along(d) => d[axis] / d[2],
    };
    [0, 1].map(|axis| {
        let (extent, sum) = (w[2 * axis + 1] - w[2 * axis], w[2 * axis + 1] + w[2 * axis]);
        let both = |image: f64, w: f64| ((2.0 * image).abs() + (w * sum).abs()) / extent;
        [both(slant(axis), slope), both(image[axis], constant)]
    })
}

/// A planar projection's picture: near and far before the centre, and no constant beyond 2³⁰.
fn planar_reasons(all: &mut Reasons, family: &ProjectionBits, plane: bool, w: [i32; 4], n: i32, f: i32) {
    all.window(w);
    all.when(n >= f, E::NearNotBeforeFar);
    if !plane {
        return;
    }
    let Planar { slope, constant, image } = terms(family);
    if saturates(family) {
        all.perhaps.extend([E::NearNotPositive, E::NearNotBeforeFar, E::EmptyWindow, E::OutOfRange]);
        return;
    }
    let at = |distance: i32| constant - slope * fx(distance);
    // In steps of 2⁻³², plus the rounding of w's terms.
    let step = 2f64.powi(-28) * (slope.abs() * (fx(n).abs() + fx(f).abs()) + constant.abs()) + 2f64.powi(-30);
    for w in [at(n), at(f)] {
        if w < -step {
            all.surely.push(E::NearNotPositive);
        } else if w < step {
            all.perhaps.push(E::NearNotPositive);
        }
    }
    // These two are limits of the numbers' range only: each constant's parts below 2³⁰ are fine, and a
    // constant beyond it is not.
    let limit = |all: &mut Reasons, parts: [f64; 2], error| {
        if (parts[0] + parts[1]).abs() >= LIMIT * (1.0 + NEAR) {
            all.surely.push(error);
        } else if parts[0].abs() + parts[1].abs() >= LIMIT * (1.0 - NEAR) {
            all.perhaps.push(error);
        }
    };
    if n < f {
        let slope = fx(n) / (fx(f) - fx(n));
        limit(all, [at(f) * slope, step * slope], E::NearNotBeforeFar);
    }
    for (axis, low, high) in [(0, fx(w[0]), fx(w[1])), (1, fx(w[2]), fx(w[3]))] {
        if low >= high {
            continue;
        }
        limit(
            all,
            [2.0 * image[axis] / (high - low), -constant * (low + high) / (high - low)],
            E::EmptyWindow,
        );
    }
}

pub(crate) fn check(b: &mut Bytes<'_>) {
    let family = any(b);
    reasons(&family).check(&family.library(), &family);
}
