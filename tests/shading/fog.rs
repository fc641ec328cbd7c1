//! Fog: the level of each pixel against distances in f64 along the pixel's ray, and fogged shaders against the shader alone, mixed
//! by that level.

use crate::rays::{
    camera, everywhere, floor, in_memory, mixed, usual, Faces, Tiles, AREA, FOV, SIDE, SKY, WALL,
};
use embedded_graphics::pixelcolor::{Gray8, GrayColor, Rgb888, RgbColor};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::PointsIter;
use pinhole::space::{Model, World};
use pinhole::{
    camera::Window,
    color::{Alpha, Half},
    fog::{Fog, FogTable, VertexFog},
    light::LightError,
    prelude::*,
    shading::{Dithered, SpanShader, Translucent},
    sprite::SolidTexel,
    texture::{ColorKeyed, Texels},
    Angle,
};
use support::bridge::ways::{by_every_call, memory, memory_with, Drawn};
use support::oracle::chain::{self, dot, M4, V3};
use support::oracle::rng::Rng;

fn number(v: f64) -> Scalar {
    Scalar::try_from(v).expect("in range")
}

/// A view volume, in f64, of 240 × 240 pixels: in perspective with 60 degrees, or parallel with a window of ±`half`.
#[derive(Clone, Copy, Debug)]
struct Lens {
    near: f64,
    far: f64,
    parallel: Option<f64>,
}

impl Lens {
    fn projection(&self) -> Projection {
        let [near, far] = [self.near, self.far].map(number);
        match self.parallel.map(number) {
            None => Projection::perspective(Angle::degrees(60), Size::new(SIDE, SIDE), near, far).unwrap(),
            Some(half) => {
                let window = Window { left: -half, right: half, bottom: -half, top: half };
                Projection::orthographic(window, near, far).unwrap()
            }
        }
    }

    /// The depth of points at this distance, in steps.
    fn depth(&self, distance: f64) -> f64 {
        let Self { near, far, parallel } = *self;
        match parallel {
            None => 65_535.0 * far / (far - near) * (1.0 - near / distance),
            Some(_) => 65_535.0 * (distance - near) / (far - near),
        }
    }

    /// The depth of points at this distance; at the eye and behind it less than any.
    fn bound(&self, distance: f64) -> f64 {
        match self.parallel.is_none() && distance <= 0.0 {
            true => f64::MIN,
            false => self.depth(distance),
        }
    }

    fn matrix(&self) -> M4 {
        match self.parallel {
            None => chain::perspective(FOV, SIDE, SIDE, self.near, self.far),
            Some(half) => chain::orthographic(-half, half, -half, half, self.near, self.far),
        }
    }

    /// Where a corner is seen, in pixels.
    fn seen(&self, [x, y, z]: V3) -> [f64; 2] {
        let scale = self.parallel.unwrap_or_else(|| -z * 30f64.to_radians().tan());
        [x / scale, y / scale].map(|c| c * f64::from(SIDE) / 2.0)
    }
}

/// White in black fog in 7/255 steps: a colour for each level; nothing else draws white.
const LEVEL: u8 = 7;
const NOTHING: Gray8 = Gray8::WHITE;

