//! Whether a mesh has face planes, as a type.

/// Whether a [`Mesh`](crate::Mesh) has face planes, by which its back faces are culled early: [`WithPlanes`] or
/// [`WithoutPlanes`]. Sealed: no other type can implement it.
///
/// It is the last type parameter of a mesh, and of the types that are made from a mesh. Generic code has it as a parameter, too:
///
/// ```
/// use pinhole::{mesh::FacePlanes, prelude::*, Angle};
/// fn placed<'m, P: FacePlanes>(camera: &Camera, mesh: &'m Mesh<'m, i16, P>, turn: Angle) -> MeshInstance<'m, i16, P> {
///     camera.place(mesh, &Affine::rotation_y(turn))
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not say whether a mesh has face planes",
    label = "not `WithPlanes` or `WithoutPlanes`",
    note = "a mesh has type `Mesh<'a>` without planes, and `Mesh<'a, i16, WithPlanes>` after `with_planes`; code for both has a parameter `P: FacePlanes`"
)]
pub trait FacePlanes: Copy + core::fmt::Debug + sealed::Sealed {
    /// Whether faces are culled by planes.
    #[doc(hidden)]
    const CULL: bool;
}

/// Marks a mesh that has face planes, as the parameter `P` of [`Mesh`](crate::Mesh): [`with_planes`](crate::Mesh::with_planes)
/// makes one, and says what planes are for. No value of this type exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum WithPlanes {}

/// Marks a mesh that has no face planes, as the parameter `P` of [`Mesh`](crate::Mesh): the default. No value of this type exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum WithoutPlanes {}

impl FacePlanes for WithPlanes {
    const CULL: bool = true;
}

impl FacePlanes for WithoutPlanes {
    const CULL: bool = false;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::WithPlanes {}
    impl Sealed for super::WithoutPlanes {}
}
