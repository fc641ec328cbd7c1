//! B1: fifty keyed sprites, billboards of 16 × 16 texels on the torus's vertices, scaled by their distance and tested for depth.

use super::{count, drawn, Counted, Deep};
use crate::lists::{DISC, POINTS};
use crate::scene;
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use pinhole::{prelude::*, texture::ColorKeyed};

/// The transparent colour.
const KEY: Rgb565 = Rgb565::MAGENTA;

pub(super) fn b1_z(Deep { frame, depth, .. }: &mut Deep<0>) -> Option<Counted> {
    let model = black_box(&scene::TORUS);
    let mesh = Mesh::new(black_box(&POINTS), model.mesh.exponent(), &[]).ok()?;
    let (camera, turned) = (model.camera()?, model.turned());
    let side = black_box(Scalar::from_bits(1 << 14));
    count(frame, &mut |picture| {
        let (camera, mesh, turned) = black_box((&camera, &mesh, &turned));
        let mut depth = depth.buffer()?;
        let sprite = Sprite::new(ColorKeyed::new(&DISC, KEY)).with_size(side, side);
        let placed = camera.place_sprites(mesh, turned);
        drawn(placed.draw(|_| sprite, &mut picture.pixels().depth_tested(&mut depth)))
    })
}
