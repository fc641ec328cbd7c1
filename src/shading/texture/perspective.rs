//! Texture coordinates in perspective: quotients of two numbers that are linear on the screen.

use super::line::{Coordinates, LARGEST_BLOCK};
use super::linear::range;
use super::mapping::{FaceCoords, FRACTION};
use crate::math::hints::opaque_next;
use crate::math::num::{
    leading_zeros, mul_called, mul_high, mul_wide, reciprocal_called, reciprocal_of_positive, Reciprocal,
    CORTEX_M0,
};
use crate::math::unrolled::{map2, map3};
use crate::raster::{Gradient, GradientSetup, ScreenPoint, Triangle};
use crate::shading::corner_values::inverse_w;

/// Texture coordinates that are not linear on the screen. With q = 1/w, the numbers q, s = (u − u₀)·q and t = (v − v₀)·q are, and
/// a pixel has u = u₀ + s/q. u₀ and v₀ are those of the farthest corner, where q is least exact: there s = t = 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Perspective {
    /// In 2⁻³⁰ of their range over the triangle: 0 … 2³⁰ for q, and 2²⁹ more than s and t, which are −2²⁹ … 2²⁹.
    planes: [Gradient; 3],
    /// u₀ and v₀ in 2⁻³² of the sides.
    origin: [u32; 2],
    /// Half of a [`Sample`]'s unit in 2⁻³² of the sides, for u and v: 2^([`LARGEST_BLOCK`] − 1) … 2²², so that the steps over a block are
    /// exact.
    half_units: [u32; 2],
    /// The right shifts from s/q and t/q in 2^([`ROOM`] − 29) to that unit: 0 … 23.
    downs: [u8; 2],
    /// The width of the widest block, in pixels: a power of two.
    pub(super) widest_block: i32,
    pub(super) curvature: Curvature,
    /// The column that planes are counted from: 0 unless coordinates are [linear by rows](is_linear_by_rows), otherwise that in
    /// the middle of the triangle.
    pub(super) anchor: i32,
    /// For [`line`](Self::line): the left shifts from products of K and 1/q² to the change from a pixel to the next, for mantissas of
    /// 1/q that are not shifted.
    steps: [i32; 2],
}

/// q, s and t at a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planes {
    pub(super) q: i32,
    s: i32,
    t: i32,
}

impl Planes {
    /// Whether a [`Sample`] has room for the coordinates: they are at most 16 times as far from the farthest corner's as a corner's may
    /// be.
    #[inline(always)]
    pub(super) fn has_room(&self) -> bool {
        // From −q to q.
        let is_within = |s: i32, q: i32| (s >> ROOM).wrapping_add(q) as u32 <= (q as u32) << 1;
        let Self { q, s, t } = *self;
        q > 0 && is_within(s, q) && is_within(t, q)
    }

    /// These planes where they [have room](Self::has_room); elsewhere, which is beside the triangle, those of the nearest coordinates
    /// that have.
    #[inline(always)]
    pub(super) fn inside_room(self) -> Self {
        let q = self.q.max(1);
        // In 32 bits: samples do not need the lower bits.
        let most = if q >> (31 - ROOM) == 0 { q << ROOM } else { i32::MAX };
        let inside = |s: i32| s.min(most).max(-most);
        Self { q, s: inside(self.s), t: inside(self.t) }
    }
}

/// Texture coordinates relative to those of the farthest corner, in the unit that [`Perspective::half_units`] says: at most 2²⁹.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    u: i32,
    v: i32,
}

impl Sample {
    /// The sum of this sample and itself.
    #[inline(always)]
    pub(super) fn twice(self) -> [i32; 2] {
        [self.u + self.u, self.v + self.v]
    }

    pub(super) const ZERO: Self = Self { u: 0, v: 0 };
}

