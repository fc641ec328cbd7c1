//! Smooth and dithered inks on every kind of target, against exact fractions: `oracle/shade.rs`.

#[path = "../bridge/mod.rs"]
mod bridge;
#[path = "../oracle/mod.rs"]
mod oracle;

mod bands;
mod cut;
mod dither;
mod own_shaders;
mod shaded;
mod smooth;
mod target;
