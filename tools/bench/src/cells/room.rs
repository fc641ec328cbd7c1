//! R1: a room of 4 by 5 fields with a wall across a part of it, 60 quads with X1's picture on each, before an eye inside: the near
//! plane cuts some of them. No quad hides one that comes later in the mesh, so that mesh order is painter's order.

use super::foggy::fog;
use super::{count, draw_faces, Counted};
use crate::lists::PICTURE;
use crate::scene::{View, ROOM};
use core::hint::black_box;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::draw::ShaderFor;
use pinhole::space::{Model, World};
use pinhole::{prelude::*, target::Pixels, texture::Texels};

const COLUMNS: usize = 320;
pub(super) const ROWS: usize = 240;
/// With the vertices of the room.
pub(super) type Memory<const DEPTH_ROWS: usize> = super::Memory<112, DEPTH_ROWS, COLUMNS, ROWS>;

/// Near the corner at the origin, looking along the room.
const VIEW: View = View {
    ahead: [301_466, 52_429, -524_288],
    degrees: 75,
    range: [6_554, 30 << 16],
    ..View::new([85_197, 65_536, -58_982], Size::new(COLUMNS as u32, ROWS as u32))
};
/// The farthest corner has a distance of 10.
const FOG: [i32; 2] = [1, 9];

/// The texture coordinates of the corners of both faces of a quad, in 1/16 texel.
static UV: [[[i16; 2]; 3]; 2] = [[[0, 1024], [1024, 1024], [1024, 0]], [[0, 1024], [1024, 0], [0, 0]]];

#[inline(always)]
fn draw<S: for<'p> ShaderFor<Pixels<'p, Rgb565>>, const DEPTH_ROWS: usize>(
    camera: &Camera,
    shade: impl Fn([[i16; 2]; 3]) -> S,
    Memory { frame, depth, corners }: &mut Memory<DEPTH_ROWS>,
) -> Option<Counted> {
    count(frame, &mut |picture| {
        let (camera, room, uv) = black_box((camera, &ROOM, &UV));
        let instance = camera.place(&room.mesh, &Affine::<Model, World>::identity());
        let shade = |face: usize| shade(uv[face & 1]);
        draw_faces(instance.faces(shade).cached(corners), depth, &mut picture.pixels())
    })
}

#[inline(always)]
pub(super) fn textured<S: Texels<Color = Rgb565, Ink = Rgb565>, const DEPTH_ROWS: usize>(
    texture: Texture<S>,
    memory: &mut Memory<DEPTH_ROWS>,
) -> Option<Counted> {
    let texture = black_box(texture);
    draw(&VIEW.camera()?, |uv| texture.at(uv), memory)
}

#[inline(always)]
pub(super) fn fogged<const DEPTH_ROWS: usize>(memory: &mut Memory<DEPTH_ROWS>) -> Option<Counted> {
    let camera = VIEW.camera()?;
    let (texture, fog) = black_box((Texture::new(&PICTURE), fog(FOG, &camera)?));
    draw(&camera, |uv| Fogged::new(texture.at(uv), &fog), memory)
}
