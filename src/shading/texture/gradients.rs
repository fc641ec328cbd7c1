//! Texture coordinates over a triangle.

use super::mapping::{Accuracy, Textured};
use super::texels::Texels;
use crate::math::num::{leading_zeros, mul_high, mul_wide, reciprocal_of_positive};
use crate::math::unrolled::map3;
use crate::raster::{Gradient, GradientSetup, Triangle};
use crate::shading::corner_values::inverse_w;

/// Texture coordinates over a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) enum Gradients {
    /// u and v in 2⁻³² of the sides, linear on the screen: all corners are about as far away, or the projection is parallel.
    Affine([Gradient; 2]),
    Perspective(Perspective),
}

/// Texture coordinates that are not linear on the screen. With q = 1/w, the numbers q, s = (u − u₀)·q and t = (v − v₀)·q are, and
/// a pixel has u = u₀ + s/q. u₀ and v₀ are those of the farthest corner, where q is least exact: there s = t = 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Perspective {
    /// In 2⁻³⁰ of their range over the triangle: 0 … 2³⁰ for q, and 2²⁹ more than s and t, which are −2²⁹ … 2²⁹.
    q: Gradient,
    st: [Gradient; 2],
    /// u₀ and v₀ in 2⁻³² of the sides.
    origin: [u32; 2],
    /// A [`Sample`]'s unit is 2^this of 2⁻³² of the sides: [`LARGEST_RUN`] … 22, so that the steps over a run are exact.
    up: [u8; 2],
    /// The right shift from s/q in 2⁻²⁹ to a sample's unit: at least 2.
    down: [u8; 2],
    /// What [`Perspective::curvature`] adds to the logarithm of |s'·q − s·q'|: in 2⁻¹⁶, like the logarithm.
    bound: i32,
    /// The right shifts of u and of v to the larger unit of both, in texels: 0 … 21.
    coarser: [u8; 2],
    /// The binary logarithm of the widest run.
    pub(super) largest_run: u32,
}

/// Texture coordinates relative to those of the farthest corner, in the unit of [`Perspective::up`], and q, at a pixel's centre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// At most 2²⁷.
    uv: [i32; 2],
    /// 1/w in the unit of [`Perspective::q`]: 1 … 2³¹ − 1; 0 in [`NONE`](Self::NONE).
    pub(super) q: i32,
}

impl Sample {
    /// No coordinates: nothing is linear from here or to here.
    pub(super) const NONE: Self = Self { uv: [0; 2], q: 0 };

    #[inline(always)]
    pub(super) const fn is_none(&self) -> bool {
        self.q == 0
    }
}

/// The widest run is 256 pixels.
const LARGEST_RUN: u32 = 8;

impl Gradients {
    pub(super) fn new<S: Texels>(shader: &Textured<S>, triangle: &Triangle<'_>) -> Self {
        let [[ua, va], [ub, vb], [uc, vc]] = shader.uv;
        let (u, v) = ([ua, ub, uc], [va, vb, vc]);
        let ranges @ [(_, width), (_, height)] = [range(&u), range(&v)];
        // A unit is 2^(unit − FRACTION + bits − 32) texel: |Δu·Δw| ≤ 4·2^−accuracy texels · w, in 2²⁸. The right shifts of w are
        // 5 … 30.
        let ([u_unit, v_unit], [w, h]) = (shader.texture.unit, shader.texture.texels.size_bits());
        let shift =
            |unit: u8, bits: u32| (accuracy_bits(shader) + u32::from(unit) + bits).wrapping_sub(FRACTION + 6);
        let [w, h] = [shift(u_unit, w), shift(v_unit, h)];
        // (1/w₀ − 1/w₁)/(1/w₁) = (w₁ − w₀)/w₀.
        let (nearest, apart) = range(&shader.w);
        if is_linear(width as u32, apart as u32, nearest, w)
            && is_linear(height as u32, apart as u32, nearest, h)
        {
            return Self::affine(shader, triangle, [u, v], ranges);
        }
        Self::Perspective(Perspective::new(shader, triangle))
    }

