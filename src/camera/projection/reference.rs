//! View volumes by projection reference point and window.

use super::parts::{extent, offset, ratio, row, ONE};
use super::{Projection, Window};
use crate::camera::CameraError;
use crate::math::num::{mul_translation, scale, SATURATED};
use crate::math::{homogeneous, to_scalar, Point3, Row, Scalar};
use crate::space::{Canonical, View};

/// A view volume by projection reference point (PRP), window on the view plane, and front and back
/// planes, all in view coordinates u, v, n; the view plane is n = 0, through the VRP.
///
/// It stores the normalising transform from view coordinates to the canonical view volume:
///
/// ```text
///     parallel     S · T · Sh          onto −1 ≤ x, y ≤ 1, −1 ≤ z ≤ 0
///     perspective  S · Sh · T(−PRP)    onto x = ±z, y = ±z, z = −z_min, z = −1
/// ```
///
/// where Sh shears the volume's centre line, from the PRP to the window's centre, onto the z axis.
/// [`Projection::from_reference`] continues to clip space. (Foley et al., *Computer Graphics*, 2nd
/// ed., sections 6.2 and 6.5.)
///
/// ```
/// use pinhole::{camera::{CameraError, ReferenceVolume, Window}, prelude::*};
/// let number = |v| Scalar::from_f32(v).unwrap();
/// let window = Window { left: number(-1.0), right: number(3.0), bottom: number(-1.0), top: number(3.0) };
/// let prp = Point3::from_f32(0.5, 0.5, 1.0).unwrap();
/// let volume = ReferenceVolume::perspective(prp, window, number(0.5), number(-4.0))?;
/// // A corner of the window lies on x = −z, y = z of the canonical volume.
/// let corner = volume.normalise(Point3::from_ints(3, -1, 0));
/// assert_eq!((corner.x(), corner.y()), (-corner.z(), corner.z()));
/// let _ = Projection::from_reference(&volume);
/// # Ok::<(), CameraError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReferenceVolume {
    /// Canonical x, y, z as linear forms of view coordinates; for a perspective times the distance of its back plane, so that
    /// constants lose no bits if that is far away.
    rows: [Row; 3],
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Parallel,
    /// The front plane on the n axis and its and the back plane's distances from the PRP, in 2⁻¹⁶.
    Perspective {
        front: i32,
        to_front: u64,
        to_back: u64,
    },
}

impl ReferenceVolume {
    /// A perspective volume. The centre of projection is the PRP, which lies in front of the view plane (n > 0);
    /// `front` and `back` are positions on the n axis in world units, back < front < PRP.
    ///
    /// # Errors
    ///
    /// [`CameraError::ReferenceBehindPlane`], [`EmptyWindow`](CameraError::EmptyWindow),
    /// [`WindowTooSmall`](CameraError::WindowTooSmall),
    /// [`NearNotPositive`](CameraError::NearNotPositive) where front is not before the PRP,
    /// [`NearNotBeforeFar`](CameraError::NearNotBeforeFar) and
    /// [`NearTooCloseToFar`](CameraError::NearTooCloseToFar).
    pub fn perspective(
        prp: Point3<View>,
        window: Window,
        front: Scalar,
        back: Scalar,
    ) -> Result<Self, CameraError> {
        let pn = before_plane(prp)?;
        let to_front = extent(front, prp.z()).ok_or(CameraError::NearNotPositive)?;
        let depth = extent(back, front).ok_or(CameraError::NearNotBeforeFar)?;
        // 34 bits.
        let to_back = depth + to_front;
        // 2·pn/extent brings the window's border to 45°.
        let [x, y] = sides(prp, window, |extent| ratio(2 * pn, extent))?;
        let z = row(2, (1, 0), -(pn << 16));
        if offset(to_front as i64, depth).is_none() {
            return Err(CameraError::NearTooCloseToFar);
        }
        let kind = Kind::Perspective { front: front.to_bits(), to_front, to_back };
        Ok(Self { rows: [x, y, z], kind })
    }

    /// A volume of parallel projection. Projectors run along the direction from the PRP to the window's centre; orthographic
    /// where that is the n axis, oblique otherwise. `front` and `back` are positions on the n axis in world units, back < front.
    ///
    /// # Errors
    ///
    /// The errors of [`perspective`](Self::perspective) except `NearNotPositive`: front may lie anywhere.
    pub fn parallel(
        prp: Point3<View>,
        window: Window,
        front: Scalar,
        back: Scalar,
    ) -> Result<Self, CameraError> {
        before_plane(prp)?;
        let depth = extent(back, front).ok_or(CameraError::NearNotBeforeFar)?;
        let [x, y] = sides(prp, window, |extent| ratio(2 << 16, extent))?;
        let z = row(2, (1, 0), -(i64::from(front.to_bits()) << 16)).times(ratio(1 << 16, depth));
        if offset(i64::from(front.to_bits()), depth).is_none() {
            return Err(CameraError::NearTooCloseToFar);
        }
        Ok(Self { rows: [x, y, z], kind: Kind::Parallel })
    }

