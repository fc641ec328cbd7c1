//! Smoothing: pixels that an edge crosses are mixed with their neighbours beyond it.

use super::inside;
use super::memory::{Gives, PixelStore};
use super::target::{DepthTestedSurface, Surface};
use crate::color::{Color, Mixer, Reads, StoredPixel};
use crate::math::hints::opaque;
use crate::raster::{share, CrossedEdge, PixelLayout, Scissor, Window};
use core::marker::PhantomData;
use embedded_graphics_core::primitives::Rectangle;

/// A pass of smoothing: each edge mixes pairs of neighbours. The first pass mixes neighbours in a row and, along creases, neighbours in a column of
/// which the upper one has an even row; the second pass, along creases and silhouettes, those of which it has an odd row; the third pass, along
/// silhouettes, those of which it has an even row. So no pass mixes a row with both of the rows beside it, and the picture does not depend on the bands
/// in which it is made (the zebra order of line relaxation). [`smooth`](DepthTestedSurface::smooth) makes the passes.
#[derive(Debug)]
pub struct SmoothPass<'p, C, Cell> {
    pub(super) cells: &'p mut [Cell],
    pub(super) layout: PixelLayout,
    pub(super) depths: &'p [u16],
    pub(super) depth_layout: PixelLayout,
    /// The pixels that this pass may change. Of a band: the new rows in the first pass, all in the second, those that do not wait in the third.
    pub(super) pixels: Scissor,
    /// The number of the pass: 0 to 2.
    pub(super) number: usize,
    pub(super) color: PhantomData<C>,
}

/// Which pixels of an edge are smoothed. Gradients are the changes of depth per pixel of the minor axis, in 2⁻⁸ step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Of the faces with the smaller and the larger minor coordinates; of a side where no face is drawn any number that was a gradient.
    pub(crate) gradients: [i32; 2],
    pub(crate) kind: SeenKind,
}

/// Where an edge is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SeenKind {
    /// Beyond a silhouette whose face has the smaller minor coordinates: where the pixel on the near side belongs to the face; or does not hide it, as
    /// beside a face thinner than a pixel, and the one on the far side is at least as far as the edge.
    Low,
    /// Beyond a silhouette whose face has the larger minor coordinates.
    High,
    /// Along a crease: where both pixels belong to their faces.
    Crease,
}

impl<S: Surface> DepthTestedSurface<'_, '_, S> {
    /// Smooths the edges of a picture that is drawn, with its depths: `edges` is called once for each of three
    /// passes, and hands it to the [edges](crate::draw::SmoothEdges::draw) of all objects. [`SmoothEdges`](crate::draw::SmoothEdges) has an example. In
    /// bands [`SmoothFrame`](crate::bands::SmoothFrame) does so.
    ///
    /// The target is one whose pixels lie in memory, such as [`picture.pixels()`](crate::target::Picture::pixels): a display or the `Picture` itself does not
    /// compile. With a colour of two values `cargo build` stops (`cargo check` does not).
    pub fn smooth(
        &mut self,
        mut edges: impl FnMut(&mut SmoothPass<'_, S::Color, <S::Store as PixelStore>::Cell>),
    ) where
        S::Color: Color,
        S::Store: Gives<Reads>,
    {
        let (depths, Rectangle { top_left, size }) = (self.depth.values(), self.depth.area());
        let depth_layout = PixelLayout::new(top_left.x, top_left.y, size.width as usize);
        let pixels = inside(&self.surface.area()).clipped_to(&self.depth.scissor());
        let Some(memory) = self.surface.memory() else { return };
        let (drawable, rows) = memory.split();
        let pixels = pixels.clipped_to(drawable);
        let (cells, scratch) = rows.parts();
        for number in 0..3 {
            let (layout, color) = (scratch.layout, PhantomData);
            edges(&mut SmoothPass { cells, layout, depths, depth_layout, pixels, number, color });
        }
    }
}

impl<C: StoredPixel<Cell> + Color, Cell: Copy> SmoothPass<'_, C, Cell> {
    /// The pixels that are smoothed by this pass.
    pub(crate) fn pixels(&self) -> Scissor {
        self.pixels
    }

    /// The number of the pass: 0 to 2.
    pub(crate) fn number(&self) -> usize {
        self.number
    }

    /// How to smooth edges that are tall, or wide.
    pub(crate) fn axes(&self, scissor: &Scissor, is_tall: bool) -> Axes {
        let Self { layout, depth_layout, number, .. } = *self;
        let [layout, depth_layout] = [layout, depth_layout].map(|layout| Along::new(layout, is_tall));
        Axes { window: Window::new(scissor, is_tall, number as i32 & 1), layout, depth_layout }
    }

