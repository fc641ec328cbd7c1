//! The ordered dither against Bayer's pattern; that each pixel has the level that its rank selects is tested in `levels`.

use crate::levels::{rank, CORNER};
use crate::scene::{
    draw, flat, for_every_colour, random_colour, random_triangle, with_triangle, Colour, SIZE,
};
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::Gray4;
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::{Dithered, Flat};
use support::oracle::rng::Rng;
use support::oracle::shade::Lit;
use support::oracle::target::Screen;

/// A picture filled with one colour.
fn filled<C: Colour>(shader: Dithered<Flat>) -> Screen<C> {
    with_triangle([(-20_000, -20_000), (60_000, -20_000), (-20_000, 60_000)], |face| draw(face, shader))
}

fn even<C: Colour>(colour: Lit, rng: &mut Rng) {
    let picture = filled::<C>(flat(colour).dithered());
    let exact = C::DEPTHS.levels(colour);
    for (at, drawn) in picture.drawn() {
        for (level, &(n, d)) in drawn.levels().into_iter().zip(&exact) {
            let sum = n as f64 / d as f64 + (2 * rank(at) + 1) as f64 / 128.0;
            assert!(
                ((sum - CORNER).floor()..=(sum + CORNER).floor()).contains(&(level as f64)),
                "{at} {colour:?}"
            );
            // A colour that is exactly a level is not dithered.
            assert!(n % d != 0 || level == n / d, "{at} {colour:?}");
        }
    }
    // Any 8 × 8 pixels: |sum − 64·exact| ≤ 64·(1/128 + 2⁻¹⁶), times 2¹⁰.
    let corner = Point::new(rng.below(57) as i32, rng.below(41) as i32);
    let block = Rectangle::new(corner, Size::new(8, 8));
    for (channel, (n, d)) in exact.into_iter().enumerate() {
        let level = |p: Point| picture.at(p).expect("drawn everywhere").levels()[channel];
        let sum: i128 = block.points().map(level).sum();
        assert!((sum * d - 64 * n).abs() << 10 <= (512 + 1) * d, "{sum} for {n}/{d}: {colour:?} {corner:?}");
    }
}

#[test]
fn dithering_keeps_means_and_leaves_exact_levels_pure() {
    let mut rng = Rng::new(0x71);
    for _ in 0..60 {
        let colour = random_colour(&mut rng);
        for_every_colour!(even(colour, &mut rng));
    }
    for grey in [0, 17, 85, 170, 255] {
        // Lights that are levels of Gray4, levels of Gray2, and all lights.
        let colour = Lit { rgb: [grey; 3], level: 256 };
        for_every_colour!(even(colour, &mut rng));
    }
}

/// More light makes no pixel darker, and all 65 shades of the pattern differ.
fn monotone<C: Colour>() {
    let levels = |grey: u8| -> Vec<i128> {
        let picture = filled::<C>(flat(Lit { rgb: [grey; 3], level: 256 }).dithered());
        assert_eq!(picture.drawn().count() as u32, SIZE.0 * SIZE.1);
        picture.drawn().flat_map(|(_, colour)| colour.levels()).collect()
    };
    let mut last = levels(0);
    assert!(last.iter().all(|&level| level == 0));
    let mut changes = 0;
    for grey in 1..=255 {
        let next = levels(grey);
        assert!(next.iter().zip(&last).all(|(next, last)| next >= last), "{grey}");
        changes += usize::from(next != last);
        last = next;
    }
    let channels = C::DEPTHS.0.len();
    assert!(last.chunks(channels).all(|pixel| pixel == C::DEPTHS.0));
    let shades = 64 * C::DEPTHS.0.iter().max().expect("a channel") + 1;
    assert!(changes as i128 >= 254.min(shades - 1), "{changes} of {shades}");
}

#[test]
fn more_light_makes_no_pixel_darker() {
    for_every_colour!(monotone());
}

/// The pattern is fixed to the screen: a moving face uncovers pixels of one fixed picture.
#[test]
fn the_dither_pattern_is_fixed_to_the_screen() {
    let mut rng = Rng::new(0x72);
    let shader = flat(Lit { rgb: [90, 140, 33], level: 200 }).dithered();
    let still = filled::<Gray4>(shader);
    for _ in 0..200 {
        let moved = with_triangle(random_triangle(&mut rng), |face| draw::<Gray4, _>(face, shader));
        assert!(moved.drawn().all(|(at, colour)| still.at(at) == Some(colour)));
    }
    let kinds: std::collections::BTreeSet<_> = still.drawn().map(|(_, colour)| colour.levels()).collect();
    assert_eq!(kinds.len(), 2);
}
