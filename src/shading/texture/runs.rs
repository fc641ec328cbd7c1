//! A row of pixels, divided into runs over which texture coordinates are linear.

use super::gradients::{Gradients, Perspective, Sample};
use crate::raster::{Gradient, Span};

/// Texture coordinates of pixels from left to right, in 2⁻³² of the sides: linear, without end.
#[derive(Clone, Copy)]
pub struct Line {
    /// The coordinates of the next pixel.
    pub(crate) at: [u32; 2],
    step: [u32; 2],
}

impl Iterator for Line {
    type Item = [u32; 2];

    #[inline(always)]
    fn next(&mut self) -> Option<[u32; 2]> {
        Some(self.advance())
    }
}

impl Line {
    /// The coordinates of the next pixel; advances to the pixel after it.
    #[inline(always)]
    pub(crate) fn advance(&mut self) -> [u32; 2] {
        let at @ [u, v] = self.at;
        let [du, dv] = self.step;
        self.at = [u.wrapping_add(du), v.wrapping_add(dv)];
        at
    }

    /// A span of a triangle over which coordinates are linear.
    #[inline(always)]
    pub(super) fn affine([u, v]: &[Gradient; 2], Span { x, y, .. }: Span) -> Self {
        Self { at: [u.at(x, y), v.at(x, y)], step: [u.step(), v.step()] }
    }
}

/// The runs of a span in perspective: their widths and coordinates.
///
/// A pixel belongs to the largest block of 2^n pixels, at a multiple of 2^n on the screen, over which coordinates may be
/// interpolated linearly. If they may over a block, they may over its halves, so that the search can begin at any size. A
/// pixel shows the same texel however its row is cut into spans, by bands, by the depth buffer or by another target.
pub(super) struct PerspectiveRuns<'g> {
    perspective: &'g Perspective,
    start: i32,
    x: i32,
    y: i32,
    end: i32,
    /// The row's [curvature](Perspective::curvature).
    curvature: i32,
    /// The sample at `x`, where the last run ended; none at the span's begin, and after a run of one pixel.
    left: Sample,
}

impl<'g> PerspectiveRuns<'g> {
    #[inline(always)]
    pub(super) fn new(perspective: &'g Perspective, Span { x, y, width, .. }: Span) -> Self {
        let curvature = perspective.curvature(x, y);
        let end = x + width; // inside the guard band
        Self { perspective, start: x, x, y, end, curvature, left: Sample::NONE }
    }

    /// The next run.
    #[inline(never)] // its loop needs all registers
    fn run(&mut self) -> (i32, Line) {
        let Self { perspective, start, x, y, end, curvature, left } = *self;
        // No block with this pixel has a larger minimum of q.
        let q = perspective.q(x, y);
        let mut bits = (perspective.largest_run as i32).min(Perspective::largest_block(curvature, q.max(1)));
        if x > start {
            // A block that began further left would have been the last run.
            bits = bits.min(x.trailing_zeros() as i32);
        }
        while bits > 0 {
            let mask = -1 << (bits & 31);
            let (from, to) = (x & mask, (x | !mask).wrapping_add(1));
            let behind @ (q_behind, st_behind) = perspective.at(to, y);
            // A sample at the left end was the right end of the last run, so it had room: zeros pass the test.
            let first @ (q_first, st_first) =
                if left.is_none() { perspective.at(from, y) } else { (left.q, [0; 2]) };
            if Perspective::has_room(&behind)
                && Perspective::has_room(&first)
                && Perspective::largest_block(curvature, q_first.min(q_behind)) >= bits
            {
                let left = if left.is_none() { perspective.divided(q_first, st_first) } else { left };
                let right = perspective.divided(q_behind, st_behind);
                let ([u, v], step @ [du, dv]) =
                    (perspective.phases(&left), perspective.step(&left, &right, bits as u32));
                let passed = (x - from) as u32; // at most 255
                let at = [u.wrapping_add(du.wrapping_mul(passed)), v.wrapping_add(dv.wrapping_mul(passed))];
                let width = to.min(end) - x;
                (self.x, self.left) = (to, right);
                return (width, Line { at, step });
            }
            bits -= 1;
        }
        let sample = if left.is_none() { perspective.sample(x, y) } else { left };
        (self.x, self.left) = (x + 1, Sample::NONE);
        (1, Line { at: perspective.phases(&sample), step: [0; 2] })
    }
}

impl Iterator for PerspectiveRuns<'_> {
    type Item = (i32, Line);

    #[inline(always)]
    fn next(&mut self) -> Option<(i32, Line)> {
        (self.x < self.end).then(|| self.run())
    }
}

/// The runs of a span.
pub(super) enum Runs<'g> {
    /// The only one.
    Affine(Option<(i32, Line)>),
    Perspective(PerspectiveRuns<'g>),
}

impl<'g> Runs<'g> {
    #[inline(always)]
    pub(super) fn new(gradients: &'g Gradients, span: Span) -> Self {
        match gradients {
            Gradients::Affine(gradients) => Self::Affine(Some((span.width, Line::affine(gradients, span)))),
            Gradients::Perspective(perspective) => Self::Perspective(PerspectiveRuns::new(perspective, span)),
        }
    }
}

impl Iterator for Runs<'_> {
    type Item = (i32, Line);

    #[inline(always)]
    fn next(&mut self) -> Option<(i32, Line)> {
        match self {
            Self::Affine(run) => run.take(),
            Self::Perspective(runs) => runs.next(),
        }
    }
}
