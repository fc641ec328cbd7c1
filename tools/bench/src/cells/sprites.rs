//! B1: fifty keyed sprites, billboards of 16 × 16 texels on the torus's vertices, scaled by their distance and tested for depth.

use super::{count, drawn, Counted, Deep};
use crate::scene::{self, area};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use pinhole::{prelude::*, texture::ColorKeyed};

/// A side of the picture, in texels.
const SIDE: usize = 16;

/// A disc on a transparent background, with a different colour for nearly every texel.
static DISC: [[Rgb565; SIDE]; SIDE] = {
    let mut picture = [[KEY; SIDE]; SIDE];
    let mut at = 0;
    while at < SIDE * SIDE {
        let (x, y) = (at % SIDE, at / SIDE);
        // In halves of a texel from the middle.
        let [u, v] = [2 * x as i32 - 15, 2 * y as i32 - 15];
        if u * u + v * v < 15 * 15 {
            picture[y][x] = Rgb565::new(31, 2 * y as u8, 2 * x as u8);
        }
        at += 1;
    }
    picture
};
const KEY: Rgb565 = Rgb565::MAGENTA;

/// Each tenth vertex of the torus.
static POINTS: [[i16; 3]; 50] = {
    let vertices = scene::TORUS.mesh.vertices();
    let mut points = [[0; 3]; 50];
    let mut at = 0;
    while at < 50 {
        points[at] = vertices[10 * at];
        at += 1;
    }
    points
};

pub(super) fn b1_z(Deep { frame, depth, .. }: &mut Deep<0>) -> Option<Counted> {
    let model = black_box(&scene::TORUS);
    let mesh = Mesh::new(black_box(&POINTS), model.mesh.exponent(), &[]).ok()?;
    let (camera, turned) = (model.camera()?, model.turned());
    let side = black_box(Scalar::from_bits(1 << 14));
    count(frame, &mut |picture| {
        let (camera, mesh, turned) = black_box((&camera, &mesh, &turned));
        let mut depth = DepthBuffer::new(black_box(area()), &mut depth.0).ok()?;
        let sprite = Sprite::new(ColorKeyed::new(&DISC, KEY)).with_size(side, side);
        let placed = camera.place_sprites(mesh, turned);
        drawn(placed.draw(|_| sprite, &mut picture.pixels().depth_tested(&mut depth)))
    })
}
