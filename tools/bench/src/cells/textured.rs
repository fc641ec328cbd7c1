//! X1 to X4: textures. X1: S3's torus, with a picture of 64 × 64 texels once round; X2: a floor over the whole picture, whose
//! far end is 5.6 times as far away as its near end; X3: a floor rolled by 25 degrees, which the near plane cuts; X4: one rolled
//! by 20 degrees that reaches the horizon, a thousand times as far away.

use super::{count, draw_faces, drawn, Counted, Memory, Plain, TORUS};
use crate::scene::{self, Scene, SIZE};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::space::{Model, World};
use pinhole::{prelude::*, texture::Accuracy, Angle};

/// A side of the picture, in texels.
const SIDE: usize = 64;

/// A picture with a different colour for nearly every texel.
pub(super) static PICTURE: [[Rgb565; SIDE]; SIDE] = {
    let mut picture = [[Rgb565::new(0, 0, 0); SIDE]; SIDE];
    let mut at = 0;
    while at < SIDE * SIDE {
        let (x, y) = (at % SIDE, at / SIDE);
        picture[y][x] = Rgb565::new((x / 2) as u8, y as u8, (31 - (x + y) / 4) as u8);
        at += 1;
    }
    picture
};

/// The coordinates of the corners of a face of the torus.
#[inline(always)]
pub(super) fn torus_uv(face: usize) -> [[i16; 2]; 3] {
    TORUS_UV.get(face).copied().unwrap_or_default()
}

/// Texture coordinates of the corners of each face of the torus, in 1/16 texel: once round 25 rings of 20 vertices, with two faces for
/// each vertex.
static TORUS_UV: [[[i16; 2]; 3]; 1000] = {
    let mut uv = [[[0; 2]; 3]; 1000];
    let mut vertex = 0;
    while vertex < 500 {
        let (ring, at) = (vertex / 20, vertex % 20);
        let [a, b] = [torus_corner(ring, at), torus_corner(ring + 1, at)];
        let [c, d] = [torus_corner(ring + 1, at + 1), torus_corner(ring, at + 1)];
        (uv[2 * vertex], uv[2 * vertex + 1]) = ([a, b, c], [a, c, d]);
        vertex += 1;
    }
    uv
};

const fn torus_corner(ring: usize, at: usize) -> [i16; 2] {
    [(16 * SIDE * ring / 25) as i16, (16 * SIDE * at / 20) as i16]
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

/// An eye at the origin, which looks along −z.
#[inline(never)]
pub(super) fn camera() -> Option<Camera> {
    let [eye, ahead] = [0, -1].map(|z| Point3::from_ints(0, 0, z));
    let view = ViewTransform::look_at(eye, ahead, Vector3::from_ints(0, 1, 0)).ok()?;
    let (near, far) = (Scalar::from_bits(black_box(1 << 15)), Scalar::from_bits(black_box(2000 << 16)));
    let size = Size::new(SIZE, SIZE);
    let lens = Projection::perspective(Angle::degrees(black_box(60)), size, near, far).ok()?;
    Some(Camera::new(&view, &lens, &Viewport::new(Point::zero(), size).ok()?))
}

#[inline(always)]
pub(super) fn floor(
    floor: &'static Floor,
    accuracy: Accuracy,
    Plain { frame, corners, .. }: &mut Plain<4>,
) -> Option<Counted> {
    let (camera, floor) = (camera()?, black_box(floor));
    let instance = camera.place(&floor.mesh, &Affine::<Model, World>::identity());
    let texture = Texture::new(&PICTURE).with_accuracy(accuracy);
    let t = floor.texels.wrapping_mul(16);
    let uv = [[0, t], [t, t], [t, 0], [0, 0]];
    count(frame, &mut |picture| {
        let (instance, texture, uv) = black_box((&instance, &texture, &uv));
        let mesh = instance.mesh();
        let shade = |face| texture.at(mesh.corners_of(face, uv));
        drawn(instance.faces(shade).cached(corners).draw(&mut picture.pixels()))
    })
}

#[inline(always)]
pub(super) fn torus<const DEPTHS: usize>(
    accuracy: Accuracy,
    Memory { frame, depth, corners }: &mut Memory<TORUS, DEPTHS>,
) -> Option<Counted> {
    let scene = Scene::new(&scene::TORUS_BY_PLANES)?;
    let (texture, instance) = (Texture::new(&PICTURE).with_accuracy(accuracy), scene.place());
    count(frame, &mut |picture| {
        let (instance, texture) = black_box((&instance, &texture));
        let shade = |face: usize| texture.at(torus_uv(face));
        draw_faces(instance.faces(shade).culled_by_planes().cached(corners), depth, &mut picture.pixels())
    })
}
