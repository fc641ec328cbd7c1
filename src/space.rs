//! Coordinate spaces as type tags: code that mixes two spaces does not compile. Start with [`Model`] and [`World`].
//!
#![doc = include_str!("book/coordinates.md")]
//!
#![doc = include_str!("book/coordinates.svg")]
//!
#![doc = include_str!("book/signs.md")]
//!
//! # Spaces are not mixed
//!
//! Screen coordinates have their own arithmetic, so [`ScreenPoint`](crate::raster::ScreenPoint) is a type of its own.
//!
//! A transform from model space takes no point in world space:
//!
//! ```
//! use pinhole::prelude::*;
//! let place = Affine::<Model, World>::identity();
//! let _: Point3<World> = place.apply(Point3::<Model>::from_ints(1, 2, 3));
//! ```
//! ```compile_fail,E0308
//! use pinhole::prelude::*;
//! let place = Affine::<Model, World>::identity();
//! let _: Point3<World> = place.apply(Point3::<World>::from_ints(1, 2, 3));
//! ```
//!
//! Transforms compose only if the first one's target is the second one's source:
//!
//! ```
//! use pinhole::{prelude::*, Angle};
//! let spin = Affine::<Model, Model>::rotation_y(Angle::degrees(30));
//! let _ = spin.then(&Affine::<Model, World>::identity());
//! ```
//! ```compile_fail,E0308
//! use pinhole::{prelude::*, Angle};
//! let spin = Affine::<Model, Model>::rotation_y(Angle::degrees(30));
//! let _ = spin.then(&Affine::<World, World>::identity());
//! ```
//!
//! Only a [`ViewTransform`](crate::ViewTransform) maps to view space:
//!
//! ```
//! use pinhole::prelude::*;
//! let _ = Affine::<Model, World>::identity();
//! ```
//! ```compile_fail,E0599
//! use pinhole::{space::{View, World}, Affine};
//! let _ = Affine::<World, View>::identity();
//! ```

/// Model space: the coordinates of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Model {}

/// World space: the coordinates of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum World {}

/// View space: the coordinates u (right), v (up), n (towards the viewer) of the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum View {}

/// Normalised device coordinates: x to the right, y up, z away from the viewer; the view volume is −1 … 1 on all axes, with the
/// near plane at z = −1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Ndc {}

pub(crate) use scene_space::SceneSpace;

/// A trait that no other crate can name.
mod scene_space {
    use super::{Model, World};

    /// A space in which a scene is set up: [`Model`] or [`World`]. [`Affine`](crate::Affine) maps between these; each later space
    /// is reached by one function.
    #[diagnostic::on_unimplemented(
        message = "an affine transform cannot lead from or to `{Self}`",
        label = "not `Model` or `World`",
        note = "`ViewTransform` leads to `View`, `Projection` and `Viewport` to the screen"
    )]
    pub trait SceneSpace: Copy {}

    impl SceneSpace for Model {}
    impl SceneSpace for World {}
}
