//! World to view: where the camera stands and which way is up.

use crate::math::float::{fixed, float};
use crate::math::num::{self, add};
use crate::math::unit::{cross, cross_units, is_zero, normalise};
use crate::math::{Point3, Row, Scalar, Vector3};
use crate::space::{View, World};

/// The rigid transform from world to view, `V = R · T(−eye)`:
///
/// ```text
///     | ux uy uz −u·eye |   u  right          u = (VUP × VPN) / |VUP × VPN|
///     | vx vy vz −v·eye |   v  up             v = n × u
///     | nx ny nz −n·eye |   n  to the viewer  n = VPN / |VPN|
///     | 0  0  0  1      |
/// ```
///
/// The eye is kept exactly and subtracted first, in integers: a scene far from the origin is as
/// sharp as one near it. Rows are in 2⁻³⁰, each coefficient within 2⁻²⁸ over the sine of the angle
/// between VUP and VPN: near-parallel ones leave the roll uncertain. (Foley, van Dam, Feiner, Hughes, *Computer
/// Graphics*, 2nd ed., section 6.5.)
///
/// ```
/// use pinhole::{Point3, Vector3, Viewing, ViewingError};
/// let (eye, target) = (Point3::from_ints(0, 0, 5), Point3::from_ints(0, 0, 0));
/// let viewing = Viewing::look_at(eye, target, Vector3::from_ints(0, 1, 0))?;
/// assert_eq!(viewing.apply(target), Point3::from_ints(0, 0, -5)); // the camera looks along −z
/// let up_is_along_the_gaze = Vector3::from_ints(0, 0, 1);
/// assert_eq!(Viewing::look_at(eye, target, up_is_along_the_gaze), Err(ViewingError::ParallelUp));
/// # Ok::<(), ViewingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Viewing {
    /// u, v, n in 2⁻³⁰.
    rows: [[i32; 3]; 3],
    /// In 2⁻³² world units, within ±2¹⁶ of them.
    eye: [i64; 3],
}

/// Why there is no view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ViewingError {
    /// VPN or gaze has length zero: give a direction, or a target away from the eye.
    ZeroDirection,
    /// VUP has length zero: give any vector that is not along the gaze, such as (0, 1, 0).
    ZeroUp,
    /// An axonometric view needs a VPN of three non-zero components, two equal ones for a dimetric
    /// view and none equal for a trimetric one.
    NotAxonometric,
    /// A matrix that is no rotation and shift.
    NotRigid,
    /// The eye lies outside ±32768 world units: choose a larger unit.
    EyeOutside,
    /// VUP lies within 2⁻¹² rad of the gaze's line, so up is undefined: give another VUP.
    ParallelUp,
}

/// The sides that multiview drawings show. Top is seen with −z upwards, bottom with +z upwards, all
/// others with y upwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Side {
    /// From +z.
    Front,
    /// From −z.
    Back,
    /// From +x.
    Right,
    /// From −x.
    Left,
    /// From +y.
    Top,
    /// From −y.
    Bottom,
}

impl core::fmt::Display for ViewingError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::ZeroDirection => "the viewing direction has length zero",
            Self::ZeroUp => "the up vector has length zero",
            Self::NotAxonometric => "the view plane normal does not fit the axonometric view",
            Self::NotRigid => "the viewing matrix is not rigid",
            Self::EyeOutside => "the eye lies outside the world: choose a larger unit",
            Self::ParallelUp => "the up vector is parallel to the viewing direction: give another",
        })
    }
}

impl core::error::Error for ViewingError {}

impl Viewing {
    /// From `eye` towards `target`, with `up` upwards in the picture. Both vectors are of any length; the
    /// coefficients' bound is that of the [type](Self).
    ///
    /// # Errors
    ///
    /// [`ViewingError::ZeroDirection`] when the target is the eye, [`ZeroUp`](ViewingError::ZeroUp), and
    /// [`ParallelUp`](ViewingError::ParallelUp) when `up` is within 2⁻¹² rad of the gaze's line.
    pub const fn look_at(
        eye: Point3<World>,
        target: Point3<World>,
        up: Vector3<World>,
    ) -> Result<Self, ViewingError> {
        let (e, t) = (eye.bits(), target.bits());
        // 33 bits.
        Self::towards(
            eye,
            &[e[0] as i64 - t[0] as i64, e[1] as i64 - t[1] as i64, e[2] as i64 - t[2] as i64],
            up,
        )
    }