    fn affine<S>(
        shader: &Textured<S>,
        triangle: &Triangle<'_>,
        values: [[i32; 3]; 2],
        ranges: [(i32, i32); 2],
    ) -> Self {
        let setup = GradientSetup::new(triangle);
        let margin = if setup.extent.is_large() { LARGE_MARGIN } else { MARGIN };
        let gradient = |values: [i32; 3], (least, extent): (i32, i32), unit: u8| {
            // Values up to 2¹⁷ keep the numerators of the set-up in 32 bits. The finer the unit, the smaller are the margin and the
            // error of the gradient against the extent.
            let unit = i32::from(unit);
            let finer = (unit - 16).min(leading_zeros(extent as u32) - 15).max(0) & 15; // 2¹⁷, or more that is given
            let extent = extent << finer;
            let (low, high) = (margin.min(extent >> 1), (extent - margin).max(extent >> 1));
            let inside = |value: i32| ((value - least) << finer).max(low).min(high);
            // In 2^−(FRACTION + 8 + finer) units.
            let Gradient { origin, right, down } = setup.through(&map3(values, inside));
            let up = (unit - 16 - finer) & 31;
            Gradient { origin: origin << up, right: right << up, down: down << up }
                .add_bias((least as u32) << ((unit - FRACTION as i32) & 31))
        };
        let ([u, v], [u_range, v_range], [u_unit, v_unit]) = (values, ranges, shader.texture.unit);
        Self::Affine([gradient(u, u_range, u_unit), gradient(v, v_range, v_unit)])
    }
}

/// What keeps coordinates between those of the corners in spite of the error of [`GradientSetup::through`], in units of its
/// values: w columns and h rows from the first corner that is less than ((w + h)/2 + 34 + 1552)/256, and w + h is at most 1026
/// within 512 pixels.
const MARGIN: i32 = 9;

/// [`MARGIN`] for triangles of up to 2¹⁴ columns and rows.
const LARGE_MARGIN: i32 = 71;

const FRACTION: u32 = Textured::<()>::FRACTION;

/// The least value, and the difference between the largest and it: less than 2²⁴.
fn range(&[a, b, c]: &[i32; 3]) -> (i32, i32) {
    let least = a.min(b).min(c);
    (least, a.max(b).max(c) - least)
}

/// The binary logarithm of 1/[`Accuracy`].
#[inline(always)]
fn accuracy_bits<S>(shader: &Textured<S>) -> u32 {
    match shader.texture.accuracy {
        Accuracy::Quarter => 2,
        Accuracy::Eighth => 3,
        Accuracy::Sixteenth => 4,
    }
}

/// Whether coordinates may be interpolated linearly over a triangle, given the differences of the coordinate, below 2²⁴, and of w
/// over it, and the least w: they are then off by less than |Δu|·|Δw|/(4·w).
///
/// The product is compared in units of 2²⁸, rounded down, with w, also rounded down: `false` where that leaves a doubt.
#[inline(always)]
fn is_linear(du: u32, dw: u32, w: i32, tolerance: u32) -> bool {
    let product = (u64::from(du << 4) * u64::from(dw)) >> 32;
    (product as u32) < (w as u32) >> (tolerance & 31)
}

/// The binary logarithm in 2⁻¹⁶ of `v ≥ 1`, linear between powers of two: too small by less than [`ROUND_UP`].
#[inline(always)]
fn log_of(v: u32) -> i32 {
    let zeros = leading_zeros(v);
    let fraction = (v << (zeros & 31)) << 1 >> 16; // without the leading bit
    ((31 - zeros) << 16) | fraction as i32
}

/// [`log_of`] 64 bits.
#[inline(always)]
fn log(v: u64) -> i32 {
    let high = (v >> 32) as u32;
    if high == 0 {
        return log_of(v as u32);
    }
    let zeros = leading_zeros(high);
    log_of((v << (zeros & 63) >> 32) as u32) + ((32 - zeros) << 16)
}

/// More than log₂(1 + f) − f for f in 0 … 1, at most 0.08608, and more than what 16 bits of f cut off, in 2⁻¹⁶.
const ROUND_UP: i32 = 5643;

