//! BinnedFaces and edges recorded once, and drawn band by band.

use super::bins::{BinError, Bins, Sorting};
use super::{
    fill, fill_nearer, pixels, put, Binned, DrawRegion, Fan, Outcome, PlaneCulled, Polygon, Progress, Shader,
    SpanShader, Statistics, TransformedMesh,
};
use crate::camera::{ScreenVertex, UnpackedVertex};
use crate::clip::CLIP_SLOTS;
use crate::math::Coordinate;
use crate::raster::{DepthTriangle, Scissor};
use crate::surface::{DepthBuffer, Target};

use embedded_graphics_core::primitives::Rectangle;

/// The visible faces of a mesh, recorded once, to be drawn band by band, or into any part of the picture: see
/// [`TransformedMesh::bin_faces`]; [`MeshInstance::transform`](crate::MeshInstance::transform) has an example.
#[derive(Debug)]
pub struct BinnedFaces<'a, V = i16, const DEPTH: bool = false>(Binned<'a, V, DEPTH>);

/// The visible edges of a mesh, ready to be drawn band by band: see [`TransformedMesh::bin_edges`]; they are
/// drawn like the faces of the example at [`MeshInstance::transform`](crate::MeshInstance::transform).
#[derive(Debug)]
pub struct BinnedEdges<'a, V = i16, const DEPTH: bool = false>(Binned<'a, V, DEPTH>);

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Culls the faces and sorts the visible ones by their first row. `records` is scratch for the frame: one
    /// number per visible face, and one per 16 faces of the mesh, rounded up.
    ///
    /// # Errors
    ///
    /// [`BinError::Storage`] when the records are too short, and says how many are needed, and
    /// [`BinError::TooMany`] beyond 65535 faces; nothing is recorded then.
    #[inline(never)] // what it makes is large: inlined it would stand there once more while faces are drawn
    pub fn bin_faces(&self, records: &'a mut [u16]) -> Result<BinnedFaces<'a, V, DEPTH>, BinError> {
        let mut faces = BinnedFaces(Binned::new(*self, records, self.placed.mesh.faces().len()));
        self.record_faces(&mut faces.0)?;
        Ok(faces)
    }

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
    #[inline(never)] // what it makes is large: inlined it would stand there once more while edges are drawn
    pub fn bin_edges(&self, records: &'a mut [u16]) -> Result<BinnedEdges<'a, V, DEPTH>, BinError> {
        let mut edges = BinnedEdges(Binned::new(*self, records, self.placed.mesh.edges().len()));
        self.record_edges(&mut edges.0)?;
        Ok(edges)
    }

    /// Sorts out all faces, and then once more those that are kept.
    #[inline(never)] // its lists are gone when it returns
    fn record_faces(&self, faces: &mut Binned<'_, V, DEPTH>) -> Result<(), BinError> {
        let Binned { bins, statistics, .. } = faces;
        let list = self.placed.mesh.faces();
        let mut sorting = bins.sorting();
        for (index, face) in list.iter().enumerate() {
            self.record(index, face, &mut sorting, statistics);
        }
        sorting.finish(list.len(), |index| self.first_row(index))?;
        *statistics = statistics.with_the_rest_culled(list.len());
        Ok(())
    }

    /// Keeps what is seen of a face; counts it.
    #[inline(always)]
    fn record(
        &self,
        index: usize,
        face: &[u16; 3],
        sorting: &mut Sorting<'_, '_>,
        statistics: &mut Statistics,
    ) {
        if let Some(kept) = self.kept(face).filter(|kept| kept.iter().all(|corner| corner.whole())) {
            if self.front(&kept.map(|corner| *corner), statistics).is_some() {
                self.keep(index, kept, sorting);
            }
            return;
        }
        let mut reach = Scissor::EMPTY;
        let outcome = self.reach_of_cut(face, &mut reach);
        statistics.count(outcome);
        if outcome.is_drawn() {
            sorting.put(index, &reach);
        }
    }

    #[inline(never)] // its frame is gone when others are sorted out
    fn keep(&self, index: usize, [a, b, c]: [&ScreenVertex; 3], sorting: &mut Sorting<'_, '_>) {
        sorting.put(index, &self.reach([*a, *b, *c]));
    }

    /// Where a face begins that was kept.
    #[inline(never)] // asked for in two places
    fn first_row(&self, index: usize) -> i32 {
        let Some(face) = self.placed.mesh.faces().get(index) else { return 0 };
        match self.whole(face) {
            Some(corners) => self.top(corners),
            None => {
                let mut reach = Scissor::EMPTY;
                self.reach_of_cut(face, &mut reach);
                reach.rows().start
            }
        }
    }

    /// Where a face with these corners may cover pixels.
    #[inline(always)]
    fn reach(&self, corners: [ScreenVertex; 3]) -> Scissor {
        Scissor::bounding_box(&self.images(corners).map(|image| image.point))
    }

    /// The first row of that.
    #[inline(always)]
    fn top(&self, corners: [ScreenVertex; 3]) -> i32 {
        self.reach(corners).rows().start
    }

    #[cold]
    #[inline(never)]
    fn reach_of_cut(&self, face: &[u16; 3], reach: &mut Scissor) -> Outcome {
        let (mut polygon, mut progress) = (Polygon::new(), Progress::BEGIN);
        let cut = self.polygon(face, &mut polygon, &mut [(); CLIP_SLOTS]);
        progress.begin(&polygon, self.placed.cull, cut);
        if progress.outcome.is_drawn() {
            *reach = polygon.reach();
        }
        progress.outcome
    }

    /// Where an edge begins that was kept.
    #[inline(never)] // asked for in two places
    fn first_row_of_edge(&self, index: usize) -> i32 {
        let edge = self.placed.mesh.edges().get(index);
        let ends = edge.and_then(|&edge| self.ends_of(edge, &mut Statistics::default()));
        ends.map_or(0, |ends| reach_of_line(&ends).rows().start)
    }

    /// Sorts out all edges, and then once more those that are kept.
    #[inline(never)] // its lists are gone when it returns
    fn record_edges(&self, edges: &mut Binned<'_, V, DEPTH>) -> Result<(), BinError> {
        let Binned { bins, statistics, .. } = edges;
        let list = self.placed.mesh.edges();
        let mut sorting = bins.sorting();
        for (index, &edge) in list.iter().enumerate() {
            let ends = self.ends_of(edge, statistics);
            sorting.put(index, &ends.map_or(Scissor::EMPTY, |ends| reach_of_line(&ends)));
        }
        sorting.finish(list.len(), |index| self.first_row_of_edge(index))?;
        *statistics = statistics.with_the_rest_drawn(list.len());
        Ok(())
    }
}

impl<'a, V: Coordinate> PlaneCulled<'a, V> {
    /// Like `placed.transform(corners).bin_faces(records)` ([`TransformedMesh::bin_faces`]), for drawing in bands, but
    /// transforms only vertices of faces that may be visible.
    ///
    /// ```
    /// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// # use pinhole::{Affine, Angle, Camera, ScreenVertex, Frame, Mesh, Point3, Projection, Scalar, Vector3, ViewTransform, Viewport};
    /// # let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2], [0, 2, 1]])?;
    /// # let mut display = MockDisplay::<Gray8>::new();
    /// # let viewport = Viewport::new(Point::zero(), display.size())?;
    /// # let view = ViewTransform::look_at(Point3::from_ints(0, 0, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?;
    /// # let [near, far] = [1, 9].map(Scalar::from_num);
    /// # let lens = Projection::perspective(Angle::degrees(40), viewport.size(), near, far)?;
    /// # let camera = Camera::new(&view, &lens, &viewport);
    /// # let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
    /// let mesh = mesh.with_normals(&[[0, 0, 32_767], [0, 0, -32_767]])?.with_planes(&[0, 0])?;
    /// let placed = camera.place(&mesh, &Affine::identity());
    /// let (mut corners, mut records) = ([ScreenVertex::EMPTY; 3], [0; 2 + 1]);
    /// let mut faces = placed.cull_by_planes().bin_faces(&mut corners, &mut records)?;
    /// let mut frame = Frame::new(display.bounding_box(), Gray8::BLACK);
    /// while let Some(mut band) = frame.next_band(&mut strip)? {
    ///     faces.solid(|_| Gray8::WHITE, &mut band.pixels())?;
    ///     band.send(&mut display)?;
    /// }
    /// assert_eq!((faces.statistics().drawn, faces.statistics().culled), (1, 1));
    /// assert_eq!(display.get_pixel(Point::new(32, 32)), Some(Gray8::WHITE));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`BinError::Storage`] when the records are too short, and says how many are needed, and
    /// [`BinError::TooMany`] beyond 65535 faces; nothing is recorded then.
    pub fn bin_faces(
        &self,
        corners: &'a mut [ScreenVertex],
        records: &'a mut [u16],
    ) -> Result<BinnedFaces<'a, V>, BinError> {
        self.recorded(corners, records)
    }

    /// The same with depth, for drawing against depth strips: see
    /// [`MeshInstance::transform_depth`](crate::MeshInstance::transform_depth).
    ///
    /// # Errors
    ///
    /// As [`faces`](Self::bin_faces).
    pub fn bin_faces_with_depth(
        &self,
        corners: &'a mut [ScreenVertex],
        records: &'a mut [u16],
    ) -> Result<BinnedFaces<'a, V, true>, BinError> {
        self.recorded(corners, records)
    }

    #[inline(never)] // what it makes is large: inlined it would stand there once more while faces are drawn
    fn recorded<const DEPTH: bool>(
        &self,
        corners: &'a mut [ScreenVertex],
        records: &'a mut [u16],
    ) -> Result<BinnedFaces<'a, V, DEPTH>, BinError> {
        let mut bins = Bins::new(records, self.placed.mesh.faces().len(), pixels(self.placed.area()));
        let mut statistics = Statistics::default();
        self.record::<DEPTH>(corners, &mut bins, &mut statistics)?;
        Ok(BinnedFaces(Binned { transformed: self.transformed::<DEPTH>(corners), bins, statistics }))
    }

    #[inline(never)] // its lists are gone when it returns
    fn record<const DEPTH: bool>(
        &self,
        corners: &mut [ScreenVertex],
        bins: &mut Bins<'_>,
        statistics: &mut Statistics,
    ) -> Result<(), BinError> {
        let (count, mut sorting) = (self.placed.mesh.faces().len(), bins.sorting());
        self.each::<DEPTH, BinError>(corners, |index, face, kept, _| {
            self.transformed::<DEPTH>(kept).record(index, face, &mut sorting, statistics);
            Ok(())
        })?;
        let transformed = self.transformed::<DEPTH>(corners);
        sorting.finish(count, |index| transformed.first_row(index))?;
        *statistics = statistics.with_the_rest_culled(count);
        Ok(())
    }
}

