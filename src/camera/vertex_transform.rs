//! The vertex stage: model coordinates to the screen, in integers.
//!
//! Once per object, model, view and projection transforms are composed into four linear forms, after subtraction of the eye.
//! Once per vertex: three or four forms, one reciprocal, two or three products. ARCHITECTURE.md, "Numbers", has the error
//! budget.

use super::camera::Screen;
use super::{Camera, ScreenVertex, UnpackedVertex};
use crate::math::cores::CORTEX_M0;
use crate::math::hints::opaque_next;
use crate::math::num::{
    add, bits_of, evaluate, magnitude, mul_high, mul_wide, reciprocal, reciprocal_of_large, scale,
    scale_word, shift_to_fit, Reciprocal,
};
use crate::math::row::RowBlock;
use crate::math::unrolled::{map2, map3};
use crate::math::{matrix_product, Affine, ClipCoords, Coordinate, LinearForm, Row};
use crate::raster::{ScreenPoint, FARTHEST, GUARD_BAND};
use crate::space::{Model, World};
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::primitives::Rectangle;

/// The vertex transform of one object under one camera: model coordinates to clip space and to the screen.
///
/// Clip coordinates are `integer · 2^exponent` with one exponent `e_xy` for x and y, one for d and one for w. Only differences
/// of exponents are stored.
#[derive(Clone, Copy, Debug)]
#[repr(C)] // fields of the vertex loop first: loads of a Cortex-M0 have offsets up to 124 bytes
pub(crate) struct VertexTransform {
    w: LinearForm,
    x: LinearForm,
    y: LinearForm,
    /// The power of two that shifts a mesh's largest coordinate to the top of its word: coordinates are *justified* by it.
    justify_factor: i32,
    /// The least w for which 32-bit arithmetic suffices. If w alone decides the near test, a vertex with this w is also
    /// certainly beyond the near plane.
    min_w: i32,
    /// The right shift from `x·R/2³²` to half sub-pixels, where R is the reciprocal of w shifted to 31 bits.
    right: i32,
    /// [`ScreenVertex::BIAS`]: as a constant it would take two instructions and a register.
    bias: i32,
    /// If depth depends on w alone it is `origin + depth_scale/w`, in 2⁻²⁷; `origin` includes the half that rounds to 2⁻²⁴.
    origin: i32,
    /// The negative factor of 1/w in that formula, in units of w times 2^(2 − scale_down).
    depth_scale: i32,
    scale_down: i32,
    /// e_d − e_w: never negative.
    d_over_w: i32,
    d: LinearForm,
    /// e_xy − e_w: 0 … [`Screen::room`](super::camera::Screen::room).
    xy_over_w: i32,
    screen: Screen,
    /// Whether the near test and depth need d.
    by_d: bool,
    far_clip: bool,
}