/// A sprite has the level of its point, within a step of depth, by every draw call; a transparent texel is left out in fog, and a
/// translucent one is mixed after fog.
#[test]
fn sprites_have_the_level_of_their_points() {
    let mut rng = Rng::new(57);
    let cases = [
        (Lens { near: 1.0, far: 100.0, parallel: None }, [4.0, 40.0]),
        (Lens { near: 0.25, far: 500.0, parallel: None }, [1.0, 9.0]),
        (Lens { near: 1.0, far: 50.0, parallel: Some(8.0) }, [3.0, 30.0]),
    ];
    for (lens, range) in cases {
        let camera = camera(&lens.projection());
        let fog = Fog::new(number(range[0]), number(range[1])).unwrap();
        let table = FogTable::new(&fog, &camera, Gray8::BLACK).unwrap();
        // The depth at which a level begins.
        let begin = |level: f64| lens.bound(range[0] + (range[1] - range[0]) * (level - 0.5) / 32.0);
        let mut counts = [0; 33];
        for case in 0..2000 {
            let bits = rng.int((lens.near * 65536.0) as i64 + 9, (1.3 * range[1] * 65536.0) as i64);
            let at = Point3::new(Scalar::ZERO, Scalar::ZERO, Scalar::from_bits(-bits as i32));
            let placed = camera.place_sprite(at);
            let color = Gray8::new(32 * LEVEL);
            let texels = [[color, color, color, color, NOTHING, NOTHING, NOTHING, NOTHING]; 8];
            let (mut pixels, mut depths) = (vec![Gray8::new(99); 240 * 240], vec![0; 240 * 240]);
            let mut picture = Picture::new(&mut pixels, Size::new(SIDE, SIDE)).unwrap();
            let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths).unwrap();
            let solid = |_| Sprite::new(Fogged::new(SolidTexel::new(color), &table)).magnified(4);
            let keyed = |_| Sprite::new(Fogged::new(ColorKeyed::new(&texels, NOTHING), &table));
            let inside = |_| {
                Sprite::new(Translucent::new(Fogged::new(SolidTexel::new(color), &table), Alpha::new(8)))
                    .magnified(2)
            };
            let outside = |_| {
                Sprite::new(Fogged::new(Translucent::new(SolidTexel::new(color), Alpha::new(8)), &table))
                    .magnified(2)
            };
            let is_blended = case % 6 > 3;
            let Ok(_) = match case % 6 {
                0 => placed.draw(solid, &mut picture),
                1 => placed.draw(keyed, &mut picture.pixels()),
                2 => placed.draw(solid, &mut picture.pixels().depth_tested(&mut depth)),
                3 => placed.draw(keyed, &mut picture.depth_tested(&mut depth)),
                4 => placed.draw(inside, &mut picture.pixels()),
                _ => placed.draw(outside, &mut picture.pixels().depth_tested(&mut depth)),
            };
            let shown = pixels[119 * 240 + 119].luma();
            // A quarter of the sprite's own colour, rounded to nearest.
            let level = match is_blended {
                false => 32 - shown / LEVEL,
                true => (0..=32)
                    .find(|l| (u32::from((32 - l) * LEVEL) * 8 + 99 * 24 + 16) / 32 == u32::from(shown))
                    .unwrap(),
            };
            let depth = lens.depth(bits as f64 / 65536.0);
            let [from, to] = [0.0, 1.0].map(|next| begin(f64::from(level) + next));
            assert!(level == 0 || from <= depth + 1.0, "{lens:?}, {depth}: {level}");
            assert!(level == 32 || depth - 1.0 <= to, "{lens:?}, {depth}: {level}");
            counts[usize::from(level)] += 1;
            if !is_blended {
                assert_eq!(shown, (32 - level) * LEVEL);
            }
            // The right half of the keyed picture.
            if case % 6 == 1 || case % 6 == 3 {
                assert_eq!(pixels[119 * 240 + 121], Gray8::new(99));
            }
        }
        assert!(counts.iter().all(|&count| count > 10), "{counts:?}");
    }
}

