//! A row of pixels, divided into runs over which texture coordinates are linear.

use super::gradients::Gradients;
use super::line::{Coordinates, Line, LARGEST_BLOCK};
use super::perspective::{Perspective, Planes, Sample};
use crate::math::hints::keep_rolled;
use crate::raster::{Gradient, Span};

/// The runs of a span whose coordinates are linear: blocks of 2^[`LARGEST_BLOCK`] pixels, at multiples of it on the screen.
pub(super) struct LinearRuns {
    /// The coordinates in column 0, and their changes from a pixel to the next.
    first: [u32; 2],
    step: [u32; 2],
    x: i32,
    end: i32,
}

impl LinearRuns {
    #[inline(always)]
    pub(super) fn new([u, v]: &[Gradient; 2], span: Span) -> Self {
        Self::of([[u.at(0, span.y), v.at(0, span.y)], [u.step(), v.step()]], span)
    }

    #[inline(always)]
    pub(super) fn by_row(rows: &Perspective, span: Span) -> Self {
        Self::of(rows.line(span.y), span)
    }

    #[inline(always)]
    fn of([first, step]: [[u32; 2]; 2], Span { x, width, .. }: Span) -> Self {
        Self { first, step, x, end: x + width } // inside the guard band
    }

    /// The next run, its width and coordinates.
    #[inline(always)]
    fn next_run<const N: usize>(&mut self) -> Option<(i32, Coordinates<N>)> {
        let Self { x, end, first: [u, v], step } = *self;
        if x >= end {
            return None;
        }
        let (from, to) = block(x, LARGEST_BLOCK);
        self.x = to;
        let along = |first: u32, step: u32| first.wrapping_add(step.wrapping_mul(from as u32));
        let [du, dv] = step;
        let line = Coordinates::of_block([along(u, du), along(v, dv)], step, LARGEST_BLOCK, x - from);
        Some((to.min(end) - x, line))
    }
}

/// The block of 2^`bits` pixels, at a multiple of it on the screen, that holds a column: its begin and its end.
#[inline(always)]
const fn block(x: i32, bits: i32) -> (i32, i32) {
    let mask = -1 << (bits & 31);
    (x & mask, (x | !mask).wrapping_add(1))
}

/// The runs of a span in perspective.
///
/// A pixel belongs to the largest block of 2^n pixels, at a multiple of 2^n on the screen, over which coordinates may be
/// interpolated linearly. If they may over a block, they may over its halves, so that the search can begin at any size. A
/// pixel shows the same texel however its row is cut into spans, by bands, by the depth buffer or by another target.
pub(super) struct PerspectiveRuns<'g> {
    perspective: &'g Perspective,
    x: i32,
    end: i32,
    /// At `x`.
    planes: Planes,
    /// The row's [curvature](super::perspective::Curvature::of_row).
    curvature: i32,
    /// The sample at `x`, if the last run ended there with one.
    left: Sample,
    /// The binary logarithm of the last run's block: [`BEGIN`], [`SINGLE`] or more.
    last: i32,
}

/// A block of 2^`bits` pixels, of which `passed` lie left of `x`, and where it ends.
struct Block {
    bits: i32,
    passed: i32,
    behind: Planes,
}

/// Values of [`PerspectiveRuns::last`]: no run was before, or it had one pixel.
const BEGIN: i32 = -1;
const SINGLE: i32 = 0;

impl<'g> PerspectiveRuns<'g> {
    #[inline(always)]
    pub(super) fn new(perspective: &'g Perspective, Span { x, y, width, .. }: Span) -> Self {
        Self {
            perspective,
            x,
            end: x + width, // inside the guard band
            planes: perspective.beyond(perspective.row(y), x),
            curvature: perspective.curvature.of_row(y),
            left: Sample::ZERO,
            last: BEGIN,
        }
    }

    /// The word of the next run's first pixel, and its step: two numbers are returned in registers.
    #[inline(never)] // its loop needs all registers
    fn word_run(&mut self) -> (u32, u32) {
        let Coordinates { at: [at], step: [step] } = self.run();
        (at, step)
    }

    /// [`run`](Self::run) as a function.
    #[inline(never)] // its loop needs all registers
    fn wide_run<const N: usize>(&mut self) -> Coordinates<N> {
        self.run()
    }

    /// The next run, up to the new `x` or the end.
    #[inline(always)]
    fn run<const N: usize>(&mut self) -> Coordinates<N> {
        let Self { perspective, x, last, .. } = *self;
        // A block that began further left would have been the last run.
        let aligned = if last == BEGIN { 0 } else { x };
        let bits = (aligned | perspective.widest_block).trailing_zeros() as i32;
        let bits = bits.min(self.reach_at(0));
        let block = if last > SINGLE { self.block_from_here(bits) } else { self.block_around(bits) };
        let (mut sum, mut change, mut line) = (self.left.twice(), [0; 2], (1, 0));
        if let Some(Block { bits, passed, behind }) = block {
            (self.x, self.planes, self.last) = (x + (1 << (bits & 31)) - passed, behind, bits);
            (self.left, sum, change) = perspective.ends(self.left, behind, bits);
            line = (bits, passed);
        } else {
            (self.x, self.planes, self.last) = (x + 1, perspective.beyond(self.planes, 1), SINGLE);
        }
        let (bits, passed) = line;
        perspective.line_through(sum, change, bits, passed)
    }

