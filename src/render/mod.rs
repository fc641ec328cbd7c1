//! The pipeline on one page.
//!
//! 1. [`Camera::place`] folds model, viewing, projection and viewport into integer forms, once per
//!    object.
//! 2. Every vertex goes through them to the screen, once, into the caller's corners; those that
//!    need clipping are marked.
//! 3. Faces are sorted out: turned away, without area, outside, whole, or cut (and then clipped in
//!    homogeneous coordinates and taken as a fan).
//! 4. What is left is rasterised span by span into the DrawTarget: as edges
//!    ([`Placed::wireframe`]), as faces in the mesh's order ([`Placed::solid`]), from far to near
//!    ([`Painter`]), or where they are nearer than a depth buffer says ([`Placed::depth_tested`]).

mod painter;
mod path;
mod statistics;

pub use painter::{Painter, RecordError};
pub use statistics::Statistics;

use crate::camera::{Camera, Image, Placement};
use crate::clip;
use crate::math::{Affine, Coordinate};
use crate::output::{scissor, send, DepthBuffer};
use crate::raster::{self, DepthPlane, ScreenPoint};
use crate::scene::Mesh;
use crate::space::{Model, World};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::primitives::Rectangle;

/// A mesh placed before a camera, ready to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'m, V = i16> {
    mesh: Mesh<'m, V>,
    placement: Placement,
    area: Rectangle,
    cull: Cull,
}

/// Which faces are left out for the way they turn on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cull {
    /// Those turned away: right for closed meshes.
    #[default]
    Back,
    /// None: both sides show.
    None,
}

/// A vertex's place on the screen: 12 bytes of scratch memory each, given by the caller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Corner {
    point: ScreenPoint,
    /// 16.8, or negative where the vertex has no place at all and the clipper takes over.
    depth: i32,
}

impl Corner {
    /// No place yet: for arrays in statics.
    pub const EMPTY: Self = Self { point: ScreenPoint::ORIGIN, depth: -1 };

    fn whole(&self) -> bool {
        self.depth >= 0
    }
}

impl Default for Corner {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl From<Option<Image>> for Corner {
    #[inline(always)]
    fn from(image: Option<Image>) -> Self {
        match image {
            Some(Image { point, depth }) => Self { point, depth },
            None => Self::EMPTY,
        }
    }
}

/// What becomes of a face.
enum Outcome {
    Culled,
    Degenerate,
    Outside,
    /// All corners as they are; whether it faces the viewer.
    Whole([Corner; 3], bool),
    /// What the planes leave, as a fan, and whether they took anything: the vertex loop sends more
    /// here than the planes cut.
    Cut(heapless::Vec<Corner, { clip::CORNERS }>, bool),
}

impl Camera {
    /// The mesh before this camera. All that depends on the object but not on its vertices is
    /// computed here, in integers.
    pub fn place<'m, V: Coordinate>(
        &self,
        mesh: &Mesh<'m, V>,
        model: &Affine<Model, World>,
    ) -> Placed<'m, V> {
        let placement = Placement::new(self, model, mesh.exponent().into(), mesh.justify());
        Placed { mesh: *mesh, placement, area: self.area(), cull: Cull::Back }
    }
}

impl<'m, V: Coordinate> Placed<'m, V> {
    /// Draws other faces than the front ones.
    #[must_use]
    pub fn with_cull(self, cull: Cull) -> Self {
        Self { cull, ..self }
    }