/// How fast coordinates depart from a line along a row.
///
/// Along a row s and q are linear, with the steps s' and q', so K = s'·q − s·q' is constant, and so is that of t; from row to row
/// they are linear. Between pixels L columns apart with q₀ and q₁, s/q changes by K·L/(q₀·q₁), and q by q'·L: interpolated linearly
/// in between, s/q is off by at most |K·q'|·L²/(4·q₀·q₁·min(q₀, q₁)) ≤ |K·q'|·L²/(4·m³) with m = min(q₀, q₁).
///
/// This error has one sign: with t from 0 to 1 along the block and Δ the change of s/q over it, s/q differs from the line by
/// Δ·(q₁ − q₀)·t·(1 − t)/q(t), whose largest magnitude is that of e = Δ·(q₁ − q₀)/(√q₀ + √q₁)². Lines are moved by
/// h = Δ·(q₁ − q₀)/(8·q₁), and are then off by at most |h| or |e − h|. Both are at most |K·q'|·L²/(8·m³). In units of |K·q'|·L²/m³,
/// and with r = max(q₀, q₁)/m, Δ·(q₁ − q₀) is 1/r in units of m, and e = 1/(r·(1 + √r)²) ≤ r^(−3/2)/4. Where q₁ = m, h is 1/(8·r) and e is at most
/// twice that. Where q₀ = m, h is 1/(8·r²), and with x = r^(−1/2) ≤ 1, e − h is at most x³/4 − x⁴/8 = x³·(2 − x)/8 ≤ 1/8.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curvature {
    /// K of s and of t in row 0, wrapping, and their changes from row to row, in a unit in which those of covered rows are below
    /// 2³⁰: in texels, those of the larger unit of both.
    rows: [[i32; 2]; 2],
    /// The binary logarithm of that unit: 0 … 35.
    cut: i32,
    /// An upper bound of K's error.
    slack: u32,
    /// The logarithm of |K·q'|/(8·ε), as a fraction of 2⁹³, less the logarithm of |K| in this unit, as a fraction of 2³¹: in 2⁻¹⁶, like
    /// the logarithms.
    bound: i32,
}

/// The binary logarithm of `v ≥ 1` in 2⁻¹⁶, linear between powers of two: too small by less than [`ROUND_UP`].
#[inline(always)]
fn log_of(v: u32) -> i32 {
    log_of_2_31(v) + (31 << 16)
}

/// [`log_of`] `v ≥ 1` as a fraction of 2³¹. On a Cortex-M0 a call: code size.
#[inline(always)]
fn log_of_2_31(v: u32) -> i32 {
    match CORTEX_M0 {
        true => log_of_2_31_called(v),
        false => log_of_2_31_inlined(v),
    }
}

#[inline(never)]
fn log_of_2_31_called(v: u32) -> i32 {
    log_of_2_31_inlined(v)
}

#[inline(always)]
fn log_of_2_31_inlined(v: u32) -> i32 {
    let zeros = leading_zeros(v);
    let fraction = (v << (zeros & 31)) << 1 >> 16; // without the leading bit
    fraction as i32 - (zeros << 16)
}

/// An upper bound of log₂(1 + f) − f for f in 0 … 1, which is 0.08608, and of what f loses by having 16 bits, in 2⁻¹⁶.
const ROUND_UP: i32 = 5643;

impl Curvature {
    /// Of planes whose values at pixel (x, y) near the triangle are given.
    fn new(planes: &[Gradient; 3], (x, y): (i32, i32), size: &Size, coarser: [u8; 2], exponent: i32) -> Self {
        let [q, s, t] = planes;
        let [u, v] = coarser;
        let k = |s: &Gradient, coarser: u8| RowK::new(q, s, (x, y), size, coarser.into());
        let (of_s, of_t) = (k(s, u), k(t, v));
        // The sum of K and its steps has one bit more.
        let cut = (of_s.bits.max(of_t.bits) - 29).max(0); // at most 35
        let slope = log_of(q.step().cast_signed().unsigned_abs() | 1);
        Self {
            rows: [of_s.rows(cut, y), of_t.rows(cut, y)],
            cut,
            slack: 2 + (1 << (size.row_bits & 31)),
            bound: slope + 2 * ROUND_UP + ((exponent + cut + 31 - 3 * 31) << 16),
        }
    }

    /// K of s and of t in a row.
    #[inline(always)]
    fn k(&self, y: i32) -> [i32; 2] {
        map2(self.rows, |[k, step]| k.wrapping_add(step.wrapping_mul(y)))
    }

