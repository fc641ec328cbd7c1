//! `examples/shader`: shaders made with the public interface alone, each pixel against rays in f64 that share no code with
//! the library.

#[path = "../../examples/shader"]
mod example {
    pub(crate) mod scene;
    pub(crate) mod shaders;
}

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::prelude::Point;
use embedded_graphics::primitives::Rectangle;
use example::scene::{self, BOARD, FOG_COLOR, FOG_RANGE, GLASS, NEAR_FAR, SIZE, SKY, TILES, WALL_COLOR};
use pinhole::raster::{Gradient, Span, Triangle};
use pinhole::shading::{CornerValues, Shader, SpanShader};
use pinhole::space::{Model, World};
use pinhole::{camera::Window, prelude::*, Angle};
use support::bridge::ways::{by_every_call, memory};
use support::oracle::chain::{cross, dot, normalise};

type V = [f64; 3];

fn sub(a: V, b: V) -> V {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// What a ray meets first, and how the colour is made.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Seen {
    Sky,
    Tile(u32),
    Wall,
}

struct Ray {
    seen: Seen,
    /// Whether there is glass in front of it.
    glass: bool,
    color: [f64; 3],
}

/// Where a ray meets a quad: how far along the view direction, and where in the quad's sides.
fn meets(quad: &[[i16; 3]; 4], eye: V, ray: V) -> Option<(f64, [f64; 2])> {
    let [a, b, _, d] = quad.map(|corner| corner.map(f64::from));
    let (u, v) = (sub(b, a), sub(d, a));
    let normal = cross(u, v);
    let towards = dot(normal, ray);
    if towards >= 0.0 {
        return None; // from behind, or along it
    }
    let t = dot(normal, sub(a, eye)) / towards;
    let at = sub([0, 1, 2].map(|i| eye[i] + t * ray[i]), a);
    let uv = [dot(at, u) / dot(u, u), dot(at, v) / dot(v, v)];
    let [near, far] = NEAR_FAR.map(f64::from);
    (t >= near && t <= far && uv.iter().all(|c| (0.0..=1.0).contains(c))).then_some((t, uv))
}

fn channels(c: Rgb888) -> [f64; 3] {
    [c.r(), c.g(), c.b()].map(f64::from)
}

/// The scene at a point of the screen, in pixels.
fn look(x: f64, y: f64) -> Ray {
    let [eye, towards] = [scene::EYE, scene::TOWARDS].map(|p| p.map(f64::from));
    let ahead = normalise(sub(towards, eye));
    let right = normalise(cross(ahead, [0.0, 1.0, 0.0]));
    let up = cross(right, ahead);
    let (width, height) = (f64::from(SIZE.width), f64::from(SIZE.height));
    let scale = (f64::from(scene::FIELD_OF_VIEW).to_radians() / 2.0).tan();
    let [sx, sy] = [(2.0 * x / width - 1.0) * scale * width / height, (1.0 - 2.0 * y / height) * scale];
    let ray = [0, 1, 2].map(|i| ahead[i] + right[i] * sx + up[i] * sy);

    let floor = meets(&scene::FLOOR, eye, ray);
    let wall = meets(&scene::WALL, eye, ray);
    let (mut seen, mut color, mut nearest) = (Seen::Sky, channels(SKY), f64::MAX);
    if let Some((t, uv)) = floor {
        let tile = uv.map(|c| (c * f64::from(TILES)).floor() as u32).iter().sum::<u32>();
        (seen, color, nearest) = (Seen::Tile(tile % 2), channels(BOARD[(tile % 2) as usize]), t);
    }
    if let Some((t, _)) = wall.filter(|(t, _)| *t < nearest) {
        let [near, far] = NEAR_FAR.map(f64::from);
        let depth = 65_535.0 * (far / (far - near) - far * near / ((far - near) * t));
        let [begin, end] = FOG_RANGE.map(f64::from);
        let share = ((depth - begin) / (end - begin)).clamp(0.0, 1.0);
        let (own, fog) = (channels(WALL_COLOR), channels(FOG_COLOR));
        (seen, color, nearest) = (Seen::Wall, [0, 1, 2].map(|i| own[i] + (fog[i] - own[i]) * share), t);
    }
    let glass = meets(&scene::PANE, eye, ray).is_some_and(|(t, _)| t < nearest);
    if glass {
        let own = channels(GLASS);
        color = [0, 1, 2].map(|i| (own[i] + color[i]) / 2.0);
    }
    Ray { seen, glass, color }
}

/// A pixel is compared where the scene is the same 1/64 pixel around its center: vertices lie on 1/256 pixel, and the
/// checkerboard's 1/w and u/w have 24 bits.
#[test]
fn a_checkerboard_a_fog_and_glass_made_outside_the_crate_are_those_of_rays() {
    let pixels = scene::draw().expect("the scene");
    let (mut compared, mut met, mut worst) = (0, [0; 4], 0.0_f64);
    for (i, pixel) in pixels.iter().enumerate() {
        let (x, y) = ((i as u32 % SIZE.width) as f64 + 0.5, (i as u32 / SIZE.width) as f64 + 0.5);
        let ray = look(x, y);
        let around = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        let is_same = |(dx, dy): (f64, f64)| {
            let other = look(x + dx / 64.0, y + dy / 64.0);
            other.seen == ray.seen && other.glass == ray.glass
        };
        if !around.into_iter().all(is_same) {
            continue;
        }
        let error = (0..3).map(|c| (channels(*pixel)[c] - ray.color[c]).abs()).fold(0.0, f64::max);
        // A channel of the fog is rounded to 1/256 of its range downwards, and then to nearest; glass to nearest.
        let bound = match (ray.seen, ray.glass) {
            (Seen::Wall, _) => 1.2,
            (_, true) => 0.5,
            (_, false) => 0.0,
        };
        assert!(error <= bound, "({x}, {y}): {pixel:?}, {:?} {:?}", ray.seen, ray.color);
        if ray.seen == Seen::Wall {
            worst = worst.max(error);
        }
        compared += 1;
        met[match ray.seen {
            Seen::Sky => 0,
            Seen::Tile(_) => 1,
            Seen::Wall => 2,
        }] += 1;
        met[3] += usize::from(ray.glass);
    }
    assert!(compared * 100 > pixels.len() * 97, "{compared} of {}", pixels.len());
    assert!(met.iter().all(|&count| count > 3_000), "{met:?}");
    assert!(worst > 0.6, "{worst}");
}