/// The largest distance, in steps of depth, between the depth at a pixel's ray within 1/256 pixel and the depths that have the
/// pixel's level: of triangles within 512 pixels, and of larger ones. And the pixels that have each level.
fn worst(lens: &Lens, fog: [f64; 2], scene: &Faces) -> ([f64; 2], [usize; 33]) {
    let camera = camera(&lens.projection());
    let table = Fog::new(number(fog[0]), number(fog[1])).unwrap();
    let table = FogTable::new(&table, &camera, Gray8::BLACK).unwrap();
    let (mut worst, mut counts) = ([0.0; 2], [0; 33]);
    for face in 0..scene.uv.len() {
        let (corners, ray) = (scene.corners(face), scene.distances(face, &lens.matrix()));
        let seen = corners.map(|corner| lens.seen(corner));
        let extent = |axis: usize| {
            let c = seen.map(|p| p[axis]);
            c.into_iter().fold(f64::MIN, f64::max) - c.into_iter().fold(f64::MAX, f64::min)
        };
        let is_cut = corners.iter().any(|c| -c[2] < lens.near || -c[2] > lens.far);
        let is_large = usize::from(is_cut || extent(0).max(extent(1)) >= 511.0);
        let shade: &dyn Fn(usize) -> _ = &|_| Fogged::new(Gray8::new(32 * LEVEL), &table);
        let pixels = memory(AREA, NOTHING, &mut |target, _| {
            scene.alone(face).place(&camera, &mut |instance| {
                let Ok(_) = instance.faces(shade).draw(target);
            });
        });
        for (Point { x, y }, pixel) in AREA.points().zip(pixels).filter(|(_, pixel)| *pixel != NOTHING) {
            let level = 32 - pixel.luma() / LEVEL;
            counts[usize::from(level)] += 1;
            let around = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)].map(|(dx, dy)| {
                let [distance, _] =
                    ray.0.at(f64::from(x) + 0.5 + dx / 256.0, f64::from(y) + 0.5 + dy / 256.0)?;
                Some(lens.depth(distance))
            });
            let [Some(a), Some(b), Some(c), Some(d)] = around else {
                panic!("({x}, {y}) lies beside the plane")
            };
            let (low, high) = (a.min(b).min(c).min(d), a.max(b).max(c).max(d));
            let bound = |half: f64| lens.bound(fog[0] + (fog[1] - fog[0]) * (f64::from(level) + half) / 32.0);
            let before = if level == 0 { 0.0 } else { bound(-0.5) - high };
            let beyond = if level == 32 { 0.0 } else { low - bound(0.5) };
            worst[is_large] = f64::max(worst[is_large], before.max(beyond));
        }
    }
    (worst, counts)
}

/// Triangles that hardly tilt, of up to `size` of the picture's side, from 250 to 900 before the eye.
fn facing(seed: u64, count: u16, size: f64) -> Faces {
    let (mut rng, mut scene) = (Rng::new(seed), Faces::new(-5));
    for _ in 0..count {
        let distance = rng.real(250.0, 900.0);
        let half = distance * 30f64.to_radians().tan();
        let centre = [0; 2].map(|_| rng.real(-half, half));
        let corners = [(); 3].map(|()| {
            let [x, y] = centre.map(|c| c + rng.real(-half, half) * size);
            let z = -distance * (1.0 + rng.real(-0.1, 0.1));
            [x, y, z].map(|c| (c * 32.0).clamp(-32_767.0, 32_767.0) as i16)
        });
        scene.push(corners, [[0; 2]; 3]);
    }
    scene
}

/// Triangles that hardly tilt and reach up to 8000 pixels from the picture, before a parallel lens of ±100.
fn vast(seed: u64, count: u16) -> Faces {
    let (mut rng, mut scene) = (Rng::new(seed), Faces::new(-2));
    for _ in 0..count {
        let [distance, tilt] = [rng.real(300.0, 800.0), rng.log(20.0, 2000.0)];
        let away = rng.real(0.0, 360.0).to_radians();
        let corners = [0.0, 2.1, 4.2].map(|turn| {
            let (reach, angle): (f64, f64) = (rng.real(1000.0, 6600.0), away + turn + rng.real(-0.5, 0.5));
            let z = -(distance + rng.real(-tilt, tilt));
            [reach * angle.cos(), reach * angle.sin(), z.min(-10.0)].map(|c| (c * 4.0) as i16)
        });
        scene.push(corners, [[0; 2]; 3]);
    }
    scene
}

