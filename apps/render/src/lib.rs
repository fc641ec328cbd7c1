//! From a model or a scene to a picture: what `pinhole-render` draws and writes to files, and `pinhole-viewer` shows in a
//! window.
#![allow(missing_docs)] // modules of two programs, not an interface

pub mod firmware;
pub mod import;
mod json;
mod light;
pub mod model;
mod normals;
pub mod paint;
pub mod parts;
pub mod picture;
pub mod projections;
pub mod quantised;
pub mod scene;
pub mod style;
