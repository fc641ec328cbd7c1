//! Faces that are binned once a frame and drawn band by band.

use super::binned::Binned;
use super::bins::{BinError, BinSort, Bins};
use super::draw_region::{pixels, DrawRegion};
use super::face_source::{FaceSource, MeshOrder};
use super::face_triangles::FaceTriangles;
use super::faces::{draw_triangles, each_face, keep_depth};
use super::fill::{fill, fill_nearer};
use super::plane_culled::PlaneCulled;
use super::statistics::Statistics;
use super::vertex_cache::{BinnedVertices, LazyCache, TransformedMesh, VertexCache};
use crate::camera::ScreenVertex;
use crate::clip::Varying;
use crate::math::Coordinate;
use crate::raster::Scissor;
use crate::shading::SpanShader;
use crate::surface::{DepthBuffer, DepthTarget, Target};
use core::convert::Infallible;
use embedded_graphics_core::primitives::Rectangle;

/// The visible faces of a mesh, binned by the rows in which they begin, to be drawn band by band, or into any part of the
/// picture: see [`TransformedMesh::bin_faces`]; [`MeshInstance::transform`](crate::MeshInstance::transform) has an example.
#[derive(Debug)]
pub struct BinnedFaces<'a, V = i16, const DEPTH: bool = false>(pub(super) Binned<'a, V, DEPTH>);

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Culls the faces and sorts the visible ones by their first row. `records` is scratch for the frame: one
    /// number per visible face, and one per 16 faces of the mesh, rounded up.
    ///
    /// # Errors
    ///
    /// [`BinError::Storage`] when the records are too short, and says how many are needed, and
    /// [`BinError::TooMany`] beyond 65535 faces; nothing is recorded then.
    #[inline(never)] // the result is large: inlined, it would stand on the stack once more while faces are drawn
    pub fn bin_faces(&self, records: &'a mut [u16]) -> Result<BinnedFaces<'a, V, DEPTH>, BinError> {
        let mut faces = BinnedFaces(Binned::new(*self, records, self.instance.mesh.faces().len()));
        faces.0.statistics = self.fill_bins(&mut faces.0.bins)?;
        Ok(faces)
    }

    #[inline(never)] // the lists of the sort are gone when it returns
    fn fill_bins(&self, bins: &mut Bins<'_>) -> Result<Statistics, BinError> {
        bin(MeshOrder, *self, bins)
    }

    /// The first row of a face that was binned.
    #[inline(never)] // one copy for two callers
    pub(super) fn first_row(&self, index: usize) -> i32 {
        let Some(face) = self.instance.mesh.faces().get(index) else { return 0 };
        match self.on_screen(face) {
            Some(corners) => {
                Scissor::bounding_box(&self.unpack(corners).map(|corner| corner.point)).rows().start
            }
            None => self.first_row_of_clipped(face),
        }
    }

    #[cold]
    #[inline(never)]
    fn first_row_of_clipped(&self, face: &[u16; 3]) -> i32 {
        let viewport = Scissor::EMPTY; // no gradient is asked for
        let mut triangles = FaceTriangles::<()>::new(&viewport);
        self.clip_face(face, &mut triangles);
        triangles.fan.reach().rows().start
    }
}

/// Bins faces of a source: counts them, and then sorts those that are drawn.
#[inline(always)]
fn bin<'a, V: Coordinate + 'a, const DEPTH: bool>(
    source: impl FaceSource,
    mut cache: impl VertexCache<'a, V, DEPTH>,
    bins: &mut Bins<'_>,
) -> Result<Statistics, BinError> {
    let (count, mut sort) = (cache.instance().mesh.faces().len(), bins.sort());
    let statistics = count_faces(source, &mut cache, &mut sort);
    let mesh = cache.view();
    sort.finish(count, |index| mesh.first_row(index))?;
    Ok(statistics)
}

