//! From spans to an `embedded-graphics` DrawTarget.

use crate::raster::{Scissor, Span};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// The pixels that lie in the target and in `area`.
pub(crate) fn scissor(target: &impl Dimensions, area: &Rectangle) -> Scissor {
    let ends = |low: i32, extent: u32| (i64::from(low), i64::from(low) + i64::from(extent));
    let overlap = |(low, high): (i64, i64), (a_low, a_high): (i64, i64)| {
        // The area lies in the guard band, so what is left of it does.
        (low.clamp(a_low, a_high) as i32, high.clamp(a_low, a_high) as i32)
    };
    let bounds = target.bounding_box();
    let (left, right) =
        overlap(ends(bounds.top_left.x, bounds.size.width), ends(area.top_left.x, area.size.width));
    let (top, bottom) =
        overlap(ends(bounds.top_left.y, bounds.size.height), ends(area.top_left.y, area.size.height));
    Scissor::new(left, top, right, bottom)
}

/// Sends one run of pixels to the target.
#[inline]
pub(crate) fn send<D: DrawTarget>(target: &mut D, span: Span, colour: D::Color) -> Result<(), D::Error> {
    // Width and height are positive.
    let size = Size::new(span.width.unsigned_abs(), span.height.unsigned_abs());
    target.fill_solid(&Rectangle::new(Point::new(span.x, span.y), size), colour)
}
