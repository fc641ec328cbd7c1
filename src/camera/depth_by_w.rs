//! Depth under a perspective projection, as a function of w alone.

use super::projection::ratio;
use crate::math::num::{add, mul_translation, scale};
use crate::math::Row;

/// Depth as a function of w. If the rows d and w are parallel but for their offsets, then `d = A·w − B` and depth is
/// `d/w = A − B/w`: w alone decides the near test, and the vertex loop need not evaluate d.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DepthByW {
    /// A, the depth at infinite distance, in 2⁻²⁷: ½ … 4.
    pub(crate) infinity: i32,
    /// B in 2⁻³², positive.
    pub(crate) scale: i64,
    /// For w at least this large, in 2⁻³², d ≥ 0 is certain despite the rounding of the camera's rows.
    pub(crate) near: i64,
}

impl DepthByW {
    /// `None` for parallel projections, whose w is constant; for matrices whose rows d and w are not parallel to z; for
    /// perspectives whose far plane is nearer than 4/3 of the near distance; and for those whose centre of projection is far
    /// from the origin of view space.
    pub(crate) const fn new(d: &Row, w: &Row) -> Option<Self> {
        let ([0, 0, along], [0, 0, away]) = (d.linear, w.linear) else { return None };
        if away == 0 {
            return None;
        }
        // Relative error 2⁻³⁰.
        let (a, e) = ratio(along as i64 * away.signum() as i64, away.unsigned_abs() as u64);
        let e = e + d.exponent - w.exponent;
        let infinity = scale(a, e + 27);
        let drop = add(mul_translation(a as i32, e, w.offset), -d.offset);
        if infinity < 1 << 26 || infinity >= 1 << 29 || drop <= 0 {
            return None;
        }
        let (quotient, exponent) = ratio(drop, a.unsigned_abs()); // infinity > 0, so a > 0
        let near = scale(quotient, exponent - e);
        // A·(w − offset) has a relative error of 2⁻³⁰: given the bound on the offset, 2⁻¹⁸ of w.
        let offset = w.offset.unsigned_abs() as i64;
        if near >= 1 << 60 || offset >> 12 > near {
            return None;
        }
        Some(Self { infinity: infinity as i32, scale: drop, near: near + (near >> 24) + (offset >> 26) + 64 })
    }
}