/// The exceptions that `Fogged` states: triangles larger than 512 pixels, and the last step before the far plane, where depth ends at
/// 65534.46.
#[test]
fn levels_of_large_triangles_and_before_the_far_plane_are_within_their_bounds() {
    let lens = Lens { near: 1.0, far: 4000.0, parallel: Some(100.0) };
    let ([_, large], counts) = worst(&lens, [250.0, 900.0], &vast(9, 400));
    assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
    assert!(large < 1.0 / 64.0, "{large}");
    // A slope through the far plane, of a few steps of depth over the picture, in fog that is full there.
    let lens = Lens { near: 1.0, far: 250.0, parallel: Some(100.0) };
    let mut most = 0.0_f64;
    for (steps, [low, high]) in [
        (9.0, [249.953125, 250.015625]),
        (16.0, [249.953125, 250.015625]),
        (32.0, [249.8, 250.1]),
        (64.0, [249.96875, 250.0078125]),
    ] {
        let corner = |x: f64, y: f64, z: f64| [x, y, -z];
        let slope = [
            corner(-100.0, -100.0, low),
            corner(100.0, -100.0, low),
            corner(100.0, 100.0, high),
            corner(-100.0, 100.0, high),
        ];
        let start = 250.0 - steps * 249.0 / 65_535.0;
        let ([_, worst], counts) = worst(&lens, [start, 250.0], &Faces::quad(slope, 0.0, 1, -7));
        assert!(counts.iter().filter(|&&count| count > 0).count() > 3, "{counts:?}");
        most = most.max(worst);
    }
    assert!(most < 0.54 && most > 0.27, "{most}");
}

#[test]
fn levels_are_those_of_rays_within_a_fraction_of_a_step_of_depth() {
    let perspective = |near, far| Lens { near, far, parallel: None };
    let parallel = |near, far, half| Lens { near, far, parallel: Some(half) };
    let quad = |corners, roll, exponent| Faces::quad(corners, roll, 1, exponent);
    let soup = |seed, reach| Faces::soup(&mut Rng::new(seed), 240, reach, 3000, |_| 0);
    let cases = [
        ("floor", perspective(1.0, 100.0), [3.0, 60.0], quad(floor(0.5, 90.0, 60.0), 12.0, -8)),
        ("rolled floor", perspective(1.0, 100.0), [1.0, 9.0], quad(floor(0.5, 9.5, 6.0), 25.0, -10)),
        ("a thousand times", perspective(0.25, 250.0), [2.0, 99.0], quad(floor(0.5, 240.0, 99.0), 20.0, -7)),
        ("wall", perspective(1.0, 2000.0), [-5.0, 40.0], quad(WALL, 30.0, -4)),
        ("beyond near and far", perspective(2.0, 20.0), [1.0, 40.0], quad(floor(0.5, 90.0, 60.0), 5.0, -8)),
        ("small triangles", perspective(1.0, 100.0), [2.0, 40.0], soup(1, 300)),
        ("large triangles", perspective(1.0, 1000.0), [2.0, 30.0], soup(2, 2000)),
        ("few steps", perspective(0.125, 1000.0), [20.0, 45.0], soup(3, 600)),
        ("facing", perspective(0.125, 8000.0), [200.0, 950.0], facing(6, 3000, 0.1)),
        ("facing, of all sizes", perspective(0.125, 8000.0), [200.0, 950.0], facing(7, 300, 1.9)),
        ("facing, parallel", parallel(1.0, 30_000.0, 100.0), [250.0, 900.0], facing(8, 1000, 0.03)),
        ("parallel", parallel(-1.0, 50.0, 12.0), [-0.5, 44.0], soup(4, 600)),
        ("parallel, far", parallel(1.0, 1000.0, 6.0), [3.0, 12.0], soup(5, 300)),
    ];
    let mut most = [0.0; 2];
    for (name, lens, fog, scene) in cases {
        let (worst, counts) = worst(&lens, fog, &scene);
        for (most, worst) in most.iter_mut().zip(worst) {
            *most = f64::max(*most, worst);
        }
        // Every level between the nearest and the farthest one is used.
        let used = counts.iter().filter(|&&count| count > 0).count();
        let between =
            counts.iter().rposition(|&c| c > 0).unwrap() - counts.iter().position(|&c| c > 0).unwrap();
        assert!(used == between + 1 && used > 15, "{name}: {counts:?}");
    }
    // The bound of `Fogged`, at most twice the largest error. Large triangles show none beyond the 1/256 pixel.
    assert!(most[0] < 1.0 / 64.0 && most[0] > 1.0 / 128.0 && most[1] < 1.0 / 64.0, "{most:?}");
}