    /// Smooths an edge.
    #[inline(never)]
    pub(crate) fn edge(&mut self, edge: &CrossedEdge, seen: &Seen, axes: &Axes) {
        const {
            assert!(
                C::FORMAT.bits() > 1,
                "edges cannot be smoothed with two colors: use a color of more bits"
            )
        };
        let Some(columns) = edge.columns_within(&axes.window) else { return };
        let (mask, beyond, planes) = (opaque(C::MASK), axes.depth_layout.minor, Planes::new(seen));
        // The depths of the first pixels of pairs, and of the second ones, by the index of the first one.
        let Some(count) = self.depths.len().checked_sub(beyond) else { return };
        let (Some(lows), Some(highs)) = (self.depths.get(..count), self.depths.get(beyond..)) else { return };
        let (near, far) = if seen.kind == SeenKind::High { (highs, lows) } else { (lows, highs) };
        edge.each_pair(columns, &axes.window, |pair| {
            let (at, depth) = (axes.depth_layout.at(pair.major, pair.minor), edge.depth(pair.major));
            let (Some(&near), Some(&far)) = (near.get(at), far.get(at)) else { return };
            let [near, far] = [near, far].map(|step| (i32::from(step) << 8) - depth);
            if !planes.are_seen(pair.offset, near, far) {
                return;
            }
            let shares = edge.shares(&pair).map(|area| share(area, C::SHARE_BITS));
            let at = axes.layout.at(pair.major, pair.minor);
            let beyond = at.wrapping_add(axes.layout.minor);
            if let (Some(&low), Some(&high)) = (self.cells.get(at), self.cells.get(beyond)) {
                let mixed = C::exchanged([C::load(low), C::load(high)], shares, mask);
                for (at, color) in [at, beyond].into_iter().zip(mixed) {
                    if let Some(cell) = self.cells.get_mut(at) {
                        *cell = color.stored();
                    }
                }
            }
        });
    }
}

/// The pairs that a pass mixes along edges that are tall, or wide.
pub(crate) struct Axes {
    window: Window,
    layout: Along,
    depth_layout: Along,
}

/// Where the pairs of an edge lie in a buffer.
#[derive(Clone, Copy)]
struct Along {
    origin: usize,
    major: usize,
    minor: usize,
}

impl Along {
    #[inline(always)]
    fn new(PixelLayout { stride, origin }: PixelLayout, is_tall: bool) -> Self {
        let (major, minor) = if is_tall { (stride, 1) } else { (1, stride) };
        Self { origin, major, minor }
    }

    /// Index of the first pixel of a pair.
    #[inline(always)]
    fn at(&self, major: i32, minor: i32) -> usize {
        let along = (major as usize).wrapping_mul(self.major);
        (minor as usize).wrapping_mul(self.minor).wrapping_add(along).wrapping_add(self.origin)
    }
}

impl Seen {
    pub(crate) const NONE: Self = Self { gradients: [0; 2], kind: SeenKind::Low };
}

/// The planes of the faces beside an edge: of the one on the near side of a silhouette, and the one on the far side.
struct Planes {
    near: Plane,
    far: Plane,
    /// How far before the plane of a silhouette's face a pixel on the near side may lie, in 2⁻⁸ step: by what the face's depth changes in four pixels. A
    /// pixel of the surface does that continues beyond faces thinner than a pixel, as on a teapot of 64 × 48 pixels. What is nearer still hides the edge.
    reach: i32,
    is_crease: bool,
}

/// The plane through an edge and a face beside it.
struct Plane {
    /// The depth of a pair's pixel less that of the edge, for an edge through the centre of the first pixel, and its change with the distance of the
    /// edge from there: in 2⁻¹⁶ step, by distances in 2⁻⁸ pixel. At most 2²⁹ and 2²¹.
    depth: i32,
    change: i32,
    /// How far off the depth of a pixel of the face may be, in 2⁻⁸ step: two steps, as depths are rounded, and 1/32 of the gradient, as corners are.
    within: i32,
}

impl Planes {
    #[inline(always)]
    fn new(seen: &Seen) -> Self {
        let [low, high] = seen.gradients;
        let within = |gradient: i32| 512 + (gradient.abs() >> 5);
        // Hidden: LLVM would negate the product of each pixel.
        let low = Plane { depth: 0, change: opaque(-low), within: within(low) };
        let high = Plane { depth: high << 8, change: opaque(-high), within: within(high) };
        let (near, far) = if seen.kind == SeenKind::High { (high, low) } else { (low, high) };
        let reach = 512 + 4 * near.change.abs();
        Self { near, far, reach, is_crease: seen.kind == SeenKind::Crease }
    }

    /// Whether an edge is seen between two pixels with these depths less that of the edge: see [`SeenKind`]. `offset`: how far the edge lies beyond the
    /// centre of the first pixel, in 2⁻³² pixel.
    #[inline(always)]
    fn are_seen(&self, offset: u32, near: i32, far: i32) -> bool {
        let offset = (offset >> 24) as i32;
        let behind = |plane: &Plane, depth: i32| depth - ((plane.depth + plane.change * offset) >> 8);
        let own = behind(&self.near, near);
        if own.abs() > self.near.within {
            return !self.is_crease && own >= -self.reach && far >= 0;
        }
        !self.is_crease || behind(&self.far, far).abs() <= self.far.within
    }
}

defmt_format!([C, Cell] SmoothPass<'_, C, Cell>, self, "pass over rows {=i32} to {=i32}", self.pixels.top, self.pixels.bottom);
