//! Lines against depth: those that are nearer, and those that faces do not hide.

use super::{Edges, Limits, Placed, Polygon, Progress, Statistics, Transformed};
use crate::camera::{Corner, Image};
use crate::clip::PLACES;
use crate::math::Coordinate;
use crate::output::{DepthBuffer, Target};
use crate::raster::{self, Along, Piece, Plane, Scissor, ScreenPoint, Triangle};
use crate::scene::Mesh;

use heapless::Vec;

impl<V: Coordinate> Placed<'_, V> {
    /// Draws the mesh's edges where they are as near as what `depth` holds, or nearer, and keeps their
    /// depth there: axes, paths and cages among solid things. Otherwise as
    /// [`wireframe`](Self::wireframe).
    ///
    /// A pixel's depth is that of the line at the pixel's centre along the major axis, within 0.51 of a step for
    /// lines within 512 pixels, beyond within ½ + 2⁻¹³ and 2⁻¹⁷ for every pixel. A line whose two ends lie in one pixel is
    /// tested by its nearer end. Call this after the solid things
    /// were drawn [`depth_tested`](Self::depth_tested) into the same buffer. A line that lies in a face flickers:
    /// use [`hidden_line`](Self::hidden_line) for a solid's own edges.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn wireframe_depth_tested<T: Target>(
        &self,
        colour: T::Color,
        cache: &mut [Corner],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let limits = Limits::shared(&target.area(), self.area(), Some(depth));
        let view = Transformed::<V, true>::new(self, cache);
        view.all_edges(|_, ends| nearer(&ends, colour, &limits.scissor, depth, target))
    }

    /// Draws only the faces' depth: what hides lines. Bit for bit the depth of
    /// [`depth_tested`](Self::depth_tested). [`hidden_line`](Self::hidden_line) has an example.
    #[inline(never)] // its frame is gone when it returns
    pub fn depth_only(&self, cache: &mut [Corner], depth: &mut DepthBuffer<'_>) -> Statistics {
        let limits = Limits::shared(&depth.area(), self.area(), None);
        let view = Transformed::<V, true>::new(self, cache);
        let Ok(statistics) = view.all(
            &limits.viewport,
            |_| Nothing,
            |piece, Nothing| {
                keep(piece, &limits.scissor, depth);
                Ok::<(), core::convert::Infallible>(())
            },
        );
        statistics
    }

    /// Draws those parts of the mesh's edges that no face hides, by the depth that
    /// [`depth_only`](Self::depth_only) left, of this mesh and of others: a wireframe of a solid, on any
    /// target, also of one bit.
    ///
    /// A pixel of an edge is drawn where the edge is at least as near as the buffer, or where the buffer holds one
    /// of the edge's own two faces ([`Mesh::with_edge_faces`](crate::Mesh::with_edge_faces)): a pixel's centre
    /// lies to one side of the edge, and on a steep face its depth differs much. Without the faces beside them,
    /// edges come out dotted: up to half of their pixels are missing. An edge whose two ends lie in one pixel is tested by
    /// its nearer end.
    ///
    /// So nothing is drawn that lies more than two steps behind what is nearest at the pixel's centre, unless
    /// that is a face beside it. Within a pixel of where another face begins to hide an edge, the picture may
    /// differ from what is true at the edge itself: of the pixels where a part of an edge is seen 99.8 % and more
    /// are drawn, and 0.3 % at most of those drawn show a part that is just hidden (`tests/hidden_line.rs`). Where
    /// an edge lies in a face that is not beside it, as that of a box on a floor does, about half of that
    /// edge's pixels go to the floor.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// use pinhole::{
    ///     edge_faces, space::{Model, World}, Affine, Angle, Camera, DepthBuffer, Mesh, Point3, Projection,
    ///     Scalar, Vector3, Viewing, Viewport,
    /// };
    /// const VERTICES: [[i16; 3]; 4] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    /// const FACES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    /// const EDGES: [[u16; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    /// const BESIDE: [[u16; 2]; 6] = edge_faces(&EDGES, &FACES);
    /// let mesh = Mesh::new(&VERTICES, 0, &FACES)?.with_edges(&EDGES)?.with_edge_faces(&BESIDE)?;
    /// let mut display = MockDisplay::<BinaryColor>::new();
    /// # display.set_allow_overdraw(true);
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::new(
    ///     &Viewing::look_at(Point3::from_ints(0, 0, 5), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
    ///     &Projection::perspective(Angle::degrees(45), viewport.size(), Scalar::from_num(1), Scalar::from_num(9))?,
    ///     &viewport,
    /// );
    /// let model = Affine::<Model, World>::rotation_y(Angle::degrees(20));
    /// let placed = camera.place(&mesh, &model);
    /// let mut storage = [0; 64 * 64];
    /// let mut depth = DepthBuffer::new(display.bounding_box(), &mut storage)?;
    /// placed.depth_only(&mut [], &mut depth);
    /// placed.hidden_line(BinaryColor::On, &mut [], &mut depth, &mut display)?;
    /// // The edge at the back is hidden: from (-1, 1, -1) to (1, -1, -1), through the middle.
    /// let lit = |x, y| display.get_pixel(Point::new(x, y)).is_some();
    /// let [from, to] = [2, 1].map(|i| placed.project(i).unwrap().0.pixel());
    /// assert!(lit(from.x.into(), from.y.into()) && lit(to.x.into(), to.y.into()));
    /// assert!(!lit((i32::from(from.x) + i32::from(to.x)) / 2, (i32::from(from.y) + i32::from(to.y)) / 2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn hidden_line<T: Target>(
        &self,
        colour: T::Color,
        cache: &mut [Corner],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let limits = Limits::shared(&target.area(), self.area(), Some(depth));
        let view = Transformed::<V, true>::new(self, cache);
        view.all_edges(|edge, ends| view.unhidden(edge, &ends, colour, &limits, depth, target))
    }
}