/// `FogTable::factor` at every depth, against the distances half-way between two factors.
#[test]
fn factors_are_the_nearest_at_every_depth() {
    let cases = [
        (Lens { near: 1.0, far: 100.0, parallel: None }, [4.0, 50.0]),
        (Lens { near: 0.125, far: 125.0, parallel: None }, [0.5, 125.0]),
        (Lens { near: 5.0, far: 9.0, parallel: None }, [1.0, 30.0]),
        (Lens { near: -4.0, far: 9.0, parallel: Some(3.0) }, [-3.5, 8.0]),
        (Lens { near: 1.0, far: 30_000.0, parallel: None }, [0.25, 30_000.0]),
    ];
    // The part of the way from start to end at which this part of a colour is left.
    type Profile = fn(f64) -> f64;
    let profiles: [Profile; 3] = [|left| 1.0 - left, |left| -left.log(64.0), |left| (-left.log(64.0)).sqrt()];
    for (case, (lens, fog)) in cases.into_iter().flat_map(|case| [(0, case), (1, case), (2, case)]) {
        let camera = camera(&lens.projection());
        let [start, end] = fog.map(number);
        let table = match case {
            0 => FogTable::new(&Fog::new(start, end).unwrap(), &camera, Gray8::BLACK),
            1 => FogTable::exponential(&Fog::new(start, end).unwrap(), &camera, Gray8::BLACK),
            _ => FogTable::squared(&Fog::new(start, end).unwrap(), &camera, Gray8::BLACK),
        }
        .unwrap();
        let bounds = core::array::from_fn::<f64, 32, _>(|i| {
            let share = profiles[case](1.0 - (i as f64 + 0.5) / 32.0);
            lens.bound(fog[0] + (fog[1] - fog[0]) * share)
        });
        let (mut ties, mut last) = (0, 32);
        for depth in 0..65_535 {
            let factor = table.factor(depth);
            let at =
                |error: f64| 32 - bounds.iter().filter(|&&bound| bound <= f64::from(depth) + error).count();
            // The camera's rows are within 2⁻³⁰ of the lens, a bound within 2⁻¹⁶ of a step.
            let [low, high] = [at(1.0 / 2048.0), at(-1.0 / 2048.0)];
            assert!(
                (low..=high).contains(&usize::from(factor)),
                "{lens:?} {depth}: {factor}, {low} to {high}"
            );
            assert!(factor <= last);
            (ties, last) = (ties + usize::from(low != high), factor);
        }
        assert!(ties < 4, "{lens:?}: {ties}");
    }
}

#[test]
fn set_ups_that_cannot_be_are_refused() {
    let fog = |start, end| Fog::new(number(start), number(end));
    assert_eq!(fog(2.0, 2.0), Err(LightError::EmptyFog { start: number(2.0), end: number(2.0) }));
    let table = |lens: &Lens, start, end| {
        FogTable::new(&fog(start, end).unwrap(), &camera(&lens.projection()), Gray8::BLACK)
    };
    let lens = Lens { near: 0.0625, far: 1000.0, parallel: None };
    // 65535/16 · (1/500 − 1/1000) is 4.09.
    let error = table(&lens, 500.0, 1000.0).unwrap_err();
    assert_eq!(error, LightError::TooFewFogSteps { steps: 4 });
    assert_eq!(
        error.to_string(),
        "the fog spans 4 of 65535 steps of depth, but needs 8: move the near plane away from the eye, or the fog's start and end apart"
    );
    assert!(table(&lens, 300.0, 1000.0).is_ok()); // 9.6

    // Nothing but fog, and no fog at all.
    let all = table(&lens, -3.0, 0.0).unwrap();
    assert_eq!([0, 65_534].map(|depth| all.factor(depth)), [0; 2]);
    let none = table(&lens, 1001.0, 2000.0).unwrap();
    assert_eq!([0, 65_534].map(|depth| none.factor(depth)), [32; 2]);
    // Depth that changes with x.
    let mut matrix =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.25, 0.0, -1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let slanted = |matrix: &[[f64; 4]; 4]| {
        FogTable::new(
            &fog(0.0, 1.0).unwrap(),
            &camera(&Projection::from_matrix(matrix).unwrap()),
            Gray8::BLACK,
        )
    };
    assert_eq!(slanted(&matrix), Err(LightError::SlantedDepth));
    matrix[2][0] = 0.0;
    assert!(slanted(&matrix).is_ok());
}

