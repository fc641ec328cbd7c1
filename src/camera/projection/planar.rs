//! Planar geometric projections: points to points of a plane, without depth.

use super::parts::{extent, ratio, row, ONE};
use super::{Projection, Window};
use crate::camera::CameraError;
use crate::math::num::{scale, shift_to_fit, sqrt, SATURATED};
use crate::math::{homogeneous, to_scalar, Point3, Row, Scalar, Vector3};
use crate::space::View;

/// Projects points of view space onto a plane z = const along rays from a centre or along a
/// direction, as the textbook's 4 × 4 matrices do.
///
/// The image is a point of the plane, so z/w is constant or zero and carries no depth. For a
/// picture, [`Projection::from_planar`] adds a window and a depth.
///
/// ```
/// use pinhole::{camera::{CameraError, PlanarProjection}, space::View, Point3, Scalar};
/// let onto_5 = PlanarProjection::eye_at_origin(Scalar::from_int(5))?;
/// assert_eq!(onto_5.apply(Point3::<View>::from_ints(2, 4, 10)), Some(Point3::from_ints(1, 2, 5)));
/// # Ok::<(), CameraError>(())
/// ```
///
/// (Carlbom and Paciorek, *Planar geometric projections and viewing transformations*, 1978;
/// Foley et al., *Computer Graphics*, 2nd ed., section 6.4.)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanarProjection {
    /// x, y, z, w as linear forms of view coordinates.
    rows: [Row; 4],
}

const X: Row = axis(0);
const Y: Row = axis(1);
const Z: Row = axis(2);
/// w = 1.
const UNIT: Row = Row { offset: 1 << 32, ..Row::ZERO };

const fn axis(i: usize) -> Row {
    let mut linear = [0; 3];
    linear[i] = 1 << 30;
    Row { linear, exponent: 0, offset: 0 }
}

impl PlanarProjection {
    /// The projection from a centre at the origin onto the plane z = d, in world units:
    ///
    /// ```text
    ///     | 1 0 0   0 |
    ///     | 0 1 0   0 |
    ///     | 0 0 1   0 |
    ///     | 0 0 1/d 0 |
    /// ```
    ///
    /// The gaze is along +z for d > 0; for [`Projection::from_planar`], whose camera looks along −z, use d < 0.
    ///
    /// # Errors
    ///
    /// [`CameraError::NoViewPlane`] for d = 0.
    pub fn eye_at_origin(d: Scalar) -> Result<Self, CameraError> {
        Ok(Self { rows: [X, Y, Z, by(d, 0)?] })
    }

    /// The projection from a centre at (0, 0, −d), in world units, onto the plane z = 0, which contains the origin:
    ///
    /// ```text
    ///     | 1 0 0   0 |
    ///     | 0 1 0   0 |
    ///     | 0 0 0   0 |
    ///     | 0 0 1/d 1 |
    /// ```
    ///
    /// It tends to [`parallel`](Self::parallel) as d grows.
    ///
    /// # Errors
    ///
    /// [`CameraError::NoViewPlane`] for d = 0.
    pub fn origin_in_plane(d: Scalar) -> Result<Self, CameraError> {
        Ok(Self { rows: [X, Y, Row::ZERO, by(d, 1 << 32)?] })
    }

    /// The parallel projection along z onto the plane z = 0, the limit for a centre at infinity:
    ///
    /// ```text
    ///     | 1 0 0 0 |
    ///     | 0 1 0 0 |
    ///     | 0 0 0 0 |
    ///     | 0 0 0 1 |
    /// ```
    pub const fn parallel() -> Self {
        Self { rows: [X, Y, Row::ZERO, UNIT] }
    }

