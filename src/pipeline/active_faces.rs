//! Binned faces with a list of active faces, which continue from band to band.

use super::binned::Binned;
use super::binned_faces::{BinnedFaces, FaceList, IN_BAND};
use super::bins::{each_active, NONE};
use super::draw_region::DrawRegion;
use super::drawable::ShaderFor;
use super::face_source::PartOrder;
use super::faces::{draw_triangles, each_face};
use super::fill::{fill, fill_nearer, solid_color};
use super::vertex_cache::{area, BinnedVertices, TransformedMesh};
use crate::color::InkKind;
use crate::fast::carried::{self, Carried, Rest};
use crate::math::hints::keep_rolled;
use crate::math::unrolled::map3;
use crate::math::Coordinate;
use crate::raster::{DepthTriangle, Scissor};
use crate::shading::SpanShader;
use crate::surface::{DepthBuffer, DepthTarget, Surface};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;

/// An entry of a list of active faces, for targets with colours of type `C`. With colours of 16 bits it takes 36 bytes without depth
/// and 48 with depth, which is carried by three words. [`BinnedFaces::with_active_faces`] has an example.
#[derive(Clone, Copy, Debug)]
pub struct ActiveFace<C, const WORDS: usize = 3> {
    /// The face's index.
    face: u16,
    /// The entry of the next active face in the order of the mesh, or of the next free one.
    next: u16,
    carried: Carried<C, WORDS>,
}

impl<C: PixelColor, const WORDS: usize> ActiveFace<C, WORDS> {
    /// An entry without a face, with which the caller's list begins.
    pub const EMPTY: Self = Self { face: 0, next: 0, carried: Carried::EMPTY }; // all bits 0: a static takes no flash
}

/// The list of faces that continue from band to band, as a type parameter of [`BinnedFaces`]: [`BinnedFaces::with_active_faces`] makes it and
/// has an example.
#[derive(Debug)]
pub struct ActiveFaces<'f, C, const WORDS: usize = 3> {
    entries: &'f mut [ActiveFace<C, WORDS>],
    /// The first active face and the first free entry: active faces are linked in the order of the mesh.
    first: u16,
    free: u16,
    /// The left and right end of the last band, and the row below it; `None` if no band was drawn to its end.
    below: Option<[i32; 3]>,
}

/// Where a band has arrived in a list.
struct Cursor {
    /// The entry before the next one.
    before: u16,
    /// The next entry, and its face.
    at: u16,
    face: u16,
}

impl<'f, C, const WORDS: usize> ActiveFaces<'f, C, WORDS> {
    /// A list without a face.
    fn new(list: &'f mut [ActiveFace<C, WORDS>]) -> Self {
        let length = list.len().min(usize::from(NONE) - 1); // behind the last entry: at most `NONE`
        Self { entries: list.get_mut(..length).unwrap_or_default(), first: NONE, free: NONE, below: None }
    }

    /// Links all entries as free ones.
    fn clear(&mut self) {
        (self.first, self.free) = (NONE, if self.entries.is_empty() { NONE } else { 0 });
        for (entry, next) in self.entries.iter_mut().zip(1..) {
            keep_rolled();
            entry.next = next; // behind the last one there is none
        }
    }

    fn cursor(&self) -> Cursor {
        let mut cursor = Cursor { before: NONE, at: self.first, face: NONE };
        cursor.face = self.face(cursor.at);
        cursor
    }

    fn face(&self, entry: u16) -> u16 {
        self.entries.get(usize::from(entry)).map_or(NONE, |entry| entry.face)
    }

    /// Links the entry behind the one before the cursor's.
    fn link(&mut self, before: u16, to: u16) {
        match self.entries.get_mut(usize::from(before)) {
            Some(entry) => entry.next = to,
            None => self.first = to,
        }
    }

