//! Designs for objects that lie between a distance and twice that distance: they are scaled so that w needs no normalising.

use crate::chain::{Design, ScreenVertex};
use crate::divide::{sixteen_bits, OneStep, Reciprocal, TwoSteps};
use crate::form::{lifted, Form};
use crate::num::{exp2, log2_above, mul_high, mul_wide, nearest32, sum_of, within};
use crate::Object;

/// The factor that brings the farthest vertex to just below 2³¹, and the number of bits by which x and y are shorter. `None` if
/// the nearest vertex is then below 2³⁰.
fn factor(object: &Object) -> Option<(f64, i32)> {
    let (row, offset) = (object.linear()[2], object.offset()[2]);
    let reach = sum_of(row) * Object::REACH;
    let (least, most) = (offset - reach, (offset + reach) * (1.0 + exp2(-14)));
    (least > object.near && 2.0 * least > most * (1.0 + exp2(-14)))
        .then(|| (exp2(31) / most, object.half_picture().max(log2_above(object.focal))))
}

/// Rows of 30 bits, two Newton steps.
pub(crate) struct ScaledThirty {
    x: Form,
    y: Form,
    w: Form,
    /// x/w · 2^beyond is in pixels.
    beyond: i32,
}

impl ScaledThirty {
    #[inline(always)]
    fn clip(&self, v: [i16; 3]) -> [i32; 3] {
        let v = lifted(v);
        [self.x.at(v), self.y.at(v), self.w.at(v)]
    }
}

impl Design for ScaledThirty {
    type Vertex = [i16; 3];

    fn new(object: &Object) -> Option<Self> {
        let (factor, beyond) = factor(object)?;
        let ([x, y, w], [ox, oy, ow]) = (object.linear(), object.offset());
        let to_xy = factor * object.focal * exp2(-beyond);
        // Far to the side, x does not fit.
        let fits = |row, offset: f64| (sum_of(row) * Object::REACH + offset.abs()) * to_xy < exp2(31) - 2.0;
        (fits(x, ox) && fits(y, oy)).then(|| Self {
            x: Form::scaled(x, ox, to_xy),
            y: Form::scaled(y, oy, to_xy),
            w: Form::scaled(w, ow, factor),
            beyond,
        })
    }

    #[inline(always)]
    fn corner(&self, v: [i16; 3]) -> ScreenVertex {
        let [x, y, w] = self.clip(v);
        if !within(x, w) || !within(y, w) {
            return ScreenVertex::EMPTY;
        }
        let mantissa = TwoSteps::mantissa(w);
        let right = (28 - self.beyond - 8) & 31;
        let along = |v| ((mul_high(v, mantissa) >> right) + 1) >> 1;
        ScreenVertex { x: along(x), y: along(y) }
    }

    fn before_snap(&self, v: [i16; 3]) -> [f64; 2] {
        let [x, y, w] = self.clip(v);
        [x, y].map(|v| mul_wide(v, TwoSteps::mantissa(w)) as f64 * exp2(self.beyond - 61))
    }
}

/// One 32-bit product for each coefficient, like [`OneProduct`](crate::short::OneProduct).
pub(crate) struct ScaledShort {
    rows: [[i32; 3]; 3],
    offsets: [i32; 3],
    beyond: i32,
}

impl ScaledShort {
    /// Quotients in 2⁻³⁰.
    #[inline(always)]
    fn quotients(&self, v: [i16; 3]) -> Option<[i32; 2]> {
        let v = v.map(i32::from);
        let at = |i: usize| {
            let ([a, b, c], [x, y, z]) = (self.rows[i], v);
            self.offsets[i].wrapping_add(a * x).wrapping_add(b * y).wrapping_add(c * z)
        };
        let (x, y, w) = (at(0), at(1), at(2));
        let limit = w - (w >> 12);
        if !within(x, limit) || !within(y, limit) {
            return None;
        }
        let r = sixteen_bits::<OneStep>(w);
        Some([x, y].map(|v| ((v + (1 << 15)) >> 16) * r))
    }
}

impl Design for ScaledShort {
    type Vertex = [i16; 3];

    fn new(object: &Object) -> Option<Self> {
        let (factor, beyond) = factor(object)?;
        let (rows, offsets) = (object.linear(), object.offset());
        let to_xy = factor * object.focal * exp2(-beyond);
        let factors = [to_xy, to_xy, factor];
        let fits = |i: usize| (sum_of(rows[i]) * Object::REACH + offsets[i].abs()) * to_xy < exp2(31) - 2.0;
        (fits(0) && fits(1)).then(|| Self {
            rows: [0, 1, 2].map(|i| rows[i].map(|c| nearest32(c * factors[i]))),
            offsets: [0, 1, 2].map(|i| nearest32(offsets[i] * factors[i])),
            beyond,
        })
    }

    #[inline(always)]
    fn corner(&self, v: [i16; 3]) -> ScreenVertex {
        let Some(quotients) = self.quotients(v) else { return ScreenVertex::EMPTY };
        let right = (22 - self.beyond - 1) & 31;
        let [x, y] = quotients.map(|q| ((q >> right) + 1) >> 1);
        ScreenVertex { x, y }
    }

    fn before_snap(&self, v: [i16; 3]) -> [f64; 2] {
        self.quotients(v).unwrap_or_default().map(|q| f64::from(q) * exp2(self.beyond - 30))
    }
}
