//! The per-vertex chain: model coordinates to the screen, in integers.
//!
//! Once per object the whole chain up to clip space is folded into four linear forms, with the
//! eye subtracted first. Once per vertex: three or four forms, one reciprocal, two or three
//! products. Error budget: ARCHITECTURE.md, "Numbers".

use super::{Camera, Corner, Image, Screen};
use crate::math::num::{add, bits_of, excess, magnitude, mul_high, mul_wide, reciprocal, scale};
use crate::math::row::{forms, Rows};
use crate::math::{product, Affine, Coordinate, Form, Homogeneous, Row};
use crate::raster::{ScreenPoint, FARTHEST};
use crate::space::{Model, World};
use embedded_graphics_core::primitives::Rectangle;

/// A camera's view of one object: its vertices to clip space and to the screen.
///
/// Values are `integer · 2^exponent` with one exponent `e_xy` for x and y, one for d and one for
/// w. Only differences of exponents are kept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placement {
    x: Form,
    y: Form,
    d: Form,
    w: Form,
    /// Left shift that justifies a vertex coordinate to 32 bits.
    justify: u32,
    /// e_xy − e_w: 0 … room.
    xy_over_w: i32,
    /// e_d − e_w: never negative.
    d_over_w: i32,
    /// Least w for which the fast path keeps all its bits.
    least_w: i32,
    /// |x|, |y| < w · 2^(wide − narrow) has a place in a [`Corner`]; one of the two is 0.
    wide: u8,
    narrow: u8,
    screen: Screen,
    far_clip: bool,
}

impl Placement {
    /// `exponent`: of the mesh, coordinate = vertex · 2^exponent; `justify`: left shift that
    /// brings its largest coordinate to the top of 32 bits.
    #[inline(never)] // set-up: small is better
    pub(crate) fn new(camera: &Camera, model: &Affine<Model, World>, exponent: i32, justify: u32) -> Self {
        // 1 Model to view, relative to the eye.
        let (m, m_exponent) = model.linear();
        let (linear, linear_exponent) = product(&camera.axes, 0, m, m_exponent);
        let offset = forms(&camera.axes, 0, &model.offset_from(camera.eye), &[0; 3]);
        let view = Rows { linear, exponent: linear_exponent, offset };
        // 2 View to clip; a factor common to all four rows changes nothing, and where numbers are
        //   large (thin volumes, narrow windows, far away) one keeps them from saturating. In 2⁻³² an
        //   object reaches three coefficients times 2^(31 + unit), and lies at `offset`.
        let unit = exponent - justify as i32;
        let largest = magnitude(view.linear.as_flattened());
        let around = match largest {
            0 => 0,
            _ => excess(largest.into(), 30) + linear_exponent + unit + 31 + 2 + 32,
        };
        let bits = excess(bits_of(&view.offset), 0).max(around) + 1;
        let [x, y, d, w] = &camera.rows;
        let shift = x.overflow(bits).max(y.overflow(bits)).max(d.overflow(bits)).max(w.overflow(bits)).max(0);
        let (x, y, d, w) = (x.of(&view, shift), y.of(&view, shift), d.of(&view, shift), w.of(&view, shift));
        // 3 Exponents from what the rows can reach over the object. A justified coordinate v
        //   stands for v·2^unit.
        let Screen { unit: screen_unit, room, .. } = camera.screen;
        let e_xy = reach(&x, unit).max(reach(&y, unit));
        // Finer x than w is of no use; much coarser x means an object far to the side.
        let e_w = reach(&w, unit).max(e_xy - room);
        let e_xy = e_xy.max(e_w);
        let e_d = reach(&d, unit).max(e_w);
        let (xy_over_w, d_over_w) = (e_xy - e_w, e_d - e_w);
        // 4 The fast path shifts right by at least one: see `project`. Leading zeros of w at most:
        let zeros = (29 - xy_over_w - screen_unit).min(13 - d_over_w);
        // 5 Corners reach 2^18 sub-pixels, where the guard band does: −24 … 11.
        let reach = (Corner::REACH - screen_unit).min(room) - xy_over_w;
        Self {
            x: form(&x, unit, e_xy),
            y: form(&y, unit, e_xy),
            d: form(&d, unit, e_d),
            w: form(&w, unit, e_w),
            justify,
            xy_over_w,
            d_over_w,
            least_w: if zeros >= 1 { 1 << (31 - zeros) } else { i32::MAX },
            wide: reach.max(0) as u8,
            narrow: (-reach).clamp(0, 31) as u8,
            screen: camera.screen,
            far_clip: camera.far_clip,
        }
    }