    /// From `eye` along `gaze`, with `up` upwards in the picture.
    ///
    /// ```
    /// use pinhole::{Point3, Vector3, Viewing, ViewingError};
    /// let (eye, right) = (Point3::from_ints(1, 2, 3), Vector3::from_ints(9, 0, 0));
    /// let viewing = Viewing::look_along(eye, right, Vector3::from_ints(0, 1, 0))?;
    /// // Two units ahead of the eye and one above: the camera looks along −z.
    /// assert_eq!(viewing.apply(Point3::from_ints(3, 3, 3)), Point3::from_ints(0, 1, -2));
    /// # Ok::<(), ViewingError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`look_at`](Self::look_at).
    pub const fn look_along(
        eye: Point3<World>,
        gaze: Vector3<World>,
        up: Vector3<World>,
    ) -> Result<Self, ViewingError> {
        let [x, y, z] = longs(gaze);
        Self::towards(eye, &[-x, -y, -z], up)
    }

    /// From a view reference point, a view plane normal (towards the viewer) and an up vector.
    ///
    /// # Errors
    ///
    /// As [`look_at`](Self::look_at).
    pub const fn from_reference(
        vrp: Point3<World>,
        vpn: Vector3<World>,
        vup: Vector3<World>,
    ) -> Result<Self, ViewingError> {
        Self::towards(vrp, &longs(vpn), vup)
    }

    /// One of the six multiview directions, from `vrp`: for an orthographic projection, faces
    /// parallel to the view plane keep their exact size. Exact.
    pub const fn multiview(vrp: Point3<World>, side: Side) -> Self {
        const P: i32 = 1 << 30;
        // u, v, n; n points from the object to the viewer.
        let rows = match side {
            Side::Front => [[P, 0, 0], [0, P, 0], [0, 0, P]],
            Side::Back => [[-P, 0, 0], [0, P, 0], [0, 0, -P]],
            Side::Right => [[0, 0, -P], [0, P, 0], [P, 0, 0]],
            Side::Left => [[0, 0, P], [0, P, 0], [-P, 0, 0]],
            Side::Top => [[P, 0, 0], [0, 0, -P], [0, P, 0]],
            Side::Bottom => [[P, 0, 0], [0, 0, P], [0, -P, 0]],
        };
        Self { rows, eye: wide(vrp) }
    }

    /// The isometric view, VPN (1, 1, 1) and y up: with an orthographic projection all three axes
    /// are foreshortened by √(2/3). Coefficients within 2⁻³².
    /// (Carlbom and Paciorek, *Planar geometric projections and viewing transformations*, 1978.)
    ///
    /// ```
    /// use pinhole::{Point3, Scalar, Side, Vector3, Viewing, ViewingError};
    /// let (origin, up) = (Point3::from_ints(0, 0, 0), Scalar::from_num(2));
    /// let views = [
    ///     Viewing::multiview(origin, Side::Top),
    ///     Viewing::isometric(origin),
    ///     Viewing::dimetric(origin, Scalar::from_num(1), up)?, // VPN (1, 2, 1)
    ///     Viewing::trimetric(origin, Vector3::from_ints(1, 2, 3))?,
    /// ];
    /// // How long a unit of each axis is in the picture: √(1 − its part of n squared).
    /// let n = views.map(|view| view.rows()[2].map(|c| f64::from(c) / f64::from(1 << 30)));
    /// let lengths = n.map(|n| n.map(|c| (100.0 * (1.0 - c * c).sqrt()).round()));
    /// assert_eq!(lengths, [[100.0, 0.0, 100.0], [82.0; 3], [91.0, 58.0, 91.0], [96.0, 85.0, 60.0]]);
    /// # Ok::<(), ViewingError>(())
    /// ```
    pub const fn isometric(vrp: Point3<World>) -> Self {
        // 1/√2, 1/√6, 2/√6 and 1/√3 in 2⁻³⁰.
        const H: i32 = 759_250_125;
        const S: i32 = 438_353_264;
        const T: i32 = 619_925_131;
        Self { rows: [[H, 0, -H], [-S, 2 * S, -S], [T, T, T]], eye: wide(vrp) }
    }

