//! Translucency: faces over what is behind them, face by face. The levels of the colours themselves are tested in `colors.rs`.

use crate::rays::{each_level, everywhere, Faces, AREA, SIZE, SKY};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::raster::{Span, Triangle};
use pinhole::{
    prelude::*,
    shading::{Shader, SpanShader, Translucent},
    target::Pixels,
};
use support::bridge::ways::{memory, memory_with};
use support::oracle::rng::Rng;

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
        memory_with(AREA, AREA, SKY, &mut |target, depth| behind.draw_deep(paint, target, depth));
    let (mut wanted, mut counts) = (before.clone(), [0; 2]);
    let none = Rgb888::new(255, 254, 253); // no shader draws it
    for face in 0..front.uv.len() {
        let alone = front.alone(face);
        let opaque: &dyn Fn(usize) -> S = &|_| opaque(face);
        let all = memory(AREA, none, &mut |target, depth| alone.draw_deep(opaque, target, depth));
        let own = memory(AREA, none, &mut |target, depth| {
            behind.draw_deep(paint, &mut Pixels::new(&mut vec![none; before.len()], AREA).unwrap(), depth);
            alone.draw_deep(opaque, target, depth);
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
            behind.draw_deep(paint, target, depth);
            front.draw_deep(translucent, target, depth);
        });
        assert!(drawn.1 == stored, "depth is not stored");
        assert!(drawn.0 == wanted && drawn.0 != before);
    }
}

/// The function is light that is added. Halves, alphas, keys and screen doors are in `fuzz/targets/translucent.rs`.
#[test]
fn faces_are_mixed_by_any_function_of_both_colors() {
    let scene = Faces::soup(&mut Rng::new(33), 120, 1200, 3000, |_| 0);
    let color = |face: usize| Rgb888::new(!(face as u8), (3 * face) as u8, 100);
    let smooth = |face: usize| Gouraud::new([color(face), color(face + 70), color(face + 140)]);
    let added = |own: Rgb888, stored: Rgb888| each_level(own, stored, u8::saturating_add);
    check_scene(&scene, &color, &|face| Translucent::new(color(face), added), &added);
    check_scene(&scene, &smooth, &|face| Translucent::new(smooth(face), added), &added);
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
    type Ink = Rgb888;
    type Setup = Rgb888;
    type FastPath = ();
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
