//! Targets: any `embedded-graphics` DrawTarget, or pixels in memory. Also the depth buffer, frames drawn in bands, and dirty
//! regions: the rectangles that a new frame has to send.

mod band;
pub(crate) mod block_fill;
mod buffer_error;
mod depth;
mod dirty_regions;
mod kept_runs;
mod least_run;
mod memory;
mod picture;
mod pixels;
mod row;
mod smooth_frame;
mod smoothing;
mod strip;
mod target;

pub use band::{Band, Frame};
pub use buffer_error::BufferError;
pub use depth::DepthBuffer;
pub use dirty_regions::{DirtyRegions, Tracked, TransferCost};
pub(crate) use kept_runs::each_run;
pub use least_run::LeastRun;
pub use memory::Memory;
pub(crate) use memory::PixelRows;
pub(crate) use memory::{Gives, PixelStore};
pub use picture::Picture;
pub use pixels::Pixels;
pub use smooth_frame::{SmoothBand, SmoothFrame};
pub use smoothing::SmoothPass;
pub(crate) use smoothing::{Seen, SeenKind};
pub use strip::StripBuffers;
pub(crate) use target::{draw_run, put, DepthTarget, Tested, Unmatched, Untested, WithDepth};
pub use target::{DepthTestedSurface, Surface, Target};

use crate::raster::Scissor;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// The part of a target's area in the range of 2D drawing: pixels with 16-bit coordinates.
pub(crate) fn drawable(area: &Rectangle) -> Scissor {
    inside(area).clamped()
}

/// A scissor, at most 2¹⁶ pixels each way, as a rectangle of `embedded-graphics`.
pub(crate) fn rectangle(area: &Scissor) -> Rectangle {
    let (columns, rows) = (area.columns(), area.rows());
    let size = Size::new(columns.len() as u32, rows.len() as u32);
    Rectangle::new(Point::new(columns.start, rows.start), size)
}

/// A rectangle as a scissor, with bounds of any size: callers intersect it with a viewport, or take its [`drawable`] part.
pub(crate) fn inside(area: &Rectangle) -> Scissor {
    let Rectangle { top_left: Point { x, y }, size } = *area;
    let (right, bottom) = (x.saturating_add_unsigned(size.width), y.saturating_add_unsigned(size.height));
    Scissor::unclamped(x, y, right, bottom)
}
