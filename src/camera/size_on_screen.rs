//! How large a length of the world is on the screen, parallel to the view plane.

use super::Camera;
use crate::math::num::{
    add, evaluate, mul_wide, reciprocal_of_positive, scale, scale_long_to_word, scale_to_word, shift_to_fit,
};
use crate::math::row::RowBlock;
use crate::math::{matrix_product, Affine, Coordinate, Row, Scalar};
use crate::raster::SpriteAxis;
use crate::space::{Model, World};

/// The factors from lengths at a vertex, in world units along the view's axes u and v, to lengths on the screen: `a/w` and `b/w`,
/// where a and b are the coefficients of u and v in the forms x and y of clip space.
///
/// **Error.** ½ sub-pixel for the rounding, and the relative error of w, whose coefficients have 30 bits and which is rounded to 2⁻³²; the
/// reciprocal and the products add 2⁻²⁸. `Sprite::with_size` has the sum.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SizeOnScreen {
    /// w as a form of the vertex, whose coordinates are integers in 2^unit.
    w: Row,
    unit: i32,
    /// a and b in 2^(exponent − 30) sub-pixels, each at most 2³⁰, and their exponents.
    factors: [(i32, i32); 2],
}

impl SizeOnScreen {
    /// The factors at the vertices of a mesh in units of 2^`unit`, which `model` places before the camera.
    #[inline(never)] // set-up: code size counts
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
        let up = camera.screen.unit;
        // Where the viewport is turned by a quarter, x is a form of v, and y of u.
        let [across, down] = [x, y].map(|row| {
            let [a, b, _] = row.linear;
            (a.abs().max(b.abs()), row.exponent + up)
        });
        Self { w, unit, factors: [across, down] }
    }

    /// Width and height on the screen, in sub-pixels, of a rectangle at a vertex of `size` in world units: at most
    /// [`SpriteAxis::LARGEST`] each, and 0 for lengths that are not positive. `None` if w is not positive: the vertex lies in the plane
    /// of the eye.
    #[inline(always)] // one caller, which is not inlined
    pub(crate) fn at<V: Coordinate>(&self, vertex: [V; 3], size: [Scalar; 2]) -> Option<[i32; 2]> {
        let Row { linear, exponent, offset } = self.w;
        // Products of at most 2⁶¹. A coordinate times 1 is the integer that the mesh stores.
        let sum = linear.iter().zip(vertex).map(|(&m, c)| mul_wide(m, c.times(1))).sum();
        let w = add(scale(sum, exponent + self.unit + 2), offset); // in 2⁻³²
        if w <= 0 {
            return None;
        }
        let w_down = shift_to_fit(w as u64, 30);
        // The argument is 2²⁹ … 2³⁰.
        let r = reciprocal_of_positive(scale_long_to_word(w, w_down));
        // 1/w = 2³² / (2^w_down · argument) = mantissa · 2^(shift − 61 + 32 − w_down).
        let inverse = r.shift as i32 - 29 - w_down;
        let [width, height] = size.map(|length| length.to_bits().max(0));
        let along = |(factor, exponent): (i32, i32), length: i32| {
            on_screen(factor, length, r.mantissa, exponent + inverse)
        };
        let [across, down] = self.factors;
        // Most rectangles are squares.
        let (wide, is_square) = (along(across, width), (across, width) == (down, height));
        Some([wide, if is_square { wide } else { along(down, height) }])
    }
}

