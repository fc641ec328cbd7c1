//! What a pixel of a textured face shows, by a ray in f64, whatever the projection; and pictures of a face to compare with it.

use crate::textures::{Numbered, Screen, Shown, SIDE};
use embedded_graphics::prelude::*;
use pinhole::space::{Model, World};
use pinhole::{Affine, Camera, Cull, Mesh, SpanShader, Viewport};
use support::oracle::chain::{self, M4};
use support::oracle::rng::Rng;
use support::oracle::texture::{off_clamped, off_repeated, Range, Ray};

/// Faces in view space, which is the world here, in units of 2^exponent, and texture coordinates of each corner, on a screen of
/// `side` × `side` pixels.
pub(crate) struct Faces {
    pub(crate) side: u32,
    pub(crate) vertices: Vec<[i16; 3]>,
    pub(crate) exponent: i8,
    pub(crate) uv: Vec<[[i16; 2]; 3]>,
}

impl Faces {
    pub(crate) const fn new(exponent: i8) -> Self {
        Self { side: SIDE, vertices: vec![], exponent, uv: vec![] }
    }

    pub(crate) fn push(&mut self, corners: [[i16; 3]; 3], uv: [[i16; 2]; 3]) {
        self.vertices.extend(corners);
        self.uv.push(uv);
    }

    /// Random triangles of three sizes, about points up to `reach` to each side and up to `deep` ahead.
    pub(crate) fn soup(
        rng: &mut Rng,
        count: usize,
        reach: i64,
        deep: i64,
        mut uv: impl FnMut(&mut Rng) -> i16,
    ) -> Self {
        let mut faces = Self::new(-6);
        for i in 0..count {
            let middle = [rng.int(-reach, reach), rng.int(-reach, reach), -rng.int(70, deep)];
            let size = [deep / 3, deep / 15, 40][i % 3];
            let corners = [(); 3].map(|()| [0, 1, 2].map(|k| (middle[k] + rng.int(-size, size)) as i16));
            let uv = [(); 3].map(|()| [(); 2].map(|()| uv(rng)));
            faces.push(corners, uv);
        }
        faces
    }

    pub(crate) fn indices(&self) -> Vec<[u16; 3]> {
        (0..self.uv.len() as u16).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()
    }

    /// The pixels of one of the faces alone.
    pub(crate) fn draw<S: SpanShader<Shown>>(
        &self,
        face: usize,
        camera: &Camera,
        shader: S,
    ) -> Vec<Option<Shown>> {
        let index = face as u16;
        let faces = [[3 * index, 3 * index + 1, 3 * index + 2]];
        let mesh = Mesh::new(&self.vertices, self.exponent, &faces).unwrap();
        let instance = camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
        let mut screen = Screen(vec![None; (self.side * self.side) as usize]);
        let shade: &dyn Fn(usize) -> S = &|_| shader;
        let Ok(_) = instance.solid(shade, &mut [], &mut screen);
        screen.0
    }

    /// The exact coordinates of a face, in units of `unit` texels, under a projection of the screen.
    pub(crate) fn ray(&self, face: usize, projection: &M4, unit: [f64; 2]) -> FaceRay {
        let camera = chain::Camera {
            view: chain::View { rows: chain::IDENTITY.m, eye: [0.0; 3] },
            projection: *projection,
            viewport: chain::Viewport::new(0, 0, self.side, self.side),
        };
        let corners = [0, 1, 2].map(|i| chain::vertex(self.vertices[3 * face + i], self.exponent));
        let uv = self.uv[face].map(|[u, v]| [f64::from(u) * unit[0], f64::from(v) * unit[1]]);
        FaceRay(Ray::new(&camera, &chain::IDENTITY, corners, uv))
    }
}

/// The coordinates on the rays through the pixels of one face.
pub(crate) struct FaceRay(Ray);

impl FaceRay {
    /// The largest error in texels of a picture, beyond a shift of 1/64 pixel, where the picture repeats; and how many pixels there
    /// are.
    pub(crate) fn worst_repeated(&self, picture: &[Option<Shown>], bits: [u32; 2]) -> (f64, usize) {
        self.worst(picture, bits, off_repeated)
    }

    /// The largest error, and the number of pixels, where the edge of the picture continues.
    pub(crate) fn worst_clamped(&self, picture: &[Option<Shown>], bits: [u32; 2]) -> (f64, usize) {
        self.worst(picture, bits, off_clamped)
    }

    fn worst(
        &self,
        picture: &[Option<Shown>],
        bits: [u32; 2],
        off: impl Fn(f64, Range, f64) -> f64,
    ) -> (f64, usize) {
        let (mut worst, mut count) = (0.0f64, 0);
        for (i, shown) in picture.iter().enumerate() {
            let Some(Shown(shown)) = *shown else { continue };
            let columns = picture.len().isqrt();
            let (x, y) = ((i % columns) as i64, (i / columns) as i64);
            // Beside the face's horizon a point within 1/64 pixel may show anything.
            let Some(exact) = self.0.around(x, y) else { continue };
            for axis in 0..2 {
                let side = f64::from(1u32 << bits[axis]);
                worst = worst.max(off(f64::from(shown[axis]) / 2f64.powi(32) * side, exact[axis], side));
            }
            count += 1;
        }
        (worst, count)
    }
}

/// A camera at the origin that looks along −z.
pub(crate) fn camera(lens: &pinhole::Projection) -> Camera {
    camera_on(SIDE, lens)
}

/// A camera at the origin that looks along −z, for a screen of `side` × `side` pixels.
pub(crate) fn camera_on(side: u32, lens: &pinhole::Projection) -> Camera {
    use pinhole::{Point3, Vector3, ViewTransform};
    let viewport = Viewport::new(Point::zero(), Size::new_equal(side)).unwrap();
    let [eye, ahead] = [0, -1].map(|z| Point3::from_ints(0, 0, z));
    let view = ViewTransform::look_at(eye, ahead, Vector3::from_ints(0, 1, 0)).unwrap();
    Camera::new(&view, lens, &viewport)
}

/// 60 degrees, from 1 to `far`.
pub(crate) fn perspective(far: f64) -> M4 {
    chain::perspective(0x2aaa_aaab, SIDE, SIDE, 1.0, far)
}

pub(crate) fn library(matrix: &M4) -> pinhole::Projection {
    pinhole::Projection::from_matrix(matrix).unwrap()
}

/// Texels of 2^`bits` columns and rows that show their coordinates.
pub(crate) const fn numbered(bits: [u32; 2]) -> Numbered {
    Numbered(bits)
}
