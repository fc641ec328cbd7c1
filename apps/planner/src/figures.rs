//! The figures of the pages in `docs`, which `build.rs` reads: instructions, the size of code, and chips.

use crate::chip::Chip;

/// Instructions per vertex, face and so on, on the cores M0, M3, M4F and RV32, and the largest error of their sum in percent.
pub(crate) struct Constants<const N: usize> {
    of: [[f32; N]; 4],
    error: f32,
}

/// The size of code in bytes on the cores M0, M3, M4F and RV32, at opt-level 3. An M4F has the figures of an M3.
#[derive(Clone, Copy)]
pub(crate) struct Code {
    pub(crate) flash: [i32; 4],
    pub(crate) stack: [i32; 4],
}

impl Code {
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

impl<const N: usize> Constants<N> {
    /// The instructions of a frame that has so many vertices, faces and so on, on the four cores, and their largest error in percent.
    pub(crate) fn time(&self, counts: &[f64; N]) -> ([f64; 4], f32) {
        let sum = |of: [f32; N]| of.iter().zip(counts).map(|(&one, count)| f64::from(one) * count).sum();
        (self.of.map(sum), self.error)
    }
}

include!(concat!(env!("OUT_DIR"), "/figures.rs"));
