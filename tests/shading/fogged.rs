//! Fogged shaders of every kind: their pixels are those of the shader alone, mixed with the fog by the level at the pixel, whose
//! distance `fog` compares with rays.

use crate::rays::{everywhere, floor, in_memory, mixed, usual, Faces, Tiles, AREA, SIDE, SKY, WALL};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use pinhole::{
    Blended, ColorKeyed, Flat, Fog, FogTable, Fogged, Gouraud, HalfBlended, IndexedTexels, LitPalette,
    Scalar, ScreenDoor, ShadeTable, SpanShader, Texels, Texture,
};
use support::bridge::ways::{by_every_call, memory_with, Drawn};
use support::oracle::rng::Rng;

/// Blue in black fog in 7/255 steps: a colour for each level.
const LEVEL: u8 = 7;

const FOG: Rgb888 = Rgb888::new(200, 90, 30);

fn table(color: Rgb888) -> FogTable<Rgb888> {
    let fog = Fog::linear(Scalar::from_int(2), Scalar::from_int(30)).unwrap();
    FogTable::new(&fog, &usual(), color).unwrap()
}

fn soup(seed: u64, reach: i64) -> Faces {
    Faces::soup(&mut Rng::new(seed), 120, reach, 3000, |rng| rng.int(-480, 480) as i16)
}

/// A plain colour in fog of another one shows the factor of each pixel: by the order of drawing, of the face that is seen there.
fn factors(scene: &Faces) -> Drawn<Rgb888> {
    let black = table(Rgb888::BLACK);
    everywhere(scene, &|_| Fogged::new(Rgb888::new(0, 0, 32 * LEVEL), &black))
}

/// The picture with depth, and the depths.
fn deep<S: SpanShader<Rgb888>>(scene: &Faces, shade: &dyn Fn(usize) -> S) -> (Vec<Rgb888>, Vec<u16>) {
    memory_with(AREA, AREA, SKY, &mut |target, depth| {
        scene.place(&usual(), &mut |instance| {
            let Ok(_) = instance.depth_tested(shade, &mut [], depth, target);
        });
    })
}

/// Pixels in fog are those of the shader alone, mixed by the factors. Returns the number of pixels of each factor.
fn compare(fogged: &[Rgb888], alone: &[Rgb888], factors: &[Rgb888]) -> [usize; 33] {
    let mut counts = [0; 33];
    for ((&pixel, &own), factor) in fogged.iter().zip(alone).zip(factors) {
        let factor = factor.b() / LEVEL;
        assert_eq!(pixel, if own == SKY { SKY } else { mixed(own, FOG, factor) });
        counts[usize::from(factor)] += usize::from(own != SKY);
    }
    counts
}

/// A shader in fog shows what the shader shows alone, mixed by the factor at the pixel.
fn check<S: SpanShader<Rgb888>>(scene: &Faces, factors: &Drawn<Rgb888>, shade: &dyn Fn(usize) -> S) {
    let fog = table(FOG);
    let (fogged, alone) = (deep(scene, &|face| Fogged::new(shade(face), &fog)), deep(scene, shade));
    assert!(fogged.1 == alone.1);
    let counts = compare(&fogged.0, &alone.0, &factors.deep);
    let met = counts.iter().filter(|&&count| count > 0).count();
    assert!(counts.iter().sum::<usize>() > 5_000 && met > 25, "{counts:?}");
}

#[test]
fn every_shader_is_mixed_with_the_fog_at_its_pixels() {
    let quad = |corners, roll, exponent| Faces::quad(corners, roll, 60, exponent);
    let colors = |face: usize| {
        [0, 70, 140].map(|more| Rgb888::new(!(face as u8), (2 * face) as u8, (face + more) as u8))
    };
    let shades = ShadeTable::new(Rgb888::YELLOW);
    let palette = LitPalette::<_, 2, 32>::new(&[Rgb888::MAGENTA, Rgb888::new(60, 250, 90)]);
    let bits = [0xcc; 8];
    let lit = IndexedTexels::<_, 1>::new(&bits, 8, 8, palette.row(256)).unwrap();
    let lit = Texture::new(lit.with_lit_palette(&palette));
    for scene in &[soup(41, 1500), quad(floor(0.9, 300.0, 200.0), 20.0, -6), quad(WALL, 70.0, -4)] {
        let factors = factors(scene);
        check(scene, &factors, &|face| colors(face)[0]);
        check(scene, &factors, &|face| Flat::lit(colors(face)[1], 177).dithered());
        check(scene, &factors, &|face| Gouraud::new(colors(face)));
        check(scene, &factors, &|face| Gouraud::lit(colors(face)[2], [256, 90, 180]).dithered());
        check(scene, &factors, &|face| shades.lit([256, 20 + face as u16, 180]));
        check(scene, &factors, &|face| Texture::new(Tiles).at(scene.uv[face]));
        check(scene, &factors, &|face| lit.at(scene.uv[face]).lit([256, 90, 180]));
    }
}

/// Keyed texels and screen doors leave out the pixels that they leave out without fog, whichever wraps the other.
#[test]
fn fogged_faces_may_leave_out_pixels() {
    let fog = table(FOG);
    for scene in [soup(42, 1200), Faces::quad(floor(0.9, 300.0, 200.0), 20.0, 60, -6)] {
        let texture = Texture::new(ColorKeyed::new(Tiles, Tiles.texel(3 << 29, 5 << 29)));
        let shade = |face: usize| texture.at(scene.uv[face]);
        for face in 0..scene.uv.len() {
            let alone = scene.alone(face);
            let own = in_memory(&alone, &|_| shade(face));
            let fogged = in_memory(&alone, &|_| Fogged::new(shade(face), &fog));
            assert!(fogged.depths == own.depths);
            compare(&fogged.solid, &own.solid, &factors(&alone).solid);
        }
        let inside = in_memory(&scene, &|face| Fogged::new(ScreenDoor::new(shade(face), 23), &fog));
        let outside = deep(&scene, &|face| ScreenDoor::new(Fogged::new(shade(face), &fog), 23));
        assert!((&inside.deep, &inside.depths) == (&outside.0, &outside.1));
        assert!(inside.solid.iter().filter(|&&pixel| pixel != SKY).count() > 500);
        let inside = in_memory(&scene, &|face| Fogged::new(Blended::new(shade(face), 11), &fog));
        let outside = deep(&scene, &|face| Blended::new(Fogged::new(shade(face), &fog), 11));
        assert!((&inside.deep, &inside.depths) == (&outside.0, &outside.1));
        let half = deep(&scene, &|face| HalfBlended::new(Fogged::new(shade(face), &fog)));
        assert!(half.0 != inside.deep);
    }
}

/// Faces that planes cut, from a painter and from bins.
#[test]
fn fogged_faces_are_equal_by_every_draw_call() {
    let (scene, fog) = (soup(43, 600), table(FOG));
    let shade = |face: usize| {
        Fogged::new(Gouraud::new([Rgb888::RED, Rgb888::GREEN, Rgb888::new(0, 0, face as u8)]), &fog)
    };
    scene.place(&usual(), &mut |instance| {
        let (drawn, _) = by_every_call(instance, AREA, SKY, &[17, SIDE], &shade);
        assert!(drawn.solid.iter().filter(|&&pixel| pixel != SKY).count() > 5_000);
    });
}