/// Factors of vertices and faces, for turned, stretched and distant objects, against f64.
#[test]
fn factors_of_vertices_are_linear_in_distance() {
    let mut rng = Rng::new(7);
    let (mut worst, mut counts) = (0.0_f64, [0; 3]);
    for case in 0..3_000 {
        let reach = [20.0, 3000.0, 0.5][case % 3];
        let mut vector = |size: f64| [0; 3].map(|_| number(rng.real(-size, size)));
        let f64s = |v: [Scalar; 3]| v.map(f64::from);
        let [axes @ .., origin, eye, ahead] = [
            vector(2.0),
            vector(2.0),
            vector([2.0, 0.1][case % 2]),
            vector(reach),
            vector(reach),
            vector(1.0),
        ];
        let direction = f64s(ahead);
        let length = dot(direction, direction).sqrt();
        if length < 0.1 {
            continue;
        }
        let vector3 = |[x, y, z]: [Scalar; 3]| Vector3::new(x, y, z);
        let point = |[x, y, z]: [Scalar; 3]| Point3::<World>::new(x, y, z);
        let [x, y, z] = axes;
        let model = Affine::<Model, World>::from_frame(vector3(x), vector3(y), vector3(z), point(origin));
        let up = if direction[1].abs() < 0.9 * length { [0, 1, 0] } else { [1, 0, 0] };
        let up = Vector3::from_ints(up[0], up[1], up[2]);
        let view = ViewTransform::from_reference(point(eye), -vector3(ahead), up).unwrap();
        let viewport = Viewport::new(Point::zero(), Size::new(SIDE, SIDE)).unwrap();
        let lens = Lens { near: 1.0, far: 100.0, parallel: None };
        let camera = Camera::new(&view, &lens.projection(), &viewport);
        let exponent = -(rng.below(12) as i8);
        let vertices: Vec<[i16; 3]> =
            (0..20).map(|_| [0; 3].map(|_| rng.int(-32_768, 32_767) as i16)).collect();
        let distance = |v: V3| {
            let local = v.map(|c| c * 2f64.powi(exponent.into()));
            let world = [0, 1, 2].map(|i| {
                f64s(origin)[i] + (0..3).map(|k| f64s(axes[k])[i] * local[k]).sum::<f64>() - f64s(eye)[i]
            });
            dot(world, direction) / length
        };
        // About the distance of a vertex.
        let middle = distance(vertices[0].map(f64::from));
        let extent = reach * rng.log(0.05, 4.0);
        if middle.abs() + extent > 32_000.0 {
            continue;
        }
        let [start, end] = [middle - extent * rng.unit(), middle + extent].map(number);
        if start >= end {
            continue;
        }
        let fog = Fog::new(start, end).unwrap();
        let fog = VertexFog::new(&fog, &camera, &model, exponent);
        let [start, end] = [start, end].map(f64::from);
        let exact = |v: V3| (256.0 * (end - distance(v)) / (end - start)).clamp(0.0, 256.0);
        for vertex in &vertices {
            let factor = fog.factor(*vertex);
            // Beyond the half of rounding, in the unit of the bound.
            let off = (f64::from(factor) - exact(vertex.map(f64::from))).abs() - 0.5;
            let size = vertex.map(|c| f64::from(c).abs()).into_iter().fold(0.0, f64::max)
                * 2f64.powi(exponent.into());
            let unit = 256.0 * (reach + 2.0 * size) / (end - start);
            worst = worst.max(off / unit);
            counts[usize::from(factor > 0) + usize::from(factor == 256)] += 1;
        }
    }
    let bound = 1.5 * 2f64.powi(-30);
    assert!(worst < bound && worst > bound / 2.0, "{}", worst * 2f64.powi(30));
    assert!(counts.iter().all(|&count| count > 1_000), "{counts:?}");
}