impl Perspective {
    fn new<S: Texels>(shader: &Textured<S>, triangle: &Triangle<'_>) -> Self {
        // Below 2²², so that there is room for samples beside the triangle.
        let q = inverse_w(shader.w).map(|q| (q >> 9).max(1));
        // The farthest corner first: errors of gradients grow with the distance from the first corner.
        let ([qa, qb, qc], [a, b, c], [ua, ub, uc]) = (q, triangle.corners, shader.uv);
        let (q, corners, uv) = if qb < qa && qb <= qc {
            ([qb, qc, qa], [b, c, a], [ub, uc, ua])
        } else if qc < qa {
            ([qc, qa, qb], [c, a, b], [uc, ua, ub])
        } else {
            (q, triangle.corners, shader.uv)
        };
        let turned = Triangle { corners, ..*triangle };
        let setup = GradientSetup::new(&turned);
        let ([_, q1, q2], [[u, v], [u1, v1], [u2, v2]]) = (q, uv);
        let (du, dv) = ([u1 - u, u2 - u], [v1 - v, v2 - v]); // below 2²⁴
        let magnitude = |[a, b]: [i32; 2]| a.unsigned_abs() | b.unsigned_abs();
        let n = 32 - leading_zeros(magnitude(du) | magnitude(dv)); // |difference| < 2^n, 0 … 24
        let times = |difference: i32, q: i32| {
            let product = i64::from(difference) * i64::from(q); // below 2^(n + 22)
            ((product + (1 << (n & 31))) >> ((n + 1) & 31)) as i32 + (1 << 21)
        };
        let gradient = |[a, b]: [i32; 2]| setup.through(&[1 << 21, times(a, q1), times(b, q2)]);
        let [u_unit, v_unit] = shader.texture.unit.map(i32::from);
        let phase = |c: i32, unit: i32| (c as u32) << ((unit - FRACTION as i32) & 31);
        // s/q in 2⁻²⁷ is a coordinate in 2^(n + unit − 34) of 2⁻³² of the side.
        let (u_full, v_full) = (u_unit + n - 34, v_unit + n - 34);
        let (u_up, v_up) = (u_full.max(LARGEST_RUN as i32), v_full.max(LARGEST_RUN as i32)); // at most 22
        let q = setup.through(&q);
        // An error ε of s/q is one of ε·2^(n + 1 + unit − FRACTION + bits − 32) texels.
        let [w, h] = shader.texture.texels.size_bits().map(|bits| bits as i32);
        let (u_texel, v_texel) = (u_unit + w, v_unit + h); // 19 … 40
        let texel = u_texel.max(v_texel);
        let coarser = [(texel - u_texel) as u8, (texel - v_texel) as u8];
        // log₂(|q'|/(4·ε)), rounded up.
        let exponent = accuracy_bits(shader) as i32 + n + texel - 41;
        let bound = log(u64::from((q.right as i32).unsigned_abs() | 1)) + ROUND_UP + (exponent << 16);
        Self {
            q,
            st: [gradient(du), gradient(dv)],
            origin: [phase(u, u_unit), phase(v, v_unit)],
            up: [u_up as u8, v_up as u8],
            down: [(2 + u_up - u_full) as u8, (2 + v_up - v_full) as u8], // at most 26
            bound,
            coarser,
            largest_run: largest_run(triangle),
        }
    }

    /// The coordinates at a pixel; where there is no room for them, which is beside the triangle, those nearest to them.
    pub(super) fn sample(&self, x: i32, y: i32) -> Sample {
        let (q, st) = self.at(x, y);
        let q = q.max(1);
        self.divided(q, st.map(|s| s.clamp(-q, q)))
    }

    /// q, s and t at a pixel.
    #[inline(always)]
    pub(super) fn at(&self, x: i32, y: i32) -> (i32, [i32; 2]) {
        let [s, t] = self.st.map(|gradient| gradient.at(x, y).wrapping_sub(1 << 29) as i32);
        (self.q.at(x, y) as i32, [s, t])
    }

    /// s/q and t/q, for |s|, |t| ≤ q.
    #[inline(never)] // called from three places
    pub(super) fn divided(&self, q: i32, [s, t]: [i32; 2]) -> Sample {
        let r = reciprocal_of_positive(q); // 1/q = mantissa · 2^(shift − 61)
        let divided = |s: i32, down: u8| mul_high(s << (r.shift & 31), r.mantissa) >> (down & 31);
        let [u, v] = self.down;
        Sample { uv: [divided(s, u), divided(t, v)], q }
    }