impl VertexTransform {
    /// Composes `model` and `camera` for a mesh whose coordinates are vertex · 2^`exponent`. `justify` is the left shift that
    /// brings its largest coordinate to the top of 32 bits, `narrow` whether coordinates have 16 bits.
    #[inline(never)] // set-up: code size counts
    pub(crate) fn new(
        camera: &Camera,
        model: &Affine<Model, World>,
        exponent: i32,
        justify: u32,
        narrow: bool,
    ) -> Self {
        // Step 1: model to view, relative to the eye.
        let (m, m_exponent) = model.linear();
        let away = model.offset_from(&camera.eye);
        // Copies, which are overwritten: LLVM would clear an array of zeros by a library function.
        let mut view = RowBlock { linear: *m, exponent: m_exponent, offset: away }; // in a tuple it would be copied twice
        let mut i = 0;
        while let (Some(offset), Some(axis)) = (view.offset.get_mut(i), camera.axes.get(i)) {
            *offset = evaluate(axis, 0, &away, 0);
            i = opaque_next(i);
        }
        view.exponent = matrix_product(&camera.axes, 0, m, m_exponent, &mut view.linear);
        // Step 2: view to clip. A common factor of all four rows changes nothing; where numbers are large (thin volumes, narrow
        // windows, distant objects) it prevents saturation. In 2⁻³² an object extends three coefficients times 2^(31 + unit) around
        // `offset`.
        let unit = exponent - justify as i32;
        let largest = magnitude(view.linear.as_flattened());
        let around = match largest {
            0 => 0,
            _ => shift_to_fit(largest.into(), 30) + view.exponent + unit + 31 + 2 + 32,
        };
        let bits = shift_to_fit(bits_of(&view.offset), 0).max(around) + 1;
        let (mut shift, mut i) = (0, 0);
        while let Some(row) = camera.rows.get(i) {
            shift = shift.max(row.overflow(bits));
            i = opaque_next(i);
        }
        // Step 3: exponents from the range of each row over the object. A justified coordinate v stands for v·2^unit.
        let [first, ..] = camera.rows;
        let (mut rows, mut reaches, mut i) = ([first; 4], [0; 4], 0); // a copy, not zeros, as above
        while let (Some(row), Some(reached), Some(own)) =
            (rows.get_mut(i), reaches.get_mut(i), camera.rows.get(i))
        {
            own.compose(&view, shift, row);
            *reached = min_exponent(row, unit);
            i = opaque_next(i);
        }
        let ([x, y, d, w], [reach_x, reach_y, reach_d, reach_w]) = (&rows, reaches);
        let Screen { unit: screen_unit, room, .. } = camera.screen;
        let e_xy = reach_x.max(reach_y);
        // x need not be finer than w; if it is much coarser, the object lies far to the side.
        let e_w = reach_w.max(e_xy - room);
        let e_xy = e_xy.max(e_w);
        // Step 4: depth from w if w is at least 2⁻⁴ somewhere, so that offsets in 2⁻³² are fine enough; otherwise from d.
        let by_w = camera.depth_by_w.as_ref().filter(|_| e_w + shift >= -35);
        let in_w = |v: i64, up: i32| scale(v, up - 32 - shift - e_w);
        let e_d = reach_d.max(e_w);
        let (xy_over_w, d_over_w) = (e_xy - e_w, e_d - e_w);
        // Step 5: `project` shifts right by at least 0 and left by less than 32, which limits the leading zeros of w.
        let right = 28 - xy_over_w - screen_unit;
        let zeros = right.min(31 - d_over_w).min(9);
        let mut min_w = if zeros >= 0 && screen_unit + room >= ScreenVertex::RANGE_BITS {
            1 << (30 - zeros)
        } else {
            i32::MAX
        };
        let (mut origin, mut depth_scale, mut scale_down) = (4, 0, 0);
        if let Some(by_w) = by_w {
            // Rounding of d and of w costs less than 4 units each, of the offsets 2⁻³⁰. Both terms are below 2³¹.
            let near = in_w(by_w.near, 0).min(i32::MAX.into()) as u32 + (64 << d_over_w.min(25));
            min_w = min_w.max(near.min(i32::MAX as u32) as i32);
            origin += by_w.infinity;
            // `depth_scale` has 31 bits, or fewer where it is close to 0.
            scale_down = (34 + shift + e_w - shift_to_fit(by_w.scale as u64, 31)).clamp(0, 31);
            depth_scale = -in_w(by_w.scale, scale_down - 2).min(i32::MAX.into()) as i32;
        }
        let mut transform = Self {
            justify_factor: LinearForm::justify(justify, narrow),
            xy_over_w,
            right,
            bias: ScreenVertex::BIAS,
            d_over_w,
            min_w,
            origin,
            depth_scale,
            scale_down,
            by_d: by_w.is_none(),
            screen: camera.screen,
            far_clip: camera.far_clip,
            x: LinearForm::ZERO,
            y: LinearForm::ZERO,
            d: LinearForm::ZERO,
            w: LinearForm::ZERO,
        };
        transform.x = vertex_form(x, unit, e_xy);
        transform.y = vertex_form(y, unit, e_xy);
        transform.d = vertex_form(d, unit, e_d);
        transform.w = vertex_form(w, unit, e_w);
        transform
    }

    /// The transform of an object whose vertices are cached: it can [unpack](Self::unpack) them, and nothing else.
    #[inline(always)]
    pub(crate) const fn of_cached(camera: &Camera) -> Self {
        Self {
            w: LinearForm::ZERO,
            x: LinearForm::ZERO,
            y: LinearForm::ZERO,
            justify_factor: 0,
            min_w: i32::MAX,
            right: 0,
            bias: 0,
            origin: 0,
            depth_scale: 0,
            scale_down: 0,
            d_over_w: 0,
            d: LinearForm::ZERO,
            xy_over_w: 0,
            screen: camera.screen,
            by_d: false,
            far_clip: camera.far_clip,
        }
    }