    /// Fills the rows of a band with the faces before `face`.
    #[inline(never)] // the loop over other faces needs the registers
    fn continue_to<T: Surface<Color = C>>(
        &mut self,
        face: u16,
        cursor: &mut Cursor,
        scissor: &Scissor,
        depths: &mut [u16],
        band: &mut T,
    ) {
        while cursor.face < face {
            let at = cursor.at;
            let Some(entry) = self.entries.get_mut(usize::from(at)) else { return };
            let ends = carried::fill(&mut entry.carried, scissor.rows(), depths, band);
            cursor.at = entry.next;
            if ends {
                (entry.next, self.free) = (self.free, at);
                self.link(cursor.before, cursor.at);
            } else {
                cursor.before = at;
            }
            cursor.face = self.face(cursor.at);
        }
    }

    /// Takes the free entry for a face before the cursor.
    fn insert(&mut self, cursor: &mut Cursor, face: u16) {
        let at = self.free;
        let Some(entry) = self.entries.get_mut(usize::from(at)) else { return };
        self.free = core::mem::replace(&mut entry.next, cursor.at);
        entry.face = face;
        self.link(cursor.before, at);
        cursor.before = at;
    }
}

/// How many words of depth an [`ActiveFace`] carries: 3, or none of vertices without depth.
pub trait Carries<const WORDS: usize> {}
impl<V: Coordinate> Carries<3> for BinnedFaces<'_, V, true> {}
impl<V: Coordinate> Carries<0> for BinnedFaces<'_, V, false> {}

impl<'a, V: Coordinate, const DEPTH: bool> BinnedFaces<'a, V, DEPTH> {
    /// Carries faces that continue below a band to the next one: their edges, depth and colour are not computed again. The pixels are
    /// those without a list. S3, a torus of 1000 triangles with depth in bands of 8 rows, takes 1.33 times the instructions of one piece on a
    /// Cortex-M3, 1.62 times without the list.
    ///
    /// `list` holds the faces that continue: with as many entries as faces cross the border of two bands, none is set up twice. In bands of 8
    /// rows the torus needs 56, the height field F1 of 64 × 64 vertices 166 with each face in one colour; three times the square root of the number of visible faces is
    /// enough for most meshes. A face that finds no entry is set up again in the next band.
    ///
    /// Carried are faces of one colour, such as a colour or [`Flat`](crate::shading::Flat) without fog, that are at most 32 rows high and not
    /// clipped, drawn into the `pixels()` of bands that follow each other from top to bottom. All others are set up in each band. On a Cortex-M0 no face is
    /// carried. The closure that shades a face is called in the first band that the face lies in, and in further bands unless the face is
    /// carried into them: a carried face keeps its colour.
    ///
    /// A band below a gap, above the last one, or of other columns begins again at the top of the bins, with an empty list: the pixels
    /// are right, and each face is set up again. For two cores, [fork](Self::fork) first: each fork takes a list of its own. [`depth_only`](Self::depth_only)
    /// is for faces without a list.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
    /// use pinhole::{draw::ActiveFace, meshes::TORUS, prelude::*, Angle};
    /// let mut display = MockDisplay::<Rgb565>::new();
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let sphere = TORUS.bounding_sphere();
    /// let camera = Camera::framing(&sphere, &viewport, Angle::degrees(40), Angle::degrees(30), Angle::degrees(20))?;
    /// let mut buffers = mesh_buffers!(TORUS);
    /// let mut strip = strip_buffers!(Rgb565, 64, 8);
    /// let mut list = [ActiveFace::EMPTY; 40];
    /// let instance = camera.place(&TORUS, &Affine::identity());
    /// let faces = instance.transform_depth(&mut buffers.cache).bin_faces(&mut buffers.bins)?;
    /// let mut faces = faces.with_active_faces(&mut list);
    /// let mut frame = Frame::new(display.bounding_box(), Rgb565::BLACK);
    /// while let Some(mut band) = frame.next_band(&mut strip.colors)? {
    ///     let mut depth = DepthBuffer::new(band.area(), &mut strip.depths)?;
    ///     faces.draw(|_| Rgb565::CSS_GOLD, &mut band.pixels().depth_tested(&mut depth))?;
    ///     band.send(&mut display)?;
    /// }
    /// assert!(faces.statistics().drawn > 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(always)]
    pub fn with_active_faces<C: PixelColor, const WORDS: usize>(
        self,
        list: &'a mut [ActiveFace<C, WORDS>],
    ) -> BinnedFaces<'a, V, DEPTH, ActiveFaces<'a, C, WORDS>>
    where
        Self: Carries<WORDS>,
    {
        BinnedFaces { binned: self.binned, list: ActiveFaces::new(list) }
    }
}

