//! Smoothing: pixels that an edge crosses are mixed with their neighbours beyond it.

use super::inside;
use super::memory::{Gives, PixelStore};
use super::target::{DepthTestedSurface, Surface};
use crate::color::{Color, Mixer, Reads, StoredPixel};
use crate::raster::{share, CrossedEdge, CrossedPixel, PixelLayout, Scissor, ScreenPoint};
use core::marker::PhantomData;
use core::ops::Range;
use embedded_graphics_core::primitives::Rectangle;

/// A pass of smoothing over every other row: first the even rows, then the odd ones. A pixel is mixed with a neighbour in its own row or in a
/// row of the other pass, so the picture does not depend on the bands in which it is made (the zebra order of line relaxation). [`smooth`](DepthTestedSurface::smooth) makes the passes.
#[derive(Debug)]
pub struct SmoothPass<'p, C, Cell> {
    pub(super) cells: &'p mut [Cell],
    pub(super) layout: PixelLayout,
    pub(super) depths: &'p [u16],
    pub(super) depth_layout: PixelLayout,
    /// The pixels that have a colour and a depth.
    pub(super) pixels: Scissor,
    /// The row above them, which is finished: nothing, or as wide as they are.
    pub(super) above: (&'p [Cell], &'p [u16]),
    /// The rows that are smoothed, of those with the parity of `odd`.
    pub(super) rows: Range<i32>,
    pub(super) odd: i32,
    pub(super) color: PhantomData<C>,
}

/// A corner of a face, with its depth in 16.8.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) point: ScreenPoint,
    pub(crate) depth: i32,
}

/// Which pixels of an edge are smoothed.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Seen {
    /// Beyond a silhouette: the pixel on the far side is at least as far as the edge, or the one on the near side belongs to the face with
    /// this corner. `is_high`: the face has the larger minor coordinates.
    Silhouette { corner: Corner, is_high: bool },
    /// Along a crease: both pixels belong to their faces, whose depths change by these gradients per pixel, of which the second has the larger
    /// minor coordinates.
    Crease([i32; 2]),
}

