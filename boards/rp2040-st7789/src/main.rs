//! An RP2040 with an ST7789 on SPI: a lit cube that turns, drawn into one strip while DMA sends the other. Compiled, not run on
//! hardware.
#![no_std]
#![no_main]

mod panel;
mod scene;

use defmt_rtt as _;
use embedded_hal::spi::MODE_3;
use panel::Panel;
use panic_probe as _;
use pinhole::Angle;
use rp2040_hal as hal;
use rp2040_hal::fugit::RateExtU32;
use rp2040_hal::{dma::DMAExt, gpio::Pins, pac, Clock, Sio, Spi, Timer, Watchdog};
use scene::{Scene, BANDS, FIRST_BAND, STRIP};

/// The second stage of booting, for the flash on a Pico.
#[allow(unsafe_code)]
#[link_section = ".boot2"]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// Of the crystal.
const CRYSTAL: u32 = 12_000_000;
/// A turn.
const FRAMES: i32 = 120;

#[hal::entry]
fn main() -> ! {
    let mut p = pac::Peripherals::take().unwrap();
    let mut watchdog = Watchdog::new(p.WATCHDOG);
    let clocks = hal::clocks::init_clocks_and_plls(
        CRYSTAL,
        p.XOSC,
        p.CLOCKS,
        p.PLL_SYS,
        p.PLL_USB,
        &mut p.RESETS,
        &mut watchdog,
    )
    .ok()
    .unwrap();
    let mut delay = Timer::new(p.TIMER, &mut p.RESETS, &clocks);

    let pins = Pins::new(p.IO_BANK0, p.PADS_BANK0, Sio::new(p.SIO).gpio_bank0, &mut p.RESETS);
    let bus = Spi::<_, _, _, 8>::new(p.SPI0, (pins.gpio19.into_function(), pins.gpio18.into_function()))
        .init(&mut p.RESETS, clocks.peripheral_clock.freq(), 62_500_000.Hz(), MODE_3);
    let [select, command, reset] = [
        pins.gpio17.into_push_pull_output().into_dyn_pin(),
        pins.gpio20.into_push_pull_output().into_dyn_pin(),
        pins.gpio21.into_push_pull_output().into_dyn_pin(),
    ];
    let channel = p.DMA.split(&mut p.RESETS).ch0;
    let panel = Panel::new(bus, channel, select, command, reset, &mut delay);

    let scene = cortex_m::singleton!(: Scene = Scene::new()).unwrap();
    let mut free: &'static mut [u8] = cortex_m::singleton!(: [u8; STRIP] = [0; STRIP]).unwrap();
    // The first to leave is black.
    let mut transfer = panel.send(&FIRST_BAND, cortex_m::singleton!(: [u8; STRIP] = [0; STRIP]).unwrap());
    loop {
        for number in 0..FRAMES {
            let mut turned = scene.turned(Angle::turns(number, FRAMES as u32));
            for _ in 0..BANDS {
                let band = turned.next_band(free);
                let area = band.area();
                let (panel, sent) = transfer.wait();
                transfer = panel.send(&area, band.into_bytes());
                free = sent;
            }
        }
        defmt::info!("{} frames", FRAMES);
    }
}
