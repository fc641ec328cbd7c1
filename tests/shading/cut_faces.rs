//! BinnedFaces that the near plane cuts: colours are linear on the screen over each piece, and go over into those of the
//! whole face.

use crate::scene::{
    draw, for_every_colour, gouraud, lit, mesh, random_colour, random_lights, shaded, Colour, Picture, SIZE,
};
use embedded_graphics_core::pixelcolor::Gray8;
use pinhole::clip::{Barycentric, Varying};
use pinhole::{Affine, Camera, Scalar, SpanShader};
use support::bridge::pair::{CameraBits, ProjectionBits, ViewBits, ONE};
use support::oracle::rng::Rng;
use support::oracle::shade::Lit;

/// From the origin along −z, 90 degrees high.
fn camera(near: i32) -> Camera {
    CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, SIZE, near, 100 * ONE),
        viewport: (0, 0, SIZE.0, SIZE.1),
    }
    .library()
}

type V3 = [f64; 3];

/// A corner in space with the levels of its channels.
#[derive(Clone, Debug)]
struct ScreenVertex {
    at: V3,
    levels: Vec<f64>,
}

fn reals(bits: [i32; 3]) -> V3 {
    bits.map(|c| f64::from(c) / 65536.0)
}

/// What is left beyond the near plane, in the order of Sutherland and Hodgman: each edge's cut, then its end.
fn clip(corners: &[ScreenVertex; 3], near: f64) -> Vec<ScreenVertex> {
    let mut left = Vec::new();
    for (from, to) in [(2, 0), (0, 1), (1, 2)] {
        let (a, b) = (&corners[from], &corners[to]);
        let (da, db) = (-a.at[2] - near, -b.at[2] - near);
        if (da < 0.0) != (db < 0.0) {
            let t = da / (da - db);
            let mix = |p: f64, q: f64| p + (q - p) * t;
            left.push(ScreenVertex {
                at: [0, 1, 2].map(|i| mix(a.at[i], b.at[i])),
                levels: a.levels.iter().zip(&b.levels).map(|(&p, &q)| mix(p, q)).collect(),
            });
        }
        if db >= 0.0 {
            left.push(b.clone());
        }
    }
    left
}

fn screen(p: V3) -> (f64, f64) {
    let focal = f64::from(SIZE.1) / 2.0; // 90 degrees
    (f64::from(SIZE.0) / 2.0 - focal * p[0] / p[2], f64::from(SIZE.1) / 2.0 + focal * p[1] / p[2])
}

