//! Faces before a camera; what a pixel of a face shows, by a ray in f64, whatever the projection; and pictures of faces to compare with
//! it.

use embedded_graphics::pixelcolor::{PixelColor, Rgb888, RgbColor};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{color::Unmixed, prelude::*, shading::SpanShader, target::Pixels, texture::Texels};
pub(crate) use support::bridge::texels::{Numbered, Shown};
use support::bridge::ways::{self, by_every_call, Drawn};
use support::oracle::chain::{self, M4, V3};
use support::oracle::rng::Rng;
use support::oracle::shade;
use support::oracle::target::Screen;
use support::oracle::texture::{Range, Ray};

pub(crate) const SIDE: u32 = 240;
pub(crate) const SIZE: Size = Size::new(SIDE, SIDE);
pub(crate) const AREA: Rectangle = Rectangle::new(Point::zero(), SIZE);
pub(crate) const SKY: Rgb888 = Rgb888::new(1, 2, 3);
/// 60 degrees.
pub(crate) const FOV: u32 = 0x2aaa_aaab;

/// Texels whose coordinates have 32 bits.
#[derive(Clone, Copy)]
pub(crate) struct Wide<S>(pub(crate) S);

impl<S: Texels> Texels for Wide<S> {
    type Color = S::Color;
    type Ink = S::Ink;
    type FastPath = ();
    const WIDE: bool = true;

    fn size_bits(&self) -> [u32; 2] {
        self.0.size_bits()
    }

    fn texel(&self, u: u32, v: u32) -> S::Ink {
        self.0.texel(u, v)
    }
}

/// The bound that `Texels::WIDE` documents for coordinates that share a word, in sides.
pub(crate) const PACKING: f64 = 37.0 / 65536.0;

/// 8 × 8 texels, each of a colour of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tiles;

impl Texels for Tiles {
    type Color = Rgb888;
    type Ink = Rgb888;
    type FastPath = ();

    fn size_bits(&self) -> [u32; 2] {
        [3, 3]
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        let [column, row] = [u, v].map(|c| (c >> 29) as u8);
        Rgb888::new(20 + 16 * column, 40 + 16 * row, 60)
    }
}