/// Flat colours in fog, in 1/256 of a level: a light of 256 keeps them. Tables are compared in `tables`.
#[test]
fn colors_in_fog_are_the_nearest() {
    let mut rng = Rng::new(9);
    for _ in 0..40 {
        let [own, fog] = [(); 2].map(|()| [(); 3].map(|()| rng.bits() as u8));
        let [own_color, fog_color] = [own, fog].map(|[r, g, b]| Rgb888::new(r, g, b));
        for factor in [0, 1, 100, 255, 256, 999] {
            let color = Flat::from(own_color).in_fog(fog_color, factor);
            let seen = SpanShader::<Rgb888>::solid(&color).unwrap();
            let share = f64::from(factor.min(256)) / 256.0;
            for (level, (own, fog)) in
                [seen.r(), seen.g(), seen.b()].into_iter().zip(own.into_iter().zip(fog))
            {
                let off = f64::from(level) - f64::from(own) * share - f64::from(fog) * (1.0 - share);
                assert!(off.abs() <= 0.5 + 1e-9, "{own:?} {fog:?} {share}: {seen:?}");
            }
        }
    }
}

const FOG: Rgb888 = Rgb888::new(200, 90, 30);

fn table(color: Rgb888) -> FogTable<Rgb888> {
    let fog = Fog::new(Scalar::from_int(2), Scalar::from_int(30)).unwrap();
    FogTable::new(&fog, &usual(), color).unwrap()
}

fn soup(seed: u64, reach: i64) -> Faces {
    Faces::soup(&mut Rng::new(seed), 120, reach, 3000, |rng| rng.int(-480, 480) as i16)
}

/// A plain colour in fog of another one shows the factor of each pixel: by the order of drawing, of the face that is seen there.
fn factors(scene: &Faces) -> Drawn<Rgb888> {
    let black = table(Rgb888::BLACK);
    everywhere(scene, &|_| Fogged::new(Rgb888::new(0, 0, 32 * LEVEL), &black))
}

/// The picture with depth, and the depths.
fn deep<S: SpanShader<Rgb888>>(scene: &Faces, shade: &dyn Fn(usize) -> S) -> (Vec<Rgb888>, Vec<u16>) {
    memory_with(AREA, AREA, SKY, &mut |target, depth| scene.draw_deep(shade, target, depth))
}

/// Pixels in fog are those of the shader alone, mixed by the factors. Returns the number of pixels of each factor.
fn compare(fogged: &[Rgb888], alone: &[Rgb888], factors: &[Rgb888]) -> [usize; 33] {
    let mut counts = [0; 33];
    for ((&pixel, &own), factor) in fogged.iter().zip(alone).zip(factors) {
        let factor = factor.b() / LEVEL;
        assert_eq!(pixel, if own == SKY { SKY } else { mixed(own, FOG, factor) });
        counts[usize::from(factor)] += usize::from(own != SKY);
    }
    counts
}

/// A shader in fog shows what the shader shows alone, mixed by the factor at the pixel.
fn check<S: SpanShader<Rgb888>>(scene: &Faces, factors: &Drawn<Rgb888>, shade: &dyn Fn(usize) -> S) {
    let fog = table(FOG);
    let (fogged, alone) = (deep(scene, &|face| Fogged::new(shade(face), &fog)), deep(scene, shade));
    assert!(fogged.1 == alone.1);
    let counts = compare(&fogged.0, &alone.0, &factors.deep);
    let met = counts.iter().filter(|&&count| count > 0).count();
    assert!(counts.iter().sum::<usize>() > 5_000 && met > 25, "{counts:?}");
}

