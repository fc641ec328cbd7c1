//! Drawing a frame without a framebuffer: in a blocking loop, with two strips and DMA, and in an async task. Each loop pulls
//! bands from a [`Frame`].
//!
//! ```text
//! cargo run --release --example bands
//! ```
//!
//! Transfers to the display take time here, as by SPI. The three pictures are equal; one is written to
//! `target/bands/bands.png`.

use clap::{value_parser, Command};
use embedded_graphics::mono_font::{ascii::FONT_9X15_BOLD, MonoTextStyle};
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::Text;
use pinhole::{prelude::*, Angle};
use pinhole_apps_support::{command, files, still};
use std::error::Error;
use std::future::Future;
use std::ops::ControlFlow::Continue;
use std::path::PathBuf;
use std::pin::pin;
use std::process::ExitCode;
use std::task::{Context, Poll, Waker};
use std::thread::{self, JoinHandle};

const SIZE: Size = Size::new(240, 240);
/// Rows of a band: a divisor of the height, so that DMA always sends whole strips.
const ROWS: u32 = 8;
const STRIP: usize = Frame::<Rgb565>::strip_bytes(SIZE.width, ROWS);

const TEAPOT: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES) else { panic!() };
    let Ok(mesh) = mesh.with_normals(&teapot::NORMALS) else { panic!() };
    mesh
};

/// The teapot, and all memory that drawing it needs, but for strips.
struct Scene {
    instance: MeshInstance<'static>,
    light: Lambert,
    buffers: MeshBuffers!(TEAPOT),
    depth: [u16; (SIZE.width * ROWS) as usize],
}

/// The contents of a frame, drawn into every band.
struct Contents<'a> {
    faces: BinnedFaces<'a, i16, true>,
    light: &'a Lambert,
    depth: &'a mut [u16],
}

impl Scene {
    fn new() -> Result<Self, Box<dyn Error>> {
        let viewport = Viewport::new(Point::zero(), SIZE)?;
        let (eye, origin) = (Point3::from_ints(0, 16, 32), Point3::from_ints(0, 0, 0));
        let view = ViewTransform::look_at(eye, origin, Vector3::from_ints(0, 1, 0))?;
        let projection =
            Projection::perspective(Angle::degrees(45), SIZE, Scalar::from_int(10), Scalar::from_int(60))?;
        let model = Affine::rotation_y(Angle::degrees(-25));
        Ok(Self {
            instance: Camera::new(&view, &projection, &viewport).place(&TEAPOT, &model),
            light: Lambert::new(&model, Vector3::from_ints(-4, 6, 5), 60)?,
            buffers: mesh_buffers!(TEAPOT),
            depth: [0; (SIZE.width * ROWS) as usize],
        })
    }

    /// Starts a frame: transforms every vertex and bins every face, once.
    fn begin_frame(&mut self) -> Result<(Frame<Rgb565>, Contents<'_>), Box<dyn Error>> {
        let MeshBuffers { cache, bins, .. } = &mut self.buffers;
        let faces = self.instance.transform_depth(cache).bin_faces(bins)?;
        let frame = Frame::new(Rectangle::new(Point::zero(), SIZE), Rgb565::new(2, 6, 5));
        Ok((frame, Contents { faces, light: &self.light, depth: &mut self.depth }))
    }
}

impl Contents<'_> {
    /// Draws a band: the teapot with the band's depth buffer, and the caption on top.
    fn draw(&mut self, band: &mut Band<'_, Rgb565>) -> Result<(), Box<dyn Error>> {
        let mut depth = DepthBuffer::new(band.area(), self.depth)?;
        let colour = |face: usize| Rgb565::new(31, 44, 14).dim(self.light.level(teapot::NORMALS[face]));
        let Ok(()) = self.faces.draw(colour, &mut band.depth_tested(&mut depth));
        let style = MonoTextStyle::new(&FONT_9X15_BOLD, Rgb565::WHITE);
        let Ok(_) = Text::new("7.5 KB of strips", Point::new(48, 224), style).draw(band);
        Ok(())
    }
}

/// A display that receives rectangles of pixels in wire order, as from its driver.
struct Display(Vec<Rgb565>);

impl Display {
    fn new() -> Self {
        // A colour that the picture does not have, so that a pixel that is not sent shows.
        Self(vec![Rgb565::MAGENTA; (SIZE.width * SIZE.height) as usize])
    }

    /// Sets the window and writes its bytes.
    fn receive(&mut self, area: &Rectangle, bytes: &[u8]) {
        let colours =
            bytes.chunks_exact(2).map(|b| Rgb565::from_bits(u16::from_be_bytes([b[0], b[1]]).into()));
        for (at, colour) in area.points().zip(colours) {
            self.0[(at.y as u32 * SIZE.width + at.x as u32) as usize] = colour;
        }
    }
}

