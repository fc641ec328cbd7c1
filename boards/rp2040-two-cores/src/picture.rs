//! A frame of any closed mesh by two cores: lit, with depth, in strips that are sent while the next one is drawn. Of each strip the
//! first core draws the upper half and the second core the lower half. It draws the pixels of the other boards' `picture.rs`.

use crate::both_cores::OtherCore;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor, WebColors};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{prelude::*, Angle};

pub const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
/// Rows of a band: more are faster, and take more memory.
pub const ROWS: u32 = 8;
/// A strip has a band for each core.
pub const STRIPS: u32 = SCREEN.size.height / (2 * ROWS);
/// All strips are sent whole.
const _: () = assert!(SCREEN.size.height % (2 * ROWS) == 0);

const BACKGROUND: Rgb565 = Rgb565::BLACK;
/// Of a model without materials.
pub const COLOR: Rgb565 = Rgb565::CSS_GOLD;
/// Light on faces that are turned away from the lamp; full light is 256.
const AMBIENT: u16 = 48;

/// Where a strip lies on the screen.
pub const fn area(strip: u32) -> Rectangle {
    let rows = 2 * ROWS;
    Rectangle::new(Point::new(0, (strip * rows) as i32), Size::new(SCREEN.size.width, rows))
}

/// A mesh before its camera, and the memory of its drawing.
pub struct Picture<'a> {
    mesh: &'a Mesh<'a>,
    camera: Camera,
    memory: Memory<'a>,
}

/// A vertex cache and bins for a mesh, one number per 16 faces, and the depths of a band for each core.
pub struct Memory<'a> {
    pub cache: &'a mut [ScreenVertex],
    pub bins: &'a mut [u16],
    pub cursor: &'a mut [u16],
    pub depths: [&'a mut [u16]; 2],
}

impl<'a> Picture<'a> {
    /// A camera to the right of the mesh and above it, which sees all of it however it is turned.
    pub fn new(mesh: &'a Mesh<'a>, memory: Memory<'a>) -> Result<Self, &'static str> {
        let viewport = Viewport::new(SCREEN.top_left, SCREEN.size)
            .map_err(|_| "the screen has no pixels, or more than 8192 a side")?;
        let (field_of_view, yaw, pitch) = (Angle::degrees(40), Angle::degrees(30), Angle::degrees(20));
        let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch)
            .map_err(|_| "the model is a point, or too large: see `fit` in build.rs")?;
        Ok(Self { mesh, camera, memory })
    }

    /// Draws a frame into strip after strip. `color` gives the colour of each face at a level of light. `send` gets each with its number and returns the strip for the next one, in the end the
    /// one that is free.
    pub fn draw(
        &mut self,
        color: impl Fn(usize, u16) -> Rgb565 + Copy + Send + Sync,
        turn: Angle,
        other: &mut OtherCore,
        mut free: &'static mut [u8],
        mut send: impl FnMut(u32, &'static mut [u8]) -> &'static mut [u8],
    ) -> Result<(Statistics, &'static mut [u8]), &'static str> {
        let Self { mesh, camera, memory: Memory { cache, bins, cursor, depths: [depths, other_depths] } } =
            self;
        let model = Affine::rotation_y(turn);
        let light = Lambert::new(&model, Vector3::from_ints(2, 3, 4), AMBIENT).map_err(|_| "no light")?;
        let level = |face: usize| mesh.normals().get(face).map_or(256, |&normal| light.level(normal));
        let shade = |face: usize| color(face, level(face));

        // Vertices to the screen, visible faces into the bins of the bands.
        let instance = camera.place(mesh, &model);
        let transformed = instance.split_transform_depth(cache, |ours, theirs| other.both(ours, theirs));
        let faces = transformed.split_bin_faces(bins, |ours, theirs| other.both(ours, theirs));
        let mut faces = faces.map_err(|_| "no room for all faces: the bins are of another mesh")?;
        let statistics = faces.statistics();
        let forks = faces.fork(cursor);
        let [mut ours, mut theirs] = forks.map_err(|_| "the cursor is of another mesh")?;

        let frame = Frame::new(SCREEN, BACKGROUND);
        let draw = |band: u32, faces: &mut BinnedFaces<'_>, pixels: &mut [u8], depths: &mut [u16]| {
            let band = frame.nth_band(band, pixels).map_err(|_| "half a strip is shorter than a row")?;
            let mut band = band.ok_or("more bands than the frame has")?;
            let depth = DepthBuffer::new(band.area(), depths);
            let mut depth = depth.map_err(|_| "fewer depths than pixels in half a strip")?;
            let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(&mut depth));
            Ok::<(), &'static str>(())
        };
        for strip in 0..STRIPS {
            let (upper, lower) = free.split_at_mut(free.len() / 2);
            let (mut good, mut other_good) = (Ok(()), Ok(()));
            other.both(
                || good = draw(2 * strip, &mut ours, upper, depths),
                || other_good = draw(2 * strip + 1, &mut theirs, lower, other_depths),
            );
            good.and(other_good)?;
            free = send(strip, free);
        }
        Ok((statistics, free))
    }
}
