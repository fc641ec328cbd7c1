//! Edges that are binned once a frame and drawn band by band.

use super::binned::Binned;
use super::bins::{BinError, Bins};
use super::draw_region::DrawRegion;
use super::fill::line;
use super::hidden_line::draw_nearer;
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::camera::UnpackedVertex;
use crate::math::Coordinate;
use crate::raster::Scissor;
use crate::surface::{DepthBuffer, Target};
use embedded_graphics_core::primitives::Rectangle;

/// The visible edges of a mesh, binned by the rows in which they begin, to be drawn band by band: see
/// [`TransformedMesh::bin_edges`]. They are drawn like the faces of the example at
/// [`MeshInstance::transform`](crate::MeshInstance::transform).
#[derive(Debug)]
pub struct BinnedEdges<'a, V = i16, const DEPTH: bool = false>(Binned<'a, V, DEPTH>);

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Sorts the visible edges by their first row. `records` is scratch for the frame: one number per visible
    /// edge, and one per 16 edges of the mesh, rounded up.
    ///
    /// ```
    /// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// # use pinhole::{Affine, Angle, Camera, ScreenVertex, Frame, Mesh, Painter, Point3, Projection, Scalar, Vector3, ViewTransform, Viewport};
    /// # let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?.with_edges(&[[0, 1], [1, 2], [2, 0]])?;
    /// # let mut display = MockDisplay::<Gray8>::new();
    /// # let viewport = Viewport::new(Point::zero(), display.size())?;
    /// # let view = ViewTransform::look_at(Point3::from_ints(0, 0, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?;
    /// # let [near, far] = [1, 9].map(Scalar::from_num);
    /// # let lens = Projection::perspective(Angle::degrees(40), viewport.size(), near, far)?;
    /// # let camera = Camera::new(&view, &lens, &viewport);
    /// # let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
    /// let placed = camera.place(&mesh, &Affine::identity());
    /// let (mut corners, mut records) = ([ScreenVertex::EMPTY; 3], [0; 3 + 1]);
    /// let mut edges = placed.transform(&mut corners).bin_edges(&mut records)?;
    /// let mut frame = Frame::new(display.bounding_box(), Gray8::BLACK);
    /// while let Some(mut band) = frame.next_band(&mut strip)? {
    ///     edges.draw(Gray8::WHITE, &mut band.pixels())?;
    ///     band.send(&mut display)?;
    /// }
    /// let (corner, _) = placed.project(0).ok_or("out of sight")?;
    /// let at = Point::new(corner.pixel().x.into(), corner.pixel().y.into());
    /// assert_eq!((edges.statistics().drawn, display.get_pixel(at)), (3, Some(Gray8::WHITE)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`BinError::Storage`] when the records are too short, and says how many are needed, and
    /// [`BinError::TooMany`] beyond 65535 edges; nothing is recorded then.
    #[inline(never)] // the result is large: inlined, it would stand on the stack once more while edges are drawn
    pub fn bin_edges(&self, records: &'a mut [u16]) -> Result<BinnedEdges<'a, V, DEPTH>, BinError> {
        let mut edges = BinnedEdges(Binned::new(*self, records, self.instance.mesh.edges().len()));
        edges.0.statistics = self.fill_edge_bins(&mut edges.0.bins)?;
        Ok(edges)
    }

    /// Counts all edges, and then sorts those that are drawn.
    #[inline(never)] // the lists of the sort are gone when it returns
    fn fill_edge_bins(&self, bins: &mut Bins<'_>) -> Result<Statistics, BinError> {
        let (edges, mut statistics) = (self.instance.mesh.edges(), Statistics::NONE);
        let mut sort = bins.sort();
        for (index, &edge) in edges.iter().enumerate() {
            let ends = self.edge_out_of_line(edge, &mut statistics);
            sort.put(index, &ends.map_or(Scissor::EMPTY, |ends| reach(&ends)));
        }
        sort.finish(edges.len(), |index| self.first_row_of_edge(index))?;
        Ok(statistics.with_the_rest_drawn(edges.len()))
    }

    /// [`edge`](Self::edge) where small is better than fast.
    #[inline(never)]
    fn edge_out_of_line(&self, edge: [u16; 2], statistics: &mut Statistics) -> Option<[UnpackedVertex; 2]> {
        self.edge(edge, statistics)
    }

    /// The first row of an edge that was binned.
    #[inline(never)] // one copy for two callers
    fn first_row_of_edge(&self, index: usize) -> i32 {
        let edge = self.instance.mesh.edges().get(index);
        let ends = edge.and_then(|&edge| self.edge_out_of_line(edge, &mut Statistics::default()));
        ends.map_or(0, |ends| reach(&ends).rows().start)
    }
}

