//! From a model or a scene to a picture: what `pinhole-render` draws and writes to files, and `pinhole-viewer` shows in a
//! window.
#![allow(missing_docs)] // modules of two programs, not an interface

mod arguments;
mod ascii;
mod brush;
mod camera;
mod colours;
mod draw;
pub mod firmware;
pub mod fog;
pub mod import;
mod json;
pub mod light;
mod meshes;
pub mod model;
mod normals;
mod options;
pub mod paint;
mod palette;
pub mod parts;
pub mod picture;
mod picture_file;
pub mod program;
pub mod projections;
pub mod quantised;
mod range;
pub mod scene;
mod sprite_paint;
pub mod sprites;
pub mod style;
pub mod texture;
mod turntable;
mod used;
