//! An ESP32-C3 with an ST7789 on SPI: your model turns, drawn into one strip while DMA sends the other, and each frame logs its time,
//! its bytes and what was drawn. Compiled, not run on hardware.
#![no_std]
#![no_main]

mod bus;
#[path = "../../common/all/src/panel.rs"]
mod panel;
#[path = "../../common/two-strips/src/picture.rs"]
mod picture;
#[path = "../../common/st7789/src/registers.rs"]
mod registers;
#[path = "../../common/all/src/stack.rs"]
mod stack;
mod stop;

use bus::Bus;
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
use panel::{Panel, WAKING};
use picture::Picture;
use pinhole::{camera::Rotation, prelude::*, Angle};
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
/// From one writing of the panel's registers to the next.
const REFRESH: Duration = Duration::from_millis(500);
const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
/// Rows of a band: more are faster, and take more memory.
const ROWS: u32 = 24;
/// Bytes of a strip.
const STRIP: usize = Frame::<Rgb565>::strip_bytes(SCREEN.size.width, ROWS);

// In statics, so that the linker says if they do not fit. The rest of RAM is the stack.
static MESH: ConstStaticCell<MeshBuffers!(MODEL)> = ConstStaticCell::new(mesh_buffers!(MODEL));
static DEPTHS: ConstStaticCell<[u16; STRIP / 2]> = ConstStaticCell::new([0; STRIP / 2]);

#[esp_hal::main]
fn main() -> ! {
    let (Some(mesh), Some(depths)) = (MESH.try_take(), DEPTHS.try_take()) else {
        stop("the buffers are in use")
    };
    // In statics of their own, with what DMA must know of them.
    let (Ok(mut free), Ok(other)) = (esp_hal::dma_tx_buffer!(STRIP), esp_hal::dma_tx_buffer!(STRIP)) else {
        stop("no DMA from the strips")
    };

    let p = esp_hal::init(esp_hal::Config::default().with_cpu_clock(CpuClock::max())); // 160 MHz
    stack::paint();
    let mut watchdog = Rtc::new(p.RTC_TIMER).rwdt;
    if WATCHDOG > Duration::ZERO {
        watchdog.set_timeout(RwdtStage::Stage0, WATCHDOG);
        watchdog.enable();
    }
    let config = Config::default().with_frequency(Rate::from_mhz(40)).with_mode(Mode::_3);
    let config = config.with_min_async_transfer_size(64); // commands go without DMA, which cannot read those in flash
    let Ok(spi) = Spi::new(p.SPI2, config) else { stop("no such clock of the bus") };
    let mut panel = Panel {
        bus: Bus::new(spi.with_sck(p.GPIO6).with_mosi(p.GPIO7).with_dma(p.DMA_CH0), other),
        select: Output::new(p.GPIO10, Level::High, OutputConfig::default()),
        command: Output::new(p.GPIO4, Level::High, OutputConfig::default()),
        reset: Output::new(p.GPIO5, Level::High, OutputConfig::default()),
    };
    let mut delay = Delay::new();
    panel.start(&mut delay).unwrap_or_else(|problem| stop(problem));

    let picture = Picture::new(&MODEL, SCREEN, Rotation::Deg0, &mut mesh.cache, &mut mesh.bins, depths);
    let mut picture = picture.unwrap_or_else(|problem| stop(problem));
    // A constant: what the model does not have is left out when this is compiled.
    let color = |face: usize, level: u16| match MODEL_COLORS {
        Some(colors) => colors.lit(face, level),
        None => picture::COLOR.dim(level),
    };
    let mut refreshed = Instant::now();
    loop {
        for frame in 0..FRAMES {
            watchdog.feed();
            let start = Instant::now();
            let turned = picture.turned(Angle::turns(frame as i32, FRAMES));
            let mut turned = turned.unwrap_or_else(|problem| stop(problem));
            let (mut bytes, mut shown) = (0, Ok(()));
            while let (Ok(()), Some(band)) =
                (shown, turned.next_band(color, free.as_mut_slice()).unwrap_or_else(|problem| stop(problem)))
            {
                let (area, len) = (band.area(), band.bytes().len());
                bytes += len as u32; // of all bands, at most 115 200
                match panel.window(&area) {
                    Ok(bus) => free = bus.send(free, len),
                    Err(problem) => shown = Err(problem),
                }
            }
            let statistics = turned.statistics();
            let time = start.elapsed().as_micros();
            if shown.is_ok() && refreshed.elapsed() >= REFRESH {
                refreshed = Instant::now();
                shown = panel.refresh();
                picture.shown = None;
                delay.delay_millis(WAKING);
            }
            match shown {
                Ok(()) => {
                    defmt::info!("frame {=u32}: {=u64} us, {=u32} bytes, {}", frame, time, bytes, statistics);
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
