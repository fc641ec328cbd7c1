//! Translucency: levels of every colour type against fractions, and faces over what is behind them, face by face.

use crate::every_target::{in_memory, SKY};
use crate::textures::{floor, quad, soup, Scene, SIDE};
use embedded_graphics::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor, Rgb555, Rgb565, Rgb666,
    Rgb888, RgbColor,
};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{
    Affine, Blend, Blended, ColorKeyed, Cull, DepthBuffer, Gouraud, HalfBlended, Mesh, Picture, ScreenDoor,
    ScreenVertex, SpanShader, Texels, Texture, Translucent,
};
use support::oracle::rng::Rng;

/// All pairs of levels of each channel with every alpha, beside random levels of the others.
fn check<C: Blend + core::fmt::Debug>(
    max: [u8; 3],
    make: impl Fn([u8; 3]) -> C,
    levels: impl Fn(C) -> [u8; 3],
) {
    let mut rng = Rng::new(11);
    for channel in 0..3 {
        for own in 0..=max[channel] {
            for stored in 0..=max[channel] {
                let mut pair = [own, stored].map(|level| {
                    let mut color = max.map(|max| rng.below(usize::from(max) + 1) as u8);
                    color[channel] = level;
                    color
                });
                if rng.one_in(4) {
                    // The largest sums, which must not carry into a neighbour.
                    (0..3)
                        .filter(|&other| other != channel)
                        .for_each(|other| pair.iter_mut().for_each(|c| c[other] = max[other]));
                }
                let [own, stored] = pair;
                let each = |level: &dyn Fn(u32, u32) -> u32| {
                    [0, 1, 2].map(|i| level(own[i].into(), stored[i].into()) as u8)
                };
                let half = levels(make(own).half(make(stored)));
                assert_eq!(half, each(&|a, b| a.div_ceil(2) + b / 2), "{own:?} {stored:?}");
                let within = (0..3)
                    .all(|i| (2 * i16::from(half[i]) - i16::from(own[i]) - i16::from(stored[i])).abs() <= 1);
                assert!(within, "{own:?} {stored:?}");
                for alpha in 0..=32 {
                    let mixed = levels(make(own).mix(make(stored), alpha));
                    let alpha = u32::from(alpha);
                    assert_eq!(
                        mixed,
                        each(&|a, b| (a * alpha + b * (32 - alpha) + 16) / 32),
                        "{own:?} {stored:?} {alpha}"
                    );
                }
            }
        }
    }
}

macro_rules! check_rgb {
    ($($color:ident),*) => {$(
        check([$color::MAX_R, $color::MAX_G, $color::MAX_B], |[r, g, b]| $color::new(r, g, b), |c| [c.r(), c.g(), c.b()]);
    )*};
}

#[test]
fn levels_of_every_color_type_are_the_nearest() {
    check_rgb!(Rgb555, Bgr555, Rgb565, Bgr565, Rgb666, Bgr666, Rgb888, Bgr888);
    check([255, 0, 0], |[luma, ..]| Gray8::new(luma), |c| [c.luma(), 0, 0]);
    check([15, 0, 0], |[luma, ..]| Gray4::new(luma), |c| [c.luma(), 0, 0]);
    check([3, 0, 0], |[luma, ..]| Gray2::new(luma), |c| [c.luma(), 0, 0]);
    check([1, 0, 0], |[luma, ..]| BinaryColor::from(luma == 1), |c| [u8::from(c.is_on()), 0, 0]);
}

/// The mixed colour, by fractions.
fn mixed(own: Rgb888, stored: Rgb888, alpha: u32) -> Rgb888 {
    let level =
        |own: u8, stored: u8| ((u32::from(own) * alpha + u32::from(stored) * (32 - alpha) + 16) / 32) as u8;
    Rgb888::new(level(own.r(), stored.r()), level(own.g(), stored.g()), level(own.b(), stored.b()))
}