/// The rows and columns in which a line may cover pixels.
#[inline(always)]
fn reach_of_line([from, to]: &[UnpackedVertex; 2]) -> Scissor {
    let (from, to) = (from.point.pixel(), to.point.pixel());
    let (left, right) = (from.x.min(to.x), from.x.max(to.x));
    let (top, bottom) = (from.y.min(to.y), from.y.max(to.y));
    Scissor::new(left.into(), top.into(), i32::from(right) + 1, i32::from(bottom) + 1)
}

impl<V: Coordinate, const DEPTH: bool> BinnedFaces<'_, V, DEPTH> {
    /// Draws what lies in a band, in the mesh's order: see [`MeshInstance::solid`](crate::MeshInstance::solid). `shade`
    /// is asked once for each face that a band meets.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(always)]
    pub fn solid<T: Target, I: SpanShader<T::Color>>(
        &mut self,
        shade: impl FnMut(usize) -> I,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let limits = self.advance_to_band(&band.area(), None);
        self.draw_solid(&limits, shade, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while items are taken in
    fn draw_solid<T: Target, I: SpanShader<T::Color>>(
        &mut self,
        limits: &DrawRegion,
        shade: impl FnMut(usize) -> I,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each(limits, shade, |piece, ink| fill(&piece.triangle, &ink, &limits.scissor, band))
    }

    /// Counts for the whole frame, whichever bands were drawn; `drawn` includes faces that cover no pixel.
    pub const fn statistics(&self) -> Statistics {
        self.0.statistics
    }

    /// A rectangle of the viewport around all faces that are drawn: no pixel outside it is covered. Without pixels where none
    /// is drawn.
    pub fn bounds(&self) -> Rectangle {
        self.0.bounds()
    }

    /// What of the viewport lies in a band, and that of a depth buffer if there is one; takes in the faces that begin there.
    #[inline(never)] // once for all ways to draw
    pub(super) fn advance_to_band(
        &mut self,
        band: &Rectangle,
        depth: Option<&DepthBuffer<'_>>,
    ) -> DrawRegion {
        self.0.advance_to_band(band, depth, TransformedMesh::first_row)
    }

    /// Draws what was [taken in](Self::advance_to_band) for these limits.
    #[inline(always)]
    pub(super) fn each<I: Shader, E>(
        &mut self,
        limits: &DrawRegion,
        mut shade: impl FnMut(usize) -> I,
        mut draw: impl FnMut(&DepthTriangle<'_>, I) -> Result<(), E>,
    ) -> Result<(), E> {
        let (faces, rows) = (self.0.transformed.placed.mesh.faces(), limits.scissor.rows());
        let mut fan = Fan::new();
        let mut piece = DepthTriangle::new(&limits.viewport);
        self.0.each(limits, |view, index| {
            let Some(face) = faces.get(index) else { return Ok(true) };
            if let Some(kept) = view.whole(face) {
                fan.whole();
                put::<DEPTH>(&mut piece, &view.images(kept), view.area(&kept));
            } else {
                fan.clear();
                if !view.triangle_into(face, &mut fan, &mut piece) {
                    return Ok(true);
                }
            }
            let (mut end, mut shaded) = (i32::MIN, None);
            loop {
                let reach = Scissor::bounding_box(piece.triangle.corners()).rows();
                end = end.max(reach.end);
                if reach.start < rows.end && reach.end > rows.start {
                    let ink = *shaded.get_or_insert_with(|| shade(index));
                    draw(&piece, fan.ink(&ink))?;
                }
                if !view.triangle_into(face, &mut fan, &mut piece) {
                    break;
                }
            }
            Ok(end <= rows.end)
        })
    }
}

impl<V: Coordinate> BinnedFaces<'_, V, true> {
    /// Draws the faces in a band where they are nearer than `depth`. Make that for the band's
    /// [area](crate::Band::area): nothing is drawn outside it, so with another band's buffer this one stays empty.
    /// See [`MeshInstance::depth_tested`](crate::MeshInstance::depth_tested). `shade` is asked once for each face that a band
    /// meets.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(always)]
    pub fn depth_tested<T: Target, I: SpanShader<T::Color>>(
        &mut self,
        shade: impl FnMut(usize) -> I,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let limits = self.advance_to_band(&band.area(), Some(depth));
        self.draw_depth_tested(&limits, shade, depth, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while items are taken in
    fn draw_depth_tested<T: Target, I: SpanShader<T::Color>>(
        &mut self,
        limits: &DrawRegion,
        shade: impl FnMut(usize) -> I,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let mut against = band.against(depth);
        self.each(limits, shade, |piece, ink| fill_nearer(piece, &ink, &limits.scissor, &mut against, band))
    }
}

impl<V: Coordinate, const DEPTH: bool> BinnedEdges<'_, V, DEPTH> {
    /// Draws what lies in a band: see [`MeshInstance::wireframe`](crate::MeshInstance::wireframe).
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(always)]
    pub fn draw<T: Target>(&mut self, colour: T::Color, band: &mut T) -> Result<(), T::Error> {
        let limits = self.advance_to_band(&band.area(), None);
        self.draw_lines(&limits, colour, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while items are taken in
    fn draw_lines<T: Target>(
        &mut self,
        limits: &DrawRegion,
        colour: T::Color,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each(limits, |_, _, [from, to]| {
            band.line(from.point.pixel(), to.point.pixel(), &limits.scissor, colour)
        })
    }

    /// What became of the edges.
    pub const fn statistics(&self) -> Statistics {
        self.0.statistics
    }

    /// A rectangle of the viewport around all edges that are drawn: no pixel outside it is. Without pixels where none is drawn.
    pub fn bounds(&self) -> Rectangle {
        self.0.bounds()
    }

    /// What of the viewport lies in a band, and that of a depth buffer if there is one; takes in the edges that begin there.
    #[inline(never)] // once for all ways to draw
    pub(super) fn advance_to_band(
        &mut self,
        band: &Rectangle,
        depth: Option<&DepthBuffer<'_>>,
    ) -> DrawRegion {
        self.0.advance_to_band(band, depth, TransformedMesh::first_row_of_edge)
    }

    /// Draws what was [taken in](Self::advance_to_band) for these limits.
    #[inline(always)]
    pub(super) fn each<E>(
        &mut self,
        limits: &DrawRegion,
        mut draw: impl FnMut(&TransformedMesh<'_, V, DEPTH>, usize, [UnpackedVertex; 2]) -> Result<(), E>,
    ) -> Result<(), E> {
        let (edges, end) = (self.0.transformed.placed.mesh.edges(), limits.scissor.rows().end);
        self.0.each(limits, |view, index| {
            let edge = edges.get(index);
            let Some(ends) = edge.and_then(|&edge| view.ends_of(edge, &mut Statistics::default())) else {
                return Ok(true);
            };
            draw(view, index, ends)?;
            Ok(reach_of_line(&ends).rows().end <= end)
        })
    }
}

#[cfg(feature = "defmt")]
impl<V, const DEPTH: bool> defmt::Format for BinnedFaces<'_, V, DEPTH> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Self(Binned { bins, statistics, .. }) = self;
        defmt::write!(f, "faces within {}: {}", bins.bounds(), statistics);
    }
}

#[cfg(feature = "defmt")]
impl<V, const DEPTH: bool> defmt::Format for BinnedEdges<'_, V, DEPTH> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Self(Binned { bins, statistics, .. }) = self;
        defmt::write!(f, "edges within {}: {}", bins.bounds(), statistics);
    }
}
