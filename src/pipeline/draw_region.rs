//! The draw region: which pixels a draw call may write.

use crate::raster::Scissor;
use crate::surface::{inside, DepthBuffer, Surface};
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::primitives::Rectangle;

/// The pixels that a draw call may write, and the viewport in which gradients are set up.
pub(super) struct DrawRegion {
    /// The pixels that lie in the viewport, in the target, and in the depth buffer if there is one.
    pub(super) scissor: Scissor,
    /// All pixels of the viewport, whichever band is drawn: so gradients are equal in all bands.
    pub(super) viewport: Scissor,
}

/// The pixels of a viewport, which lies inside the guard band: no sum overflows.
pub(super) fn pixels(viewport: &Rectangle) -> Scissor {
    let Rectangle { top_left: Point { x, y }, size } = *viewport;
    Scissor::unclamped(x, y, x.wrapping_add_unsigned(size.width), y.wrapping_add_unsigned(size.height))
}

impl DrawRegion {
    /// The part of a viewport that lies in a target.
    #[inline(always)]
    pub(super) fn new(target: &impl Surface, viewport: &Rectangle) -> Self {
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

    /// [`new`](Self::new) out of line, one copy for the draw calls of which a firmware may use several: bands, painter's order,
    /// depth-tested lines.
    #[inline(never)]
    pub(super) fn shared(target: &Rectangle, viewport: &Rectangle, depth: Option<&DepthBuffer<'_>>) -> Self {
        let region = Self::of(target, viewport);
        match depth {
            Some(depth) => region.with_depth(depth),
            None => region,
        }
    }
}
