//! Gouraud colours against the plane through the corners' levels, at the centres of pixels.

use crate::scene::{
    corners, draw, flat, flat_camera, for_every_colour, gouraud, lit, mesh, random_colour, random_lights,
    random_triangle, vertex, Colour,
};
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, Gray8, Rgb555, Rgb565, Rgb666, Rgb888,
};
use pinhole::{Affine, Channels, Flat, Gouraud, SpanShader};
use support::oracle::coverage::{centre, edge, P};
use support::oracle::rng::Rng;
use support::oracle::shade::{distance, Lit};
use support::oracle::target::{Call, Recorder};

/// The bound in levels: ½ for the rounding, and the documented error of a gradient.
const BOUND: f64 = 0.5 + 1.0 / 512.0;

fn check<C: Colour, I: SpanShader<C>>(
    t: [P; 3],
    shader: impl Fn([Lit; 3]) -> I,
    colours: [Lit; 3],
    worst: &mut f64,
) {
    let (camera, vertices) = (flat_camera(), t.map(vertex));
    let mesh = mesh(&vertices);
    let instance = camera.place(&mesh, &Affine::identity());
    let Some(t) = corners(&instance) else { panic!("{t:?} is in the guard band") };
    let picture = draw::<C, _>(&instance, shader(colours));
    let plain = draw::<C, _>(&instance, C::decode(0));
    assert_eq!(picture.drawn().count(), plain.drawn().count());
    for (p, colour) in picture.drawn() {
        let exact = C::DEPTHS.over(t, colours, centre(p.x.into(), p.y.into()));
        for (level, exact) in colour.levels().into_iter().zip(exact) {
            let error = distance(level, exact);
            assert!(error <= BOUND, "{error} at {p:?}: {t:?} {colours:?}");
            *worst = worst.max(error);
        }
    }
}

fn random<C: Colour>(cases: usize) {
    let mut rng = Rng::new(0x60);
    let (mut worst, mut worst_lit) = (0.0, 0.0);
    let mut windings = [0, 0];
    for _ in 0..cases {
        let t = random_triangle(&mut rng);
        windings[usize::from(edge(t[0], t[1], t[2]) > 0)] += 1;
        check::<C, _>(t, gouraud, [0; 3].map(|_| random_colour(&mut rng)), &mut worst);
        check::<C, _>(t, lit, random_lights(&mut rng), &mut worst_lit);
    }
    assert!(windings.iter().all(|&n| n > cases / 3) && worst > 0.499 && worst_lit > 0.499, "{windings:?}");
    println!("{}: within {worst:.6} levels, lit {worst_lit:.6}", core::any::type_name::<C>());
}

#[test]
fn gouraud_colors_are_the_nearest_levels_of_their_gradients() {
    for_every_colour!(random(1500));
}

/// Three equal corner colours give the colour of a flat face in every pixel, to the last bit.
fn even<C: Colour>(rng: &mut Rng) {
    let (camera, colour) = (flat_camera(), random_colour(rng));
    let vertices = random_triangle(rng).map(vertex);
    let mesh = mesh(&vertices);
    let instance = camera.place(&mesh, &Affine::identity());
    let whole = draw::<C, _>(&instance, flat(colour));
    assert_eq!(draw::<C, _>(&instance, gouraud([colour; 3])), whole, "{vertices:?} {colour:?}");
    for (_, drawn) in whole.drawn() {
        for (level, exact) in drawn.levels().into_iter().zip(C::DEPTHS.levels(colour)) {
            assert!(distance(level, exact) <= 0.5 + 1.0 / 65536.0, "{colour:?}");
        }
    }
}

#[test]
fn three_equal_corner_colors_make_a_solid_face() {
    let mut rng = Rng::new(0x61);
    for _ in 0..300 {
        for_every_colour!(even(&mut rng));
    }
}

/// Rounded as `embedded-graphics` rounds.
fn nearest<C: Channels + From<Rgb888> + core::fmt::Debug>(colour: Rgb888) {
    let vertices = [(0, 0), (0, 9000), (9000, 0)].map(vertex);
    let (camera, mesh) = (flat_camera(), mesh(&vertices));
    let mut target = Recorder::<C>::sized(64, 48);
    let instance = camera.place(&mesh, &Affine::identity());
    instance.solid(|_| Flat::from(colour), &mut [], &mut target).expect("no error");
    assert!(target.pixels.len() > 500);
    assert!(
        target.pixels.values().all(|&(drawn, _)| drawn == C::from(colour)),
        "{colour:?}: {:?}",
        C::from(colour)
    );
}

#[test]
fn flat_colors_are_the_nearest_of_every_color_type() {
    let mut rng = Rng::new(0x62);
    for _ in 0..300 {
        let [r, g, b] = random_colour(&mut rng).rgb;
        let colour = Rgb888::new(r, g, b);
        nearest::<Rgb555>(colour);
        nearest::<Bgr555>(colour);
        nearest::<Rgb565>(colour);
        nearest::<Bgr565>(colour);
        nearest::<Rgb666>(colour);
        nearest::<Bgr666>(colour);
        nearest::<Rgb888>(colour);
        nearest::<Bgr888>(colour);
        nearest::<Gray8>(colour);
    }
}

/// Pixels are sent with one call for each span.
#[test]
fn one_draw_call_fills_a_whole_span() {
    let vertices = [(100, 100), (9000, 3000), (2000, 11_000)].map(vertex);
    let (camera, mesh) = (flat_camera(), mesh(&vertices));
    let instance = camera.place(&mesh, &Affine::identity()).with_cull(pinhole::Cull::None);
    let shader = Gouraud::lit(Rgb888::new(200, 100, 50), [0, 256, 100]);
    let (mut smooth, mut plain) = (Recorder::<Rgb565>::sized(64, 48), Recorder::<Rgb565>::sized(64, 48));
    instance.solid(|_| shader, &mut [], &mut smooth).expect("no error");
    instance.solid(|_| Rgb565::new(0, 0, 0), &mut [], &mut plain).expect("no error");
    let spans = |calls: &[Call<Rgb565>]| -> Vec<_> {
        calls
            .iter()
            .map(|call| match *call {
                Call::Solid(area, _) => (area, area.size.width as usize),
                Call::Contiguous(area, colours) => (area, colours),
                ref other => panic!("{other:?}"),
            })
            .collect()
    };
    assert!(smooth.calls.len() > 20);
    assert_eq!(spans(&smooth.calls), spans(&plain.calls));
}

/// Levels of light beyond 256 count as 256.
#[test]
fn a_light_level_of_256_is_full_light() {
    for level in [256, 257, u16::MAX] {
        let colour = Rgb888::new(9, 8, 7);
        assert_eq!(Gouraud::lit(colour, [level; 3]), Gouraud::lit(colour, [256; 3]));
        assert_ne!(Gouraud::lit(colour, [level; 3]), Gouraud::lit(colour, [level, 255, level]));
    }
}
