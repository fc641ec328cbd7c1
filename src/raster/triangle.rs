//! Triangles: their corners, area and order from top to bottom.

use super::{Scissor, ScreenPoint};
use crate::math::determinant;
use core::borrow::Borrow;

/// Twice the signed area in square sub-pixels: positive when the vertices run counter-clockwise
/// as seen with y up, which is what faces the viewer. Exact: |area| ≤ 2⁴⁵.
#[inline(always)]
pub(crate) fn area([a, b, c]: &[ScreenPoint; 3]) -> i64 {
    // Differences below 2²³, products below 2⁴⁵.
    determinant((b.x - a.x, b.y - a.y), (c.x - a.x, c.y - a.y))
}

/// A triangle that is about to be filled, with corners in 24.8, as a custom [`SpanShader`](crate::shading::SpanShader) sees it.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Triangle<'v> {
    /// In any order.
    pub(crate) corners: [ScreenPoint; 3],
    /// The [`area()`] of the corners; not zero.
    pub(crate) area: i64,
    /// The pixels that may be filled. It bounds the distance over which gradients must be accurate.
    pub(crate) viewport: &'v Scissor,
}

impl<'v> Triangle<'v> {
    /// A triangle whose `area` is the [`area()`] of its corners and not zero, and of which only pixels inside the viewport
    /// are filled.
    #[inline(always)]
    pub(crate) fn new(corners: [ScreenPoint; 3], area: i64, viewport: &'v Scissor) -> Self {
        Self { corners, area, viewport }
    }

    /// Replaces the corners and their area.
    #[inline(always)]
    pub(crate) fn set(&mut self, corners: [ScreenPoint; 3], area: i64) {
        (self.corners, self.area) = (corners, area);
    }

    /// Whether the triangle lies to the left or to the right of the scissor: it covers no pixel of it.
    #[inline(always)]
    pub(crate) fn is_beside(&self, scissor: &Scissor) -> bool {
        let bounds = Scissor::bounding_box(&self.corners);
        bounds.left >= scissor.right || bounds.right <= scissor.left
    }

    #[inline(always)]
    pub(crate) fn corners(&self) -> &[ScreenPoint; 3] {
        &self.corners
    }
}

/// The corners sorted by y, and whether the middle corner lies to the left of the edge between the top and the bottom
/// one.
#[inline(always)]
pub(crate) fn sort_by_y<P: Borrow<ScreenPoint>>(corners: [P; 3], area: i64) -> ([P; 3], bool) {
    let [mut a, mut b, mut c] = corners;
    let is_above = |p: &P, q: &P| p.borrow().y < q.borrow().y;
    // If a, b, c run counter-clockwise with y up, a on top and c at the bottom, then b lies to the left of the edge a–c. Each
    // exchange of two corners reverses the orientation.
    let mut orientation = (area >> 32) as i32;
    if is_above(&b, &a) {
        (a, b, orientation) = (b, a, !orientation);
    }
    if is_above(&c, &b) {
        (b, c, orientation) = (c, b, !orientation);
        if is_above(&b, &a) {
            (a, b, orientation) = (b, a, !orientation);
        }
    }
    ([a, b, c], orientation >= 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::mixed;

    /// Half of the shoelace formula's sum, with y down: negative for corners that run counter-clockwise with y up.
    #[test]
    fn a6_the_area_is_positive_counter_clockwise_with_y_up() {
        let mut state = 0xA6;
        for k in 0..10_000 {
            let mut number = || (mixed(&mut state) as i32) >> (10 + k % 21); // ±2²¹ and less
            let corners = [(); 3].map(|()| ScreenPoint::clamped(number(), number()));
            let [a, b, c] = corners.map(|p| (i128::from(p.x), i128::from(p.y)));
            let sum = [(a, b), (b, c), (c, a)].map(|(p, q)| p.0 * q.1 - q.0 * p.1).iter().sum::<i128>();
            assert_eq!(i128::from(area(&corners)), -sum);
        }
    }
}
