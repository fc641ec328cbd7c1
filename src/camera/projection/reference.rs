//! View volumes by projection reference point and window.

use super::parts::{extent, offset, ratio, row, ONE};
use super::{Projection, Window};
use crate::camera::CameraError;
use crate::math::num::SATURATED;
use crate::math::{Point3, Row, Scalar};
use crate::space::View;

impl Projection {
    /// The perspective by projection reference point (PRP), window on the view plane n = 0, and front and back planes, all in view
    /// coordinates u, v, n. The centre of projection is the PRP, which lies in front of the view plane (n > 0); `front` and `back` are
    /// positions on the n axis in world units, back < front < PRP. The volume's centre line, from the PRP to the window's centre, is
    /// sheared onto the z axis. (Foley et al., *Computer Graphics*, 2nd ed., sections 6.2 and 6.5.)
    ///
    /// Rounded coefficients move x and y by at most 2⁻²⁷ of the row's largest coefficient times the largest coordinate, or of its
    /// constant.
    ///
    /// ```
    /// use pinhole::{camera::Window, prelude::*};
    /// let number = |v| Scalar::from_f32(v).unwrap();
    /// let window = Window { left: number(-1.0), right: number(3.0), bottom: number(-1.0), top: number(3.0) };
    /// let prp = Point3::from_f32(0.5, 0.5, 1.0).unwrap();
    /// let lens = Projection::perspective_from_reference(prp, window, number(0.5), number(-4.0))?;
    /// // A corner of the window is a corner of the picture.
    /// let corner = lens.apply(Point3::from_ints(3, -1, 0)).unwrap();
    /// assert_eq!((corner.x(), corner.y()), (Scalar::ONE, -Scalar::ONE));
    /// # Ok::<(), pinhole::camera::CameraError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError::NoViewPlane`], [`EmptyWindow`](CameraError::EmptyWindow),
    /// [`NearNotPositive`](CameraError::NearNotPositive) where front is not before the PRP, and
    /// [`NearNotBeforeFar`](CameraError::NearNotBeforeFar).
    pub fn perspective_from_reference(
        prp: Point3<View>,
        window: Window,
        front: Scalar,
        back: Scalar,
    ) -> Result<Self, CameraError> {
        let pn = before_plane(prp)?;
        let to_front = extent(front, prp.z()).ok_or(CameraError::NearNotPositive)?;
        let depth = extent(back, front).ok_or(CameraError::NearNotBeforeFar)?;
        // 2·pn/extent brings the window's border to 45°. All rows are those of the canonical volume times the distance of its back
        // plane, so that constants lose no bits if that is far away.
        let [x, y] = sides(prp, window, |extent| ratio(2 * pn, extent))?;
        if offset(to_front as i64, depth).is_none() {
            return Err(CameraError::NearNotBeforeFar);
        }
        // d = (−z − z_min)/(1 − z_min); the distance from the PRP to the back plane has 34 bits.
        let (m, e) = ratio((depth + to_front) as i64, depth);
        let d = row(2, (1, 0), -(i64::from(front.to_bits()) << 16)).times((-m, e));
        let w = row(2, (-1, 0), pn << 16);
        Ok(Self { rows: [x, y, d, w] })
    }

    /// The parallel projection by PRP, window on the view plane n = 0, and front and back planes, as in
    /// [`perspective_from_reference`](Self::perspective_from_reference). Projectors run along the direction from the PRP to the window's
    /// centre: orthographic where that is the n axis, oblique otherwise.
    ///
    /// # Errors
    ///
    /// The errors of `perspective_from_reference` except `NearNotPositive`: front may lie anywhere.
    pub fn parallel_from_reference(
        prp: Point3<View>,
        window: Window,
        front: Scalar,
        back: Scalar,
    ) -> Result<Self, CameraError> {
        before_plane(prp)?;
        let depth = extent(back, front).ok_or(CameraError::NearNotBeforeFar)?;
        let [x, y] = sides(prp, window, |extent| ratio(2 << 16, extent))?;
        if offset(i64::from(front.to_bits()), depth).is_none() {
            return Err(CameraError::NearNotBeforeFar);
        }
        let (m, e) = ratio(1 << 16, depth);
        let d = row(2, (1, 0), -(i64::from(front.to_bits()) << 16)).times((-m, e));
        Ok(Self { rows: [x, y, d, Row { offset: 1 << 32, ..Row::ZERO }] })
    }
}

/// The PRP's distance from the view plane, in 2⁻¹⁶.
fn before_plane(prp: Point3<View>) -> Result<i64, CameraError> {
    let pn = i64::from(prp.z().to_bits());
    if pn <= 0 {
        return Err(CameraError::NoViewPlane);
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
        return Err(CameraError::EmptyWindow);
    }
    Ok(row)
}
