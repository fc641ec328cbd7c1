//! Faces that are binned once per frame and drawn band by band.

use super::binned::{assert_depth, Binned, DrawnWith};
use super::bins::{each_active, BinFill, BinStorage, Bins};
use super::cull::Facing;
use super::draw_region::{pixels, DrawRegion};
use super::drawable::ShaderFor;
use super::face_source::{FaceSource, MeshOrder};
use super::face_triangles::FaceTriangles;
use super::faces::{draw_triangles, each_face, store_depth};
use super::fill::{fill, fill_nearer};
use super::statistics::{Outcome, Statistics};
use super::vertex_cache::{area, BinnedVertices, TransformedMesh, VertexCache};
use crate::clip::Varying;
use crate::math::unrolled::map3;
use crate::math::Coordinate;
use crate::raster::Scissor;
use crate::surface::{BufferError, DepthBuffer, DepthTarget, Surface, Target, Tested, Unmatched, Untested};
use core::convert::Infallible;
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;

/// The visible faces of a mesh, binned by their first rows: each band, or any other rectangle of the picture, draws only the
/// faces that lie in it. [`TransformedMesh::bin_faces`] makes it and has an example.
///
/// `L` is the list of [active faces](Self::with_active_faces), if there is one.
#[derive(Debug)]
pub struct BinnedFaces<'a, V: Coordinate = i16, const DEPTH: bool = true, L = ()> {
    pub(super) binned: Binned<'a, V, DEPTH>,
    pub(super) list: L,
}

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Culls the faces and puts the visible ones into bins of rows, for drawing in bands. `storage` is bin storage that the
    /// result borrows: [`face_bins_len`](crate::Mesh::face_bins_len) numbers.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2], [0, 2, 1]])?;
    /// let mut display = MockDisplay::<Gray8>::new();
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 3], [0; 4]); // `mesh.vertices().len()`, `mesh.face_bins_len()`
    /// let mut faces = instance.transform(&mut cache).bin_faces(&mut bins)?;
    /// let mut frame = Frame::new(display.bounding_box(), Gray8::BLACK);
    /// while let Some(mut band) = frame.next_band(&mut strip)? {
    ///     faces.draw(|_| Gray8::WHITE, &mut band.pixels())?;
    ///     band.send(&mut display)?;
    /// }
    /// assert_eq!((faces.statistics().drawn, faces.statistics().culled), (1, 1));
    /// assert_eq!(display.get_pixel(Point::new(32, 32)), Some(Gray8::WHITE));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`BufferError::Bins`] if `storage` is too short; the error says how many numbers are needed. [`BufferError::TooManyItems`] if
    /// the mesh has more than 65535 faces. Nothing is binned then.
    #[inline(never)] // the result is large: inlined, a second copy would stay on the stack while faces are drawn
    pub fn bin_faces(&self, storage: &'a mut [u16]) -> Result<BinnedFaces<'a, V, DEPTH>, BufferError> {
        let (bins, statistics) = bin_faces(self, storage)?;
        Ok(Binned { transformed: *self, bins, statistics }.into())
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> From<Binned<'a, V, DEPTH>> for BinnedFaces<'a, V, DEPTH> {
    fn from(binned: Binned<'a, V, DEPTH>) -> Self {
        Self { binned, list: () }
    }
}

/// The visible faces of a mesh in bins, and the counts of the frame.
#[inline(never)] // one copy for all callers
pub(super) fn bin_faces<'s, V: Coordinate, const DEPTH: bool>(
    mesh: &TransformedMesh<'_, V, DEPTH>,
    storage: &'s mut [u16],
) -> Result<(Bins<'s>, Statistics), BufferError> {
    let faces = mesh.instance.mesh().faces.len();
    let mut fill = BinStorage::new(storage, faces, 1)?.fill(pixels(mesh.instance.area()));
    let statistics = fill.add_faces(MeshOrder, *mesh).with_the_rest_culled(faces);
    Ok((fill.bins(), statistics))
}

impl BinFill<'_> {
    /// Culls the faces of a source and adds the visible ones.
    #[inline(always)]
    pub(super) fn add_faces<'a, V: Coordinate + 'a, const DEPTH: bool>(
        &mut self,
        source: impl FaceSource,
        mut mesh: TransformedMesh<'a, V, DEPTH>,
    ) -> Statistics {
        let mut statistics = Statistics::NONE;
        let Ok(()) = source.push(mesh.instance.mesh().faces, |index, face| {
            // As in `each_face`, without a triangle: S3 with depth takes 3 % fewer instructions in bands of 8 rows on an M3.
            let bounds = match mesh.corners(face) {
                Some(corners) => {
                    match mesh.instance.cull().facing(area::<DEPTH>(&corners)) {
                        Facing::Drawn => statistics.count(Outcome::Unclipped),
                        Facing::Culled => return Ok::<bool, Infallible>(true),
                        Facing::EdgeOn => {
                            statistics.count(Outcome::Degenerate);
                            return Ok(true);
                        }
                    }
                    Scissor::bounding_box(&map3(mesh.unpack(corners), |corner| corner.point))
                }
                None => {
                    let (outcome, bounds) = mesh.clipped_bounds(face);
                    statistics.count(outcome);
                    if !outcome.is_drawn() {
                        return Ok(true);
                    }
                    bounds
                }
            };
            self.add(index, &bounds);
            Ok(true)
        });
        statistics
    }
}

