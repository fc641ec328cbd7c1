//! Depth of a perspective picture: a function of w alone.

use super::projection::ratio;
use crate::math::num::{add, mul_translation, scale};
use crate::math::Row;

/// Where d and w are parallel forms, `d = A·w − B`, depth is `d/w = A − B/w`, and a w tells whether near
/// cuts: the vertex loop needs no form for d.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DepthByW {
    /// A in 2⁻²⁷: ½ … 4.
    pub(crate) infinity: i32,
    /// B in 2⁻³², positive.
    pub(crate) scale: i64,
    /// With this w, in 2⁻³², or a greater one, d is not negative, whatever the camera's own roundings do.
    pub(crate) near: i64,
}

impl DepthByW {
    /// All perspectives have it but those whose far plane follows right after near (less than 4/3 of its
    /// distance), and those that look past a distant eye. Parallel projections have not, for their w is
    /// constant, nor have matrices whose z slants.
    pub(crate) const fn new(d: &Row, w: &Row) -> Option<Self> {
        let ([0, 0, along], [0, 0, away]) = (d.linear, w.linear) else { return None };
        if away == 0 {
            return None;
        }
        // Within 2⁻³⁰ of itself.
        let (a, e) = ratio(along as i64 * away.signum() as i64, away.unsigned_abs() as u64);
        let e = e + d.exponent - w.exponent;
        let infinity = scale(a, e + 27);
        let drop = add(mul_translation(a as i32, e, w.offset), -d.offset);
        if infinity < 1 << 26 || infinity >= 1 << 29 || drop <= 0 {
            return None;
        }
        let (quotient, exponent) = ratio(drop, a.unsigned_abs()); // infinity > 0, so a > 0
        let near = scale(quotient, exponent - e);
        // A·(w − offset) is off by 2⁻³⁰ of itself: with the offset below, by 2⁻¹⁸ of w.
        let offset = w.offset.unsigned_abs() as i64;
        if near >= 1 << 60 || offset >> 12 > near {
            return None;
        }
        Some(Self { infinity: infinity as i32, scale: drop, near: near + (near >> 24) + (offset >> 26) + 64 })
    }
}
