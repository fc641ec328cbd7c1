//! By how many quarters a picture is turned on its panel.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// How far a picture is turned on its panel, clockwise as one looks at the panel: where the picture's upper border lies.
/// [`Viewport::rotated`](crate::Viewport::rotated) has an example.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Rotation {
    /// At the panel's upper border, the first row of its memory.
    #[default]
    Deg0,
    /// At its right border.
    Deg90,
    /// At its lower border.
    Deg180,
    /// At its left border.
    Deg270,
}

impl Rotation {
    /// Whether the panel's x and y are the picture's y and x, and their signs, for axes whose y grows upwards.
    pub(super) const fn axes(self) -> (bool, [i32; 2]) {
        match self {
            Self::Deg0 => (false, [1, 1]),
            Self::Deg90 => (true, [1, -1]),
            Self::Deg180 => (false, [-1, -1]),
            Self::Deg270 => (true, [-1, 1]),
        }
    }

    /// The size of a picture from its size on the panel, or that on the panel from the picture's.
    pub(crate) const fn of_size(self, Size { width, height }: Size) -> Size {
        let (is_swapped, _) = self.axes();
        match is_swapped {
            true => Size::new(height, width),
            false => Size::new(width, height),
        }
    }

    /// The pixel or texel of a picture, turned: its place in the turned picture, which has this size. Wraps beyond 2³¹.
    #[inline(always)]
    pub(crate) const fn turn(self, Point { x, y }: Point, Size { width, height }: Size) -> Point {
        let (right, bottom) = ((width as i32).wrapping_sub(1), (height as i32).wrapping_sub(1));
        match self {
            Self::Deg0 => Point::new(x, y),
            Self::Deg90 => Point::new(right.wrapping_sub(y), x),
            Self::Deg180 => Point::new(right.wrapping_sub(x), bottom.wrapping_sub(y)),
            Self::Deg270 => Point::new(y, bottom.wrapping_sub(x)),
        }
    }

    /// The rotation that turns back.
    pub(crate) const fn inverse(self) -> Self {
        match self {
            Self::Deg90 => Self::Deg270,
            Self::Deg270 => Self::Deg90,
            _ => self,
        }
    }

    /// As [`turn`](Self::turn), of all pixels of a rectangle; an empty one stays empty.
    pub(crate) fn turn_rectangle(self, area: &Rectangle, size: Size) -> Rectangle {
        let Rectangle { top_left, size: Size { width, height } } = *area;
        let last = Point::new(
            top_left.x.wrapping_add_unsigned(width).wrapping_sub(1),
            top_left.y.wrapping_add_unsigned(height).wrapping_sub(1),
        );
        let [a, b] = [top_left, last].map(|corner| self.turn(corner, size));
        Rectangle::new(Point::new(a.x.min(b.x), a.y.min(b.y)), self.of_size(area.size))
    }
}
