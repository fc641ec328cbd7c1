//! Painter's order: from far to near, over everything recorded.

use super::transformed::project;
use super::{fill, put, Fan, Ink, InkFor, Limits, Outcome, Placed, Statistics, Transformed};
use crate::camera::Corner;
use crate::math::num::keep_rolled;
use crate::math::Coordinate;
use crate::output::Target;
use crate::raster::{self, Piece, Scissor, ScreenPoint, Triangle};

use core::hint::black_box;
use embedded_graphics_core::primitives::Rectangle;
use heapless::Vec;

/// Records faces of any number of placed meshes and draws them from far to near, without a depth
/// buffer.
///
/// Faces are ordered by the mean depth of their corners, in 65536 steps that are linear on the
/// screen; equal ones in the order recorded. Long faces beside short ones, and faces that pierce
/// each other, can come out wrong: that is painter's order. (Newell, Newell and Sancha, *A
/// solution to the hidden surface problem*, 1972, go further.)
///
/// Memory: 8 bytes per corner; 10 bytes and an ink (usually a colour) per face. Meshes are transformed when
/// recorded, each vertex once.
///
/// ```
/// use embedded_graphics::{geometry::{Point, Size}, mock_display::MockDisplay, pixelcolor::Gray8};
/// use pinhole::{
///     space::{Model, World}, Affine, Angle, Camera, Mesh, Painter, Point3, Projection, RecordError,
///     Scalar, Vector3, Viewing, Viewport,
/// };
/// const VERTICES: [[i16; 3]; 3] = [[-1, -1, 0], [1, -1, 0], [0, 1, 0]];
/// const FACES: [[u16; 3]; 1] = [[0, 1, 2]];
/// let mesh = Mesh::new(&VERTICES, 0, &FACES)?;
/// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
/// let camera = Camera::new(
///     &Viewing::look_at(Point3::from_ints(0, 0, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
///     &Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_num(1), Scalar::from_num(9))?,
///     &viewport,
/// );
/// let mut painter = Painter::<Gray8, 6, 2>::new();
/// for (z, luma) in [(0, 80), (-2, 40)] {
///     let model = Affine::<Model, World>::translation(Vector3::from_ints(0, 0, z));
///     painter.add(&camera.place(&mesh, &model), |_face| Gray8::new(luma))?;
/// }
/// assert!(matches!(
///     painter.add(&camera.place(&mesh, &Affine::identity()), |_| Gray8::new(0)),
///     Err(RecordError::Corners { needed: 9, capacity: 6 }),
/// ));
/// let mut display = MockDisplay::new();
/// display.set_allow_overdraw(true);
/// let statistics = painter.draw(&mut display)?;
/// assert_eq!(statistics.drawn, 2);
/// assert_eq!(display.get_pixel(Point::new(16, 16)), Some(Gray8::new(80))); // the nearer one
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Painter<I, const CORNERS: usize, const FACES: usize> {
    corners: Vec<Corner, CORNERS>,
    faces: Vec<Face<I>, FACES>,
    statistics: Statistics,
    /// The viewport drawn into.
    area: Option<Rectangle>,
}

/// Why a mesh was not recorded: nothing of it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum RecordError {
    /// Raise `CORNERS` (65536 at most): every vertex takes one, and every corner of a face that
    /// was cut.
    Corners {
        /// What this mesh would fill.
        needed: usize,
        /// What there is.
        capacity: usize,
    },
    /// Raise `FACES` (65535 at most): every face drawn takes one, and every piece of a face that
    /// was cut.
    Faces {
        /// What this mesh would fill.
        needed: usize,
        /// What there is.
        capacity: usize,
    },
    /// What is recorded already goes into another viewport: draw it first, or take two painters.
    OtherViewport,
}