/// Faces in view space, which is the world here, in units of 2^exponent, and texture coordinates of each corner, on a screen of
/// `side` × `side` pixels.
#[derive(Clone)]
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

    /// A quad as two triangles: its corners counter-clockwise, and their texture coordinates.
    pub(crate) fn push_quad(&mut self, [a, b, c, d]: [[f64; 3]; 4], [p, q, r, s]: [[i16; 2]; 4]) {
        let scale = 2f64.powi(-i32::from(self.exponent));
        let [a, b, c, d] = [a, b, c, d].map(|v| v.map(|c| (c * scale).round() as i16));
        self.push([a, b, c], [p, q, r]);
        self.push([a, c, d], [p, r, s]);
    }

    /// A quad in front of the camera, turned about the line of sight by `roll` degrees, that shows `texels` texels of each axis.
    pub(crate) fn quad(corners: [[f64; 3]; 4], roll: f64, texels: i16, exponent: i8) -> Self {
        let ((s, c), t) = (roll.to_radians().sin_cos(), texels * 16);
        let mut faces = Self::new(exponent);
        let turned = corners.map(|[x, y, z]| [c * x - s * y, s * x + c * y, z]);
        faces.push_quad(turned, [[0, t], [t, t], [t, 0], [0, 0]]);
        faces
    }

    /// Random triangles of three sizes, about points up to `reach` to each side and up to `deep` ahead: many of them slender, far to
    /// the side or across the near plane.
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

    /// One of the faces.
    pub(crate) fn alone(&self, face: usize) -> Self {
        let mut alone = Self { side: self.side, ..Self::new(self.exponent) };
        alone.push([0, 1, 2].map(|i| self.vertices[3 * face + i]), self.uv[face]);
        alone
    }

    /// The corners of a face in units of the world.
    pub(crate) fn corners(&self, face: usize) -> [V3; 3] {
        [0, 1, 2].map(|i| chain::vertex(self.vertices[3 * face + i], self.exponent))
    }

    /// Calls `with` for the faces before a camera, drawn from both sides.
    pub(crate) fn place(&self, camera: &Camera, with: &mut dyn FnMut(&MeshInstance<'_>)) {
        let indices: Vec<_> = (0..self.uv.len() as u16).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Mesh::new(&self.vertices, self.exponent, &indices).unwrap();
        with(&camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None))
    }

    /// The pixels of one of the faces alone.
    pub(crate) fn draw<C: PixelColor, S: SpanShader<C, Ink: Unmixed<C>>>(
        &self,
        face: usize,
        camera: &Camera,
        shader: S,
    ) -> Screen<C> {
        let mut screen = Screen::sized(self.side, self.side);
        let shade: &dyn Fn(usize) -> S = &|_| shader;
        self.alone(face).place(camera, &mut |instance| {
            let Ok(_) = instance.faces(shade).draw(&mut screen);
        });
        screen
    }

    /// Draws the faces into memory, with depth, before the usual camera.
    pub(crate) fn draw_deep<S: SpanShader<Rgb888>>(
        &self,
        shade: &dyn Fn(usize) -> S,
        target: &mut Pixels<'_, Rgb888>,
        depth: &mut DepthBuffer<'_>,
    ) {
        self.place(&usual(), &mut |instance| {
            let Ok(_) = instance.faces(shade).draw(&mut target.depth_tested(depth));
        });
    }

    /// Draws the faces by every draw call, with texels that are repeated and clamped, lit and not: however a row is cut into spans, by
    /// another target, by bands, by parts, by the painter or by what the depth buffer hides, a pixel shows the same.
    pub(crate) fn texture_by_every_call<T: Texels<Color = Rgb888, Ink = Rgb888> + Copy>(
        &self,
        name: &str,
        camera: &Camera,
        texels: T,
    ) {
        let (texture, uv, heights) = (Texture::new(texels), &self.uv, [13, SIDE]);
        let levels = |face: usize| [40 * face as u16 % 257, 256, 90 * face as u16 % 200];
        self.place(camera, &mut |instance| {
            let (drawn, _) = by_every_call(instance, AREA, SKY, &heights, &|face| texture.at(uv[face]));
            let pixels = drawn.solid.iter().filter(|&&pixel| pixel != SKY).count();
            assert!(pixels > 5_000, "{name}: {pixels}");
            ways::everywhere(instance, AREA, SKY, &|face| texture.clamped_at(uv[face]));
            ways::everywhere(instance, AREA, SKY, &|face| texture.at(uv[face]).lit(levels(face)));
            by_every_call(instance, AREA, SKY, &heights, &|face| {
                texture.clamped_at(uv[face]).lit(levels(face))
            });
        });
    }

    /// The exact coordinates of a face, in units of `unit` texels, under a projection of the screen.
    pub(crate) fn ray(&self, face: usize, projection: &M4, unit: [f64; 2]) -> FaceRay {
        self.ray_of(
            face,
            projection,
            self.uv[face].map(|[u, v]| [f64::from(u) * unit[0], f64::from(v) * unit[1]]),
        )
    }

    /// How far before the eye the pixels of a face lie, in the first value.
    pub(crate) fn distances(&self, face: usize, projection: &M4) -> FaceRay {
        self.ray_of(face, projection, self.corners(face).map(|[.., z]| [-z, 0.0]))
    }

    /// The weights of the second and the third corner of a face.
    pub(crate) fn weights(&self, face: usize, projection: &M4) -> FaceRay {
        self.ray_of(face, projection, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    }

    fn ray_of(&self, face: usize, projection: &M4, values: [[f64; 2]; 3]) -> FaceRay {
        let camera = chain::Camera {
            view: chain::View { rows: chain::IDENTITY.m, eye: [0.0; 3] },
            projection: *projection,
            viewport: chain::Viewport::new(0, 0, self.side, self.side),
        };
        FaceRay(Ray::new(&camera, &chain::IDENTITY, self.corners(face), values))
    }
}