impl<V: Coordinate, const DEPTH: bool> TransformedMesh<'_, V, DEPTH> {
    /// What becomes of a face with an uncached vertex, or one without a position, and the bounding box of its pixels.
    #[cold]
    #[inline(never)]
    fn clipped_bounds(&self, face: &[u16; 3]) -> (Outcome, Scissor) {
        let viewport = Scissor::EMPTY; // no gradient is computed
        let mut triangles = FaceTriangles::<()>::new(&viewport);
        (self.clip_face(face, &mut triangles), triangles.fan.bounds())
    }
}

/// Most faces of a band have rows outside it. All of them take the tier of clipped triangles, so that firmware that draws in
/// bands alone has no code of the tier of inside triangles, some 850 bytes on an M3. In bands of 8 rows trying that tier first would
/// save 1 % of S3's instructions, in bands of 16 rows 3 %.
pub(super) const IN_BAND: bool = true;

/// The binned faces that a band may meet, in the order of the mesh.
struct BandSource<'b, 's>(&'b mut Bins<'s>);

impl FaceSource for BandSource<'_, '_> {
    #[inline(always)]
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        mut visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E> {
        each_active(self.0.active(), |index| match faces.get(index) {
            Some(face) => visit(index, face),
            None => Ok(true),
        })
    }
}

impl<V: Coordinate, const DEPTH: bool, L> BinnedFaces<'_, V, DEPTH, L> {
    /// Draws the faces in a band as [`Faces::draw`](crate::draw::Faces::draw) does. `shade` is called once for each face that lies in the
    /// band, except for faces that a [list](BinnedFaces::with_active_faces) carries into it.
    ///
    /// For a depth test, create the depth buffer for this band's [area](crate::bands::Band::area): nothing is drawn outside it. Faces whose
    /// vertices were transformed without depth do not compile with one, and neither do they with a shader that needs depth:
    ///
    /// ```compile_fail,E0277
    /// # use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
    /// # use pinhole::prelude::*;
    /// fn draw(faces: &mut BinnedFaces<'_, i16, false>, depth: &mut DepthBuffer<'_>, band: &mut Band<'_, Rgb565>) {
    ///     // Compiles with `BinnedFaces<'_>`.
    ///     let Ok(()) = faces.draw(|_| Rgb565::RED, &mut band.depth_tested(depth));
    /// }
    /// ```
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn draw<T: Target, S: ShaderFor<T::Surface>>(
        &mut self,
        shade: impl FnMut(usize) -> S,
        band: &mut T,
    ) -> Result<(), T::Error>
    where
        Self: DrawnWith<T::Test>,
        L: FaceList<T::Color>,
    {
        band.dispatch(
            (self, shade),
            |(faces, shade), band| {
                const { assert_depth::<S, DEPTH>() };
                L::draw_solid(faces, shade, band)
            },
            |(faces, shade), band, depth| L::draw_depth_tested(faces, shade, depth, band),
        )
    }

    /// Counts for the whole frame, whichever bands were drawn. `drawn` includes faces that cover no pixel.
    pub const fn statistics(&self) -> Statistics {
        self.binned.statistics
    }

    /// A rectangle inside the viewport around all visible faces: no pixel outside it is drawn. It is empty if no face is
    /// visible.
    pub fn bounds(&self) -> Rectangle {
        self.binned.bounds()
    }
}

