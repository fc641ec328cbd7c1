//! Light and shaders: the levels of each channel on every kind of target, against exact fractions
//! (`support::oracle::shade`) and f64 (`support::oracle::cut_faces`).

mod bands;
mod blended;
mod dithered;
mod fog;
mod fogged;
mod keyed;
mod levels;
mod light;
mod lights;
mod lit_textures;
mod own_shaders;
mod rays;
mod scene;
mod screen_door;
mod tables;
mod textures;