#[test]
fn every_shader_is_mixed_with_the_fog_at_its_pixels() {
    let quad = |corners, roll, exponent| Faces::quad(corners, roll, 60, exponent);
    let colors = |face: usize| {
        [0, 70, 140].map(|more| Rgb888::new(!(face as u8), (2 * face) as u8, (face + more) as u8))
    };
    let shades = ShadeTable::new(Rgb888::YELLOW);
    for scene in &[soup(41, 1500), quad(floor(0.9, 300.0, 200.0), 20.0, -6), quad(WALL, 70.0, -4)] {
        let factors = factors(scene);
        check(scene, &factors, &|face| colors(face)[0]);
        check(scene, &factors, &|face| Dithered(Flat::lit(colors(face)[1], 177)));
        check(scene, &factors, &|face| Gouraud::new(colors(face)));
        check(scene, &factors, &|face| Dithered(Gouraud::lit(colors(face)[2], [256, 90, 180])));
        check(scene, &factors, &|face| shades.lit([256, 20 + face as u16, 180]));
        check(scene, &factors, &|face| Texture::new(Tiles).at(scene.uv[face]));
        check(scene, &factors, &|face| Texture::new(Tiles).clamped_at(scene.uv[face]));
        check(scene, &factors, &|face| Texture::new(Tiles).at(scene.uv[face]).lit([256, 90, 180]));
    }
}

/// Keyed texels and screen doors leave out the pixels that they leave out without fog, whichever wraps the other.
#[test]
fn fogged_faces_may_leave_out_pixels() {
    let fog = table(FOG);
    for scene in [soup(42, 1200), Faces::quad(floor(0.9, 300.0, 200.0), 20.0, 60, -6)] {
        let texture = Texture::new(ColorKeyed::new(Tiles, Tiles.texel(3 << 29, 5 << 29)));
        let shade = |face: usize| texture.at(scene.uv[face]);
        for face in 0..scene.uv.len() {
            let alone = scene.alone(face);
            let own = in_memory(&alone, &|_| shade(face));
            let fogged = in_memory(&alone, &|_| Fogged::new(shade(face), &fog));
            assert!(fogged.depths == own.depths);
            compare(&fogged.solid, &own.solid, &factors(&alone).solid);
        }
        let inside = in_memory(&scene, &|face| Fogged::new(ScreenDoor::new(shade(face), 23), &fog));
        let outside = deep(&scene, &|face| ScreenDoor::new(Fogged::new(shade(face), &fog), 23));
        assert!((&inside.deep, &inside.depths) == (&outside.0, &outside.1));
        assert!(inside.solid.iter().filter(|&&pixel| pixel != SKY).count() > 500);
        let inside =
            in_memory(&scene, &|face| Fogged::new(Translucent::new(shade(face), Alpha::new(11)), &fog));
        let outside = deep(&scene, &|face| Translucent::new(Fogged::new(shade(face), &fog), Alpha::new(11)));
        assert!((&inside.deep, &inside.depths) == (&outside.0, &outside.1));
        let half = deep(&scene, &|face| Translucent::new(Fogged::new(shade(face), &fog), Half));
        assert!(half.0 != inside.deep);
    }
}

/// Faces that planes cut, from a painter and from bins.
#[test]
fn fogged_faces_are_equal_by_every_draw_call() {
    let (scene, fog) = (soup(43, 600), table(FOG));
    let shade = |face: usize| {
        Fogged::new(Gouraud::new([Rgb888::RED, Rgb888::GREEN, Rgb888::new(0, 0, face as u8)]), &fog)
    };
    let textured = |face: usize| Fogged::new(Texture::new(Tiles).at(scene.uv[face]), &fog);
    scene.place(&usual(), &mut |instance| {
        let (drawn, _) = by_every_call(instance, AREA, SKY, &[17, SIDE], &shade);
        assert!(drawn.solid.iter().filter(|&&pixel| pixel != SKY).count() > 5_000);
        by_every_call(instance, AREA, SKY, &[17, SIDE], &textured);
    });
}