impl<V: Coordinate> Edges<'_, V, true> {
    /// What lies in a band, as [`Placed::wireframe_depth_tested`] draws it.
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
        let limits = self.take_in(&band.area(), Some(depth));
        self.draw_depth_tested(&limits, colour, depth, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while items are taken in
    fn draw_depth_tested<T: Target>(
        &mut self,
        limits: &Limits,
        colour: T::Color,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each(limits, |_, _, ends| nearer(&ends, colour, &limits.scissor, depth, band))
    }

    /// What lies in a band, as [`Placed::hidden_line`] draws it.
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
        let limits = self.take_in(&band.area(), Some(depth));
        self.draw_unhidden(&limits, colour, depth, band)
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while items are taken in
    fn draw_unhidden<T: Target>(
        &mut self,
        limits: &Limits,
        colour: T::Color,
        depth: &mut DepthBuffer<'_>,
        band: &mut T,
    ) -> Result<(), T::Error> {
        self.each(limits, |view, edge, ends| view.unhidden(edge, &ends, colour, limits, depth, band))
    }
}

impl<V: Coordinate> super::Faces<'_, V, true> {
    /// Keeps the depth of what lies in a band and draws nothing: see [`Placed::depth_only`].
    #[inline(always)]
    pub fn depth_only(&mut self, depth: &mut DepthBuffer<'_>) {
        let limits = self.take_in(&depth.area(), None);
        self.keep_depth(&limits, depth);
    }

    #[inline(never)] // its frame is gone when it returns, and is not there while items are taken in
    fn keep_depth(&mut self, limits: &Limits, depth: &mut DepthBuffer<'_>) {
        let Ok(()) = self.each(
            limits,
            |_| Nothing,
            |piece, Nothing| {
                keep(piece, &limits.scissor, depth);
                Ok::<(), core::convert::Infallible>(())
            },
        );
    }
}

