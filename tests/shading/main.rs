//! Light and shaders: the levels of each channel on every kind of target, against exact fractions
//! (`support::oracle::shade`) and f64 (`support::oracle::cut_faces`).

mod bands;
mod blended;
mod clamped_textures;
mod cut_faces;
mod dithered;
mod emission;
mod every_target;
mod fog;
mod fogged;
mod gouraud;
mod keyed;
mod light;
mod lights;
mod lit_textures;
mod own_shaders;
mod scene;
mod screen_door;
mod shade_table;
mod texture_projections;
mod texture_rays;
mod texture_units;
mod textures;
