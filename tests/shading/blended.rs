//! Translucency: mixed, dimmed and added levels of every colour type against fractions, and faces over what is behind them, face by face.

use crate::rays::{everywhere, floor, in_memory, mixed, usual, Faces, Tiles, AREA, SIZE, SKY};
use embedded_graphics::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor, Rgb555, Rgb565, Rgb666,
    Rgb888, RgbColor,
};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::raster::{Span, Triangle};
use pinhole::{
    Blended, Color, ColorKeyed, DepthBuffer, Gouraud, HalfBlended, Pixels, ScreenDoor, Shader, SpanShader,
    Texels, Texture, Translucent,
};
use support::bridge::ways::{memory, memory_with};
use support::oracle::rng::Rng;

/// All pairs of levels of each channel with every alpha, beside random levels of the others.
fn check<C: Color + core::fmt::Debug>(
    max: [u8; 3],
    make: &dyn Fn([u8; 3]) -> C,
    levels: &dyn Fn(C) -> [u8; 3],
) {
    check_dimmed(max, make, levels);
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
                // Light that is emitted is added, up to full.
                let sums = levels(make(own).emitting(make(stored)));
                assert_eq!(
                    sums,
                    [0, 1, 2].map(|i| own[i].saturating_add(stored[i]).min(max[i])),
                    "{own:?} {stored:?}"
                );
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

/// Every level of a channel in every light, which rounds to nearest; beyond 256 it is full.
fn check_dimmed<C: Color>(max: [u8; 3], make: &dyn Fn([u8; 3]) -> C, levels: &dyn Fn(C) -> [u8; 3]) {
    for level in (0..=256).chain([257, 1000, u16::MAX]) {
        for own in 0..=255u8 {
            let own = [own.min(max[0]), (255 - own).min(max[1]), (own / 2).min(max[2])];
            for (found, own) in levels(make(own).dim(level)).into_iter().zip(own) {
                let off = f64::from(found) - f64::from(own) * f64::from(level.min(256)) / 256.0;
                assert!(off.abs() <= 0.5, "{own} in {level}: {found}");
            }
        }
    }
}

macro_rules! check_rgb {
    ($($color:ident),*) => {$(
        check([$color::MAX_R, $color::MAX_G, $color::MAX_B], &|[r, g, b]| $color::new(r, g, b), &|c| [c.r(), c.g(), c.b()]);
    )*};
}

#[test]
fn levels_of_every_color_type_are_the_nearest() {
    check_rgb!(Rgb555, Bgr555, Rgb565, Bgr565, Rgb666, Bgr666, Rgb888, Bgr888);
    check([255, 0, 0], &|[luma, ..]| Gray8::new(luma), &|c| [c.luma(), 0, 0]);
    check([15, 0, 0], &|[luma, ..]| Gray4::new(luma), &|c| [c.luma(), 0, 0]);
    check([3, 0, 0], &|[luma, ..]| Gray2::new(luma), &|c| [c.luma(), 0, 0]);
    check([1, 0, 0], &|[luma, ..]| BinaryColor::from(luma == 1), &|c| [u8::from(c.is_on()), 0, 0]);
}

fn halved(own: Rgb888, stored: Rgb888) -> Rgb888 {
    let level = |own: u8, stored: u8| own.div_ceil(2) + stored / 2;
    Rgb888::new(level(own.r(), stored.r()), level(own.g(), stored.g()), level(own.b(), stored.b()))
}

/// Draws faces into memory, with depth.
fn draw_deep<S: SpanShader<Rgb888>>(
    faces: &Faces,
    shade: &dyn Fn(usize) -> S,
    target: &mut Pixels<'_, Rgb888>,
    depth: &mut DepthBuffer<'_>,
) {
    faces.place(&usual(), &mut |instance| {
        let Ok(_) = instance.depth_tested(shade, &mut [], depth, target);
    });
}

/// A scene behind, drawn with depth, and translucent faces in the order of the mesh; `opaque` is the shader without translucency.
/// The pixels that each face alone draws in front of the scene are mixed with the pixels before it.
fn check_scene<S: SpanShader<Rgb888>, B: SpanShader<Rgb888>>(
    front: &Faces,
    opaque: &dyn Fn(usize) -> S,
    translucent: &dyn Fn(usize) -> B,
    mix: &dyn Fn(Rgb888, Rgb888) -> Rgb888,
) {
    let behind = Faces::soup(&mut Rng::new(31), 120, 1500, 3000, |_| 0);
    let paint: &dyn Fn(usize) -> Rgb888 =
        &|face| Rgb888::new(40 + face as u8, !(face as u8), (17 * face) as u8);
    let (before, stored) =
        memory_with(AREA, AREA, SKY, &mut |target, depth| draw_deep(&behind, paint, target, depth));
    let (mut wanted, mut counts) = (before.clone(), [0; 2]);
    let none = Rgb888::new(255, 254, 253); // no shader draws it
    for face in 0..front.uv.len() {
        let alone = front.alone(face);
        let opaque: &dyn Fn(usize) -> S = &|_| opaque(face);
        let all = memory(AREA, none, &mut |target, depth| draw_deep(&alone, opaque, target, depth));
        let own = memory(AREA, none, &mut |target, depth| {
            draw_deep(&behind, paint, &mut Pixels::new(&mut vec![none; before.len()], AREA).unwrap(), depth);
            draw_deep(&alone, opaque, target, depth);
        });
        for (wanted, own) in wanted.iter_mut().zip(&own).filter(|(_, own)| **own != none) {
            *wanted = mix(*own, *wanted);
            counts[0] += 1;
        }
        counts[1] += own.iter().zip(&all).filter(|(own, all)| own != all).count();
    }
    assert!(counts.iter().all(|&count| count > 300), "{counts:?} drawn and hidden");
    for depth_area in [AREA, Rectangle::new(Point::new(-2, -1), SIZE + Size::new(4, 3))] {
        let drawn = memory_with(AREA, depth_area, SKY, &mut |target, depth| {
            draw_deep(&behind, paint, target, depth);
            draw_deep(front, translucent, target, depth);
        });
        assert!(drawn.1 == stored, "depth is not stored");
        assert!(drawn.0 == wanted && drawn.0 != before);
    }
}

/// In parts, and without depth: all pictures are equal, and no depth is stored.
fn check_parts<B: SpanShader<Rgb888>>(front: &Faces, translucent: &dyn Fn(usize) -> B) {
    let alone = in_memory(front, translucent);
    assert!(alone.depths.iter().all(|&depth| depth == DepthBuffer::NOTHING) && alone.deep == alone.solid);
}

#[test]
fn translucent_faces_are_mixed_with_what_is_behind_them() {
    let scene = Faces::soup(&mut Rng::new(33), 120, 1200, 3000, |_| 0);
    let color = |face: usize| Rgb888::new(!(face as u8), (3 * face) as u8, 100);
    check_scene(&scene, &color, &|face| HalfBlended::new(color(face)), &halved);
    for alpha in [1, 11, 31, 32, 77] {
        let mix = |own, stored| mixed(own, stored, alpha.min(32));
        check_scene(&scene, &color, &|face| Blended::new(color(face), alpha), &mix);
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
    check_parts(&scene, &|face| HalfBlended::new(smooth(face)));
    check_parts(&scene, &|face| Translucent::by(color(face), added));
    let nothing = in_memory(&scene, &|face| Blended::new(color(face), 0));
    assert!(nothing.solid.iter().all(|&pixel| pixel == SKY));
}

/// A colour that is neither mixed nor stored as depth: it needs no memory to read.
#[derive(Clone, Copy)]
struct Unstored(Rgb888);

impl Shader for Unstored {
    type Varying = ();

    fn sub_face(&self, _: [(); 3]) -> Self {
        *self
    }
}

impl SpanShader<Rgb888> for Unstored {
    type Setup = Rgb888;
    const WRITES_DEPTH: bool = false;

    fn set_up(&self, _: &Triangle<'_>) -> Rgb888 {
        self.0
    }

    fn span(color: &Rgb888, _: Span) -> impl Iterator<Item = Rgb888> {
        core::iter::repeat(*color)
    }
}

#[test]
fn depth_that_a_shader_does_not_write_is_stored_on_no_target() {
    let scene = Faces::soup(&mut Rng::new(35), 120, 1200, 3000, |_| 0);
    let color = |face: usize| Rgb888::new(!(face as u8), (3 * face) as u8, 100);
    let drawn = everywhere(&scene, &|face| Unstored(color(face)));
    assert!(drawn.depths.iter().all(|&depth| depth == DepthBuffer::NOTHING) && drawn.deep == drawn.solid);
    check_scene(&scene, &color, &|face| Unstored(color(face)), &|own, _| own);
}

/// Keyed textures and screen doors leave out the same pixels of translucent and of opaque faces.
#[test]
fn translucent_faces_may_leave_out_pixels() {
    let soup = Faces::soup(&mut Rng::new(34), 120, 1200, 3000, |rng| rng.int(-480, 480) as i16);
    let texture = Texture::new(ColorKeyed::new(Tiles, Tiles.texel(3 << 29, 5 << 29)));
    let ninth = |own, stored| mixed(own, stored, 9);
    for scene in &[soup, Faces::quad(floor(0.9, 300.0, 200.0), 20.0, 60, -6)] {
        let shade = |face: usize| texture.at(scene.uv[face]);
        check_scene(scene, &shade, &|face| HalfBlended::new(shade(face)), &halved);
        check_scene(scene, &shade, &|face| Blended::new(shade(face), 9), &ninth);
        check_parts(scene, &|face| Blended::new(shade(face), 9));
        let door = |face: usize| ScreenDoor::new(shade(face), 23);
        check_scene(scene, &door, &|face| Blended::new(door(face), 9), &ninth);
        check_scene(scene, &door, &|face| ScreenDoor::new(HalfBlended::new(shade(face)), 23), &halved);
    }
}