    /// The largest block of at most 2^`bits` pixels that begins at `x`, where the last run ended.
    #[inline(always)]
    fn block_from_here(&self, mut bits: i32) -> Option<Block> {
        let Self { perspective, planes, .. } = *self;
        while bits > 0 {
            let width = 1 << (bits & 31); // at most 64
            if self.reach_at(width) >= bits {
                let behind = perspective.beyond(planes, width);
                if behind.has_room() {
                    return Some(Block { bits, passed: 0, behind });
                }
            }
            bits -= 1;
            keep_rolled();
        }
        None
    }

    /// The largest block of at most 2^`bits` pixels that has `x` in it. Computes the sample at its begin, or at `x` if there is none.
    #[inline(always)]
    fn block_around(&mut self, bits: i32) -> Option<Block> {
        let (first, block) = self.search_around(bits);
        self.left = self.perspective.divided(first);
        block
    }

    /// The largest block of at most 2^`bits` pixels that has `x` in it, and the planes at its begin, or at `x` if there is none.
    #[inline(always)]
    fn search_around(&self, mut bits: i32) -> (Planes, Option<Block>) {
        let Self { perspective, x, planes, .. } = *self;
        let falls = perspective.q_falls();
        while bits > 0 {
            let width = 1 << (bits & 31); // at most 64
            let passed = x & (width - 1);
            let (from, to) = (-passed, width - passed);
            if self.reach_at(if falls { to } else { from }) >= bits {
                let (first, behind) = (perspective.beyond(planes, from), perspective.beyond(planes, to));
                // Coordinates with room at both ends of a block have room between them.
                if first.has_room() && behind.has_room() {
                    return (first, Some(Block { bits, passed, behind }));
                }
            }
            bits -= 1;
            keep_rolled();
        }
        (planes.inside_room(), None)
    }

    /// The binary logarithm of the largest block that may begin or end `by` columns from `x`, as far as q there decides.
    #[inline(always)]
    fn reach_at(&self, by: i32) -> i32 {
        Perspective::largest_block(self.curvature, self.perspective.q_beyond(self.planes, by))
    }

    /// The binary logarithm of the number of texels that the pixel after the last run [covers](Perspective::covered).
    #[inline(always)]
    pub(super) fn covered(&self, size_bits: [u32; 2]) -> i32 {
        self.perspective.covered(self.planes, size_bits)
    }

    /// The next run, its width and coordinates.
    #[inline(always)]
    fn next_run<const N: usize>(&mut self) -> Option<(i32, Coordinates<N>)> {
        let x = self.x;
        if x >= self.end {
            return None;
        }
        let line = match N {
            1 => Coordinates::of_word(self.word_run()),
            _ => self.wide_run(),
        };
        Some((self.x.min(self.end) - x, line))
    }
}

impl PerspectiveRuns<'_> {
    /// The next run, its width and coordinates about the middle of its block, wherever in the block it begins.
    #[inline(always)]
    pub(super) fn next_about_middle(&mut self) -> Option<(i32, AboutColumn)> {
        let x = self.x;
        let (width, Coordinates { at, step }) = self.next_run::<2>()?;
        let by = x - (self.x - ((1 << (self.last & 31)) >> 1)); // inside the guard band
        Some((width, AboutColumn::new(at, step, by)))
    }
}

/// Texture coordinates that are linear along a run, given in a column that does not depend on where the run begins.
#[derive(Clone, Copy)]
pub(super) struct AboutColumn {
    /// In that column, in 2⁻³² of the sides.
    pub(super) at: [u32; 2],
    pub(super) step: [u32; 2],
    /// The run's first pixel, in columns from that column.
    pub(super) by: i32,
}

impl AboutColumn {
    /// From coordinates `by` columns from the column.
    #[inline(always)]
    fn new([u, v]: [u32; 2], step @ [du, dv]: [u32; 2], by: i32) -> Self {
        let back = |at: u32, step: u32| at.wrapping_sub(step.wrapping_mul(by as u32));
        Self { at: [back(u, du), back(v, dv)], step, by }
    }

    /// Of a span over a triangle whose coordinates are linear by rows.
    #[inline(always)]
    pub(super) fn by_row(rows: &Perspective, Span { x, y, .. }: Span) -> Self {
        let [first, step] = rows.line(y);
        let own = Self::new(first, step, -rows.anchor);
        Self { by: x - rows.anchor, ..own } // inside the guard band
    }
}

/// The runs of a span over a triangle of any kind.
pub(super) enum Runs<'g> {
    /// Of a small triangle: the only run of the span.
    Packed(Option<(i32, Coordinates<1>)>),
    Linear(LinearRuns),
    Perspective(PerspectiveRuns<'g>),
}

impl<'g> Runs<'g> {
    #[inline(always)]
    pub(super) fn new(gradients: &'g Gradients, span: Span) -> Self {
        match gradients {
            Gradients::Packed(gradient) => {
                let words = Coordinates { at: [gradient.at(span.x, span.y)], step: [gradient.step()] };
                Self::Packed(Some((span.width, words)))
            }
            Gradients::Linear(gradients) => Self::Linear(LinearRuns::new(gradients, span)),
            Gradients::Rows(rows) => Self::Linear(LinearRuns::by_row(rows, span)),
            Gradients::Perspective(perspective) => Self::Perspective(PerspectiveRuns::new(perspective, span)),
        }
    }

    /// The next run, its width and coordinates, of which `N` numbers are known.
    #[inline(always)]
    pub(super) fn next_run<const N: usize>(&mut self) -> Option<(i32, Line)> {
        let (width, own) = match self {
            Self::Packed(run) => {
                let (width, words) = run.take().filter(|_| N == 1)?;
                return Some((width, words.line()));
            }
            Self::Linear(runs) => runs.next_run::<N>()?,
            Self::Perspective(runs) => runs.next_run::<N>()?,
        };
        Some((width, own.line()))
    }
}