/// A floor from `near` to `far` ahead, one unit below the eye, `half` units to each side.
pub(crate) fn floor(near: f64, far: f64, half: f64) -> [[f64; 3]; 4] {
    [[-half, -1.0, -near], [half, -1.0, -near], [half, -1.0, -far], [-half, -1.0, -far]]
}

/// A wall along the line of sight, a thousand times as far at its end.
pub(crate) const WALL: [[f64; 3]; 4] =
    [[-1.0, -30.0, -1.2], [-1.0, 30.0, -1.2], [-1.0, 30.0, -1200.0], [-1.0, -30.0, -1200.0]];

/// The values on the rays through the pixels of one face.
pub(crate) struct FaceRay(pub(crate) Ray);

impl FaceRay {
    /// The largest error in texels of a picture, beyond a shift of 1/64 pixel, and how many pixels there are. `off` is `off_repeated` or
    /// `off_clamped`.
    pub(crate) fn worst(
        &self,
        picture: &Screen<Shown>,
        bits: [u32; 2],
        off: impl Fn(f64, Range, f64) -> f64,
    ) -> (f64, usize) {
        let (mut worst, mut count) = (0.0f64, 0);
        for (Point { x, y }, Shown(shown)) in picture.drawn() {
            // Beside the face's horizon a point within 1/64 pixel may show anything.
            let Some(exact) = self.0.around(x.into(), y.into()) else { continue };
            for axis in 0..2 {
                let side = f64::from(1u32 << bits[axis]);
                worst = worst.max(off(f64::from(shown[axis]) / 2f64.powi(32) * side, exact[axis], side));
            }
            count += 1;
        }
        (worst, count)
    }
}

/// A camera at the origin that looks along −z, for a screen of `side` × `side` pixels.
pub(crate) fn camera_on(side: u32, lens: &Projection) -> Camera {
    let viewport = Viewport::new(Point::zero(), Size::new_equal(side)).unwrap();
    let [eye, ahead] = [0, -1].map(|z| Point3::from_ints(0, 0, z));
    let view = ViewTransform::look_at(eye, ahead, Vector3::from_ints(0, 1, 0)).unwrap();
    Camera::new(&view, lens, &viewport)
}

/// A camera at the origin that looks along −z.
pub(crate) fn camera(lens: &Projection) -> Camera {
    camera_on(SIDE, lens)
}

/// 60 degrees, from 1 to `far`.
pub(crate) fn perspective(far: f64) -> M4 {
    chain::perspective(FOV, SIDE, SIDE, 1.0, far)
}

pub(crate) fn library(matrix: &M4) -> Projection {
    Projection::from_matrix(matrix).unwrap()
}

/// The camera of most scenes.
pub(crate) fn usual() -> Camera {
    camera(&library(&perspective(2000.0)))
}

/// Faces before the usual camera, by the ways of `ways::in_memory`.
pub(crate) fn in_memory<S: SpanShader<Rgb888>>(faces: &Faces, shade: &dyn Fn(usize) -> S) -> Drawn<Rgb888> {
    let mut drawn = None;
    faces.place(&usual(), &mut |instance| drawn = Some(ways::in_memory(instance, AREA, SKY, shade)));
    drawn.expect("placed")
}

/// Faces before the usual camera, by the ways of `ways::everywhere`.
pub(crate) fn everywhere<S: SpanShader<Rgb888, Ink: Unmixed<Rgb888>>>(
    faces: &Faces,
    shade: &dyn Fn(usize) -> S,
) -> Drawn<Rgb888> {
    let mut drawn = None;
    faces.place(&usual(), &mut |instance| drawn = Some(ways::everywhere(instance, AREA, SKY, shade)));
    drawn.expect("placed")
}

/// Two colours, channel by channel.
pub(crate) fn each_level(own: Rgb888, other: Rgb888, level: impl Fn(u8, u8) -> u8) -> Rgb888 {
    Rgb888::new(level(own.r(), other.r()), level(own.g(), other.g()), level(own.b(), other.b()))
}

/// Two colours, mixed in 1/32 parts to nearest.
pub(crate) fn mixed(own: Rgb888, other: Rgb888, parts: u8) -> Rgb888 {
    each_level(own, other, |own, other| shade::mixed(own, other, parts))
}