    /// The binary logarithm of |K·q'|/(8·ε) in a row, as a fraction of 2⁹³, in 2⁻¹⁶.
    #[inline(never)] // code size
    pub(super) fn of_row(&self, y: i32) -> i32 {
        let [s, t] = map2(self.k(y), i32::unsigned_abs);
        log_of_2_31(s.max(t).wrapping_add(self.slack)) + self.bound
    }
}

/// K of s or t at a pixel, exactly or more.
struct RowK {
    k: i64,
    /// The change from row to row.
    step: i64,
    /// The bits of the largest K of covered rows.
    bits: i32,
}

impl RowK {
    /// At pixel (x, y), in 2^`coarser`, at most 21.
    #[inline(never)] // rare in fine meshes: code size counts
    fn new(q: &Gradient, s: &Gradient, (x, y): (i32, i32), size: &Size, coarser: u32) -> Self {
        let (q0, q_right, q_down) = (q.at(x, y) as i32, q.step() as i32, q.row_step() as i32);
        let (s0, right, down) = (s.at(x, y).wrapping_sub(BIAS) as i32, s.step() as i32, s.row_step() as i32);
        let (at, step) = match size.has_columns {
            // Exact: q is below 2³¹, |s| and |t| are at most 2³⁰, and steps at most 2²⁹.
            true => (
                mul_wide(right, q0).wrapping_sub(mul_wide(s0, q_right)),
                mul_wide(right, q_down).wrapping_sub(mul_wide(down, q_right)),
            ),
            // Steps from row to row may wrap: more than K at any pixel, as q is at most 2³⁰.
            false => (i64::from(right.unsigned_abs().wrapping_add(q_right.unsigned_abs())) << 30, 0),
        };
        let (k, step) = (at >> (coarser & 31), step >> (coarser & 31));
        let largest = k.unsigned_abs() | step.unsigned_abs() << (size.row_bits & 31);
        Self { k, step, bits: 64 - leading_zeros_64(largest) }
    }

    /// K in row 0 and its change from row to row, in 2^`cut`, given that this is K in row `y`.
    #[inline(never)] // rare in fine meshes: code size counts
    fn rows(&self, cut: i32, y: i32) -> [i32; 2] {
        let (k, step) = ((self.k >> (cut & 63)) as i32, (self.step >> (cut & 63)) as i32);
        [k.wrapping_sub(step.wrapping_mul(y)), step]
    }
}

/// How far a triangle reaches.
struct Size {
    /// The binary logarithm of the widest block: at most the widest span, A/H with twice the area A and the height H, so that a
    /// gradient changes by no more over it than over the triangle.
    largest_block: i32,
    /// Whether the longest column of pixels has two or more, so that a gradient changes over two rows by no more than over the
    /// triangle.
    has_columns: bool,
    /// Every covered row is less than 2^`row_bits` rows from each corner's row: 1 … 16.
    row_bits: u32,
    /// The rows of the highest and of the lowest corner.
    rows: [i32; 2],
    /// The column in the middle of the triangle, and the largest distance of a covered pixel from it, in columns.
    middle: i32,
    reach: i32,
}

impl Size {
    fn of(triangle: &Triangle<'_>) -> Self {
        let (left, across) = range_called(map3(triangle.corners, |a| a.x));
        let (top, down) = range_called(map3(triangle.corners, |a| a.y));
        let bits = |length: i32| 32 - leading_zeros(length as u32);
        let (width, height) = (bits(across), bits(down));
        // A/H in sub-pixels is at least 2^(bits of A − bits of H − 1); a pixel is 2⁸ of them.
        let area = 64 - leading_zeros_64(triangle.area.unsigned_abs()) - 1 - 8;
        Self {
            largest_block: (area - height).clamp(0, LARGEST_BLOCK),
            has_columns: area - width > 0,
            row_bits: (height - 7).max(1) as u32,
            rows: [top >> 8, (top + down) >> 8],
            middle: (left + left + across) >> 9,
            reach: (across >> 9) + 1,
        }
    }
}

/// [`range`] as a function.
#[inline(never)]
fn range_called(values: [i32; 3]) -> (i32, i32) {
    range(&values)
}

