//! The template's picture of a closed mesh is right, whatever its shape: every pixel is compared with a ray through its centre,
//! cast in f64 at all triangles, which shares nothing with the library but the mesh.

use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::Angle;
use pinhole_apps_support::bodies::{cup, gear, moved, stl, torus, Body};
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::{ImportedMesh, Options};
use pinhole_render::firmware;
use support::oracle::chain::{cross, dot, normalise, V3};

/// Colours that light cannot make equal: they differ in the channels that are not zero.
const PALETTE: [[u8; 3]; 7] =
    [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0], [255, 0, 255], [0, 255, 255], [255; 3]];
/// How far a vertex may be off on the screen: the snap to 1/256 px, and the rounding of constructors.
const OFF: f64 = 1.0 / 128.0;
/// The largest error of depth, in steps of the depth buffer: faces two steps apart stay apart (ARCHITECTURE.md, "Numbers"), and a
/// tenth is for the distances of the near and far planes, which are not known here to a step.
const DEPTH: f64 = 2.2;

/// The mesh that firmware has of a body, each face in another colour than the faces listed next to it.
fn imported(name: &str, body: &Body) -> ImportedMesh {
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&file, stl(body)).unwrap();
    let mut model =
        pinhole_import::import(&file, &firmware::options(&firmware::TEMPLATE, &Options::default())).unwrap();
    assert!(model.warnings.is_empty(), "{name} is closed: {:?}", model.warnings);
    model.palette = PALETTE.to_vec();
    model.face_colors = (0..model.faces.len()).map(|face| (face % 7) as u8).collect();
    model
}

