//! An STM32F411 with an SSD1306 on I2C and a rotary encoder, by embassy: your model turns as a line drawing without hidden lines. The
//! encoder turns it too, a press stops it, and only what has changed is sent. Each frame logs its time, the bytes sent and what
//! was drawn.
#![no_std]
#![no_main]

mod clocks;
#[path = "../../common/embassy/src/input.rs"]
mod input;
mod picture;
mod show;
#[path = "../../common/all/src/stack.rs"]
mod stack;
#[path = "../../common/all/src/stop.rs"]
mod stop;

use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embassy_executor::Executor;
use embassy_stm32::gpio::{Input, Pull};
use embassy_stm32::i2c::{self, I2c, Master};
use embassy_stm32::mode::Async;
use embassy_stm32::peripherals::{DMA1_CH0, DMA1_CH6, I2C1, IWDG};
use embassy_stm32::time::Hertz;
use embassy_stm32::wdg::IndependentWatchdog;
use embassy_stm32::{bind_interrupts, dma};
use picture::{Picture, PIXELS};
use pinhole::{mesh_buffers, MeshBuffers};
use ssd1306::{prelude::*, I2CDisplayInterface, Ssd1306Async};
use static_cell::{ConstStaticCell, StaticCell};
use stop::stop;

include!(concat!(env!("OUT_DIR"), "/model.rs"));

bind_interrupts!(struct Interrupts {
    I2C1_EV => i2c::EventInterruptHandler<I2C1>;
    I2C1_ER => i2c::ErrorInterruptHandler<I2C1>;
    DMA1_STREAM6 => dma::InterruptHandler<DMA1_CH6>;
    DMA1_STREAM0 => dma::InterruptHandler<DMA1_CH0>;
});

/// The chip is reset when a frame takes longer, in microseconds; 0: no watchdog.
const WATCHDOG: u32 = 2_000_000;

// In statics, so that the linker says if they do not fit. The rest of RAM is the stack.
static MESH: ConstStaticCell<MeshBuffers!(faces, edges: MODEL)> =
    ConstStaticCell::new(mesh_buffers!(faces, edges: MODEL));
static DEPTHS: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static EXECUTOR: StaticCell<Executor> = StaticCell::new();

#[cortex_m_rt::entry]
fn main() -> ! {
    let p = embassy_stm32::init(clocks::config());
    stack::paint();
    let mut watchdog = IndependentWatchdog::new(p.IWDG, WATCHDOG.max(1000));
    if WATCHDOG > 0 {
        watchdog.unleash();
    }
    let mut config = i2c::Config::default();
    config.frequency = Hertz::khz(400);
    let bus = I2c::new(p.I2C1, p.PB6, p.PB7, p.DMA1_CH6, p.DMA1_CH0, Interrupts, config);
    let contacts = [Input::new(p.PA1, Pull::Up), Input::new(p.PA2, Pull::Up)];
    let button = Input::new(p.PA0, Pull::Up);

    let (Ok(read), Ok(show)) = (read(contacts, button), show(bus, watchdog)) else {
        stop("a task runs already")
    };
    let executor = EXECUTOR.try_init_with(Executor::new).unwrap_or_else(|| stop("the executor runs already"));
    executor.run(|spawner| {
        spawner.spawn(read);
        spawner.spawn(show);
    })
}

#[embassy_executor::task]
async fn read(contacts: [Input<'static>; 2], button: Input<'static>) {
    match input::read(contacts, button).await {}
}

#[embassy_executor::task]
async fn show(bus: I2c<'static, Async, Master>, mut watchdog: IndependentWatchdog<'static, IWDG>) {
    let (Some(mesh), Some(depths)) = (MESH.try_take(), DEPTHS.try_take()) else {
        stop("the buffers are in use")
    };
    let picture = Picture::new(&MODEL, &mut mesh.cache, [&mut mesh.bins, &mut mesh.edge_bins], depths);
    let mut picture = picture.unwrap_or_else(|problem| stop(problem));
    let bus = show::KeptOn(I2CDisplayInterface::new(bus));
    let display = Ssd1306Async::new(bus, DisplaySize128x64, DisplayRotation::Rotate0);
    let mut display = display.into_buffered_graphics_mode();
    let Err(problem) = show::show(&mut display, &mut picture, || watchdog.pet()).await;
    stop(problem)
}
