//! The rasteriser: pure integers, no colour and no target. Usable by itself.
//!
//! # Rules
//!
//! Lines:
//! - **L1** every pixel lies within ½ pixel of the true line along the minor axis;
//! - **L2** a line clipped to a rectangle draws exactly those pixels of the unclipped line that lie
//!   in the rectangle;
//! - **L3** A→B and B→A draw the same pixels: ends are ordered by (x, y), and from there a tie
//!   keeps the smaller minor step, in every octant.
//!
//! Triangles:
//! - **R1** pixel (i, j) has its centre at (i + ½, j + ½);
//! - **R2** it is covered when, for each edge, the centre lies strictly on its inner side, or on it
//!   and the edge is a left or a top edge;
//! - **R3** left edge: not horizontal, interior to its right;
//! - **R4** top edge: horizontal, interior below;
//! - **R5** a centre on a vertex is covered as its edges say;
//! - **R6** a triangle of no area covers nothing;
//! - **R7** order and winding of the vertices do not matter;
//! - **R8** triangles on opposite sides of shared edges cover every centre in the interior of their
//!   union exactly once, and on its border at most once;
//! - **R9** all this without tolerance, for every triangle in the guard band.
//!
//! (Direct3D 11.3 functional specification, section 3.4.2: the top-left rule.)
//!
//! Screen points come from a transform or, for those who rasterise in 2D, through a door that
//! refuses what is out of range:
//!
//! ```
//! use pinhole::raster::ScreenPoint;
//! assert!(ScreenPoint::from_subpixels(8192 * 256, 0).is_some());
//! assert!(ScreenPoint::from_subpixels(8192 * 256 + 1, 0).is_none());
//! ```
//! ```compile_fail,E0451
//! let forged = pinhole::raster::ScreenPoint { x: 1 << 30, y: 0 };
//! ```

mod depth;
mod depth_triangle;
pub(crate) mod edge;
pub(crate) mod gradient;
mod light;
mod line;
mod line_depth;
pub(crate) mod pixel_layout;
pub(crate) mod trapezoid;
pub(crate) mod triangle;

pub(crate) use crate::fast::{Inside, Kept, Low};
pub(crate) use depth::FARTHEST;
pub(crate) use depth_triangle::DepthTriangle;
pub use gradient::Gradient;
pub(crate) use gradient::GradientSetup;
pub use line::line;
pub(crate) use line::{LineSetup, LineSpans};
pub(crate) use line_depth::LineDepth;
pub(crate) use pixel_layout::{place, PixelLayout, RowOrigin, RowScratch, Rows};
pub(crate) use trapezoid::Trapezoid;
pub(crate) use triangle::AnyTriangle;
pub use triangle::{area, triangle, Triangle};

/// The guard band: 3D geometry is cut at this many pixels from the target's origin.
pub const GUARD_BAND: i32 = 8192;

/// A point on the screen in 24.8: sub-pixels of 1/256 pixel, x right, y down, pixel (i, j) covers
/// [256·i, 256·i + 256) × [256·j, 256·j + 256). Inside the guard band, its border included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScreenPoint {
    pub(crate) x: i32,
    pub(crate) y: i32,
}

impl ScreenPoint {
    pub(crate) const ORIGIN: Self = Self { x: 0, y: 0 };

    /// The door for 2D work: 1/256 pixel, exact; `None` beyond ±8192 pixels.
    pub const fn from_subpixels(x: i32, y: i32) -> Option<Self> {
        const LIMIT: i32 = GUARD_BAND * 256;
        // Negative where one of these is, and where one wraps.
        let room =
            x.wrapping_add(LIMIT) | LIMIT.wrapping_sub(x) | y.wrapping_add(LIMIT) | LIMIT.wrapping_sub(y);
        if room < 0 {
            return None;
        }
        Some(Self { x, y })
    }

    /// Saturates at the guard band.
    pub(crate) fn clamped(x: i32, y: i32) -> Self {
        const LIMIT: i32 = GUARD_BAND * 256;
        Self { x: x.clamp(-LIMIT, LIMIT), y: y.clamp(-LIMIT, LIMIT) }
    }

    /// For callers that have shown the point to lie in the guard band: see `VertexTransform::project`.
    #[inline(always)]
    pub(crate) fn inside(x: i32, y: i32) -> Self {
        debug_assert!(Self::from_subpixels(x, y).is_some(), "({x}, {y})");
        Self { x, y }
    }