    /// The vertex in clip space. Few vertices take this path, so code size counts and speed does not.
    #[inline(never)]
    pub(crate) fn clip_into<V: Coordinate>(&self, vertex: [V; 3], slot: &mut ClipCoords) {
        let v = vertex.map(|c| c.times(self.justify_factor));
        slot.xydw = [&self.x, &self.y, &self.d, &self.w].map(|form| form.at(v, V::NARROW));
    }

    /// The vertex in clip space.
    pub(crate) fn clip<V: Coordinate>(&self, vertex: [V; 3]) -> ClipCoords {
        let mut h = ClipCoords::ZERO;
        self.clip_into(vertex, &mut h);
        h
    }

    /// w of a vertex in clip space, in a unit common to the vertices of this transform: positive in front of the eye.
    pub(crate) fn w<V: Coordinate>(&self, vertex: &[V; 3]) -> i32 {
        self.w.at(vertex.map(|c| c.times(self.justify_factor)), V::NARROW)
    }

    /// The linear forms x, y (in one unit) and w (in another) of a justified vertex: coefficients in 2⁻³¹, and an offset.
    pub(crate) fn forms(&self) -> [([i32; 3], i32); 3] {
        [self.x.numbers(), self.y.numbers(), self.w.numbers()]
    }

    /// Linear forms of justified coordinates, coefficients in 2⁻³¹ and an offset, that are negative only outside of the view: beyond
    /// the left, right, top or bottom border of the viewport, or before the near plane, for a vertex and for new vertices between such
    /// vertices. Their rounding by some units of x, y, d and w is allowed for. Beyond a border, that of positions is less
    /// than the half pixel to the first pixel's centre.
    pub(crate) fn borders(&self) -> [[i64; 4]; 5] {
        const ROUNDING: i64 = 4;
        let wide = |([a, b, c], offset): ([i32; 3], i32)| [a, b, c, offset].map(i64::from);
        let ([x, y, w], [a, b, c, d]) = (self.forms().map(wide), wide(self.d.numbers()));
        let up = 1 << ((self.xy_over_w + self.screen.unit) & 31); // ≤ 2²¹
        let Size { width, height } = self.area().size;
        // w times half the extent, which is at most 2²², and ±v times up: below 2⁵⁴.
        let border = |[p, q, r, s]: [i64; 4], extent: u32, up: i64| {
            let (half, [a, b, c, d]) = (i64::from(extent) * 128, w);
            let rounding = ROUNDING * (half + up.abs());
            [half * a + up * p, half * b + up * q, half * c + up * r, half * d + up * s + rounding]
        };
        let [left, right] = [up, -up].map(|up| border(x, width, up));
        let [top, bottom] = [up, -up].map(|up| border(y, height, up));
        [left, right, top, bottom, [a, b, c, d + ROUNDING]]
    }

    /// The centres of the viewport's first and last column and row, relative to the origin of packed vertices, in 24.8.
    pub(crate) fn pixel_centres(&self) -> ([i32; 2], [i32; 2]) {
        let (Rectangle { top_left, size }, [x, y]) = (self.area(), self.screen.packed_origin);
        let first = [top_left.x * 256 + 128 - x, top_left.y * 256 + 128 - y]; // the viewport lies in the guard band
        let [width, height] = [size.width, size.height].map(|extent| (extent as i32 - 1) * 256);
        (first, [first[0] + width, first[1] + height])
    }

    /// The viewport's pixels.
    pub(crate) const fn area(&self) -> &Rectangle {
        &self.screen.area
    }

    /// Whether [`project`](Self::project) needs d: the far plane clips, or w alone does not decide the near test.
    pub(crate) fn needs_d(&self, depth: bool, far: bool) -> bool {
        self.by_d || far && !depth
    }

