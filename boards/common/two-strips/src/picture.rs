//! A frame of any closed mesh: lit, with depth, in bands of what has changed, sent while the next one is drawn. It draws the pixels of the
//! other boards' `picture.rs`.

use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor, WebColors};
use embedded_graphics_core::{geometry::Size, primitives::Rectangle};
use pinhole::{prelude::*, Angle};

pub const BACKGROUND: Rgb565 = Rgb565::BLACK;
/// Of a model without materials.
pub const COLOR: Rgb565 = Rgb565::CSS_GOLD;
/// Light on faces that are turned away from the lamp; full light is 256.
const AMBIENT: u16 = 48;

/// A mesh before its camera, and the memory of its drawing.
pub struct Picture<'a> {
    mesh: &'a Mesh<'a>,
    screen: Rectangle,
    /// The rectangle around the mesh that the display shows; `None` if it may show anything.
    pub shown: Option<Rectangle>,
    camera: Camera,
    instance: MeshInstance<'a>,
    cache: &'a mut [ScreenVertex],
    bins: &'a mut [u16],
    depths: &'a mut [u16],
}

/// The mesh of a frame, as far as it is drawn.
pub struct Turned<'a> {
    mesh: &'a Mesh<'a>,
    /// The size of the part of the area that is not drawn yet.
    left: Size,
    frame: Frame<Rgb565>,
    /// With depth.
    faces: BinnedFaces<'a>,
    depths: &'a mut [u16],
    light: Lambert,
}

impl<'a> Picture<'a> {
    /// A camera to the right of the mesh and above it, which sees all of it however it is turned, on a panel that may be mounted
    /// turned. The memory is a vertex cache and bins for the mesh, and the depths of a band.
    pub fn new(
        mesh: &'a Mesh<'a>,
        screen: Rectangle,
        rotation: pinhole::camera::Rotation,
        cache: &'a mut [ScreenVertex],
        bins: &'a mut [u16],
        depths: &'a mut [u16],
    ) -> Result<Self, &'static str> {
        let viewport = Viewport::new(screen.top_left, screen.size)
            .map_err(|_| "the screen has no pixels, or more than 8192 a side")?
            .rotated(rotation);
        let (field_of_view, yaw, pitch) = (Angle::degrees(40), Angle::degrees(30), Angle::degrees(20));
        let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch)
            .map_err(|_| "the model is a point, or too large: see `fit` in build.rs")?;
        let instance = camera.place(mesh, &Affine::identity());
        Ok(Self { mesh, screen, shown: None, camera, instance, cache, bins, depths })
    }

    /// A frame: vertices to the screen, visible faces into the bins of the bands. Its bands are those of the rectangle around the mesh, as
    /// it is shown and as it will be.
    pub fn turned(&mut self, turn: Angle) -> Result<Turned<'_>, &'static str> {
        let model = Affine::rotation_y(turn);
        self.instance = self.camera.place(self.mesh, &model);
        let faces = self.instance.transform_depth(self.cache).bin_faces(self.bins);
        let faces = faces.map_err(|_| {
            "no room for all faces: the bins are of another mesh, or it has more than 65535 faces"
        })?;
        let bounds = faces.bounds();
        let area = self.shown.replace(bounds).map_or(self.screen, |shown| around(shown, bounds));
        Ok(Turned {
            mesh: self.mesh,
            left: area.size,
            frame: Frame::new(area, BACKGROUND),
            faces,
            depths: self.depths,
            light: Lambert::new(&model, Vector3::from_ints(2, 3, 4), AMBIENT).map_err(|_| "no light")?,
        })
    }
}

/// The smallest rectangle that contains two others.
fn around(a: Rectangle, b: Rectangle) -> Rectangle {
    let last = |rectangle: Rectangle| rectangle.bottom_right().unwrap_or(rectangle.top_left);
    Rectangle::with_corners(a.top_left.component_min(b.top_left), last(a).component_max(last(b)))
}

impl Turned<'_> {
    /// The next band of the frame, drawn, or `None` after the last one. `color` gives the colour of each face at a level of light.
    pub fn next_band<'s>(
        &mut self,
        color: impl Fn(usize, u16) -> Rgb565,
        strip: &'s mut [u8],
    ) -> Result<Option<Band<'s, Rgb565>>, &'static str> {
        // The first band has the rows that are left over: while the last one is sent, the next frame begins.
        let row = Frame::<Rgb565>::strip_bytes(self.left.width, 1).max(1);
        let rows = self.left.height.saturating_sub(1) as usize % (strip.len() / row).max(1) + 1;
        self.left.height = self.left.height.saturating_sub(rows as u32); // at most the height, unless it is 0
        let strip = strip.get_mut(..rows * row).unwrap_or_default(); // no more than fit
        let band = self.frame.next_band(strip).map_err(|_| "the strip is shorter than a row")?;
        let Some(mut band) = band else { return Ok(None) };
        let depth = DepthBuffer::new(band.area(), self.depths);
        let mut depth = depth.map_err(|_| "fewer depths than pixels in the strip")?;
        let (mesh, light) = (self.mesh, &self.light);
        let level = |face: usize| mesh.normals().get(face).map_or(256, |&normal| light.level(normal));
        let Ok(()) =
            self.faces.draw(|face| color(face, level(face)), &mut band.pixels().depth_tested(&mut depth));
        // Text and icons of embedded-graphics go on top here: a band is a DrawTarget. What they change must be in the bounds.
        Ok(Some(band))
    }

    pub fn statistics(&self) -> Statistics {
        self.faces.statistics()
    }
}
