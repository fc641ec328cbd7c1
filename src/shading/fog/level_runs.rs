//! A span as runs of pixels with equal levels of fog.

use super::table::LEVELS;
use crate::raster::Span;

/// The runs of a span over which the level of fog is constant, from left to right, with that level. A run whose end lies inside the
/// span takes one division; a pixel takes nothing.
///
/// Depth of pixel k of the span is `depth + k·step`, exactly and modulo 2³², and below 2³² at all pixels of the span. So the run's
/// length follows from the quotient exactly, and every pixel has the level of its own depth, however the span is cut.
pub(super) struct LevelRuns<'t> {
    bounds: &'t [u32; LEVELS + 2],
    level: usize,
    depth: u32,
    step: u32,
    span: Span,
}

impl<'t> LevelRuns<'t> {
    /// `depth`: at the first pixel. `level`: where the search for its level begins, 0 … 32.
    #[inline(always)]
    pub(super) fn new(bounds: &'t [u32; LEVELS + 2], level: u8, depth: u32, step: u32, span: Span) -> Self {
        Self { bounds, level: level.into(), depth, step, span }
    }

    /// The depths of the level: from the first to before the second.
    #[inline(always)]
    fn bounds_of(&self, level: usize) -> (u32, u32) {
        match self.bounds.get(level..) {
            Some(&[from, to, ..]) => (from, to),
            _ => (0, u32::MAX), // no level is above 32
        }
    }

    /// Moves to the level of `depth`, and returns its bounds.
    #[inline(always)]
    fn find(&mut self) -> (u32, u32) {
        let (mut from, mut to) = self.bounds_of(self.level);
        while self.depth >= to && self.level < LEVELS {
            self.level += 1;
            (from, to) = self.bounds_of(self.level);
        }
        while self.depth < from && self.level > 0 {
            self.level -= 1;
            (from, to) = self.bounds_of(self.level);
        }
        (from, to)
    }
}

impl Iterator for LevelRuns<'_> {
    /// A part of the span, and its level.
    type Item = (Span, u8);

    #[inline(always)]
    fn next(&mut self) -> Option<(Span, u8)> {
        let beyond = self.span.width.wrapping_sub(1); // the pixels of the run after the first
        if beyond < 0 {
            return None;
        }
        let (from, to) = self.find();
        let (first, last) = (self.depth, self.depth.wrapping_add(self.step.wrapping_mul(beyond as u32)));
        // Both ends have the level, or the last pixel k with depth + k·step < to, or ≥ from, is the run's last.
        let more = if last >= to {
            to.wrapping_sub(first).wrapping_sub(1).checked_div(self.step)
        } else if last < from {
            first.wrapping_sub(from).checked_div(self.step.wrapping_neg())
        } else {
            None
        };
        // Less than `beyond`; in any case a run has a pixel, and none outside of the span.
        let more = more.map_or(beyond, |more| more.min(beyond as u32) as i32);
        let run = Span { width: more.wrapping_add(1), ..self.span };
        self.span.x = self.span.x.wrapping_add(run.width);
        self.span.width = self.span.width.wrapping_sub(run.width);
        self.depth = first.wrapping_add(self.step.wrapping_mul(run.width as u32));
        Some((run, self.level as u8))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::math::random::Random;
    use std::vec::Vec;

    /// Each pixel's level by its own depth, against the runs, from every level at which the search may begin.
    #[test]
    fn every_pixel_has_the_level_of_its_own_depth() {
        let mut random = Random(3);
        let mut runs_met = 0;
        for case in 0..20_000 {
            let mut bounds = [0; LEVELS + 2];
            let reach = [1 << 32, 1 << 31, 1 << 20, 200, 8][case % 5];
            let low = random.below((1 << 32) - reach + 1);
            bounds.iter_mut().for_each(|bound| *bound = (low + random.below(reach)) as u32);
            (bounds[0], bounds[LEVELS + 1]) = (0, u32::MAX);
            bounds.sort_unstable();
            let width = 1 + random.below(40);
            // Depths of the ends, so that none in between wraps.
            let [first, end] = [0; 2].map(|_| (low + random.below(reach)).min(u32::MAX.into()));
            let step = (end - first) / width;
            let span = Span { x: random.within(500), y: 7, width: width as i32, height: 1 };
            let begin = random.below(33) as u8;
            let runs: Vec<_> =
                LevelRuns::new(&bounds, begin, first as u32, step as u32, span).take(50).collect();
            let mut pixels = Vec::new();
            for (run, level) in &runs {
                assert_eq!((run.y, run.height), (7, 1));
                pixels.extend((run.x..run.x + run.width).map(|x| (x, *level)));
            }
            let wanted: Vec<_> = (0..width)
                .map(|k| {
                    let depth = first + k * step;
                    let level = bounds[1..=LEVELS].iter().filter(|&&bound| i64::from(bound) <= depth).count();
                    (span.x + k as i32, level as u8)
                })
                .collect();
            assert_eq!(pixels, wanted, "{bounds:?} {first} {step}");
            runs_met += usize::from(runs.len() > 4);
        }
        assert!(runs_met > 5_000, "{runs_met}");
    }

    #[test]
    fn wrong_depths_end_too() {
        let bounds = [0; LEVELS + 2];
        for width in [i32::MIN, -1, 0, 1, 9, i32::MAX] {
            for (depth, step) in [(u32::MAX, 0), (5, u32::MAX), (u32::MAX, 1 << 31), (0, 77)] {
                let span = Span { x: i32::MAX, y: 0, width, height: 1 };
                let runs = LevelRuns::new(&bounds, 255, depth, step, span).take(20);
                assert!(runs.map(|(run, _)| i64::from(run.width)).sum::<i64>() <= i64::from(width.max(0)));
            }
        }
    }
}
