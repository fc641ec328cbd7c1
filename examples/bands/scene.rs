//! The teapot with a caption, and all memory that drawing it needs.

use embedded_graphics::mono_font::{ascii::FONT_9X15_BOLD, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::Text;
use pinhole::{
    Affine, Angle, Band, BinError, BinnedFaces, Camera, DepthBuffer, DepthBufferError, Dim, Frame, Lambert,
    Mesh, MeshInstance, Point3, Projection, Scalar, ScreenVertex, Vector3, ViewTransform, Viewport,
};
use std::error::Error;

pub(crate) const SIZE: Size = Size::new(240, 240);
/// Rows of a band: a divisor of the height, so that DMA always sends whole strips.
const ROWS: u32 = 8;
pub(crate) const STRIP: usize = Frame::<Rgb565>::strip_bytes(SIZE.width, ROWS);

const TEAPOT: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES) else { panic!() };
    let Ok(mesh) = mesh.with_normals(&teapot::NORMALS) else { panic!() };
    mesh
};
const VERTICES: usize = teapot::VERTICES.len();
/// Bin storage: the largest number of visible faces, and one entry for every 16 faces of the mesh.
const BIN_STORAGE: usize = 600 + teapot::FACES.len().div_ceil(16);

pub(crate) struct Scene {
    instance: MeshInstance<'static>,
    light: Lambert,
    cache: [ScreenVertex; VERTICES],
    bins: [u16; BIN_STORAGE],
    depth: [u16; (SIZE.width * ROWS) as usize],
}

/// The contents of a frame, drawn into every band.
pub(crate) struct Contents<'a> {
    faces: BinnedFaces<'a, i16, true>,
    light: &'a Lambert,
    depth: &'a mut [u16],
}

impl Scene {
    pub(crate) fn new() -> Result<Self, Box<dyn Error>> {
        let viewport = Viewport::new(Point::zero(), SIZE)?;
        let view = ViewTransform::look_at(
            Point3::from_ints(0, 16, 32),
            Point3::from_ints(0, 0, 0),
            Vector3::from_ints(0, 1, 0),
        )?;
        let projection =
            Projection::perspective(Angle::degrees(45), SIZE, Scalar::from_int(10), Scalar::from_int(60))?;
        let model = Affine::rotation_y(Angle::degrees(-25));
        Ok(Self {
            instance: Camera::new(&view, &projection, &viewport).place(&TEAPOT, &model),
            light: Lambert::new(&model, Vector3::from_ints(-4, 6, 5), 60)?,
            cache: [ScreenVertex::EMPTY; VERTICES],
            bins: [0; BIN_STORAGE],
            depth: [0; (SIZE.width * ROWS) as usize],
        })
    }

    /// Starts a frame: transforms every vertex and bins every face, once.
    pub(crate) fn begin_frame(&mut self) -> Result<(Frame<Rgb565>, Contents<'_>), BinError> {
        let faces = self.instance.transform_depth(&mut self.cache).bin_faces(&mut self.bins)?;
        let frame = Frame::new(Rectangle::new(Point::zero(), SIZE), Rgb565::new(2, 6, 5));
        Ok((frame, Contents { faces, light: &self.light, depth: &mut self.depth }))
    }
}

impl Contents<'_> {
    /// Draws a band: the teapot with the band's depth buffer, and the caption on top.
    pub(crate) fn draw(&mut self, band: &mut Band<'_, Rgb565>) -> Result<(), DepthBufferError> {
        let mut depth = DepthBuffer::new(band.area(), self.depth)?;
        let colour = |face: usize| Rgb565::new(31, 44, 14).dim(self.light.level(teapot::NORMALS[face]));
        let Ok(()) = self.faces.depth_tested(colour, &mut depth, band);
        let style = MonoTextStyle::new(&FONT_9X15_BOLD, Rgb565::WHITE);
        let Ok(_) = Text::new("7.5 KB of strips", Point::new(48, 224), style).draw(band);
        Ok(())
    }
}
