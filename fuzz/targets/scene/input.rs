//! A scene from bytes: small numbers in simple views as often as extremes, and a target around a point inside the
//! viewport.

use crate::fuzzed::Bytes;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::prelude::*;
use support::bridge::pair::{bits, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::rectangle;
use support::oracle::chain;
use support::oracle::coverage::Area;
use support::oracle::target::area;

#[derive(Debug)]
pub(crate) struct Scene {
    pub(crate) camera: CameraBits,
    pub(crate) far_clip: bool,
    pub(crate) cull: Cull,
    pub(crate) model: ModelBits,
    pub(crate) vertices: Vec<[i16; 3]>,
    pub(crate) exponent: i8,
    pub(crate) faces: Vec<[u16; 3]>,
    pub(crate) edges: Vec<[u16; 2]>,
    /// What the target covers.
    pub(crate) bounds: Rectangle,
    /// The length of the cache.
    pub(crate) cache: usize,
}

fn view(b: &mut Bytes<'_>) -> ViewBits {
    let up = [0, ONE, 0];
    match b.byte() {
        // Down −z, as the vertices are meant.
        0..=127 => ViewBits::LookAlong([0; 3], [0, 0, -ONE], up),
        128..=191 => {
            let (eye, gaze) = ([0; 3].map(|_| b.i8() as i32 * ONE / 8), [0; 3].map(|_| b.i8() as i32));
            ViewBits::LookAlong(eye, gaze, up)
        }
        _ => ViewBits::LookAt([0; 3].map(|_| b.wild()), [0; 3].map(|_| b.wild()), [0; 3].map(|_| b.wild())),
    }
}

fn projection(b: &mut Bytes<'_>, size: (u32, u32)) -> ProjectionBits {
    let (near, far) = match b.byte() {
        0..=127 => (ONE / 4, 1000 * ONE),
        128..=191 => (1 + i32::from(b.u16()), ONE * (2 + i32::from(b.byte()))),
        _ => (b.wild(), b.wild()),
    };
    match b.byte() {
        0..=95 => ProjectionBits::Perspective(1 << 30, size, near, far),
        96..=127 => ProjectionBits::Perspective(u32::from(b.u16()) << 15, size, near, far),
        128..=191 => {
            let (w, h) = (i32::from(b.byte()) * 256 + 1, i32::from(b.byte()) * 256 + 1);
            ProjectionBits::Frustum([-w, w / 2, -h, h], near, far)
        }
        192..=247 => {
            let (w, h) = ((1 + i32::from(b.byte())) * ONE / 16, (1 + i32::from(b.byte())) * ONE / 16);
            ProjectionBits::Orthographic([-w, w, -h, h], near, far)
        }
        _ => ProjectionBits::Orthographic([0; 4].map(|_| b.wild()), near, far),
    }
}

fn viewport(b: &mut Bytes<'_>) -> (i32, i32, u32, u32) {
    match b.byte() {
        0..=127 => (0, 0, 24, 18),
        128..=159 => {
            (b.i8() as i32 / 4, b.i8() as i32 / 4, 1 + u32::from(b.byte() >> 3), 1 + u32::from(b.byte() >> 3))
        }
        160..=175 => (b.i8() as i32 / 8, b.i8() as i32 / 8, 1, 1),
        176..=191 => (-8192, -8192, 16_384, 16_384),
        192..=207 => (-8192, 8191, 16_384, 1),
        _ => (
            i32::from(b.i16() >> 2),
            i32::from(b.i16() >> 2),
            u32::from(b.u16() >> 2),
            u32::from(b.u16() >> 2),
        ),
    }
}

/// At most 24 × 18 pixels: the viewport's own first ones, or about its middle, a border, or anywhere.
fn target(b: &mut Bytes<'_>, (x, y, w, h): (i32, i32, u32, u32)) -> Rectangle {
    let (w, h) = (w as i32, h as i32);
    let (left, top) = match b.byte() {
        0..=63 => (x, y),
        64..=127 => (x + w / 2 - 12, y + h / 2 - 9),
        128..=159 => (x + w - 12, y + h - 9),
        160..=223 => (x + b.i8() as i32, y + b.i8() as i32),
        _ => (i32::from(b.i16()), i32::from(b.i16())),
    };
    let (width, height) = match b.byte() {
        0..=191 => (24, 18),
        k => (u32::from(k & 7), u32::from(b.byte() & 15)),
    };
    rectangle(left, top, width, height)
}

fn coordinate(b: &mut Bytes<'_>) -> i16 {
    match b.byte() {
        k @ 0..=127 => i16::from(k) - 64,
        k @ 128..=143 => i16::MAX - i16::from(k - 128),
        k @ 144..=159 => i16::MIN + i16::from(k - 144),
        k @ 160..=191 => 1 << (k & 15) >> 1,
        _ => b.i16(),
    }
}

impl Scene {
    /// None where the set-up is refused: that is another target's.
    pub(crate) fn read(data: &[u8]) -> Option<Self> {
        let mut b = Bytes::new(data);
        let kind = b.byte();
        let count = 3 + usize::from(kind & 3);
        let vertices: Vec<_> = (0..count).map(|_| [(); 3].map(|()| coordinate(&mut b))).collect();
        let exponent = match kind >> 2 & 3 {
            0 => 0,
            1 => -4,
            2 => -8,
            _ => (b.i8() >> 2).clamp(-32, 15) as i8,
        };
        let index = |b: &mut Bytes<'_>| u16::from(b.byte()) % count as u16;
        let mut faces = vec![[0, 1, 2], [0, 2, 1]];
        faces.truncate(1 + usize::from(kind >> 4 & 1));
        for _ in 0..kind >> 5 & 1 {
            faces.push([index(&mut b), index(&mut b), index(&mut b)]);
        }
        let edges = vec![[0, 1], [index(&mut b), index(&mut b)]];
        let viewport = viewport(&mut b);
        let camera = CameraBits {
            view: view(&mut b),
            projection: projection(&mut b, (viewport.2, viewport.3)),
            viewport,
        };
        Viewport::new(camera.area().top_left, camera.area().size).ok()?;
        camera.view.library().ok()?;
        camera.projection.library().ok()?;
        let mut model = ModelBits::default();
        let moves = b.byte();
        if moves & 1 != 0 {
            model.0.push(Step::Y(b.u32()));
        }
        if moves & 2 != 0 {
            model.0.push(Step::X(u32::from(b.byte()) << 24));
        }
        if moves & 12 == 12 {
            model.0.insert(0, Step::Scale([b.wild(), b.wild(), b.wild()]));
        }
        if moves & 16 != 0 {
            // Before the eye.
            let away =
                [f64::from(b.i8() as i8) / 4.0, f64::from(b.i8() as i8) / 4.0, -f64::from(b.byte()) / 4.0];
            model.0.push(Step::Move(bits(away)?));
        } else if moves & 32 != 0 {
            model.0.push(Step::Move([b.wild(), b.wild(), b.wild()]));
        }
        let bounds = target(&mut b, viewport);
        let last = b.byte();
        Some(Self {
            camera,
            far_clip: last & 1 != 0,
            cull: if last & 2 == 0 { Cull::Back } else { Cull::None },
            model,
            vertices,
            exponent,
            faces,
            edges,
            bounds,
            cache: usize::from(last >> 2) % (count + 2),
        })
    }

    /// Viewport ∩ target.
    pub(crate) fn area(&self) -> Area {
        let common = area(self.bounds).intersect(area(self.camera.area()));
        Area { right: common.right.max(common.left), bottom: common.bottom.max(common.top), ..common }
    }

    /// [`Self::area`], unless it is empty.
    pub(crate) fn rectangle(&self) -> Option<Rectangle> {
        let area = self.area();
        let size = (area.width() as u32, area.height() as u32);
        (size.0 > 0 && size.1 > 0).then(|| rectangle(area.left as i32, area.top as i32, size.0, size.1))
    }

    pub(crate) fn with_instance<R>(
        &self,
        faces: &[[u16; 3]],
        edges: &[[u16; 2]],
        then: impl FnOnce(&MeshInstance<'_>) -> R,
    ) -> R {
        let mesh = Mesh::new(&self.vertices, self.exponent, faces)
            .and_then(|m| m.with_edges(edges))
            .expect("a mesh");
        let camera = self.camera.library().with_far_clip(self.far_clip);
        then(&camera.place(&mesh, &self.model.library()).with_cull(self.cull))
    }

    pub(crate) fn model_point(&self, index: u16) -> chain::V3 {
        chain::vertex(self.vertices[usize::from(index)], self.exponent)
    }
}
