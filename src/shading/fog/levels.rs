//! The level of fog of each pixel of a span.

use super::table::LEVELS;
use crate::math::hints::keep_rolled;
use core::cell::Cell;

/// The depths at which levels begin, as [`FogTable`](crate::fog::FogTable) has them.
pub(crate) type Bounds = [u32; LEVELS + 2];

/// The level of fog at a depth, found by a search from the level of a nearby depth: neighbouring pixels mostly have one level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FogLevel {
    level: usize,
    /// The least depth that has the level, and how many depths from there on have it.
    from: u32,
    reach: u32,
}

impl FogLevel {
    /// A level, 0 … 32.
    #[inline(always)]
    pub(crate) fn new(level: u8, bounds: &Bounds) -> Self {
        Self::of(level.into(), bounds)
    }

    #[inline(always)]
    fn of(level: usize, bounds: &Bounds) -> Self {
        let (from, to) = match bounds.get(level..) {
            Some(&[from, to, ..]) => (from, to),
            _ => (0, u32::MAX), // no level is above 32
        };
        Self { level, from, reach: to.wrapping_sub(from) }
    }

    /// Whether `depth`, a value of [`Gradient::of_depth`](crate::raster::Gradient::of_depth), has this level.
    #[inline(always)]
    pub(crate) fn has(&self, depth: u32) -> bool {
        depth.wrapping_sub(self.from) < self.reach
    }

    /// The level of a depth.
    #[inline(always)]
    pub(crate) fn at(mut self, depth: u32, bounds: &Bounds) -> Self {
        while depth < self.from && self.level > 0 {
            self = Self::of(self.level - 1, bounds);
            keep_rolled();
        }
        while depth >= self.from.wrapping_add(self.reach) && self.level < LEVELS {
            self = Self::of(self.level + 1, bounds);
            keep_rolled();
        }
        self
    }

    /// The number of further pixels with this level, after one of depth `first` that has it, if depth changes by `step`: at most
    /// `beyond`, and exact if no depth up to that pixel wraps. One division.
    #[inline(always)]
    pub(crate) fn further(&self, first: u32, step: u32, beyond: u32) -> u32 {
        let last = first.wrapping_add(step.wrapping_mul(beyond));
        let to = self.from.wrapping_add(self.reach);
        let more = if last >= to {
            to.wrapping_sub(first).wrapping_sub(1).checked_div(step)
        } else if last < self.from {
            first.wrapping_sub(self.from).checked_div(step.wrapping_neg())
        } else {
            None
        };
        more.map_or(beyond, |more| more.min(beyond))
    }

    /// The level: 0 … 32.
    #[inline(always)]
    pub(crate) fn level(&self) -> u8 {
        self.level as u8
    }
}

/// The runs of pixels of a span that have one level of fog, from left to right.
pub(super) struct LevelRuns<'s> {
    pub(super) bounds: &'s Bounds,
    /// The level where the last search ended: the next one begins there.
    pub(super) level: &'s Cell<FogLevel>,
    /// At the first pixel of the next run.
    pub(super) depth: u32,
    pub(super) step: u32,
}

impl LevelRuns<'_> {
    /// The width of the next run, at most `most`, which is positive, and its level.
    #[inline(always)]
    pub(super) fn next_run(&mut self, most: i32) -> (i32, u32) {
        let (level, depth) = (self.level.get(), self.depth);
        let last = depth.wrapping_add(self.step.wrapping_mul((most as u32).wrapping_sub(1)));
        let width = match level.has(depth) && level.has(last) {
            true => most,
            false => self.find(most),
        };
        self.depth = depth.wrapping_add(self.step.wrapping_mul(width as u32));
        (width, self.level.get().level().into())
    }

    /// Sets the level to that of the next pixel, and returns how many pixels have it, at most `most`.
    #[inline(never)] // its loops would take the registers of the loops over pixels
    fn find(&mut self, most: i32) -> i32 {
        let level = self.level.get().at(self.depth, self.bounds);
        self.level.set(level);
        (level.further(self.depth, self.step, (most as u32).wrapping_sub(1)) as i32).wrapping_add(1)
    }
}

/// The level of each pixel of a span, from left to right. The depth of pixel k is exactly `depth + k·step`, modulo 2³², so a
/// pixel has the level of its own depth, however the span is cut.
pub(super) struct FogLevels<'t> {
    pub(super) bounds: &'t Bounds,
    /// Where the search for the level begins.
    pub(super) level: FogLevel,
    pub(super) depth: u32,
    pub(super) step: u32,
}

impl Iterator for FogLevels<'_> {
    type Item = u8;

    #[inline(always)]
    fn next(&mut self) -> Option<u8> {
        if !self.level.has(self.depth) {
            self.level = self.level.at(self.depth, self.bounds);
        }
        self.depth = self.depth.wrapping_add(self.step);
        Some(self.level.level())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_depths_end_too() {
        let bounds = [0; LEVELS + 2];
        for (depth, step) in [(u32::MAX, 0), (5, u32::MAX), (u32::MAX, 1 << 31), (0, 77)] {
            for level in [0, 32, 255] {
                let level = FogLevel::new(level, &bounds);
                assert!(FogLevels { bounds: &bounds, level, depth, step }.take(20).count() == 20);
                let level = level.at(depth, &bounds);
                assert!(level.further(depth, step, 9) <= 9);
            }
        }
    }
}
