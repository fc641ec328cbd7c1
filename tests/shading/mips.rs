//! Reduced copies of textures: their texels, which copy a pixel shows, and what they are for: a picture close to the mean of what each
//! pixel covers, which changes little when the camera moves a little. Against f64, which shares no code with the library.

use crate::rays::{
    camera, camera_on, everywhere, floor, library, perspective, usual, Faces, Numbered, Shown, FOV, WALL,
};
use embedded_graphics::pixelcolor::{Gray8, GrayColor, Rgb888};
use embedded_graphics::prelude::*;
use pinhole::{
    prelude::*,
    texture::{BilinearTexels, IndexedTexels, MipPicture, MipTexels, Texels},
};
use support::oracle::chain;
use support::oracle::rng::Rng;
use support::oracle::texture::mean_about;

/// The number of the copy that holds a row of the copies, from 0: row i of copy n is (2·i + 1)·2ⁿ⁻¹ − 1.
fn copy_of(row: u32) -> u32 {
    (1..8).find(|n| (row + 1) % (1 << n) == 1 << (n - 1)).expect("a copy")
}

#[test]
fn copies_hold_the_means_of_the_picture() {
    let mut rng = Rng::new(3);
    let picture = [[(); 16]; 32].map(|row| row.map(|()| [(); 3].map(|()| rng.int(0, 255) as u8)));
    let built = MipPicture::build(picture.map(|row| row.map(|[r, g, b]| Rgb888::new(r, g, b))));
    let mut largest = 0.0f64;
    for (copy, column, row) in
        (0..=5u32).flat_map(|copy| (0..16).flat_map(move |u| (0..32).map(move |v| (copy, u, v))))
    {
        // Beyond the last copy there is none.
        for covered in [i32::from(copy == 5) << 21 | (copy as i32) << 16, (copy as i32) << 16 | 0xffff] {
            let texel = MipTexels::new(&built).covered_by(covered).texel(column << 28 | 77, row << 27 | 99);
            let first = i64::from(row >> copy << copy);
            for (axis, shown) in [texel.r(), texel.g(), texel.b()].into_iter().enumerate() {
                let level =
                    |[u, v]: [i64; 2]| f64::from(picture[v as usize % 32][u.rem_euclid(16) as usize][axis]);
                let exact = match copy {
                    0 => level([column.into(), row.into()]),
                    _ => mean_about(column.into(), first..first + (1 << copy), copy, &level),
                };
                largest = largest.max((f64::from(shown) - exact).abs());
            }
        }
    }
    assert!((0.4..=0.5).contains(&largest), "{largest}");
    assert_eq!(MipTexels::new(&built).covered_by(-9 << 16).texel(0, 0), MipTexels::new(&built).texel(0, 0));
}

/// `MipTexels` promises that the level is within log₂ c − `FINER` … log₂ c + `COARSER`, for c texels from a pixel to the next.
const FINER: f64 = 1.5;
const COARSER: f64 = 2.0;

#[test]
fn a_pixel_shows_the_level_of_the_texels_that_it_covers() {
    let (usual, mut rng) = (perspective(2000.0), Rng::new(41));
    let mut soup =
        |reach, deep, uv: i64| Faces::soup(&mut rng, 60, reach, deep, |rng| rng.int(-uv, uv) as i16);
    let quad = |corners, roll, texels, exponent| Faces::quad(corners, roll, texels, exponent);
    let parallel = chain::orthographic(-4.0, 4.0, -4.0, 4.0, -20.0, 20.0);
    let cases = [
        ("rolled floor", usual, quad(floor(0.5, 9.5, 6.0), 25.0, 500, -10)),
        ("rolled horizon", usual, quad(floor(0.9, 1000.0, 900.0), 20.0, 1600, -5)),
        ("wall", usual, quad(WALL, 0.0, 400, -4)),
        ("small triangles", usual, soup(300, 3000, 480)),
        ("large triangles", usual, soup(2000, 3000, 16_000)),
        ("parallel", parallel, soup(200, 100, 1000)),
    ];
    let (mut finer, mut coarser) = (0.0f64, 0.0f64);
    for (name, matrix, faces) in cases {
        let (camera, mut pixels) = (camera(&library(&matrix)), 0);
        let texture = Texture::new(MipTexels::new(Numbered([6, 7])));
        for face in 0..faces.uv.len() {
            let ray = faces.ray(face, &matrix, [1.0 / 16.0; 2]);
            for (at, Shown([_, v])) in faces.draw(face, &camera, texture.at(faces.uv[face])).drawn() {
                let level = if v >> 31 == 1 { 0 } else { copy_of(v >> 25) };
                // Beyond half of the picture steps wrap.
                let Some(covered) = ray.0.covered(at.x.into(), at.y.into()).filter(|&c| c < 32.0) else {
                    continue;
                };
                let (least, most) =
                    (covered.log2() - f64::from(level), f64::from(level) - covered.log2().max(0.0));
                (finer, coarser) = (finer.max(least), coarser.max(if level > 0 { most } else { 0.0 }));
                assert!(
                    least <= FINER && (level == 0 || most <= COARSER),
                    "{name}, face {face}, {at:?}: {level}, {covered}"
                );
                pixels += 1;
            }
        }
        assert!(pixels > 4_000, "{name}: {pixels}");
    }
    assert!(finer > FINER / 2.0 && coarser > COARSER / 2.0, "{finer}, {coarser}");
}

