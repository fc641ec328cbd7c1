//! X1 to X5: textures. X1: S3's torus, with a picture of 64 × 64 texels once round; X2: a floor over the whole picture, whose
//! far end is 5.6 times as far away as its near end; X3: a floor rolled by 25 degrees, which the near plane cuts; X4: one rolled
//! by 20 degrees that reaches the horizon, a thousand times as far away; X5: X2's floor over
//! 16 texels, each of them 5 to 28 pixels wide. X2 and X4 also in colours at their corners.

use super::{count, draw_faces, drawn, Counted, Memory, Plain, TORUS};
use crate::lists::{COPIES, PICTURE, TORUS_UV};
use crate::scene::{self, area, Scene, View};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{Rgb565, Rgb888, RgbColor};
use pinhole::space::{Model, World};
use pinhole::{
    prelude::*,
    shading::SpanShader,
    texture::{Accuracy, BilinearTexels, MipPicture, MipTexels, Texels},
};

/// The coordinates of the corners of a face of the torus.
#[inline(always)]
pub(super) fn torus_uv(face: usize) -> [[i16; 2]; 3] {
    TORUS_UV.get(face).copied().unwrap_or_default()
}

/// The picture, by an accuracy.
pub(super) fn plain(accuracy: Accuracy) -> Texture<&'static [[Rgb565; 64]; 64]> {
    Texture::new(&PICTURE).with_accuracy(accuracy)
}

/// The picture with its reduced copies.
pub(super) fn copies() -> Texture<MipTexels<&'static MipPicture<Rgb565, 64, 64>>> {
    static PICTURES: MipPicture<Rgb565, 64, 64> = MipPicture::new(COPIES, PICTURE);
    Texture::new(MipTexels::new(&PICTURES))
}

/// The picture, mixed of four texels.
pub(super) fn bilinear() -> Texture<BilinearTexels<&'static [[Rgb565; 64]; 64]>> {
    Texture::new(BilinearTexels::new(&PICTURE))
}

/// The two faces of a quad.
const QUAD: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// A quad before an eye at the origin, and how many texels lie along its sides.
pub(super) struct Floor {
    pub(super) mesh: Mesh<'static>,
    texels: i16,
}

const fn quad(corners: &'static [[i16; 3]; 4], exponent: i8, texels: i16) -> Floor {
    let Ok(mesh) = Mesh::new(corners, exponent, &QUAD) else { panic!("faces") };
    Floor { mesh, texels }
}

pub(super) static X2: Floor =
    quad(&[[-1025, -1025, -1741], [1025, -1025, -1741], [5729, 5729, -9728], [-5729, 5729, -9728]], -10, 128);
pub(super) static X3: Floor =
    quad(&[[-5136, -3525, -410], [6001, 1669, -410], [6001, 1669, -9728], [-5136, -3525, -9728]], -10, 64);
pub(super) static X4: Floor = quad(
    &[[-27052, -9880, -29], [27074, 9820, -29], [27074, 9820, -32000], [-27052, -9880, -32000]],
    -5,
    1600,
);
pub(super) static X5: Floor =
    quad(&[[-1025, -1025, -1741], [1025, -1025, -1741], [5729, 5729, -9728], [-5729, 5729, -9728]], -10, 16);

/// An eye at the origin, which looks along −z.
pub(super) const FLOOR_VIEW: View =
    View { ahead: [0, 0, -1 << 16], range: [1 << 15, 2000 << 16], ..View::new([0; 3], area().size) };

#[inline(always)]
pub(super) fn floor<S: Texels<Color = Rgb565, Ink = Rgb565>>(
    floor: &'static Floor,
    texture: Texture<S>,
    Plain { frame, corners, .. }: &mut Plain<4>,
) -> Option<Counted> {
    let (camera, floor) = (FLOOR_VIEW.camera()?, black_box(floor));
    let instance = camera.place(&floor.mesh, &Affine::<Model, World>::identity());
    let t = floor.texels.wrapping_mul(16);
    let uv = [[0, t], [t, t], [t, 0], [0, 0]];
    count(frame, &mut |picture| {
        let (instance, texture, uv) = black_box((&instance, &texture, &uv));
        let mesh = instance.mesh();
        let shade = |face| texture.at(mesh.corners_of(face, uv));
        drawn(instance.faces(shade).cached(corners).draw(&mut picture.pixels()))
    })
}

/// A floor without a texture, from blue at the near end to white at the far one.
#[inline(always)]
pub(super) fn gouraud_floor<S: SpanShader<Rgb565, Ink = Rgb565>>(
    floor: &'static Floor,
    shader: impl Fn(Gouraud) -> S,
    Plain { frame, corners, .. }: &mut Plain<4>,
) -> Option<Counted> {
    let (camera, floor) = (FLOOR_VIEW.camera()?, black_box(floor));
    let instance = camera.place(&floor.mesh, &Affine::<Model, World>::identity());
    let colors = [Rgb888::BLUE, Rgb888::BLUE, Rgb888::WHITE, Rgb888::WHITE];
    count(frame, &mut |picture| {
        let (instance, colors) = black_box((&instance, &colors));
        let shade = |face| shader(Gouraud::new(instance.mesh().corners_of(face, colors)));
        drawn(instance.faces(shade).cached(corners).draw(&mut picture.pixels()))
    })
}

#[inline(always)]
pub(super) fn torus<S: Texels<Color = Rgb565, Ink = Rgb565>, const DEPTH_ROWS: usize>(
    texture: Texture<S>,
    Memory { frame, depth, corners }: &mut Memory<TORUS, DEPTH_ROWS>,
) -> Option<Counted> {
    let scene = Scene::new(&scene::TORUS_BY_PLANES)?;
    let instance = scene.place();
    count(frame, &mut |picture| {
        let (instance, texture) = black_box((&instance, &texture));
        let shade = |face: usize| texture.at(torus_uv(face));
        draw_faces(instance.faces(shade).culled_by_planes().cached(corners), depth, &mut picture.pixels())
    })
}