    /// A dimetric view, y up: VPN (`side`, `up`, `side`), so that x and z are foreshortened alike
    /// under an orthographic projection, by √((side² + up²)/(2·side² + up²)), and y by
    /// √(2·side²/(2·side² + up²)).
    ///
    /// # Errors
    ///
    /// [`ViewingError::NotAxonometric`] where a component is zero or both are equal but for the sign, and
    /// [`ViewingError::ParallelUp`] where `side` is below 2⁻¹²·⁵ of `up`. [`isometric`](Self::isometric) has an
    /// example.
    pub const fn dimetric(vrp: Point3<World>, side: Scalar, up: Scalar) -> Result<Self, ViewingError> {
        if side.to_bits() == 0
            || up.to_bits() == 0
            || side.to_bits().unsigned_abs() == up.to_bits().unsigned_abs()
        {
            return Err(ViewingError::NotAxonometric);
        }
        Self::from_reference(vrp, Vector3::new(side, up, side), Vector3::from_ints(0, 1, 0))
    }

    /// A trimetric view, y up: a VPN of three different components, none of them zero, foreshortens
    /// each axis differently under an orthographic projection, axis i by √(1 − (VPNᵢ/|VPN|)²).
    ///
    /// # Errors
    ///
    /// [`ViewingError::NotAxonometric`] where a component is zero or two are equal but for the
    /// sign, and [`ViewingError::ParallelUp`] where the VPN is within 2⁻¹² rad of the y axis.
    pub const fn trimetric(vrp: Point3<World>, vpn: Vector3<World>) -> Result<Self, ViewingError> {
        let [x, y, z] = vpn.bits();
        let (x, y, z) = (x.unsigned_abs(), y.unsigned_abs(), z.unsigned_abs());
        if x == 0 || y == 0 || z == 0 || x == y || y == z || z == x {
            return Err(ViewingError::NotAxonometric);
        }
        Self::from_reference(vrp, vpn, Vector3::from_ints(0, 1, 0))
    }

    /// From a rigid matrix, row by row, for column vectors: the rows of its rotation are u, v, n,
    /// rounded to 2⁻³⁰. The eye is the point that the matrix as given takes to the origin, rounded to
    /// 2⁻³²: what is near it stays sharp, however far away both are.
    ///
    /// # Errors
    ///
    /// [`ViewingError::NotRigid`] where the last row is not (0, 0, 0, 1), a number is not finite,
    /// or the rows are left-handed, or a row's square is not 1 or its product with another not 0, to
    /// 4·10⁻⁶, as given and as rounded: numbers rounded to six decimals pass; [`ViewingError::EyeOutside`] where
    /// the eye leaves the world.
    ///
    /// ```
    /// use pinhole::{Point3, Viewing, ViewingError};
    /// let from_5 = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -5.0], [0.0, 0.0, 0.0, 1.0]];
    /// let view = Viewing::from_matrix(&from_5)?;
    /// assert_eq!(view.eye(), [0, 0, 5 << 32]);
    /// assert_eq!(view.apply(Point3::from_ints(0, 0, 0)), Point3::from_ints(0, 0, -5));
    /// assert_eq!(view.to_matrix(), from_5);
    /// # Ok::<(), ViewingError>(())
    /// ```
    pub fn from_matrix(matrix: &[[f64; 4]; 4]) -> Result<Self, ViewingError> {
        let [u, v, n, last] = *matrix;
        if last != [0.0, 0.0, 0.0, 1.0] {
            return Err(ViewingError::NotRigid);
        }
        let translation = [u[3], v[3], n[3]];
        let axes = [u, v, n].map(|row| [row[0], row[1], row[2]]);
        let [u, v, n] = axes;
        if !is_rigid(&axes) {
            return Err(ViewingError::NotRigid);
        }
        // |c| ≤ 1 + 2·10⁻⁶: brought to 2³⁰ at most.
        let nearest = |c: f64| ((c + if c < 0.0 { -0.5 } else { 0.5 }) as i32).clamp(-(1 << 30), 1 << 30);
        let rows = axes.map(|row| row.map(|c| nearest(c * 1_073_741_824.0)));
        // As rounded too, so that what `to_matrix` gives is taken back.
        if !is_rigid(&rows.map(as_reals)) {
            return Err(ViewingError::NotRigid);
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
            fixed(e, 32).filter(|_| inside).ok_or(ViewingError::EyeOutside)
        };
        Ok(Self { rows, eye: [part(eye(0))?, part(eye(1))?, part(eye(2))?] })
    }