    /// How fast coordinates of a row depart from a line, for [`largest_block`](Self::largest_block): any covered pixel of the row
    /// gives the same number.
    ///
    /// Along a row s and q are linear, with the steps s' and q', so K = s'·q − s·q' is constant, and so is that of t. Between pixels
    /// L columns apart with q₀ and q₁, s/q changes by K·L/(q₀·q₁), and q by q'·L: interpolated linearly in between, s/q is off by
    /// at most |K·q'|·L²/(4·q₀·q₁·min(q₀, q₁)) ≤ |K·q'|·L²/(4·m³) with m = min(q₀, q₁).
    #[inline(never)] // once for a span
    pub(super) fn curvature(&self, x: i32, y: i32) -> i32 {
        let (q, st) = self.at(x, y);
        let slope = self.q.step() as i32;
        let ([s, t], [s_step, t_step], [u, v]) = (st, self.st.map(|g| g.step() as i32), self.coarser);
        // Exact: q is below 2³¹, |s| and |t| are at most 2³⁰; steps are at most 2²⁹ where a run has two pixels.
        let constant = |s: i32, step: i32, coarser: u8| {
            (mul_wide(step, q).wrapping_sub(mul_wide(s, slope))).unsigned_abs() >> (coarser & 63)
        };
        let largest = constant(s, s_step, u).max(constant(t, t_step, v));
        log(largest.wrapping_add(1)) + ROUND_UP + self.bound
    }

    /// The binary logarithm of the largest distance between two pixels over which coordinates may be interpolated linearly, if q
    /// is `m` or more at both: |K·q'|·L² ≤ 4·ε·m³. Negative for none.
    #[inline(always)]
    pub(super) fn largest_block(curvature: i32, m: i32) -> i32 {
        (3 * log_of(m as u32) - curvature) >> 17
    }

    /// Whether a [`Sample`] has room for the coordinates of a pixel with these q, s and t.
    #[inline(always)]
    pub(super) fn has_room(&(q, [s, t]): &(i32, [i32; 2])) -> bool {
        q > 0 && s.unsigned_abs().max(t.unsigned_abs()) <= q as u32
    }

    /// q at a pixel.
    #[inline(always)]
    pub(super) fn q(&self, x: i32, y: i32) -> i32 {
        self.q.at(x, y) as i32
    }

    /// The coordinates of a sample, in 2⁻³² of the sides.
    #[inline(always)]
    pub(super) fn phases(&self, &Sample { uv: [u, v], .. }: &Sample) -> [u32; 2] {
        let ([a, b], [m, n]) = (self.origin, self.up);
        [a.wrapping_add((u as u32) << (m & 31)), b.wrapping_add((v as u32) << (n & 31))]
    }

    /// The change per pixel between two samples, 2^`bits` pixels from each other; exact, as `bits` is at most [`LARGEST_RUN`].
    #[inline(always)]
    pub(super) fn step(&self, left: &Sample, right: &Sample, bits: u32) -> [u32; 2] {
        let ([a, b], [c, d], [m, n]) = (left.uv, right.uv, self.up);
        let shift = |up: u8| u32::from(up).wrapping_sub(bits) & 31;
        [((c - a) as u32) << shift(m), ((d - b) as u32) << shift(n)]
    }
}

/// The binary logarithm of the widest run: at most the widest span of the triangle, A/H with twice the area A and the height H,
/// so that a gradient changes by no more over it than over the triangle; 256 pixels at most.
fn largest_run(triangle: &Triangle<'_>) -> u32 {
    let [a, b, c] = triangle.corners.map(|corner| corner.y);
    let height = (a.max(b).max(c) - a.min(b).min(c)) as u32; // not 0, as the area is not
    let area_bits = 64 - triangle.area.unsigned_abs().leading_zeros() as i32;
    let height_bits = 32 - leading_zeros(height);
    // A/H in sub-pixels is at least 2^(area_bits − height_bits − 1); a pixel is 2⁸ of them.
    (area_bits - height_bits - 1 - 8).clamp(0, LARGEST_RUN as i32) as u32
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;

    /// The bound of [`log_of`] and [`log`], which the error of textures rests on.
    #[test]
    fn logarithms_are_too_small_by_less_than_round_up() {
        let mut largest = 0.0_f64;
        for shift in 0..64 {
            for fraction in 0..2048_u64 {
                let v = (((1 << 11 | fraction) as u128) << shift >> 11) as u64;
                if v == 0 {
                    continue;
                }
                let (exact, own) = ((v as f64).log2() * 65536.0, f64::from(log(v)));
                assert!(own <= exact + 0.001 && exact < own + f64::from(ROUND_UP), "{v}: {own} for {exact}");
                largest = largest.max(exact - own);
                if let Ok(v) = u32::try_from(v) {
                    assert_eq!(log_of(v), log(v.into()), "{v}");
                }
            }
        }
        assert!(2.0 * largest > f64::from(ROUND_UP), "{largest}");
    }
}
