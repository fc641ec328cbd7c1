//! From spans to an `embedded-graphics` DrawTarget.

mod band;
mod depth;
mod dirty;
mod wire;

pub use band::{Band, BandError, Frame};
pub use depth::{DepthBuffer, DepthBufferError};
pub use dirty::{Dirty, WindowCost};
pub use wire::Wire;

use crate::raster::{Scissor, Span};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// The pixels that lie in the target and in `area`.
pub(crate) fn scissor(target: &impl Dimensions, area: &Rectangle) -> Scissor {
    inside(&target.bounding_box()).within(&inside(area))
}

/// As `embedded-graphics` has it.
pub(crate) fn rectangle(area: &Scissor) -> Rectangle {
    let (columns, rows) = (area.columns(), area.rows());
    // At most 2¹⁶ each way.
    let size = Size::new(columns.len() as u32, rows.len() as u32);
    Rectangle::new(Point::new(columns.start, rows.start), size)
}

/// The pixels of a rectangle: of a viewport, which lies inside the guard band, or to be intersected with one.
pub(crate) fn inside(area: &Rectangle) -> Scissor {
    let Rectangle { top_left: Point { x, y }, size } = *area;
    let (right, bottom) = (x.saturating_add_unsigned(size.width), y.saturating_add_unsigned(size.height));
    Scissor::as_given(x, y, right, bottom)
}

/// Sends one run of pixels to the target.
#[inline(always)]
pub(crate) fn send<D: DrawTarget>(target: &mut D, span: Span, colour: D::Color) -> Result<(), D::Error> {
    // Width and height are positive.
    let size = Size::new(span.width as u32, span.height as u32);
    target.fill_solid(&Rectangle::new(Point::new(span.x, span.y), size), colour)
}

/// Sends one run of pixels in a row, each with its own colour: `colours` is told how many.
#[inline(always)]
pub(crate) fn send_run<D: DrawTarget, C: Iterator<Item = D::Color>>(
    target: &mut D,
    span: Span,
    colours: impl FnOnce(u32) -> C,
) -> Result<(), D::Error> {
    let width = span.width as u32; // positive
    let area = Rectangle::new(Point::new(span.x, span.y), Size::new(width, 1));
    target.fill_contiguous(&area, colours(width))
}
