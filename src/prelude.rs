//! What most programs need, in one line: `use pinhole::prelude::*`. Everything else is in the modules by topic.
//!
//! The names do not collide with those of `embedded_graphics::prelude`, so both preludes can be imported. [`Angle`](crate::Angle)
//! is not here, because `embedded-graphics` has an `Angle` too: write `pinhole::Angle`.
//!
//! ```
//! use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
//! use pinhole::prelude::*;
//!
//! let size = Size::new(64, 64);
//! let viewport = Viewport::new(Point::zero(), size)?;
//! let turned = Affine::<Model, World>::identity().rotate_y(pinhole::Angle::degrees(30));
//! let color = Rgb565::RED;
//! # Ok::<(), pinhole::camera::CameraError>(())
//! ```

// `MeshBuffers` and `StripBuffers` are each a type and a macro: this exports both.
pub use crate::{mesh_buffers, strip_buffers, MeshBuffers, StripBuffers};

pub use crate::bands::{Band, Frame};
pub use crate::camera::{Camera, Projection, ScreenVertex, ViewTransform, Viewport};
pub use crate::color::Color;
pub use crate::draw::{BinnedFaces, Cull, MeshInstance, Object, Painter, Scene, Statistics};
pub use crate::fog::Fogged;
pub use crate::light::{Lambert, Light};
pub use crate::math::{Affine, Point3, Scalar, Vector3};
pub use crate::mesh::Mesh;
pub use crate::shading::{Dithered, Flat, Gouraud, ScreenDoor, ShadeTable};
pub use crate::space::{Model, World};
pub use crate::sprite::Sprite;
pub use crate::target::{DepthBuffer, Picture, Surface, Target};
pub use crate::texture::Texture;
