//! Slow, independent oracles, which never call the library. They compute the right answer from the specification alone,
//! and the tests compare the library with it.
//!
//! * [`coverage`] which pixels a triangle covers (R1–R9), in exact integers
//! * [`mod@line`] which pixels a line draws (L1–L3), each by its own exact division
//! * [`cases`] random triangles and lines, dense where rasterisers go wrong
//! * [`chain`] model → world → view → clip → screen in f64, from the quantised inputs
//! * [`eye`] what a camera sees in each pixel, in f64, by one ray per pixel: no clipping in it
//! * [`target`] draw targets that count, that fail and that make ASCII pictures
//! * [`picture`] how far edges must move to explain a whole depth-tested picture, in f64
//! * [`shade`] colours over a triangle and dithered, in exact fractions
//! * [`texture`] the texture coordinates that pixels show, in f64, by one ray per pixel
//! * [`cut_faces`] colours of faces that the near plane, the far plane or the guard band cuts, in f64
//! * [`rng`] a seeded generator, so that every run draws the same cases

pub mod cases;
pub mod chain;
#[cfg(test)]
mod check;
pub mod coverage;
pub mod cut_faces;
pub mod eye;
pub mod hidden;
pub mod line;
pub mod picture;
pub mod rng;
pub mod shade;
pub mod target;
pub mod texture;