fn cross(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> f64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

/// How far a pixel's centre lies inside a triangle, in pixels.
fn inside(t: [(f64, f64); 3], p: (f64, f64)) -> f64 {
    let side = cross(t[0], t[1], t[2]).signum();
    let from = |a: (f64, f64), b: (f64, f64)| side * cross(a, b, p) / (b.0 - a.0).hypot(b.1 - a.1);
    from(t[0], t[1]).min(from(t[1], t[2])).min(from(t[2], t[0]))
}

/// Every pixel inside one piece has the colour of that piece's plane, but for what the snap explains, and `more` of a channel.
fn check<C: Colour, I: SpanShader<C>>(
    bits: [[i32; 3]; 3],
    ink: impl Fn([Lit; 3]) -> I,
    colours: [Lit; 3],
    more: impl Fn(usize) -> f64,
    seen: &mut usize,
) {
    let corners = [0, 1, 2].map(|i| ScreenVertex {
        at: reals(bits[i]),
        levels: C::DEPTHS.levels(colours[i]).iter().map(|&(n, d)| n as f64 / d as f64).collect(),
    });
    let mut polygon = clip(&corners, 1.0);
    // Seen from behind it is taken the other way round; y points downwards.
    let places: Vec<_> = polygon.iter().map(|corner| screen(corner.at)).collect();
    if (2..places.len()).map(|k| cross(places[0], places[k - 1], places[k])).sum::<f64>() > 0.0 {
        polygon.reverse();
    }
    let vertices = bits.map(|v| v.map(Scalar::from_bits));
    let mesh = mesh(&vertices);
    let picture = draw::<C, _>(&camera(ONE).place(&mesh, &Affine::identity()), ink(colours));
    for k in 2..polygon.len() {
        let piece = [&polygon[0], &polygon[k - 1], &polygon[k]];
        let t = piece.map(|corner| screen(corner.at));
        let area = cross(t[0], t[1], t[2]);
        for (p, colour) in picture.drawn() {
            let at = (f64::from(p.x) + 0.5, f64::from(p.y) + 0.5);
            if inside(t, at) < 1.0 / 64.0 {
                continue;
            }
            *seen += 1;
            for (channel, level) in colour.levels().into_iter().enumerate() {
                let of = |i: usize| piece[i].levels[channel];
                let weights = [cross(at, t[1], t[2]), cross(t[0], at, t[2]), cross(t[0], t[1], at)];
                let exact = (weights[0] * of(0) + weights[1] * of(1) + weights[2] * of(2)) / area;
                // A corner that moves by d moves the plane by its slope times d: three corners, 1/256 px each.
                let slope = |x: bool| {
                    let c = |i: usize| if x { t[i].1 } else { t[i].0 };
                    let (u, v) = (c(1) - c(0), c(2) - c(0));
                    ((of(1) - of(0)) * v - (of(2) - of(0)) * u) / area
                };
                let snap = 3.0 / 256.0 * slope(true).hypot(slope(false));
                let error = (level as f64 - exact).abs();
                // ½, the plane's share and that of the cut corners' rounding.
                assert!(
                    error <= 0.5 + 1.0 / 512.0 + 1.0 / 512.0 + more(channel) + snap,
                    "{error}, snap {snap}: {bits:?} {colours:?} {p:?}"
                );
            }
        }
    }
}

fn random_face(rng: &mut Rng) -> [[i32; 3]; 3] {
    let mut corner = |behind: bool| {
        let z = if behind { rng.int(-ONE as i64 + 1, 4 << 16) } else { -rng.int(ONE.into(), 8 << 16) };
        [rng.int(-5 << 16, 5 << 16) as i32, rng.int(-5 << 16, 5 << 16) as i32, z as i32]
    };
    let mut face = [corner(false), corner(true), corner(false)];
    if rng.one_in(3) {
        face[0][2] = rng.int(-ONE as i64 + 1, 2 << 16) as i32;
    }
    face.rotate_left(rng.below(3));
    face
}

fn random<C: Colour>(cases: usize) {
    let (mut rng, mut seen) = (Rng::new(0x90), 0);
    for _ in 0..cases {
        check::<C, _>(
            random_face(&mut rng),
            gouraud,
            [0; 3].map(|_| random_colour(&mut rng)),
            |_| 0.0,
            &mut seen,
        );
        check::<C, _>(random_face(&mut rng), lit, random_lights(&mut rng), |_| 0.0, &mut seen);
        // Light is rounded too.
        let half_an_entry = |channel: usize| C::DEPTHS.0[channel] as f64 / 510.0;
        check::<C, _>(random_face(&mut rng), shaded, random_lights(&mut rng), half_an_entry, &mut seen);
    }
    assert!(seen > 100 * cases, "{seen} pixels");
}

#[test]
fn pieces_are_linear_between_the_colours_of_the_cut() {
    for_every_colour!(random(300));
}

/// As a corner passes the near plane, no colour jumps: from one unit of 2⁻¹⁶ before it to one behind it, pixels change
/// by no more than what the corner's own way on the screen explains.
#[test]
fn colours_do_not_jump_at_the_near_plane() {
    let mut rng = Rng::new(0x91);
    let (mut worst, mut seen, mut faces) = (0, 0, 0);
    for _ in 0..2000 {
        let mut face = random_face(&mut rng);
        for corner in &mut face {
            corner[2] = corner[2].min(-ONE);
        }
        let passes = rng.below(3);
        let colours = [0; 3].map(|_| random_colour(&mut rng));
        let picture = |z: i32| -> Picture<Gray8> {
            let mut face = face;
            face[passes][2] = z;
            let vertices = face.map(|v| v.map(Scalar::from_bits));
            let mesh = mesh(&vertices);
            draw(&camera(ONE).place(&mesh, &Affine::identity()), gouraud(colours))
        };
        let (before, behind) = (picture(-ONE), picture(1 - ONE));
        // Slivers change by their own snapping.
        if before.drawn().count() < 100 {
            continue;
        }
        faces += 1;
        for (p, colour) in before.drawn() {
            let Some(other) = behind.at(p) else { continue };
            seen += 1;
            worst = worst.max((colour.levels()[0] - other.levels()[0]).abs());
        }
    }
    println!("{faces} faces, {seen} pixels: {worst} levels of 255");
    assert!(faces > 500 && worst <= 2, "{faces} faces, {seen} pixels: {worst}");
}

/// Weights after six cuts against those in f64: the first two are off by half a unit for each cut, the third by a unit.
#[test]
fn weights_are_one_in_all_and_those_of_the_point() {
    let mut rng = Rng::new(0x94);
    let mut largest = [0f64; 2];
    for _ in 0..50_000 {
        let whole = [0, 1, 2].map(|corner| [0, 1, 2].map(|i| f64::from(u8::from(i == corner))));
        let mut points: Vec<(Barycentric, V3)> = (0..3).map(|i| (Barycentric::of(i), whole[i])).collect();
        for cut in 1..=6 {
            let [(a, p), (b, q)] = [0; 2].map(|_| points[rng.below(points.len())]);
            let t = match rng.below(4) {
                0 => rng.int(0, 9),
                1 => (1 << 31) - rng.int(1, 9),
                _ => rng.int(0, (1 << 31) - 1),
            };
            let exact: V3 = core::array::from_fn(|i| p[i] + (q[i] - p[i]) * t as f64 / f64::from(1u32 << 31));
            let weights = a.towards(&b, t).weights();
            assert_eq!(weights.iter().sum::<i32>(), 1 << 30);
            assert!(weights.iter().all(|w| (-6..=(1 << 30) + 6).contains(w)), "{weights:?}");
            for (i, (weight, exact)) in weights.into_iter().zip(exact).enumerate() {
                let off = (f64::from(weight) - exact * f64::from(1 << 30)).abs() / f64::from(cut);
                largest[i / 2] = largest[i / 2].max(off);
            }
            points.push((a.towards(&b, t), exact));
        }
    }
    println!("off by {largest:?} for each cut");
    assert!(largest[0] <= 0.501 && largest[1] <= 1.001, "{largest:?}");
    assert!(largest[0] > 0.4 && largest[1] > 0.6, "{largest:?}");
}
