//! An STM32F411 with an ILI9341 on SPI: the README's first picture, turning. Compiled, not run on hardware.
#![no_std]
#![no_main]

mod picture;

use defmt_rtt as _;
use embedded_hal::spi::MODE_0;
use embedded_hal_bus::spi::ExclusiveDevice;
use mipidsi::interface::SpiInterface;
use mipidsi::options::{ColorOrder, Orientation, Rotation};
use mipidsi::{models::ILI9341Rgb565, Builder};
use panic_probe as _;
use pinhole::Angle;
use stm32f4xx_hal::gpio::Speed;
use stm32f4xx_hal::{
    pac::{self, SPI1},
    prelude::*,
    rcc::Config,
    spi::Spi,
};

/// A turn.
const FRAMES: i32 = 120;

#[cortex_m_rt::entry]
fn main() -> ! {
    let peripherals = pac::Peripherals::take().unwrap();
    let mut rcc = peripherals.RCC.freeze(Config::hse(25.MHz()).sysclk(100.MHz()));
    let mut delay = peripherals.TIM5.delay_us(&mut rcc);

    let pins = peripherals.GPIOA.split(&mut rcc);
    let clock = pins.pa5.into_alternate().speed(Speed::VeryHigh);
    let data = pins.pa7.into_alternate().speed(Speed::VeryHigh);
    let reset = pins.pa2.into_push_pull_output();
    let command = pins.pa3.into_push_pull_output();
    let select = pins.pa4.into_push_pull_output();
    let bus = Spi::new(peripherals.SPI1, (Some(clock), SPI1::NoMiso, Some(data)), MODE_0, 25.MHz(), &mut rcc);

    let mut buffer = [0; 1024];
    let device = ExclusiveDevice::new_no_delay(bus, select).unwrap();
    let mut display = Builder::new(ILI9341Rgb565, SpiInterface::new(device, command, &mut buffer))
        .reset_pin(reset)
        // Such a panel's columns run from right to left: a landscape that is not mirrored, MADCTL 0x28.
        .orientation(Orientation::new().rotate(Rotation::Deg90).flip_vertical())
        .color_order(ColorOrder::Bgr)
        .init(&mut delay)
        .unwrap();

    loop {
        for frame in 0..FRAMES {
            picture::draw(&mut display, Angle::turns(frame, FRAMES as u32)).unwrap();
        }
        defmt::info!("{} frames", FRAMES);
    }
}
