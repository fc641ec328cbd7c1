//! A balloon over misty fields, on an RP2040 with an ST7789: `cargo run --release --example balloon`. Each frame logs its time. Run on
//! an emulated RP2040, not on hardware.
#![no_std]
#![no_main]

#[path = "../../../common/rp2040/src/bus.rs"]
mod bus;
#[path = "../../../common/all/src/panel.rs"]
mod panel;
#[path = "../../../common/st7789/src/registers.rs"]
mod registers;
mod scene;
#[path = "../../../common/rp2040/src/stop.rs"]
mod stop;

use bus::Bus;
use core::ops::ControlFlow::{Break, Continue};
use cortex_m::singleton;
use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::{pixelcolor::Rgb565, primitives::Rectangle};
use embedded_hal::{delay::DelayNs, spi::MODE_3};
use panel::{Panel, WAKING};
use pinhole::prelude::*;
use rp2040_hal as hal;
use rp2040_hal::fugit::RateExtU32;
use rp2040_hal::{dma::DMAExt, gpio::Pins, pac, Clock as _, Sio, Spi, Timer, Watchdog};
use scene::{Buffers, Scene, MORNING, WAY};
use stop::stop;

/// The second stage of booting, for the flash on a Pico.
#[allow(unsafe_code)]
#[link_section = ".boot2"]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// Of the crystal.
const CRYSTAL: u32 = 12_000_000;
/// Frames until everything looks as before.
const FRAMES: i32 = 96;
/// Frames from one writing of the panel's registers to the next.
const REFRESH: i32 = 8;
const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
/// Rows of a band: more are faster, and take more memory.
const ROWS: u32 = 40;

#[hal::entry]
fn main() -> ! {
    // In statics, so that the linker says if they do not fit, and DMA may own the strips. The rest of RAM is the stack.
    let buffers = singleton!(: Buffers = Buffers::new());
    let strip = singleton!(: StripBuffers!(Rgb565, SCREEN.size.width, ROWS) = strip_buffers!(Rgb565, SCREEN.size.width, ROWS));
    let other = singleton!(: StripBuffers!(Rgb565, SCREEN.size.width, ROWS, no depth) = strip_buffers!(Rgb565, SCREEN.size.width, ROWS, no depth));
    let (Some(buffers), Some(strip), Some(other)) = (buffers, strip, other) else {
        stop("the buffers are in use")
    };

    let Some(mut p) = pac::Peripherals::take() else { stop("the peripherals are in use") };
    let mut watchdog = Watchdog::new(p.WATCHDOG);
    let clocks = hal::clocks::init_clocks_and_plls(
        CRYSTAL,
        p.XOSC,
        p.CLOCKS,
        p.PLL_SYS,
        p.PLL_USB,
        &mut p.RESETS,
        &mut watchdog,
    );
    let Ok(clocks) = clocks else { stop("the clocks do not start") };
    let timer = Timer::new(p.TIMER, &mut p.RESETS, &clocks);

    let pins = Pins::new(p.IO_BANK0, p.PADS_BANK0, Sio::new(p.SIO).gpio_bank0, &mut p.RESETS);
    let spi = Spi::<_, _, _, 8>::new(p.SPI0, (pins.gpio19.into_function(), pins.gpio18.into_function()))
        .init(&mut p.RESETS, clocks.peripheral_clock.freq(), 62_500_000.Hz(), MODE_3);
    let channel = p.DMA.split(&mut p.RESETS).ch0;
    let mut panel = Panel {
        bus: Bus::new(spi, channel, timer, &mut other.colors),
        select: pins.gpio17.into_push_pull_output().into_dyn_pin(),
        command: pins.gpio20.into_push_pull_output().into_dyn_pin(),
        reset: pins.gpio21.into_push_pull_output().into_dyn_pin(),
    };
    let mut delay = timer;
    panel.start(&mut delay).unwrap_or_else(|problem| stop(problem));

    let scene = Scene::<Rgb565>::new(SCREEN.size, &MORNING).unwrap_or_else(|problem| stop(problem));
    let mut free: &'static mut [u8] = &mut strip.colors;
    loop {
        for number in 0..FRAMES {
            let start = timer.get_counter_low();
            let view = scene.frame(number * WAY / FRAMES, buffers);
            let mut view = view.unwrap_or_else(|problem| stop(problem));
            let mut frame = Frame::<Rgb565>::new(SCREEN, MORNING.mist.into());
            free = loop {
                let band =
                    frame.band_or_strip(free).unwrap_or_else(|_| stop("the strip is shorter than a row"));
                let mut band = match band {
                    Break(strip) => break strip,
                    Continue(band) => band,
                };
                let depth = DepthBuffer::new(band.area(), &mut strip.depths);
                let mut depth = depth.unwrap_or_else(|_| stop("fewer depths than pixels in the strip"));
                let Ok(()) = view.draw(&mut depth, &mut band.pixels());
                let area = band.area();
                // The chip starts anew after an error of the bus.
                let bus = panel.window(&area).unwrap_or_else(|problem| stop(problem));
                free = bus.send(band.into_bytes());
            };
            if number % REFRESH == 0 {
                panel.refresh().unwrap_or_else(|problem| stop(problem));
                delay.delay_ms(WAKING);
            }
            let time = timer.get_counter_low().wrapping_sub(start);
            defmt::info!("frame {=i32}: {=u32} us", number, time);
        }
    }
}
