//! An STM32F411 with an ILI9341 on SPI: your model turns, and each frame logs its time, its bytes and what was drawn. Run on an
//! emulated STM32F411, not on hardware.
#![no_std]
#![no_main]

mod picture;
mod stop;

use cortex_m::{peripheral::DWT, singleton};
use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embedded_graphics_core::{geometry::Dimensions, pixelcolor::Rgb565};
use embedded_hal::{delay::DelayNs, spi::MODE_0};
use embedded_hal_bus::spi::ExclusiveDevice;
use mipidsi::interface::SpiInterface;
use mipidsi::options::{ColorOrder, Orientation, Rotation};
use mipidsi::{models::ILI9341Rgb565, Builder};
use picture::{Drawn, Memory};
use pinhole::{prelude::*, Angle};
use stm32f4xx_hal::gpio::Speed;
use stm32f4xx_hal::{
    pac::{self, SPI1},
    prelude::*,
    rcc::Config,
    spi::Spi,
};
use stop::stop;

include!(concat!(env!("OUT_DIR"), "/model.rs"));

/// The core's clock.
const MEGAHERTZ: u32 = 100;
/// Frames of a turn.
const FRAMES: u32 = 48;
const WIDTH: u32 = 320;
/// Rows of a band: more are faster, and take more memory.
const ROWS: u32 = 8;

/// Waits by counting cycles. The timers of the HAL would link `core::fmt`, by an `unwrap` of their own.
struct Delay;

impl DelayNs for Delay {
    fn delay_ns(&mut self, time: u32) {
        cortex_m::asm::delay(time.div_ceil(1000) * MEGAHERTZ); // below 2³²: at most 4.3 million µs, times 100
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    // In statics, so that the linker says if they do not fit. The rest of RAM is the stack.
    let mesh = singleton!(: MeshBuffers!(MODEL) = mesh_buffers!(MODEL));
    let strip = singleton!(: StripBuffers!(Rgb565, WIDTH, ROWS) = strip_buffers!(Rgb565, WIDTH, ROWS));
    let (Some(mesh), Some(strip)) = (mesh, strip) else { stop("the buffers are in use") };
    let mut memory = Memory::new(&mut mesh.cache, &mut mesh.bins, &mut strip.colors, &mut strip.depths);

    let (Some(mut core), Some(peripherals)) = (cortex_m::Peripherals::take(), pac::Peripherals::take())
    else {
        stop("the peripherals are in use")
    };
    let mut rcc = peripherals.RCC.freeze(Config::hse(25.MHz()).sysclk(MEGAHERTZ.MHz()));
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();

    let pins = peripherals.GPIOA.split(&mut rcc);
    let serial_clock = pins.pa5.into_alternate().speed(Speed::VeryHigh);
    let data = pins.pa7.into_alternate().speed(Speed::VeryHigh);
    let reset = pins.pa2.into_push_pull_output();
    let command = pins.pa3.into_push_pull_output();
    let select = pins.pa4.into_push_pull_output();
    let spi = (Some(serial_clock), SPI1::NoMiso, Some(data));
    let bus = Spi::new(peripherals.SPI1, spi, MODE_0, 25.MHz(), &mut rcc);

    let mut buffer = [0; 1024];
    let Ok(device) = ExclusiveDevice::new_no_delay(bus, select); // a pin of this chip cannot fail
    let display = Builder::new(ILI9341Rgb565, SpiInterface::new(device, command, &mut buffer))
        .reset_pin(reset)
        // Such a panel's columns run from right to left: a landscape that is not mirrored, MADCTL 0x28.
        .orientation(Orientation::new().rotate(Rotation::Deg90).flip_vertical())
        .color_order(ColorOrder::Bgr)
        .init(&mut Delay);
    let Ok(mut display) = display else { stop("the display does not start") };

    let camera = picture::camera(&MODEL, display.bounding_box()).unwrap_or_else(|problem| stop(problem));
    // A constant: what the model does not have is left out when this is compiled.
    let color = |face: usize, level: u16| match MODEL_COLORS {
        Some(colors) => colors.lit(face, level),
        None => picture::COLOR.dim(level),
    };
    loop {
        for frame in 0..FRAMES {
            let start = DWT::cycle_count();
            let turn = Angle::turns(frame as i32, FRAMES);
            let drawn = picture::draw(&MODEL, color, &camera, turn, &mut memory, &mut display);
            let time = DWT::cycle_count().wrapping_sub(start) / MEGAHERTZ;
            match drawn {
                Ok(Drawn { statistics, bytes }) => {
                    defmt::info!("frame {=u32}: {=u32} us, {=u32} bytes, {}", frame, time, bytes, statistics);
                }
                // An error of the bus, for instance. The next frame opens its own windows and sends every pixel again.
                Err(problem) => defmt::error!("frame {=u32}: {=str}", frame, problem),
            }
        }
    }
}
