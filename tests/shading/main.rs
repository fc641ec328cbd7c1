//! Light and shaders: the levels of each channel on every kind of target, against exact fractions
//! (`support::oracle::shade`) and f64 (`support::oracle::cut_faces`).

mod bands;
mod bilinear;
mod blended;
mod colors;
mod fog;
mod levels;
mod lights;
mod lit_textures;
mod mips;
mod own_shaders;
mod perspective_gouraud;
mod rays;
mod scene;
mod tables;
mod textures;
