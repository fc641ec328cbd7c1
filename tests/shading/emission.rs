//! Faces that emit light: the sum of lit colour and emission, against sums in f64.

use crate::scene::{
    corners, draw, flat, flat_camera, for_every_colour, lit, mesh, random_colour, random_lights,
    random_triangle, vertex, Colour,
};
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr666, BinaryColor, Gray2, Gray8, GrayColor, Rgb565, Rgb888, RgbColor,
};
use pinhole::{Affine, Dim, FaceColors, LitPalette, MaterialError, ShadeTable, SpanShader};
use support::oracle::coverage::{centre, edge, P};
use support::oracle::rng::Rng;
use support::oracle::shade::Lit;

/// A sum of 0 … 255 in each channel: lit colour and emission, at most full.
fn sum(colour: Lit, emission: [u8; 3]) -> [f64; 3] {
    let lit = colour.rgb.map(|c| f64::from(c) * f64::from(colour.level) / 256.0);
    [0, 1, 2].map(|i| (lit[i] + f64::from(emission[i])).min(255.0))
}

/// The levels of a target, from channels of 0 … 255; greys by the luma of Rec. 601 with weights of 256.
fn levels<C: Colour>(channels: [f64; 3]) -> Vec<f64> {
    let [r, g, b] = channels;
    match *C::DEPTHS.0 {
        [max] => vec![(77.0 * r + 150.0 * g + 29.0 * b) / 256.0 * max as f64 / 255.0],
        ref all => all.iter().zip(channels).map(|(&max, channel)| channel * max as f64 / 255.0).collect(),
    }
}

fn off<C: Colour>(colour: C, exact: [f64; 3]) -> f64 {
    let pairs = colour.levels().into_iter().zip(levels::<C>(exact));
    pairs.map(|(level, exact)| (level as f64 - exact).abs()).fold(0.0, f64::max)
}

fn rgb([r, g, b]: [u8; 3]) -> Rgb888 {
    Rgb888::new(r, g, b)
}

/// Draws a triangle, and returns the largest distance of a pixel's levels from those that `exact` gives for its weights of the corners.
fn worst<C: Colour, S: SpanShader<C>>(t: [P; 3], shader: S, exact: impl Fn([f64; 3]) -> [f64; 3]) -> f64 {
    let (camera, vertices) = (flat_camera(), t.map(vertex));
    let mesh = mesh(&vertices);
    let instance = camera.place(&mesh, &Affine::identity());
    let [a, b, c] = corners(&instance).expect("it is in the guard band");
    let whole = edge(a, b, c) as f64;
    let picture = draw::<C, _>(&instance, shader);
    let distances = picture.drawn().map(|(p, colour)| {
        let p = centre(p.x.into(), p.y.into());
        off(colour, exact([edge(p, b, c), edge(a, p, c), edge(a, b, p)].map(|area| area as f64 / whole)))
    });
    distances.fold(0.0, f64::max)
}

fn faces<C: Colour>(cases: usize) {
    let mut rng = Rng::new(0xE1);
    let [mut flat_worst, mut smooth_worst] = [0.0f64; 2];
    for _ in 0..cases {
        let (t, emission) = (random_triangle(&mut rng), random_colour(&mut rng).rgb);
        let colour = random_colour(&mut rng);
        let shader = flat(colour).emitting(rgb(emission));
        flat_worst = flat_worst.max(worst::<C, _>(t, shader, |_| sum(colour, emission)));
        let lights = random_lights(&mut rng);
        let sums = lights.map(|light| sum(light, emission));
        let mixed = |weights: [f64; 3]| [0, 1, 2].map(|i| (0..3).map(|k| weights[k] * sums[k][i]).sum());
        smooth_worst = smooth_worst.max(worst::<C, _>(t, lit(lights).emitting(rgb(emission)), mixed));
    }
    println!("{}: {flat_worst:.6} and {smooth_worst:.6} level", core::any::type_name::<C>());
    // Halves are rounded in 1/2^17 of a level.
    assert!(flat_worst <= 0.5 + 1.0 / 65536.0 && flat_worst > 0.4, "{flat_worst}");
    assert!(smooth_worst <= 0.5 + 1.0 / 512.0 && smooth_worst > 0.49, "{smooth_worst}");
}

#[test]
fn faces_have_the_nearest_levels_of_lit_colour_and_emission() {
    for_every_colour!(faces(400));
}