    /// Projects a vertex to the screen. Returns `None` if it must be clipped (before the near plane or too close to it to tell,
    /// outside the guard band, beyond a far plane that clips), is out of the packed range, or so near to the eye that 32 bits
    /// do not suffice: [`without_position`](Self::without_position) is for these. `by_d` is the result of
    /// [`needs_d`](Self::needs_d).
    ///
    /// With 1/w = R·2^(n − 61): `x/w · 2^(e + unit) = ⌊x·R/2³²⌋ · 2^(n − 29 + e + unit)`, a right
    /// shift by `28 − e − unit − n ≥ 0` to halves, rounded to nearest with ties up.
    #[inline(always)]
    pub(crate) fn project<V: Coordinate, const DEPTH: bool>(
        &self,
        vertex: &[V; 3],
        by_d: bool,
        far: bool,
    ) -> Option<ScreenVertex> {
        let v = map3(*vertex, |c| c.times(self.justify_factor));
        let w = self.w.at(v, V::NARROW);
        if w < self.min_w {
            return None;
        }
        let forms = || [self.x.at(v, V::NARROW), self.y.at(v, V::NARROW)];
        let d_at_vertex = || if by_d { self.d.at(v, V::NARROW) } else { 0 };
        let is_cut = |d| d < 0 || (DEPTH || far) && self.may_be_beyond_far(d, w);
        // Cores with enough registers evaluate all forms first, which frees the registers of v; LLVM does not move them across
        // the branch below. A Cortex-M0 evaluates each form where it is used, so that it tests `by_d` once.
        let early = (!CORTEX_M0).then(|| (forms(), d_at_vertex()));
        if early.is_some_and(|(_, d)| by_d && is_cut(d)) {
            return None;
        }
        let r = reciprocal_of_large(w);
        let n = r.shift as i32;
        let over_w = |forms: [i32; 2]| {
            let right = (self.right - n) & 31;
            map2(forms, |v| mul_high(v, r.mantissa) >> right)
        };
        let early = early.map(|(forms, d)| (over_w(forms), d));
        let mut depth = 0;
        if by_d {
            let d = early.map_or_else(d_at_vertex, |(_, d)| d);
            if early.is_none() && is_cut(d) {
                return None;
            }
            if DEPTH {
                let d = d << ((n + self.d_over_w) & 31) >> 2; // up to w: 31 bits
                depth = (self.origin + mul_high(d, r.mantissa)) >> 3;
            }
        } else if DEPTH {
            depth =
                (self.origin + (mul_high(self.depth_scale, r.mantissa) >> ((self.scale_down - n) & 31))) >> 3;
        }
        let [x, y] = early.map_or_else(|| over_w(forms()), |(positions, _)| positions);
        if DEPTH && depth > SURELY_BEFORE_FAR {
            if far && self.is_beyond_far(vertex) {
                return None;
            }
            depth = depth.min(FARTHEST);
        }
        ScreenVertex::new::<DEPTH>(x, y, self.bias, depth)
    }

    /// Returns n, 7 … 21, where x/w and y/w in clip space are in units of 2ⁿ sub-pixels.
    pub(crate) fn sub_pixels(&self) -> i32 {
        self.xy_over_w + self.screen.unit
    }

    /// Whether a vertex lies before the near plane.
    #[inline(always)]
    fn is_before_near<V: Coordinate>(&self, vertex: &[V; 3]) -> bool {
        self.d.at(vertex.map(|c| c.times(self.justify_factor)), V::NARROW) < 0
    }

    /// A vertex that [`project`](Self::project) gives no position, with the clip planes that it lies outside of: only the near
    /// plane if it lies before that, otherwise all of them. `far`: whether the far plane clips.
    #[cold]
    #[inline(never)]
    pub(crate) fn without_position<V: Coordinate>(&self, vertex: &[V; 3], far: bool) -> ScreenVertex {
        if self.is_before_near(vertex) {
            return ScreenVertex::without_position(ScreenVertex::NEAR);
        }
        ScreenVertex::without_position(match self.planes_outside(&self.clip(*vertex), far) {
            0 => ScreenVertex::ASIDE,
            planes => planes,
        })
    }

    /// The clip planes that a point lies outside of: bit i is set if its [`distance`](Self::distance) from plane i is negative.
    /// `far`: whether the far plane clips.
    #[inline(never)] // rare path: code size counts
    pub(crate) fn planes_outside(&self, h: &ClipCoords, far: bool) -> u32 {
        let [x, y, d, w] = h.xydw;
        // Most points lie inside the guard band, far from its border: `|x/w| < 2^room` follows from ⌊|x| / 2^down⌋ < w.
        let down = (self.screen.room - self.xy_over_w) & 31; // 0 … 14
        let reach = (x.unsigned_abs() >> down).max(y.unsigned_abs() >> down);
        let is_inside_guard_band = w > 0 && reach < w.unsigned_abs();
        let mut outside = u32::from(d < 0);
        let mut plane = if is_inside_guard_band { 5 } else { 1 };
        let planes = if far && self.may_be_beyond_far(d, w) { 6 } else { 5 };
        while plane < planes {
            outside |= u32::from(self.distance(plane, h) < 0) << (plane & 31);
            plane = opaque_next(plane);
        }
        outside
    }

