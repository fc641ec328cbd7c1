//! Triangles: their area, and the definition of the pixels that they cover.
//!
//! A row's covered pixels lie between two edges. Both ends are `⌈X − ½⌉`, where X is the edge's intersection with the
//! row of pixel centres; the left end is included and the right end excluded. This is the top-left rule (R2–R5), and
//! since an end depends on one edge alone, triangles on both sides of the edge share it (R8).

use super::any_triangle::Spans;
use super::{Gradient, GradientSetup, Scissor, ScreenPoint, Span};
use crate::math::determinant;
use core::borrow::Borrow;

/// Twice the signed area in square sub-pixels: positive when the vertices run counter-clockwise
/// as seen with y up, which is what faces the viewer. Exact: |area| ≤ 2⁴⁵.
#[inline(always)]
pub fn area([a, b, c]: &[ScreenPoint; 3]) -> i64 {
    // Differences below 2²³, products below 2⁴⁵.
    determinant((b.x - a.x, b.y - a.y), (c.x - a.x, c.y - a.y))
}

/// A triangle that is about to be filled, with corners in 24.8, as a custom [`SpanShader`](crate::SpanShader) sees it.
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

    #[inline(always)]
    pub(crate) fn corners(&self) -> &[ScreenPoint; 3] {
        &self.corners
    }

    /// The covered pixels inside the scissor: one span per row, top to bottom.
    #[inline(always)]
    pub(crate) fn spans(&self, scissor: &Scissor) -> Spans {
        Spans::new(self, scissor)
    }

    /// The gradient of a value given at each corner, 0 … 2²⁴ − 1 in the corners' order, for custom shaders. Larger values
    /// count as 2²⁴ − 1.
    pub fn plane(&self, values: [u32; 3]) -> Gradient {
        GradientSetup::new(self).through(&values.map(|value| value.min((1 << 24) - 1) as i32))
    }
}

/// Calls `span` for each row's covered pixels inside the scissor, top to bottom: rules R1 to R9.
///
/// # Errors
///
/// The first error of `span`; no further span is computed.
///
/// ```
/// use pinhole::raster::{triangle, Scissor, ScreenPoint};
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let scissor = Scissor::new(0, 0, 16, 16);
/// let mut rows = Vec::new();
/// triangle([corner(0, 0), corner(4, 0), corner(0, 4)], &scissor, |s| -> Result<(), ()> {
///     rows.push((s.y, s.x, s.width));
///     Ok(())
/// })?;
/// // The slanted edge passes through pixel centres and is a right edge: they are not covered.
/// assert_eq!(rows, [(0, 0, 3), (1, 0, 2), (2, 0, 1)]);
/// # Ok::<(), ()>(())
/// ```
pub fn triangle<E>(
    vertices: [ScreenPoint; 3],
    scissor: &Scissor,
    span: impl FnMut(Span) -> Result<(), E>,
) -> Result<(), E> {
    match area(&vertices) {
        0 => Ok(()), // R6
        area => Triangle::new(vertices, area, scissor).spans(scissor).try_for_each(span),
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