    /// The projection onto the plane z = z_p from a centre at `distance` from (0, 0, z_p) in
    /// `direction` (any length; (dx, dy, dz) is its unit vector, Q the distance):
    ///
    /// ```text
    ///     | 1  0  −dx/dz         z_p·dx/dz           |
    ///     | 0  1  −dy/dz         z_p·dy/dz           |
    ///     | 0  0  −z_p/(Q·dz)    z_p²/(Q·dz) + z_p   |
    ///     | 0  0  −1/(Q·dz)      1 + z_p/(Q·dz)      |
    /// ```
    ///
    /// All other constructors are special cases. A negative `distance` puts the centre on the other side of the plane. `None`
    /// is an infinite distance: a parallel projection along `direction`, orthographic or oblique. (Foley et al., section 6.4,
    /// equation 6.17.)
    ///
    /// # Errors
    ///
    /// [`CameraError::NoViewPlane`] if the direction is parallel to the plane or the distance is zero,
    /// [`OutOfRange`](CameraError::OutOfRange) if a constant of the matrix is beyond ±2³⁰.
    pub fn general(
        z_p: Scalar,
        distance: Option<Scalar>,
        direction: Vector3<View>,
    ) -> Result<Self, CameraError> {
        let [dx, dy, dz] = direction.bits().map(i64::from);
        if dz == 0 || distance == Some(Scalar::ZERO) {
            return Err(CameraError::NoViewPlane);
        }
        // In 2⁻³².
        let z_p = i64::from(z_p.to_bits()) << 16;
        // plus + slope·(z − z_p).
        let slanted =
            |plus: Row, slope: (i64, i32)| plus.linear_combination(ONE, &Row { offset: -z_p, ..Z }, slope);
        let over_dz =
            |n: i64| if dz < 0 { ratio(n, dz.unsigned_abs()) } else { ratio(-n, dz.unsigned_abs()) };
        let x = slanted(X, over_dz(dx));
        let y = slanted(Y, over_dz(dy));
        let (z, w) = match distance {
            None => (Row { offset: z_p, ..Row::ZERO }, UNIT),
            Some(distance) => {
                // 1/(Q·dz) = |direction|/(Q·its z), which keeps its bits where the direction lies near
                // the plane: all parts brought to 31 bits at least.
                let largest = dx.unsigned_abs().max(dy.unsigned_abs()).max(dz.unsigned_abs());
                let up = (-shift_to_fit(largest, 31)).max(0); // 2³¹ itself stays, and with it the others' last bit
                let square = [dx, dy, dz].map(|c| scale(c, up).unsigned_abs().pow(2)).iter().sum(); // ≤ 3·2⁶²
                let length = i64::from(sqrt(square)); // 2³⁰ … 2³¹·⁸
                let product = i64::from(distance.to_bits()) * scale(dz, up); // 2³¹ · 2³¹
                if product == 0 {
                    return Err(CameraError::NoViewPlane);
                }
                let (m, e) = ratio(length << 16, product.unsigned_abs());
                let slope = (if product < 0 { m } else { -m }, e);
                let w = slanted(UNIT, slope);
                // The third row is z_p times the fourth.
                (w.times(ratio(z_p >> 16, 1 << 16)), w)
            }
        };
        let rows = [x, y, z, w];
        if rows.iter().any(|row| row.offset.abs() >= SATURATED) {
            return Err(CameraError::OutOfRange);
        }
        Ok(Self { rows })
    }

    /// The image of a point, rounded to 2⁻¹⁶ (within ½ + 2⁻¹⁷ of such a step) and saturated. Rounded coefficients add at most
    /// 2⁻²⁸/(w·dz) of the largest coordinate of point, plane and image; dz is 1 except in [`general`](Self::general). `None` if
    /// the ray is parallel to the plane (w rounds to 0). A point behind the centre of projection has an image, too, upside
    /// down, as the textbook's matrix has it.
    pub fn apply(&self, p: Point3<View>) -> Option<Point3<View>> {
        let p = p.bits().map(|c| i64::from(c) << 16);
        let ([x, y, z, w], _) = homogeneous(&self.rows, &p);
        if w == 0 {
            return None;
        }
        Some(Point3::from_bits([x, y, z].map(|c| {
            let c = if w < 0 { -c } else { c };
            let (m, e) = ratio(c, w.unsigned_abs());
            to_scalar(scale(m, e + 32))
        })))
    }

    /// The homogeneous image (x, y, z, w) before the division, each rounded to nearest in 2⁻¹⁶ and saturated.
    pub fn homogeneous(&self, p: Point3<View>) -> [Scalar; 4] {
        let p = p.bits().map(|c| i64::from(c) << 16);
        self.rows.map(|row| Scalar::from_bits(to_scalar(row.apply(&p))))
    }
}