fn sub(a: V3, b: V3) -> V3 {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// A picture by rays.
struct Rays {
    /// The faces in the world, turned.
    faces: Vec<[V3; 3]>,
    /// The colour of each face in the light, channels from 0 to 1.
    colors: Vec<V3>,
    eye: V3,
    /// The axes to the right, up and ahead.
    axes: [V3; 3],
    /// Pixels per unit of the tangent.
    scale: f64,
    size: Size,
    /// The distances of the near and the far plane.
    planes: [f64; 2],
}

impl Rays {
    fn new(model: &ImportedMesh, turn: f64, size: Size) -> Self {
        let step = f64::from(model.exponent).exp2();
        let (sin, cos) = turn.to_radians().sin_cos();
        let at = |v: u16| {
            let [x, y, z] = model.vertices[usize::from(v)].map(|c| f64::from(c) * step);
            [x * cos + z * sin, y, z * cos - x * sin]
        };
        let faces: Vec<[V3; 3]> = model.faces.iter().map(|face| face.map(at)).collect();
        let light = normalise([2.0, 3.0, 4.0]);
        let shade = |(number, [a, b, c]): (usize, &[V3; 3])| {
            let cosine = dot(normalise(cross(sub(*b, *a), sub(*c, *a))), light).max(0.0);
            let level = (48.0 + (256.0 - 48.0) * cosine) / 256.0;
            PALETTE[number % 7].map(|c| f64::from(c) / 255.0 * level)
        };
        // The sphere about the mesh fills 31/32 of the height or width, at 40 degrees, from 30 degrees to the right and 20 above.
        let sphere = model.mesh().unwrap().bounding_sphere();
        let centre = [sphere.centre.x(), sphere.centre.y(), sphere.centre.z()]
            .map(|c| f64::from(c.to_bits()) / 65536.0);
        let radius = f64::from(sphere.radius.to_bits()) / 65536.0;
        let tangent = 20f64.to_radians().tan();
        let distance = radius / (tangent * 31.0 / 32.0).atan().sin();
        let ((sin_yaw, cos_yaw), (sin_pitch, cos_pitch)) =
            (30f64.to_radians().sin_cos(), 20f64.to_radians().sin_cos());
        let away = [cos_pitch * sin_yaw, sin_pitch, cos_pitch * cos_yaw];
        let ahead = away.map(|c| -c);
        let right = normalise(cross(ahead, [0.0, 1.0, 0.0]));
        Self {
            colors: faces.iter().enumerate().map(shade).collect(),
            faces,
            eye: [0, 1, 2].map(|i| centre[i] + distance * away[i]),
            axes: [right, cross(right, ahead), ahead],
            scale: f64::from(size.width.min(size.height)) / 2.0 / tangent,
            size,
            planes: [distance - radius, distance + radius],
        }
    }

    /// The depth in the buffer at a distance along the view.
    fn depth(&self, distance: f64) -> f64 {
        let [near, far] = self.planes;
        65535.0 * far * (distance - near) / (distance * (far - near))
    }

    /// The point of the screen at which a point of the world is.
    fn on_screen(&self, point: V3) -> [f64; 2] {
        let [x, y, ahead] = self.axes.map(|axis| dot(axis, sub(point, self.eye)));
        let [width, height] = [self.size.width, self.size.height].map(f64::from);
        [width / 2.0 + self.scale * x / ahead, height / 2.0 - self.scale * y / ahead]
    }

    /// The depth of a face at a point of the screen, if it shows its front there.
    fn hit(&self, [a, b, c]: &[V3; 3], x: f64, y: f64) -> Option<f64> {
        let [width, height] = [self.size.width, self.size.height].map(f64::from);
        let (dx, dy) = ((x - width / 2.0) / self.scale, (height / 2.0 - y) / self.scale);
        let [right, up, ahead] = self.axes;
        // As long as it is along the view, so that t is the distance along the view. Cramer's rule.
        let ray = [0, 1, 2].map(|i| ahead[i] + dx * right[i] + dy * up[i]);
        let (e, f) = (sub(*b, *a), sub(*c, *a));
        let normal = cross(e, f);
        let facing = -dot(ray, normal);
        let from = sub(self.eye, *a);
        let across = cross(from, ray);
        let (u, v) = (dot(f, across) / facing, -dot(e, across) / facing);
        let is_hit = facing > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        is_hit.then(|| self.depth(dot(from, normal) / facing))
    }

    /// What a pixel may show if vertices are off by [`OFF`]: the faces, or `None` for the background. Rays go through the centre and
    /// as many points to each side of it as `finer` says: a face may be narrower than their distance.
    fn seen(&self, at: Point, boxes: &[[[f64; 2]; 2]], finer: i32) -> Vec<Option<usize>> {
        let (x, y) = (f64::from(at.x) + 0.5, f64::from(at.y) + 0.5);
        let is_near = |[low, high]: &[[f64; 2]; 2]| {
            (low[0] - OFF..=high[0] + OFF).contains(&x) && (low[1] - OFF..=high[1] + OFF).contains(&y)
        };
        let near: Vec<usize> = (0..boxes.len()).filter(|&face| is_near(&boxes[face])).collect();
        let offsets = (-finer..=finer).map(|step| OFF * f64::from(step) / f64::from(finer));
        let mut seen = Vec::new();
        for (dx, dy) in offsets.clone().flat_map(|dx| offsets.clone().map(move |dy| (dx, dy))) {
            let hit = |&face: &usize| Some((face, self.hit(&self.faces[face], x + dx, y + dy)?));
            let hits: Vec<_> = near.iter().filter_map(hit).collect();
            // Of each ray, what it meets first, or as far ahead as the depth buffer cannot tell. At a silhouette, rays beside it meet
            // what is behind.
            match hits.iter().map(|(_, depth)| *depth).min_by(f64::total_cmp) {
                Some(nearest) => {
                    let first = hits.iter().filter(|(_, depth)| *depth <= nearest + DEPTH);
                    seen.extend(first.map(|(face, _)| Some(*face)));
                }
                None => seen.push(None),
            }
        }
        seen.sort_unstable();
        seen.dedup();
        seen
    }

    /// How many pixels of a picture show what no ray allows, and how many have one face alone that they may show.
    fn judge(&self, picture: &Canvas<Rgb565>) -> (usize, usize) {
        let (mut wrong, mut certain) = (0, 0);
        let around = |face: &[V3; 3]| {
            let [a, b, c] = face.map(|corner| self.on_screen(corner));
            let of = |pick: fn(f64, f64) -> f64| [0, 1].map(|i| pick(pick(a[i], b[i]), c[i]));
            [of(f64::min), of(f64::max)]
        };
        let boxes: Vec<_> = self.faces.iter().map(around).collect();
        let points = Rectangle::new(Point::zero(), self.size).points();
        for (at, pixel) in points.zip(picture.pixels()) {
            let seen = self.seen(at, &boxes, 1);
            let shown =
                [f64::from(pixel.r()) / 31.0, f64::from(pixel.g()) / 63.0, f64::from(pixel.b()) / 31.0];
            // A level of red and blue is 1/31; normals and light are rounded.
            let is_shown = |face: &Option<usize>| {
                let wanted = face.map_or([0.0; 3], |face| self.colors[face]);
                (0..3).all(|i| (wanted[i] - shown[i]).abs() <= 0.6 / 31.0 + 0.01)
            };
            wrong +=
                usize::from(!seen.iter().any(is_shown) && !self.seen(at, &boxes, 8).iter().any(is_shown));
            certain += usize::from(seen.len() == 1);
        }
        (wrong, certain)
    }
}

/// Compares the template's pictures of a body, at angles of a turn and on two displays.
fn is_right(name: &str, body: &Body) {
    let model = imported(name, body);
    let mut drawn = 0;
    for (number, size) in [Size::new(120, 90), Size::new(64, 100)].into_iter().enumerate() {
        for turn in [0, 9, 25, 160, 275] {
            let turn = turn + 7 * number as i32;
            let mut canvas = Canvas::new(size, Rgb565::MAGENTA);
            firmware::draw(&model, Angle::degrees(turn), &mut canvas).unwrap();
            let rays = Rays::new(&model, f64::from(turn), size);
            let (wrong, certain) = rays.judge(&canvas);
            assert_eq!(wrong, 0, "{name} at {turn} degrees, {size:?}");
            let pixels = canvas.pixels().len();
            assert!(certain * 100 > pixels * 90, "{name}: {certain} of {pixels} pixels have one answer");
            drawn += canvas.pixels().iter().filter(|color| **color != Rgb565::BLACK).count();
        }
    }
    assert!(drawn > 10 * 1000, "{name}: {drawn} pixels");
}

#[test]
fn closed_bodies_are_right() {
    // Two rings, one through the other: no order of the two is right.
    let ring = torus(3.0, 0.8, 24, 12);
    let mut chain = moved(&ring, |[x, y, z]| [x - 1.5, y, z]);
    chain.extend(moved(&ring, |[x, y, z]| [x + 1.5, -z, y]));
    for (name, body) in [
        ("closed-gear.stl", gear()),
        ("closed-torus.stl", torus(3.0, 1.2, 32, 16)),
        ("closed-cup.stl", cup()),
        ("closed-chain.stl", chain),
    ] {
        is_right(name, &body);
    }
}