impl<C: PixelColor, const WORDS: usize> FaceList<C> for ActiveFaces<'_, C, WORDS> {
    #[inline(never)]
    fn draw_solid<V: Coordinate, T: Surface<Color = C>, S: ShaderFor<T>, const DEPTH: bool>(
        faces: &mut BinnedFaces<'_, V, DEPTH, Self>,
        shade: impl FnMut(usize) -> S,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let carries = WORDS == 0 && is_carried::<C, S>() && carried::has_memory(band);
        let region = faces.advance_list(&band.area(), None, carries);
        faces.each_carried::<_, _, false>(&region, carries, shade, band, None)
    }

    #[inline(never)]
    fn draw_depth_tested<V: Coordinate, T: Surface<Color = C>, S: ShaderFor<T>, const DEPTH: bool>(
        faces: &mut BinnedFaces<'_, V, DEPTH, Self>,
        shade: impl FnMut(usize) -> S,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        let mut target = DepthTarget::new(depth, band);
        let carries =
            is_carried::<C, S>() && S::WRITES_DEPTH && target.is_aligned && carried::has_memory(band);
        let region = faces.advance_list(&band.area(), Some(target.buffer), carries);
        faces.each_carried::<_, _, true>(&region, carries, shade, band, Some(&mut target))
    }
}

impl<C: PixelColor, V: Coordinate, const DEPTH: bool, const WORDS: usize>
    BinnedFaces<'_, V, DEPTH, ActiveFaces<'_, C, WORDS>>
{
    /// Activates the faces that begin in a band. Unless the band lies directly below the last one and has its columns, begins again at the
    /// top of the bins: the list has no face then. `carries`: faces can be carried into this band.
    #[inline(never)] // one copy for all draw calls
    fn advance_list(
        &mut self,
        band: &Rectangle,
        depth: Option<&DepthBuffer<'_>>,
        carries: bool,
    ) -> DrawRegion {
        let Self { binned, list } = self;
        let region = DrawRegion::shared(band, binned.transformed.instance.area(), depth);
        let Scissor { left, top, right, .. } = region.scissor;
        if region.scissor.is_empty() {
            return region;
        }
        let continues = list.below.is_some_and(|[l, r, row]| l == left && r == right && row == top);
        if !(continues && (carries || list.first == NONE)) {
            list.clear();
            binned.bins.restart();
        }
        list.below = None; // until the band is drawn
        binned.bins.advance_to_band(&region.scissor.rows());
        region
    }

    #[inline(always)]
    fn each_carried<T: Surface<Color = C>, S: ShaderFor<T>, const TESTED: bool>(
        &mut self,
        region: &DrawRegion,
        carries: bool,
        mut shade: impl FnMut(usize) -> S,
        band: &mut T,
        mut depth: Option<&mut DepthTarget<'_, '_>>,
    ) -> Result<(), T::Error> {
        let Self { binned: Binned { transformed: mesh, bins, .. }, list } = self;
        let (scissor, mesh) = (&region.scissor, *mesh);
        if scissor.is_empty() {
            return Ok(());
        }
        let faces = mesh.instance.mesh().faces;
        let (mut cursor, mut triangle) = (list.cursor(), DepthTriangle::new(&region.viewport));
        each_active(bins.active(), |index| {
            let number = index as u16; // fewer than 65535 faces
            if cursor.face < number {
                list.continue_to(number, &mut cursor, scissor, depths_of(&mut depth), band);
            }
            let (Some(face), mut own) = (faces.get(index), None) else { return Ok(true) };
            if carries && let Some(corners) = mesh.on_screen(face) {
                let area = area::<DEPTH>(&corners);
                let corners = mesh.unpack(corners);
                triangle.triangle.set(map3(corners, |corner| corner.point), area);
                if WORDS != 0 {
                    triangle.depths = map3(corners, |corner| corner.depth);
                }
                let [a, b, c] = &triangle.triangle.corners;
                let first_row = (a.y.min(b.y).min(c.y) + 127) >> 8;
                if first_row >= scissor.bottom {
                    return Ok(false);
                }
                if first_row >= scissor.top {
                    let shader = shade(index);
                    own = Some(shader);
                    if let Some(color) = solid_color::<T, S>(&shader) {
                        let entry = list.entries.get_mut(usize::from(list.free));
                        let (has_room, entry) = (entry.is_some(), entry.map(|entry| &mut entry.carried));
                        match carried::begin(entry, &triangle, color, scissor, depths_of(&mut depth), band) {
                            Rest::Nothing => return Ok(true),
                            Rest::Carried if has_room => {
                                list.insert(&mut cursor, number);
                                return Ok(true);
                            }
                            Rest::Carried => return Ok(false),
                            Rest::Declined => {}
                        }
                    }
                }
            }
            draw_face::<_, _, _, DEPTH, TESTED>(&mesh, region, index, own, &mut shade, band, &mut depth)
        })?;
        list.continue_to(NONE, &mut cursor, scissor, depths_of(&mut depth), band);
        list.below = Some([scissor.left, scissor.right, scissor.bottom]);
        Ok(())
    }
}

