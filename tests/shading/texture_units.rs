//! Texture coordinates in every unit, on faces of every size: exact texels, and rays in f64.

use crate::texture_rays::{camera_on, library, numbered, Faces};
use crate::textures::{Wide, PACKING};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use pinhole::{Affine, Mesh, Picture, TexelSlice, Texture};
use support::oracle::chain::{self, M4};
use support::oracle::rng::Rng;

/// x and y from −1 to 1, over z from −0.5 to −300.
fn parallel() -> M4 {
    chain::orthographic(-1.0, 1.0, -1.0, 1.0, 0.5, 300.0)
}

/// A picture of W × W pixels that shows 64 × 64 texels once: pixel (x, y) shows texel (⌊(2x + 1)·32/W⌋, ⌊(2y + 1)·32/W⌋).
#[test]
fn a_square_shows_the_picture_once_in_every_unit() {
    let texels: Vec<Rgb888> = (0..64 * 64).map(|i| Rgb888::new((i % 64) as u8, (i / 64) as u8, 1)).collect();
    let texels = TexelSlice::new(&texels, 64, 64).unwrap();
    let units = (-14..=0).map(|exponent| {
        let texture = Texture::new(texels).with_exponent(exponent).unwrap();
        (format!("exponent {exponent}"), texture, 1i16 << -exponent)
    });
    let by_default = ("1/16 texel".to_string(), Texture::new(texels), 1024);
    for (name, texture, end) in units.chain([by_default]) {
        // One side of the picture.
        let uv = [[0, end], [end, end], [end, 0], [0, 0]];
        for side in [64, 600, 1500] {
            let vertices = [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]];
            let mesh = Mesh::new(&vertices, 0, &[[0, 1, 2], [0, 2, 3]]).unwrap();
            let camera = camera_on(side, &library(&parallel()));
            let instance = camera.place(&mesh, &Affine::identity());
            let draw = |is_clamped: bool| {
                let mut pixels = vec![Rgb888::BLACK; (side * side) as usize];
                let mut picture = Picture::new(&mut pixels, Size::new_equal(side)).unwrap();
                let mut picture = picture.pixels();
                let Ok(_) = match is_clamped {
                    true => {
                        instance.solid(|f| texture.clamped_at(mesh.corners_of(f, &uv)), &mut [], &mut picture)
                    }
                    false => instance.solid(|f| texture.at(mesh.corners_of(f, &uv)), &mut [], &mut picture),
                };
                pixels
            };
            for is_clamped in [false, true] {
                for (i, pixel) in draw(is_clamped).into_iter().enumerate() {
                    assert_eq!(pixel.b(), 1);
                    let at = [i as u32 % side, i as u32 / side];
                    for (at, shown) in at.into_iter().zip([pixel.r(), pixel.g()]) {
                        let (texel, rest) = ((2 * at + 1) * 32 / side, (2 * at + 1) * 32 % side);
                        // Within 1/16 texel of two texels' border either will do.
                        let is_near = |border: u32| rest.abs_diff(border) <= side / 16;
                        let off = i64::from(shown) - i64::from(texel);
                        let allowed = off == 0 || off == 1 && is_near(side) || off == -1 && is_near(0);
                        assert!(allowed, "{name}, {side} px, clamped {is_clamped}: {shown}, not {texel}");
                    }
                }
            }
        }
    }
}

