//! World to view: where the camera stands and which way is up.

use crate::math::num::add;
use crate::math::unit::{cross, cross_units, normalise};
use crate::math::{Point3, Row, Vector3};
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
/// sharp as one near it. Rows are in 2⁻³⁰, each coefficient within 2⁻²⁹ for VUP well away from
/// VPN; the roll error grows as 1/sin of their angle. (Foley, van Dam, Feiner, Hughes, *Computer
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
    /// In 2⁻¹⁶ world units.
    eye: [i32; 3],
}

/// Why there is no view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ViewingError {
    /// VPN or gaze has length zero: give a direction, or a target away from the eye.
    ZeroDirection,
    /// VUP has length zero: give any vector that is not along the gaze, such as (0, 1, 0).
    ZeroUp,
    /// VUP lies within 2⁻¹² rad of the gaze's line, so up is undefined: give another VUP.
    ParallelUp,
}

impl core::fmt::Display for ViewingError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::ZeroDirection => "the viewing direction has length zero",
            Self::ZeroUp => "the up vector has length zero",
            Self::ParallelUp => "the up vector is parallel to the viewing direction: give another",
        })
    }
}

impl core::error::Error for ViewingError {}

impl Viewing {
    /// From `eye` towards `target`, with `up` upwards in the picture.
    ///
    /// # Errors
    ///
    /// [`ViewingError`] when the target is the eye, or `up` is zero or along the gaze.
    pub fn look_at(
        eye: Point3<World>,
        target: Point3<World>,
        up: Vector3<World>,
    ) -> Result<Self, ViewingError> {
        let (e, t) = (eye.bits(), target.bits());
        let back = |i: usize| i64::from(e[i]) - i64::from(t[i]); // 33 bits
        Self::towards(e, [back(0), back(1), back(2)], up)
    }

    /// From `eye` along `gaze`, with `up` upwards in the picture.
    ///
    /// # Errors
    ///
    /// [`ViewingError`] when `gaze` or `up` is zero or they are parallel.
    pub fn look_along(
        eye: Point3<World>,
        gaze: Vector3<World>,
        up: Vector3<World>,
    ) -> Result<Self, ViewingError> {
        Self::towards(eye.bits(), gaze.bits().map(|c| -i64::from(c)), up)
    }

    /// From a view reference point, a view plane normal (towards the viewer) and an up vector.
    ///
    /// # Errors
    ///
    /// [`ViewingError`] when `vpn` or `vup` is zero or they are parallel.
    pub fn from_reference(
        vrp: Point3<World>,
        vpn: Vector3<World>,
        vup: Vector3<World>,
    ) -> Result<Self, ViewingError> {
        Self::towards(vrp.bits(), vpn.bits().map(i64::from), vup)
    }

    /// `back` is the direction of n, of any length.
    fn towards(eye: [i32; 3], back: [i64; 3], up: Vector3<World>) -> Result<Self, ViewingError> {
        let up = up.bits().map(i64::from);
        let n = normalise(back).ok_or(ViewingError::ZeroDirection)?;
        let up_unit = normalise(up).ok_or(ViewingError::ZeroUp)?;
        // The sine of the angle between them, from unit vectors; squared, in 2⁻⁶⁰.
        let sine = cross_units(up_unit, n);
        let square: i64 = sine.iter().map(|&c| i64::from(c) * i64::from(c)).sum();
        if square < 1 << (60 - 24) {
            return Err(ViewingError::ParallelUp);
        }
        // u from the vectors as given, not from rounded unit vectors: near-parallel ones differ in
        // their low bits.
        let u = normalise(cross(up, back)).ok_or(ViewingError::ParallelUp)?;
        Ok(Self { rows: [u, cross_units(n, u), n], eye })
    }

    /// The axes u, v, n as rows, in 2⁻³⁰.
    pub const fn rows(&self) -> [[i32; 3]; 3] {
        self.rows
    }

    /// The translation column `(−u·eye, −v·eye, −n·eye)` in 2⁻³² world units, each within 2⁻¹³:
    /// for reading. The pipeline subtracts the eye first and does not use it.
    pub fn translation(&self) -> [i64; 3] {
        self.rows_over_world().map(|row| row.apply(self.eye.map(|c| -(i64::from(c) << 16))))
    }

    /// A world point in view coordinates, rounded to the nearest 2⁻¹⁶ and saturated.
    pub fn apply(&self, p: Point3<World>) -> Point3<View> {
        let p = p.bits();
        let relative = |i: usize| add(i64::from(p[i]) << 16, -(i64::from(self.eye[i]) << 16));
        let relative = [relative(0), relative(1), relative(2)];
        let image = self.rows_over_world().map(|row| row.apply(relative));
        Point3::from_bits(image.map(crate::math::to_scalar))
    }

    /// The eye in 2⁻¹⁶ world units.
    pub(super) const fn eye(&self) -> [i32; 3] {
        self.eye
    }

    pub(super) fn rows_over_world(&self) -> [Row; 3] {
        self.rows.map(|linear| Row { linear, exponent: 0, offset: 0 })
    }
}
