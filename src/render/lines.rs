//! Lines against depth: those that are nearer, and those that faces do not hide.

use super::{pieces, Edges, Outcome, Placed, Statistics, Transformed, Window};
use crate::camera::{Corner, Image};
use crate::clip::CORNERS;
use crate::math::Coordinate;
use crate::output::{send, DepthBuffer};
use crate::raster::{self, Along, Plane, Scissor, ScreenPoint, Span, Triangle};
use embedded_graphics_core::draw_target::DrawTarget;
use heapless::Vec;

impl<V: Coordinate> Placed<'_, V> {
    /// Draws the mesh's edges where they are as near as what `depth` holds, or nearer, and keeps their
    /// depth there: axes, paths and cages among solid things. Otherwise as
    /// [`wireframe`](Self::wireframe).
    ///
    /// A pixel's depth is that of the line at the pixel's centre along the major axis, within 0.51 of a step for
    /// lines within 512 pixels, beyond within ½ and 2⁻¹⁷ for every pixel. A line that lies in a face
    /// fights with it: [`hidden_line`](Self::hidden_line) is for the edges of solid meshes.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    pub fn wireframe_depth_tested<D: DrawTarget>(
        &self,
        colour: D::Color,
        cache: &mut [Corner],
        depth: &mut DepthBuffer<'_>,
        target: &mut D,
    ) -> Result<Statistics, D::Error> {
        let window = Window::new(target, &self.area).with_depth(depth);
        let transformed = self.transform_depth(cache);
        transformed.all_edges(|_, ends| nearer(&ends, colour, &window.scissor, depth, target))
    }

    /// Keeps the depth of the faces and draws nothing: what hides lines.
    pub fn depth_only(&self, cache: &mut [Corner], depth: &mut DepthBuffer<'_>) -> Statistics {
        let window = Window::of_depth(depth, &self.area);
        let transformed = self.transform_depth(cache);
        let Ok(statistics) = transformed.all(
            |_| Nothing,
            |corners, area, Nothing| {
                keep(&corners, area, &window, depth);
                Ok::<(), core::convert::Infallible>(())
            },
        );
        statistics
    }

    /// Draws those parts of the mesh's edges that no face hides, by the depth that
    /// [`depth_only`](Self::depth_only) left, of this mesh and of others: a wireframe of a solid, on any
    /// target, also of one bit.
    ///
    /// A pixel of an edge is drawn where the edge is as near as what is held there, or where what is held
    /// is a face beside the edge ([`Mesh::with_edge_faces`](crate::Mesh::with_edge_faces)): the centre of a pixel
    /// lies to one side of the edge, and on a steep face that is far from it in depth. Without the faces
    /// beside them, edges of steep faces come out dotted.
    ///
    /// So nothing is drawn that lies more than two steps behind what is nearest at the pixel's centre, unless
    /// that is a face beside it. Within a pixel of where another face begins to hide an edge, the picture may
    /// differ from what is true at the edge itself: of the pixels where a part of an edge is seen 99.8 % and more
    /// are drawn, and 0.3 % at most of those drawn show a part that is just hidden (`tests/hidden_line.rs`).
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    pub fn hidden_line<D: DrawTarget>(
        &self,
        colour: D::Color,
        cache: &mut [Corner],
        depth: &mut DepthBuffer<'_>,
        target: &mut D,
    ) -> Result<Statistics, D::Error> {
        let window = Window::new(target, &self.area).with_depth(depth);
        let transformed = self.transform_depth(cache);
        transformed.all_edges(|edge, ends| {
            let beside = transformed.beside(edge, &window.viewport);
            unhidden(&ends, &beside, colour, &window.scissor, depth, target)
        })
    }
}

impl<V: Coordinate> Edges<'_, V, true> {
    /// What lies in a band, as [`Placed::wireframe_depth_tested`] draws it.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    pub fn depth_tested<D: DrawTarget>(
        &mut self,
        colour: D::Color,
        depth: &mut DepthBuffer<'_>,
        band: &mut D,
    ) -> Result<(), D::Error> {
        let window = Window::new(band, self.viewport()).with_depth(depth);
        self.each(&window.scissor, |_, _, ends| nearer(&ends, colour, &window.scissor, depth, band))
    }

    /// What lies in a band, as [`Placed::hidden_line`] draws it.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    pub fn hidden_line<D: DrawTarget>(
        &mut self,
        colour: D::Color,
        depth: &mut DepthBuffer<'_>,
        band: &mut D,
    ) -> Result<(), D::Error> {
        let window = Window::new(band, self.viewport()).with_depth(depth);
        self.each(&window.scissor, |transformed, edge, ends| {
            let beside = transformed.beside(edge, &window.viewport);
            unhidden(&ends, &beside, colour, &window.scissor, depth, band)
        })
    }
}

