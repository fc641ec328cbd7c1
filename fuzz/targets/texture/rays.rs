//! One textured face before a simple camera, with coordinates up to the ends of `i16` and w up to 65536 times as large at one corner
//! as at another, against one ray in f64 per pixel; and equal pixels on every target.

use super::{shown, Numbered};
use crate::fuzzed::place::Place;
use crate::fuzzed::Bytes;
use embedded_graphics_core::pixelcolor::Rgb888;
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::{prelude::*, texture::Accuracy};
use support::bridge::pair::{CameraBits, ModelBits, Step, ONE};
use support::bridge::rectangle;
use support::oracle::chain;
use support::oracle::texture::{off_clamped, off_repeated, Ray};

/// A colour that no coordinates show: u and v would be in one column and row in 4096.
const SKY: Rgb888 = Rgb888::new(255, 255, 255);

/// 1 to 65536, small ones and powers of two as often as any.
fn distance(b: &mut Bytes<'_>) -> i32 {
    match b.byte() {
        k @ 0..=63 => 1 + i32::from(k),
        k @ 64..=127 => 1 << (k & 15),
        k @ 128..=143 => 65_536 - i32::from(k & 15),
        _ => 1 + i32::from(b.u16()),
    }
}

fn coordinate(b: &mut Bytes<'_>) -> i16 {
    match b.byte() {
        0..=31 => i16::MIN,
        32..=63 => i16::MAX,
        64..=95 => 0,
        k @ 96..=159 => (i16::from(k) - 128) << 6,
        _ => b.i16(),
    }
}

#[derive(Debug)]
struct Face {
    camera: CameraBits,
    far_clip: bool,
    /// In units of 1/64; the mesh lies 512 units further back.
    vertices: [[i16; 3]; 3],
    uv: [[i16; 2]; 3],
    /// The texture's sides are 2^bits texels.
    bits: [u32; 2],
    /// The unit of coordinates: 2^exponent of a side, or 1/16 texel.
    exponent: Option<i8>,
    accuracy: Accuracy,
}

impl Face {
    fn read(b: &mut Bytes<'_>) -> Self {
        let kind = b.byte();
        let side = if kind & 1 == 0 { 32 } else { 240 };
        let near = b.of(&[ONE / 64, ONE / 8, ONE]);
        let camera = CameraBits::perspective(1 << 30, (side, side), near, b.of(&[2000, 100]) * ONE);
        // Across the picture at its distance, and a little beyond, or anywhere. Some corners lie behind the eye.
        let vertices = [(); 3].map(|()| {
            let w = if b.byte() < 24 { -i32::from(b.byte()) } else { distance(b) };
            let across = |b: &mut Bytes<'_>| match b.byte() {
                k @ 0..=239 => (w.abs() * (i32::from(k) - 120)) / 96,
                _ => i32::from(b.i16()),
            };
            [across(b), across(b), 32_768 - w].map(|c| c.clamp(-32_768, 32_767) as i16)
        });
        let uv = [(); 3].map(|()| [coordinate(b), coordinate(b)]);
        let bits = [b.below(6), b.below(6)].map(|bits| 3 + bits as u32);
        let exponent = (kind & 2 != 0).then(|| -(b.below(16) as i8));
        let accuracy = b.of(&[Accuracy::Quarter, Accuracy::Eighth, Accuracy::Sixteenth]);
        Self { camera, far_clip: kind & 4 != 0, vertices, uv, bits, exponent, accuracy }
    }

    fn with_instance(&self, then: impl FnOnce(&MeshInstance<'_>)) {
        let mesh = Mesh::new(&self.vertices, -6, &[[0, 1, 2]]).expect("a mesh");
        let camera = self.camera.library().with_far_clip(self.far_clip);
        then(&camera.place(&mesh, &self.model().library()).with_cull(Cull::None));
    }

    fn model(&self) -> ModelBits {
        ModelBits(vec![Step::Move([0, 0, -512 * ONE])])
    }

    /// The unit of coordinates in texels.
    fn unit(&self) -> [f64; 2] {
        self.bits
            .map(|bits| self.exponent.map_or(1.0 / 16.0, |e| f64::from(i32::from(e) + bits as i32).exp2()))
    }

    fn ray(&self) -> Ray {
        let unit = self.unit();
        let uv = self.uv.map(|uv| [0, 1].map(|axis| f64::from(uv[axis]) * unit[axis]));
        let corners = self.vertices.map(|v| chain::vertex(v, -6));
        Ray::new(&self.camera.exact(), &self.model().exact(), corners, uv)
    }

    /// The documented error in texels, u's and v's.
    fn bound(&self) -> [f64; 2] {
        let chosen = match self.accuracy {
            Accuracy::Quarter => 0.25,
            Accuracy::Eighth => 0.125,
            Accuracy::Sixteenth => 0.0625,
        };
        let near = self.camera.projection.near() * 64.0;
        let w = self.vertices.map(|[_, _, z]| f64::from(32_768 - i32::from(z)).max(near));
        let [largest, least] =
            [w.iter().copied().fold(0.0, f64::max), w.iter().copied().fold(f64::MAX, f64::min)];
        let unit = self.unit();
        // In units.
        let ranges = [0, 1].map(|axis| {
            let values = self.uv.map(|uv| f64::from(uv[axis]));
            let high = values.iter().copied().fold(f64::MIN, f64::max);
            high - values.iter().copied().fold(f64::MAX, f64::min)
        });
        // The planes of u and v have one unit.
        let planes = 8.0 * 2f64.powi(-24) * ranges[0].max(ranges[1]) * largest / least;
        // Six planes round the coordinates of new corners to 1/256 unit.
        [0, 1].map(|axis| chosen + 0.03 + (ranges[axis] * 2f64.powi(-13) + 6.0 / 512.0 + planes) * unit[axis])
    }
}

