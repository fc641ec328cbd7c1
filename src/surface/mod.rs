//! From spans to pixels: an `embedded-graphics` DrawTarget, or memory.

mod band;
mod depth;
mod dirty_regions;
pub(crate) mod memory;
mod picture;
mod pixel_format;
mod pixels;
mod target;

pub(crate) use crate::fast::table_fill::{Shade, Shades};
pub use band::{Band, BandError, Frame};
pub(crate) use depth::DepthTarget;
pub use depth::{DepthBuffer, DepthBufferError};
pub use dirty_regions::{DirtyRegions, TransferCost};
pub use picture::{Picture, PictureError};
pub use pixel_format::PixelFormat;
pub use pixels::{Pixels, StoredPixel};
pub use target::Target;

use crate::raster::Scissor;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// The pixels of a target as far as anything is drawn, however large it is.
pub(crate) fn reach(area: &Rectangle) -> Scissor {
    inside(area).clamped()
}

/// As `embedded-graphics` has it.
pub(crate) fn rectangle(area: &Scissor) -> Rectangle {
    let (columns, rows) = (area.columns(), area.rows());
    // At most 2¹⁶ each way.
    let size = Size::new(columns.len() as u32, rows.len() as u32);
    Rectangle::new(Point::new(columns.start, rows.start), size)
}

/// The pixels of a rectangle, to be intersected with a viewport, or brought [near](Scissor::near).
pub(crate) fn inside(area: &Rectangle) -> Scissor {
    let Rectangle { top_left: Point { x, y }, size } = *area;
    let (right, bottom) = (x.saturating_add_unsigned(size.width), y.saturating_add_unsigned(size.height));
    Scissor::unclamped(x, y, right, bottom)
}
