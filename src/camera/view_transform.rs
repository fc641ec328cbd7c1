//! World to view space: the camera's position and orientation.

use crate::camera::CameraError;
use crate::math::float::{ldexp, to_fixed};
use crate::math::num::{self, add};
use crate::math::unit::{cross, cross_units, is_zero, normalise};
use crate::math::{Affine, Angle, NormalMatrix, Point3, Row, Scalar, Vector3};
use crate::space::{Model, View, World};

/// The rigid transform from world space to view space, `V = R · T(−eye)`:
///
/// ```text
///     | ux uy uz −u·eye |   u  right          u = (VUP × VPN) / |VUP × VPN|
///     | vx vy vz −v·eye |   v  up             v = n × u
///     | nx ny nz −n·eye |   n  to the viewer  n = VPN / |VPN|
///     | 0  0  0  1      |
/// ```
///
/// The eye is stored exactly and subtracted first, in integers: a scene far from the origin is as
/// sharp as one near it. Rows are in 2⁻³⁰, each coefficient within 2⁻²⁸ over the sine of the angle
/// between VUP and VPN: near-parallel ones leave the roll uncertain. (Foley, van Dam, Feiner, Hughes, *Computer
/// Graphics*, 2nd ed., section 6.5.)
///
/// ```
/// use pinhole::{camera::CameraError, prelude::*};
/// let (eye, target) = (Point3::from_ints(0, 0, 5), Point3::from_ints(0, 0, 0));
/// let viewing = ViewTransform::look_at(eye, target, Vector3::from_ints(0, 1, 0))?;
/// assert_eq!(viewing.apply(target), Point3::from_ints(0, 0, -5)); // the camera looks along −z
/// let up_is_along_the_gaze = Vector3::from_ints(0, 0, 1);
/// assert_eq!(ViewTransform::look_at(eye, target, up_is_along_the_gaze), Err(CameraError::Direction));
/// # Ok::<(), CameraError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ViewTransform {
    /// The axes u, v, n of view space in world coordinates, in 2⁻³⁰.
    rows: [[i32; 3]; 3],
    /// The eye in 2⁻³² world units; at most ±2¹⁶ world units.
    eye: [i64; 3],
}

impl ViewTransform {
    /// The view from `eye` to `target`, both in world units, with `up` upwards in the picture. `up` may have any length. The
    /// [type](Self) states the error bound of coefficients.
    ///
    /// # Errors
    ///
    /// [`CameraError::Direction`] if the target is the eye, or if `up` has length zero or is parallel to the gaze to within 2⁻¹² rad.
    pub const fn look_at(
        eye: Point3<World>,
        target: Point3<World>,
        up: Vector3<World>,
    ) -> Result<Self, CameraError> {
        let (e, t) = (eye.bits(), target.bits());
        // 33 bits.
        Self::from_axes(
            eye,
            &[e[0] as i64 - t[0] as i64, e[1] as i64 - t[1] as i64, e[2] as i64 - t[2] as i64],
            up,
        )
    }

    /// The view of a camera that orbits `target` at this distance, with y up: for a turntable, an encoder or a touch screen. At
    /// `yaw` 0 and `pitch` 0 the eye is on the +z side of the target. A positive yaw moves it to the right, towards +x; a
    /// positive pitch moves it up. Every angle is valid: at a pitch of a quarter turn the camera looks straight down, and beyond
    /// that the picture is upside down. Coefficients are within 2⁻²⁸, the eye within 2⁻²⁸ of the distance.
    ///
    /// ```
    /// use pinhole::{prelude::*, Angle};
    /// let target = Point3::from_ints(1, 2, 3);
    /// let from_the_right = ViewTransform::orbit(target, Scalar::from_int(5), Angle::degrees(90), Angle::ZERO);
    /// assert_eq!(from_the_right.apply(Point3::from_ints(6, 2, 3)), Point3::from_ints(0, 0, 0)); // the eye
    /// assert_eq!(from_the_right.apply(target), Point3::from_ints(0, 0, -5));
    /// ```
    pub const fn orbit(target: Point3<World>, distance: Scalar, yaw: Angle, pitch: Angle) -> Self {
        let ((sy, cy), (sp, cp)) = (yaw.sin_cos(), pitch.sin_cos());
        // Units in 2⁻³⁰: their product is at most 2⁶⁰ before the shift.
        const fn times(a: i32, b: i32) -> i32 {
            num::scale(a as i64 * b as i64, -30) as i32
        }
        let n = [times(sy, cp), sp, times(cy, cp)];
        let rows = [[cy, 0, -sy], [-times(sy, sp), cp, -times(cy, sp)], n];
        // Distances in 2⁻¹⁶ times units in 2⁻³⁰, to 2⁻³²: at most 2⁴⁷ beside the target's 2⁴⁷.
        let [x, y, z] = to_q32(target);
        let d = distance.to_bits() as i64;
        let eye = [
            x + num::scale(d * n[0] as i64, -14),
            y + num::scale(d * n[1] as i64, -14),
            z + num::scale(d * n[2] as i64, -14),
        ];
        Self { rows, eye }
    }

