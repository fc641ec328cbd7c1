//! Single points: projection to the screen, for labels, and back, for picking.

use super::projected::Projected;
use super::projection::ratio;
use super::{Camera, VertexTransform};
use crate::camera::CameraError;
use crate::math::num::{add, dot, scale, shift_to_fit};
use crate::math::unit::cross_exact;
use crate::math::{Affine, Point3, Row, Scalar, Vector3};
use crate::raster::{ScreenPoint, GUARD_BAND};
use crate::space::{Model, World};

impl Camera {
    /// Projects a world point: its screen position, within 1/256 px, and its depth, 0 near to 65534 far, within 1 if far is at
    /// least twice near. Points outside of the viewport are projected too; beyond a far plane that does not clip they have depth 65534.
    /// [`MeshInstance::project`](crate::draw::MeshInstance::project) has the same error bounds.
    ///
    /// ```
    /// use embedded_graphics::geometry::{Point, Size};
    /// use pinhole::{camera::Projected, meshes::CUBE, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(240, 240))?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(60), Angle::ZERO, Angle::degrees(37))?;
    /// // Where a label goes, ...
    /// let Projected { point: at, depth } = camera.project(Point3::from_ints(1, 0, 1))?;
    /// // ... and what was touched there. Depths 0 and 65534 give the line through a touched position, from near to far.
    /// let back = camera.unproject(at, depth).ok_or("outside the world")?;
    /// let close = |a: Scalar, b: i16| (a - b.into()).abs() < Scalar::from_ratio(1, 100);
    /// assert!(close(back.x(), 1) && close(back.y(), 0) && close(back.z(), 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError`] if the point lies before the near plane, beyond a far plane that clips, or outside of the guard band.
    pub fn project(&self, p: Point3<World>) -> Result<Projected, CameraError> {
        let [x, y, z] = [p.x(), p.y(), p.z()];
        // A model transform of scale 0 maps all vertices to this point.
        let model =
            Affine::<Model, World>::scale(Scalar::ZERO).then(&Affine::translation(Vector3::new(x, y, z)));
        let transform = VertexTransform::new(self, &model, 0, 16, true);
        let h = transform.clip([0i16; 3]);
        if let Some(error) = transform.why_not_projected(&h) {
            return Err(error);
        }
        let vertex = transform.project_wide(&h, Some(VertexTransform::depth));
        Ok(Projected { point: vertex.point, depth: vertex.step() })
    }

    /// The world point that [`project`](Self::project)s to this screen position and depth. `None` if it is outside of ±32768
    /// world units, or if the camera matrix is nearly singular (a determinant of 0 in 45 bits).
    ///
    /// Error: the size of half a sub-pixel and half a step of depth at that point, and 2⁻¹⁷ world units; for a pair that
    /// `project` returned, the error of `project` is added. This holds for fields of view up to 150° and rows of
    /// [`ViewTransform::from_matrix`](crate::ViewTransform::from_matrix) that are orthonormal to 2⁻²⁹; a larger error of the
    /// rows moves the point by that fraction of its distance.
    pub fn unproject(&self, at: ScreenPoint, depth: u16) -> Option<Point3<World>> {
        let [across, down] = self.planes_through(at);
        let [_, _, d, w] = &self.rows;
        // Depth is 2¹⁶·d/w, so this plane contains the points of that depth.
        let behind = d.linear_combination((1 << 30, -30), w, (-i64::from(depth), -16));
        self.world_point(meet([&across, &down, &behind])?)
    }

