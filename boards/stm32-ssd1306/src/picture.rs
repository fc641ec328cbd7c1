//! A frame of any closed mesh: its edges, without those that its own faces hide, and with a text on top. Everything that the display
//! shows is computed here from one number, the step of the turn.

use embedded_graphics::mono_font::{ascii::FONT_6X10, MonoTextStyle};
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::{Dimensions, Drawable, Point, Size};
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::{Baseline, Text};
use pinhole::{draw::BinnedEdges, prelude::*, Angle};

pub const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(128, 64));
/// Rows of a band as wide as the screen.
pub const ROWS: u32 = 16;
pub const PIXELS: usize = (SCREEN.size.width * ROWS) as usize;
/// Steps of a turn, of 3 degrees.
pub const STEPS: i32 = 120;

/// A mesh before its camera, and the memory of its drawing.
pub struct Picture<'a> {
    mesh: &'a Mesh<'a>,
    camera: Camera,
    instance: MeshInstance<'a>,
    cache: &'a mut [ScreenVertex],
    face_bins: &'a mut [u16],
    edge_bins: &'a mut [u16],
    depths: &'a mut [u16],
}

/// The contents of a frame.
pub struct Turned<'a> {
    /// With depth.
    faces: BinnedFaces<'a>,
    edges: BinnedEdges<'a>,
    depths: &'a mut [u16],
    label: Label,
}

impl<'a> Picture<'a> {
    /// A camera to the right of the mesh and above it, which sees all of it however it is turned. The memory is a vertex cache
    /// and bins for the mesh, and the depths of a band.
    pub fn new(
        mesh: &'a Mesh<'a>,
        cache: &'a mut [ScreenVertex],
        [face_bins, edge_bins]: [&'a mut [u16]; 2],
        depths: &'a mut [u16],
    ) -> Result<Self, &'static str> {
        let viewport = Viewport::new(SCREEN.top_left, SCREEN.size)
            .map_err(|_| "the screen has no pixels, or more than 8192 a side")?;
        let (field_of_view, yaw, pitch) = (Angle::degrees(40), Angle::degrees(30), Angle::degrees(20));
        let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch)
            .map_err(|_| "the model is a point, or too large: see `fit` in build.rs")?;
        let instance = camera.place(mesh, &Affine::identity());
        Ok(Self { mesh, instance, camera, cache, face_bins, edge_bins, depths })
    }

    /// A frame: vertices to the screen, visible faces and edges into the bins of the bands.
    pub fn turned(&mut self, step: i32) -> Result<Turned<'_>, &'static str> {
        self.instance = self.camera.place(self.mesh, &Affine::rotation_y(Angle::turns(step, STEPS as u32)));
        let transformed = self.instance.transform_depth(self.cache);
        let faces = transformed.bin_faces(self.face_bins);
        let edges = transformed.bin_edges(self.edge_bins);
        Ok(Turned {
            faces: faces.map_err(|_| "no room for all faces: the bins are of another mesh")?,
            edges: edges.map_err(|_| "no room for all edges: the bins are of another mesh")?,
            depths: self.depths,
            label: Label::new(step),
        })
    }
}

impl Turned<'_> {
    /// Rectangles around the mesh and around the text: nothing is drawn outside them.
    pub fn bounds(&self) -> [Rectangle; 2] {
        [self.edges.bounds(), self.label.text().bounding_box()]
    }

    /// The next band of a frame, drawn.
    pub fn next_band<'s>(
        &mut self,
        frame: &mut Frame<BinaryColor>,
        strip: &'s mut [u8],
    ) -> Result<Band<'s, BinaryColor>, &'static str> {
        let band = frame.next_band(strip).map_err(|_| "the strip is shorter than a row")?;
        let mut band = band.ok_or("more bands than the frame has")?;
        let depth = DepthBuffer::new(band.area(), self.depths);
        let mut depth = depth.map_err(|_| "fewer depths than pixels in the strip")?;
        self.faces.depth_only(&mut depth);
        let Ok(()) = self.edges.hidden_line(BinaryColor::On, &mut band.depth_tested(&mut depth));
        let Ok(_) = self.label.text().draw(&mut band);
        Ok(band)
    }

    pub fn statistics(&self) -> Statistics {
        self.edges.statistics()
    }
}

/// A frame of the pixels of `area`.
pub fn frame(area: Rectangle) -> Frame<BinaryColor> {
    Frame::new(area, BinaryColor::Off)
}

/// The angle in degrees, three digits: `core::fmt` would take several kilobytes.
struct Label([u8; 3]);

impl Label {
    fn new(step: i32) -> Self {
        let degrees = step % STEPS * (360 / STEPS);
        let digit = |power: i32| b'0' + (degrees / power % 10) as u8; // 0 to 9
        Self([digit(100), digit(10), digit(1)])
    }

    /// In the upper left corner.
    fn text(&self) -> Text<'_, MonoTextStyle<'static, BinaryColor>> {
        let characters = core::str::from_utf8(&self.0).unwrap_or("");
        let style = MonoTextStyle::new(&FONT_6X10, BinaryColor::On);
        Text::with_baseline(characters, Point::zero(), style, Baseline::Top)
    }
}