impl core::fmt::Display for RecordError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Corners { needed, capacity: 65_536 } => {
                write!(f, "{needed} corners, but a painter holds at most 65536: record fewer meshes, or smaller ones")
            }
            Self::Corners { needed, capacity } => {
                write!(f, "{needed} corners for {capacity} places: raise CORNERS")
            }
            Self::Faces { needed, capacity: 65_535 } => {
                write!(
                    f,
                    "{needed} faces, but a painter holds at most 65535: record fewer meshes, or smaller ones"
                )
            }
            Self::Faces { needed, capacity } => {
                write!(f, "{needed} faces for {capacity} places: raise FACES")
            }
            Self::OtherViewport => f.write_str("one painter draws into one viewport at a time"),
        }
    }
}

impl core::error::Error for RecordError {}

/// A triangle to draw.
#[derive(Clone, Copy, Debug)]
struct Face<I> {
    corners: [u16; 3],
    /// 0 far … 65535 near.
    key: u16,
    /// The face to draw after this one.
    next: u16,
    ink: I,
}

/// All that a [`Painter`] recorded, from far to near: `painter.order()`, then `draw` for every band.
#[derive(Clone, Copy, Debug)]
pub struct PaintersOrder<'a, I> {
    corners: &'a [Corner],
    faces: &'a [Face<I>],
    first: u16,
    area: Option<Rectangle>,
    statistics: Statistics,
}

impl<I: Copy> PaintersOrder<'_, I> {
    /// Draws what lies in the target, a band for instance.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn draw<T: Target>(&self, target: &mut T) -> Result<(), T::Error>
    where
        I: InkFor<T::Color>,
    {
        let Some(area) = &self.area else { return Ok(()) };
        let limits = Limits::shared(&target.area(), area, None);
        let mut at = self.first;
        while let Some(face) = self.faces.get(usize::from(at)) {
            let points = face
                .corners
                .map(|i| self.corners.get(usize::from(i)).map_or(ScreenPoint::ORIGIN, |c| c.point()));
            if !Scissor::of(&points).and(&limits.scissor).is_empty() {
                let triangle = Triangle::new(points, raster::area(&points), &limits.viewport);
                fill(&triangle, &face.ink, &limits.scissor, target)?;
            }
            at = face.next;
        }
        Ok(())
    }

    /// What became of the faces.
    pub const fn statistics(&self) -> Statistics {
        self.statistics
    }
}

/// No face: the end of a list.
const NONE: u16 = u16::MAX;

impl<I: Copy, const CORNERS: usize, const FACES: usize> Painter<I, CORNERS, FACES> {
    /// An empty recorder.
    pub const fn new() -> Self {
        Self { corners: Vec::new(), faces: Vec::new(), statistics: Statistics::NONE, area: None }
    }

    /// Forgets what was recorded.
    pub fn clear(&mut self) {
        self.corners.clear();
        self.faces.clear();
        self.statistics = Statistics::default();
        self.area = None;
    }

