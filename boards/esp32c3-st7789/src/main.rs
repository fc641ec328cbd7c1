//! An ESP32-C3 with an ST7789 on SPI: your model turns, and each frame logs its time, its bytes and what was drawn. Compiled, not
//! run on hardware.
#![no_std]
#![no_main]

mod picture;
mod stop;

use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embedded_graphics_core::geometry::Dimensions;
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_hal_bus::spi::ExclusiveDevice;
use esp_hal::clock::CpuClock;
use esp_hal::delay::Delay;
use esp_hal::gpio::{Level, Output, OutputConfig};
use esp_hal::spi::master::{Config, Spi};
use esp_hal::spi::Mode;
use esp_hal::time::{Instant, Rate};
use mipidsi::interface::SpiInterface;
use mipidsi::{models::ST7789, options::ColorInversion, Builder};
use picture::{Drawn, Memory};
use pinhole::{prelude::*, Angle};
use static_cell::ConstStaticCell;
use stop::stop;

include!(concat!(env!("OUT_DIR"), "/model.rs"));

// What the boot loader wants to know of the image.
#[allow(unsafe_code)]
mod description {
    esp_bootloader_esp_idf::esp_app_desc!();
}

/// Frames of a turn.
const FRAMES: u32 = 120;
const WIDTH: u32 = 240;
/// Rows of a band: more are faster, and take more memory.
const ROWS: u32 = 24;

// In statics, so that the linker says if they do not fit. The rest of RAM is the stack.
static MESH: ConstStaticCell<MeshBuffers!(MODEL)> = ConstStaticCell::new(mesh_buffers!(MODEL));
static STRIP: ConstStaticCell<StripBuffers!(Rgb565, WIDTH, ROWS)> =
    ConstStaticCell::new(strip_buffers!(Rgb565, WIDTH, ROWS));

#[esp_hal::main]
fn main() -> ! {
    let (Some(mesh), Some(strip)) = (MESH.try_take(), STRIP.try_take()) else {
        stop("the buffers are in use")
    };
    let mut memory = Memory::new(&mut mesh.cache, &mut mesh.bins, &mut strip.colors, &mut strip.depths);

    let p = esp_hal::init(esp_hal::Config::default().with_cpu_clock(CpuClock::max())); // 160 MHz
    let config = Config::default().with_frequency(Rate::from_mhz(40)).with_mode(Mode::_3);
    let Ok(bus) = Spi::new(p.SPI2, config) else { stop("no such clock of the bus") };
    let bus = bus.with_sck(p.GPIO6).with_mosi(p.GPIO7);
    let select = Output::new(p.GPIO10, Level::High, OutputConfig::default());
    let command = Output::new(p.GPIO4, Level::High, OutputConfig::default());
    let reset = Output::new(p.GPIO5, Level::High, OutputConfig::default());

    let mut buffer = [0; 1024];
    let Ok(device) = ExclusiveDevice::new_no_delay(bus, select); // a pin of this chip cannot fail
    let display = Builder::new(ST7789, SpiInterface::new(device, command, &mut buffer))
        .display_size(240, 240)
        .invert_colors(ColorInversion::Inverted)
        .reset_pin(reset)
        .init(&mut Delay::new());
    let Ok(mut display) = display else { stop("the display does not start") };

    let camera = picture::camera(&MODEL, display.bounding_box()).unwrap_or_else(|problem| stop(problem));
    // A constant: what the model does not have is left out when this is compiled.
    let color = |face: usize, level: u16| match MODEL_COLORS {
        Some(colors) => colors.lit(face, level),
        None => picture::COLOR.dim(level),
    };
    loop {
        for frame in 0..FRAMES {
            let start = Instant::now();
            let turn = Angle::turns(frame as i32, FRAMES);
            match picture::draw(&MODEL, color, &camera, turn, &mut memory, &mut display) {
                Ok(Drawn { statistics, bytes }) => {
                    let time = start.elapsed().as_micros();
                    defmt::info!("frame {=u32}: {=u64} us, {=u32} bytes, {}", frame, time, bytes, statistics);
                }
                // The next frame is sent as a whole.
                Err(problem) => defmt::error!("{=str}", problem),
            }
        }
    }
}