    /// The finite vanishing points of the world's x, y and z axes, where the images of all lines parallel to the axis meet: `[x, y]` on
    /// the screen in 1/256 pixel, saturated at ±2³⁰, because they may lie far off the screen. `None` for an axis whose parallels stay
    /// parallel (its direction lies within 2⁻²⁵ of the view plane), as all do under a parallel projection.
    ///
    /// Error: 1/512 px, and as far as the point moves when its axis turns by 2⁻²⁸ rad; for fields of view from 26°
    /// to 120°. (Carlbom and Paciorek, *Planar geometric projections and viewing transformations*, 1978.)
    ///
    /// ```
    /// use embedded_graphics::geometry::{Point, Size};
    /// use pinhole::{prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(240, 240))?;
    /// let lens = Projection::perspective(Angle::degrees(90), viewport.size(), Scalar::from_int(1), Scalar::from_int(9))?;
    /// // From (5, 0, 5): parallels to x and to z meet at 45° to the gaze, on the borders; those to y stay parallel.
    /// let eye = Point3::from_ints(5, 0, 5);
    /// let view = ViewTransform::look_at(eye, Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?;
    /// let [x, y, z] = Camera::new(&view, &lens, &viewport).vanishing_points();
    /// let ([x, _], [z, _]) = (x.ok_or("parallel")?, z.ok_or("parallel")?);
    /// assert!(x.abs() <= 1 && (z - 240 * 256).abs() <= 1 && y.is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn vanishing_points(&self) -> [Option<[i32; 2]>; 3] {
        let point = |direction: [i32; 3]| {
            // The rows without their constants: three products of at most 2⁶⁰.
            let at = |row: &Row| (dot(&row.linear, &direction), row.exponent);
            let [x_row, y_row, _, w_row] = &self.rows;
            let (w, w_exponent) = at(w_row);
            // A row's largest coefficient has 30 bits, so w is about 2⁵⁹ · cos.
            if w.unsigned_abs() < 1 << 34 {
                return None;
            }
            let quotient = |row: &Row| -> i64 {
                let (v, exponent) = at(row);
                let (v, exponent) = if w < 0 { (-v, exponent) } else { (v, exponent) };
                // v/w in sub-pixels: 61 bits over 61 bits, 2^unit of them.
                let (m, e) = ratio(v, w.unsigned_abs());
                scale(m, e + exponent - w_exponent + self.screen.unit + 16)
            };
            // In 2⁻¹⁶ sub-pixels from the centre.
            let (x, y) = (quotient(x_row), quotient(y_row));
            let [cx, cy] = self.screen.centre();
            let near =
                |v: i64, centre: i32| add(scale(v, -16), centre.into()).clamp(-(1 << 30), 1 << 30) as i32;
            Some([near(x, cx), near(y, cy)])
        };
        let [u, v, n] = self.axes;
        [point([u[0], v[0], n[0]]), point([u[1], v[1], n[1]]), point([u[2], v[2], n[2]])]
    }

    /// The two planes of view space that project to the screen column and the screen row of `at`.
    fn planes_through(&self, at: ScreenPoint) -> [Row; 2] {
        let [x, y, _, w] = &self.rows;
        let [cx, cy] = self.screen.centre();
        let plane = |row: &Row, position: i32, centre: i32| {
            debug_assert!(position.abs() <= GUARD_BAND * 256);
            // x/w = (position − centre)/2^unit: 23 bits.
            row.linear_combination((1 << 30, -30), w, (-i64::from(position - centre), -self.screen.unit))
        };
        [plane(x, at.x(), cx), plane(y, at.y(), cy)]
    }

    /// A view-space point in 2⁻²⁴ to world space; `None` if it leaves ±32768 world units.
    fn world_point(&self, p: [i64; 3]) -> Option<Point3<World>> {
        let [u, v, n] = self.axes;
        let columns = [[u[0], v[0], n[0]], [u[1], v[1], n[1]], [u[2], v[2], n[2]]];
        let mut bits = [0; 3];
        for ((bit, column), eye) in bits.iter_mut().zip(columns).zip(self.eye) {
            // |p| < 2⁴¹ times 2³⁰, three times, and the eye: in i128, rounded from 2⁻⁵⁴ to 2⁻¹⁶.
            let sum: i128 = column.iter().zip(p).map(|(&m, c)| i128::from(m) * i128::from(c)).sum();
            let v = (((sum + (i128::from(eye) << 22)) >> 37) + 1) >> 1;
            *bit = i32::try_from(v).ok()?;
        }
        Some(Point3::from_bits(bits))
    }
}