/// The row z/d + offset.
fn by(d: Scalar, offset: i64) -> Result<Row, CameraError> {
    let d = i64::from(d.to_bits());
    if d == 0 {
        return Err(CameraError::NoViewPlane);
    }
    Ok(row(2, ratio(d.signum() << 16, d.unsigned_abs()), offset))
}

impl Projection {
    /// A planar projection seen through a `window` of its plane, with depth between the planes z = −near and z = −far
    /// (distances along −z in world units, near < far).
    ///
    /// The camera looks along −z. If the centre of projection lies at smaller z than the volume (as with d > 0),
    /// the far plane is the one closer to it and the picture is mirrored, as the matrix says.
    ///
    /// x and y are the planar image's, mapped from the window to −1 … 1; depth is linear on the
    /// screen, `d = (w at far)/(far − near) · (−z − near)`.
    ///
    /// ```
    /// use pinhole::{camera::{CameraError, PlanarProjection, Window}, prelude::*};
    /// let [one, two] = [1, 2].map(Scalar::from_int);
    /// let window = Window { left: -two, right: two, bottom: -two, top: two };
    /// // Parallel, along (0, -1, 1): shapes parallel to the plane z = 0 are preserved.
    /// let planar = PlanarProjection::general(Scalar::ZERO, None, Vector3::from_ints(0, -1, 1))?;
    /// let lens = Projection::from_planar(&planar, window, -one, two)?;
    /// # let _ = lens;
    /// # Ok::<(), CameraError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError::EmptyWindow`], [`WindowTooSmall`](CameraError::WindowTooSmall),
    /// [`NearNotBeforeFar`](CameraError::NearNotBeforeFar),
    /// [`NearNotPositive`](CameraError::NearNotPositive) where near or far lies behind the
    /// centre of projection, [`NearTooCloseToFar`](CameraError::NearTooCloseToFar), and
    /// [`OutOfRange`](CameraError::OutOfRange) where w at the far plane passes 2³⁰.
    pub fn from_planar(
        planar: &PlanarProjection,
        window: Window,
        near: Scalar,
        far: Scalar,
    ) -> Result<Self, CameraError> {
        let [x, y, _, w] = &planar.rows;
        let form = |image: &Row, low: Scalar, high: Scalar| {
            let extent = extent(low, high).ok_or(CameraError::EmptyWindow)?;
            let sum = i64::from(low.to_bits()) + i64::from(high.to_bits());
            let (a, b) = (ratio(2 << 16, extent), ratio(-sum, extent));
            let row = image.linear_combination(a, w, b);
            // Each term is tested, not only the sum: a saturated term may cancel with the other one.
            if [row, image.times(a), w.times(b)].iter().any(|row| row.offset.abs() >= SATURATED) {
                return Err(CameraError::WindowTooSmall);
            }
            Ok(row)
        };
        let x = form(x, window.left, window.right)?;
        let y = form(y, window.bottom, window.top)?;
        let depth = extent(near, far).ok_or(CameraError::NearNotBeforeFar)?;
        let w_at = |distance: Scalar| w.apply(&[0, 0, -(i64::from(distance.to_bits()) << 16)]);
        if w_at(near) <= 0 || w_at(far) <= 0 {
            return Err(CameraError::NearNotPositive);
        }
        if w_at(far) >= SATURATED {
            return Err(CameraError::OutOfRange);
        }
        // κ = w(far)/(far − near): 2⁻³² over 2⁻¹⁶.
        let (m, e) = ratio(w_at(far), depth);
        let near = Row { offset: -(i64::from(near.to_bits()) << 16), ..row(2, (-1, 0), 0) };
        let d = near.times((m, e - 16));
        if d.offset.abs() >= SATURATED {
            return Err(CameraError::NearTooCloseToFar);
        }
        Ok(Self { rows: [x, y, d, *w] })
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for PlanarProjection {
    fn format(&self, f: defmt::Formatter<'_>) {
        for row in &self.rows {
            let (linear, exponent, offset) = (row.linear, row.exponent, row.offset);
            defmt::write!(f, "[{} * 2^({=i32} - 30), {=i64}/2^32]", linear, exponent, offset);
        }
    }
}
