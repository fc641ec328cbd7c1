//! Fogged shaders of every kind: their pixels are those of the shader alone, mixed with the fog by the level at the pixel, whose
//! distance `fog` compares with rays.

use crate::every_target::{in_memory, on_every_target, SKY};
use crate::textures::{floor, quad, soup, Scene, SIDE, WALL};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::prelude::*;
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Blended, ColorKeyed, Cull, Flat, Fog, FogTable, Fogged, Gouraud, HalfBlended, IndexedTexels,
    LitPalette, Mesh, Painter, Picture, Scalar, ScreenDoor, ShadeTable, SpanShader, Texels, Texture,
};

/// Blue in black fog in 7/255 steps: a colour for each level.
const LEVEL: u8 = 7;

fn mixed(own: Rgb888, fog: Rgb888, factor: u8) -> Rgb888 {
    let level = |own: u8, fog: u8| {
        ((u32::from(own) * u32::from(factor) + u32::from(fog) * u32::from(32 - factor) + 16) / 32) as u8
    };
    Rgb888::new(level(own.r(), fog.r()), level(own.g(), fog.g()), level(own.b(), fog.b()))
}

const FOG: Rgb888 = Rgb888::new(200, 90, 30);

fn table(color: Rgb888) -> FogTable<Rgb888> {
    let fog = Fog::linear(Scalar::from_int(2), Scalar::from_int(30)).unwrap();
    FogTable::new(&fog, &Scene::camera(), color).unwrap()
}

/// The factor of each pixel, face by face in the order of drawing: that of a fogged colour.
fn factors(drawn: &[Rgb888]) -> Vec<u8> {
    drawn.iter().map(|pixel| pixel.b() / LEVEL).collect()
}

/// A shader in fog shows what the shader shows alone, mixed by the factor at the pixel: on every target, in bands, with depth and
/// without.
fn check<S: SpanShader<Rgb888>>(scene: &Scene, shade: &dyn Fn(usize) -> S) {
    let fog = table(FOG);
    let white = table(Rgb888::BLACK);
    let fogged = on_every_target(scene, &|face| Fogged::new(shade(face), &fog));
    let alone = on_every_target(scene, shade);
    // A plain colour in this fog shows the factor of each pixel: by the order of drawing, of the same face as in `fogged`.
    let factor = on_every_target(scene, &|_| Fogged::new(Rgb888::new(0, 0, 32 * LEVEL), &white));
    assert!(fogged.depths == alone.depths);
    let (mut counts, mut compared) = ([0; 33], 0);
    for (pictures, factor) in [(&fogged.solid, &alone.solid), (&fogged.deep, &alone.deep)]
        .into_iter()
        .zip([&factor.solid, &factor.deep])
    {
        let (fogged, alone) = pictures;
        for ((&pixel, &own), factor) in fogged.iter().zip(alone).zip(factors(factor)) {
            if own != SKY {
                assert_eq!(pixel, mixed(own, FOG, factor));
                counts[usize::from(factor)] += 1;
                compared += 1;
            } else {
                assert_eq!(pixel, SKY);
            }
        }
    }
    assert!(compared > 10_000 && counts.iter().filter(|&&count| count > 0).count() > 25, "{counts:?}");
}

/// 8 × 8 texels of different colours.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stripes;

impl Texels for Stripes {
    type Color = Rgb888;

    fn size_bits(&self) -> [u32; 2] {
        [3, 3]
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        Rgb888::new((u >> 29 << 5) as u8, (v >> 29 << 4) as u8, 90)
    }
}

#[test]
fn every_shader_is_mixed_with_the_fog_at_its_pixels() {
    let scenes = [soup(41, 1500, 30), quad(floor(0.9, 300.0, 200.0), 20.0, 60, -6), quad(WALL, 70.0, 60, -4)];
    let colors = |face: usize| {
        [0, 70, 140].map(|more| Rgb888::new(!(face as u8), (2 * face) as u8, (face + more) as u8))
    };
    let shades = ShadeTable::new(Rgb888::YELLOW);
    let palette = LitPalette::<_, 2, 32>::new(&[Rgb888::MAGENTA, Rgb888::new(60, 250, 90)]);
    let bits = [0xcc; 8];
    let lit = IndexedTexels::<_, 1>::new(&bits, 8, 8, palette.row(256)).unwrap();
    let lit = Texture::new(lit.with_lit_palette(&palette));
    for scene in &scenes {
        let corners = |face: usize| scene.faces[face].map(|vertex| scene.uv[usize::from(vertex)]);
        check(scene, &|face| colors(face)[0]);
        check(scene, &|face| Flat::lit(colors(face)[1], 200));
        check(scene, &|face| Flat::lit(colors(face)[1], 177).dithered());
        check(scene, &|face| Gouraud::new(colors(face)));
        check(scene, &|face| Gouraud::new(colors(face)).dithered());
        check(scene, &|face| Gouraud::lit(colors(face)[2], [256, 90, 180]));
        check(scene, &|face| shades.lit([256, 20 + face as u16, 180]));
        check(scene, &|face| Texture::new(Stripes).at(corners(face)));
        check(scene, &|face| lit.at(corners(face)).lit([256, 90, 180]));
    }
}