impl<S: Surface<Color: Color>> DepthTestedSurface<'_, '_, S>
where
    S::Store: Gives<Reads>,
{
    /// Smooths the edges of a picture that is drawn, with its depths: `edges` is called for the even rows and for the odd ones, and passes
    /// each pass to the [edges](crate::draw::SmoothEdges::draw) of all objects. [`SmoothEdges`](crate::draw::SmoothEdges) has an example. In
    /// bands [`SmoothFrame`](crate::bands::SmoothFrame) does so.
    ///
    /// It compiles for targets whose pixels lie in memory and have more than one bit.
    pub fn smooth(
        &mut self,
        mut edges: impl FnMut(&mut SmoothPass<'_, S::Color, <S::Store as PixelStore>::Cell>),
    ) {
        let (values, Rectangle { top_left, size }) = (self.depth.values(), self.depth.area());
        let depth_layout = PixelLayout::new(top_left.x, top_left.y, size.width as usize);
        let pixels = inside(&self.surface.area()).clipped_to(&self.depth.scissor());
        let Some(memory) = self.surface.memory() else { return };
        let (drawable, rows) = memory.split();
        let pixels = pixels.clipped_to(drawable);
        let (cells, scratch) = rows.parts();
        for odd in [0, 1] {
            edges(&mut SmoothPass {
                cells,
                layout: scratch.layout,
                depths: values,
                depth_layout,
                pixels,
                above: (&[], &[]),
                rows: pixels.rows(),
                odd,
                color: PhantomData,
            });
        }
    }
}

impl<C: StoredPixel<Cell> + Color, Cell: Copy> SmoothPass<'_, C, Cell> {
    /// The rows in which an edge that is smoothed by this pass may lie, and whether it is the last pass over them.
    pub(crate) fn rows(&self) -> (Range<i32>, bool) {
        (self.rows.clone(), self.odd == 1)
    }

    /// The pixels that have a colour and a depth.
    pub(crate) fn pixels(&self) -> Scissor {
        self.pixels
    }

    /// Smooths an edge.
    #[inline(never)]
    pub(crate) fn edge(&mut self, edge: &CrossedEdge, seen: Seen, scissor: &Scissor) {
        const {
            assert!(
                C::FORMAT.bits() > 1,
                "edges cannot be smoothed with two colours: use a color of more bits"
            )
        };
        let (columns, rows) =
            (scissor.columns(), self.rows.start.max(scissor.top)..self.rows.end.min(scissor.bottom));
        let (first, last) = edge.columns();
        let mut gradient = None; // of the face at a silhouette, computed at the first pixel that needs it
        if edge.tall {
            let first = first.max(rows.start);
            let first = first + ((first ^ self.odd) & 1);
            edge.each_pixel::<true>([first, last.min(rows.end - 1)], self.odd, |pixel| {
                let [x, y] = [pixel.minor, pixel.major];
                if columns.contains(&x) && columns.contains(&(x + pixel.aside)) {
                    self.mix(pixel, [x, y], [x + pixel.aside, y], edge, seen, &mut gradient);
                }
            });
        } else {
            let within = [first.max(columns.start), last.min(columns.end - 1)];
            let within = edge.columns_between(within, [rows.start, rows.end]);
            // The row above the first one is there, or nothing lies there.
            let top = scissor.top - i32::from(!self.above.0.is_empty());
            edge.each_pixel::<false>(within, self.odd, |pixel| {
                let [x, y] = [pixel.major, pixel.minor];
                let beyond = y + pixel.aside;
                if rows.contains(&y) && beyond >= top && beyond < scissor.bottom {
                    self.mix(pixel, [x, y], [x, beyond], edge, seen, &mut gradient);
                }
            });
        }
    }

    /// Mixes a pixel with its neighbour, if the edge is seen between them.
    #[inline(always)]
    fn mix(
        &mut self,
        pixel: CrossedPixel,
        [x, y]: [i32; 2],
        [beside, beyond]: [i32; 2],
        edge: &CrossedEdge,
        seen: Seen,
        gradient: &mut Option<i32>,
    ) {
        let share = share(pixel.share, C::SHARE_BITS);
        if share == 0 {
            return;
        }
        let own = self.depths.get(self.depth_layout.at(x, y));
        let (theirs, neighbour) = if beyond < self.pixels.top {
            let at = beside.wrapping_sub(self.pixels.left) as usize;
            let (cells, depths) = self.above;
            (depths.get(at), cells.get(at))
        } else {
            (
                self.depths.get(self.depth_layout.at(beside, beyond)),
                self.cells.get(self.layout.at(beside, beyond)),
            )
        };
        let (Some(&own), Some(&theirs), Some(&neighbour)) = (own, theirs, neighbour) else { return };
        if !seen.between(&pixel, own, theirs, edge, gradient) {
            return;
        }
        if let Some(cell) = self.cells.get_mut(self.layout.at(x, y)) {
            *cell = C::load(neighbour).mixer()(C::load(*cell), (1 << C::SHARE_BITS) - share).stored();
        }
    }
}

impl Seen {
    /// Whether the edge is seen between a pixel with this depth and its neighbour.
    #[inline(always)]
    fn between(
        self,
        pixel: &CrossedPixel,
        own: u16,
        theirs: u16,
        edge: &CrossedEdge,
        known: &mut Option<i32>,
    ) -> bool {
        let [own, theirs] = [own, theirs].map(|depth| i32::from(depth) << 8);
        let [at, beyond] = [pixel.offset, pixel.offset + (pixel.aside << 8)];
        // Within two steps, as depths are rounded, and an eighth of the change per pixel, as corners are.
        let fits = |depth: i32, gradient: i32, offset: i32| {
            let off = depth - pixel.depth - ((gradient * offset) >> 8); // 2²¹ · 2¹⁰
            off.abs() <= 512 + (gradient.abs() >> 3)
        };
        match self {
            Self::Silhouette { corner: Corner { point, depth }, is_high } => {
                // The pixel itself lies on the near side if the neighbour lies on the far side.
                let (near, offset, far) =
                    if (pixel.aside < 0) == is_high { (own, at, theirs) } else { (theirs, beyond, own) };
                far >= pixel.depth
                    || fits(near, *known.get_or_insert_with(|| edge.gradient(point, depth)), offset)
            }
            Self::Crease([low, high]) => {
                let [own_gradient, other] = if pixel.aside < 0 { [high, low] } else { [low, high] };
                fits(own, own_gradient, at) && fits(theirs, other, beyond)
            }
        }
    }
}

defmt_format!([C, Cell] SmoothPass<'_, C, Cell>, self, "pass over rows {=i32} to {=i32}", self.rows.start, self.rows.end);
