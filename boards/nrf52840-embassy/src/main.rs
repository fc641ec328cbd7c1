//! An nRF52840 with an ST7789 and a rotary encoder, by embassy: your model turns, drawn into one strip while DMA sends the other. The
//! encoder turns it too, a press stops it, and nothing is sent while nothing changes. Each frame logs its time, the bytes sent and
//! what was drawn.
#![no_std]
#![no_main]

mod input;
mod panel;
mod picture;
mod stop;
mod tasks;

use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embassy_executor::{Executor, InterruptExecutor};
use embassy_nrf::gpio::{Input, Level, Output, OutputDrive, Pull};
use embassy_nrf::interrupt;
use embassy_nrf::interrupt::{InterruptExt, Priority};
use embassy_nrf::spim::{Config, Frequency, InterruptHandler, Spim, MODE_3};
use embassy_nrf::{bind_interrupts, peripherals::SPI3};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::zerocopy_channel::{Receiver, Sender};
use embassy_time::Delay;
use panel::Panel;
use picture::{Picture, PIXELS};
use pinhole::{mesh_buffers, Dim, MeshBuffers};
use static_cell::{ConstStaticCell, StaticCell};
use stop::stop;
use tasks::{Strip, Strips};

include!(concat!(env!("OUT_DIR"), "/model.rs"));

bind_interrupts!(struct Interrupts {
    SPIM3 => InterruptHandler<SPI3>;
});

// In statics, so that the linker says if they do not fit. The rest of RAM is the stack.
static MESH: ConstStaticCell<MeshBuffers!(MODEL)> = ConstStaticCell::new(mesh_buffers!(MODEL));
static DEPTHS: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
/// Two are enough where all bands take equally long to draw. A third one evens out those that take longer.
static BANDS: ConstStaticCell<[Strip; 3]> = ConstStaticCell::new([const { Strip::EMPTY }; 3]);
static STRIPS: StaticCell<Strips> = StaticCell::new();

static EXECUTOR: StaticCell<Executor> = StaticCell::new();
/// For tasks that do not wait until a band is drawn: an interrupt runs them.
static URGENT: InterruptExecutor = InterruptExecutor::new();

#[allow(unsafe_code)]
#[interrupt]
unsafe fn EGU0_SWI0() {
    // SAFETY: nothing else calls it, and `start` enables this interrupt.
    unsafe { URGENT.on_interrupt() }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut config = embassy_nrf::config::Config::default();
    config.time_interrupt_priority = Priority::P2;
    let p = embassy_nrf::init(config);
    let mut config = Config::default();
    (config.frequency, config.mode) = (Frequency::M32, MODE_3);
    // Of all SPIs, only this one is as fast.
    interrupt::SPIM3.set_priority(Priority::P2);
    let bus = Spim::new_txonly(p.SPI3, Interrupts, p.P0_13, p.P0_14, config);
    let select = Output::new(p.P0_15, Level::High, OutputDrive::Standard);
    let command = Output::new(p.P0_16, Level::High, OutputDrive::Standard);
    let reset = Output::new(p.P0_17, Level::High, OutputDrive::Standard);
    let panel = Panel::new(bus, select, command, reset, &mut Delay).unwrap_or_else(|problem| stop(problem));
    let contacts = [Input::new(p.P0_26, Pull::Up), Input::new(p.P0_27, Pull::Up)];
    let button = Input::new(p.P0_02, Pull::Up);

    let Some(bands) = BANDS.try_take() else { stop("the strips are in use") };
    let Some(strips) = STRIPS.try_init_with(|| Strips::new(bands)) else { stop("the strips are in use") };
    let (empty, drawn) = strips.split();
    interrupt::EGU0_SWI0.set_priority(Priority::P3);
    let (Ok(read), Ok(send), Ok(draw)) = (read(contacts, button), send(panel, drawn), draw(empty)) else {
        stop("a task runs already")
    };
    let urgent = URGENT.start(interrupt::EGU0_SWI0);
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
    mut panel: Panel<Spim<'static>, Output<'static>>,
    drawn: Receiver<'static, CriticalSectionRawMutex, Strip>,
) {
    match tasks::send(&mut panel, drawn).await {}
}

#[embassy_executor::task]
async fn draw(empty: Sender<'static, CriticalSectionRawMutex, Strip>) {
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
    let Err(problem) = tasks::draw(&mut picture, color, empty).await;
    stop(problem)
}