impl<V: Coordinate> Transformed<'_, V, true> {
    /// A line, where it is as near as what is held, or a face beside its edge is what is held.
    #[inline(always)]
    fn unhidden<T: Target>(
        &self,
        edge: usize,
        ends: &[Image; 2],
        colour: T::Color,
        limits: &Limits,
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<(), T::Error> {
        let (mut beside, mut first) = (FacesBeside::new(), 0);
        loop {
            let others = self.beside(edge, first, &limits.viewport, &mut beside);
            let is_beside = |held, x, y| beside.iter().any(|face| face.is(held, x, y));
            seen(ends, false, &is_beside, colour, &limits.scissor, depth, target)?;
            if !others {
                return Ok(());
            }
            first += beside.len();
        }
    }

    /// The faces beside an edge, as their depth was kept, piece by piece where they were cut: from this piece on as many as there
    /// is room for. Tells whether there are others. They are made where they stay.
    #[inline(never)]
    fn beside(&self, edge: usize, first: usize, viewport: &Scissor, beside: &mut FacesBeside) -> bool {
        beside.clear();
        let (mesh, mut polygon, mut piece) = (self.placed.mesh, Polygon::new(), 0);
        for &face in mesh.edge_faces().get(edge).into_iter().flatten() {
            // A large mesh has a face of that number, which cannot be named.
            let named = mesh.faces().get(usize::from(face)).filter(|_| face != Mesh::<V>::NO_FACE);
            let Some(face) = named else { continue };
            let (mut progress, mut corners) = (Progress::BEGIN, [Image::ORIGIN; 3]);
            let cut = self.polygon(face, &mut polygon, &mut [(); PLACES]);
            progress.begin(&polygon, self.placed.cull, cut);
            while let Some(area) = progress.next(&polygon, &mut corners) {
                let points = corners.map(|c| c.point);
                if piece >= first {
                    let plane =
                        Plane::of_depth(&Triangle::new(points, area, viewport), &corners.map(|c| c.depth));
                    if beside.push(Beside { points, plane }).is_err() {
                        return true;
                    }
                }
                piece += 1; // fewer than 2·CORNERS
            }
        }
        false
    }
}

/// The faces beside an edge, or pieces of them. Where there are more than these a line is drawn once more: few faces are cut to more
/// than two, and room on the stack is dear.
type FacesBeside = Vec<Beside, 2>;

/// A face beside an edge, or a piece of it.
struct Beside {
    points: [ScreenPoint; 3],
    plane: Plane,
}

impl Beside {
    /// Whether it is what is held at a pixel: of that depth, and there at all, its border included.
    fn is(&self, held: u16, x: i32, y: i32) -> bool {
        (self.plane.at(x, y) >> 16) as u16 == held && {
            let centre = ScreenPoint::inside(x * 256 + 128, y * 256 + 128); // of a pixel of the target
            let [a, b, c] = self.points;
            let sides = [[a, b, centre], [b, c, centre], [c, a, centre]].map(|side| raster::area(&side));
            sides.iter().all(|&side| side >= 0) || sides.iter().all(|&side| side <= 0)
        }
    }
}

/// The ink of what is not drawn.
#[derive(Clone, Copy)]
struct Nothing;

impl super::Ink for Nothing {
    type Carried = ();

    fn piece(&self, _: [(); 3]) -> Self {
        *self
    }
}

fn keep(piece: &Piece<'_>, scissor: &Scissor, depth: &mut DepthBuffer<'_>) {
    let plane = piece.plane();
    for span in piece.triangle.spans(scissor) {
        let Ok(()) = depth.test(span, &plane, |_| Ok::<(), core::convert::Infallible>(()));
    }
}

/// A line, where it is as near as what is held, or nearer; its depth is kept there.
#[inline(always)]
fn nearer<T: Target>(
    ends: &[Image; 2],
    colour: T::Color,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) -> Result<(), T::Error> {
    seen(ends, true, &|_, _, _| false, colour, scissor, depth, target)
}

/// A line, drawn where it is as near as the buffer or `is_drawn_over` says so; with `keeps` its depth is stored.
#[inline(never)] // once for both; asked is only where the line is behind what is held
fn seen<T: Target>(
    ends: &[Image; 2],
    keeps: bool,
    is_drawn_over: &dyn Fn(u16, i32, i32) -> bool,
    colour: T::Color,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let along = Along::new(ends.map(|end| end.point), ends.map(|end| end.depth));
    let [from, to] = ends.map(|end| end.point.pixel());
    raster::line(from, to, scissor, |span| {
        let is_seen = |x, y, held: &mut u16| {
            let own = along.depth(x, y);
            let is_seen = own <= *held || is_drawn_over(*held, x, y);
            if is_seen && keeps {
                *held = own;
            }
            is_seen
        };
        depth.along(span, is_seen, |visible| target.fill(visible, colour))
    })
}