#[inline(never)]
fn leading_zeros_64(v: u64) -> i32 {
    match (v >> 32) as u32 {
        0 => 32 + leading_zeros(v as u32),
        high => leading_zeros(high),
    }
}

/// [`mul_high`] as a call on a Cortex-M0: code size.
#[inline(always)]
fn high(a: i32, b: i32) -> i32 {
    (mul_called(a, b) >> 32) as i32 // fits, as that of `mul_high`
}

/// A [`Sample`] has room for s and t up to 2^`ROOM` times q.
const ROOM: i32 = 3;

/// Added to s and t, so that their planes have no negative values.
const BIAS: u32 = 1 << 29;

impl Perspective {
    /// The gradients of a triangle, as `wrap` wraps them, given whether they are linear over each row. `size_bits` are the binary
    /// logarithms of the texture's width and height, in bytes, so that four registers hold all arguments, and the caller's stack frame
    /// is gone.
    #[inline(never)] // less frequent than linear ones in fine meshes: code size counts
    pub(super) fn set_up<G>(
        coords: &FaceCoords,
        size_bits: [u8; 2],
        triangle: &Triangle<'_>,
        wrap: impl FnOnce(bool, Self) -> G,
    ) -> G {
        let corners = CornerPlanes::new(coords, triangle);
        Self::of_planes(&corners, coords, size_bits, triangle, wrap)
    }

    #[inline(never)] // its stack frame does not exist while the planes are set up
    fn of_planes<G>(
        corners: &CornerPlanes,
        coords: &FaceCoords,
        size_bits: [u8; 2],
        triangle: &Triangle<'_>,
        wrap: impl FnOnce(bool, Self) -> G,
    ) -> G {
        let CornerPlanes { planes, first, least_q, uv: [u, v], n } = *corners;
        let [u_unit, v_unit] = coords.unit.map(i32::from);
        let phase = |c: i32, unit: i32| (c as u32) << ((unit - FRACTION as i32) & 31);
        // s/q in 2^(ROOM − 29) is a coordinate in 2^(n + unit − 36 + ROOM) of 2⁻³² of the side.
        let (u_full, v_full) = (u_unit + n - 36 + ROOM, v_unit + n - 36 + ROOM);
        // At most 23.
        let (u_up, v_up) = (u_full.max(LARGEST_BLOCK), v_full.max(LARGEST_BLOCK));
        // An error ε of s/q is one of ε·2^(n + 1 + unit − FRACTION + bits − 32) texels.
        let [w, h] = size_bits.map(i32::from);
        let (u_texel, v_texel) = (u_unit + w, v_unit + h); // 19 … 40
        let texel = u_texel.max(v_texel);
        let coarser = [(texel - u_texel) as u8, (texel - v_texel) as u8];
        // log₂(1/(8·ε)), rounded up.
        let exponent = coords.accuracy as i32 + n + texel - 42;
        let size = Size::of(triangle);
        let curvature = Curvature::new(&planes, (first.x >> 8, first.y >> 8), &size, coarser, exponent);
        let is_by_rows = is_linear_by_rows(&planes, least_q, &size, &curvature);
        let anchor = if is_by_rows { size.middle } else { 0 };
        let step = texel + n + curvature.cut - 65;
        let own = Self {
            planes: map3(planes, |plane| Gradient { origin: plane.at(anchor, 0), ..plane }),
            origin: [phase(u, u_unit), phase(v, v_unit)],
            half_units: [1 << ((u_up - 1) & 31), 1 << ((v_up - 1) & 31)],
            downs: [(u_up - u_full) as u8, (v_up - v_full) as u8],
            widest_block: 1 << (size.largest_block & 31),
            curvature,
            anchor,
            steps: [step - w, step - h],
        };
        wrap(is_by_rows, own)
    }

