//! A frame of any closed mesh: lit, with depth, in bands. It knows no board: a host that includes this file draws the same
//! pixels, as `pinhole-render MODEL --firmware` does.

use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor, WebColors};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{prelude::*, Angle};

const BACKGROUND: Rgb565 = Rgb565::BLACK;
/// Of a model without materials.
pub const COLOR: Rgb565 = Rgb565::CSS_GOLD;
/// Light on faces that are turned away from the lamp; full light is 256.
const AMBIENT: u16 = 48;

/// The memory of a drawing: `mesh_buffers!` and `strip_buffers!` declare it.
pub struct Memory<'a> {
    cache: &'a mut [ScreenVertex],
    bins: &'a mut [u16],
    strip: &'a mut [u8],
    depths: &'a mut [u16],
}

impl<'a> Memory<'a> {
    /// A vertex cache and bins for the mesh, and a strip of some rows with the depths of its pixels.
    pub fn new(
        cache: &'a mut [ScreenVertex],
        bins: &'a mut [u16],
        strip: &'a mut [u8],
        depths: &'a mut [u16],
    ) -> Self {
        Self { cache, bins, strip, depths }
    }
}

/// A camera to the right of the mesh and above it, which sees all of it however it is turned.
pub fn camera(mesh: &Mesh<'_>, screen: Rectangle) -> Result<Camera, &'static str> {
    let viewport = Viewport::new(screen.top_left, screen.size)
        .map_err(|_| "the screen has no pixels, or more than 8192 a side")?;
    let (field_of_view, yaw, pitch) = (Angle::degrees(40), Angle::degrees(30), Angle::degrees(20));
    Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch)
        .map_err(|_| "the model is a point, or too large: see `fit` in build.rs")
}

/// What a frame was.
pub struct Drawn {
    pub statistics: Statistics,
    /// Of the pixels that were sent, without those of commands.
    pub bytes: u32,
}

/// Draws the mesh, turned about the y axis, band by band. `color` gives the colour of each face at a level of light. `send` gets the
/// rectangle of each band, and its pixels in wire order: row by row, the high byte of each first.
pub fn draw(
    mesh: &Mesh<'_>,
    color: impl Fn(usize, u16) -> Rgb565,
    camera: &Camera,
    turn: Angle,
    memory: &mut Memory<'_>,
    screen: Rectangle,
    mut send: impl FnMut(&Rectangle, &[u8]) -> Result<(), &'static str>,
) -> Result<Drawn, &'static str> {
    let model = Affine::rotation_y(turn);
    let light = Lambert::new(&model, Vector3::from_ints(2, 3, 4), AMBIENT).map_err(|_| "no light")?;
    let level = |face: usize| mesh.normals().get(face).map_or(256, |&normal| light.level(normal));

    // Once a frame: vertices to the screen, visible faces into the bins of the bands.
    let instance = camera.place(mesh, &model);
    let faces = instance.transform_depth(memory.cache).bin_faces(memory.bins);
    let mut faces = faces.map_err(|_| {
        "no room for all faces: the bins are of another mesh, or it has more than 65535 faces"
    })?;
    let mut frame = Frame::new(screen, BACKGROUND);
    let mut bytes = 0;
    while let Some(mut band) = frame.next_band(memory.strip).map_err(|_| "the strip is shorter than a row")? {
        let depth = DepthBuffer::new(band.area(), memory.depths);
        let mut depth = depth.map_err(|_| "fewer depths than pixels in the strip")?;
        let Ok(()) = faces.draw(|face| color(face, level(face)), &mut band.pixels().depth_tested(&mut depth));
        // Text and icons of embedded-graphics go on top here: a band is a DrawTarget.
        send(&band.area(), band.bytes())?;
        bytes += band.bytes().len() as u32; // of any display, less than 2³²
    }
    Ok(Drawn { statistics: faces.statistics(), bytes })
}