    /// The vertex in clip space, where vertices are few: small is better.
    #[inline(never)]
    pub(crate) fn clip_one<V: Coordinate>(&self, vertex: [V; 3]) -> Homogeneous {
        let v = vertex.map(|c| c.justify(self.justify));
        let at = |form: &Form| form.at_one(&v, V::NARROW);
        Homogeneous { x: at(&self.x), y: at(&self.y), d: at(&self.d), w: at(&self.w) }
    }

    /// The viewport's pixels.
    pub(crate) const fn area(&self) -> &Rectangle {
        &self.screen.area
    }

    /// The vertex in clip space.
    #[inline(always)]
    pub(crate) fn clip<V: Coordinate>(&self, vertex: [V; 3]) -> Homogeneous {
        let v = vertex.map(|c| c.justify(self.justify));
        let at = |form: &Form| form.at(v, V::NARROW);
        Homogeneous { x: at(&self.x), y: at(&self.y), d: at(&self.d), w: at(&self.w) }
    }

    /// The vertex on the screen, or an empty corner when it must be clipped or lies farther out than
    /// corners reach: in front of near, outside the guard band, beyond far if that cuts, or so near to
    /// the eye that 32 bits do not carry it.
    ///
    /// With 1/w = R·2^(n − 61): `x/w · 2^(e + unit) = ⌊x·R/2³²⌋ · 2^(n − 29 + e + unit)`, a right
    /// shift by `29 − e − unit − n ≥ 1`, rounded to nearest with ties up.
    #[inline(always)]
    pub(crate) fn project<V: Coordinate, const DEPTH: bool>(&self, vertex: [V; 3], far: bool) -> Corner {
        let h = self.clip(vertex);
        // |v| >> wide < w >> narrow implies |v| < w·2^(wide − narrow). (v ^ v >> 31 is |v|, or |v| − 1:
        // then it may be equal, and still has a place.)
        let limit = h.w >> self.narrow;
        let beyond = |v: i32| ((v ^ (v >> 31)) >> self.wide) >= limit;
        if h.d < 0 || h.w < self.least_w || beyond(h.x) || beyond(h.y) {
            return Corner::EMPTY;
        }
        // d·2^d_over_w at most w less what d is stored short: then w − d is not negative. Rarely not so.
        let limit = (h.w - (h.w >> 16) - 1) >> self.d_over_w.min(31);
        if far && h.d >= limit && self.beyond_far(&h) < 0 {
            return Corner::EMPTY;
        }
        let r = reciprocal(h.w);
        let n = r.shift as i32;
        let right = (29 - self.xy_over_w - self.screen.unit - n - 1).clamp(0, 31); // by least_w
        let along = |v: i32| ((mul_high(v, r.mantissa) >> right) + 1) >> 1;
        let depth = if DEPTH {
            let right = 37 - self.d_over_w - n; // ≥ 25 by least_w
            let depth = if right > 32 {
                (mul_high(h.d, r.mantissa) >> (right - 33)) + 1
            } else {
                // Near the eye the low word counts. Beyond far the quotient may leave 32 bits.
                (mul_wide(h.d, r.mantissa) >> (right - 1)).min(1 << 30) as i32 + 1
            };
            (depth >> 1).min(FARTHEST)
        } else {
            0
        };
        Corner::new(along(h.x), along(h.y), depth)
    }

    /// Where a corner that has a place lies on the screen, with its depth if that is asked for.
    #[inline(always)]
    pub(crate) fn at<const DEPTH: bool>(&self, corner: Corner) -> Image {
        let ([x, y], [cx, cy], offset) = (self.screen.centre, Corner::CENTRE, corner.offset());
        Image {
            point: ScreenPoint::inside(x - cx + offset.x(), y - cy + offset.y()),
            depth: if DEPTH { corner.depth() } else { 0 },
        }
    }

    /// [`project`](Self::project) for any point that the clipper left, in wide arithmetic: the
    /// same bits where both work.
    #[inline(never)] // rare: small is better
    pub(crate) fn image(&self, h: &Homogeneous) -> Image {
        let r = reciprocal(h.w);
        let n = r.shift as i32;
        let right = 61 - n - self.xy_over_w - self.screen.unit; // ≥ 61 − 30 − 21
        let [cx, cy] = self.screen.centre;
        let depth = quotient(h.d, r.mantissa, n + self.d_over_w - 37, 0);
        Image {
            point: ScreenPoint::clamped(
                quotient(h.x, r.mantissa, -right, cx),
                quotient(h.y, r.mantissa, -right, cy),
            ),
            depth: depth.clamp(0, FARTHEST),
        }
    }