impl<V: Coordinate> super::Faces<'_, V, true> {
    /// Keeps the depth of what lies in a band and draws nothing: see [`Placed::depth_only`].
    pub fn depth_only(&mut self, depth: &mut DepthBuffer<'_>) {
        let window = Window::of_depth(depth, self.viewport());
        let Ok(()) = self.each(
            &window.scissor,
            |_| Nothing,
            |corners, area, Nothing| {
                keep(&corners, area, &window, depth);
                Ok::<(), core::convert::Infallible>(())
            },
        );
    }
}

impl<V: Coordinate> Transformed<'_, V, true> {
    /// The faces beside an edge, as their depth was kept: piece by piece where they were cut.
    fn beside(&self, edge: usize, viewport: &Scissor) -> Vec<Beside, { 2 * (CORNERS - 2) }> {
        let mut all = Vec::new();
        let mesh = &self.placed.mesh;
        let beside = mesh.edge_faces().get(edge).copied().unwrap_or_default();
        if mesh.edge_faces().is_empty() {
            return all;
        }
        let mut add = |corners: [Image; 3], area: i64| {
            let points = corners.map(|c| c.point);
            let plane = Plane::of_depth(&Triangle::new(points, area, viewport), corners.map(|c| c.depth));
            // There is room for the pieces of two faces.
            let _ = all.push(Beside { points, plane });
        };
        for face in beside {
            let Some(&face) = mesh.faces().get(usize::from(face)) else { continue };
            match self.sort_out::<()>(face) {
                Outcome::Whole(corners, area) => add(corners, area),
                Outcome::Cut(corners) => {
                    pieces(&corners).for_each(|(piece, area)| add(piece.map(|c| c.image), area));
                }
                Outcome::Culled | Outcome::Degenerate | Outcome::Outside => {}
            }
        }
        all
    }
}

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

fn keep(corners: &[Image; 3], area: i64, window: &Window, depth: &mut DepthBuffer<'_>) {
    let triangle = Triangle::new(corners.map(|c| c.point), area, &window.viewport);
    let plane = Plane::of_depth(&triangle, corners.map(|c| c.depth));
    let Ok(()) = triangle
        .fill(&window.scissor, |span| depth.test(span, &plane, |_| Ok::<(), core::convert::Infallible>(())));
}

/// A line, where it is as near as what is held, or nearer.
fn nearer<D: DrawTarget>(
    ends: &[Image; 2],
    colour: D::Color,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
    target: &mut D,
) -> Result<(), D::Error> {
    trace(ends, scissor, |span, along| {
        let is_seen = |x, y, held: &mut u16| {
            let own = along.depth(x, y);
            let is_seen = own <= *held;
            if is_seen {
                *held = own;
            }
            is_seen
        };
        depth.along(span, is_seen, |visible| send(target, visible, colour))
    })
}

/// A line, where it is as near as what is held, or a face beside it is what is held.
fn unhidden<D: DrawTarget>(
    ends: &[Image; 2],
    beside: &[Beside],
    colour: D::Color,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
    target: &mut D,
) -> Result<(), D::Error> {
    trace(ends, scissor, |span, along| {
        let is_seen = |x, y, held: &mut u16| {
            along.depth(x, y) <= *held || beside.iter().any(|face| face.is(*held, x, y))
        };
        depth.along(span, is_seen, |visible| send(target, visible, colour))
    })
}

/// The runs of a line, with the depth along it.
fn trace<E>(
    ends: &[Image; 2],
    scissor: &Scissor,
    mut draw: impl FnMut(Span, &Along) -> Result<(), E>,
) -> Result<(), E> {
    let along = Along::new(ends.map(|end| end.point), ends.map(|end| end.depth));
    let [from, to] = ends.map(|end| end.point.pixel());
    raster::line(from, to, scissor, |span| draw(span, &along))
}
