//! B1 and P1: 50 and 200 keyed sprites, billboards of 16 × 16 and 8 × 8 texels on the torus's vertices, scaled by their distance and
//! tested for depth.

use super::{count, drawn, Counted, Deep};
use crate::scene;
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use pinhole::{prelude::*, texture::ColorKeyed};

/// Points of the torus with a picture on each; the sides of the sprites are in 2⁻¹⁶.
#[inline(always)]
pub(super) fn sprites<const SIDE: usize>(
    points: &'static [[i16; 3]],
    disc: &'static [[Rgb565; SIDE]; SIDE],
    side: i32,
    Deep { frame, depth, .. }: &mut Deep<0>,
) -> Option<Counted> {
    let model = black_box(&scene::TORUS);
    let mesh = Mesh::new(black_box(points), model.mesh.exponent(), &[]).ok()?;
    let (camera, turned) = (model.camera()?, model.turned());
    let side = black_box(Scalar::from_bits(side));
    count(frame, &mut |picture| {
        let (camera, mesh, turned) = black_box((&camera, &mesh, &turned));
        let mut depth = depth.buffer()?;
        let sprite = Sprite::new(ColorKeyed::new(disc, Rgb565::MAGENTA)).with_size(side, side);
        let placed = camera.place_sprites(mesh, turned);
        drawn(placed.draw(|_| sprite, &mut picture.pixels().depth_tested(&mut depth)))
    })
}