/// Culls and clips faces and puts those that are drawn to the sort.
#[inline(never)] // its frame is gone when the faces are sorted
fn count_faces<'a, V: Coordinate + 'a, const DEPTH: bool>(
    source: impl FaceSource,
    cache: &mut impl VertexCache<'a, V, DEPTH>,
    sort: &mut BinSort<'_, '_>,
) -> Statistics {
    let viewport = Scissor::EMPTY; // no gradient is asked for
    let Ok(statistics) =
        each_face(source, cache, &viewport, |index, _, triangles: &mut FaceTriangles<'_, ()>| {
            sort.put(index, &triangles.fan.reach());
            Ok::<bool, Infallible>(true)
        });
    statistics
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
    /// let (mut cache, mut storage) = ([ScreenVertex::EMPTY; 3], [0; 2 + 1]);
    /// let mut faces = placed.cull_by_planes().bin_faces(&mut cache, &mut storage)?;
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
        cache: &'a mut [ScreenVertex],
        records: &'a mut [u16],
    ) -> Result<BinnedFaces<'a, V>, BinError> {
        self.binned(cache, records)
    }

    /// [`bin_faces`](Self::bin_faces) with depth, for drawing against depth strips: see
    /// [`MeshInstance::transform_depth`](crate::MeshInstance::transform_depth).
    ///
    /// # Errors
    ///
    /// Those of [`bin_faces`](Self::bin_faces).
    pub fn bin_faces_with_depth(
        &self,
        cache: &'a mut [ScreenVertex],
        records: &'a mut [u16],
    ) -> Result<BinnedFaces<'a, V, true>, BinError> {
        self.binned(cache, records)
    }

    #[inline(never)] // the result is large: inlined, it would stand on the stack once more while faces are drawn
    fn binned<const DEPTH: bool>(
        &self,
        cache: &'a mut [ScreenVertex],
        records: &'a mut [u16],
    ) -> Result<BinnedFaces<'a, V, DEPTH>, BinError> {
        let mut bins = Bins::new(records, self.instance.mesh.faces().len(), pixels(self.instance.area()));
        let statistics = self.fill_bins::<DEPTH>(cache, &mut bins)?;
        let transformed = TransformedMesh::with_cache(self.instance, DEPTH, cache);
        Ok(BinnedFaces(Binned { transformed, bins, statistics }))
    }

    #[inline(never)] // the lists of the sort are gone when it returns
    fn fill_bins<const DEPTH: bool>(
        &self,
        cache: &mut [ScreenVertex],
        bins: &mut Bins<'_>,
    ) -> Result<Statistics, BinError> {
        bin(
            self.source(),
            LazyCache::<V, DEPTH>::new(
                self.instance,
                DEPTH || self.instance.vertex_transform.clips_at_far(),
                cache,
            ),
            bins,
        )
    }
}

/// The binned faces that a band may meet, in the order of the mesh.
struct BandSource<'b, 's>(&'b mut Bins<'s>);

impl FaceSource for BandSource<'_, '_> {
    #[inline(always)]
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        mut visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E> {
        self.0.band(|index| match faces.get(index) {
            Some(face) => visit(index, face),
            None => Ok(true),
        })
    }
}

