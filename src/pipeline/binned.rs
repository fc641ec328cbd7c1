//! Items of a mesh, faces or edges, that are recorded once and met band by band.

use super::bins::Bins;
use super::{pixels, DrawRegion, Statistics, TransformedMesh};
use crate::surface::{rectangle, DepthBuffer};

use embedded_graphics_core::primitives::Rectangle;

/// Which items are seen, and by the rows where they begin; and what they are drawn from.
#[derive(Debug)]
pub(super) struct Binned<'a, V, const DEPTH: bool> {
    pub(super) transformed: TransformedMesh<'a, V, DEPTH>,
    pub(super) bins: Bins<'a>,
    pub(super) statistics: Statistics,
}

impl<'a, V, const DEPTH: bool> Binned<'a, V, DEPTH> {
    /// None of so many items yet.
    #[inline(always)]
    pub(super) fn new(
        transformed: TransformedMesh<'a, V, DEPTH>,
        records: &'a mut [u16],
        items: usize,
    ) -> Self {
        let bins = Bins::new(records, items, pixels(transformed.placed.area()));
        Self { transformed, bins, statistics: Statistics::default() }
    }

    /// A rectangle around all of their pixels; without pixels where there are none.
    pub(super) fn bounds(&self) -> Rectangle {
        rectangle(&self.bins.bounds())
    }

    /// What of the viewport lies in a band, and that of a depth buffer if there is one; takes in the items that begin there.
    #[inline(always)]
    pub(super) fn advance_to_band(
        &mut self,
        band: &Rectangle,
        depth: Option<&DepthBuffer<'_>>,
        first_row: impl Fn(&TransformedMesh<'a, V, DEPTH>, usize) -> i32,
    ) -> DrawRegion {
        let Self { transformed, bins, .. } = self;
        let limits = DrawRegion::shared(band, transformed.placed.area(), depth);
        bins.advance_to_band(&limits.scissor.rows(), |index| first_row(transformed, index));
        limits
    }

    /// Calls `draw` for the items that were [taken in](Self::advance_to_band) for these limits, in the mesh's order. It tells whether
    /// the item ends there: then no band below meets it.
    ///
    /// # Errors
    ///
    /// The first error of `draw`.
    #[inline(always)]
    pub(super) fn each<E>(
        &mut self,
        limits: &DrawRegion,
        mut draw: impl FnMut(&TransformedMesh<'a, V, DEPTH>, usize) -> Result<bool, E>,
    ) -> Result<(), E> {
        if limits.scissor.is_empty() {
            return Ok(()); // what is open is that of another band
        }
        let view = self.transformed;
        self.bins.band(|index| draw(&view, index))
    }
}