fn halved(own: Rgb888, stored: Rgb888) -> Rgb888 {
    let level = |own: u8, stored: u8| own.div_ceil(2) + stored / 2;
    Rgb888::new(level(own.r(), stored.r()), level(own.g(), stored.g()), level(own.b(), stored.b()))
}

/// A scene behind, drawn with depth, and translucent faces in the order of the mesh; `opaque` is the shader without translucency.
/// The pixels that each face alone draws in front of the scene are mixed with the pixels before it.
fn check_scene<S: SpanShader<Rgb888>, B: SpanShader<Rgb888>>(
    front: &Scene,
    opaque: &dyn Fn(usize) -> S,
    translucent: &dyn Fn(usize) -> B,
    mix: &dyn Fn(Rgb888, Rgb888) -> Rgb888,
) {
    let size = Size::new(SIDE, SIDE);
    let area = Rectangle::new(Point::zero(), size);
    let behind = soup(31, 1500, 10);
    let paint: &dyn Fn(usize) -> Rgb888 =
        &|face| Rgb888::new(40 + face as u8, !(face as u8), (17 * face) as u8);
    let camera = Scene::camera();
    let (mut pixels, mut depths) = (vec![SKY; (SIDE * SIDE) as usize], vec![0; (SIDE * SIDE) as usize]);
    let mut cache = vec![ScreenVertex::EMPTY; 4000];
    {
        let mesh = Mesh::new(&behind.vertices, behind.exponent, &behind.faces).unwrap();
        let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None);
        let mut depth = DepthBuffer::new(area, &mut depths).unwrap();
        let mut picture = Picture::new(&mut pixels, size).unwrap();
        let Ok(_) = instance.depth_tested(paint, &mut cache, &mut depth, &mut picture.pixels());
    }
    let (before, stored) = (pixels.clone(), depths.clone());
    let mut wanted = pixels.clone();
    let none = Rgb888::new(255, 254, 253); // no shader draws it
    let mut counts = [0; 2];
    for (face, &corners) in front.faces.iter().enumerate() {
        let alone = [corners];
        let mesh = Mesh::new(&front.vertices, front.exponent, &alone).unwrap();
        let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None);
        let opaque: &dyn Fn(usize) -> S = &|_| opaque(face);
        let (mut own, mut all) = (vec![none; pixels.len()], vec![none; pixels.len()]);
        let Ok(_) = instance.solid(opaque, &mut cache, &mut Picture::new(&mut all, size).unwrap().pixels());
        // A depth buffer begins clear, so the scene behind is drawn into it again.
        let mut copy = stored.clone();
        let mut depth = DepthBuffer::new(area, &mut copy).unwrap();
        let mut ignored = vec![none; pixels.len()];
        let first = Mesh::new(&behind.vertices, behind.exponent, &behind.faces).unwrap();
        let first = camera.place(&first, &Affine::identity()).with_cull(Cull::None);
        let Ok(_) = first.depth_tested(
            paint,
            &mut cache,
            &mut depth,
            &mut Picture::new(&mut ignored, size).unwrap().pixels(),
        );
        let mut picture = Picture::new(&mut own, size).unwrap();
        let Ok(_) = instance.depth_tested(opaque, &mut cache, &mut depth, &mut picture.pixels());
        for (wanted, own) in wanted.iter_mut().zip(&own).filter(|(_, own)| **own != none) {
            *wanted = mix(*own, *wanted);
            counts[0] += 1;
        }
        counts[1] += own.iter().zip(&all).filter(|(own, all)| own != all).count();
    }
    assert!(counts.iter().all(|&count| count > 300), "{counts:?} drawn and hidden");

    let mesh = Mesh::new(&front.vertices, front.exponent, &front.faces).unwrap();
    let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None);
    let first = Mesh::new(&behind.vertices, behind.exponent, &behind.faces).unwrap();
    let first = camera.place(&first, &Affine::identity()).with_cull(Cull::None);
    for depth_area in [area, Rectangle::new(Point::new(-2, -1), size + Size::new(4, 3))] {
        let mut storage = vec![0; (depth_area.size.width * depth_area.size.height) as usize];
        let mut depth = DepthBuffer::new(depth_area, &mut storage).unwrap();
        let mut drawn = vec![SKY; pixels.len()];
        let mut picture = Picture::new(&mut drawn, size).unwrap();
        let Ok(_) = first.depth_tested(paint, &mut cache, &mut depth, &mut picture.pixels());
        let kept = depth.values().to_vec();
        let Ok(_) = instance.depth_tested(translucent, &mut cache, &mut depth, &mut picture.pixels());
        assert!(depth.values() == kept, "depth is not stored");
        assert!(drawn == wanted && drawn != before);
    }
    // In bands, and without depth: all pictures are equal, and no depth is stored.
    let alone = in_memory(front, translucent);
    assert!(alone.depths.iter().all(|&depth| depth == DepthBuffer::NOTHING) && alone.deep == alone.solid);
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Stripes;

