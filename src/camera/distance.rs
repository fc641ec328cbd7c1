//! The distance of points before the camera, along its axis: for fog.

use super::projection::ratio;
use super::Camera;
use crate::math::num::{add, evaluate, row_times, scale};
use crate::math::{homogeneous, Affine, Row};
use crate::space::{Model, World};

impl Camera {
    /// The depth of points `distance` before the camera, in 2⁻³² of a unit, |`distance`| below 2⁴⁹: in 2⁻¹⁶ of a step, rounded to
    /// within 1, and saturated at the ends of `u32`. Points at the centre of projection and behind it count as nearest. `None` if
    /// points of equal distance differ in depth.
    pub(crate) fn depth_at(&self, distance: i64) -> Option<u32> {
        let [.., d, w] = &self.rows;
        let ([0, 0, _], [0, 0, _]) = (d.linear, w.linear) else { return None };
        // Each below 2⁶¹, in one unit. The row d is scaled by 65535/65536: depth is 2¹⁶ · d/w.
        let ([d, w], _) = homogeneous(&[*d, *w], &[0, 0, -distance]);
        if d <= 0 || w <= 0 {
            return Some(0);
        }
        let (mantissa, exponent) = ratio(d, w.unsigned_abs());
        Some(scale(mantissa, exponent + 32).min(u32::MAX.into()) as u32)
    }

    /// A linear form of an object's model coordinates: `full` at points `start` before the camera, 0 at points `end` before it. Both are
    /// in 2⁻¹⁶ world units, and `start` is less than `end`.
    pub(crate) fn ramp(&self, model: &Affine<Model, World>, [start, end]: [i32; 2], full: i32) -> Row {
        let [.., back] = &self.axes; // n, which points to the viewer
        let (m, exponent) = model.linear();
        let offset = evaluate(back, 0, &model.offset_from(&self.eye), 0);
        let towards = Row::new(&row_times(back, m), exponent - 60, add(offset, i64::from(end) << 16));
        // −n is the distance: end − distance. In world units, `full` is reached within the extent, 32 bits.
        let extent = (i64::from(end) - i64::from(start)).unsigned_abs().max(1);
        towards.times(ratio(i64::from(full) << 16, extent))
    }
}
