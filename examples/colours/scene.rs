//! A teapot in front of a wall, with light per vertex and colours per corner.

use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Angle, Band, Camera, Channels, Cull, DepthBuffer, Frame, Gouraud, Lambert, Lit, Mesh,
    PixelFormat, Point3, Projection, Scalar, ScreenVertex, SpanShader, Vector3, ViewTransform, Viewport,
};
use std::error::Error;

const CLAY: Rgb888 = Rgb888::new(255, 178, 92);

/// The shaders of the wall and of the teapot.
pub(crate) type Shaders<I, L> = (fn(Gouraud) -> I, fn(Lit) -> L);

/// A wall across the picture, counter-clockwise from the lower left.
const WALL: [[i16; 3]; 4] = [[-34, -36, -18], [34, -36, -18], [34, 22, -18], [-34, 22, -18]];
const WALL_FACES: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
const WALL_COLOURS: [Rgb888; 4] = [
    Rgb888::new(226, 120, 160),
    Rgb888::new(60, 48, 120),
    Rgb888::new(10, 40, 80),
    Rgb888::new(110, 190, 220),
];

pub(crate) struct Scene {
    area: Rectangle,
    camera: Camera,
    model: Affine<Model, World>,
    /// Light levels at the teapot's vertices.
    levels: Vec<u16>,
}

impl Scene {
    pub(crate) fn new(size: Size) -> Result<Self, Box<dyn Error>> {
        let viewing = ViewTransform::look_at(
            Point3::from_ints(0, 15, 42),
            Point3::from_f32(1.2, -0.6, 0.0)?,
            Vector3::from_ints(0, 1, 0),
        )?;
        let projection =
            Projection::perspective(Angle::degrees(31), size, Scalar::from_int(10), Scalar::from_int(90))?;
        let camera = Camera::new(&viewing, &projection, &Viewport::new(Point::zero(), size)?);
        let model = Affine::<Model, World>::rotation_y(Angle::degrees(-25));
        // The light comes from above, the left and the front.
        let light = Lambert::new(&model, Vector3::from_ints(-3, 4, 3), 40)?;
        let mut levels = vec![0; teapot::VERTICES.len()];
        light.levels(&vertex_normals(), &mut levels);
        Ok(Self { area: Rectangle::new(Point::zero(), size), camera, model, levels })
    }

    /// Draws in bands of `rows` rows; `shaders` makes the shaders.
    pub(crate) fn draw<C: Channels + PixelFormat, I: SpanShader<C>, L: SpanShader<C>>(
        &self,
        rows: u32,
        (smooth, lit): Shaders<I, L>,
        mut send: impl FnMut(&Band<'_, C>),
    ) -> Result<(), Box<dyn Error>> {
        let pot = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES)?;
        let wall = Mesh::new(&WALL, 0, &WALL_FACES)?;
        let (mut pot_cache, mut wall_cache) =
            ([ScreenVertex::EMPTY; teapot::VERTICES.len()], [ScreenVertex::EMPTY; 4]);
        let (mut pot_bins, mut wall_bins) = (vec![0; 2 * teapot::FACES.len()], [0; 3]);

        // The inside is visible through the gap around the lid.
        let instance = self.camera.place(&pot, &self.model).with_cull(Cull::None);
        let projected = instance.transform_depth(&mut pot_cache);
        let mut pot_faces = projected.bin_faces(&mut pot_bins)?;
        let instance = self.camera.place(&wall, &Affine::identity());
        let mut wall_faces = instance.transform_depth(&mut wall_cache).bin_faces(&mut wall_bins)?;

        let width = self.area.size.width;
        let mut strip = vec![0; Frame::<C>::strip_bytes(width, rows)];
        let mut depths = vec![0; (width * rows) as usize];
        let mut frame = Frame::new(self.area, C::from_channels([0; 3]));
        while let Some(mut band) = frame.next_band(&mut strip)? {
            let mut depth = DepthBuffer::new(band.area(), &mut depths)?;
            let colours = |face: usize| WALL_FACES[face].map(|i| WALL_COLOURS[usize::from(i)]);
            wall_faces.depth_tested(|face| smooth(Gouraud::new(colours(face))), &mut depth, &mut band)?;
            let pot = |face| lit(Gouraud::lit(CLAY, pot.corners_of(face, &self.levels)));
            pot_faces.depth_tested(pot, &mut depth, &mut band)?;
            send(&band);
        }
        Ok(())
    }
}

/// Vertex normals: the mean of the normals of adjacent faces, weighted by area.
fn vertex_normals() -> Vec<[i16; 3]> {
    let mut sums = vec![[0i64; 3]; teapot::VERTICES.len()];
    for face in teapot::FACES {
        let [a, b, c] = face.map(|i| teapot::VERTICES[usize::from(i)].map(i64::from));
        let (u, v) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
        let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        for index in face {
            for (sum, part) in sums[usize::from(index)].iter_mut().zip(cross) {
                *sum += part;
            }
        }
    }
    let unit = |sum: [i64; 3]| {
        let length = sum.iter().map(|c| c * c).sum::<i64>().isqrt().max(1);
        sum.map(|c| (c * 32_767 / length) as i16)
    };
    sums.into_iter().map(unit).collect()
}