/// The simplest loop: draw a band, send it, draw the next band into the same strip.
fn blocking(scene: &mut Scene, display: &mut Display) -> Result<(), Box<dyn Error>> {
    let mut strip = [0; STRIP];
    let (mut frame, mut contents) = scene.begin_frame()?;
    while let Some(mut band) = frame.next_band(&mut strip)? {
        contents.draw(&mut band)?;
        display.receive(&band.area(), band.bytes());
    }
    Ok(())
}

/// A transfer in progress, which owns the display and a strip until it is complete, as in HALs of microcontrollers.
type Transfer = JoinHandle<(Display, &'static mut [u8])>;

fn send(mut display: Display, area: Rectangle, bytes: &'static mut [u8]) -> Transfer {
    thread::spawn(move || {
        display.receive(&area, bytes);
        (display, bytes)
    })
}

/// Two strips: while DMA sends one, the next band is drawn into the other.
fn two_strips(scene: &mut Scene, display: Display) -> Result<Display, Box<dyn Error>> {
    let wait = |transfer: Transfer| transfer.join().map_err(|_| "the transfer failed");
    // In firmware these are two statics.
    let [mut free, other] = [0; 2].map(|_| Vec::leak(vec![0; STRIP]));
    let (mut frame, mut contents) = scene.begin_frame()?;
    // The loop starts with an empty transfer.
    let mut transfer = send(display, Rectangle::zero(), other);
    // After the last band the strip comes back: `free` would be drawn into in the next frame.
    while let Continue(mut band) = frame.band_or_strip(free)? {
        contents.draw(&mut band)?;
        let area = band.area();
        let bytes = band.into_bytes();
        let (display, sent) = wait(transfer)?;
        transfer = send(display, area, bytes);
        free = sent;
    }
    Ok(wait(transfer)?.0)
}

/// The blocking loop as an async task: other tasks run during transfers. [`block_on`] and this bus stand for an executor such as
/// embassy's and its SPI, with which the loop works unchanged.
async fn task(scene: &mut Scene, display: &mut Display) -> Result<(), Box<dyn Error>> {
    let mut strip = [0; STRIP];
    let (mut frame, mut contents) = scene.begin_frame()?;
    while let Some(mut band) = frame.next_band(&mut strip)? {
        contents.draw(&mut band)?;
        for _ in 0..band.bytes().len() / 1024 {
            let mut waited = false;
            let wait = |_: &mut Context<'_>| match std::mem::replace(&mut waited, true) {
                true => Poll::Ready(()),
                false => Poll::Pending,
            };
            std::future::poll_fn(wait).await;
        }
        display.receive(&band.area(), band.bytes());
    }
    Ok(())
}

/// The smallest executor: polls a task until it is done, and runs another task in between.
fn block_on<T>(task: impl Future<Output = T>, mut meanwhile: impl FnMut()) -> T {
    let mut context = Context::from_waker(Waker::noop());
    let mut task = pin!(task);
    loop {
        if let Poll::Ready(result) = task.as_mut().poll(&mut context) {
            return result;
        }
        meanwhile();
    }
}

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, Box<dyn Error>> {
        let out = command::option("out", "DIR", "The folder for the picture", "target/bands");
        let about =
            "Draws a frame in bands: in a blocking loop, by DMA with two strips, and in an async task";
        let command = Command::new("bands").about(about).arg(out.value_parser(value_parser!(PathBuf)));
        let out: PathBuf = command::matches(command)?.remove_one("out").unwrap_or_default();
        let mut scene = Scene::new()?;

        let (mut simple, mut waiting, mut others) = (Display::new(), Display::new(), 0);
        blocking(&mut scene, &mut simple)?;
        let by_dma = two_strips(&mut scene, Display::new())?;
        block_on(task(&mut scene, &mut waiting), || others += 1)?;
        command::say(format_args!("another task ran {others} times during the transfers of the async task"))?;
        if by_dma.0 != simple.0 || waiting.0 != simple.0 {
            return Err("the pictures differ".into());
        }
        command::folder(&out)?;
        let file = out.join("bands.png");
        let pixels: Vec<Rgb888> = simple.0.into_iter().map(Rgb888::from).collect();
        files::write(&[(&*file, still::png(SIZE, &pixels)?)])?;
        command::say(format_args!("{}: the same picture three times", file.display()))?;
        Ok(ExitCode::SUCCESS)
    })
}
