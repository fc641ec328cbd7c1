//! The camera: its position and orientation ([`ViewTransform`]), its view volume ([`Projection`]) and the rectangle of the
//! target that shows it ([`Viewport`]). Start with [`Camera::framing`].
//!
#![doc = include_str!("../book/projections.md")]

mod borders;
#[allow(clippy::module_inception)] // the type has the folder's name
mod camera;
mod camera_error;
mod depth_by_w;
mod distance;
mod framing;
mod picking;
mod plane_eye;
mod projected;
mod projection;
mod rotation;
mod screen_vertex;
mod size_on_screen;
mod upright;
mod vertex_transform;
mod view_transform;
mod viewport;
mod visibility;

pub(crate) use borders::Borders;
pub use camera::Camera;
pub use camera_error::CameraError;
pub(crate) use plane_eye::PlaneEye;
pub use projected::Projected;
pub use projection::{Projection, Window};
pub use rotation::Rotation;
pub use screen_vertex::ScreenVertex;
pub(crate) use screen_vertex::UnpackedVertex;
pub(crate) use size_on_screen::SizeOnScreen;
pub use upright::Upright;
pub(crate) use vertex_transform::{DepthOf, VertexTransform};
pub use view_transform::ViewTransform;
pub use viewport::Viewport;
pub use visibility::{Frustum, Visibility};
