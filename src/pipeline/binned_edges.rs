//! Edges that are binned once per frame and drawn band by band.

use super::anti_aliased::{self, beyond, BEYOND, BEYOND_BY_TABLE};
use super::binned::{Binned, DrawnWith};
use super::bins::{each_active, BinStorage};
use super::draw_region::{pixels, DrawRegion};
use super::drawable::StrokeFor;
use super::fill::line_in_band;
use super::hidden_line::draw_nearer;
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::camera::UnpackedVertex;
use crate::color::Access;
use crate::math::hints::keep_rolled;
use crate::math::Coordinate;
use crate::raster::Scissor;
use crate::shading::StrokeKind;
use crate::surface::{BufferError, DepthBuffer, Surface, Target, Tested, Unmatched, Untested, WithDepth};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;

/// The visible edges of a mesh, binned by their first rows: each band draws only the edges that lie in it.
/// [`TransformedMesh::bin_edges`] makes it and has an example.
#[derive(Debug)]
pub struct BinnedEdges<'a, V: Coordinate = i16, const DEPTH: bool = true>(Binned<'a, V, DEPTH>);

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Puts the visible edges into bins of rows, for drawing in bands. `storage` is bin storage that the result borrows:
    /// [`edge_bins_len`](crate::Mesh::edge_bins_len) numbers.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?.with_edges(&[[0, 1], [1, 2], [2, 0]])?;
    /// let mut display = MockDisplay::<Gray8>::new();
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 3], [0; 5]); // `mesh.vertices().len()`, `mesh.edge_bins_len()`
    /// let mut edges = instance.transform(&mut cache).bin_edges(&mut bins)?;
    /// let mut frame = Frame::new(display.bounding_box(), Gray8::BLACK);
    /// while let Some(mut band) = frame.next_band(&mut strip)? {
    ///     edges.draw(Gray8::WHITE, &mut band.pixels())?;
    ///     band.send(&mut display)?;
    /// }
    /// let at: Point = instance.project(0)?.into();
    /// assert_eq!((edges.statistics().drawn, display.get_pixel(at)), (3, Some(Gray8::WHITE)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`BufferError::Bins`] if `storage` is too short; the error says how many numbers are needed. [`BufferError::TooManyItems`] if
    /// the mesh has more than 65535 edges. Nothing is binned then.
    #[inline(never)] // the result is large: inlined, a second copy would stay on the stack while edges are drawn
    pub fn bin_edges(&self, storage: &'a mut [u16]) -> Result<BinnedEdges<'a, V, DEPTH>, BufferError> {
        let edges = self.instance.mesh().edges;
        let mut fill = BinStorage::new(storage, edges.len(), 1)?.fill(pixels(self.instance.area()));
        let mut statistics = Statistics::NONE;
        for (index, &edge) in edges.iter().enumerate() {
            let Some(ends) = self.edge_out_of_line(edge, &mut statistics) else { continue };
            let mut bounds = bounds(&ends);
            // A box outside the viewport is tried again, larger by the reach of an anti-aliased line, and of one by a table. `add` is
            // inlined once.
            for _ in 0..=BEYOND_BY_TABLE {
                keep_rolled();
                if fill.add(index, &bounds) {
                    break;
                }
                bounds = bounds.grown(1);
            }
        }
        let statistics = statistics.with_the_rest_drawn(edges.len());
        Ok(BinnedEdges(Binned { transformed: *self, bins: fill.bins(), statistics }))
    }
}

impl<V: Coordinate, const DEPTH: bool> TransformedMesh<'_, V, DEPTH> {
    /// [`edge`](Self::edge) as one shared copy, for callers whose code size matters more than their speed.
    #[inline(never)]
    pub(super) fn edge_out_of_line(
        &self,
        edge: [u16; 2],
        statistics: &mut Statistics,
    ) -> Option<[UnpackedVertex; 2]> {
        self.edge(edge, statistics)
    }
}

