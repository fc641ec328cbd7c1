//! The figures of the pages in `docs`, which `build.rs` reads: instructions, the size of code, and chips.

use crate::chip::Chip;
use pinhole_apps_support::work::{terms, Work};

/// A way to draw: instructions per vertex, face and so on, on the cores M0, M3, M4F and RV32, and the largest error of their sum in
/// percent.
pub(crate) struct Constants {
    way: &'static str,
    of: [&'static [f32]; 4],
    error: f32,
}

/// The size of code in bytes on the cores M0, M3, M4F and RV32, at opt-level 3. An M4F has the figures of an M3.
#[derive(Clone, Copy)]
pub(crate) struct Code {
    pub(crate) flash: [i32; 4],
    pub(crate) stack: [i32; 4],
}

impl Code {
    /// This code plus that of smooth edges, whose stack is the largest.
    pub(crate) const fn with_smooth_edges(self) -> Self {
        Self { stack: SMOOTH_EDGES_CODE.stack, ..self.and(SMOOTH_EDGES_CODE, DEPTH_PIXELS_CODE) }
    }

    /// This code plus the code that image `with` has and image `without` has not.
    pub(crate) const fn and(self, with: Self, without: Self) -> Self {
        let (mut sum, mut core) = (self, 0);
        while core < 4 {
            sum.flash[core] += with.flash[core] - without.flash[core];
            core += 1;
        }
        sum
    }
}

impl Constants {
    /// The instructions of a frame on the four cores, and their largest error in percent.
    pub(crate) fn time(&self, work: &Work) -> ([f64; 4], f32) {
        let counts = terms(self.way).into_iter().map(|(_, count)| f64::from(count(work)));
        let counts: Vec<f64> = counts.collect();
        let sum = |of: &[f32]| of.iter().zip(&counts).map(|(&one, count)| f64::from(one) * count).sum();
        (self.of.map(sum), self.error)
    }
}

include!(concat!(env!("OUT_DIR"), "/figures.rs"));
