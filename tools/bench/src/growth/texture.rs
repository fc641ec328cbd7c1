//! A picture on faces that have no texture coordinates, as the planner lays it on.

use crate::lists::{PALETTE, TEXELS};
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{
    prelude::*,
    texture::{IndexedTexels, LitTextured},
};

/// A side of the picture, in texels.
const SIDE: usize = 64;
/// The unit of coordinates as a power of two, in sides of the picture: a mesh as large as coordinates allow shows it four times.
pub const UNIT: i8 = -14;
/// Texels in a unit of coordinates.
#[cfg(feature = "report")]
pub(super) const TEXELS_OF_UNIT: f64 = SIDE as f64 / (1 << 14) as f64;

/// Each face with the picture on it, in the light that its normal has. `None`: no such picture.
#[inline(always)]
pub(super) fn textured<'s>(
    mesh: &'s Mesh<'s>,
    light: &'s Lambert,
) -> Option<impl Fn(usize) -> LitTextured<IndexedTexels<'static, Rgb565, 8>> + 's> {
    let texture = Texture::new(IndexedTexels::new(&TEXELS, SIDE, SIDE, PALETTE.as_flattened()).ok()?);
    let texture = texture.with_exponent(UNIT).ok()?;
    Some(move |face| {
        let normal = mesh.normals().get(face).copied().unwrap_or_default();
        texture.at(coordinates(mesh, face, normal)).lit([light.level(normal); 3])
    })
}

/// Texture coordinates of a face's corners: the two axes that the face is turned to least.
#[inline(always)]
pub fn coordinates(mesh: &Mesh<'_>, face: usize, normal: [i16; 3]) -> [[i16; 2]; 3] {
    let [x, y, z] = normal.map(i16::unsigned_abs);
    mesh.corners_of(face, mesh.vertices()).map(|[px, py, pz]| match (x >= y && x >= z, y >= z) {
        (true, _) => [if normal[0] > 0 { -pz } else { pz }, -py],
        (_, true) => [px, if normal[1] > 0 { pz } else { -pz }],
        _ => [if normal[2] > 0 { px } else { -px }, -py],
    })
}
