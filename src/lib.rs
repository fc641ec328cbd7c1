#![no_std]
// docs.rs shows what needs a feature.
#![cfg_attr(docsrs, feature(doc_cfg))]
// Before the README's own definitions, so that its links lead somewhere on docs.rs too.
#![doc = include_str!("book/links.md")]
#![doc = include_str!("../README.md")]

#[cfg(doc)]
pub mod book;
mod camera;
pub mod clip;
mod math;
mod output;
pub mod raster;
mod render;
mod scene;
mod shade;
pub mod space;

pub use camera::{
    Camera, Corner, Hidden, PlanarProjection, Projection, ProjectionError, Ray, ReferenceVolume, Side,
    VanishingPoint, Viewing, ViewingError, Viewport, ViewportError, Visibility, Window,
};
pub use math::{
    Affine, Angle, AxisError, ClipPoint, Coordinate, InverseError, MatrixError, NormalMap, NumberError,
    Outcode, Point3, Quaternion, QuaternionError, Scalar, Sphere, Vector3,
};
pub use output::{
    Band, BandError, DepthBuffer, DepthBufferError, Dirty, Frame, Picture, PictureError, Pixels, Stored,
    Target, WindowCost, Wire,
};
pub use render::{
    draw_line, fill_triangle, BinsError, Cull, Edges, Faces, Facing, Ink, InkFor, Painter, PaintersOrder,
    Placed, RecordError, Statistics, Transformed,
};
pub use scene::{edge_faces, Hierarchy, HierarchyError, Mesh, MeshError, Node};
pub use shade::{Channels, Dim, Dithered, Flat, Gouraud, Lambert, LightError, Lit, ShadeTable, Shaded};
