//! An RP2040 with an ST7789 on SPI: your model turns, drawn by both cores into one strip while DMA sends the other, and each frame
//! logs its time and what was drawn. Compiled, not run on hardware.
#![no_std]
#![no_main]

mod both_cores;
#[path = "../../common/rp2040/src/bus.rs"]
mod bus;
#[path = "../../common/all/src/panel.rs"]
mod panel;
mod picture;
#[path = "../../common/st7789/src/registers.rs"]
mod registers;
#[path = "../../common/all/src/stack.rs"]
mod stack;
#[path = "../../common/rp2040/src/stop.rs"]
mod stop;

use both_cores::{serve, OtherCore, PaintedStack};
use bus::Bus;
use core::ops::Range;
use cortex_m::singleton;
use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_hal::{delay::DelayNs, spi::MODE_3};
use panel::{Panel, WAKING};
use picture::{area, Memory, Picture, ROWS, SCREEN};
use pinhole::{prelude::*, Angle};
use rp2040_hal as hal;
use rp2040_hal::fugit::{ExtU32, RateExtU32};
use rp2040_hal::multicore::{Multicore, StackAllocation};
use rp2040_hal::{dma::DMAExt, gpio::Pins, pac, Clock as _, Sio, Spi, Timer, Watchdog};
use stop::stop;

include!(concat!(env!("OUT_DIR"), "/model.rs"));

/// The second stage of booting, for the flash on a Pico.
#[allow(unsafe_code)]
#[link_section = ".boot2"]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// Bytes of the second core's stack. Drawing takes less than 3 KB, which `tools/bench/run bands` in pinhole's repository tests.
const STACK_BYTES: usize = 4096;
static STACK: PaintedStack<{ STACK_BYTES / size_of::<usize>() }> = PaintedStack::new();

/// Of the crystal.
const CRYSTAL: u32 = 12_000_000;
/// Frames of a turn.
const FRAMES: u32 = 120;
/// The chip is reset when a frame takes longer, in milliseconds; 0: no watchdog.
const WATCHDOG: u32 = 1000;
/// From one writing of the panel's registers to the next, in µs.
const REFRESH: u32 = 500_000;

#[hal::entry]
fn main() -> ! {
    // In statics, so that the linker says if they do not fit, and DMA may own the strips. The rest of RAM is the stack.
    let mesh = singleton!(: MeshBuffers!(MODEL) = mesh_buffers!(MODEL));
    let cursor =
        singleton!(: [u16; MODEL.faces().len().div_ceil(16)] = [0; MODEL.faces().len().div_ceil(16)]);
    let strip = singleton!(: StripBuffers!(Rgb565, SCREEN.size.width, 2 * ROWS) = strip_buffers!(Rgb565, SCREEN.size.width, 2 * ROWS));
    let other = singleton!(: StripBuffers!(Rgb565, SCREEN.size.width, 2 * ROWS, no depth) = strip_buffers!(Rgb565, SCREEN.size.width, 2 * ROWS, no depth));
    let (Some(mesh), Some(cursor), Some(strip), Some(other)) = (mesh, cursor, strip, other) else {
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
    stack::paint();
    if WATCHDOG > 0 {
        watchdog.start(WATCHDOG.millis());
    }
    let timer = Timer::new(p.TIMER, &mut p.RESETS, &clocks);

    let mut sio = Sio::new(p.SIO);
    let mut cores = Multicore::new(&mut p.PSM, &mut p.PPB, &mut sio.fifo);
    let [_, second] = cores.cores() else { stop("the second core is missing") };
    let Range { start, end } = STACK.paint();
    // SAFETY: from here on the second core alone writes this memory, and it has the alignment of a stack
    #[allow(unsafe_code)]
    let stack = unsafe { StackAllocation::from_raw_parts(start, end) };
    let other_core = OtherCore::new(|| second.spawn(stack, || serve()));
    let Ok(mut other_core) = other_core else { stop("the second core does not start") };

    let pins = Pins::new(p.IO_BANK0, p.PADS_BANK0, sio.gpio_bank0, &mut p.RESETS);
    let spi = Spi::<_, _, _, 8>::new(p.SPI0, (pins.gpio19.into_function(), pins.gpio18.into_function()))
        .init(&mut p.RESETS, clocks.peripheral_clock.freq(), 62_500_000.Hz(), MODE_3);
    let channel = p.DMA.split(&mut p.RESETS).ch0;
    let mut panel = Panel {
        bus: Bus::new(spi, channel, timer, other.colors.as_mut_slice()),
        select: pins.gpio17.into_push_pull_output().into_dyn_pin(),
        command: pins.gpio20.into_push_pull_output().into_dyn_pin(),
        reset: pins.gpio21.into_push_pull_output().into_dyn_pin(),
    };
    let mut delay = timer;
    panel.start(&mut delay).unwrap_or_else(|problem| stop(problem));

    let half = strip.depths.len() / 2;
    let (depths, other_depths) = strip.depths.split_at_mut(half);
    let depths = [depths, other_depths];
    let memory = Memory { cache: &mut mesh.cache, bins: &mut mesh.bins, cursor, depths };
    let mut picture = Picture::new(&MODEL, memory).unwrap_or_else(|problem| stop(problem));
    let mut free: &'static mut [u8] = &mut strip.colors;
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
            let turn = Angle::turns(frame as i32, FRAMES);
            let mut shown = Ok(());
            let drawn = picture.draw(color, turn, &mut other_core, free, |strip, pixels| {
                if shown.is_err() {
                    return pixels; // the rest of a frame that is given up
                }
                match panel.window(&area(strip)) {
                    Ok(bus) => bus.send(pixels),
                    Err(problem) => {
                        shown = Err(problem);
                        pixels
                    }
                }
            });
            let (statistics, strip) = drawn.unwrap_or_else(|problem| stop(problem));
            free = strip;
            let time = timer.get_counter_low().wrapping_sub(start);
            if shown.is_ok() && timer.get_counter_low().wrapping_sub(refreshed) >= REFRESH {
                refreshed = timer.get_counter_low();
                shown = panel.refresh();
                delay.delay_ms(WAKING);
            }
            match shown {
                Ok(()) => defmt::info!("frame {=u32}: {=u32} us, {}", frame, time, statistics),
                // The next frame is sent whole.
                Err(problem) => {
                    defmt::error!("frame {=u32}: {=str}", frame, problem);
                    panel.start(&mut delay).unwrap_or_else(|problem| stop(problem));
                }
            }
        }
        stack::log();
        defmt::info!("the second core's stack: {=usize} of {=usize} bytes used", STACK.used(), STACK_BYTES);
    }
}
