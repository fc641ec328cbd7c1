//! Keyed texels: which pixels are left out, and which depths are stored, against rays in f64, which share no code with the library.

use crate::every_target::{on_every_target, Drawn, SKY};
use crate::textures::{floor, quad, soup, volume, Scene, FAR, FOV, NEAR, SIDE, WALL};
use embedded_graphics::pixelcolor::Rgb888;
use pinhole::{Accuracy, ColorKeyed, DepthBuffer, IndexKeyed, IndexedTexels, Texels, Texture};

const KEY: Rgb888 = Rgb888::new(255, 0, 255);
const SIDE_BITS: u32 = 3;

/// A chessboard of 8 × 8 texels: its upper left texel has the key's colour, and the texels beside it have colours of their own.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Chessboard;

impl Texels for Chessboard {
    type Color = Rgb888;

    fn size_bits(&self) -> [u32; 2] {
        [SIDE_BITS; 2]
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        let [column, row] = [u, v].map(|c| (c >> 29) as u8);
        if (column ^ row) & 1 == 0 {
            KEY
        } else {
            Rgb888::new(20 + column, 40 + row, 60)
        }
    }
}

/// Depth at a point of the screen, in pixels, of a face: 65535·(z/w + 1)/2.
fn depth(scene: &Scene, face: usize, [x, y]: [f64; 2]) -> f64 {
    let scale = (FOV.to_radians() / 2.0).tan();
    let half = f64::from(SIDE) / 2.0;
    let ray = [(x - half) / half * scale, (half - y) / half * scale, -1.0];
    let [a, b, c] = scene.faces[face]
        .map(|i| scene.vertices[usize::from(i)].map(|c| f64::from(c) * 2f64.powi(scene.exponent.into())));
    let sum = volume(ray, b, c) + volume(a, ray, c) + volume(a, b, ray);
    let w = volume(a, b, c) / sum; // the ray's end has a distance of 1 along the line of sight
    65535.0 * FAR / (FAR - NEAR) * (1.0 - NEAR / w)
}

fn around([x, y]: [f64; 2]) -> [[f64; 2]; 4] {
    [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)].map(|(dx, dy)| [x + dx / 64.0, y + dy / 64.0])
}

/// A pixel is drawn if the texel at its centre is not transparent, and stores its depth then; other pixels are left alone. It is
/// compared where the texel is the same within 1/64 pixel and 0.08 texel: the error that `Texture` promises.
#[test]
fn pixels_of_transparent_texels_are_left_out_with_their_depth() {
    let scenes = [
        quad(floor(0.5, 9.5, 6.0), 25.0, 16, -10), // cut by the near plane
        quad(floor(0.9, 300.0, 200.0), 20.0, 60, -6),
        quad(WALL, 70.0, 60, -4),
    ];
    let (mut drawn, mut left_out) = (0, 0);
    for scene in scenes {
        for &face in &scene.faces {
            let alone =
                Scene { faces: vec![face], vertices: scene.vertices.clone(), uv: scene.uv.clone(), ..scene };
            let corners = face.map(|vertex| alone.uv[usize::from(vertex)]);
            let full = on_every_target(&alone, &|_| Texture::new(Chessboard).at(corners));
            let texture = Texture::new(ColorKeyed::new(Chessboard, KEY)).with_accuracy(Accuracy::Sixteenth);
            let Drawn { solid, deep, depths } = on_every_target(&alone, &|_| texture.at(corners));
            assert!(solid == deep, "one face hides nothing of itself");
            for (i, &pixel) in solid.iter().enumerate() {
                if full.solid[i] == SKY {
                    assert_eq!((pixel, depths[i]), (SKY, DepthBuffer::NOTHING), "outside of the face");
                    continue;
                }
                let centre = [(i as u32 % SIDE) as f64 + 0.5, (i as u32 / SIDE) as f64 + 0.5];
                let points = around(centre).map(|point| alone.exact(0, point));
                let texel = |axis: usize, by: f64| points.map(|uv| (uv[axis] + by).floor() as i64);
                let of = |axis: usize| {
                    let all = [texel(axis, -0.08), texel(axis, 0.08)].concat();
                    all.iter().all(|&one| one == all[0]).then_some(all[0])
                };
                let (Some(column), Some(row)) = (of(0), of(1)) else { continue };
                if (column + row).rem_euclid(2) == 0 {
                    assert_eq!((pixel, depths[i]), (SKY, DepthBuffer::NOTHING), "{centre:?}");
                    left_out += 1;
                } else {
                    let [column, row] = [column, row].map(|c| c.rem_euclid(8) as u8);
                    assert_eq!(pixel, Rgb888::new(20 + column, 40 + row, 60), "{centre:?}");
                    // One step of rounding, and the change of depth within 1/64 pixel.
                    let near = around(centre).map(|point| depth(&alone, 0, point));
                    let (low, high) = (
                        near.iter().copied().fold(f64::MAX, f64::min),
                        near.iter().copied().fold(f64::MIN, f64::max),
                    );
                    let stored = f64::from(depths[i]);
                    assert!(
                        stored >= low - 1.0 && stored <= high + 1.0,
                        "{centre:?}: {stored}, {low} … {high}"
                    );
                    drawn += 1;
                }
            }
        }
    }
    assert!(drawn > 10_000 && left_out > 10_000, "{drawn} and {left_out}");
}