/// The intersection of three planes, in 2⁻²⁴, by Cramer's rule; `None` if there is none within 2¹⁷ of the origin.
fn meet(planes: [&Row; 3]) -> Option<[i64; 3]> {
    let [a, b, c] = planes;
    // Cross products, scaled to 45 bits by a common factor.
    let normals = [(b, c), (c, a), (a, b)].map(|(a, b)| cross_exact(&a.linear, &b.linear));
    let largest = normals.iter().flatten().map(|v| v.unsigned_abs()).max()?;
    let normals = normals.map(|n| n.map(|v| scale(v, -shift_to_fit(largest, 45).max(0))));
    let determinant: i128 =
        a.linear.iter().zip(normals[0]).map(|(&m, n)| i128::from(m) * i128::from(n)).sum();
    if determinant.unsigned_abs() < 1 << 30 {
        return None;
    }
    // m·p·2^(e − 30) + offset·2⁻³² = 0, so m·p·2²⁴ = −offset · 2^(22 − e). Constants beyond 2⁷² belong to points that are too
    // far away.
    let constant = |row: &Row| -> Option<i128> {
        let (v, left) = (i128::from(row.offset), 22 - row.exponent);
        if left <= 0 {
            return Some(v >> (-left).min(127));
        }
        let bits = 128 - v.unsigned_abs().leading_zeros() as i32;
        (v == 0 || bits + left <= 73).then(|| if v == 0 { 0 } else { v << left })
    };
    let constants = [constant(a)?, constant(b)?, constant(c)?];
    let [l, m, n] = normals;
    let columns = [[l[0], m[0], n[0]], [l[1], m[1], n[1]], [l[2], m[2], n[2]]];
    let mut point = [0; 3];
    for (coordinate, column) in point.iter_mut().zip(columns) {
        // Three products of 73 + 45 bits.
        let sum: i128 = constants.iter().zip(column).map(|(&c, n)| c * i128::from(n)).sum();
        let v = -sum.checked_div(determinant)?;
        if v.unsigned_abs() > 1 << 41 {
            return None;
        }
        *coordinate = v as i64;
    }
    Some(point)
}

#[cfg(test)]
mod tests {
    use super::{meet, Row};

    /// The plane x = 0 and two planes nearly through one line, which meet in (0, 0, 1). Their determinant is `k`/2⁶⁰ of the largest
    /// product of coefficients, which is scaled to 45 bits: the determinant is then 1 for 2¹⁶, and lost below half of that.
    #[test]
    fn planes_meet_until_their_determinant_has_no_bit_left() {
        const ONE: i32 = 1 << 30;
        let plane = |linear: [i32; 3]| Row { linear, exponent: 0, offset: -4 * i64::from(linear[2]) };
        for (k, meets) in [(1 << 29, true), (1 << 17, true), (1 << 16, true), (1 << 14, false), (0, false)] {
            for sign in [1, -1] {
                let planes = [plane([ONE, 0, 0]), plane([0, ONE - 1, k]), plane([0, sign * ONE, sign * k])];
                let [a, b, c] = &planes;
                let found = meet([a, b, c]);
                assert_eq!(found.is_some(), meets, "{k} {sign}");
                let away = found.map_or(0, |[x, y, z]| x.abs().max(y.abs()).max((z - (1 << 24)).abs()));
                // The rounded determinant is off by up to a half, in 2⁻²⁴ of the point.
                assert!(away <= (1 << 24) * (1 << 15) / k.max(1) as i64, "{k}: {found:?}");
            }
        }
    }
}
