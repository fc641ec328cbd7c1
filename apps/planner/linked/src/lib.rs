//! What all images share: a display that takes pixels and shows nothing, the camera of the templates, and counting the
//! instructions of frames.
//!
//! The environment variable `PLANNER_MODELS` names a folder with one file per image, of the image's name. The file has the
//! image's mesh and sizes: the constants `MODEL`, `WIDTH`, `HEIGHT`, `ROWS`, `SIDE` (in texels) and `SHADING`, the type
//! `Color` of the display's colours, and the constant `WHITE` of it.
#![no_std]

use bench::board::{println, Clock};
use core::convert::Infallible;
use core::marker::PhantomData;
use embedded_graphics_core::pixelcolor::{PixelColor, Rgb888};
use embedded_graphics_core::Pixel;

// The names that the images use.
pub use core::hint::black_box;
pub use embedded_graphics_core::draw_target::DrawTarget;
pub use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
pub use embedded_graphics_core::pixelcolor::{BinaryColor, Rgb565, RgbColor};
pub use embedded_graphics_core::primitives::Rectangle;
pub use pinhole::{color::Color as _, prelude::*, texture::IndexedTexels, Angle};

/// The colour of the model.
pub const COLOR: Rgb565 = Rgb565::new(31, 52, 14);
/// The colour of the model, for shaders.
pub const LIT: Rgb888 = Rgb888::new(255, 215, 0);

/// A display that shows nothing: drivers are not part of what is measured.
pub struct Display<C> {
    size: Size,
    color: PhantomData<C>,
}

impl<C> Display<C> {
    /// A display of a size that the compiler does not know.
    pub fn new(width: u32, height: u32) -> Self {
        Self { size: black_box(Size::new(width, height)), color: PhantomData }
    }
}

impl<C> OriginDimensions for Display<C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: PixelColor> DrawTarget for Display<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        if black_box(false) {
            pixels.into_iter().for_each(|pixel| _ = black_box(pixel));
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        black_box(area);
        // The code that sends is in the image but not executed: the page computes the time of the bus.
        if black_box(false) {
            colors.into_iter().for_each(|color| _ = black_box(color));
        }
        Ok(())
    }
}

/// A camera that sees all of a mesh however it is turned, as the templates make it.
#[inline(never)]
pub fn camera(mesh: &Mesh<'_>, size: Size) -> Option<Camera> {
    let viewport = Viewport::new(Point::zero(), size).ok()?;
    let [field_of_view, yaw, pitch] = [40, 30, 20].map(Angle::degrees);
    Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch).ok()
}

/// The lamp of the templates, for a model that is turned.
pub fn light(model: &Affine<pinhole::space::Model, pinhole::space::World>) -> Option<Lambert> {
    Lambert::new(model, Vector3::from_ints(2, 3, 4), 48).ok()
}

/// The light level of a face.
pub fn level(mesh: &Mesh<'_>, light: &Lambert, face: usize) -> u16 {
    mesh.normals().get(face).map_or(256, |&normal| light.level(normal))
}

/// [`bench::growth::coordinates`] of a face.
pub fn coordinates(mesh: &Mesh<'_>, face: usize) -> [[i16; 2]; 3] {
    bench::growth::coordinates(mesh, face, mesh.normals().get(face).copied().unwrap_or_default())
}

/// All of a display, or of a picture.
pub fn area(display: &impl OriginDimensions) -> Rectangle {
    Rectangle::new(Point::zero(), display.size())
}

/// The exponent of the planner's own texture coordinates, which [`coordinates`] computes.
pub use bench::growth::UNIT;

/// The steps of a turn that are drawn and counted, of 120.
pub const TURNS: [i32; 2] = [0, 23];

