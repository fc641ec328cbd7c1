//! A depth buffer beside the memory of a surface.

use super::target::Surface;
use super::DepthBuffer;
use embedded_graphics_core::primitives::Rectangle;

/// A depth buffer, and whether its rows are laid out like those of the target's memory.
#[derive(Debug)]
pub(crate) struct DepthTarget<'d, 'b> {
    pub(crate) buffer: &'d mut DepthBuffer<'b>,
    /// Whether a pixel has the same index in the depth buffer as in the target's memory: the two begin with the same pixel and
    /// have rows of the same width. Either may have more rows.
    pub(crate) is_aligned: bool,
}

impl<'d, 'b> DepthTarget<'d, 'b> {
    /// Compares the layouts of depth buffer and target: once per draw call, not for each triangle.
    #[inline(always)]
    pub(crate) fn new<T: Surface>(buffer: &'d mut DepthBuffer<'b>, target: &mut T) -> Self {
        let Rectangle { top_left, size } = buffer.area();
        let pixels = target.memory().map(|memory| memory.area());
        let is_aligned = pixels.is_some_and(|own| own.top_left == top_left && own.size.width == size.width);
        Self { buffer, is_aligned }
    }
}