    /// Where coordinates are [linear by rows](is_linear_by_rows): u and v in column 0 of a row, and their changes from a pixel to the
    /// next, in 2⁻³² of the sides.
    #[inline(never)]
    pub(super) fn line(&self, y: i32) -> [[u32; 2]; 2] {
        let Self { curvature, anchor, steps, .. } = self;
        let Planes { q, s, t } = self.row(y);
        let r = reciprocal_called(q); // 1/q = mantissa · 2^(shift − 61)
        let [u, v] = self.phases(self.times(s, t, r));
        let square = mul_high(r.mantissa, r.mantissa); // 1/q² = square · 2^(2·shift − 90)
        let ([k_s, k_t], [m, n]) = (curvature.k(y), *steps);
        let step = |k: i32, up: i32| {
            let (step, up) = (mul_high(k, square), up + 2 * r.shift as i32);
            match up >= 0 {
                true => step << (up & 31),
                false => step >> (-up & 31),
            }
        };
        let (du, dv) = (step(k_s, m) as u32, step(k_t, n) as u32);
        let anchor = *anchor as u32;
        [[u.wrapping_sub(du.wrapping_mul(anchor)), v.wrapping_sub(dv.wrapping_mul(anchor))], [du, dv]]
    }

    /// The binary logarithm of the number of texels that a pixel covers along each axis, in 2⁻¹⁶, of a texture with these binary
    /// logarithms of its sides.
    ///
    /// s/q changes by (s'·q − s·q')/q² from a pixel to the next. The changes to the right and down are added up: no less than along any
    /// line, and at most √2 times as much.
    #[inline(never)] // code size
    pub(super) fn covered(&self, Planes { q, s, t }: Planes, [w, h]: [u32; 2]) -> i32 {
        let ([q_plane, s_plane, t_plane], [m, n], [i, j]) = (self.planes, self.half_units, self.downs);
        // In 2³² of the product of both units: at corners whose w is 32767 times as large as another's, 4 bits are left.
        let along = |s: i32, step: u32, q_step: u32| {
            (mul_high(step as i32, q) - mul_high(s, q_step as i32)).unsigned_abs()
        };
        let both = |s: i32, plane: Gradient| {
            along(s, plane.step(), q_plane.step()) + along(s, plane.row_step(), q_plane.row_step())
        };
        // A half unit is 2^(5 … 22), and s/q in 2^(ROOM − 29) a coordinate in twice as much, divided by 2^downs.
        let texel =
            |half: u32, bits: u32, down: u8| (half.trailing_zeros() + 1 + bits) as i32 - i32::from(down);
        let (u, v) = (texel(m, w, i), texel(n, h, j));
        let finer = |u: i32, v: i32| (v - u).max(0) & 31;
        let most = (both(s, s_plane) >> finer(u, v)).max(both(t, t_plane) >> finer(v, u));
        log_of(most | 1) - 2 * log_of(q.max(1) as u32) + ((u.max(v) + 29 - ROOM) << 16)
    }

    /// [`covered`](Self::covered) in the column in the middle of the triangle, where coordinates are [linear by rows](is_linear_by_rows).
    #[inline(always)]
    pub(super) fn covered_in_row(&self, y: i32, size_bits: [u32; 2]) -> i32 {
        self.covered(self.row(y), size_bits)
    }

    /// The planes in column 0 of a row.
    #[inline(always)]
    pub(super) fn row(&self, y: i32) -> Planes {
        let [q, s, t] = map3(self.planes, |plane| plane.at(0, y));
        Planes { q: q as i32, s: s.wrapping_sub(BIAS) as i32, t: t.wrapping_sub(BIAS) as i32 }
    }

    /// The planes `by` columns further right.
    #[inline(always)]
    pub(super) fn beyond(&self, Planes { q, s, t }: Planes, by: i32) -> Planes {
        let [q_step, s_step, t_step] = map3(self.planes, |plane| plane.step() as i32);
        Planes {
            q: q.wrapping_add(q_step.wrapping_mul(by)),
            s: s.wrapping_add(s_step.wrapping_mul(by)),
            t: t.wrapping_add(t_step.wrapping_mul(by)),
        }
    }

    /// q of [`beyond`](Self::beyond).
    #[inline(always)]
    pub(super) fn q_beyond(&self, Planes { q, .. }: Planes, by: i32) -> i32 {
        let [step, ..] = &self.planes;
        q.wrapping_add((step.step() as i32).wrapping_mul(by))
    }

    /// Whether q decreases to the right.
    #[inline(always)]
    pub(super) fn q_falls(&self) -> bool {
        let [step, ..] = &self.planes;
        (step.step() as i32) < 0
    }