    /// A point of view space in the canonical volume's coordinates, rounded to 2⁻¹⁶ (within ½ + 2⁻¹⁷ of such a step) and
    /// saturated. Rounded coefficients add at most 2⁻²⁷ of the largest coefficient times the largest coordinate (or of the
    /// constant, where that is larger) and 2⁻³¹.
    pub fn normalise(&self, p: Point3<View>) -> Point3<Canonical> {
        let p = p.bits().map(|c| i64::from(c) << 16);
        let shrink = match self.kind {
            Kind::Parallel => ONE,
            Kind::Perspective { to_back, .. } => ratio(1 << 16, to_back),
        };
        let (xyz, shift) = homogeneous(&self.rows, &p);
        Point3::from_bits(xyz.map(|v| {
            to_scalar(mul_translation(shrink.0 as i32, shrink.1 + shift, v)) // |m| ≤ 2³⁰
        }))
    }

    /// z_min of the perspective canonical volume, whose front plane is z = −z_min: rounded to
    /// 2⁻¹⁶ (within ½ + 2⁻¹⁴ of such a step). Zero for a parallel one, whose front plane is z = 0.
    pub fn z_min(&self) -> Scalar {
        match self.kind {
            Kind::Parallel => Scalar::ZERO,
            Kind::Perspective { to_front, to_back, .. } => {
                let (m, e) = ratio(to_front as i64, to_back); // 34 bits
                Scalar::from_bits(to_scalar(scale(m, e + 32)))
            }
        }
    }
}

/// The PRP's distance from the view plane, in 2⁻¹⁶.
fn before_plane(prp: Point3<View>) -> Result<i64, CameraError> {
    let pn = i64::from(prp.z().to_bits());
    if pn <= 0 {
        return Err(CameraError::ReferenceBehindPlane);
    }
    Ok(pn)
}

/// The rows x and y: sheared so that the volume's centre line is parallel to n, times `factor` of the window's extent.
fn sides(
    prp: Point3<View>,
    window: Window,
    factor: impl Fn(u64) -> (i64, i32),
) -> Result<[Row; 2], CameraError> {
    let [px, py, pn] = prp.bits().map(i64::from);
    let form = |axis: usize, p: i64, low: Scalar, high: Scalar| {
        let (sheared, extent) = sheared(axis, p, pn, low, high)?;
        unsaturated(sheared.times(factor(extent)))
    };
    Ok([form(0, px, window.left, window.right)?, form(1, py, window.bottom, window.top)?])
}

/// `axis + n·(centre − p)/pn − centre`, which is 0 on the volume's centre line and a translation in the view plane; and the
/// window's extent.
fn sheared(axis: usize, p: i64, pn: i64, low: Scalar, high: Scalar) -> Result<(Row, u64), CameraError> {
    let extent = extent(low, high).ok_or(CameraError::EmptyWindow)?;
    let sum = i64::from(low.to_bits()) + i64::from(high.to_bits()); // twice the centre
    let slope = ratio(sum - 2 * p, 2 * pn.unsigned_abs());
    let straight = row(axis, (1, 0), -(sum << 15));
    Ok((straight.linear_combination(ONE, &row(2, slope, 0), ONE), extent))
}

/// The row; an error if its constant is saturated.
fn unsaturated(row: Row) -> Result<Row, CameraError> {
    if row.offset.abs() >= SATURATED {
        return Err(CameraError::WindowTooSmall);
    }
    Ok(row)
}

impl Projection {
    /// The projection of a view volume: from canonical coordinates to clip space by parallel `z = −2·z − 1, w = 1`; perspective
    /// `z = (−(1 + z_min)·z − 2·z_min)/(1 − z_min), w = −z`.
    pub fn from_reference(volume: &ReferenceVolume) -> Self {
        let [x, y, z] = volume.rows;
        let minus = (-ONE.0, ONE.1);
        let (d, w) = match volume.kind {
            Kind::Parallel => (z.times(minus), Row { offset: 1 << 32, ..Row::ZERO }),
            Kind::Perspective { front, to_front, to_back } => {
                // The canonical rows are scaled by the distance to the back plane, which divides out: d = (−z − z_min)/(1 − z_min).
                let (m, e) = ratio(to_back as i64, to_back - to_front);
                let d = row(2, (1, 0), -(i64::from(front) << 16)).times((-m, e));
                (d, z.times(minus))
            }
        };
        Self { rows: [x, y, d, w] }
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for ReferenceVolume {
    fn format(&self, f: defmt::Formatter<'_>) {
        for row in &self.rows {
            let (linear, exponent, offset) = (row.linear, row.exponent, row.offset);
            defmt::write!(f, "[{} * 2^({=i32} - 30), {=i64}/2^32]", linear, exponent, offset);
        }
    }
}