    /// In 1/256 pixel, to the right.
    pub const fn x(self) -> i32 {
        self.x
    }

    /// In 1/256 pixel, downwards.
    pub const fn y(self) -> i32 {
        self.y
    }

    /// The pixel that the point lies in: (⌊x⌋, ⌊y⌋).
    pub const fn pixel(self) -> Pixel {
        // ±2²¹ / 256 fits 16 bits.
        Pixel { x: (self.x >> 8) as i16, y: (self.y >> 8) as i16 }
    }
}

/// The pixel where a line ends: −32768 … 32767.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pixel {
    /// The column.
    pub x: i16,
    /// The row.
    pub y: i16,
}

/// The pixels that may be written: columns `left` to `right`, rows `top` to `bottom`, ends excluded. Empty where
/// an end is not beyond its beginning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Scissor {
    pub(crate) left: i32,
    pub(crate) top: i32,
    pub(crate) right: i32,
    pub(crate) bottom: i32,
}

impl Scissor {
    /// DrawRegion in pixels, clamped to ±32768: nothing is drawn beyond.
    pub fn new(left: i32, top: i32, right: i32, bottom: i32) -> Self {
        Self { left, top, right, bottom }.near()
    }

    /// DrawRegion brought where drawing can reach.
    pub(crate) fn near(&self) -> Self {
        let near = |v: i32| v.clamp(-32_768, 32_768);
        Self {
            left: near(self.left),
            top: near(self.top),
            right: near(self.right),
            bottom: near(self.bottom),
        }
    }

    /// DrawRegion as they are: inside the guard band, or to be intersected with what is.
    #[inline(always)]
    pub(crate) const fn as_given(left: i32, top: i32, right: i32, bottom: i32) -> Self {
        Self { left, top, right, bottom }
    }

    /// All that 3D geometry reaches: the viewport of what has none.
    pub(crate) const GUARD_BAND: Self =
        Self { left: -GUARD_BAND, top: -GUARD_BAND, right: GUARD_BAND, bottom: GUARD_BAND };

    pub(crate) const EMPTY: Self = Self { left: 0, top: 0, right: 0, bottom: 0 };

    /// The pixels whose centres lie in the bounding box of a triangle: it covers no others.
    #[inline(always)]
    pub(crate) fn of([a, b, c]: &[ScreenPoint; 3]) -> Self {
        let first = |p: i32| (p + 127) >> 8; // ⌈p − ½⌉
        Self {
            left: first(a.x.min(b.x).min(c.x)),
            top: first(a.y.min(b.y).min(c.y)),
            right: first(a.x.max(b.x).max(c.x)),
            bottom: first(a.y.max(b.y).max(c.y)),
        }
    }

    /// Encloses nothing, and with anything just that.
    pub(crate) const NOTHING: Self =
        Self { left: i32::MAX, top: i32::MAX, right: i32::MIN, bottom: i32::MIN };

    /// The bounding box of both, of [`NOTHING`](Self::NOTHING) and another that one. An empty box counts with where it is.
    #[inline(always)]
    pub(crate) fn enclosing(&self, other: &Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// Whether there is no pixel inside.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }

    /// From the first to the one after the last.
    #[inline(always)]
    pub(crate) fn rows(&self) -> core::ops::Range<i32> {
        self.top..self.bottom
    }

    /// From the first to the one after the last.
    pub(crate) fn columns(&self) -> core::ops::Range<i32> {
        self.left..self.right
    }

    /// What lies in both, of which the other is inside the guard band: so is that, however far this one reaches.
    pub(crate) fn within(&self, other: &Self) -> Self {
        let both = self.and(other);
        if both.is_empty() {
            Self::EMPTY
        } else {
            both
        }
    }

    /// What lies in both.
    #[inline(always)]
    pub(crate) fn and(&self, other: &Self) -> Self {
        Self {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.min(other.right),
            bottom: self.bottom.min(other.bottom),
        }
    }
}

/// A run of pixels: `width` to the right of and including `x`, or `height` downwards from and
/// including `y`. One of the two is 1, neither is less.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Span {
    /// The leftmost column.
    pub x: i32,
    /// The topmost row.
    pub y: i32,
    /// Columns.
    pub width: i32,
    /// Rows.
    pub height: i32,
}