/// `factor · length · mantissa / 2^(46 − up)`, rounded, at most [`SpriteAxis::LARGEST`], for a factor of at most 2³⁰ and a length that
/// is not negative.
#[inline(never)] // code size: two calls
fn on_screen(factor: i32, length: i32, mantissa: i32, up: i32) -> i32 {
    let product = mul_wide(factor, length); // ≤ 2⁶¹
    let fitted = shift_to_fit(product as u64, 30);
    let product = scale_to_word(product, fitted); // ≤ 2³⁰; −30 ≤ fitted ≤ 31
    let (product, down) = (mul_wide(product, mantissa), 46 - up - fitted); // below 2⁶¹
    if down > 30 {
        scale_long_to_word(product, down).min(SpriteAxis::LARGEST)
    } else {
        scale(product, -down).min(SpriteAxis::LARGEST.into()) as i32 // not negative
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Projection, ViewTransform, Viewport, Window};
    use crate::math::random::Random;
    use crate::math::{Angle, Point3, Vector3};
    use embedded_graphics_core::geometry::{Point, Size};

    /// A view from `eye` to `target`, and its axis n in f64.
    fn view(eye: [i32; 3], target: [i32; 3]) -> (ViewTransform, [f64; 3]) {
        let point = |bits: [i32; 3]| {
            let [x, y, z] = bits.map(Scalar::from_bits);
            Point3::new(x, y, z)
        };
        let view = ViewTransform::look_at(point(eye), point(target), Vector3::from_ints(2, 9, -1)).unwrap();
        let away = [0, 1, 2].map(|i| f64::from(eye[i]) - f64::from(target[i]));
        let length = away.iter().map(|c| c * c).sum::<f64>().sqrt();
        (view, away.map(|c| c / length))
    }

    /// The largest error of lengths beyond ½ sub-pixel, over the length and the documented bound: of single points in the picture if
    /// `reach` is 0, otherwise of the vertices of an object, `reach` world units each way.
    fn largest_error(reach: f64) -> f64 {
        let (mut random, mut largest, mut compared) = (Random(9), 0.0_f64, 0);
        let size = Size::new(240, 180);
        let viewport = Viewport::new(Point::new(3, -5), size).unwrap();
        // A window of 1/32 × 3/128 world units at 1/64: 90° across.
        let (near, far) = (Scalar::from_bits(1 << 10), Scalar::from_int(3000));
        let [x, y] = [1 << 10, 3 << 8].map(Scalar::from_bits);
        let lens = Projection::frustum(Window { left: -x, right: x, bottom: -y, top: y }, near, far).unwrap();
        let focal = 120.0 * 256.0 / 65536.0; // sub-pixels at distance 1 of 2⁻¹⁶ world units
        for case in 0..400_000 {
            let eye = [0; 3].map(|_| random.within(20_000 << 16));
            let target = eye.map(|c| c + random.within(1 << 20));
            let (view, n) = view(eye, target);
            let camera = Camera::new(&view, &lens, &viewport);
            // An object turned about y, at a place that brings this vertex close to the eye.
            let vertex = [0; 3].map(|_| (reach * 256.0) as i16 * (random.below(2) as i16 * 2 - 1));
            let turn = random.bits();
            let (sin, cos) = (f64::from(turn) * core::f64::consts::TAU / 4_294_967_296.0).sin_cos();
            let [a, b, c] = vertex.map(|c| f64::from(c) * 256.0);
            let turned = [cos * a + sin * c, b, cos * c - sin * a];
            let far = [1200, 1 << 11, 1 << 16, 1 << 26][case % 4];
            let at = [0, 1, 2].map(|i| eye[i] - turned[i] as i32 + random.within(far));
            let [x, y, z] = at.map(Scalar::from_bits);
            let moved = [0, 1, 2].map(|i| f64::from(at[i]) - f64::from(eye[i]) + turned[i]);
            let distance = -(0..3).map(|i| moved[i] * n[i]).sum::<f64>() / 65536.0;
            let aside = moved.iter().map(|c| c * c).sum::<f64>().sqrt() / 65536.0;
            // Only vertices no farther from the axis than the picture's corners: √(1 + 1² + ¾²) is 1.6.
            if distance < 1.0 / 64.0 || aside > 1.6 * distance {
                continue;
            }
            let model = Affine::rotation_y(Angle::from_bits(turn)).translate(Vector3::new(x, y, z));
            let found = SizeOnScreen::new(&camera, &model, -8);
            let length = [0; 2].map(|_| Scalar::from_bits(random.below(i32::MAX.into()) as i32));
            let found = found.at(vertex, length).unwrap();
            for axis in 0..2 {
                let exact = focal * f64::from(length[axis].to_bits()) / distance;
                if exact > f64::from((1 << 30) - 64) {
                    assert!(found[axis] > (1 << 30) - 128);
                    continue;
                }
                let error = ((f64::from(found[axis]) - exact).abs() - 0.5) / exact;
                largest = largest.max(error / (1.2e-8 + (-28.0_f64).exp2() * reach / distance));
                compared += 1;
            }
        }
        assert!(compared > 10_000, "{compared}");
        largest
    }

    /// The bounds in the documentation of `Sprite::with_size`, at most twice the largest errors met.
    #[test]
    fn lengths_are_within_the_documented_error() {
        // The bound covers, for a point, the rounding of w near the eye; for an object, the rounding of its coefficients.
        for reach in [0.0, 100.0] {
            let largest = largest_error(reach);
            assert!((0.5..=1.0).contains(&largest), "{reach}: {largest}");
        }
    }

    #[test]
    fn a_point_in_the_plane_of_the_eye_has_no_size() {
        let view = ViewTransform::from_reference(
            Point3::from_ints(0, 0, 0),
            Vector3::from_ints(0, 0, 1),
            Vector3::from_ints(0, 1, 0),
        );
        let viewport = Viewport::new(Point::zero(), Size::new(64, 64)).unwrap();
        let (near, far) = (Scalar::from_int(1), Scalar::from_int(9));
        let lens = Projection::perspective(Angle::degrees(60), Size::new(64, 64), near, far).unwrap();
        let size = SizeOnScreen::new(&Camera::new(&view.unwrap(), &lens, &viewport), &Affine::identity(), 0);
        let at = |z| size.at([3i16, -4, z], [Scalar::from_int(1); 2]);
        assert_eq!((at(0), at(1)), (None, None));
        assert!(at(-1).is_some());
        assert_eq!(size.at([0i16, 0, -2], [Scalar::ZERO, -Scalar::ONE]), Some([0, 0]));
    }
}
