//! How large a length of the world is on the screen, parallel to the view plane.

use super::Camera;
use crate::math::num::{evaluate, mul_wide, reciprocal, scale, shift_to_fit};
use crate::math::row::RowBlock;
use crate::math::{matrix_product, Affine, Coordinate, Row, Scalar};
use crate::space::{Model, World};

/// The factors from lengths at a vertex, in world units along the view's axes u and v, to lengths on the screen: `a/w` and `b/w`,
/// where a and b are the coefficients of u and v in the forms x and y of clip space.
///
/// **Error.** 2⁻²⁷ of the length for the products and the reciprocal, ½ sub-pixel for the rounding, and the error of w: 2⁻³² units
/// for its rounding, and 2⁻³⁰ of the largest coefficient times the distance for that of its row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SizeOnScreen {
    /// w as a form of the vertex, whose coordinates are integers in 2^unit.
    w: Row,
    unit: i32,
    /// a and b in 2^(exponent − 30) sub-pixels, each at most 2³⁰, and their exponents.
    factors: [(i32, i32); 2],
}

impl SizeOnScreen {
    /// For vertices in 2^`unit` of an object that `model` places before the camera.
    #[inline(never)] // set-up: code size counts, speed does not
    pub(crate) fn new(camera: &Camera, model: &Affine<Model, World>, unit: i32) -> Self {
        let (m, m_exponent) = model.linear();
        let away = model.offset_from(&camera.eye);
        let [u, v, n] = &camera.axes;
        let offset = [u, v, n].map(|axis| evaluate(axis, 0, &away, 0));
        let mut view = RowBlock { linear: *m, exponent: m_exponent, offset };
        view.exponent = matrix_product(&camera.axes, 0, m, m_exponent, &mut view.linear);
        let [x, y, _, own] = &camera.rows;
        let mut w = *own; // a copy that is overwritten
        own.compose(&view, 0, &mut w);
        let [[a, _, _], [_, b, _]] = [x.linear, y.linear];
        let up = camera.screen.unit;
        Self { w, unit, factors: [(a.abs(), x.exponent + up), (b.abs(), y.exponent + up)] }
    }

    /// Width and height on the screen in sub-pixels of a rectangle at a vertex, given in world units, at most `largest` each, and 0
    /// for lengths that are not positive. `None` if w is not positive: the vertex lies in the plane of the eye.
    #[inline(never)] // code size: the last of its arguments is a constant
    pub(crate) fn at<V: Coordinate>(
        &self,
        vertex: [V; 3],
        size: [Scalar; 2],
        largest: i32,
    ) -> Option<[i32; 2]> {
        // A product by 1 is the number that the mesh stores. The form takes integers as if they were in 2⁻³².
        let vertex = vertex.map(|c| i64::from(c.times(1)));
        let w = evaluate(&self.w.linear, self.w.exponent + self.unit + 32, &vertex, self.w.offset); // in 2⁻³²
        if w <= 0 {
            return None;
        }
        let w_down = shift_to_fit(w as u64, 30);
        let r = reciprocal(scale(w, -w_down) as i32); // 1 … 2³⁰
                                                      // 1/w = 2³² / (2^w_down · 30 bits) = mantissa · 2^(shift − 61 + 32 − w_down).
        let inverse = r.shift as i32 - 29 - w_down;
        let [width, height] = size.map(|length| length.to_bits().max(0));
        let along = |(factor, exponent): (i32, i32), length: i32| {
            let product = mul_wide(factor, length); // ≤ 2⁶¹, in 2^(exponent − 30 − 16) sub-pixels
            let down = shift_to_fit(product as u64, 30);
            let product = scale(product, -down) as i32; // ≤ 2³⁰
            let sub_pixels = scale(mul_wide(product, r.mantissa), down + exponent - 46 + inverse);
            sub_pixels.min(largest.into()) as i32 // not negative
        };
        let [across, down] = self.factors;
        Some([along(across, width), along(down, height)])
    }
}
