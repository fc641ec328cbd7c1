//! A row of pixels, divided into runs over which texture coordinates are linear.

use super::gradients::{Gradients, Perspective, Sample};
use crate::math::hints::keep_rolled;
use crate::raster::Span;

/// Texture coordinates of pixels from left to right, in 2⁻³² of the sides: linear, without end.
pub(super) struct Line {
    at: [u32; 2],
    step: [u32; 2],
}

impl Iterator for Line {
    type Item = [u32; 2];

    #[inline(always)]
    fn next(&mut self) -> Option<[u32; 2]> {
        keep_rolled(); // unrolled by LLVM, the loop keeps multiples of the steps on the stack
        let at @ [u, v] = self.at;
        let [du, dv] = self.step;
        self.at = [u.wrapping_add(du), v.wrapping_add(dv)];
        Some(at)
    }
}

/// The runs of a span: their widths and coordinates.
///
/// In perspective, runs end at multiples of powers of two on the screen, so that a pixel shows the same texel however its row
/// is cut into spans, by bands, by the depth buffer or by another target.
pub(super) struct Runs<'g> {
    gradients: &'g Gradients,
    x: i32,
    y: i32,
    end: i32,
    /// The sample at `x`, where the last run ended; none at the span's begin, and after a run of one pixel.
    left: Sample,
}

impl<'g> Runs<'g> {
    #[inline(always)]
    pub(super) fn new(gradients: &'g Gradients, Span { x, y, width, .. }: Span) -> Self {
        Self { gradients, x, y, end: x + width, left: Sample::NONE } // inside the guard band
    }

    /// The next run in perspective.
    #[inline(never)] // its loop needs all registers
    fn run(&mut self, perspective: &Perspective) -> (i32, Line) {
        let (x, y) = (self.x, self.y);
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

impl Iterator for Runs<'_> {
    type Item = (i32, Line);

    #[inline(always)]
    fn next(&mut self) -> Option<(i32, Line)> {
        let width = self.end - self.x;
        if width <= 0 {
            return None;
        }
        Some(match self.gradients {
            Gradients::Affine([u, v]) => {
                let (x, y) = (self.x, self.y);
                self.x = self.end;
                (width, Line { at: [u.at(x, y), v.at(x, y)], step: [u.step(), v.step()] })
            }
            Gradients::Perspective(perspective) => self.run(perspective),
        })
    }
}