/// Keyed texels and screen doors leave out the pixels that they leave out without fog, whichever wraps the other.
#[test]
fn fogged_faces_may_leave_out_pixels() {
    let fog = table(FOG);
    for scene in [soup(42, 1200, 30), quad(floor(0.9, 300.0, 200.0), 20.0, 60, -6)] {
        let corners = |face: usize| scene.faces[face].map(|vertex| scene.uv[usize::from(vertex)]);
        let texture = Texture::new(ColorKeyed::new(Stripes, Stripes.texel(3 << 29, 5 << 29)));
        for &face in &scene.faces {
            let alone = Scene {
                vertices: scene.vertices.clone(),
                uv: scene.uv.clone(),
                faces: vec![face],
                exponent: scene.exponent,
            };
            let at = face.map(|vertex| scene.uv[usize::from(vertex)]);
            let own = in_memory(&alone, &|_| texture.at(at));
            let fogged = in_memory(&alone, &|_| Fogged::new(texture.at(at), &fog));
            let black = table(Rgb888::BLACK);
            let factor = in_memory(&alone, &|_| Fogged::new(Rgb888::new(0, 0, 32 * LEVEL), &black));
            assert!(fogged.depths == own.depths);
            for ((&pixel, &own), factor) in fogged.solid.iter().zip(&own.solid).zip(factors(&factor.solid)) {
                assert_eq!(pixel, if own == SKY { SKY } else { mixed(own, FOG, factor) });
            }
        }
        let shade = |face: usize| texture.at(corners(face));
        let inside = on_every_target(&scene, &|face| Fogged::new(ScreenDoor::new(shade(face), 23), &fog));
        let outside = on_every_target(&scene, &|face| ScreenDoor::new(Fogged::new(shade(face), &fog), 23));
        assert!(
            inside.deep == outside.deep && inside.solid == outside.solid && inside.depths == outside.depths
        );
        assert!(inside.solid.iter().filter(|&&pixel| pixel != SKY).count() > 500);
        let inside = in_memory(&scene, &|face| Fogged::new(Blended::new(shade(face), 11), &fog));
        let outside = in_memory(&scene, &|face| Blended::new(Fogged::new(shade(face), &fog), 11));
        assert!(inside.deep == outside.deep && inside.solid == outside.solid);
        let half = in_memory(&scene, &|face| HalfBlended::new(Fogged::new(shade(face), &fog)));
        assert!(half.solid != inside.solid);
    }
}

/// A painter stores fogged shaders; and faces in the order of the mesh have the pixels that they have alone.
#[test]
fn a_painter_draws_fogged_faces() {
    let scene = soup(43, 600, 10);
    let fog = table(FOG);
    let shade = |face: usize| {
        Fogged::new(Gouraud::new([Rgb888::RED, Rgb888::GREEN, Rgb888::new(0, 0, face as u8)]), &fog)
    };
    let mesh = Mesh::new(&scene.vertices, scene.exponent, &scene.faces).unwrap();
    let camera = Scene::camera();
    let instance = camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
    let size = Size::new(SIDE, SIDE);
    let mut painted = vec![SKY; (SIDE * SIDE) as usize];
    let mut painter = Box::new(Painter::<_, 600, 200>::new());
    painter.add(&instance, shade).unwrap();
    let order = painter.order();
    let Ok(_) = order.draw(&mut Picture::new(&mut painted, size).unwrap().pixels());
    // The pixel of each is that of a face drawn alone.
    let mut matched = vec![false; painted.len()];
    for face in 0..scene.faces.len() {
        let faces = [scene.faces[face]];
        let mesh = Mesh::new(&scene.vertices, scene.exponent, &faces).unwrap();
        let instance = camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
        let mut alone = vec![SKY; painted.len()];
        let Ok(_) =
            instance.solid(|_| shade(face), &mut [], &mut Picture::new(&mut alone, size).unwrap().pixels());
        for (i, matched) in matched.iter_mut().enumerate() {
            *matched |= alone[i] == painted[i];
        }
    }
    assert!(matched.iter().all(|&matched| matched));
    assert!(painted.iter().filter(|&&pixel| pixel != SKY).count() > 5_000);
}