fn tables<C: Colour>(cases: usize) {
    let mut rng = Rng::new(0xE2);
    for _ in 0..cases {
        let [colors, emissions] = [0; 2].map(|_| [0; 3].map(|_| random_colour(&mut rng).rgb));
        let table = ShadeTable::<C>::emitting(rgb(colors[0]), rgb(emissions[0]));
        let palette = LitPalette::<C, 3, 32>::emitting(&colors.map(rgb), &emissions.map(rgb));
        let at = |i: usize, step: usize, steps: usize| {
            let lit = colors[i].map(|c| f64::from(c) * step as f64 / steps as f64);
            [0, 1, 2].map(|k| (lit[k] + f64::from(emissions[i][k])).min(255.0))
        };
        for (step, &color) in table.colors().iter().enumerate() {
            assert!(off(color, at(0, step, 255)) <= 0.5 + 1e-9, "{colors:?} {emissions:?} {step}");
        }
        for (row, shades) in palette.rows().iter().enumerate() {
            for (i, &color) in shades.iter().enumerate() {
                assert!(off(color, at(i, row, 31)) <= 0.5 + 1e-9, "{colors:?} {emissions:?} {row}");
            }
        }
        // A face that emits nothing has the shades of light alone.
        assert_eq!(ShadeTable::<C>::emitting(rgb(colors[0]), Rgb888::BLACK), ShadeTable::new(rgb(colors[0])));
    }
}

#[test]
fn tables_and_palettes_have_the_nearest_levels() {
    for_every_colour!(tables(60));
}

/// Every pair of levels of a channel, in the format's own levels.
#[test]
fn channels_of_a_format_add_up_to_full() {
    for own in 0..=255u8 {
        for emission in 0..=255u8 {
            let wanted = |max: u16| (u16::from(own) + u16::from(emission)).min(max) as u8;
            let [a, b] = [own, emission].map(Gray8::new);
            assert_eq!(a.emitting(b).luma(), wanted(255));
            let mixed = Rgb888::new(own, emission, 7).emitting(Rgb888::new(emission, 0, 250));
            assert_eq!(mixed, Rgb888::new(wanted(255), emission, 255));
            if own < 64 && emission < 64 {
                let mixed = Rgb565::new(own / 2, own, 31).emitting(Rgb565::new(emission / 2, emission, 0));
                let five = (u16::from(own / 2) + u16::from(emission / 2)).min(31) as u8;
                assert_eq!(mixed, Rgb565::new(five, wanted(63), 31));
                let mixed = Bgr666::new(0, own, 63).emitting(Bgr666::new(emission, emission, 1));
                assert_eq!(mixed, Bgr666::new(emission, wanted(63), 63));
            }
            if own < 32 && emission < 32 {
                let mixed = Bgr555::new(own, 3, 0).emitting(Bgr555::new(emission, 4, 0));
                assert_eq!(mixed, Bgr555::new(wanted(31), 7, 0));
            }
            if own < 4 && emission < 4 {
                assert_eq!(Gray2::new(own).emitting(Gray2::new(emission)).luma(), wanted(3));
            }
        }
    }
    let (on, dark) = (BinaryColor::On, BinaryColor::Off);
    let all = [(dark, dark), (dark, on), (on, dark), (on, on)].map(|(own, emission)| own.emitting(emission));
    assert_eq!(all, [dark, on, on, on]);
}

#[test]
fn colours_of_faces_may_emit_light() {
    let colors = FaceColors::new(&[[100, 0, 0], [0, 200, 0], [100, 0, 0]], &[1, 2, 0, 1]).unwrap();
    assert_eq!(colors.emissions(), [[0u8; 3]; 0]);
    assert_eq!(colors.emission::<Rgb888>(0), Rgb888::BLACK);
    assert_eq!(colors.lit::<Rgb888>(0, 128), Rgb888::new(0, 100, 0));
    let lamps = colors.with_emission(&[[0, 0, 0], [0, 100, 9], [250, 0, 0]]).unwrap();
    let lit = [0, 1, 2, 3, 4].map(|face| lamps.lit::<Rgb888>(face, 128));
    assert_eq!(lit, [[0, 200, 9], [255, 0, 0], [50, 0, 0], [0, 200, 9], [0, 0, 0]].map(rgb));
    assert_eq!((lamps.palette(), lamps.faces()), (colors.palette(), colors.faces()));
    for (emission, count) in [(&[] as &[_], 0), (&[[1; 3]; 4], 4)] {
        let error = colors.with_emission(emission).unwrap_err();
        assert_eq!(error, MaterialError::Emission { emission: count, palette: 3 });
        let wanted = format!("{count} emitted colours for a palette of 3: give one for each, black for none");
        assert_eq!(error.to_string(), wanted);
    }
}
