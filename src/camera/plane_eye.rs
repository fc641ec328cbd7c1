//! The viewer's position in an object's coordinates, for culling by face planes.

use super::VertexTransform;
use crate::math::num::{bits_of, mul_wide, scale, shift_to_fit};
use crate::math::unit::cross_exact;

/// The eye point in an object's coordinates, homogeneous (x : y : z : w), where the largest justified coordinate counts as 1.
/// Under a parallel projection w is 0, and xyz is the direction of projection.
///
/// For a face in the plane n·v = p, the sign of `n·xyz − p·w` decides whether it is front-facing (negative) or back-facing
/// (positive). Without a reflection the eye of a front-facing face is on the side to which n points; a reflection reverses
/// both, the faces' orientation and this sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PlaneEye {
    xyz: [i32; 3],
    w: i32,
}

impl PlaneEye {
    /// An eye for which [`behind`](Self::behind) is negative for every plane, so that nothing is culled.
    pub(crate) const NOWHERE: Self = Self { xyz: [0; 3], w: 0 };

    /// The four numbers are at most 2^BITS in magnitude.
    const BITS: i32 = 13;

    /// The error bound of each of the four numbers, in 1/1000: half a unit from rounding, and the bits that [`new`](Self::new)
    /// drops.
    const ERROR: i32 = 515;

    /// The error bound of [`behind`](Self::behind), for normals of unit length with components within 2⁻¹⁵. Let v be a vertex
    /// with justified coordinates, |vᵢ| ≤ 1:
    ///
    /// * a normal's components sum to at most √3·2¹⁵ + 3, and so does n·v: multiplied by the errors of xyz and of w;
    /// * the normal's error is multiplied by xyz − v·w, at most 2^(BITS + 1) in each of three components;
    /// * the plane's error, a half, is multiplied by 2w.
    ///
    /// One unit is added for two small terms: the fraction that the division by 1000 drops, and six times the amount by which an
    /// exact number of the eye may exceed 2^BITS.
    const MARGIN: i32 = 2 * 56_759 * Self::ERROR / 1000 + 6 * (1 << Self::BITS) + (1 << Self::BITS) + 1;

    /// At the eye the three forms x, y and w of a vertex are 0: by Cramer's rule with the forms'
    /// coefficients l and offsets o, `xyz = o_x (l_y × l_w) + o_y (l_w × l_x) + o_w (l_x × l_y)` and
    /// `w = −l_x · (l_y × l_w)`. The determinant of three corners' x, y and w, whose sign is that of the face on the
    /// screen, is the plane through them at this point (the Cauchy–Binet formula; Blinn, *A Homogeneous Formulation for
    /// Lines in 3 Space*, 1977).
    #[inline(never)] // set-up: code size counts
    pub(crate) fn new(transform: &VertexTransform) -> Self {
        let forms @ [(x, _), (y, _), (w, _)] = transform.forms();
        // Exact, below 2⁶¹; then 29 bits, half a unit off.
        let crosses = [cross_exact(&y, &w), cross_exact(&w, &x), cross_exact(&x, &y)];
        let down = shift_to_fit(bits_of(crosses.as_flattened()), 29);
        let crosses = crosses.map(|cross| cross.map(|c| scale(c, -down) as i32));
        // Offsets have 31 bits, with an error of half a unit too: three products below 2⁶⁰, each off by 2²⁸ + 2³⁰ at most.
        let mut eye = [0; 4];
        for (cross, (_, offset)) in crosses.iter().zip(forms) {
            for (sum, &c) in eye.iter_mut().zip(cross) {
                *sum += mul_wide(c, offset);
            }
        }
        eye[3] = -x.iter().zip(crosses[0]).fold(0, |sum, (&a, b)| sum + mul_wide(a, b));
        let down = shift_to_fit(bits_of(&eye), Self::BITS);
        // 3·(2²⁸ + 2³⁰) is 0.0147·2³⁸. With fewer bits the object is nearly flat.
        if down < 38 {
            return Self::NOWHERE;
        }
        let [x, y, z, w] = eye.map(|v| scale(v, -down) as i32);
        Self { xyz: [x, y, z], w }
    }

    /// An eye that every plane has on its other side, so that [`behind`](Self::behind) finds front faces.
    pub(crate) fn opposite(self) -> Self {
        Self { xyz: self.xyz.map(|c| -c), w: -self.w }
    }

    /// Positive or zero only if a face with the plane n·v/2 = `plane` is certainly back-facing: its distance less the error
    /// bound, in 2⁻¹⁵ times a factor common to all faces of an object.
    #[inline(always)]
    pub(crate) fn behind(self, [a, b, c]: [i16; 3], plane: i16) -> i32 {
        let ([x, y, z], twice) = (self.xyz, 2 * self.w);
        // Three products of 2¹⁵ and 2¹³, one of 2¹⁵ and 2¹⁴, whatever the normal's length: below 2³¹.
        i32::from(a) * x + i32::from(b) * y + i32::from(c) * z - i32::from(plane) * twice - Self::MARGIN
    }

