//! Sprites at the vertices of a mesh, keyed and scaled by their distance, into a picture in memory.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// 128 bytes, which count.
static TEXELS: [[Rgb565; 8]; 8] = {
    let mut texels = [[Rgb565::RED; 8]; 8];
    texels[2] = [Rgb565::GREEN; 8];
    texels
};

image!(cube, memory: [Rgb565; pixels(ROWS)] = [scene::BACKGROUND; pixels(ROWS)], {
    let scene = Turntable::new();
    let points = scene.camera().place_sprites(&cube.mesh, scene.model());
    let mut picture = Picture::new(memory, black_box(Size::new(scene::SIZE, ROWS))).ok()?;
    let side = black_box(Scalar::from_bits(1 << 14));
    let sprite = Sprite::new(ColorKeyed::new(black_box(&TEXELS), Rgb565::GREEN)).with_size(side, side);
    let Ok(_) = points.draw(|_| sprite, &mut picture.pixels());
    black_box(picture.colors());
    Some(())
});