    /// The view by view reference point (VRP), view plane normal (VPN, towards the viewer) and view up vector (VUP), all of any length:
    /// the view from `vrp` against the direction `vpn`. Technical drawings are named by the VPN:
    ///
    /// | name | VPN | VUP |
    /// |---|---|---|
    /// | multiview: front, back; right, left | ±z; ±x | y |
    /// | multiview: top; bottom | y; −y | −z; z |
    /// | isometric | (1, 1, 1): [`isometric`](Self::isometric) | y |
    /// | dimetric | two components of equal size, such as (2, 1, 2) | y |
    /// | trimetric | three components of different size, such as (1, 2, 3) | y |
    ///
    /// A VPN and a VUP along axes give exact axes. (Carlbom and Paciorek, *Planar geometric projections and viewing transformations*,
    /// 1978.)
    ///
    /// ```
    /// use pinhole::prelude::*;
    /// let (origin, y) = (Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0));
    /// let views = [
    ///     ViewTransform::from_reference(origin, y, Vector3::from_ints(0, 0, -1))?, // from the top
    ///     ViewTransform::isometric(origin),
    ///     ViewTransform::from_reference(origin, Vector3::from_ints(1, 2, 1), y)?,
    ///     ViewTransform::from_reference(origin, Vector3::from_ints(1, 2, 3), y)?,
    /// ];
    /// // The foreshortening of each axis under an orthographic projection is √(1 − nᵢ²).
    /// let n = views.map(|view| view.to_matrix()[2]);
    /// let lengths = n.map(|[x, y, z, _]| [x, y, z].map(|c| (100.0 * (1.0 - c * c).sqrt()).round()));
    /// assert_eq!(lengths, [[100.0, 0.0, 100.0], [82.0; 3], [91.0, 58.0, 91.0], [96.0, 85.0, 60.0]]);
    /// # Ok::<(), pinhole::camera::CameraError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`look_at`](Self::look_at).
    pub const fn from_reference(
        vrp: Point3<World>,
        vpn: Vector3<World>,
        vup: Vector3<World>,
    ) -> Result<Self, CameraError> {
        Self::from_axes(vrp, &to_i64(vpn), vup)
    }

    /// The isometric view, VPN (1, 1, 1) and y up: with an orthographic projection all three axes
    /// are foreshortened by √(2/3). Coefficients within 2⁻³².
    /// (Carlbom and Paciorek, *Planar geometric projections and viewing transformations*, 1978.)
    pub const fn isometric(vrp: Point3<World>) -> Self {
        // 1/√2, 1/√6, 2/√6 and 1/√3 in 2⁻³⁰.
        const H: i32 = 759_250_125;
        const S: i32 = 438_353_264;
        const T: i32 = 619_925_131;
        Self { rows: [[H, 0, -H], [-S, 2 * S, -S], [T, T, T]], eye: to_q32(vrp) }
    }

