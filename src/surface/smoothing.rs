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
    /// Whether gradients are known. Most silhouettes need none.
    pub(crate) are_known: bool,
}

/// Where an edge is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SeenKind {
    /// Beyond a silhouette: where the pixel on the far side is at least as far as the edge, or the one on the near side, which has the smaller minor
    /// coordinate, belongs to the face.
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

    /// Smooths an edge from a column on. Returns the column from which on gradients are needed that are not known.
    #[inline(never)]
    pub(crate) fn edge(&mut self, edge: &CrossedEdge, seen: &Seen, axes: &Axes, from: i32) -> Option<i32> {
        const {
            assert!(
                C::FORMAT.bits() > 1,
                "edges cannot be smoothed with two colors: use a color of more bits"
            )
        };
        let [first, last] = edge.columns_within(&axes.window)?;
        let (mask, beyond, planes) = (opaque(C::MASK), axes.depth_layout.minor, Planes::new(seen));
        // The depths of the first pixels of pairs, and of the second ones, by the index of the first one.
        let count = self.depths.len().checked_sub(beyond)?;
        let (lows, highs) = (self.depths.get(..count)?, self.depths.get(beyond..)?);
        let far = if seen.kind == SeenKind::High { lows } else { highs };
        edge.each_pair([first.max(from), last], &axes.window, |pair| {
            let (at, depth) = (axes.depth_layout.at(pair.major, pair.minor), edge.depth(pair.major));
            let step = |depths: &[u16]| depths.get(at).map(|&step| (i32::from(step) << 8) - depth);
            let is_beyond = seen.kind != SeenKind::Crease && step(far).is_some_and(|beyond| beyond >= 0);
            if !is_beyond {
                if !seen.are_known {
                    return false;
                }
                let (Some(low), Some(high)) = (step(lows), step(highs)) else { return true };
                if !planes.fit(pair.offset, [low, high]) {
                    return true;
                }
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
            true
        })
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
    pub(crate) const NONE: Self = Self { gradients: [0; 2], kind: SeenKind::Low, are_known: false };
}

/// The planes of the faces beside an edge, with the smaller and the larger minor coordinates.
struct Planes {
    /// The change of depth per pixel away from the edge, of the face with the smaller and of the face with the larger minor coordinates.
    changes: [i32; 2],
    /// How far off a pixel's depth may be.
    within: [i32; 2],
}

impl Planes {
    #[inline(always)]
    fn new(seen: &Seen) -> Self {
        let [low, high] = seen.gradients;
        // Within two steps, as depths are rounded, and 1/32 of the change per pixel, as corners are. Where no face is drawn, any depth fits.
        let within =
            |gradient: i32, is_drawn: bool| if is_drawn { 512 + (gradient.abs() >> 5) } else { 1 << 30 };
        let within = [within(low, seen.kind != SeenKind::High), within(high, seen.kind != SeenKind::Low)];
        // Hidden: LLVM would negate the product of each pixel.
        Self { changes: [opaque(-low), high], within }
    }

    /// Whether both pixels of a pair, with these depths less that of the edge, belong to the faces. `offset`: how far the edge lies beyond the centre
    /// of the first pixel, in 2⁻³² pixel.
    #[inline(always)]
    fn fit(&self, offset: u32, [low, high]: [i32; 2]) -> bool {
        let ([low_change, high_change], [low_within, high_within]) = (self.changes, self.within);
        let fits = |depth: i32, change: i32, within: i32| {
            let off = depth - (change >> 8);
            (off + within) as u32 <= 2 * within as u32 // |off| ≤ within
        };
        // The pixels' centres lie before and behind the edge. Products of 2²¹ · 2⁸ at most.
        let offset = (offset >> 24) as i32;
        fits(low, low_change * offset, low_within) && fits(high, high_change * (256 - offset), high_within)
    }
}

defmt_format!([C, Cell] SmoothPass<'_, C, Cell>, self, "pass over rows {=i32} to {=i32}", self.pixels.top, self.pixels.bottom);
