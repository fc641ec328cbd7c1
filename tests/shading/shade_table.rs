//! Colours of a shade table against the plane through the corners' light, at the centres of pixels.

use crate::scene::{
    corners, draw, flat_camera, for_every_colour, mesh, random_lights, random_triangle, shaded, table,
    vertex, Colour,
};
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Affine, Cull, DepthBuffer, Picture, ShadeTable};
use support::oracle::coverage::{centre, P};
use support::oracle::rng::Rng;
use support::oracle::shade::{distance, Depths, Lit};

/// The bound in entries: ½ for the rounding, and the documented error of a gradient.
const BOUND: f64 = 0.5 + 1.0 / 512.0;

/// A table of white in 255 levels: the level is the index of the entry.
const NUMBERS: Depths = Depths(&[255]);

fn white(light: Lit) -> Lit {
    Lit { rgb: [255; 3], ..light }
}

/// A colour type of indices: the entry that a pixel shows.
fn numbers() -> ShadeTable<Rgb888> {
    ShadeTable::from_colors(core::array::from_fn(|i| Rgb888::new(i as u8, 255 - i as u8, 7)))
}

#[test]
fn light_selects_the_nearest_table_entry() {
    let (mut rng, camera, table) = (Rng::new(0xA0), flat_camera(), numbers());
    let (mut worst, mut beyond) = (0.0f64, 0.0f64);
    for _ in 0..6000 {
        let (t, lights): ([P; 3], _) = (random_triangle(&mut rng), random_lights(&mut rng));
        let vertices = t.map(vertex);
        let mesh = mesh(&vertices);
        let instance = camera.place(&mesh, &Affine::identity());
        let Some(t) = corners(&instance) else { panic!("{t:?} is in the guard band") };
        let picture = draw::<Rgb888, _>(&instance, table.lit(lights.map(|light| light.level)));
        for (p, colour) in picture.drawn() {
            let exact = NUMBERS.over(t, lights.map(white), centre(p.x.into(), p.y.into()));
            let [number, ..] = colour.levels()[..] else { panic!("three channels") };
            let error = distance(number, exact[0]);
            assert!(error <= BOUND, "{error} at {p:?}: {t:?} {lights:?}");
            worst = worst.max(error);
            beyond = beyond.max(error - 0.5);
        }
    }
    println!("within {worst:.6} of an entry, {beyond:.6} beyond the rounding");
    assert!(worst > 0.499);
}

/// The bound of a channel: the rounding of its entry and of the light.
fn random<C: Colour>(cases: usize) {
    let (mut rng, camera) = (Rng::new(0xA1), flat_camera());
    let mut worst = 0.0f64;
    for _ in 0..cases {
        let (t, lights): ([P; 3], _) = (random_triangle(&mut rng), random_lights(&mut rng));
        let vertices = t.map(vertex);
        let mesh = mesh(&vertices);
        let instance = camera.place(&mesh, &Affine::identity());
        let Some(t) = corners(&instance) else { panic!("{t:?} is in the guard band") };
        let picture = draw::<C, _>(&instance, shaded(lights));
        assert_eq!(picture.drawn().count(), draw::<C, _>(&instance, C::decode(0)).drawn().count());
        for (p, colour) in picture.drawn() {
            let exact = C::DEPTHS.over(t, lights, centre(p.x.into(), p.y.into()));
            for ((level, exact), max) in colour.levels().into_iter().zip(exact).zip(C::DEPTHS.0) {
                let bound = 0.5 + BOUND * *max as f64 / 255.0;
                let error = distance(level, exact);
                assert!(error <= bound, "{error} at {p:?}: {t:?} {lights:?}");
                worst = worst.max(error / bound);
            }
        }
    }
    assert!(worst > 0.5, "{worst}");
    println!("{}: within {worst:.3} of the bound", core::any::type_name::<C>());
}

#[test]
fn table_colors_are_within_the_documented_bound() {
    for_every_colour!(random(700));
}

/// Each entry is the nearest colour, to the last bit.
fn entries<C: Colour>(rng: &mut Rng) {
    let lights = random_lights(rng);
    for (number, colour) in table::<C>(lights).colors().iter().enumerate() {
        // number/255 of the light: 256/255 of number/256.
        let exact = C::DEPTHS.levels(Lit { level: number as u16, ..lights[0] });
        for (level, (n, d)) in colour.levels().into_iter().zip(exact) {
            assert!(distance(level, (n * 256, d * 255)) <= 0.5, "{number}: {lights:?}");
        }
    }
}

#[test]
fn table_entries_are_the_nearest_colors_of_the_target() {
    let mut rng = Rng::new(0xA2);
    for _ in 0..100 {
        for_every_colour!(entries(&mut rng));
    }
}

/// Full light selects the last entry in every pixel, no light the first; more than full light counts as full.
#[test]
fn full_light_and_no_light_select_the_last_and_the_first_entry() {
    let (mut rng, camera, table) = (Rng::new(0xA3), flat_camera(), numbers());
    for _ in 0..3000 {
        let vertices = random_triangle(&mut rng).map(vertex);
        let mesh = mesh(&vertices);
        let instance = camera.place(&mesh, &Affine::identity());
        for (levels, number) in [([256, 257, u16::MAX], 255), ([0; 3], 0)] {
            let picture = draw::<Rgb888, _>(&instance, table.lit(levels));
            assert!(picture.drawn().all(|(_, c)| c == table.colors()[number]), "{vertices:?} {levels:?}");
        }
    }
}

/// The loops for memory targets, with depth and without, draw the pixels of any other target.
#[test]
fn memory_targets_and_depth_tests_draw_the_colors_of_any_target() {
    let (mut rng, camera) = (Rng::new(0xA4), flat_camera());
    let size = Size::new(64, 48);
    let area = Rectangle::new(Point::zero(), size);
    let mut drawn = 0;
    for _ in 0..3000 {
        let (lights, black) = (random_lights(&mut rng), Rgb565::new(0, 0, 0));
        let vertices = random_triangle(&mut rng).map(vertex);
        let mesh = mesh(&vertices);
        let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None);
        let shader = shaded::<Rgb565>(lights);
        let wanted = draw::<Rgb565, _>(&instance, shader);
        drawn += wanted.drawn().count();
        let wanted = wanted.before(black);
        let mut pixels = [black; 64 * 48];
        let Ok(_) =
            instance.solid(|_| shader, &mut [], &mut Picture::new(&mut pixels, size).expect("room").pixels());
        assert!(pixels[..] == wanted[..], "{vertices:?} {lights:?}");
        let (mut pixels, mut depths) = ([black; 64 * 48], [0; 64 * 48]);
        let mut depth = DepthBuffer::new(area, &mut depths).expect("room");
        let mut picture = Picture::new(&mut pixels, size).expect("room");
        let Ok(_) = instance.depth_tested(|_| shader, &mut [], &mut depth, &mut picture.pixels());
        assert!(pixels[..] == wanted[..], "with depth: {vertices:?} {lights:?}");
    }
    assert!(drawn > 300_000, "{drawn}");
}