/// Whether faces of a shader can be carried: not if its colour depends on depth or w, as in fog.
const fn is_carried<C: PixelColor, S: SpanShader<C>>() -> bool {
    S::Ink::IS_OPAQUE && !S::NEEDS_DEPTH && !S::NEEDS_W
}

/// The depths of a depth buffer, or none.
#[inline(always)]
fn depths_of<'d>(depth: &'d mut Option<&mut DepthTarget<'_, '_>>) -> &'d mut [u16] {
    match depth {
        Some(depth) => depth.buffer.values_mut(),
        None => &mut [],
    }
}

/// Sets a face up, and draws what lies of it in a band. Returns whether it ends there. `own`: its shader, if it is known.
#[cold]
#[inline(never)]
fn draw_face<V: Coordinate, T: Surface, S: ShaderFor<T>, const DEPTH: bool, const TESTED: bool>(
    mesh: &TransformedMesh<'_, V, DEPTH>,
    DrawRegion { scissor, viewport }: &DrawRegion,
    index: usize,
    own: Option<S>,
    shade: &mut impl FnMut(usize) -> S,
    band: &mut T,
    depth: &mut Option<&mut DepthTarget<'_, '_>>,
) -> Result<bool, T::Error> {
    let (mut ends, rows) = (true, scissor.rows());
    each_face(PartOrder(index..index + 1), &mut BinnedVertices(*mesh), viewport, |_, face, triangles| {
        let bounds = triangles.fan.bounds().rows();
        ends = bounds.end <= rows.end;
        if bounds.start < rows.end && bounds.end > rows.start {
            let shader = own.unwrap_or_else(|| shade(index));
            draw_triangles(mesh.instance, face, triangles, &shader, |triangle, shader| match depth {
                Some(depth) if TESTED => fill_nearer(triangle, shader, scissor, IN_BAND, depth, band),
                None if TESTED => Ok(()), // never
                _ => fill(&triangle.triangle, shader, scissor, IN_BAND, band),
            })?;
        }
        Ok(true)
    })?;
    Ok(ends)
}

// Colours are not printed: they need not implement `Format`.
defmt_format!([C, const WORDS: usize] ActiveFace<C, WORDS>, self, "active face {=u16}", self.face);

defmt_format!([C, const WORDS: usize] ActiveFaces<'_, C, WORDS>, self, "a list of {=usize} active faces", self.entries.len());

/// The figures of the documentation.
#[cfg(target_pointer_width = "32")]
const _: () = {
    use embedded_graphics_core::pixelcolor::Rgb565;
    assert!(size_of::<ActiveFace<Rgb565, 0>>() == 36 && size_of::<ActiveFace<Rgb565>>() == 48);
};