/// A firmware that draws a model in the directions of [`TURNS`] and prints a line `turn,instructions` for each. The arguments are
/// the variables, each in a static of its own, and the function that draws a frame. The constants of the image's file are in scope.
#[macro_export]
macro_rules! firmware {
    (|$camera:ident, $turn:ident, $display:ident: $color:ty| $($name:ident: $type:ty = $start:expr,)* $body:block) => {
        include!(concat!(env!("PLANNER_MODELS"), "/", env!("CARGO_BIN_NAME"), ".rs"));

        #[inline(never)]
        fn frame(
            $camera: &pinhole::Camera,
            $turn: pinhole::Angle,
            $display: &mut $crate::Display<$color>,
            $($name: &mut $type,)*
        ) -> Option<()> $body

        fn run() -> Option<()> {
            $(
                #[allow(non_upper_case_globals)] // the name is the argument's
                static mut $name: $type = $start;
            )*
            let mut display = $crate::Display::new(WIDTH, HEIGHT);
            let size = embedded_graphics_core::geometry::OriginDimensions::size(&display);
            let camera = $crate::camera(&MODEL, size)?;
            $crate::counted(&mut |turn| {
                // SAFETY: frames are drawn one after the other, each returns before the next, and nothing else names the variables.
                unsafe { frame(&camera, turn, &mut display, $(&mut *(&raw mut $name),)*) }
            })
        }

        $crate::start!(run());
    };
}

/// The entry point of a firmware, whose body returns `None` if it fails.
#[macro_export]
macro_rules! start {
    ($run:expr) => {
        #[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
        #[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
        fn main() -> ! {
            bench::board::end($run.is_some())
        }
    };
}

/// Draws frames and prints their instructions.
pub fn counted(frame: &mut dyn FnMut(Angle) -> Option<()>) -> Option<()> {
    let mut clock = Clock::new()?;
    for turn in TURNS {
        let mut done = None;
        let instructions = clock.count(&mut || done = frame(Angle::turns(turn, 120)))?;
        done?;
        println!("{turn},{instructions}");
    }
    Some(())
}

/// A firmware that draws faces with depth in bands, as the templates do, in the shading that the image is named for: into the target that
/// `$target` makes of a `$band`.
#[macro_export]
macro_rules! depth_bands {
    (|$band:ident| $target:expr) => {
        static TEXELS: [u8; SIDE * SIDE] = [1; SIDE * SIDE];
        static PALETTE: [Color; 256] = [WHITE; 256];

        $crate::firmware!(|camera, turn, display: Color|
            mesh: MeshBuffers!(MODEL) = mesh_buffers!(MODEL),
            strip: StripBuffers!(Color, WIDTH, ROWS) = strip_buffers!(Color, WIDTH, ROWS),
            {
                let model = Affine::rotation_y(turn);
                let light = light(&model)?;
                let level = |face| level(&MODEL, &light, face);
                let smooth = |face| {
                    let normals = MODEL.corners_of(face, MODEL.vertex_normals());
                    Gouraud::lit(LIT, normals.map(|normal| light.level(normal)))
                };
                let texture = Texture::new(IndexedTexels::<_, 8>::new(&TEXELS, SIDE, SIDE, &PALETTE).ok()?);
                let texture = texture.with_exponent(UNIT).ok()?;
                let instance = camera.place(&MODEL, &model);
                let mut faces = instance.transform_depth(&mut mesh.cache).bin_faces(&mut mesh.bins).ok()?;
                let mut frame = Frame::new(area(display), Color::from(BinaryColor::Off));
                while let Some(mut band) = frame.next_band(&mut strip.colors).ok()? {
                    let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).ok()?;
                    let (depth, $band) = (&mut depth, &mut band);
                    let target = $target;
                    let Ok(()) = match SHADING {
                        "flat" => faces.draw(|face| Color::from(LIT).dim(level(face)), &mut target.depth_tested(depth)),
                        "smooth" => faces.draw(smooth, &mut target.depth_tested(depth)),
                        "dithered" => faces.draw(|face| Dithered(Flat::lit(LIT, level(face))), &mut target.depth_tested(depth)),
                        "smooth dithered" => faces.draw(|face| Dithered(smooth(face)), &mut target.depth_tested(depth)),
                        _ => {
                            let shade = |face| texture.at(coordinates(&MODEL, face)).lit([level(face); 3]);
                            faces.draw(shade, &mut target.depth_tested(depth))
                        }
                    };
                    band.send(display).ok()?;
                }
                Some(())
            }
        );
    };
}
