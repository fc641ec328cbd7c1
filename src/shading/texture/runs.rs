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
/// In perspective, runs end at multiples of powers of two on the screen, so that a pixel shows the same texel however its row
/// is cut into spans, by bands, by the depth buffer or by another target.
pub(super) struct PerspectiveRuns<'g> {
    perspective: &'g Perspective,
    x: i32,
    y: i32,
    end: i32,
    /// The sample at `x`, where the last run ended; none at the span's begin, and after a run of one pixel.
    left: Sample,
}

impl<'g> PerspectiveRuns<'g> {
    #[inline(always)]
    pub(super) fn new(perspective: &'g Perspective, Span { x, y, width, .. }: Span) -> Self {
        Self { perspective, x, y, end: x + width, left: Sample::NONE } // inside the guard band
    }

    /// The next run.
    #[inline(never)] // its loop needs all registers
    fn run(&mut self) -> (i32, Line) {
        let (x, y, perspective) = (self.x, self.y, self.perspective);
        let mut bits = perspective.largest_run;
        let mut left_of = (x, self.left);
        // A block starts at a multiple of its size. If one that began further left were linear, it would be the last run.
        if !self.left.is_none() {
            bits = bits.min(x.trailing_zeros());
        }
        while bits > 0 {
            let (from, to) = (x & (-1 << (bits & 31)), (x | !(-1 << (bits & 31))).wrapping_add(1));
            if left_of.1.is_none() || left_of.0 != from {
                left_of = (from, perspective.sample(from, y));
            }
            let (left, right) = (left_of.1, perspective.sample(to, y));
            if perspective.is_linear(&left, &right) {
                let ([u, v], step @ [du, dv]) =
                    (perspective.phases(&left), perspective.step(&left, &right, bits));
                let passed = (x - from) as u32; // at most 63
                let at = [u.wrapping_add(du.wrapping_mul(passed)), v.wrapping_add(dv.wrapping_mul(passed))];
                let width = to.min(self.end) - x;
                (self.x, self.left) = (to, right);
                return (width, Line { at, step });
            }
            bits -= 1;
        }
        let sample = perspective.nearest_sample(x, y);
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
