//! Primitives of a mesh, faces or edges, that are binned once and drawn band by band.

use super::bins::Bins;
use super::draw_region::DrawRegion;
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::math::Coordinate;
use crate::shading::Shader;
use crate::surface::BufferError;
use crate::surface::{rectangle, DepthBuffer};
use embedded_graphics_core::primitives::Rectangle;

/// A transformed mesh, or its binned faces or edges, that can be drawn into a target with this [test](crate::target::Target::Test): with a depth buffer,
/// only vertices with depth. Draw calls and `bin_smooth_edges` have this bound, so that the compiler names the missing depth.
#[diagnostic::on_unimplemented(
    message = "a depth buffer needs vertices with depth, and these were transformed without it",
    label = "vertices without depth",
    note = "call `transform_depth` instead of `transform` before the faces or edges are binned"
)]
pub trait DrawnWith<Test> {}

/// Stops the build where a shader needs depth and the binned vertices have none: for a `const` block of a draw call.
pub(super) const fn assert_depth<S: Shader, const DEPTH: bool>() {
    assert!(DEPTH || !S::NEEDS_DEPTH, "this shader needs depth: bin faces of `transform_depth`")
}

/// The visible primitives of a mesh, binned by their first rows, and the vertices that they are drawn from.
#[derive(Debug)]
pub(super) struct Binned<'a, V: Coordinate, const DEPTH: bool> {
    pub(super) transformed: TransformedMesh<'a, V, DEPTH>,
    pub(super) bins: Bins<'a>,
    pub(super) statistics: Statistics,
}

impl<V: Coordinate, const DEPTH: bool> Binned<'_, V, DEPTH> {
    /// Two sets of the same primitives, each for bands of its own; `cursor` is the second one's storage.
    #[inline(always)]
    pub(super) fn fork<'b>(
        &'b mut self,
        cursor: &'b mut [u16],
    ) -> Result<[Binned<'b, V, DEPTH>; 2], BufferError> {
        let Self { transformed, ref mut bins, statistics } = *self;
        let forks = bins.fork(cursor)?;
        Ok(forks.map(|bins| Binned { transformed, bins, statistics }))
    }

    /// A rectangle around the pixels of all primitives; empty if there are none.
    pub(super) fn bounds(&self) -> Rectangle {
        rectangle(&self.bins.bounds())
    }

    /// Activates the primitives that begin in a band, or up to `BEYOND` rows below it. Returns the part of the viewport that lies
    /// in the band, and in the depth buffer if there is one.
    #[inline(always)]
    pub(super) fn advance_to_band<const BEYOND: i32>(
        &mut self,
        band: &Rectangle,
        depth: Option<&DepthBuffer<'_>>,
    ) -> DrawRegion {
        let Self { transformed, bins, .. } = self;
        let region = DrawRegion::shared(band, transformed.instance.area(), depth);
        let rows = region.scissor.rows();
        if BEYOND == 0 {
            bins.advance_to_band(&rows);
        } else {
            bins.advance_beyond::<BEYOND>(&rows);
        }
        region
    }
}
