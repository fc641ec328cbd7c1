//! Smooth and dithered inks on every kind of target, against exact fractions: `oracle/shade.rs`.

mod bands;
mod cut_faces;
mod dithered;
mod gouraud;
mod light;
mod scene;
mod shade_table;
