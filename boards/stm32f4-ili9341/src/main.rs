//! An STM32F411 with an ILI9341 on SPI: your model turns, drawn into one strip while DMA sends the other, and each frame logs its time,
//! its bytes and what was drawn. Run on an emulated STM32F411, not on hardware.
#![no_std]
#![no_main]

mod bus;
mod columns;
#[path = "../../common/all/src/panel.rs"]
mod panel;
#[path = "../../common/two-strips/src/picture.rs"]
mod picture;
mod registers;
#[path = "../../common/all/src/stack.rs"]
mod stack;
#[path = "../../common/all/src/stop.rs"]
mod stop;

use bus::{Bus, Delay, MEGAHERTZ};
use columns::Columns;
use core::cell::{Ref, RefCell};
use cortex_m::{peripheral::DWT, singleton};
use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::{pixelcolor::Rgb565, primitives::Rectangle};
use embedded_hal::delay::DelayNs;
use embedded_hal::spi::{Mode, MODE_0};
use panel::{Panel, WAKING};
use picture::Picture;
use pinhole::{camera::Rotation, prelude::*, Angle};
use stm32f4xx_hal::gpio::Speed;
use stm32f4xx_hal::{
    dma::StreamsTuple,
    pac::{self, SPI1},
    prelude::*,
    rcc::Config,
    spi::Spi,
    watchdog::IndependentWatchdog,
};
use stop::stop;

include!(concat!(env!("OUT_DIR"), "/model.rs"));

/// Frames of a turn.
const FRAMES: u32 = 48;
/// The chip is reset when a frame takes longer, in milliseconds; 0: no watchdog.
const WATCHDOG: u32 = 1000;
/// From one writing of the panel's registers to the next, in µs.
const REFRESH: u32 = 500_000;
/// Of the bus.
const HERTZ: u32 = 25_000_000;
const MODE: Mode = MODE_0;
/// The panel as its controller reads it, row by row. Bands run along these rows.
const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 320));
/// The panel's right border is at the top; `Deg270`: its left border is.
const ROTATION: Rotation = Rotation::Deg90;
/// Rows of a band: more are faster, and take more memory.
const ROWS: u32 = 10;
/// Pixels of a strip.
const PIXELS: usize = (SCREEN.size.width * ROWS) as usize;
type Strip = StripBuffers!(Rgb565, SCREEN.size.width, ROWS, no depth);

#[cortex_m_rt::entry]
fn main() -> ! {
    // In statics, so that the linker says if they do not fit, and DMA may borrow the strips. The rest of RAM is the stack.
    let mesh = singleton!(: MeshBuffers!(MODEL) = mesh_buffers!(MODEL));
    let depths = singleton!(: [u16; PIXELS] = [0; PIXELS]);
    let strips = singleton!(: [RefCell<Strip>; 2] = [const { RefCell::new(Strip::new()) }; 2]);
    let columns = singleton!(: Columns<{ SCREEN.size.height as usize }> = Columns::NONE);
    let (Some(mesh), Some(depths), Some([strip, other]), Some(columns)) = (mesh, depths, strips, columns)
    else {
        stop("the buffers are in use")
    };
    let mut strips: [&'static RefCell<Strip>; 2] = [strip, other];

    let (Some(mut core), Some(peripherals)) = (cortex_m::Peripherals::take(), pac::Peripherals::take())
    else {
        stop("the peripherals are in use")
    };
    let mut rcc = peripherals.RCC.freeze(Config::hse(25.MHz()).sysclk(MEGAHERTZ.MHz()));
    stack::paint();
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();

    let mut watchdog = IndependentWatchdog::new(peripherals.IWDG);
    if WATCHDOG > 0 {
        watchdog.stop_on_debug(&peripherals.DBGMCU, true);
        watchdog.start(WATCHDOG.millis());
    }

    let pins = peripherals.GPIOA.split(&mut rcc);
    let serial_clock = pins.pa5.into_alternate().speed(Speed::VeryHigh);
    let data = pins.pa7.into_alternate().speed(Speed::VeryHigh);
    // Nothing is read: one wire for data, and no byte that could be lost.
    let wires = (Some(serial_clock), Some(data));
    let spi = Spi::new_bidi(peripherals.SPI1, wires, MODE, HERTZ.Hz(), &mut rcc);
    // SAFETY: DMA's handle is for the bus's data register alone, which the core does not write until DMA is done
    #[allow(unsafe_code)]
    let for_dma = unsafe { SPI1::steal() };
    let sender =
        Spi::new_bidi(for_dma, (SPI1::NoSck, SPI1::NoMosi), MODE, HERTZ.Hz(), &mut rcc).use_dma().tx();
    let stream = StreamsTuple::new(peripherals.DMA2, &mut rcc).3;

    let mut panel = Panel {
        bus: Bus::new(spi, stream, sender, first(strips[1], 0)),
        select: pins.pa4.into_push_pull_output().erase(),
        command: pins.pa3.into_push_pull_output().erase(),
        reset: pins.pa2.into_push_pull_output().erase(),
    };
    let mut delay = Delay;
    panel.start(&mut delay).unwrap_or_else(|problem| stop(problem));

    let picture = Picture::new(&MODEL, SCREEN, ROTATION, &mut mesh.cache, &mut mesh.bins, depths);
    let mut picture = picture.unwrap_or_else(|problem| stop(problem));
    // A constant: what the model does not have is left out when this is compiled.
    let color = |face: usize, level: u16| match MODEL_COLORS {
        Some(colors) => colors.lit(face, level),
        None => picture::COLOR.dim(level),
    };
    let mut refreshed = DWT::cycle_count();
    loop {
        for frame in 0..FRAMES {
            watchdog.feed();
            let start = DWT::cycle_count();
            let is_whole = picture.shown.is_none();
            let turned = picture.turned(Angle::turns(frame as i32, FRAMES));
            let mut turned = turned.unwrap_or_else(|problem| stop(problem));
            let (mut bytes, mut shown) = (0, Ok(()));
            while shown.is_ok() {
                let Ok(mut strip) = strips[0].try_borrow_mut() else { stop("the strip is in use") };
                let band = turned.next_band(color, &mut strip.colors).unwrap_or_else(|problem| stop(problem));
                let Some(band) = band else { break };
                let (area, len) = columns.changed(band, is_whole);
                bytes += len as u32; // of all bands, at most 153 600
                drop(strip);
                if len == 0 {
                    continue;
                }
                match panel.window(&area) {
                    Ok(bus) => {
                        bus.send(first(strips[0], len));
                        strips.reverse();
                    }
                    Err(problem) => shown = Err(problem),
                }
            }
            let statistics = turned.statistics();
            let time = DWT::cycle_count().wrapping_sub(start) / MEGAHERTZ;
            if shown.is_ok() && DWT::cycle_count().wrapping_sub(refreshed) >= REFRESH * MEGAHERTZ {
                refreshed = DWT::cycle_count();
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