    /// s/q and t/q, where there is [room](Planes::has_room).
    #[inline(always)]
    pub(super) fn divided(&self, Planes { q, s, t }: Planes) -> Sample {
        self.times(s, t, reciprocal_called(q))
    }

    /// s and t times 1/q = mantissa · 2^(shift − 61).
    #[inline(always)]
    fn times(&self, s: i32, t: i32, r: Reciprocal) -> Sample {
        let divided = |s: i32, down: u8| high(s >> ROOM << (r.shift & 31), r.mantissa) >> (down & 31);
        let [u, v] = self.downs;
        Sample { u: divided(s, u), v: divided(t, v) }
    }

    /// The binary logarithm of the largest distance between two pixels over which coordinates may be interpolated linearly, if q
    /// is `m` or more at both: |K·q'|·L² ≤ 8·ε·m³. Negative for none.
    #[inline(always)]
    pub(super) fn largest_block(curvature: i32, m: i32) -> i32 {
        (3 * log_of_2_31(m as u32) - curvature) >> 17
    }

    /// The coordinates of a sample, in 2⁻³² of the sides.
    #[inline(always)]
    pub(super) fn phases(&self, Sample { u, v }: Sample) -> [u32; 2] {
        let ([a, b], [m, n]) = (self.origin, self.half_units);
        [a.wrapping_add((u as u32).wrapping_mul(m << 1)), b.wrapping_add((v as u32).wrapping_mul(n << 1))]
    }

    /// The sample at the end of a block of 2^`bits` pixels, and for [`line_through`](Self::line_through) the sum of those at both ends,
    /// moved by half of the line's error (see [`Curvature`]), and their difference.
    #[inline(always)]
    pub(super) fn ends(&self, left: Sample, behind: Planes, bits: i32) -> (Sample, [i32; 2], [i32; 2]) {
        let Planes { q, s, t } = behind;
        let r = if CORTEX_M0 { reciprocal_called(q) } else { reciprocal_of_positive(q) };
        let right = self.times(s, t, r);
        let [q_step, ..] = &self.planes;
        // (q₁ − q₀)/(8·q₁) in 2⁻²⁹. It wraps where |q₁ − q₀| > 8·q₁, but |Δ| is at most 8·ε/(r·(r − 1)) < ε/9 there: with any share below
        // 2³⁰, the line moves by less than 2·ε/9, and is off by less than ε/3.
        let change = (q_step.step() as i32) << (bits & 31); // no more than q changes over the triangle
        let share = high(change >> ROOM << (r.shift & 31), r.mantissa);
        let twice = |d: i32| high(d, share) << 4; // 2·h, to 16 units
        let (du, dv) = (right.u - left.u, right.v - left.v);
        let sum = [(left.u + right.u).wrapping_add(twice(du)), (left.v + right.v).wrapping_add(twice(dv))];
        (right, sum, [du, dv])
    }

    /// The line over a block of 2^`bits` pixels from pixel `passed` on: see [`Coordinates::through`].
    #[inline(always)]
    pub(super) fn line_through<const N: usize>(
        &self,
        sum: [i32; 2],
        change: [i32; 2],
        bits: i32,
        passed: i32,
    ) -> Coordinates<N> {
        Coordinates::through(sum, change, self.origin, self.half_units, bits, passed)
    }
}

/// Whether coordinates in perspective may be interpolated linearly over each row of a triangle, given the least q of its corners.
///
/// With the notation of [`Curvature`], a row's tangent in a column that is D columns away at most is off by up to
/// |K·q'|·D²/(q₀²·q₁) ≤ |K·q'|·(2·D)²/(4·m³), where m is the least q.
#[inline(never)] // rare in fine meshes: code size counts
fn is_linear_by_rows(planes: &[Gradient; 3], least_q: i32, size: &Size, curvature: &Curvature) -> bool {
    let Size { reach, rows: [top, bottom], .. } = *size;
    let [q, s, t] = map3(*planes, |plane| plane.step().cast_signed().unsigned_abs());
    // More than the changes over `reach` columns. Steps are at most 2²⁹ where blocks may have two pixels.
    let over = |step: u32| u64::from(step) * u64::from(reach as u32);
    // Less than q within `reach` columns of a covered pixel: gradients are off by less than 2¹².
    let least = (i64::from(least_q) << 8) - (1 << 12) - over(q) as i64;
    if size.largest_block == 0 || !size.has_columns || least < 1 {
        return false;
    }
    let has_room = (1 << 29) + (1 << 12) + over(s.max(t)) <= (least as u64) << ROOM;
    let curvature = curvature.of_row(top).max(curvature.of_row(bottom));
    // `curvature` is of half of that.
    let error = curvature + 2 * (log_of(2 * reach as u32) + ROUND_UP) + (1 << 16);
    has_room && error <= 3 * log_of_2_31(least as u32)
}