    /// Whether [`behind`](Self::behind) is certainly positive or zero for all faces of a cluster: see
    /// [`Mesh::with_planes`](crate::Mesh::with_planes) for its numbers.
    ///
    /// With the eye u = xyz − w·c from the cluster's point c, the sum for a face is `n·u + w·(n·c − 2·plane)`. Its normal n lies within
    /// M of the cluster's vector a, its plane within E of c: the sum is at least `a·u − M·|u| − |w|·E`. (Shirman and Abi-Ezzi, *The Cone of
    /// Normals Technique for Fast Processing of Curved Patches*, 1993, with a ball in place of the cone.)
    #[inline(always)]
    pub(crate) fn is_behind_all(self, &[cx, cy, cz, radius, ax, ay, az, errors]: &[i16; 8]) -> bool {
        // Each component is off by a half, which a normal of up to 2¹⁵ in each component multiplies.
        const MARGIN: i32 = PlaneEye::MARGIN + 3 * (1 << 14);
        let errors = i32::from(errors as u16);
        let along = |eye: i32, c: i16| eye - ((self.w * i32::from(c) + (1 << 14)) >> 15); // at most 2¹⁴
        let [x, y, z] = self.xyz;
        let (x, y, z) = (along(x, cx), along(y, cy), along(z, cz));
        // at most 2¹⁶
        let from_planes = ((i32::from(radius as u16) * ((errors & 255) + 1)) >> 8) + 1;
        // At most 3·2²⁹, and 2²⁹ + 2¹⁸: in 2¹⁵ they are subtracted without overflow.
        let in_front = (i32::from(ax) * x + i32::from(ay) * y + i32::from(az) * z) >> 15;
        let off = (self.w.abs() * from_planes + MARGIN + (1 << 15) - 1) >> 15;
        let Ok(rest) = u32::try_from(in_front - off) else { return false };
        // M is (m + 1)·2⁷, so (M·|u|)² is (m + 1)²·u²·2¹⁴, in 2³⁰ as the square of the rest, which is below 3·2¹⁴.
        let (most, square) = ((errors >> 8) as u32 + 1, (x * x + y * y + z * z) as u32); // 2⁸, 3·2²⁸
        rest * rest >= most * most * ((square >> 16) + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Projection, ViewTransform, Viewport, Window};
    use crate::math::random::Random;
    use crate::math::{Affine, Angle, Point3, Scalar, Vector3};
    use crate::space::{Model, World};
    use embedded_graphics_core::geometry::{Point, Size};

    /// xyz and w by Cramer's rule in 128-bit integers, from the forms' rounded offsets.
    fn exact(transform: &VertexTransform) -> [i128; 4] {
        let [(x, ox), (y, oy), (w, ow)] =
            transform.forms().map(|(linear, offset)| (linear.map(i128::from), i128::from(offset)));
        let cross = |a: [i128; 3], b: [i128; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let (yw, wx, xy) = (cross(y, w), cross(w, x), cross(x, y));
        let along = |i: usize| ox * yw[i] + oy * wx[i] + ow * xy[i];
        [along(0), along(1), along(2), -(x[0] * yw[0] + x[1] * yw[1] + x[2] * yw[2])]
    }

    #[test]
    fn each_number_of_the_eye_is_within_its_error() {
        let (mut random, mut largest, mut counted) = (Random(5), 0.0_f64, 0);
        let viewport = Viewport::new(Point::new(-7, 3), Size::new(240, 180)).unwrap();
        let number = |v| Scalar::try_from(v).expect("in range");
        let lens =
            Projection::perspective(Angle::degrees(50), viewport.size(), number(0.1), number(90.0)).unwrap();
        let side = number(3.0);
        let window = Window { left: -side, right: side, bottom: -side, top: side };
        let parallel = Projection::orthographic(window, number(0.1), number(90.0)).unwrap();
        for i in 0..20_000 {
            // Near and distant, sheared, mirrored, thin, small objects.
            let mut vector = |size: f64| {
                Vector3::new(
                    number(random.unit() * size),
                    number(random.unit() * size),
                    number(random.unit() * size),
                )
            };
            let size = [1.0, 0.1, 0.004][i % 3];
            let (x, y, z) = (vector(size), vector(size), vector([1.0, 0.01][i / 3 % 2] * size));
            let mut point = |size: f64| {
                Point3::new(
                    number(random.unit() * size),
                    number(random.unit() * size),
                    number(random.unit() * size),
                )
            };
            let (origin, eye) = (point(1.0), point([1.5, 10.0, 60.0][i / 6 % 3]));
            let model = Affine::<Model, World>::from_frame(x, y, z, origin);
            let viewing =
                ViewTransform::look_at(eye, Point3::from_ints(0, 0, 0), Vector3::from_ints(1, 2, 3)).unwrap();
            let camera = Camera::new(&viewing, if i % 5 == 0 { &parallel } else { &lens }, &viewport);
            let transform = VertexTransform::new(&camera, &model, -14, 16, true);
            let found = PlaneEye::new(&transform);
            let ([x, y, z], w) = (found.xyz, found.w);
            let found = [x, y, z, w].map(f64::from);
            if found == [0.0; 4] {
                continue;
            }
            counted += 1;
            let exact = exact(&transform).map(|v| v as f64);
            let most = |numbers: [f64; 4]| numbers.into_iter().fold(0.0, |most: f64, v| most.max(v.abs()));
            let factor = (most(found) / most(exact)).log2().round().exp2();
            for (found, exact) in found.into_iter().zip(exact) {
                largest = largest.max((found - exact * factor).abs());
            }
            assert!(most(found) <= 8192.0 && most(found) >= 4095.0, "{found:?}");
        }
        assert!(largest <= f64::from(PlaneEye::ERROR) / 1000.0 && largest > 0.4, "{largest}"); // the largest measured is 0.500002
        assert!(counted > 19_900, "{counted}");
    }
}