/// Random triangles of up to 24, 200 and 700 pixels, in every unit, over ranges from one unit to all of `i16`, in a parallel projection
/// and in perspective, cut by the near plane, too. No pixel is farther from a ray's texel than documented: by 2⁻¹³ of the range or 1/400
/// texel and, in perspective, by the accuracy and the error of the planes.
#[test]
fn every_unit_and_range_is_as_exact_as_documented() {
    let mut rng = Rng::new(71);
    let (mut pixels, mut largest) = (0, [0.0f64; 2]);
    for (exponent, range) in
        (-15i8..=0).flat_map(|exponent| [1, 2, 3, 16, 300, 5000, 65_535].map(|range| (exponent, range)))
    {
        for (side, is_parallel) in [24, 200, 700].into_iter().flat_map(|side| [(side, true), (side, false)]) {
            let matrix = match is_parallel {
                true => parallel(),
                false => chain::perspective(0x2aaa_aaab, side, side, 0.5, 2000.0),
            };
            let camera = camera_on(side, &library(&matrix));
            let bits = [(); 2].map(|()| 3 + rng.below(6) as u32);
            let unit = bits.map(|bits| 2f64.powi(bits as i32 + i32::from(exponent)));
            let faces = any_face(&mut rng, side, range, is_parallel);
            let uv = &faces.uv[0];
            // The larger range of u and v in texels: of their own, and with 0.
            let [extent, reach] = [None, Some(0.0)].map(|zero| {
                let of = |axis: usize| {
                    let values = || uv.iter().map(|uv| f64::from(uv[axis])).chain(zero);
                    (values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)) * unit[axis]
                };
                of(0).max(of(1))
            });
            // From the near plane on.
            let w = || faces.vertices.iter().map(|&[.., z]| f64::from(-z).max(32.0));
            let ratio = w().fold(0.0, f64::max) / w().fold(f64::MAX, f64::min);
            let (ray, texels) = (faces.ray(0, &matrix, unit), numbered(bits));
            let texture = Texture::new(texels).with_exponent(exponent).unwrap();
            let wide = Texture::new(Wide(texels)).with_exponent(exponent).unwrap();
            let (clamped, count) = ray.worst_clamped(&faces.draw(0, &camera, texture.clamped_at(*uv)), bits);
            let (repeated, _) = ray.worst_repeated(&faces.draw(0, &camera, wide.at(*uv)), bits);
            let (packed, _) = ray.worst_repeated(&faces.draw(0, &camera, texture.at(*uv)), bits);
            let packing = f64::from(1 << bits[0].max(bits[1])) * PACKING;
            for (name, worst, range) in [
                ("clamped", clamped, reach),
                ("repeated", repeated, extent),
                ("packed", packed - packing, extent),
            ] {
                let linear = (range * 2f64.powi(-13)).max(1.0 / 400.0);
                let planes = 0.25 + 8.0 * 2f64.powi(-24) * range * ratio;
                let bound = if is_parallel { linear } else { linear + planes };
                let case = format!("{name}, 2^{exponent}, {uv:?} of {bits:?}, {side} px, {is_parallel}");
                assert!(worst <= bound, "{case}: {worst} of {bound}");
                if is_parallel {
                    let kind = usize::from(linear > 1.0 / 400.0);
                    largest[kind] = largest[kind].max(worst / linear);
                }
            }
            pixels += count;
        }
    }
    // The bounds are at most twice the errors that are met.
    assert!(pixels > 3_000_000 && largest.iter().all(|&share| share > 0.5), "{pixels} pixels, {largest:?}");
}

/// One face, across a part of the screen or, in perspective, from any depth; its coordinates have a range of `range` units or less.
fn any_face(rng: &mut Rng, side: u32, range: i64, is_parallel: bool) -> Faces {
    let mut faces = Faces { side, ..Faces::new(-6) };
    let corners = [(); 3].map(|()| {
        let reach = if is_parallel { 64 } else { 300 };
        let z = if is_parallel { -64 } else { rng.int(-900, 60) };
        [rng.int(-reach, reach), rng.int(-reach, reach), z].map(|c| c as i16)
    });
    let least = [(); 2].map(|()| match rng.below(3) {
        0 => 0,
        1 => rng.int(i64::from(i16::MIN), i64::from(i16::MAX) - range),
        _ => -rng.int(0, range.min(1 << 15)),
    });
    let uv = [(); 3].map(|()| {
        least.map(|least| {
            (least + [0, range, rng.int(0, range)][rng.below(3)]).min(i64::from(i16::MAX)) as i16
        })
    });
    faces.push(corners, uv);
    faces
}