/// The planes of a triangle, set up from its farthest corner.
struct CornerPlanes {
    /// Of q, s and t.
    planes: [Gradient; 3],
    /// The farthest corner, q there and its coordinates.
    first: ScreenPoint,
    least_q: i32,
    uv: [i32; 2],
    /// Differences of coordinates are below 2^this, 0 … 24.
    n: i32,
}

impl CornerPlanes {
    #[inline(never)] // its stack frame is gone when it returns
    fn new(coords: &FaceCoords, triangle: &Triangle<'_>) -> Self {
        // Below 2²², so that there is room for samples beside the triangle.
        let all_q = map3(inverse_w(coords.w), |q| (q >> 9).max(1));
        // The farthest corner first: errors of gradients grow with the distance from the first corner.
        let [qa, qb, qc] = all_q;
        let farthest = match () {
            () if qb < qa && qb <= qc => 1,
            () if qc < qa => 2,
            () => 0,
        };
        let (mut q, mut uv, mut turned, mut i) = (all_q, coords.uv, *triangle, 0);
        while let (Some(q), Some(uv), Some(corner)) = (q.get_mut(i), uv.get_mut(i), turned.corners.get_mut(i))
        {
            let at = if i + farthest < 3 { i + farthest } else { i + farthest - 3 };
            if let (Some(own_q), Some(own_uv), Some(own)) =
                (all_q.get(at), coords.uv.get(at), triangle.corners.get(at))
            {
                (*q, *uv, *corner) = (*own_q, *own_uv, *own);
            }
            i = opaque_next(i);
        }
        let setup = GradientSetup::called(&turned);
        let ([least_q, q1, q2], [[u, v], [u1, v1], [u2, v2]]) = (q, uv);
        let (du, dv) = ([u1 - u, u2 - u], [v1 - v, v2 - v]); // below 2²⁴
        let magnitude = |[a, b]: [i32; 2]| a.unsigned_abs() | b.unsigned_abs();
        let n = 32 - leading_zeros(magnitude(du) | magnitude(dv));
        let gradient = |[a, b]: [i32; 2]| setup.through(&[1 << 21, times(a, q1, n), times(b, q2, n)]);
        let ([first, ..], planes) = (turned.corners, [setup.through(&q), gradient(du), gradient(dv)]);
        Self { planes, first, least_q, uv: [u, v], n }
    }
}

/// s or t at a corner, given the difference of its coordinate from the first corner's, below 2^n, and q: 22 bits.
#[inline(never)] // code size
fn times(difference: i32, q: i32, n: i32) -> i32 {
    let product = mul_wide(difference, q); // below 2^(n + 22)
    ((product + (1 << (n & 31))) >> ((n + 1) & 31)) as i32 + (1 << 21)
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;

    /// The bound of [`log_of`], which the error of textures rests on.
    #[test]
    fn logarithms_are_too_small_by_less_than_round_up() {
        let mut largest = 0.0_f64;
        for shift in 0..32 {
            for fraction in 0..2048_u64 {
                let v = ((1 << 11 | fraction) << shift >> 11) as u32;
                if v == 0 {
                    continue;
                }
                let (exact, own) = (f64::from(v).log2() * 65536.0, f64::from(log_of(v)));
                assert!(own <= exact + 0.001 && exact < own + f64::from(ROUND_UP), "{v}: {own} for {exact}");
                largest = largest.max(exact - own);
            }
        }
        assert!(2.0 * largest > f64::from(ROUND_UP), "{largest}");
    }
}