/// Faces of any shape that hide each other: keyed texels are the unkeyed picture without the key, on every target and in bands.
#[test]
fn keyed_faces_show_what_is_behind_them() {
    for seed in 5..8 {
        let scene = soup(seed, 1200, 200);
        let corners = |face: usize| scene.faces[face].map(|vertex| scene.uv[usize::from(vertex)]);
        let texture = Texture::new(ColorKeyed::new(Chessboard, KEY));
        let Drawn { solid, deep, depths } = on_every_target(&scene, &|face| texture.at(corners(face)));
        assert!(solid.iter().chain(&deep).all(|&pixel| pixel != KEY));
        for (pixel, depth) in deep.iter().zip(&depths) {
            assert_eq!(*pixel == SKY, *depth == DepthBuffer::NOTHING);
        }
        assert!(deep.iter().filter(|&&pixel| pixel != SKY).count() > 10_000 && solid != deep);
    }
}

/// A key of an index leaves out the same pixels as a key of the index's colour; an index that no texel has leaves out none.
#[test]
fn a_key_is_a_colour_or_an_index() {
    let scene = quad(floor(0.5, 9.5, 6.0), 25.0, 40, -10);
    let corners = |face: usize| scene.faces[face].map(|vertex| scene.uv[usize::from(vertex)]);
    let palette: Vec<Rgb888> = (0..16).map(|i| Rgb888::new(100 + i, 7 * i, 255 - i)).collect();
    let bytes: Vec<u8> = (0..8 * 8 / 2).map(|i: u8| i.wrapping_mul(37)).collect();
    let texels = IndexedTexels::<_, 4>::new(&bytes, 8, 8, &palette).unwrap();
    for key in [0, 5, 10, 16, 255] {
        let by_index = Texture::new(IndexKeyed::new(texels, key));
        let drawn = on_every_target(&scene, &|face| by_index.at(corners(face)));
        match palette.get(usize::from(key)) {
            Some(&color) => {
                let by_color = Texture::new(ColorKeyed::new(texels, color));
                let other = on_every_target(&scene, &|face| by_color.at(corners(face)));
                assert!(drawn.deep == other.deep && drawn.depths == other.depths);
                let full = on_every_target(&scene, &|face| Texture::new(texels).at(corners(face)));
                let without = full.deep.iter().map(|&pixel| if pixel == color { SKY } else { pixel });
                assert!(drawn.deep.iter().copied().eq(without) && drawn.deep != full.deep);
            }
            None => {
                let full = on_every_target(&scene, &|face| Texture::new(texels).at(corners(face)));
                assert!(drawn.deep == full.deep && drawn.depths == full.depths);
            }
        }
    }
    // Two indices of one colour: only the key is transparent.
    let same = [Rgb888::new(9, 9, 9); 16];
    let texels = texels.with_palette(&same).unwrap();
    let kept = |x: u32| IndexKeyed::new(texels, 5).kept_texel(x << 29, 0);
    // 37 = 0x25 is the second byte: texels 0, 0, 2, 5.
    assert_eq!([kept(0), kept(2), kept(3)], [Some(same[0]), Some(same[0]), None]);
    assert_eq!(ColorKeyed::new(texels, same[0]).kept_texel(0, 0), None);
}