/// Stripes by the depths that are stored.
#[derive(Clone, Copy)]
struct Contours([i32; 3]);

/// The first depth of a level, in steps. The floor of the scene has 44 660 to 64 129.
const fn begin(level: u32) -> u32 {
    44_000 + 620 * level
}

/// The level of a depth.
fn level(depth: u32) -> u8 {
    (1..33).filter(|&level| depth >= begin(level)).count() as u8
}

fn stripe(level: u8) -> Rgb888 {
    Rgb888::new(level * 7, 255 - level * 7, level % 2 * 255)
}

impl Shader for Contours {
    type Varying = ();
    const NEEDS_DEPTH: bool = true;

    fn sub_face(&self, _: [(); 3]) -> Self {
        *self
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self(corners.depths())
    }
}

impl SpanShader<Rgb888> for Contours {
    type Ink = Rgb888;
    type Setup = Gradient;
    type FastPath = ();

    fn set_up(&self, triangle: &Triangle<'_>) -> Gradient {
        triangle.depth_gradient(self.0)
    }

    fn span(depth: &Gradient, span: Span) -> impl Iterator<Item = Rgb888> {
        (span.x..).map(move |x| stripe(level(depth.at(x, span.y) >> 16)))
    }
}

#[test]
fn contour_lines_are_those_of_the_stored_depths() {
    let (view, projection, viewport) = scene::camera().expect("a camera");
    let (area, camera) = (Rectangle::new(Point::zero(), SIZE), Camera::new(&view, &projection, &viewport));
    let floor = quad(&scene::FLOOR);
    let mut seen = std::collections::BTreeSet::new();
    for turn in 0..6 {
        let instance = camera.place(&floor, &Affine::rotation_z(Angle::degrees(2 + 3 * turn)));
        every_call(&instance, area, &|_: usize| Contours([0; 3]));
        let count = (SIZE.width * SIZE.height) as usize;
        let (mut pixels, mut depths) = (vec![Rgb888::BLACK; count], vec![0; count]);
        let mut picture = Picture::new(&mut pixels, SIZE).expect("a picture");
        let mut depth = DepthBuffer::new(area, &mut depths).expect("a depth buffer");
        let Ok(_) = instance.faces(|_| Contours([0; 3])).draw(&mut picture.pixels().depth_tested(&mut depth));
        let drawn = pixels.iter().zip(&depths).filter(|(_, depth)| **depth != DepthBuffer::NOTHING);
        for (&pixel, &depth) in drawn {
            let level = level(depth.into());
            assert_eq!(pixel, stripe(level), "{depth}");
            seen.insert(level);
        }
    }
    assert!(seen.len() > 25, "{seen:?}");
}

/// The shader decides whether depths and 1/w are computed: every draw call gives it the same, also with face planes.
#[test]
fn a_shader_gets_depth_and_w_whichever_call_draws_it() {
    let (area, model) = (Rectangle::new(Point::zero(), SIZE), Affine::<Model, World>::identity());
    let (view, projection, viewport) = scene::camera().expect("a camera");
    let oblique = {
        let near_far = NEAR_FAR.map(Scalar::from_int);
        let [half, left, right] = [4, -9, 5].map(|tenths| Scalar::from_ratio(tenths, 10));
        let window = Window { left, right, bottom: -half, top: half };
        Projection::frustum(window, near_far[0], near_far[1]).expect("a frustum")
    };
    for projection in [projection, oblique] {
        let camera = Camera::new(&view, &projection, &viewport);
        every_call(&camera.place(&quad(&scene::FLOOR), &model), area, &scene::board);
        every_call(&camera.place(&quad(&scene::WALL), &model), area, &scene::fog);
    }
}

fn quad(corners: &'static [[i16; 3]; 4]) -> Mesh<'static> {
    Mesh::new(corners, 0, &scene::QUAD).expect("a quad")
}

fn every_call<S: SpanShader<Rgb888, Ink = Rgb888>>(
    instance: &MeshInstance<'_>,
    area: Rectangle,
    shade: &dyn Fn(usize) -> S,
) {
    let (drawn, _) = by_every_call(instance, area, SKY, &[area.size.height, 9], shade);
    assert!(drawn.solid == drawn.deep && drawn.solid.iter().filter(|&&color| color != SKY).count() > 2_000);
    let with_planes = memory(area, SKY, &mut |target, _| {
        let Ok(_) = instance.faces(shade).culled_by_planes().draw(target);
    });
    assert!(with_planes == drawn.solid);
}