/// How binned faces are drawn: with a list of active faces, or without one.
#[diagnostic::on_unimplemented(
    message = "the list of active faces has other colors than the target",
    note = "make it of `[ActiveFace::EMPTY; N]` in the target's color type"
)]
pub trait FaceList<C: PixelColor>: Sized {
    #[doc(hidden)]
    fn draw_solid<V: Coordinate, T: Surface<Color = C>, S: ShaderFor<T>, const DEPTH: bool>(
        faces: &mut BinnedFaces<'_, V, DEPTH, Self>,
        shade: impl FnMut(usize) -> S,
        band: &mut T,
    ) -> Result<(), T::Error>;

    #[doc(hidden)]
    fn draw_depth_tested<V: Coordinate, T: Surface<Color = C>, S: ShaderFor<T>, const DEPTH: bool>(
        faces: &mut BinnedFaces<'_, V, DEPTH, Self>,
        shade: impl FnMut(usize) -> S,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error>;
}

impl<C: PixelColor> FaceList<C> for () {
    #[inline(always)]
    fn draw_solid<V: Coordinate, T: Surface<Color = C>, S: ShaderFor<T>, const DEPTH: bool>(
        faces: &mut BinnedFaces<'_, V, DEPTH>,
        shade: impl FnMut(usize) -> S,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let region = faces.advance_to_band(&band.area(), None);
        faces.draw_solid(&region, shade, band)
    }

    #[inline(always)]
    fn draw_depth_tested<V: Coordinate, T: Surface<Color = C>, S: ShaderFor<T>, const DEPTH: bool>(
        faces: &mut BinnedFaces<'_, V, DEPTH>,
        shade: impl FnMut(usize) -> S,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let region = faces.advance_to_band(&band.area(), Some(depth));
        faces.draw_depth_tested(&region, shade, depth, band)
    }
}

impl<V: Coordinate, const DEPTH: bool> BinnedFaces<'_, V, DEPTH> {
    #[inline(never)] // its stack frame does not exist while the bins advance
    fn draw_solid<T: Surface, S: ShaderFor<T>>(
        &mut self,
        region: &DrawRegion,
        mut shade: impl FnMut(usize) -> S,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let instance = self.binned.transformed.instance;
        self.each(region, |index, face, triangles| {
            let shader = shade(index);
            draw_triangles(instance, face, triangles, &shader, |triangle, shader| {
                fill(&triangle.triangle, shader, &region.scissor, IN_BAND, band)
            })
        })
    }

    #[inline(never)] // its stack frame does not exist while the bins advance
    fn draw_depth_tested<T: Surface, S: ShaderFor<T>>(
        &mut self,
        region: &DrawRegion,
        mut shade: impl FnMut(usize) -> S,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let instance = self.binned.transformed.instance;
        let mut depth = DepthTarget::new(depth, band);
        self.each(region, |index, face, triangles| {
            let shader = shade(index);
            draw_triangles(instance, face, triangles, &shader, |triangle, shader| {
                fill_nearer(triangle, shader, &region.scissor, IN_BAND, &mut depth, band)
            })
        })
    }