/// The rows and columns in which a line may cover pixels.
#[inline(always)]
fn reach([from, to]: &[UnpackedVertex; 2]) -> Scissor {
    let (from, to) = (from.point.pixel(), to.point.pixel());
    let (left, right) = (from.x.min(to.x), from.x.max(to.x));
    let (top, bottom) = (from.y.min(to.y), from.y.max(to.y));
    Scissor::new(left.into(), top.into(), i32::from(right) + 1, i32::from(bottom) + 1)
}

impl<V: Coordinate, const DEPTH: bool> BinnedEdges<'_, V, DEPTH> {
    /// Draws the edges in a band: see [`MeshInstance::wireframe`](crate::MeshInstance::wireframe).
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(always)]
    pub fn draw<T: Target>(&mut self, colour: T::Color, band: &mut T) -> Result<(), T::Error> {
        let region = self.advance_to_band(&band.area(), None);
        self.draw_lines(&region, colour, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while the bins advance
    fn draw_lines<T: Target>(
        &mut self,
        region: &DrawRegion,
        colour: T::Color,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each(region, |_, _, [from, to]| {
            line(band, from.point.pixel(), to.point.pixel(), &region.scissor, colour)
        })
    }

    /// Counts for the whole frame, whichever bands were drawn.
    pub const fn statistics(&self) -> Statistics {
        self.0.statistics
    }

    /// A rectangle of the viewport around all edges that are drawn: no pixel outside it is drawn. It has no pixels where no
    /// edge is drawn.
    pub fn bounds(&self) -> Rectangle {
        self.0.bounds()
    }

    /// Takes in the edges that begin in a band. Returns the part of the viewport that lies in the band, and in the depth
    /// buffer if there is one.
    #[inline(never)] // one copy for all draw calls
    fn advance_to_band(&mut self, band: &Rectangle, depth: Option<&DepthBuffer<'_>>) -> DrawRegion {
        self.0.advance_to_band(band, depth, TransformedMesh::first_row_of_edge)
    }

    /// Passes on the edges that may meet the band of the last [`advance_to_band`](Self::advance_to_band).
    #[inline(always)]
    fn each<E>(
        &mut self,
        region: &DrawRegion,
        mut draw: impl FnMut(&TransformedMesh<'_, V, DEPTH>, usize, [UnpackedVertex; 2]) -> Result<(), E>,
    ) -> Result<(), E> {
        if region.scissor.is_empty() {
            return Ok(()); // the bins stand at another band
        }
        let (edges, end) = (self.0.transformed.instance.mesh.edges(), region.scissor.rows().end);
        let Binned { transformed, bins, .. } = &mut self.0;
        bins.band(|index| {
            let edge = edges.get(index);
            let ends = edge.and_then(|&edge| transformed.edge_out_of_line(edge, &mut Statistics::default()));
            let Some(ends) = ends else { return Ok(true) };
            draw(transformed, index, ends)?;
            Ok(reach(&ends).rows().end <= end)
        })
    }
}

impl<V: Coordinate> BinnedEdges<'_, V, true> {
    /// Draws the edges in a band as [`MeshInstance::wireframe_depth_tested`](crate::MeshInstance::wireframe_depth_tested) does.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(always)]
    pub fn depth_tested<T: Target>(
        &mut self,
        colour: T::Color,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let region = self.advance_to_band(&band.area(), Some(depth));
        self.draw_depth_tested(&region, colour, depth, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while the bins advance
    fn draw_depth_tested<T: Target>(
        &mut self,
        region: &DrawRegion,
        colour: T::Color,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each(region, |_, _, ends| draw_nearer(&ends, colour, &region.scissor, depth, band))
    }

    /// Draws the edges in a band as [`MeshInstance::hidden_line`](crate::MeshInstance::hidden_line) does.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(always)]
    pub fn hidden_line<T: Target>(
        &mut self,
        colour: T::Color,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let region = self.advance_to_band(&band.area(), Some(depth));
        self.draw_unhidden(&region, colour, depth, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while the bins advance
    fn draw_unhidden<T: Target>(
        &mut self,
        region: &DrawRegion,
        colour: T::Color,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each(region, |mesh, edge, ends| mesh.draw_unhidden(edge, &ends, colour, region, depth, band))
    }
}

#[cfg(feature = "defmt")]
impl<V, const DEPTH: bool> defmt::Format for BinnedEdges<'_, V, DEPTH> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Self(Binned { bins, statistics, .. }) = self;
        defmt::write!(f, "edges within {}: {}", bins.bounds(), statistics);
    }
}