    /// Records the mesh's visible faces; `shade` gives face `i` its colour, and is asked once for
    /// each face drawn.
    ///
    /// # Errors
    ///
    /// [`RecordError`] when there is no room, or the viewport is another than that of what is
    /// recorded already. Nothing of this mesh is recorded then, and all else still is.
    #[inline(never)] // its frame is gone when it returns
    pub fn add<V: Coordinate>(
        &mut self,
        placed: &Placed<'_, V>,
        mut shade: impl FnMut(usize) -> I,
    ) -> Result<(), RecordError>
    where
        I: Ink,
    {
        if self.corners.is_empty() {
            self.area = Some(*placed.area());
        } else if self.area.as_ref() != Some(placed.area()) {
            return Err(RecordError::OtherViewport);
        }
        let (old_corners, old_faces) = (self.corners.len(), self.faces.len());
        let mut room = Room { corners: old_corners, faces: old_faces };
        room.corners += placed.mesh.vertices().len();
        // Over capacity is reported at the end, with what all of it would need.
        let _ = self.corners.resize_default(room.corners.min(CORNERS));
        let own = self.corners.get_mut(old_corners..).unwrap_or_default();
        project::<V, true>(placed, false, own);
        let own_corners = self.corners.len();
        let mut statistics = Statistics::default();
        let viewport = Scissor::GUARD_BAND; // places alone are asked for
        let (mut fan, mut piece) = (Fan::new(), Piece::new(&viewport));
        // Where corners are not kept, or are being added to.
        let bare = Transformed::<V, true>::with_corners(placed, false, &[]);
        for (index, &face) in placed.mesh.faces().iter().enumerate() {
            // Corners without room are computed anew: the counting goes on.
            let own = self.corners.get(old_corners..own_corners).unwrap_or_default();
            let view = Transformed::<V, true>::with_corners(placed, false, own);
            let kept = view.whole(&face);
            let (outcome, is_drawn) = match kept {
                Some(kept) => {
                    let area = view.area(&kept);
                    put::<true>(&mut piece, &view.images(kept), area);
                    let outcome = placed.cull.turned(area, Outcome::Whole);
                    (outcome, outcome.is_drawn())
                }
                None => {
                    fan.clear();
                    let is_drawn = view.triangle_into(&face, &mut fan, &mut piece);
                    (fan.progress.outcome, is_drawn)
                }
            };
            statistics.count(outcome);
            if !is_drawn {
                continue;
            }
            let ink = shade(index);
            loop {
                let indices = if outcome == Outcome::Whole {
                    face.map(|i| old_corners.wrapping_add(usize::from(i)))
                } else {
                    let first = room.corners;
                    room.corners += 3;
                    for point in piece.triangle.corners() {
                        let _ = self.corners.push(Corner::bare(*point));
                    }
                    [first, first + 1, first + 2]
                };
                let ink = if kept.is_some() { ink } else { fan.ink(&ink) };
                self.record(indices, &piece.depths, &mut room, ink);
                if kept.is_some() || !bare.triangle_into(&face, &mut fan, &mut piece) {
                    break;
                }
            }
        }
        // From here on only the places count; where there is none, no face asks for it.
        let own = self.corners.get_mut(old_corners..own_corners).unwrap_or_default();
        for (index, corner) in own.iter_mut().enumerate() {
            let place = if corner.whole() {
                Some(placed.placement.at::<true>(*corner))
            } else {
                bare.image(index as u16) // fewer than 65537 vertices
            };
            *corner = Corner::bare(place.map_or(ScreenPoint::ORIGIN, |place| place.point));
        }
        let (most_corners, most_faces) = (CORNERS.min(65_536), FACES.min(usize::from(NONE)));
        let error = if room.corners > most_corners {
            RecordError::Corners { needed: room.corners, capacity: most_corners }
        } else if room.faces > most_faces {
            RecordError::Faces { needed: room.faces, capacity: most_faces }
        } else {
            self.statistics = self.statistics.and(statistics);
            return Ok(());
        };
        self.corners.truncate(old_corners);
        self.faces.truncate(old_faces);
        if old_corners == 0 {
            self.area = None;
        }
        Err(error)
    }

    /// Keeps a triangle if there is room, and counts it in any case.
    #[inline(always)]
    fn record(&mut self, indices: [usize; 3], depths: &[i32; 3], room: &mut Room, ink: I) {
        room.faces += 1;
        let [a, b, c] = depths.map(|depth| (depth.unsigned_abs() + 128) >> 8); // to whole steps

        // The mean of three depths of at most 65534: 196602·21845 < 2³², and 21845/2¹⁶ falls short
        // of a third by so little that the order of sums is kept.
        let mean = ((a + b + c) * 21_845) >> 16;
        let _ = self.faces.push(Face {
            // Beyond 65535 the mesh is refused at the end, and these never meet a picture.
            corners: indices.map(|i| i as u16),
            key: !(mean as u16),
            next: NONE,
            ink,
        });
    }

    /// Draws all that was recorded, far to near, and forgets it: also when the target refuses.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn draw<T: Target>(&mut self, target: &mut T) -> Result<Statistics, T::Error>
    where
        I: InkFor<T::Color>,
    {
        let order = self.order();
        let statistics = order.statistics();
        let result = order.draw(target);
        self.clear();
        result.map(|()| statistics)
    }