impl<V: Coordinate, const DEPTH: bool> BinnedFaces<'_, V, DEPTH> {
    /// Draws the faces in a band, in the mesh's order: see [`MeshInstance::solid`](crate::MeshInstance::solid). `shade`
    /// is asked once for each face that a band meets. A shader that needs depth takes faces that were
    /// [transformed with depth](crate::MeshInstance::transform_depth), or does not compile.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(always)]
    pub fn solid<T: Target, S: SpanShader<T::Color>>(
        &mut self,
        shade: impl FnMut(usize) -> S,
        band: &mut T,
    ) -> Result<(), T::Error> {
        const { assert!(DEPTH || !S::NEEDS_DEPTH, "this shader needs depth: bin faces of `transform_depth`") };
        let region = self.advance_to_band(&band.area(), None);
        self.draw_solid(&region, shade, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while the bins advance
    fn draw_solid<T: Target, S: SpanShader<T::Color>>(
        &mut self,
        region: &DrawRegion,
        mut shade: impl FnMut(usize) -> S,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let instance = self.0.transformed.instance;
        self.each(region, |index, face, triangles| {
            let shader = shade(index);
            draw_triangles(instance, face, triangles, &shader, |triangle, shader| {
                fill(&triangle.triangle, shader, &region.scissor, band)
            })
        })
    }

    /// Counts for the whole frame, whichever bands were drawn; `drawn` includes faces that cover no pixel.
    pub const fn statistics(&self) -> Statistics {
        self.0.statistics
    }

    /// A rectangle of the viewport around all faces that are drawn: no pixel outside it is covered. It has no pixels where
    /// no face is drawn.
    pub fn bounds(&self) -> Rectangle {
        self.0.bounds()
    }

    /// Takes in the faces that begin in a band. Returns the part of the viewport that lies in the band, and in the depth
    /// buffer if there is one.
    #[inline(never)] // one copy for all draw calls
    fn advance_to_band(&mut self, band: &Rectangle, depth: Option<&DepthBuffer<'_>>) -> DrawRegion {
        self.0.advance_to_band(band, depth, TransformedMesh::first_row)
    }

    /// Passes on the faces that meet the band of the last [`advance_to_band`](Self::advance_to_band).
    #[inline(always)]
    fn each<K: Varying, E>(
        &mut self,
        region: &DrawRegion,
        mut draw: impl FnMut(usize, &[u16; 3], &mut FaceTriangles<'_, K>) -> Result<(), E>,
    ) -> Result<(), E> {
        let rows = region.scissor.rows();
        if region.scissor.is_empty() {
            return Ok(()); // the bins stand at another band
        }
        let mut cache = BinnedVertices(self.0.transformed);
        let source = BandSource(&mut self.0.bins);
        each_face(source, &mut cache, &region.viewport, |index, face, triangles| {
            let reach = triangles.fan.reach().rows();
            if reach.start < rows.end && reach.end > rows.start {
                draw(index, face, triangles)?;
            }
            Ok(reach.end <= rows.end)
        })?;
        Ok(())
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
    pub fn depth_tested<T: Target, S: SpanShader<T::Color>>(
        &mut self,
        shade: impl FnMut(usize) -> S,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let region = self.advance_to_band(&band.area(), Some(depth));
        self.draw_depth_tested(&region, shade, depth, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while the bins advance
    fn draw_depth_tested<T: Target, S: SpanShader<T::Color>>(
        &mut self,
        region: &DrawRegion,
        mut shade: impl FnMut(usize) -> S,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let instance = self.0.transformed.instance;
        let mut depth = DepthTarget::new(depth, band);
        self.each(region, |index, face, triangles| {
            let shader = shade(index);
            draw_triangles(instance, face, triangles, &shader, |triangle, shader| {
                fill_nearer(triangle, shader, &region.scissor, &mut depth, band)
            })
        })
    }

    /// Keeps the depth of the faces in a band and draws nothing: see
    /// [`MeshInstance::depth_only`](crate::MeshInstance::depth_only).
    #[inline(always)]
    pub fn depth_only(&mut self, depth: &mut DepthBuffer<'_>) {
        let region = self.advance_to_band(&depth.area(), None);
        self.keep_depth(&region, depth);
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while the bins advance
    fn keep_depth(&mut self, region: &DrawRegion, depth: &mut DepthBuffer<'_>) {
        let Ok(()) = self.each(region, |_, _, triangles| {
            keep_depth(triangles, &region.scissor, depth);
            Ok::<(), Infallible>(())
        });
    }
}

#[cfg(feature = "defmt")]
impl<V, const DEPTH: bool> defmt::Format for BinnedFaces<'_, V, DEPTH> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Self(Binned { bins, statistics, .. }) = self;
        defmt::write!(f, "faces within {}: {}", bins.bounds(), statistics);
    }
}
