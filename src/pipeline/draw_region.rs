//! Which pixels a draw call may write.

use crate::raster::Scissor;
use crate::surface::{inside, DepthBuffer, Target};
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::primitives::Rectangle;

/// The pixels that a draw call may write, and the viewport that gradients are referred to.
pub(super) struct DrawRegion {
    /// The viewport's pixels that the target has, and the depth buffer if there is one.
    pub(super) scissor: Scissor,
    /// All pixels of the viewport: the same for every band, so that every band computes the same gradients.
    pub(super) viewport: Scissor,
}

/// The pixels of a viewport. It lies inside the guard band, so no sum overflows.
pub(super) fn pixels(viewport: &Rectangle) -> Scissor {
    let Rectangle { top_left: Point { x, y }, size } = *viewport;
    Scissor::unclamped(x, y, x.wrapping_add_unsigned(size.width), y.wrapping_add_unsigned(size.height))
}

impl DrawRegion {
    /// The part of a viewport that lies in a target.
    #[inline(always)]
    pub(super) fn new(target: &impl Target, viewport: &Rectangle) -> Self {
        Self::of(&target.area(), viewport)
    }

    /// The part of a viewport that lies in a target with these pixels.
    #[inline(always)]
    fn of(target: &Rectangle, viewport: &Rectangle) -> Self {
        let viewport = pixels(viewport);
        Self { scissor: inside(target).clipped_to(&viewport), viewport }
    }

    /// The part of the region that lies in a depth buffer.
    pub(super) fn with_depth(self, depth: &DepthBuffer<'_>) -> Self {
        Self { scissor: depth.scissor().clipped_to(&self.scissor), ..self }
    }

    /// [`new`](Self::new) out of line, for draw calls that a firmware uses several of: bands, painter's order, lines
    /// against depth.
    #[inline(never)]
    pub(super) fn shared(target: &Rectangle, viewport: &Rectangle, depth: Option<&DepthBuffer<'_>>) -> Self {
        let region = Self::of(target, viewport);
        match depth {
            Some(depth) => region.with_depth(depth),
            None => region,
        }
    }
}
