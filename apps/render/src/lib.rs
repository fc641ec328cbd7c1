//! From a model or a scene to a picture: what `pinhole-render` draws and writes to files, `pinhole-viewer` shows in a window, and
//! `pinhole-measure` writes as numbers.
#![allow(missing_docs)] // modules of three programs, not an interface

pub mod arguments;
mod ascii;
pub mod bands;
mod brush;
mod camera;
mod colours;
pub mod firmware;
pub mod fog;
pub mod import;
pub mod json;
pub mod light;
mod meshes;
pub mod model;
mod options;
pub mod paint;
pub mod parts;
pub mod picture;
pub mod program;
pub use pinhole_apps_support::projections;
pub mod quantised;
mod range;
pub mod scene;
mod shades;
mod sprite_paint;
pub mod sprites;
pub mod style;
pub mod texture;
mod turntable;
