//! Texels mixed of four neighbours, against f64, which shares no code with the library. That pixels are equal by every draw call is tested in
//! `mips`.

use crate::rays::{camera, floor, library, perspective, Faces, PACKING, WALL};
use crate::scene::Own;
use embedded_graphics::pixelcolor::{Bgr555, Bgr666, BinaryColor, Gray4, Gray8, Rgb565, Rgb888, RgbColor};
use pinhole::{
    color::Color,
    prelude::*,
    texture::{Accuracy, BilinearTexels, TexelSlice, Texels},
};
use support::oracle::rng::Rng;
use support::oracle::texture::bilinear;

/// The largest error of a channel at random points of random pictures, beyond half a level, in shares of its highest level.
fn worst<C: Color + std::fmt::Debug>(rng: &mut Rng) -> f64 {
    let (mut worst, [width, height]) = (0.0f64, [8i64, 16]);
    for _ in 0..40 {
        // All levels, or the extremes alone, which show errors of shares best.
        let is_extreme = rng.below(2) == 0;
        let texels: Vec<C> = (0..width * height)
            .map(|_| {
                C::from_channels(C::FORMAT.max().map(|max| match is_extreme {
                    true => [0, max][rng.below(2)],
                    false => rng.int(0, max.into()) as u8,
                }))
            })
            .collect();
        let plain = TexelSlice::new(&texels, 8, 16).unwrap();
        let mixed = BilinearTexels::new(plain);
        for _ in 0..500 {
            let [u, v] = [(); 2].map(|()| rng.next() as u32);
            let at = [(u, width), (v, height)].map(|(c, side)| f64::from(c) / 2f64.powi(32) * side as f64);
            let shown = mixed.texel(u, v).channels();
            for (i, max) in C::FORMAT.max().into_iter().enumerate().filter(|(_, max)| *max > 0) {
                let level = |[u, v]: [i64; 2]| {
                    f64::from(
                        texels[(v.rem_euclid(height) * width + u.rem_euclid(width)) as usize].channels()[i],
                    )
                };
                let off = (f64::from(shown[i]) - bilinear(at, &level)).abs() - 0.5;
                worst = worst.max(off / f64::from(max));
            }
        }
        // At a texel's centre it is that texel.
        for (i, texel) in texels.iter().enumerate() {
            let [u, v] = [(i as u32 % 8 * 2 + 1) << 28, (i as u32 / 8 * 2 + 1) << 27];
            assert_eq!(mixed.texel(u, v), *texel);
        }
    }
    worst
}

/// `BilinearTexels` promises half a level and these shares of the highest one: with shares in 1/32, and in 1/256.
const BOUNDS: [f64; 2] = [1.0 / 16.0, 1.0 / 128.0];

#[test]
fn texels_of_every_format_are_mixed_of_four() {
    let rng = &mut Rng::new(17);
    let [coarse, fine] = BOUNDS;
    for (name, worst, bound) in [
        ("Rgb565", worst::<Rgb565>(rng), coarse),
        ("Bgr555", worst::<Bgr555>(rng), coarse),
        ("Bgr666", worst::<Bgr666>(rng), fine),
        ("Rgb888", worst::<Rgb888>(rng), fine),
        ("Gray4", worst::<Gray4>(rng), fine),
        ("Gray8", worst::<Gray8>(rng), fine),
        ("BinaryColor", worst::<BinaryColor>(rng), fine),
        ("Own", worst::<Own>(rng), fine),
    ] {
        assert!((bound / 2.0..=bound).contains(&worst), "{name}: {worst} of {bound}");
    }
}

/// 16 texels of levels that rise and fall by 16 a texel, so that half a texel is 8 levels.
fn wave(at: i64) -> f64 {
    (16 * (8 - at.rem_euclid(16)).abs()) as f64
}

/// A pixel of a magnified face shows the colour at its own coordinates, repeated or clamped, within the error that those have.
#[test]
fn magnified_faces_show_the_mixed_picture() {
    let picture = core::array::from_fn(|v| {
        core::array::from_fn(|u| Rgb888::new(wave(u as i64) as u8, wave(v as i64) as u8, 128))
    });
    let texels: BilinearTexels<&[[Rgb888; 16]; 16]> = BilinearTexels::new(&picture);
    let texture = Texture::new(texels).with_accuracy(Accuracy::Sixteenth);
    let matrix = perspective(2000.0);
    let camera = camera(&library(&matrix));
    let (mut pixels, mut largest) = (0, 0.0f64);
    for faces in [
        Faces::quad(floor(0.5, 9.5, 6.0), 25.0, 40, -10),
        Faces::quad(WALL, 70.0, 50, -4),
        Faces::soup(&mut Rng::new(9), 60, 400, 2500, |rng| rng.int(-800, 800) as i16),
    ] {
        for (face, is_clamped) in (0..faces.uv.len()).flat_map(|face| [(face, false), (face, true)]) {
            let ray = faces.ray(face, &matrix, [1.0 / 16.0; 2]).0;
            let screen = match is_clamped {
                true => faces.draw(face, &camera, texture.clamped_at(faces.uv[face])),
                false => faces.draw(face, &camera, texture.at(faces.uv[face])),
            };
            for (at, shown) in screen.drawn() {
                let Some(covered) = ray.covered(at.x.into(), at.y.into()).filter(|&c| c < 0.8) else {
                    continue;
                };
                let exact = ray.at(f64::from(at.x) + 0.5, f64::from(at.y) + 0.5).unwrap();
                let level = |axis: usize| {
                    move |texel: [i64; 2]| match is_clamped {
                        true => wave(texel[axis].clamp(0, 15)),
                        false => wave(texel[axis]),
                    }
                };
                // 16 levels for a texel of error, of which some is due to the place in the pixel.
                let off = [shown.r(), shown.g()].into_iter().enumerate().map(|(axis, shown)| {
                    (f64::from(shown) - bilinear(exact, &level(axis))).abs() - 16.0 * covered / 64.0
                });
                let off = off.fold(0.0, f64::max);
                largest = largest.max(off);
                pixels += 1;
            }
        }
    }
    let bound = 16.0 * (1.0 / 16.0 + PACKING * 16.0 + 1.0 / 400.0) + 0.5 + 16.0 / 512.0;
    assert!(
        pixels > 50_000 && (bound / 2.0..=bound).contains(&largest),
        "{pixels} pixels, {largest} of {bound}"
    );
}
