//! A frame of any closed mesh: lit, with depth, and with a text on top of it. Everything that the display shows is computed here
//! from one number, the step of the turn.

use embedded_graphics::mono_font::{ascii::FONT_10X20, MonoTextStyle};
use embedded_graphics::pixelcolor::{Rgb565, RgbColor, WebColors};
use embedded_graphics::prelude::{Dimensions, Drawable, Point, Size};
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::{Alignment, Text};
use pinhole::{prelude::*, Angle};

pub const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
/// Rows of a band as wide as the screen: more are faster, and take more memory.
pub const ROWS: u32 = 32;
pub const PIXELS: usize = (SCREEN.size.width * ROWS) as usize;
/// Steps of a turn, of 3 degrees.
pub const STEPS: i32 = 120;

const BACKGROUND: Rgb565 = Rgb565::BLACK;
/// Of a model without materials.
pub const COLOR: Rgb565 = Rgb565::CSS_GOLD;
const TEXT: Rgb565 = Rgb565::WHITE;
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

/// The contents of a frame.
pub struct Turned<'a> {
    mesh: &'a Mesh<'a>,
    /// With depth.
    faces: BinnedFaces<'a>,
    depths: &'a mut [u16],
    light: Lambert,
    label: Label,
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
        let viewport = Viewport::new(SCREEN.top_left, SCREEN.size)
            .map_err(|_| "the screen has no pixels, or more than 8192 a side")?;
        let (field_of_view, yaw, pitch) = (Angle::degrees(40), Angle::degrees(30), Angle::degrees(20));
        let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch)
            .map_err(|_| "the model is a point, or too large: see `fit` in build.rs")?;
        Ok(Self { mesh, instance: camera.place(mesh, &Affine::identity()), camera, cache, bins, depths })
    }

    /// A frame: vertices to the screen, visible faces into the bins of the bands.
    pub fn turned(&mut self, step: i32) -> Result<Turned<'_>, &'static str> {
        let model = Affine::rotation_y(Angle::turns(step, STEPS as u32));
        self.instance = self.camera.place(self.mesh, &model);
        let faces = self.instance.transform_depth(self.cache).bin_faces(self.bins);
        Ok(Turned {
            mesh: self.mesh,
            faces: faces.map_err(|_| "no room for all faces: the bins are of another mesh")?,
            depths: self.depths,
            light: Lambert::new(&model, Vector3::from_ints(2, 3, 4), AMBIENT).map_err(|_| "no light")?,
            label: Label::new(step),
        })
    }
}

impl Turned<'_> {
    /// Rectangles around the mesh and around the text: nothing is drawn outside them.
    pub fn bounds(&self) -> [Rectangle; 2] {
        [self.faces.bounds(), self.label.text().bounding_box()]
    }

    /// The next band of a frame, drawn. `color` gives the colour of each face at a level of light.
    pub fn next_band<'s>(
        &mut self,
        color: impl Fn(usize, u16) -> Rgb565,
        frame: &mut Frame<Rgb565>,
        strip: &'s mut [u8],
    ) -> Result<Band<'s, Rgb565>, &'static str> {
        let band = frame.next_band(strip).map_err(|_| "the strip is shorter than a row")?;
        let mut band = band.ok_or("more bands than the frame has")?;
        let depth = DepthBuffer::new(band.area(), self.depths);
        let mut depth = depth.map_err(|_| "fewer depths than pixels in the strip")?;
        let (mesh, light) = (self.mesh, &self.light);
        let level = |face: usize| mesh.normals().get(face).map_or(256, |&normal| light.level(normal));
        let Ok(()) =
            self.faces.draw(|face| color(face, level(face)), &mut band.pixels().depth_tested(&mut depth));
        let text = self.label.text();
        let text_box = text.bounding_box();
        // Characters outside the band would cost their time all the same.
        if !text_box.intersection(&band.area()).is_zero_sized() {
            let Ok(_) = text.draw(&mut band);
        }
        Ok(band)
    }

    pub fn statistics(&self) -> Statistics {
        self.faces.statistics()
    }
}

/// A frame of the pixels of `area`.
pub fn frame(area: Rectangle) -> Frame<Rgb565> {
    Frame::new(area, BACKGROUND)
}

/// The angle in degrees, three digits: `core::fmt` would take several kilobytes.
struct Label([u8; 7]);

impl Label {
    fn new(step: i32) -> Self {
        let degrees = step % STEPS * (360 / STEPS);
        let digit = |power: i32| b'0' + (degrees / power % 10) as u8; // 0 to 9
        Self([digit(100), digit(10), digit(1), b' ', b'd', b'e', b'g'])
    }

    /// In the middle of the lower border.
    fn text(&self) -> Text<'_, MonoTextStyle<'static, Rgb565>> {
        let characters = core::str::from_utf8(&self.0).unwrap_or("");
        let at = Point::new(SCREEN.size.width as i32 / 2, SCREEN.size.height as i32 - 8);
        Text::with_alignment(characters, at, MonoTextStyle::new(&FONT_10X20, TEXT), Alignment::Center)
    }
}
