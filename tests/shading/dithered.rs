//! The ordered dither against Bayer's pattern.

use crate::scene::{
    corners, draw, flat, flat_camera, for_every_colour, gouraud, lit, mesh, random_colour, random_lights,
    random_triangle, vertex, Colour, Picture,
};
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::Gray4;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Affine, Flat};
use support::bridge;
use support::oracle::coverage::centre;
use support::oracle::rng::Rng;
use support::oracle::shade::{bayer, dithered, Fraction, Lit};

/// Bounds in levels: the rounding of the corners' colours, and the error of a gradient over a triangle.
const EVEN: Fraction = (1, 1 << 16);
const SMOOTH: Fraction = (1, 512);

fn rank(pattern: &[Vec<i128>], p: Point) -> i128 {
    pattern[p.y.rem_euclid(8) as usize][p.x.rem_euclid(8) as usize]
}

/// A picture filled with one colour.
fn everywhere<C: Colour>(shader: pinhole::Dithered<Flat>) -> Picture<C> {
    let vertices = [(-20_000, -20_000), (60_000, -20_000), (-20_000, 60_000)].map(vertex);
    let (camera, mesh) = (flat_camera(), mesh(&vertices));
    draw(&camera.place(&mesh, &Affine::identity()), shader)
}

fn smooth<C: Colour>(cases: usize) {
    let (mut rng, pattern, camera) = (Rng::new(0x70), bayer(8), flat_camera());
    let mut seen = 0;
    for _ in 0..cases {
        let of_one_colour = rng.one_in(2);
        let colours = match of_one_colour {
            true => random_lights(&mut rng),
            false => [0; 3].map(|_| random_colour(&mut rng)),
        };
        let vertices = random_triangle(&mut rng).map(vertex);
        let mesh = mesh(&vertices);
        let instance = camera.place(&mesh, &Affine::identity());
        let t = corners(&instance).expect("in the guard band");
        let picture = match of_one_colour {
            true => draw::<C, _>(&instance, lit(colours).dithered()),
            false => draw::<C, _>(&instance, gouraud(colours).dithered()),
        };
        for (p, colour) in picture.drawn() {
            let exact = C::DEPTHS.over(t, colours, centre(p.x.into(), p.y.into()));
            for (level, exact) in colour.levels().into_iter().zip(exact) {
                let wanted = dithered(exact, rank(&pattern, p), SMOOTH);
                assert!(wanted.contains(&level), "{level} for {wanted:?} at {p:?}: {t:?} {colours:?}");
            }
            seen += 1;
        }
    }
    assert!(seen > 100 * cases);
}

#[test]
fn smooth_dithered_colors_take_the_level_of_the_bayer_pattern() {
    for_every_colour!(smooth(800));
}

fn even<C: Colour>(colour: Lit, rng: &mut Rng) {
    let (pattern, picture) = (bayer(8), everywhere::<C>(flat(colour).dithered()));
    let exact = C::DEPTHS.levels(colour);
    for (p, drawn) in picture.drawn() {
        for (level, exact) in drawn.levels().into_iter().zip(&exact) {
            assert!(dithered(*exact, rank(&pattern, p), EVEN).contains(&level), "{p:?} {colour:?}");
            // A colour that is exactly a level is not dithered.
            assert!(exact.0 % exact.1 != 0 || level == exact.0 / exact.1, "{p:?} {colour:?}");
        }
    }
    // Any 8 × 8 pixels: |sum − 64·exact| ≤ 64·(1/128 + 2⁻¹⁶), times 2¹⁰.
    let corner = Point::new(rng.below(57) as i32, rng.below(41) as i32);
    let block = Rectangle::new(corner, bridge::rectangle(0, 0, 8, 8).size);
    for (channel, (n, d)) in exact.into_iter().enumerate() {
        let level = |p: Point| picture.at(p).expect("everywhere").levels()[channel];
        let sum: i128 = embedded_graphics_core::primitives::PointsIter::points(&block).map(level).sum();
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
    let shades = |grey: u8| everywhere::<C>(flat(Lit { rgb: [grey; 3], level: 256 }).dithered());
    let levels =
        |picture: &Picture<C>| -> Vec<i128> { picture.drawn().flat_map(|(_, c)| c.levels()).collect() };
    let mut last = levels(&shades(0));
    assert!(last.iter().all(|&level| level == 0));
    let mut changes = 0;
    for grey in 1..=255 {
        let next = levels(&shades(grey));
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
    let (mut rng, camera) = (Rng::new(0x72), flat_camera());
    let shader = flat(Lit { rgb: [90, 140, 33], level: 200 }).dithered();
    let still = everywhere::<Gray4>(shader);
    for _ in 0..200 {
        let vertices = random_triangle(&mut rng).map(vertex);
        let mesh = mesh(&vertices);
        let moved = draw::<Gray4, _>(&camera.place(&mesh, &Affine::identity()), shader);
        assert!(moved.drawn().all(|(p, colour)| still.at(p) == Some(colour)));
    }
    let kinds: std::collections::BTreeSet<_> = still.drawn().map(|(_, c)| c.levels()).collect();
    assert_eq!(kinds.len(), 2);
}
