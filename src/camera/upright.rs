//! A target in the coordinates of a turned picture.

use super::rotation::Rotation;
use super::viewport::Viewport;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

/// A DrawTarget in the coordinates of a [turned](Viewport::rotated) picture, for text and icons of embedded-graphics: (0, 0) is the pixel at
/// the picture's upper left corner, as its viewer sees it. [`Viewport::upright`] makes it.
#[derive(Debug)]
pub struct Upright<'t, T> {
    target: &'t mut T,
    /// On the target.
    area: Rectangle,
    rotation: Rotation,
}

impl Viewport {
    /// A target, such as a band or a display, in the coordinates of the picture that this viewport shows, which may be [turned](Self::rotated).
    /// Its bounding box is the part of the picture that lies in the target.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// use embedded_graphics::primitives::{Line, PrimitiveStyle};
    /// use pinhole::{camera::Rotation, Viewport};
    /// let mut panel = MockDisplay::new();
    /// let viewport = Viewport::new(Point::zero(), Size::new(8, 4))?.rotated(Rotation::Deg90);
    /// // From the upper left corner of 4 × 8 pixels to the right, then down.
    /// let style = PrimitiveStyle::with_stroke(BinaryColor::On, 1);
    /// Line::new(Point::zero(), Point::new(3, 0)).into_styled(style).draw(&mut viewport.upright(&mut panel))?;
    /// Pixel(Point::new(3, 2), BinaryColor::Off).draw(&mut viewport.upright(&mut panel))?;
    /// panel.assert_pattern(&[
    ///     "       #", // the picture's upper border is at the right
    ///     "       #",
    ///     "       #",
    ///     "     . #",
    /// ]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub const fn upright<'t, T: DrawTarget>(&self, target: &'t mut T) -> Upright<'t, T> {
        Upright { target, area: self.area(), rotation: self.rotation() }
    }

    /// The pixel of the picture that lies at a pixel of the target: where a label of a [projected](crate::Camera::project) point goes, if it is
    /// drawn [upright](Self::upright). Wraps beyond 2³¹.
    ///
    /// ```
    /// use embedded_graphics::geometry::{Point, Size};
    /// use pinhole::{camera::Rotation, Viewport};
    /// let viewport = Viewport::new(Point::new(10, 20), Size::new(8, 4))?.rotated(Rotation::Deg90);
    /// assert_eq!(viewport.upright_point(Point::new(17, 20)), Point::new(0, 0)); // the panel's upper right corner
    ///
    /// // Back, by a viewport of the picture that is turned the other way: which pixels of the panel a text changes, for `Tracked`.
    /// use embedded_graphics::primitives::Rectangle;
    /// let back = Viewport::new(Point::zero(), viewport.size())?.rotated(Rotation::Deg270);
    /// let on_panel = |at| back.upright_point(at) + viewport.area().top_left;
    /// assert_eq!(on_panel(Point::new(0, 0)), Point::new(17, 20));
    /// let text = Rectangle::new(Point::new(1, 2), Size::new(3, 5)); // `bounding_box()`
    /// let changed = Rectangle::with_corners(on_panel(text.top_left), on_panel(text.top_left + text.size - Point::new(1, 1)));
    /// assert_eq!(changed, Rectangle::new(Point::new(11, 21), Size::new(5, 3)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub const fn upright_point(&self, at: Point) -> Point {
        let Rectangle { top_left: Point { x, y }, size } = self.area();
        let (at, rotation) = (Point::new(at.x.wrapping_sub(x), at.y.wrapping_sub(y)), self.rotation());
        rotation.inverse().turn(at, rotation.of_size(size))
    }
}

impl<T> Upright<'_, T> {
    fn to_target(&self, area: &Rectangle) -> Rectangle {
        let area = self.rotation.turn_rectangle(area, self.area.size);
        Rectangle::new(sum(area.top_left, self.area.top_left), area.size)
    }
}

/// Wraps, where an addition of points would panic.
const fn sum(a: Point, b: Point) -> Point {
    Point::new(a.x.wrapping_add(b.x), a.y.wrapping_add(b.y))
}

impl<T: DrawTarget> Dimensions for Upright<'_, T> {
    fn bounding_box(&self) -> Rectangle {
        // Bounds on the panel, relative to the viewport's corner; the viewport lies in the guard band.
        let along = |low: i32, length: u32, own: i32, extent: u32| {
            let end = low.saturating_add_unsigned(length).saturating_sub(own).min(extent as i32);
            let first = low.saturating_sub(own).max(0);
            (first, end.saturating_sub(first).max(0).unsigned_abs())
        };
        let Rectangle { top_left: Point { x, y }, size: Size { width, height } } = self.target.bounding_box();
        let Rectangle { top_left: own, size } = self.area;
        let (x, width) = along(x, width, own.x, size.width);
        let (y, height) = along(y, height, own.y, size.height);
        if width == 0 || height == 0 {
            return Rectangle::zero();
        }
        let on_panel = Rectangle::new(Point::new(x, y), Size::new(width, height));
        self.rotation.inverse().turn_rectangle(&on_panel, self.rotation.of_size(size))
    }
}

impl<T: DrawTarget> DrawTarget for Upright<'_, T> {
    type Color = T::Color;
    type Error = T::Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<T::Color>>>(&mut self, pixels: I) -> Result<(), T::Error> {
        let (rotation, Rectangle { top_left, size }) = (self.rotation, self.area);
        let turned = |Pixel(at, color)| Pixel(sum(rotation.turn(at, size), top_left), color);
        self.target.draw_iter(pixels.into_iter().map(turned))
    }

    fn fill_solid(&mut self, area: &Rectangle, color: T::Color) -> Result<(), T::Error> {
        let area = self.to_target(area);
        self.target.fill_solid(&area, color)
    }
}

defmt_format!([T] Upright<'_, T>, self, "turned by {}", self.rotation);
