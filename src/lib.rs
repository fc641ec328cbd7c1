#![no_std]
#![doc = include_str!("../README.md")]

mod camera;
mod clip;
mod math;
mod output;
pub mod raster;
mod render;
mod scene;
mod shade;
pub mod space;

pub use camera::{
    Camera, ClipPoint, Projection, ProjectionError, Viewing, ViewingError, Viewport, ViewportError, Window,
};
pub use math::{Affine, Angle, Coordinate, NumberError, Point3, Scalar, Vector3};
pub use render::{Corner, Cull, Painter, Placed, RecordError, Statistics};
pub use scene::{Mesh, MeshError};
pub use shade::{Dim, Lambert, LightError};