impl<V: Coordinate, const DEPTH: bool> BinnedEdges<'_, V, DEPTH> {
    /// Draws the edges in a band as [`Edges::draw`](crate::draw::Edges::draw) does, all with one stroke.
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn draw<T: Target, K: StrokeFor<T::Surface>>(
        &mut self,
        stroke: K,
        band: &mut T,
    ) -> Result<(), T::Error>
    where
        Self: DrawnWith<T::Test>,
    {
        band.dispatch(
            self,
            |edges, band| {
                let region = edges.advance_to_band::<K, T::Color>(&band.area(), None);
                edges.draw_lines(&region, stroke, band)
            },
            |edges, band, depth| {
                let region = edges.advance_to_band::<K, T::Color>(&band.area(), Some(depth));
                edges.draw_depth_tested(&region, stroke, depth, band)
            },
        )
    }

    #[inline(never)] // its stack frame does not exist while the bins advance
    fn draw_lines<T: Surface, K: StrokeFor<T>>(
        &mut self,
        region: &DrawRegion,
        stroke: K,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each::<K, _, _>(region, |_, _, ends| {
            if <K::Access as Access>::READS {
                anti_aliased::edge(&ends, &region.viewport, &region.scissor, stroke, band);
                return Ok(());
            }
            let [from, to] = ends;
            line_in_band(band, from.point.pixel(), to.point.pixel(), &region.scissor, stroke.color())
        })
    }

    /// Splits the binned edges into two, one for each of two cores, as [`BinnedFaces::fork`](crate::draw::BinnedFaces::fork) splits
    /// faces. `cursor` is the second one's storage, one number per 16 edges of the mesh, rounded up.
    ///
    /// # Errors
    ///
    /// [`BufferError::Bins`] if `cursor` is too short; the error says how many numbers are needed.
    #[inline(never)] // the result is large
    pub fn fork<'b>(
        &'b mut self,
        cursor: &'b mut [u16],
    ) -> Result<[BinnedEdges<'b, V, DEPTH>; 2], BufferError> {
        Ok(self.0.fork(cursor)?.map(BinnedEdges))
    }

    /// Counts for the whole frame, whichever bands were drawn.
    pub const fn statistics(&self) -> Statistics {
        self.0.statistics
    }

    /// A rectangle inside the viewport around all visible edges: no pixel outside it is drawn. It is empty if no edge is
    /// visible. [`AntiAliased`](crate::shading::AntiAliased) lines may reach one pixel beyond it, and two with areas [from a
    /// table](crate::shading::AntiAliased::by_table).
    pub fn bounds(&self) -> Rectangle {
        self.0.bounds()
    }

    /// Activates the edges that begin in a band. Returns the part of the viewport that lies in the band, and in the depth
    /// buffer if there is one.
    #[inline(always)]
    fn advance_to_band<K: StrokeKind<C>, C: PixelColor>(
        &mut self,
        band: &Rectangle,
        depth: Option<&DepthBuffer<'_>>,
    ) -> DrawRegion {
        match beyond::<C, K>() {
            0 => self.advance::<0>(band, depth),
            BEYOND => self.advance::<BEYOND>(band, depth),
            _ => self.advance::<BEYOND_BY_TABLE>(band, depth),
        }
    }

    #[inline(never)] // one copy for all draw calls
    fn advance<const ROWS: i32>(&mut self, band: &Rectangle, depth: Option<&DepthBuffer<'_>>) -> DrawRegion {
        self.0.advance_to_band::<ROWS>(band, depth)
    }

    /// Calls `draw` for each edge that may lie in the band of the last [`advance_to_band`](Self::advance_to_band).
    #[inline(always)]
    fn each<K: StrokeKind<C>, C: PixelColor, E>(
        &mut self,
        region: &DrawRegion,
        mut draw: impl FnMut(&TransformedMesh<'_, V, DEPTH>, usize, [UnpackedVertex; 2]) -> Result<(), E>,
    ) -> Result<(), E> {
        if region.scissor.is_empty() {
            return Ok(()); // the bins did not advance to this band
        }
        let (edges, end) = (self.0.transformed.instance.mesh().edges, region.scissor.rows().end);
        let Binned { transformed, bins, .. } = &mut self.0;
        each_active(bins.active(), |index| {
            let edge = edges.get(index);
            let ends = edge.and_then(|&edge| transformed.edge_out_of_line(edge, &mut Statistics::default()));
            let Some(ends) = ends else { return Ok(true) };
            draw(transformed, index, ends)?;
            Ok(bounds(&ends).rows().end + beyond::<C, K>() <= end)
        })
    }
}

impl<V: Coordinate, const DEPTH: bool> BinnedEdges<'_, V, DEPTH> {
    /// Draws the edges in a band as [`Edges::hidden_line`](crate::draw::Edges::hidden_line) does.
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn hidden_line<T: WithDepth, K: StrokeFor<T::Surface>>(
        &mut self,
        stroke: K,
        band: &mut T,
    ) -> Result<(), T::Error>
    where
        Self: DrawnWith<Tested>,
    {
        band.dispatch(
            (self, stroke),
            |_, _| Ok(()), // never called
            |(edges, stroke), surface, depth| {
                let region = edges.advance_to_band::<K, T::Color>(&surface.area(), Some(depth));
                edges.draw_hidden_line(&region, stroke, depth, surface)
            },
        )
    }

    #[inline(never)] // its stack frame does not exist while the bins advance
    fn draw_depth_tested<T: Surface, K: StrokeFor<T>>(
        &mut self,
        region: &DrawRegion,
        stroke: K,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each::<K, _, _>(region, |_, _, ends| draw_nearer(&ends, stroke, region, depth, band))
    }

    #[inline(never)] // its stack frame does not exist while the bins advance
    fn draw_hidden_line<T: Surface, K: StrokeFor<T>>(
        &mut self,
        region: &DrawRegion,
        stroke: K,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each::<K, _, _>(region, |mesh, edge, ends| {
            mesh.draw_hidden_line(edge, &ends, stroke, region, depth, band)
        })
    }
}

impl<V: Coordinate, Test> DrawnWith<Test> for BinnedEdges<'_, V, true> {}
impl<V: Coordinate> DrawnWith<Untested> for BinnedEdges<'_, V, false> {}
impl<V: Coordinate> DrawnWith<Unmatched> for BinnedEdges<'_, V, false> {}

defmt_format!(
    [V: Coordinate, const DEPTH: bool] BinnedEdges<'_, V, DEPTH>, self,
    "edges within {}: {}", self.0.bins.bounds(), self.0.statistics
);

/// The bounding box of the pixels of a line of one colour.
#[inline(always)]
fn bounds([from, to]: &[UnpackedVertex; 2]) -> Scissor {
    let (from, to) = (from.point.pixel(), to.point.pixel());
    let (left, right) = (from.x.min(to.x), from.x.max(to.x));
    let (top, bottom) = (from.y.min(to.y), from.y.max(to.y));
    Scissor::unclamped(left.into(), top.into(), i32::from(right) + 1, i32::from(bottom) + 1)
}
