//! An RP2040 with an ST7789 on SPI: your model turns, drawn into one strip while DMA sends the other, and each frame logs its time
//! and what was drawn. Run on an emulated RP2040, not on hardware.
#![no_std]
#![no_main]

#[path = "../../common/rp2040/src/bus.rs"]
mod bus;
#[path = "../../common/all/src/panel.rs"]
mod panel;
#[path = "../../common/two-strips/src/picture.rs"]
mod picture;
#[path = "../../common/st7789/src/registers.rs"]
mod registers;
#[path = "../../common/all/src/stack.rs"]
mod stack;
#[path = "../../common/rp2040/src/stop.rs"]
mod stop;

use bus::Bus;
use core::cell::{Ref, RefCell};
use cortex_m::singleton;
use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::{pixelcolor::Rgb565, primitives::Rectangle};
use embedded_hal::{delay::DelayNs, spi::MODE_3};
use panel::{Panel, WAKING};
use picture::Picture;
use pinhole::{camera::Rotation, prelude::*, Angle};
use rp2040_hal as hal;
use rp2040_hal::fugit::{ExtU32, RateExtU32};
use rp2040_hal::{dma::DMAExt, gpio::Pins, pac, Clock as _, Sio, Spi, Timer, Watchdog};
use stop::stop;

include!(concat!(env!("OUT_DIR"), "/model.rs"));

/// The second stage of booting, for the flash on a Pico.
#[allow(unsafe_code)]
#[link_section = ".boot2"]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// Of the crystal.
const CRYSTAL: u32 = 12_000_000;
/// Frames of a turn.
const FRAMES: u32 = 120;
/// The chip is reset when a frame takes longer, in milliseconds; 0: no watchdog.
const WATCHDOG: u32 = 1000;
/// From one writing of the panel's registers to the next, in µs.
const REFRESH: u32 = 500_000;
const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
/// Rows of a band: more are faster, and take more memory.
const ROWS: u32 = 8;
/// Pixels of a strip.
const PIXELS: usize = (SCREEN.size.width * ROWS) as usize;
type Strip = StripBuffers!(Rgb565, SCREEN.size.width, ROWS, no depth);

#[hal::entry]
fn main() -> ! {
    // In statics, so that the linker says if they do not fit, and DMA may borrow the strips. The rest of RAM is the stack.
    let mesh = singleton!(: MeshBuffers!(MODEL) = mesh_buffers!(MODEL));
    let depths = singleton!(: [u16; PIXELS] = [0; PIXELS]);
    let strips = singleton!(: [RefCell<Strip>; 2] = [const { RefCell::new(Strip::new()) }; 2]);
    let (Some(mesh), Some(depths), Some([strip, other])) = (mesh, depths, strips) else {
        stop("the buffers are in use")
    };
    let mut strips: [&'static RefCell<Strip>; 2] = [strip, other];

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
    stack::paint();
    if WATCHDOG > 0 {
        watchdog.start(WATCHDOG.millis());
    }
    let timer = Timer::new(p.TIMER, &mut p.RESETS, &clocks);

    let pins = Pins::new(p.IO_BANK0, p.PADS_BANK0, Sio::new(p.SIO).gpio_bank0, &mut p.RESETS);
    let spi = Spi::<_, _, _, 8>::new(p.SPI0, (pins.gpio19.into_function(), pins.gpio18.into_function()))
        .init(&mut p.RESETS, clocks.peripheral_clock.freq(), 62_500_000.Hz(), MODE_3);
    let channel = p.DMA.split(&mut p.RESETS).ch0;
    let mut panel = Panel {
        bus: Bus::new(spi, channel, timer, first(strips[1], 0)),
        select: pins.gpio17.into_push_pull_output().into_dyn_pin(),
        command: pins.gpio20.into_push_pull_output().into_dyn_pin(),
        reset: pins.gpio21.into_push_pull_output().into_dyn_pin(),
    };
    let mut delay = timer;
    panel.start(&mut delay).unwrap_or_else(|problem| stop(problem));

    let picture = Picture::new(&MODEL, SCREEN, Rotation::Deg0, &mut mesh.cache, &mut mesh.bins, depths);
    let mut picture = picture.unwrap_or_else(|problem| stop(problem));
    // A constant: what the model does not have is left out when this is compiled.
    let color = |face: usize, level: u16| match MODEL_COLORS {
        Some(colors) => colors.lit(face, level),
        None => picture::COLOR.dim(level),
    };
    let mut refreshed = timer.get_counter_low();
    loop {
        for frame in 0..FRAMES {
            watchdog.feed();
            let start = timer.get_counter_low();
            let turned = picture.turned(Angle::turns(frame as i32, FRAMES));
            let mut turned = turned.unwrap_or_else(|problem| stop(problem));
            let (mut bytes, mut shown) = (0, Ok(()));
            while shown.is_ok() {
                let Ok(mut strip) = strips[0].try_borrow_mut() else { stop("the strip is in use") };
                let band = turned.next_band(color, &mut strip.colors).unwrap_or_else(|problem| stop(problem));
                let Some(band) = band else { break };
                let (area, len) = (band.area(), band.bytes().len());
                bytes += len as u32; // of all bands, at most 115 200
                drop(strip);
                match panel.window(&area) {
                    Ok(bus) => {
                        bus.send(first(strips[0], len));
                        strips.reverse();
                    }
                    Err(problem) => shown = Err(problem),
                }
            }
            let statistics = turned.statistics();
            let time = timer.get_counter_low().wrapping_sub(start);
            if shown.is_ok() && timer.get_counter_low().wrapping_sub(refreshed) >= REFRESH {
                refreshed = timer.get_counter_low();
                shown = panel.refresh();
                picture.shown = None;
                delay.delay_ms(WAKING);
            }
            match shown {
                Ok(()) => {
                    defmt::info!("frame {=u32}: {=u32} us, {=u32} bytes, {}", frame, time, bytes, statistics);
                }
                Err(problem) => {
                    defmt::error!("frame {=u32}: {=str}", frame, problem);
                    picture.shown = None;
                    panel.start(&mut delay).unwrap_or_else(|problem| stop(problem));
                }
            }
        }
        stack::log();
    }
}

/// The first bytes of a strip, for DMA.
fn first(strip: &'static RefCell<Strip>, bytes: usize) -> Ref<'static, [u8]> {
    let Ok(strip) = strip.try_borrow() else { stop("the strip is in use") };
    Ref::map(strip, |strip| strip.colors.get(..bytes).unwrap_or(&[]))
}