    /// From a rigid row-major matrix for column vectors. The rows of its rotation become u, v, n, rounded to 2⁻³⁰. The eye is
    /// the point that the given matrix maps to the origin, rounded to 2⁻³² world units, so points near the eye stay accurate
    /// far from the world's origin.
    ///
    /// # Errors
    ///
    /// [`CameraError::NotFinite`] names a row that has a number that is NaN or infinite.
    /// [`CameraError::NotRigid`] if the last row is not (0, 0, 0, 1), the rows are left-handed,
    /// or, as given or as rounded, a row's squared length differs from 1 or the dot product of two rows from 0 by more than
    /// 4·10⁻⁶: six correct decimals suffice. [`CameraError::OutOfRange`] if the eye is beyond ±32768 world units.
    ///
    /// ```
    /// use pinhole::{Point3, ViewTransform};
    /// let from_5 = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -5.0], [0.0, 0.0, 0.0, 1.0]];
    /// let view = ViewTransform::from_matrix(&from_5)?;
    /// assert_eq!(view.apply(Point3::from_ints(0, 0, 0)), Point3::from_ints(0, 0, -5));
    /// assert_eq!(view.to_matrix(), from_5);
    /// # Ok::<(), pinhole::camera::CameraError>(())
    /// ```
    pub fn from_matrix(matrix: &[[f64; 4]; 4]) -> Result<Self, CameraError> {
        for (row, name) in matrix.iter().zip(['x', 'y', 'z', 'w']) {
            if row.iter().any(|number| !number.is_finite()) {
                return Err(CameraError::NotFinite { row: name });
            }
        }
        let [u, v, n, last] = *matrix;
        if last != [0.0, 0.0, 0.0, 1.0] {
            return Err(CameraError::NotRigid);
        }
        let translation = [u[3], v[3], n[3]];
        let axes = [u, v, n].map(|row| [row[0], row[1], row[2]]);
        let [u, v, n] = axes;
        if !is_rigid(&axes) {
            return Err(CameraError::NotRigid);
        }
        // |c| ≤ 1 + 2·10⁻⁶: clamped to 2³⁰.
        let nearest = |c: f64| ((c + if c < 0.0 { -0.5 } else { 0.5 }) as i32).clamp(-(1 << 30), 1 << 30);
        let rows = axes.map(|row| row.map(|c| nearest(c * 1_073_741_824.0)));
        // Rounded rows must pass too, so that `from_matrix` accepts the result of `to_matrix`.
        if !is_rigid(&rows.map(to_f64)) {
            return Err(CameraError::NotRigid);
        }
        // −R⁻¹·t by the cofactors; the determinant is within 10⁻⁵ of 1.
        let cofactors = [cross_f64(v, n), cross_f64(n, u), cross_f64(u, v)];
        let determinant = dot(cofactors[0], u);
        let eye = |i: usize| {
            let column = [cofactors[0][i], cofactors[1][i], cofactors[2][i]];
            -dot(column, translation) / determinant
        };
        let part = |e: f64| {
            let inside = (-32_768.0..=32_768.0).contains(&e);
            to_fixed(e, 32).filter(|_| inside).ok_or(CameraError::OutOfRange)
        };
        Ok(Self { rows, eye: [part(eye(0))?, part(eye(1))?, part(eye(2))?] })
    }

    /// The row-major matrix that the camera uses: u, v, n, exact, and the translation −R·eye rounded to 53 bits.
    /// [`from_matrix`](Self::from_matrix) reads it back.
    pub fn to_matrix(&self) -> [[f64; 4]; 4] {
        let [u, v, n] = self.rows.map(|row| {
            let [x, y, z] = to_f64(row);
            // Three products of 31 × 48 bits: exact, then rounded.
            let along: i128 = row.iter().zip(self.eye).map(|(&m, e)| i128::from(m) * i128::from(e)).sum();
            [x, y, z, -(along as f64) * ldexp(1, -62)]
        });
        [u, v, n, [0.0, 0.0, 0.0, 1.0]]
    }

    /// From the direction `back` of n and an up vector, both of any length.
    #[inline(never)] // set-up: code size counts
    const fn from_axes(eye: Point3<World>, back: &[i64; 3], up: Vector3<World>) -> Result<Self, CameraError> {
        let up = to_i64(up);
        let (n, up_unit) = (normalise(back), normalise(&up));
        if is_zero(&n) {
            return Err(CameraError::Direction);
        }
        if is_zero(&up_unit) {
            return Err(CameraError::Direction);
        }
        // |up × n|² = sin² of the angle between them, in 2⁻⁶⁰.
        let sine = cross_units(&up_unit, &n);
        if num::dot(&sine, &sine) < 1 << (60 - 24) {
            return Err(CameraError::Direction);
        }
        // u from the given vectors, not from rounded unit vectors: nearly parallel vectors differ in their low bits only.
        let u = normalise(&cross(&up, back));
        Ok(Self { rows: [u, cross_units(&n, &u), n], eye: to_q32(eye) })
    }

    /// The axes u, v, n as rows, in 2⁻³⁰: −2³⁰ … 2³⁰.
    pub(super) const fn rows(&self) -> [[i32; 3]; 3] {
        self.rows
    }

    /// A world point in view coordinates, rounded to 2⁻¹⁶ and saturated: within ½ + 2⁻¹⁷ of a step of 2⁻¹⁶, given the stored
    /// rows and eye.
    pub fn apply(&self, p: Point3<World>) -> Point3<View> {
        let p = p.bits();
        let relative = |i: usize| add(i64::from(p[i]) << 16, -self.eye[i]);
        let relative = [relative(0), relative(1), relative(2)];
        let image = self.rotation_rows().map(|row| row.apply(&relative));
        Point3::from_bits(image.map(crate::math::to_scalar))
    }

    /// The normal matrix from model to view space of an object with the transform `model`. Components of the normals that it gives are
    /// within 2⁻¹⁵ and κ·2⁻²⁹, where κ is the largest scale factor of `model` divided by its smallest.
    pub(crate) fn normals(&self, model: &Affine<Model, World>) -> NormalMatrix<Model, View> {
        model.normals().rotated(&self.rows)
    }