    /// [`image`](Self::image) before the snap: x and y in 2⁻³² px, depth in 2⁻³² steps, wherever they
    /// lie. For measuring.
    pub(crate) fn unsnapped(&self, h: &Homogeneous) -> [i64; 3] {
        let r = reciprocal(h.w);
        let n = r.shift as i32;
        // From 2⁻⁶¹ of 2^unit sub-pixels, and of 2¹⁶ steps, to 2⁻³²: saturating.
        let up = n + self.xy_over_w + self.screen.unit - 37;
        let along = |v: i32, centre: i32| add(scale(mul_wide(v, r.mantissa), up), i64::from(centre) << 24);
        let [cx, cy] = self.screen.centre;
        [along(h.x, cx), along(h.y, cy), add(scale(mul_wide(h.d, r.mantissa), n + self.d_over_w - 13), 0)]
    }

    /// Signed distances from the planes in the order near, left, right, top, bottom, far of the
    /// view volume cut at the guard band; each scaled by a positive factor of its own, negative
    /// outside. At most 2⁵⁴.
    #[inline(never)] // rare: small is better
    pub(crate) fn distance(&self, plane: usize, h: &Homogeneous) -> i64 {
        let [cx, cy] = self.screen.centre;
        let (v, centre) = match plane {
            0 => return h.d.into(),
            1 | 2 => (h.x, cx),
            3 | 4 => (h.y, cy),
            _ => return self.beyond_far(h),
        };
        let up = 1 << ((self.xy_over_w + self.screen.unit) & 31); // ≤ 2²¹
        let (up, centre) = if plane & 1 == 0 { (-up, -centre) } else { (up, centre) };
        i64::from(crate::raster::GUARD_BAND * 256 + centre) * i64::from(h.w) + i64::from(v) * i64::from(up)
    }

    /// Whether the camera cuts at the far plane.
    pub(crate) fn cuts_at_far(&self) -> bool {
        self.far_clip
    }

    /// `w − d` (d is stored times 65535/65536), negative beyond the far plane.
    #[cold]
    #[inline(never)]
    fn beyond_far(&self, h: &Homogeneous) -> i64 {
        // Beyond a difference of 14 bits w gives way: 47 + 14 bits at most.
        let up = self.d_over_w.min(14);
        let down = (self.d_over_w - up).min(63);
        ((i64::from(h.w) * 65_535) >> down) - i64::from(h.d) * i64::from(1 << (16 + up))
        // 2³⁰ at most
    }
}

/// `v · mantissa · 2^shift`, rounded to nearest, and `more`; within ±2³⁰. |more| < 2²⁴.
#[inline(never)] // rare: small is better
fn quotient(v: i32, mantissa: i32, shift: i32, more: i32) -> i32 {
    add(scale(mul_wide(v, mantissa), shift), more.into()).clamp(-(1 << 30), 1 << 30) as i32
}

/// The least exponent with which the form fits its integers over all justified coordinates.
#[inline(never)] // set-up: small is better
fn reach(row: &Row, unit: i32) -> i32 {
    // In 2⁻³²: |Σ linear·v| ≤ Σ|linear| · 2^(exponent − 30) · 2^(unit + 31), |linear| ≤ 2³⁰.
    let [a, b, c] = row.linear.map(i32::unsigned_abs);
    let sum = i64::from(a) + i64::from(b) + i64::from(c);
    let linear = scale(sum, row.exponent + unit + 33).unsigned_abs(); // ≤ 2⁶²
    let bound = linear + row.offset.unsigned_abs(); // ≤ 2⁶³
                                                    // Head-room for the rounding of coefficients: 2⁻¹⁶ of it all.
    let bound = bound.saturating_add((bound >> 16) + 16);
    let result = excess(bound, 63); // below 2³¹
    let largest = a.max(b).max(c);
    if largest == 0 {
        return result;
    }
    // Each coefficient below 2³⁰ − 2¹⁵, so that it splits into 15 + 16 signed bits.
    result.max(row.exponent + unit + 1 + i32::from(largest > (1 << 30) - (1 << 16)))
}

/// The row as integers over justified coordinates, in units of 2^exponent.
#[inline(never)] // set-up: small is better
fn form(row: &Row, unit: i32, exponent: i32) -> Form {
    // |coefficient| < 2³⁰ and |offset| < 2⁶³ by `reach`.
    let linear = row.linear.map(|m| scale(i64::from(m), row.exponent + unit + 1 - exponent) as i32);
    Form::new(linear, scale(row.offset, -exponent))
}