    /// Whether w − d may be negative. d is stored times 65535/65536.
    #[inline(always)]
    fn may_be_beyond_far(&self, d: i32, w: i32) -> bool {
        d >= (w - (w >> 16) - 1) >> self.d_over_w.min(31)
    }

    #[cold]
    #[inline(never)]
    fn is_beyond_far<V: Coordinate>(&self, vertex: &[V; 3]) -> bool {
        self.distance(5, &self.clip(*vertex)) < 0
    }

    /// Unpacks a vertex that [is on the screen](ScreenVertex::is_on_screen); its depth is 0 without `DEPTH`.
    #[inline(always)]
    pub(crate) fn unpack<const DEPTH: bool>(&self, corner: ScreenVertex) -> UnpackedVertex {
        let ([x, y], offset) = (self.screen.packed_origin, corner.offset::<DEPTH>());
        UnpackedVertex {
            point: ScreenPoint::inside(x + offset.x(), y + offset.y()),
            depth: if DEPTH { corner.depth() } else { 0 },
        }
    }

    /// Projects any point that the clipper did not remove, in 64-bit arithmetic. Where [`project`](Self::project) applies it
    /// gives equal bits (test `the_packed_and_the_wide_path_give_the_same_bits`). `depth` computes the depth, if the caller
    /// needs it.
    pub(crate) fn project_wide(&self, h: &ClipCoords, depth: Option<DepthOf>) -> UnpackedVertex {
        let [x, y, d, w] = h.xydw;
        let r = reciprocal(w);
        let left = r.shift as i32 + self.xy_over_w + self.screen.unit - 61; // ≤ 30 + 21 − 61
        let [cx, cy] = self.screen.centre();
        UnpackedVertex {
            point: ScreenPoint::inside(quotient(x, r.mantissa, left, cx), quotient(y, r.mantissa, left, cy)),
            depth: depth.map_or(0, |depth| depth(self, d, r)),
        }
    }

    /// Depth in 16.8, from d and 1/w.
    pub(crate) fn depth(&self, d: i32, r: Reciprocal) -> i32 {
        (self.depth_wide(d, r) >> 35).clamp(0, FARTHEST.into()) as i32
    }

    /// Depth in 2⁻⁵⁹ from d and 1/w, including the half that rounds to 2⁻²⁴.
    #[inline(never)] // rare path: code size counts
    fn depth_wide(&self, d: i32, r: Reciprocal) -> i64 {
        let n = r.shift as i32;
        let (numerator, down) = match self.by_d {
            true => ((scale(d.into(), n + self.d_over_w) >> 2).min(i32::MAX.into()) as i32, 0),
            false => (self.depth_scale, (self.scale_down - n).max(0)),
        };
        // At most 2⁶² + 2⁶².
        (i64::from(self.origin) << 32) + (mul_wide(numerator, r.mantissa) >> down)
    }

    /// [`project_wide`](Self::project_wide) without the snap to sub-pixels and without clamping: x and y in 2⁻³² px, depth in
    /// 2⁻³² steps. For error measurement.
    pub(crate) fn unsnapped(&self, h: &ClipCoords) -> [i64; 3] {
        let [x, y, d, w] = h.xydw;
        let r = reciprocal(w);
        let n = r.shift as i32;
        // From 2⁻⁶¹ of 2^unit sub-pixels, and of 2¹⁶ steps, to 2⁻³²: saturating.
        let up = n + self.xy_over_w + self.screen.unit - 37;
        let along = |v: i32, centre: i32| add(scale(mul_wide(v, r.mantissa), up), i64::from(centre) << 24);
        let [cx, cy] = self.screen.centre();
        [along(x, cx), along(y, cy), (self.depth_wide(d, r) >> 11) - (4 << 21)]
    }