    /// Puts all that was recorded in order, to be drawn more than once: band by band. What was
    /// recorded stays until it is [cleared](Self::clear).
    ///
    /// ```
    /// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// # use pinhole::{Affine, Angle, Camera, Corner, Frame, Mesh, Painter, Point3, Projection, Scalar, Vector3, Viewing, Viewport};
    /// # let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?.with_edges(&[[0, 1], [1, 2], [2, 0]])?;
    /// # let mut display = MockDisplay::<Gray8>::new();
    /// # let viewport = Viewport::new(Point::zero(), display.size())?;
    /// # let view = Viewing::look_at(Point3::from_ints(0, 0, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?;
    /// # let [near, far] = [1, 9].map(Scalar::from_num);
    /// # let lens = Projection::perspective(Angle::degrees(40), viewport.size(), near, far)?;
    /// # let camera = Camera::new(&view, &lens, &viewport);
    /// # let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
    /// let mut painter = Painter::<Gray8, 3, 1>::new();
    /// painter.add(&camera.place(&mesh, &Affine::identity()), |_| Gray8::WHITE)?;
    /// let order = painter.order();
    /// let mut frame = Frame::new(display.bounding_box(), Gray8::BLACK);
    /// while let Some(mut band) = frame.next_band(&mut strip)? {
    ///     order.draw(&mut band.pixels())?;
    ///     band.send(&mut display)?;
    /// }
    /// assert_eq!((order.statistics().drawn, display.get_pixel(Point::new(32, 32))), (1, Some(Gray8::WHITE)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn order(&mut self) -> PaintersOrder<'_, I> {
        let first = self.sort();
        let (corners, faces) = (self.corners.as_slice(), self.faces.as_slice());
        PaintersOrder { corners, faces, first, area: self.area, statistics: self.statistics }
    }

    /// Links the faces by rising key and gives the first: a radix sort of lists, four digits of
    /// four bits, stable, in time proportional to the number of faces and with no memory beside
    /// the links. (Knuth, *The Art of Computer Programming*, vol. 3, 2nd ed., section 5.2.5.)
    #[inline(never)] // its lists are gone when it returns
    fn sort(&mut self) -> u16 {
        let count = self.faces.len();
        for (i, face) in self.faces.iter_mut().enumerate() {
            keep_rolled();
            // Fewer than 65536 faces: see `add`.
            face.next = if i + 1 < count { (i + 1) as u16 } else { NONE };
        }
        let mut first = if count == 0 { NONE } else { 0 };
        for digit in 0..black_box(4u32) {
            // Four times the same code would be no faster.
            let shift = (4 * digit) & 15;
            // Each digit's list: its first face and its last.
            let mut lists = [(NONE, NONE); 16];
            let mut at = first;
            while let Some(face) = self.faces.get_mut(usize::from(at)) {
                let next = face.next;
                face.next = NONE;
                if let Some((head, tail)) = lists.get_mut(usize::from(face.key >> shift & 15)) {
                    match self.faces.get_mut(usize::from(*tail)) {
                        Some(before) => before.next = at,
                        None => *head = at,
                    }
                    *tail = at;
                }
                at = next;
            }
            first = NONE;
            let mut end = NONE;
            for &(head, tail) in &lists {
                keep_rolled();
                if head == NONE {
                    continue;
                }
                match self.faces.get_mut(usize::from(end)) {
                    Some(before) => before.next = head,
                    None => first = head,
                }
                end = tail;
            }
        }
        first
    }
}

/// What recording would fill, were there room for it all.
struct Room {
    corners: usize,
    faces: usize,
}

#[cfg(feature = "defmt")]
impl<I, const CORNERS: usize, const FACES: usize> defmt::Format for Painter<I, CORNERS, FACES> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let (corners, faces) = (self.corners.len(), self.faces.len());
        defmt::write!(
            f,
            "painter of {=usize}/{=usize} corners, {=usize}/{=usize} faces: {}",
            corners,
            CORNERS,
            faces,
            FACES,
            self.statistics
        );
    }
}

#[cfg(feature = "defmt")]
impl<I> defmt::Format for PaintersOrder<'_, I> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "painter's order of {=usize} faces: {}", self.faces.len(), self.statistics);
    }
}
