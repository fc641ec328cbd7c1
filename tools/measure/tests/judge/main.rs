//! What `pinhole-measure` writes for programs that judge the library.

mod coverage;
mod harness;
mod messages;
mod pictures;
mod projections;
mod scenes;
mod shading;
mod sprites;
mod textures;