    /// The signed distance from a clip plane, negative outside, scaled by a positive factor per plane. Planes in order: near,
    /// then left, right, top and bottom of the guard band, then far. Plane 5 (far): below 2⁶², and at most 2⁴⁷ inside if d is
    /// not negative; all other planes: at most 2⁵⁴.
    #[inline(never)] // rare path: code size counts
    pub(crate) fn distance(&self, plane: usize, h: &ClipCoords) -> i64 {
        let ([x, y, d, w], [left, top]) = (h.xydw, self.screen.packed_origin);
        // m·w / 2^down + n·v
        let (m, down, n, v) = match plane {
            0 => return d.into(),
            1..=4 => {
                let (v, origin) = if plane < 3 { (x, left) } else { (y, top) };
                let up = 1 << ((self.xy_over_w + self.screen.unit) & 31); // ≤ 2²¹
                let [centre, _] = ScreenVertex::CENTRE; // from the origin, along x and along y
                match plane & 1 {
                    0 => (GUARD_BAND * 256 - centre - origin, 0, -up, v),
                    _ => (GUARD_BAND * 256 + centre + origin, 0, up, v),
                }
            }
            _ => {
                // w − d; d is stored as 65535/65536 of itself and multiplied by at most 2³⁰. Where the exponents
                // differ by more than 14, w is shifted down instead.
                let up = self.d_over_w.min(14);
                (65_535, (self.d_over_w - up).min(63), -(1 << (16 + up)), d)
            }
        };
        ((i64::from(m) * i64::from(w)) >> down) + i64::from(n) * i64::from(v)
    }

    /// Whether the far plane clips.
    pub(crate) fn clips_at_far(&self) -> bool {
        self.far_clip
    }
}

/// The type of [`VertexTransform::depth`]: passed as a value, so that images without depth link no code for it.
pub(crate) type DepthOf = fn(&VertexTransform, i32, Reciprocal) -> i32;

/// A depth in 16.8, eight depth steps before the far plane: the errors of d and w are smaller, so all vertices up to this depth
/// lie before it.
const SURELY_BEFORE_FAR: i32 = 65_527 << 8;

/// `v · mantissa · 2^shift`, rounded to nearest, plus `more`, clamped to the guard band; for shift < 0 and |more| < 2²⁴.
#[inline(never)] // rare path: code size counts
fn quotient(v: i32, mantissa: i32, shift: i32, more: i32) -> i32 {
    const REACH: i64 = GUARD_BAND as i64 * 256;
    (scale(mul_wide(v, mantissa), shift) + i64::from(more)).clamp(-REACH, REACH) as i32
}

/// The least exponent e for which the value of the row at every justified coordinate, in units of 2^e, and its coefficients fit
/// 32-bit integers. A justified coordinate is in units of 2^unit.
fn min_exponent(row: &Row, unit: i32) -> i32 {
    // In 2⁻³²: |Σ linear·v| ≤ Σ|linear| · 2^(exponent − 30) · 2^(unit + 31), |linear| ≤ 2³⁰.
    let [a, b, c] = row.linear;
    let (a, b, c) = (a.unsigned_abs(), b.unsigned_abs(), c.unsigned_abs());
    let sum = i64::from(a + b + c); // ≤ 3·2³⁰
    let linear = scale(sum, row.exponent + unit + 33) as u64; // < 2⁶³
    let bound = linear + row.offset.unsigned_abs(); // ≤ 2⁶³ + 2⁶²
    let bound = bound + (bound >> 16) + 16; // headroom of 2⁻¹⁶ for the rounding of coefficients
    let result = shift_to_fit(bound, 63); // below 2³¹
    let largest = a.max(b).max(c);
    if largest == 0 {
        return result;
    }
    // Each coefficient below 2³⁰ − 2¹⁵, so that it splits into 15 + 16 signed bits.
    result.max(row.exponent + unit + 1 + i32::from(largest > (1 << 30) - (1 << 16)))
}