impl Texels for Stripes {
    type Color = Rgb888;

    fn size_bits(&self) -> [u32; 2] {
        [3, 3]
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        Rgb888::new((u >> 29 << 5) as u8, (v >> 29) as u8, 9)
    }
}

#[test]
fn translucent_faces_are_mixed_with_what_is_behind_them() {
    let scene = soup(33, 1200, 30);
    let color = |face: usize| Rgb888::new(!(face as u8), (3 * face) as u8, 100);
    check_scene(&scene, &color, &|face| HalfBlended::new(color(face)), &halved);
    for alpha in [1, 11, 31, 32, 77] {
        check_scene(&scene, &color, &|face| Blended::new(color(face), alpha), &|own, stored| {
            mixed(own, stored, u32::from(alpha).min(32))
        });
    }
    let smooth = |face: usize| Gouraud::new([color(face), color(face + 70), color(face + 140)]);
    check_scene(&scene, &smooth, &|face| Blended::new(smooth(face), 20), &|own, stored| {
        mixed(own, stored, 20)
    });
    check_scene(&scene, &smooth, &|face| HalfBlended::new(smooth(face)), &halved);
    // Any function of both colours: here, light that is added.
    let added = |own: Rgb888, stored: Rgb888| {
        let sum = |own: u8, stored: u8| own.saturating_add(stored);
        Rgb888::new(sum(own.r(), stored.r()), sum(own.g(), stored.g()), sum(own.b(), stored.b()))
    };
    check_scene(&scene, &color, &|face| Translucent::by(color(face), added), &added);
    check_scene(&scene, &smooth, &|face| Translucent::by(smooth(face), added), &added);
    let nothing = in_memory(&scene, &|face| Blended::new(color(face), 0));
    assert!(nothing.solid.iter().all(|&pixel| pixel == SKY));
}

/// Keyed textures and screen doors leave out the same pixels of translucent and of opaque faces.
#[test]
fn translucent_faces_may_leave_out_pixels() {
    let scenes = [soup(34, 1200, 30), quad(floor(0.9, 300.0, 200.0), 20.0, 60, -6)];
    for scene in &scenes {
        let texture = Texture::new(ColorKeyed::new(Stripes, Stripes.texel(3 << 29, 5 << 29)));
        let corners = |face: usize| scene.faces[face].map(|vertex| scene.uv[usize::from(vertex)]);
        let shade = |face: usize| texture.at(corners(face));
        check_scene(scene, &shade, &|face| HalfBlended::new(shade(face)), &halved);
        check_scene(scene, &shade, &|face| Blended::new(shade(face), 9), &|own, stored| {
            mixed(own, stored, 9)
        });
        let door = |face: usize| ScreenDoor::new(shade(face), 23);
        check_scene(scene, &door, &|face| Blended::new(door(face), 9), &|own, stored| mixed(own, stored, 9));
        check_scene(scene, &door, &|face| ScreenDoor::new(HalfBlended::new(shade(face)), 23), &halved);
    }
}