/// A window of the picture around a pixel.
fn window(b: &mut Bytes<'_>, side: i32) -> Rectangle {
    let mut middle = |limit: i32| match b.byte() {
        k @ 0..=127 => limit / 2 + i32::from(k >> 4) - 4,
        k => i32::from(k & 127) * limit / 127,
    };
    let (x, y) = (middle(side), middle(side));
    let (width, height) = (1 + u32::from(b.byte() & 31), 1 + u32::from(b.byte() & 15));
    rectangle(x - width as i32 / 2, y - height as i32 / 2, width, height)
}

pub(crate) fn check(b: &mut Bytes<'_>) {
    let face = Face::read(b);
    let side = face.camera.viewport.2;
    let place = Place { area: window(b, side as i32), sky: SKY, rows: 1 + u32::from(b.byte() & 7) };
    let texture = Texture::new(Numbered(face.bits)).with_accuracy(face.accuracy);
    let texture = face.exponent.map_or(texture, |e| texture.with_exponent(e).expect("-15 to 0"));
    face.with_instance(|instance| {
        let repeated = place.everywhere(instance, &|_| texture.at(face.uv)).solid;
        let clamped = place.everywhere(instance, &|_| texture.clamped_at(face.uv)).solid;
        compare(&face, place.area, &repeated, off_repeated);
        compare(&face, place.area, &clamped, off_clamped);
    });
}

/// What pixels show against rays.
fn compare(face: &Face, area: Rectangle, picture: &[Rgb888], off: impl Fn(f64, (f64, f64), f64) -> f64) {
    let (ray, bound) = (face.ray(), face.bound());
    for (point, &color) in area.points().zip(picture) {
        if color == SKY {
            continue;
        }
        let Some(exact) = ray.around(point.x.into(), point.y.into()) else { continue };
        for axis in 0..2 {
            let side = f64::from(1u32 << face.bits[axis]);
            let step = side / 4096.0;
            let at = (f64::from(shown(color)[axis]) + 0.5) * step;
            let error = off(at, exact[axis], side) - step / 2.0;
            assert!(
                error <= bound[axis],
                "{point:?}, axis {axis}: {at} and {:?}, off by {error} of {}, {face:?}",
                exact[axis],
                bound[axis]
            );
        }
    }
}
