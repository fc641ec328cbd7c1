//! The memory, and two executors with their tasks.

use crate::chip::{self, Board, Input, Output, Watchdog};
use crate::input;
use crate::panel::Panel;
use crate::picture::{self, Picture, PIXELS};
use crate::stack;
use crate::stop::stop;
use crate::tasks::{self, Bus, Strip, Strips};
use embassy_executor::Executor;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::zerocopy_channel::{Receiver, Sender};
use embassy_time::Delay;
use pinhole::prelude::*;
use static_cell::{ConstStaticCell, StaticCell};

include!(concat!(env!("OUT_DIR"), "/model.rs"));

// In statics, so that the linker says if they do not fit. The rest of RAM is the stack.
static MESH: ConstStaticCell<MeshBuffers!(MODEL)> = ConstStaticCell::new(mesh_buffers!(MODEL));
static DEPTHS: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
/// Two are enough where all bands take equally long to draw. A third one evens out those that take longer.
static BANDS: ConstStaticCell<[Strip; 3]> = ConstStaticCell::new([const { Strip::EMPTY }; 3]);
static STRIPS: StaticCell<Strips> = StaticCell::new();

static EXECUTOR: StaticCell<Executor> = StaticCell::new();

/// Never ends: the thread draws, and an interrupt sends and reads the encoder.
pub fn run() -> ! {
    let Board { spi, select, command, reset, contacts, button, tearing, watchdog } = chip::start();
    stack::paint();
    let mut panel = Panel { bus: Bus(spi), select, command, reset };
    panel.start(&mut Delay).unwrap_or_else(|problem| stop(problem));

    let Some(bands) = BANDS.try_take() else { stop("the strips are in use") };
    let Some(strips) = STRIPS.try_init_with(|| Strips::new(bands)) else { stop("the strips are in use") };
    let (empty, drawn) = strips.split();
    let (Ok(read), Ok(send), Ok(draw)) =
        (read(contacts, button), send(panel, drawn, tearing), draw(empty, watchdog))
    else {
        stop("a task runs already")
    };
    let urgent = chip::urgent();
    urgent.spawn(read);
    urgent.spawn(send);
    let executor = EXECUTOR.try_init_with(Executor::new).unwrap_or_else(|| stop("the executor runs already"));
    executor.run(|spawner| spawner.spawn(draw))
}

/// Urgent, because the contacts of an encoder change every few milliseconds.
#[embassy_executor::task]
async fn read(contacts: [Input<'static>; 2], button: Input<'static>) {
    match input::read(contacts, button).await {}
}

/// Urgent, because it takes microseconds, and the bus waits for it.
#[embassy_executor::task]
async fn send(
    mut panel: Panel<Bus, Output<'static>>,
    drawn: Receiver<'static, CriticalSectionRawMutex, Strip>,
    mut tearing: Input<'static>,
) {
    match tasks::send(&mut panel, drawn, &mut tearing).await {}
}

#[embassy_executor::task]
async fn draw(empty: Sender<'static, CriticalSectionRawMutex, Strip>, mut watchdog: Watchdog) {
    let (Some(mesh), Some(depths)) = (MESH.try_take(), DEPTHS.try_take()) else {
        stop("the buffers are in use")
    };
    let picture = Picture::new(&MODEL, &mut mesh.cache, &mut mesh.bins, depths);
    let mut picture = picture.unwrap_or_else(|problem| stop(problem));
    // A constant: what the model does not have is left out when this is compiled.
    let color = |face: usize, level: u16| match MODEL_COLORS {
        Some(colors) => colors.lit(face, level),
        None => picture::COLOR.dim(level),
    };
    let Err(problem) = tasks::draw(&mut picture, color, empty, || watchdog.feed()).await;
    stop(problem)
}