    /// The mesh that was placed.
    pub const fn mesh(&self) -> &Mesh<'m, V> {
        &self.mesh
    }

    /// Where vertex `index` lies on the screen, and its depth (0 near … 65534 far). `None` when
    /// there is no such vertex, or it lies in front of the near plane or outside the guard band
    /// (and beyond the far plane, where the camera clips there).
    ///
    /// Within 1/256 px of the exact image of the quantised input, the rounding to 1/256 px
    /// included, for objects whose half extent is at most 300 times the vertex's distance;
    /// beyond, within `1/512 + 6.5·10⁻⁶ · extent/distance` px, for 480 × 320 pixels and focal lengths up
    /// to 700 px; ARCHITECTURE.md has the formula for all others. Depth is within 1 of
    /// `65535·(z/w + 1)/2` there, where far is at least twice near: what rounding costs grows as
    /// far/(far − near).
    pub fn project(&self, index: usize) -> Option<(ScreenPoint, u16)> {
        let vertex = *self.mesh.vertices().get(index)?;
        let image = match self.placement.project::<V, true>(vertex) {
            Some(image) => image,
            None => {
                let h = self.placement.clip(vertex);
                if (0..self.placement.planes()).any(|i| self.placement.distance(i, &h) < 0) {
                    return None;
                }
                self.placement.image(&h)
            }
        };
        Some((image.point, image.step()))
    }

    /// Where vertex `index` lies before its place is rounded to 1/256 px: x and y in 2⁻³² px, and depth
    /// in 2⁻³² of its 65536 steps, not cut off at either end. For measuring. `None` when there is no
    /// such vertex, or it lies in front of the near plane; what is beyond ±2³⁰ saturates.
    pub fn project_unsnapped(&self, index: usize) -> Option<[i64; 3]> {
        let vertex = *self.mesh.vertices().get(index)?;
        let h = self.placement.clip(vertex);
        (h.d >= 0 && h.w > 0).then(|| self.placement.unsnapped(&h))
    }

    /// Draws the mesh's edges, each as a Bresenham line of one colour. Pixels of a clipped edge are
    /// those of the whole edge; the near plane's and the guard band's cuts are rounded to 1/256 px.
    ///
    /// `cache` holds transformed vertices; one as long as the vertex list computes each once, a
    /// shorter one (even an empty one) computes the rest whenever an edge needs them. The picture
    /// is the same.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    pub fn wireframe<D: DrawTarget>(
        &self,
        colour: D::Color,
        cache: &mut [Corner],
        target: &mut D,
    ) -> Result<Statistics, D::Error> {
        let scissor = scissor(target, &self.area);
        let mut statistics = Statistics::default();
        self.transform::<false>(cache);
        for &[a, b] in self.mesh.edges() {
            let (from, to) = (self.corner::<false>(cache, a), self.corner::<false>(cache, b));
            let (from, to) = if from.whole() && to.whole() {
                (from.point, to.point)
            } else {
                match self.cut_edge(a, b) {
                    Some((ends, cut)) => {
                        statistics.clipped += u32::from(cut);
                        ends
                    }
                    None => {
                        statistics.outside += 1;
                        continue;
                    }
                }
            };
            statistics.drawn += 1;
            raster::line(from.pixel(), to.pixel(), &scissor, |span| send(target, span, colour))?;
        }
        Ok(statistics)
    }

    /// Draws the faces in the mesh's order, one colour each: right for convex meshes, where front
    /// faces never hide each other; [`Painter`] draws the others. `shade` gives face `i` its
    /// colour, and is asked once for each face drawn. `cache` is as in
    /// [`wireframe`](Self::wireframe).
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    pub fn solid<D: DrawTarget>(
        &self,
        shade: impl FnMut(usize) -> D::Color,
        cache: &mut [Corner],
        target: &mut D,
    ) -> Result<Statistics, D::Error> {
        let scissor = scissor(target, &self.area);
        self.faces::<false, _, _>(cache, shade, |corners, front, colour| {
            raster::fill(corners.map(|c| c.point), front, &scissor, |span| send(target, span, colour))
        })
    }

    /// Draws the faces, one colour each, where they are nearer than what `depth` holds: right for all
    /// meshes, also those that pierce each other. `shade` gives face `i` its colour, and is asked once
    /// for each face drawn. `cache` is as in [`wireframe`](Self::wireframe).
    ///
    /// A pixel's depth is that of the plane through the face's corners at the pixel's centre, in steps
    /// of 65536 that are linear on the screen, 0 near to 65534 far: within 0.54 of a step for faces
    /// within 512 pixels, for larger ones within ½ and 2⁻¹⁷ for every column and row of the target. (A
    /// face that reaches the far plane, whose 65535 stands for nothing, is drawn half a step nearer
    /// there: within 1.1.) So faces two steps apart are told apart; of equal depths the first drawn
    /// stays. Depth ends at the far plane: what lies beyond is cut off, whether or not the camera asks
    /// for that. Nothing is drawn outside the depth buffer.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*, primitives::Rectangle};
    /// use pinhole::{
    ///     space::{Model, World}, Affine, Angle, Camera, Cull, DepthBuffer, Mesh, Point3, Projection,
    ///     Scalar, Vector3, Viewing, Viewport,
    /// };
    /// // Two triangles through each other: one upright, one lying.
    /// const VERTICES: [[i16; 3]; 6] = [[-9, -9, 0], [9, -9, 0], [0, 9, 0], [-9, 0, 9], [9, 0, 9], [0, 0, -9]];
    /// let mesh = Mesh::new(&VERTICES, -3, &[[0, 1, 2], [3, 4, 5]])?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
    /// let camera = Camera::new(
    ///     &Viewing::look_at(Point3::from_ints(0, 2, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
    ///     &Projection::perspective(Angle::degrees(40), viewport.size(), Scalar::from_num(1), Scalar::from_num(9))?,
    ///     &viewport,
    /// );
    /// let mut display = MockDisplay::<Gray8>::new();
    /// display.set_allow_overdraw(true);
    /// let mut storage = [0; 32 * 32];
    /// let area = Rectangle::new(Point::zero(), viewport.size());
    /// let mut depth = DepthBuffer::new(area, &mut storage)?;
    /// let model = Affine::<Model, World>::identity();
    /// camera.place(&mesh, &model).with_cull(Cull::None).depth_tested(
    ///     |face| Gray8::new(100 + face as u8),
    ///     &mut [],
    ///     &mut depth,
    ///     &mut display,
    /// )?;
    /// let seen = |x, y| display.get_pixel(Point::new(x, y)).map(|c| c.luma());
    /// assert_eq!((seen(16, 20), seen(16, 10)), (Some(101), Some(100))); // in front of it, and behind
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    pub fn depth_tested<D: DrawTarget>(
        &self,
        shade: impl FnMut(usize) -> D::Color,
        cache: &mut [Corner],
        depth: &mut DepthBuffer<'_>,
        target: &mut D,
    ) -> Result<Statistics, D::Error> {
        let placed = Self { placement: self.placement.with_far_clip(), ..*self };
        let scissor = scissor(target, &self.area).and(&depth.scissor());
        placed.faces::<true, _, _>(cache, shade, |corners, front, colour| {
            let points = corners.map(|c| c.point);
            let plane = DepthPlane::new(points, corners.map(|c| c.depth), &scissor);
            raster::fill(points, front, &scissor, |span| {
                depth.test(span, &plane, |visible| send(target, visible, colour))
            })
        })
    }

    /// Step 3 and 4 for all faces: `draw` gets triangles of non-zero area, whether they turn
    /// counter-clockwise, and their face's colour.
    #[inline(always)]
    fn faces<const DEPTH: bool, C: Copy, E>(
        &self,
        cache: &mut [Corner],
        mut shade: impl FnMut(usize) -> C,
        mut draw: impl FnMut([Corner; 3], bool, C) -> Result<(), E>,
    ) -> Result<Statistics, E> {
        let mut statistics = Statistics::default();
        self.transform::<DEPTH>(cache);
        for (index, &face) in self.mesh.faces().iter().enumerate() {
            let outcome = self.sort_out::<DEPTH>(cache, face);
            statistics.count(&outcome);
            match outcome {
                Outcome::Whole(corners, front) => draw(corners, front, shade(index))?,
                Outcome::Cut(corners, _) => {
                    let colour = shade(index);
                    for piece in pieces(&corners) {
                        draw(piece, true, colour)?;
                    }
                }
                Outcome::Culled | Outcome::Degenerate | Outcome::Outside => {}
            }
        }
        Ok(statistics)
    }

    /// Fills the cache from the start of the vertex list.
    fn transform<const DEPTH: bool>(&self, cache: &mut [Corner]) {
        for (corner, &vertex) in cache.iter_mut().zip(self.mesh.vertices()) {
            *corner = self.placement.project::<V, DEPTH>(vertex).into();
        }
    }

    #[inline(always)]
    fn corner<const DEPTH: bool>(&self, cache: &[Corner], index: u16) -> Corner {
        match cache.get(usize::from(index)) {
            Some(corner) => *corner,
            None => self.uncached::<DEPTH>(index),
        }
    }

    #[cold]
    fn uncached<const DEPTH: bool>(&self, index: u16) -> Corner {
        let vertex = self.mesh.vertices().get(usize::from(index)); // checked by Mesh: always there
        vertex.and_then(|&v| self.placement.project::<V, DEPTH>(v)).into()
    }

    /// The vertex in clip space; the indices were checked by [`Mesh`].
    fn clip_vertex(&self, index: u16) -> Option<crate::math::Homogeneous> {
        self.mesh.vertices().get(usize::from(index)).map(|&v| self.placement.clip(v))
    }

    /// The ends of what the planes leave of an edge, and whether they took anything.
    #[cold]
    fn cut_edge(&self, a: u16, b: u16) -> Option<((ScreenPoint, ScreenPoint), bool)> {
        let placement = &self.placement;
        let whole = (self.clip_vertex(a)?, self.clip_vertex(b)?);
        let (a, b) = clip::line_at(whole.0, whole.1, placement.planes(), |i, p| placement.distance(i, p))?;
        Some(((placement.image(&a).point, placement.image(&b).point), (a, b) != whole))
    }

    #[cold]
    fn cut_face(&self, [a, b, c]: [u16; 3]) -> Outcome {
        let placement = &self.placement;
        let (Some(a), Some(b), Some(c)) = (self.clip_vertex(a), self.clip_vertex(b), self.clip_vertex(c))
        else {
            return Outcome::Outside;
        };
        let polygon = clip::triangle_at([a, b, c], placement.planes(), |i, p| placement.distance(i, p));
        if polygon.len() < 3 {
            return Outcome::Outside;
        }
        let mut corners = heapless::Vec::<Corner, { clip::CORNERS }>::new();
        for point in &polygon {
            let _ = corners.push(Some(placement.image(point)).into()); // as many as the polygon can have
        }
        let area: i64 = fan(&corners).map(|[a, b, c]| raster::area(&[a.point, b.point, c.point])).sum(); // < 7·2⁴⁵
        if area == 0 {
            return Outcome::Degenerate;
        }
        if area < 0 {
            if self.cull == Cull::Back {
                return Outcome::Culled;
            }
            corners.reverse(); // pieces are counter-clockwise from here on
        }
        let outside = |p| clip::outcode(p, placement.planes(), |i, p| placement.distance(i, p)) != 0;
        Outcome::Cut(corners, [a, b, c].iter().any(outside))
    }

    /// Step 3 of the pipeline, for one face.
    #[inline(always)]
    fn sort_out<const DEPTH: bool>(&self, cache: &[Corner], face: [u16; 3]) -> Outcome {
        let corners = face.map(|i| self.corner::<DEPTH>(cache, i));
        let [a, b, c] = corners;
        if !(a.whole() && b.whole() && c.whole()) {
            return self.cut_face(face);
        }
        let area = raster::area(&[a.point, b.point, c.point]);
        if area == 0 {
            Outcome::Degenerate
        } else if area < 0 && self.cull == Cull::Back {
            Outcome::Culled
        } else {
            Outcome::Whole(corners, area > 0)
        }
    }
}

/// The triangles of a convex polygon about its first corner.
fn fan(corners: &[Corner]) -> impl Iterator<Item = [Corner; 3]> + '_ {
    let (first, rest) = corners.split_first().map_or((Corner::default(), &[][..]), |(&f, r)| (f, r));
    rest.windows(2).filter_map(move |pair| match *pair {
        [a, b] => Some([first, a, b]),
        _ => None,
    })
}

/// Those triangles of the fan that face as the polygon does: rounding of the corners may turn a
/// sliver over, which would be drawn on top of its neighbour.
fn pieces(corners: &[Corner]) -> impl Iterator<Item = [Corner; 3]> + '_ {
    fan(corners).filter(|[a, b, c]| raster::area(&[a.point, b.point, c.point]) > 0)
}