/// The row as integers over justified coordinates, in units of 2^exponent.
#[inline(never)] // set-up: code size counts
fn vertex_form(row: &Row, unit: i32, exponent: i32) -> LinearForm {
    // |coefficient| < 2³⁰ and |offset| < 2⁶³ by `min_exponent`.
    let down = exponent - (row.exponent + unit + 1);
    let [mut a, mut b, mut c] = row.linear;
    if down > 0 {
        // Not `map`, which is a loop at opt-level "s".
        (a, b, c) = (scale_word(a, down), scale_word(b, down), scale_word(c, down));
    } // otherwise `down` is 0, or the coefficients are
    let linear = [a, b, c];
    LinearForm::new(linear, scale(row.offset, -exponent))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Projection, ViewTransform, Viewport, Window};
    use crate::math::random::Random;
    use crate::math::{Angle, Point3, Scalar, Vector3};
    use embedded_graphics_core::geometry::{Point, Size};

    /// Compares `project` and `project_wide` bit by bit for random vertices; returns how many `project` gave a position.
    fn compare(lens: &Projection, eye: f32, seed: u64) -> usize {
        let viewport = Viewport::new(Point::new(-7, 3), Size::new(240, 180)).unwrap();
        let at = Point3::from_f32(eye * 0.3, eye * 0.2, eye).unwrap();
        let origin = Point3::from_ints(0, 0, 0);
        let viewing = ViewTransform::look_at(at, origin, Vector3::from_ints(0, 1, 0)).unwrap();
        let camera = Camera::new(&viewing, lens, &viewport);
        let model = Affine::rotation_y(Angle::degrees(33));
        let transform = VertexTransform::new(&camera, &model, -14, 16, true);
        let (mut random, mut positions) = (Random(seed), 0);
        for _ in 0..20_000 {
            let vertex = random.vertex();
            let h = transform.clip(vertex);
            let plain = transform.project::<_, false>(&vertex, transform.needs_d(false, true), true);
            let deep = transform.project::<_, true>(&vertex, transform.needs_d(true, true), true);
            for (corner, depth) in [(plain, false), (deep, true)] {
                let planes: u32 =
                    (0..6).map(|plane| u32::from(transform.distance(plane, &h) < 0) << plane).sum();
                assert_eq!(transform.planes_outside(&h, true), planes, "{vertex:?}");
                assert_eq!(transform.planes_outside(&h, false), planes & 31, "{vertex:?}");
                assert_eq!(transform.is_before_near(&vertex), planes & 1 != 0, "{vertex:?}");
                if let Some(corner) = corner.filter(|corner| corner.is_on_screen()) {
                    assert_eq!(planes, 0, "{vertex:?}");
                    let (packed, wide) = (
                        if depth {
                            transform.unpack::<true>(corner)
                        } else {
                            transform.unpack::<false>(corner)
                        },
                        transform.project_wide(&h, Some(VertexTransform::depth)),
                    );
                    assert_eq!(packed.point, wide.point, "{vertex:?}");
                    assert!(!depth || packed.depth == wide.depth, "{vertex:?}: {packed:?} {wide:?}");
                    // Rounding to nearest moves by at most half a unit, of 2²⁴.
                    let snapped = [wide.point.x, wide.point.y, wide.depth].map(|v| i64::from(v) << 24);
                    for (axis, (snapped, exact)) in
                        snapped.into_iter().zip(transform.unsnapped(&h)).enumerate()
                    {
                        let is_clamped = axis == 2 && wide.depth == FARTHEST && exact > snapped;
                        assert!(
                            is_clamped || (snapped - exact).abs() <= 1 << 23,
                            "{vertex:?} {axis}: {snapped} {exact}"
                        );
                    }
                    positions += 1;
                }
            }
        }
        positions
    }

    /// The error of a vertex's depth against `d/w`, or `A − B/w`, of the integers that it is computed from, in 2⁻⁸ steps.
    fn depth_error(transform: &VertexTransform, vertex: [i16; 3]) -> Option<f64> {
        let corner = transform.project::<_, true>(&vertex, transform.needs_d(true, true), true);
        let h = transform.clip(vertex);
        let depth = corner?.depth();
        if depth == FARTHEST {
            return None;
        }
        // All over w, in 2⁻²⁷: `d·2^d_over_w`, and `origin + depth_scale·2^(2 − scale_down)` where depth_scale is 2⁻²⁷ · 2^29.
        let [_, _, d, w] = h.xydw.map(i128::from);
        let exact = match transform.by_d {
            true => d << (27 + transform.d_over_w),
            false => {
                let scaled = i128::from(transform.depth_scale) << 29 >> transform.scale_down;
                i128::from(transform.origin - 4) * w + scaled
            }
        };
        let off = (i128::from(depth) << 3) * w - exact; // 2⁻²⁷ · w
        Some((off as f64 / w as f64 / 8.0).abs())
    }

    /// ARCHITECTURE.md, "Numbers": half a unit from rounding, and the bits truncated before.
    #[test]
    fn depth_of_a_vertex_is_within_0_7_of_its_unit() {
        let number = |v| Scalar::try_from(v).expect("in range");
        let viewport = Viewport::new(Point::zero(), Size::new(240, 180)).unwrap();
        let (mut random, mut largest, mut counts) = (Random(7), [0.0_f64; 2], [0; 2]);
        for (near, far) in
            [(0.05, 3.0), (0.5, 20.0), (1.0, 1.2), (1.0, 1.4), (1.0, 3000.0), (2.5, 3.5), (0.001, 9.0)]
        {
            for eye in [0.6, 1.4, 3.0, 12.0] {
                let (near, far) = (number(near), number(far));
                let at = Point3::new(Scalar::ZERO, Scalar::ZERO, number(eye));
                let origin = Point3::from_ints(0, 0, 0);
                let viewing = ViewTransform::look_at(at, origin, Vector3::from_ints(0, 1, 0)).unwrap();
                let side = number(1.5);
                let window = Window { left: -side, right: side, bottom: -side, top: side };
                let lenses = [
                    Projection::perspective(Angle::degrees(60), viewport.size(), near, far).unwrap(),
                    Projection::orthographic(window, near, far).unwrap(),
                ];
                for lens in lenses {
                    let camera = Camera::new(&viewing, &lens, &viewport);
                    let transform =
                        VertexTransform::new(&camera, &Affine::rotation_y(Angle::degrees(33)), -14, 16, true);
                    let source = usize::from(transform.by_d);
                    for _ in 0..20_000 {
                        if let Some(error) = depth_error(&transform, random.vertex()) {
                            largest[source] = largest[source].max(error);
                            counts[source] += 1;
                        }
                    }
                }
            }
        }
        assert!(counts.iter().all(|&count| count > 50_000), "{counts:?}");
        assert!(largest.iter().all(|&error| error <= 0.7), "{largest:?}"); // the largest measured is 0.56
    }

    #[test]
    fn the_packed_and_the_wide_path_give_the_same_bits() {
        let size = Size::new(240, 180);
        let number = |v| Scalar::try_from(v).expect("in range");
        let mut positions = 0;
        for (near, far) in [(0.05, 3.0), (0.5, 20.0), (1.0, 1.2), (1.0, 3000.0), (2.5, 3.5), (0.001, 9.0)] {
            for eye in [0.6, 1.4, 3.0, 12.0] {
                let (near, far) = (number(near), number(far));
                let lens = Projection::perspective(Angle::degrees(60), size, near, far).unwrap();
                positions += compare(&lens, eye, 1);
                let side = number(1.5);
                let window = Window { left: -side, right: side, bottom: -side, top: side };
                positions += compare(&Projection::orthographic(window, near, far).unwrap(), eye, 2);
            }
        }
        assert!(positions > 200_000, "{positions}");
    }

    /// The quick test for the guard band agrees with its four planes' distances on either side of where it gives up.
    #[test]
    fn planes_outside_are_those_of_negative_distance() {
        let (size, random) = (Size::new(240, 180), &mut Random(44));
        let (near, far) = (Scalar::from_ratio(1, 2), Scalar::from_int(20));
        let lens = Projection::perspective(Angle::degrees(60), size, near, far).unwrap();
        let view = ViewTransform::look_at(
            Point3::from_ints(1, 2, 3),
            Point3::from_ints(0, 0, 0),
            Vector3::from_ints(0, 1, 0),
        );
        let [mut inside, mut outside] = [0; 2];
        // From the middle to a corner of the guard band: the centre decides how many powers of two are free.
        for corner in [0, 300, 4000, 7900] {
            let viewport = Viewport::new(Point::new(corner, -corner), size).unwrap();
            let camera = Camera::new(view.as_ref().unwrap(), &lens, &viewport);
            let transform = VertexTransform::new(&camera, &Affine::identity(), -8, 16, true);
            let down = transform.screen.room - transform.xy_over_w;
            for i in 0..40_000 {
                let w = [random.within(3), random.within(40), random.within(1 << 15)][i % 3];
                let mut near_border = || {
                    let off = random.within([1, 1 << down, 3 << down][i / 3 % 3]);
                    ((w << down) + off) * [1, -1][i / 9 % 2]
                };
                let (x, y) = (near_border(), near_border());
                let h = ClipCoords { xydw: [x, [y, 0, y >> 3][i / 18 % 3], random.within(1 << 20), w] };
                let exact = (0..6).filter(|&plane| transform.distance(plane, &h) < 0);
                let exact = exact.fold(0, |bits, plane| bits | 1 << plane);
                assert_eq!(transform.planes_outside(&h, true), exact, "{h:?} {down}");
                *if exact & 0b11110 == 0 { &mut inside } else { &mut outside } += 1;
            }
        }
        assert!(inside > 10_000 && outside > 10_000, "{inside} {outside}");
    }
}
