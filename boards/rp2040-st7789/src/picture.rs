//! A frame of any closed mesh: lit, with depth, in bands that are sent while the next one is drawn. It draws the pixels of the
//! other boards' `picture.rs`.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor, WebColors};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    Affine, Angle, Band, BinnedFaces, Camera, DepthBuffer, Dim, Frame, Lambert, Mesh, MeshInstance,
    ScreenVertex, Statistics, Vector3, Viewport,
};

pub const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
/// Rows of a band: more are faster, and take more memory.
pub const ROWS: u32 = 8;
pub const BANDS: u32 = SCREEN.size.height / ROWS;
/// A transfer gives back what it sent: after a shorter band the strip would be shorter.
const _: () = assert!(SCREEN.size.height % ROWS == 0);
pub const FIRST_BAND: Rectangle = Rectangle::new(Point::zero(), Size::new(SCREEN.size.width, ROWS));

const BACKGROUND: Rgb565 = Rgb565::BLACK;
const COLOR: Rgb565 = Rgb565::CSS_GOLD;
/// Light on faces that are turned away from the lamp; full light is 256.
const AMBIENT: u16 = 48;

/// A mesh before its camera, and the memory of its drawing.
pub struct Picture<'a> {
    mesh: &'a Mesh<'a>,
    camera: Camera,
    instance: MeshInstance<'a>,
    cache: &'a mut [ScreenVertex],
    bins: &'a mut [u16],
    depths: &'a mut [u16],
}

/// The mesh of a frame, as far as it is drawn.
pub struct Turned<'a> {
    mesh: &'a Mesh<'a>,
    frame: Frame<Rgb565>,
    /// With depth.
    faces: BinnedFaces<'a, i16, true>,
    depths: &'a mut [u16],
    light: Lambert,
}

impl<'a> Picture<'a> {
    /// A camera to the right of the mesh and above it, which sees all of it however it is turned. The memory is a vertex cache
    /// and bins for the mesh, and the depths of a band.
    pub fn new(
        mesh: &'a Mesh<'a>,
        cache: &'a mut [ScreenVertex],
        bins: &'a mut [u16],
        depths: &'a mut [u16],
    ) -> Result<Self, &'static str> {
        let viewport = Viewport::new(SCREEN.top_left, SCREEN.size).map_err(|_| "the screen is too large")?;
        let (field_of_view, yaw, pitch) = (Angle::degrees(40), Angle::degrees(30), Angle::degrees(20));
        let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch)
            .map_err(|_| "the model is a point, or too large: see `fit` in build.rs")?;
        Ok(Self { mesh, instance: camera.place(mesh, &Affine::identity()), camera, cache, bins, depths })
    }

    /// A frame: vertices to the screen, visible faces into the bins of the bands.
    pub fn turned(&mut self, turn: Angle) -> Result<Turned<'_>, &'static str> {
        let model = Affine::rotation_y(turn);
        self.instance = self.camera.place(self.mesh, &model);
        let faces = self.instance.transform_depth(self.cache).bin_faces(self.bins);
        Ok(Turned {
            mesh: self.mesh,
            frame: Frame::new(SCREEN, BACKGROUND),
            faces: faces.map_err(|_| "no room for all faces: the bins are of another mesh")?,
            depths: self.depths,
            light: Lambert::new(&model, Vector3::from_ints(2, 3, 4), AMBIENT).map_err(|_| "no light")?,
        })
    }
}

impl Turned<'_> {
    /// The next of the frame's bands, drawn.
    pub fn next_band<'s>(&mut self, strip: &'s mut [u8]) -> Result<Band<'s, Rgb565>, &'static str> {
        let band = self.frame.next_band(strip).map_err(|_| "the strip is shorter than a row")?;
        let mut band = band.ok_or("more bands than the frame has")?;
        let depth = DepthBuffer::new(band.area(), self.depths);
        let mut depth = depth.map_err(|_| "fewer depths than pixels in the strip")?;
        let (mesh, light) = (self.mesh, &self.light);
        let level = |face: usize| mesh.normals().get(face).map_or(256, |&normal| light.level(normal));
        let Ok(()) = self.faces.depth_tested(|face| COLOR.dim(level(face)), &mut depth, &mut band.pixels());
        Ok(band)
    }

    pub fn statistics(&self) -> Statistics {
        self.faces.statistics()
    }
}
