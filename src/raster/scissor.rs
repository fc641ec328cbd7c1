//! Rectangles of pixels that drawing is restricted to.

use super::{ScreenPoint, GUARD_BAND};

/// The scissor rectangle: columns `left` up to but excluding `right`, rows `top` up to but excluding `bottom`. No pixel
/// outside is written. Empty if `left ≥ right` or `top ≥ bottom`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Scissor {
    pub(crate) left: i32,
    pub(crate) top: i32,
    pub(crate) right: i32,
    pub(crate) bottom: i32,
}

impl Scissor {
    /// A scissor in pixels. Its bounds are clamped to ±32768: no pixel beyond is ever drawn.
    #[cfg(test)]
    pub(crate) fn new(left: i32, top: i32, right: i32, bottom: i32) -> Self {
        Self { left, top, right, bottom }.clamped()
    }

    /// The scissor with its bounds clamped to ±32768.
    pub(crate) fn clamped(&self) -> Self {
        let clamped = |v: i32| v.clamp(-32_768, 32_768);
        Self {
            left: clamped(self.left),
            top: clamped(self.top),
            right: clamped(self.right),
            bottom: clamped(self.bottom),
        }
    }

    /// A scissor with these bounds. The caller knows that they lie inside the guard band, or intersects the result with a
    /// scissor that does.
    #[inline(always)]
    pub(crate) const fn unclamped(left: i32, top: i32, right: i32, bottom: i32) -> Self {
        Self { left, top, right, bottom }
    }

    /// All pixels inside the guard band: the viewport of 2D drawing, which has no camera.
    pub(crate) const GUARD_BAND: Self =
        Self { left: -GUARD_BAND, top: -GUARD_BAND, right: GUARD_BAND, bottom: GUARD_BAND };

    pub(crate) const EMPTY: Self = Self { left: 0, top: 0, right: 0, bottom: 0 };

    /// The neutral element of [`union`](Self::union).
    pub(crate) const UNION_IDENTITY: Self =
        Self { left: i32::MAX, top: i32::MAX, right: i32::MIN, bottom: i32::MIN };

    /// The pixels whose centres lie in a triangle's bounding box. The triangle covers no pixel outside.
    #[inline(always)]
    pub(crate) fn bounding_box([a, b, c]: &[ScreenPoint; 3]) -> Self {
        let first = |p: i32| (p + 127) >> 8; // ⌈p − ½⌉
        Self {
            left: first(a.x.min(b.x).min(c.x)),
            top: first(a.y.min(b.y).min(c.y)),
            right: first(a.x.max(b.x).max(c.x)),
            bottom: first(a.y.max(b.y).max(c.y)),
        }
    }

    /// The rectangle with this many more pixels on each side, inside the range of `i32`.
    #[inline(always)]
    pub(crate) fn grown(&self, by: i32) -> Self {
        Self { left: self.left - by, top: self.top - by, right: self.right + by, bottom: self.bottom + by }
    }

    /// The smallest rectangle that contains both. The bounds of an empty rectangle are included, too; only
    /// [`UNION_IDENTITY`](Self::UNION_IDENTITY) adds nothing.
    #[inline(always)]
    pub(crate) fn union(&self, other: &Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// The pixels that lie in both rectangles. If there are none, the result is empty, with arbitrary bounds.
    #[inline(always)]
    pub(crate) fn intersection(&self, other: &Self) -> Self {
        Self {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.min(other.right),
            bottom: self.bottom.min(other.bottom),
        }
    }

    /// The pixels that lie in both rectangles, [`EMPTY`](Self::EMPTY) if there are none. The result lies inside the guard band
    /// if `other` does, whatever the bounds of `self`.
    pub(crate) fn clipped_to(&self, other: &Self) -> Self {
        let both = self.intersection(other);
        if both.is_empty() {
            Self::EMPTY
        } else {
            both
        }
    }

    /// Whether two rectangles that are not empty have a pixel in common.
    #[inline(always)]
    pub(crate) fn meets(&self, other: &Self) -> bool {
        self.left < other.right
            && self.right > other.left
            && self.top < other.bottom
            && self.bottom > other.top
    }

    /// Whether a rectangle that is not empty lies inside this one.
    #[inline(always)]
    pub(crate) fn contains(&self, other: &Self) -> bool {
        self.left <= other.left
            && self.right >= other.right
            && self.top <= other.top
            && self.bottom >= other.bottom
    }

    /// Whether the scissor contains no pixel.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }

    /// The rows, `top` up to but excluding `bottom`.
    #[inline(always)]
    pub(crate) fn rows(&self) -> core::ops::Range<i32> {
        self.top..self.bottom
    }

    /// The columns, `left` up to but excluding `right`.
    pub(crate) fn columns(&self) -> core::ops::Range<i32> {
        self.left..self.right
    }
}
