//! Tables of shades have the nearest colours of the target, and light selects the nearest entry at the centres of pixels.
//! The levels of faces that are drawn with tables are tested in `levels`.

use crate::scene::{
    corners, draw, for_every_colour, random_colour, random_lights, random_triangle, with_triangle, Colour,
};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::{mesh::FaceColors, shading::ShadeTable};
use support::oracle::coverage::{centre, edge};
use support::oracle::rng::Rng;
use support::oracle::shade::Depths;

fn rgb([r, g, b]: [u8; 3]) -> Rgb888 {
    Rgb888::new(r, g, b)
}

/// A channel of 0 … 255 in parts of a unit.
type Color = [i64; 3];

fn each(of: &dyn Fn(usize) -> i64) -> Color {
    [of(0), of(1), of(2)]
}

/// The exact levels of a target, as numerators and their common denominator; greys by the luma of Rec. 601 with weights of 256.
fn exact_levels(depths: Depths, [r, g, b]: Color, unit: i64) -> (Vec<i64>, i64) {
    match *depths.0 {
        [max] => (vec![(77 * r + 150 * g + 29 * b) * max as i64], 256 * 255 * unit),
        ref all => {
            (all.iter().zip([r, g, b]).map(|(&max, channel)| channel * max as i64).collect(), 255 * unit)
        }
    }
}

/// The levels of entries, and those of their target.
fn levels<C: Colour>(entries: impl Iterator<Item = C>) -> (Depths, Vec<Vec<i128>>) {
    (C::DEPTHS, entries.map(C::levels).collect())
}

/// Compares entries with the colours that `exact` gives for their numbers, to the last bit; halves are rounded up.
fn check(name: &str, (depths, entries): (Depths, Vec<Vec<i128>>), unit: i64, exact: &dyn Fn(i64) -> Color) {
    for (number, found) in entries.iter().enumerate() {
        let (numerators, unit) = exact_levels(depths, exact(number as i64), unit);
        let nearest: Vec<_> =
            numerators.into_iter().map(|n| i128::from((2 * n + unit) / (2 * unit))).collect();
        assert_eq!(*found, nearest, "{name}, {number}");
    }
}

fn entries<C: Colour>(colours @ [own, other]: [[u8; 3]; 2]) {
    let [own, other] = [rgb(own), rgb(other)];
    let shades = |table: ShadeTable<C>| levels(table.colors().iter().copied());
    check_tables(
        colours,
        [
            shades(ShadeTable::new(own)),
            shades(ShadeTable::emitting(own, other)),
            shades(ShadeTable::in_fog(own, other)),
            shades(ShadeTable::with_highlight(own, other)),
        ],
    );
}

/// Compares tables of a colour that are new, emit another one, fade into it, and have it as their highlight.
fn check_tables(colours: [[u8; 3]; 2], [new, emitting, in_fog, highlight]: [(Depths, Vec<Vec<i128>>); 4]) {
    let [own, other] = [0, 1].map(|i| move |k: usize| i64::from(colours[i][k]));
    let sum = |k: usize, i: i64| (own(k) * i + other(k) * 255).min(255 * 255);
    check("new", new, 255, &|i| each(&|k| own(k) * i));
    check("emitting", emitting, 255, &|i| each(&|k| sum(k, i)));
    check("in fog", in_fog, 255, &|i| each(&|k| own(k) * i + other(k) * (255 - i)));
    // Light up to 3/4 of the table, and then the highlight: within ½ level and 1/128.
    for (i, found) in (0..).zip(highlight.1) {
        let exact = each(&|k| match 4 * i <= 765 {
            true => own(k) * 4 * i,
            false => own(k) * 765 + (other(k) - own(k)) * 3 * (4 * i - 765),
        });
        let (numerators, unit) = exact_levels(highlight.0, exact, 765);
        for (n, level) in numerators.into_iter().zip(found) {
            assert!(128 * (level as i64 * unit - n).abs() <= 65 * unit, "highlight, {i}: {level}");
        }
    }
}

#[test]
fn tables_have_the_nearest_colours_of_the_target() {
    let mut rng = Rng::new(0xA2);
    for case in 0..60 {
        let colours = match case {
            0 => [[255; 3], [0; 3]],
            1 => [[0; 3], [255; 3]],
            _ => [(); 2].map(|()| random_colour(&mut rng).rgb),
        };
        for_every_colour!(entries(colours));
    }
}

/// A table whose colours name their entries.
fn numbers() -> ShadeTable<Rgb888> {
    ShadeTable::from_colors(core::array::from_fn(|i| Rgb888::new(i as u8, 255 - i as u8, 7)))
}

/// Within ½ entry for the rounding, and the documented error of a gradient. Full light, and more than it, selects the last entry in
/// every pixel, and no light the first.
#[test]
fn light_selects_the_nearest_table_entry() {
    let (mut rng, table, mut worst) = (Rng::new(0xA0), numbers(), 0.0f64);
    for case in 0..8000 {
        let t = random_triangle(&mut rng);
        let lights = match case % 4 {
            0 => [[256, 257, u16::MAX], [0; 3]][case / 4 % 2],
            _ => random_lights(&mut rng).map(|light| light.level),
        };
        with_triangle(t, |instance| {
            let [a, b, c] = corners(instance);
            let exact = lights.map(|level| f64::from(level.min(256)) * 255.0 / 256.0);
            for (at, colour) in draw::<Rgb888, _>(instance, table.lit(lights)).drawn() {
                let p = centre(at.x.into(), at.y.into());
                let areas = [edge(p, b, c), edge(a, p, c), edge(a, b, p)].map(|area| area as f64);
                let sum = (0..3).map(|i| areas[i] * exact[i]).sum::<f64>() / edge(a, b, c) as f64;
                let error = (f64::from(colour.r()) - sum).abs();
                let is_even = case % 4 == 0;
                assert!(
                    error <= if is_even { 0.001 } else { 0.5 + 1.0 / 512.0 },
                    "{error} at {at}: {t:?} {lights:?}"
                );
                worst = worst.max(error);
                assert_eq!(colour, table.colors()[usize::from(colour.r())]);
            }
        });
    }
    println!("within {worst:.6} of an entry");
    assert!(worst > 0.499);
}

#[test]
fn colours_of_faces_may_emit_light() {
    let colors = FaceColors::new(&[[100, 0, 0], [0, 200, 0], [100, 0, 0]], &[1, 2, 0, 1]).unwrap();
    assert_eq!(colors.emission::<Rgb888>(0), Rgb888::BLACK);
    assert_eq!(colors.lit::<Rgb888>(0, 128), Rgb888::new(0, 100, 0));
    let lamps = colors.with_emission(&[[0, 0, 0], [0, 100, 9], [250, 0, 0]]).unwrap();
    let lit = [0, 1, 2, 3, 4].map(|face| lamps.lit::<Rgb888>(face, 128));
    assert_eq!(lit, [[0, 200, 9], [255, 0, 0], [50, 0, 0], [0, 200, 9], [0, 0, 0]].map(rgb));
    assert_eq!(
        [0, 1, 2].map(|face| lamps.color::<Rgb888>(face)),
        [0, 1, 2].map(|face| colors.color::<Rgb888>(face))
    );
    for (emission, count) in [(&[] as &[_], 0), (&[[1; 3]; 4], 4)] {
        let error = colors.with_emission(emission).unwrap_err();
        let wanted = format!(
            "a list of {count} entries where 3 are needed: give one emitted colour per colour, black for none"
        );
        assert_eq!(error.to_string(), wanted);
    }
}