    /// Splits the binned faces into two, one for each of two cores: both draw from the same list of faces and the same
    /// vertices, and neither writes to them. `cursor` is the second one's storage, one number per 16 faces of the mesh,
    /// rounded up. When both are dropped, the binned faces can be drawn or forked again; a fork can be forked, for more cores.
    ///
    /// Each fork can draw any band; the pixels do not depend on which one does. Bands from top to bottom are fastest:
    /// a band above the last one of this fork begins again at the top of the bins. [`Frame::nth_band`](crate::bands::Frame::nth_band)
    /// gives each core its bands.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
    /// let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?;
    /// let mut display = MockDisplay::<Gray8>::new();
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let (mut cache, mut bins, mut cursor) = ([ScreenVertex::EMPTY; 3], [0; 3], [0; 1]);
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let mut faces = instance.transform(&mut cache).bin_faces(&mut bins)?;
    /// let forks = faces.fork(&mut cursor)?;
    ///
    /// // Each core takes the next band that no one has: eight rows of 64 pixels.
    /// let (frame, next) = (Frame::new(display.bounding_box(), Gray8::BLACK), AtomicU32::new(0));
    /// let draw = |mut faces: BinnedFaces<'_, i16, false>| {
    ///     let mut sent = Vec::new();
    ///     let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
    ///     while let Some(mut band) = frame.nth_band(next.fetch_add(1, Relaxed), &mut strip).expect("a row") {
    ///         let Ok(()) = faces.draw(|_| Gray8::WHITE, &mut band.pixels());
    ///         sent.push((band.area(), band.colors().collect::<Vec<_>>()));
    ///     }
    ///     sent
    /// };
    /// let sent = std::thread::scope(|scope| {
    ///     forks.map(|faces| scope.spawn(|| draw(faces))).map(|core| core.join().expect("no panic"))
    /// });
    /// for (area, colors) in sent.iter().flatten() {
    ///     display.fill_contiguous(area, colors.iter().copied())?;
    /// }
    /// assert_eq!(display.get_pixel(Point::new(32, 32)), Some(Gray8::WHITE));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`BufferError::Bins`] if `cursor` is too short; the error says how many numbers are needed.
    #[inline(never)] // the result is large
    pub fn fork<'b>(
        &'b mut self,
        cursor: &'b mut [u16],
    ) -> Result<[BinnedFaces<'b, V, DEPTH>; 2], BufferError> {
        Ok(self.binned.fork(cursor)?.map(BinnedFaces::from))
    }

    /// Activates the faces that begin in a band. Returns the part of the viewport that lies in the band, and in the depth
    /// buffer if there is one.
    #[inline(never)] // one copy for all draw calls
    fn advance_to_band(&mut self, band: &Rectangle, depth: Option<&DepthBuffer<'_>>) -> DrawRegion {
        self.binned.advance_to_band::<0>(band, depth)
    }

    /// Calls `draw` for each face that lies in the band of the last [`advance_to_band`](Self::advance_to_band).
    #[inline(always)]
    fn each<K: Varying, E>(
        &mut self,
        region: &DrawRegion,
        mut draw: impl FnMut(usize, &[u16; 3], &mut FaceTriangles<'_, K>) -> Result<(), E>,
    ) -> Result<(), E> {
        let rows = region.scissor.rows();
        if region.scissor.is_empty() {
            return Ok(()); // the bins did not advance to this band
        }
        let mut cache = BinnedVertices(self.binned.transformed);
        let source = BandSource(&mut self.binned.bins);
        each_face(source, &mut cache, &region.viewport, |index, face, triangles| {
            let bounds = triangles.fan.bounds().rows();
            if bounds.start < rows.end && bounds.end > rows.start {
                draw(index, face, triangles)?;
            }
            Ok(bounds.end <= rows.end)
        })?;
        Ok(())
    }

    /// Stores the depth of the faces in a band and draws nothing: see
    /// [`MeshInstance::depth_only`](crate::draw::MeshInstance::depth_only).
    #[inline(always)]
    pub fn depth_only(&mut self, depth: &mut DepthBuffer<'_>)
    where
        Self: DrawnWith<Tested>,
    {
        let region = self.advance_to_band(&depth.area(), None);
        self.store_depth(&region, depth);
    }

    #[inline(never)] // its stack frame does not exist while the bins advance
    fn store_depth(&mut self, region: &DrawRegion, depth: &mut DepthBuffer<'_>) {
        let Ok(()) = self.each(region, |_, _, triangles| {
            store_depth::<V>(triangles, &region.scissor, depth);
            Ok::<(), Infallible>(())
        });
    }
}

impl<V: Coordinate, L, Test> DrawnWith<Test> for BinnedFaces<'_, V, true, L> {}
impl<V: Coordinate, L> DrawnWith<Untested> for BinnedFaces<'_, V, false, L> {}
impl<V: Coordinate, L> DrawnWith<Unmatched> for BinnedFaces<'_, V, false, L> {}

defmt_format!(
    [V: Coordinate, const DEPTH: bool, L] BinnedFaces<'_, V, DEPTH, L>, self,
    "faces within {}: {}", self.binned.bins.bounds(), self.binned.statistics
);
