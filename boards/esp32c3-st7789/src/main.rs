//! An ESP32-C3 with an ST7789 on SPI: your model turns, and each frame logs its time, its bytes and what was drawn. Compiled, not
//! run on hardware.
#![no_std]
#![no_main]

#[path = "../../common/all/src/panel.rs"]
mod panel;
#[path = "../../common/one-strip/src/picture.rs"]
mod picture;
#[path = "../../common/st7789/src/registers.rs"]
mod registers;
#[path = "../../common/all/src/stack.rs"]
mod stack;
mod stop;

use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::{pixelcolor::Rgb565, primitives::Rectangle};
use esp_hal::clock::CpuClock;
use esp_hal::delay::Delay;
use esp_hal::gpio::{Level, Output, OutputConfig};
use esp_hal::rtc_cntl::{Rtc, RwdtStage};
use esp_hal::spi::master::{Config, Spi};
use esp_hal::spi::Mode;
use esp_hal::time::{Duration, Instant, Rate};
use esp_hal::Blocking;
use panel::{Bus as _, Panel, Problem, WAKING};
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
/// The chip is reset when a frame takes longer; zero: no watchdog.
const WATCHDOG: Duration = Duration::from_secs(1);
/// Frames from one writing of the panel's registers to the next, less than a second.
const REFRESH: u32 = 16;
const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
/// Rows of a band: more are faster, and take more memory.
const ROWS: u32 = 24;

// In statics, so that the linker says if they do not fit. The rest of RAM is the stack.
static MESH: ConstStaticCell<MeshBuffers!(MODEL)> = ConstStaticCell::new(mesh_buffers!(MODEL));
static STRIP: ConstStaticCell<StripBuffers!(Rgb565, SCREEN.size.width, ROWS)> =
    ConstStaticCell::new(strip_buffers!(Rgb565, SCREEN.size.width, ROWS));

#[esp_hal::main]
fn main() -> ! {
    let (Some(mesh), Some(strip)) = (MESH.try_take(), STRIP.try_take()) else {
        stop("the buffers are in use")
    };
    let mut memory = Memory::new(&mut mesh.cache, &mut mesh.bins, &mut strip.colors, &mut strip.depths);

    let p = esp_hal::init(esp_hal::Config::default().with_cpu_clock(CpuClock::max())); // 160 MHz
    stack::paint();
    let mut watchdog = Rtc::new(p.RTC_TIMER).rwdt;
    if WATCHDOG > Duration::ZERO {
        watchdog.set_timeout(RwdtStage::Stage0, WATCHDOG);
        watchdog.enable();
    }
    let config = Config::default().with_frequency(Rate::from_mhz(40)).with_mode(Mode::_3);
    let Ok(spi) = Spi::new(p.SPI2, config) else { stop("no such clock of the bus") };
    let mut panel = Panel {
        bus: Bus(spi.with_sck(p.GPIO6).with_mosi(p.GPIO7)),
        select: Output::new(p.GPIO10, Level::High, OutputConfig::default()),
        command: Output::new(p.GPIO4, Level::High, OutputConfig::default()),
        reset: Output::new(p.GPIO5, Level::High, OutputConfig::default()),
    };
    let mut delay = Delay::new();
    panel.start(&mut delay).unwrap_or_else(|problem| stop(problem));

    let camera = picture::camera(&MODEL, SCREEN).unwrap_or_else(|problem| stop(problem));
    // A constant: what the model does not have is left out when this is compiled.
    let color = |face: usize, level: u16| match MODEL_COLORS {
        Some(colors) => colors.lit(face, level),
        None => picture::COLOR.dim(level),
    };
    loop {
        for frame in 0..FRAMES {
            watchdog.feed();
            let start = Instant::now();
            let turn = Angle::turns(frame as i32, FRAMES);
            let drawn = picture::draw(&MODEL, color, &camera, turn, &mut memory, SCREEN, |area, pixels| {
                panel.window(area)?.write(pixels)
            });
            let time = start.elapsed().as_micros();
            let is_due = frame % REFRESH == 0;
            let shown =
                drawn.and_then(|drawn| if is_due { panel.refresh().map(|()| drawn) } else { Ok(drawn) });
            match shown {
                Ok(Drawn { statistics, bytes }) => {
                    defmt::info!("frame {=u32}: {=u64} us, {=u32} bytes, {}", frame, time, bytes, statistics);
                }
                // The next frame is sent whole.
                Err(problem) => {
                    defmt::error!("frame {=u32}: {=str}", frame, problem);
                    panel.start(&mut delay).unwrap_or_else(|problem| stop(problem));
                }
            }
            if is_due {
                delay.delay_millis(WAKING);
            }
        }
        stack::log();
    }
}

/// Blocks while it sends.
struct Bus(Spi<'static, Blocking>);

impl panel::Bus for Bus {
    /// Also for pixels, in wire order.
    fn write(&mut self, bytes: &[u8]) -> Result<(), Problem> {
        self.0.write(bytes).map_err(|_| "the bus has an error")
    }

    fn finish(&mut self) -> Result<(), Problem> {
        Ok(())
    }
}