/// Bricks of 32 × 16 texels in four tones, with light mortar between them.
fn bricks([u, v]: [i64; 2]) -> f64 {
    let (course, v) = (v.rem_euclid(64) / 16, v.rem_euclid(16));
    let u = (u + course % 2 * 16).rem_euclid(32);
    if u < 2 || v < 2 {
        200.0
    } else {
        [60.0, 100.0, 80.0, 120.0][course as usize]
    }
}

/// The pixels of faces that cover more than one texel: the face, the place and the level.
type Minified = Vec<(usize, Point, f64)>;

/// A rolled floor as in `examples/surfaces`: with mip levels its pixels are closer to the mean of what they cover, and change less while
/// the floor moves by 1/8 texel a frame.
#[test]
fn a_floor_to_the_horizon_does_not_sparkle() {
    const TEXEL: [f64; 2] = [1.0 / 16.0; 2];
    let picture =
        core::array::from_fn(|v| core::array::from_fn(|u| Gray8::new(bricks([u as i64, v as i64]) as u8)));
    let (built, matrix) =
        (MipPicture::<Gray8, 64, 64>::build(picture), chain::perspective(FOV, 120, 120, 0.125, 400.0));
    let (plain, levels, camera) =
        (Texture::new(&picture), Texture::new(MipTexels::new(&built)), camera_on(120, &library(&matrix)));
    let frame = |number: i16| {
        let mut faces = Faces { side: 120, ..Faces::quad(floor(0.2, 60.0, 60.0), 17.0, 960, -8) };
        faces.uv.iter_mut().flatten().for_each(|uv| uv[1] += 2 * number);
        faces
    };
    let draw = |faces: &Faces, has_levels: bool| -> Minified {
        let minified = |face: usize| {
            let uv = faces.uv[face];
            let screen = match has_levels {
                true => faces.draw(face, &camera, levels.at(uv)),
                false => faces.draw(face, &camera, plain.at(uv)),
            };
            let ray = faces.ray(face, &matrix, TEXEL).0;
            let is_minified = |at: &Point| ray.covered(at.x.into(), at.y.into()).is_some_and(|c| c > 1.0);
            let pixels = screen.drawn().filter(|(at, _)| is_minified(at));
            pixels.map(|(at, level)| (face, at, f64::from(level.luma()))).collect::<Vec<_>>()
        };
        (0..faces.uv.len()).flat_map(minified).collect()
    };
    let rms = |errors: Vec<f64>| (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    let [without, with] = [false, true].map(|has_levels| {
        let (first, frames) =
            (draw(&frame(0), has_levels), (0..9).map(|number| draw(&frame(number), has_levels)));
        assert!(first.len() > 3_000, "{}", first.len());
        let error = |&(face, at, level): &(usize, Point, f64)| {
            Some(level - frame(0).ray(face, &matrix, TEXEL).0.mean(at.x.into(), at.y.into(), 8, &bricks)?)
        };
        let moved = frames.collect::<Vec<_>>();
        let moved =
            moved.windows(2).map(|pair| rms(pair[0].iter().zip(&pair[1]).map(|(a, b)| a.2 - b.2).collect()));
        [rms(first.iter().filter_map(error).collect()), moved.fold(0.0, f64::max)]
    });
    let is_about = |own: f64, figure: f64| (own - figure).abs() < 0.1;
    assert!(is_about(without[0], 29.2) && is_about(with[0], 17.7), "error {without:?} {with:?}");
    assert!(is_about(without[1], 14.3) && is_about(with[1], 11.0), "change {without:?} {with:?}");
}

/// Of copies, of texels mixed of four, and of both, in memory and of a palette.
#[test]
fn faces_with_copies_or_mixed_texels_are_equal_by_every_draw_call() {
    let mut rng = Rng::new(7);
    let built = MipPicture::build(
        [[(); 32]; 32].map(|row| row.map(|()| Rgb888::new(rng.int(0, 255) as u8, rng.int(0, 255) as u8, 9))),
    );
    let bytes: Vec<u8> = (0..32 * 64).map(|_| rng.int(0, 255) as u8).collect();
    let palette: Vec<Rgb888> = (0..=255).map(|i| Rgb888::new(i, 255 - i, 40)).collect();
    let (copies, indexed) =
        (MipTexels::new(&built), IndexedTexels::<_, 8>::new(&bytes, 32, 64, &palette).unwrap());
    let both = Texture::new(BilinearTexels::new(copies));
    let indexed_copies = Texture::new(MipTexels::new(indexed));
    let scenes = |horizon, wall, soup: i64, small: i64| {
        let uv = |reach: i64| move |rng: &mut Rng| rng.int(-reach, reach) as i16;
        [
            ("horizon", Faces::quad(floor(0.9, 1000.0, 900.0), 20.0, horizon, -5)),
            ("wall", Faces::quad(WALL, 70.0, wall, -4)),
            ("soup", Faces::soup(&mut Rng::new(9), 60, 400, 2500, uv(soup))),
            ("small", Faces::soup(&mut Rng::new(52), 300, 900, 900, uv(small))),
        ]
    };
    for (name, faces) in scenes(1600, 400, 4000, 500) {
        faces.texture_by_every_call(name, &usual(), copies);
        everywhere(&faces, &|face| indexed_copies.at(faces.uv[face]));
    }
    for (name, faces) in scenes(800, 100, 800, 200) {
        faces.texture_by_every_call(name, &usual(), BilinearTexels::new(indexed));
        everywhere(&faces, &|face| both.at(faces.uv[face]));
    }
}