    /// The eye in 2⁻³² world units, exact: −2⁴⁸ … 2⁴⁸.
    pub(super) const fn eye(&self) -> [i64; 3] {
        self.eye
    }

    pub(super) fn rotation_rows(&self) -> [Row; 3] {
        self.rows.map(|linear| Row { linear, exponent: 0, offset: 0 })
    }
}

const fn to_i64(v: Vector3<World>) -> [i64; 3] {
    let [x, y, z] = v.bits();
    [x as i64, y as i64, z as i64]
}

/// A point's coordinates in 2⁻³².
const fn to_q32(p: Point3<World>) -> [i64; 3] {
    let [x, y, z] = p.bits();
    [(x as i64) << 16, (y as i64) << 16, (z as i64) << 16]
}

/// A row of the rotation as f64.
fn to_f64(row: [i32; 3]) -> [f64; 3] {
    row.map(|c| ldexp(c.into(), -30))
}

/// Whether rows are orthonormal and right-handed, to the precision of six decimals.
fn is_rigid(&[u, v, n]: &[[f64; 3]; 3]) -> bool {
    // Comparisons with NaN are false, so NaN is not rigid.
    let near = |value: f64, wanted: f64| value - wanted > -4e-6 && value - wanted < 4e-6;
    near(dot(u, u), 1.0)
        && near(dot(v, v), 1.0)
        && near(dot(n, n), 1.0)
        && near(dot(u, v), 0.0)
        && near(dot(v, n), 0.0)
        && near(dot(n, u), 0.0)
        && dot(cross_f64(u, v), n) > 0.0
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross_f64(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::{is_rigid, ViewTransform};
    use crate::math::{Angle, Point3, Scalar, Vector3};

    /// An orbit against f64: rotations by pitch and yaw, and the eye at this distance; also at the poles, where `look_at` has no
    /// answer.
    #[test]
    fn orbits_are_within_their_bound() {
        let (target, distance) = (Point3::from_ints(100, -20, 7), 640.5);
        for step in 0..400 {
            let (yaw, pitch) = (Angle::turns(step * 7, 400), Angle::turns(step * 11 + 1, 44));
            let view = ViewTransform::orbit(target, Scalar::from_ratio(1281, 2), yaw, pitch);
            let [yaw, pitch] =
                [yaw, pitch].map(|a| f64::from(a.bits()) / 4_294_967_296.0 * core::f64::consts::TAU);
            let ((sy, cy), (sp, cp)) = (yaw.sin_cos(), pitch.sin_cos());
            let axes = [[cy, 0.0, -sy], [-sy * sp, cp, -cy * sp], [sy * cp, sp, cy * cp]];
            for (row, exact) in view.rows.iter().flatten().zip(axes.as_flattened()) {
                assert!((f64::from(*row) / 1_073_741_824.0 - exact).abs() <= (-28_f64).exp2());
            }
            for ((eye, from), n) in view.eye.iter().zip([100.0, -20.0, 7.0]).zip(axes[2]) {
                let exact = from + distance * n;
                assert!((*eye as f64 / 4_294_967_296.0 - exact).abs() <= distance * (-28_f64).exp2());
            }
        }
        // Any distance and target: no overflow.
        let farthest = Point3::new(Scalar::MIN, Scalar::MAX, Scalar::MIN);
        for distance in [Scalar::MIN, Scalar::MAX, Scalar::ZERO] {
            let eye = ViewTransform::orbit(farthest, distance, Angle::degrees(45), Angle::degrees(-35)).eye;
            assert!(eye.iter().all(|c| c.unsigned_abs() <= 1 << 48), "{eye:?}");
        }
        let up = Vector3::from_ints(0, 1, 0);
        let same = ViewTransform::look_at(Point3::from_ints(3, 0, 0), Point3::from_ints(0, 0, 0), up);
        let origin = Point3::from_ints(0, 0, 0);
        assert_eq!(
            Ok(ViewTransform::orbit(origin, Scalar::from_int(3), Angle::degrees(90), Angle::ZERO)),
            same
        );
    }

    /// A difference equal to the tolerance is refused. `from_matrix` rounds to 2⁻³⁰ and tests again, so only `is_rigid` itself
    /// shows this.
    #[test]
    fn axes_as_skew_as_the_tolerance_are_not_rigid() {
        let skewed = |by: f64| is_rigid(&[[1.0, 0.0, 0.0], [by, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        for by in [4e-6, -4e-6, 5e-6, f64::NAN] {
            assert!(!skewed(by), "{by}");
        }
        for by in [0.0, 3.9e-6, -3.9e-6] {
            assert!(skewed(by), "{by}");
        }
    }
}