    /// The matrix that it draws with: [`rows`](Self::rows) and the translation −R·eye, rounded to 53 bits.
    /// [`from_matrix`](Self::from_matrix) reads it back.
    pub fn to_matrix(&self) -> [[f64; 4]; 4] {
        let [u, v, n] = self.rows.map(|row| {
            let [x, y, z] = as_reals(row);
            // 31 × 48 bits, three of them: exact, then rounded.
            let along: i128 = row.iter().zip(self.eye).map(|(&m, e)| i128::from(m) * i128::from(e)).sum();
            [x, y, z, -(along as f64) * float(1, -62)]
        });
        [u, v, n, [0.0, 0.0, 0.0, 1.0]]
    }

    /// `back` is the direction of n, of any length.
    #[inline(never)] // set-up: small is better
    const fn towards(eye: Point3<World>, back: &[i64; 3], up: Vector3<World>) -> Result<Self, ViewingError> {
        let up = longs(up);
        let (n, up_unit) = (normalise(back), normalise(&up));
        if is_zero(&n) {
            return Err(ViewingError::ZeroDirection);
        }
        if is_zero(&up_unit) {
            return Err(ViewingError::ZeroUp);
        }
        // The sine of the angle between them, from unit vectors; squared, in 2⁻⁶⁰.
        let sine = cross_units(&up_unit, &n);
        if num::dot(&sine, &sine) < 1 << (60 - 24) {
            return Err(ViewingError::ParallelUp);
        }
        // u from the vectors as given, not from rounded unit vectors: near-parallel ones differ in
        // their low bits.
        let u = normalise(&cross(&up, back));
        Ok(Self { rows: [u, cross_units(&n, &u), n], eye: wide(eye) })
    }

    /// The axes u, v, n as rows, in 2⁻³⁰: from −2³⁰ to 2³⁰. Their bound is that of the constructor.
    pub const fn rows(&self) -> [[i32; 3]; 3] {
        self.rows
    }

    /// The translation column `(−u·eye, −v·eye, −n·eye)` in 2⁻³² world units; each within
    /// 2⁻¹³ over the sine of the angle between VUP and VPN. For inspection only: the pipeline subtracts the eye first.
    pub fn translation(&self) -> [i64; 3] {
        self.rows_over_world().map(|row| row.apply(&self.eye.map(|c| -c)))
    }

    /// A world point in view coordinates, rounded to 2⁻¹⁶ (within ½ + 2⁻¹⁷ of such a step, of the view as it is)
    /// and saturated.
    pub fn apply(&self, p: Point3<World>) -> Point3<View> {
        let p = p.bits();
        let relative = |i: usize| add(i64::from(p[i]) << 16, -self.eye[i]);
        let relative = [relative(0), relative(1), relative(2)];
        let image = self.rows_over_world().map(|row| row.apply(&relative));
        Point3::from_bits(image.map(crate::math::to_scalar))
    }

    /// The eye in 2⁻³² world units, exact: ±2⁴⁷ but for rounding.
    pub const fn eye(&self) -> [i64; 3] {
        self.eye
    }

    pub(super) fn rows_over_world(&self) -> [Row; 3] {
        self.rows.map(|linear| Row { linear, exponent: 0, offset: 0 })
    }
}

const fn longs(v: Vector3<World>) -> [i64; 3] {
    let [x, y, z] = v.bits();
    [x as i64, y as i64, z as i64]
}

/// A point's coordinates in 2⁻³².
const fn wide(p: Point3<World>) -> [i64; 3] {
    let [x, y, z] = p.bits();
    [(x as i64) << 16, (y as i64) << 16, (z as i64) << 16]
}

/// A row of a viewing matrix.
fn as_reals(row: [i32; 3]) -> [f64; 3] {
    row.map(|c| float(c.into(), -30))
}

/// Orthonormal and right-handed, as far as numbers of six decimals can be.
fn is_rigid(&[u, v, n]: &[[f64; 3]; 3]) -> bool {
    // Written so that NaN fails.
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
    use super::is_rigid;

    /// The tolerance itself is refused: `from_matrix` rounds to 2⁻³⁰ afterwards and asks again, so only this function
    /// shows on which side of the limit it lies.
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
