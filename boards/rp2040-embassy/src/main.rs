//! An RP2040 with an ST7789 and a rotary encoder, by embassy: your model turns, drawn into one strip while DMA sends the other. The
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
use embassy_rp::clocks::ClockConfig;
use embassy_rp::gpio::{Input, Level, Output, Pull};
use embassy_rp::interrupt;
use embassy_rp::interrupt::{InterruptExt, Priority};
use embassy_rp::peripherals::{DMA_CH0, SPI0};
use embassy_rp::spi::{Async, Config, Phase, Polarity, Spi};
use embassy_rp::{bind_interrupts, dma};
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
    DMA_IRQ_0 => dma::InterruptHandler<DMA_CH0>;
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
unsafe fn SWI_IRQ_1() {
    // SAFETY: nothing else calls it, and `start` enables this interrupt.
    unsafe { URGENT.on_interrupt() }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    // The limit of the chip, at a core voltage of 1.15 V.
    let clocks = ClockConfig::system_freq(200_000_000).unwrap_or_else(|_| stop("no such clock"));
    let p = embassy_rp::init(embassy_rp::config::Config::new(clocks));
    let mut config = Config::default();
    config.frequency = 62_500_000; // the display's limit; of 200 MHz, 50 MHz can be made
    (config.polarity, config.phase) = (Polarity::IdleHigh, Phase::CaptureOnSecondTransition);
    let bus = Spi::new_txonly(p.SPI0, p.PIN_18, p.PIN_19, p.DMA_CH0, Interrupts, config);
    let select = Output::new(p.PIN_17, Level::High);
    let command = Output::new(p.PIN_20, Level::High);
    let reset = Output::new(p.PIN_21, Level::High);
    let panel = Panel::new(bus, select, command, reset, &mut Delay).unwrap_or_else(|problem| stop(problem));
    let contacts = [Input::new(p.PIN_10, Pull::Up), Input::new(p.PIN_11, Pull::Up)];
    let button = Input::new(p.PIN_12, Pull::Up);

    let Some(bands) = BANDS.try_take() else { stop("the strips are in use") };
    let Some(strips) = STRIPS.try_init_with(|| Strips::new(bands)) else { stop("the strips are in use") };
    let (empty, drawn) = strips.split();
    interrupt::SWI_IRQ_1.set_priority(Priority::P2);
    let (Ok(read), Ok(send), Ok(draw)) = (read(contacts, button), send(panel, drawn), draw(empty)) else {
        stop("a task runs already")
    };
    let urgent = URGENT.start(interrupt::SWI_IRQ_1);
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
    mut panel: Panel<Spi<'static, SPI0, Async>, Output<'static>>,
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
