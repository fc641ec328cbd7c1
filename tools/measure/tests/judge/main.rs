//! What `pinhole-measure` writes for programs that judge the library.

mod coverage;
mod harness;
mod pictures;
mod refused;
mod scenes;
mod sprites;
