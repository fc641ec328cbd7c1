//! The nRF52840, its clocks and pins.

use embassy_executor::{InterruptExecutor, SendSpawner};
use embassy_nrf::gpio::{Level, OutputDrive, Pull};
use embassy_nrf::interrupt;
use embassy_nrf::interrupt::{InterruptExt, Priority};
use embassy_nrf::spim::{Config, Frequency, InterruptHandler, Spim, MODE_3};
use embassy_nrf::{bind_interrupts, peripherals::SPI3};

pub use embassy_nrf::gpio::{Input, Output};

bind_interrupts!(struct Interrupts {
    SPIM3 => InterruptHandler<SPI3>;
});

pub type Bus = Spim<'static>;

/// The bus and the pins of the display, which are high, and those of the encoder.
pub struct Board {
    pub bus: Bus,
    pub select: Output<'static>,
    pub command: Output<'static>,
    pub reset: Output<'static>,
    pub contacts: [Input<'static>; 2],
    pub button: Input<'static>,
}

/// Starts the clocks, and sets the bus and the pins up.
pub fn start() -> Board {
    let mut config = embassy_nrf::config::Config::default();
    config.time_interrupt_priority = Priority::P2;
    let p = embassy_nrf::init(config);
    let mut config = Config::default();
    (config.frequency, config.mode) = (Frequency::M32, MODE_3);
    // Of all SPIs, only this one is as fast.
    interrupt::SPIM3.set_priority(Priority::P2);
    Board {
        bus: Spim::new_txonly(p.SPI3, Interrupts, p.P0_13, p.P0_14, config),
        select: Output::new(p.P0_15, Level::High, OutputDrive::Standard),
        command: Output::new(p.P0_16, Level::High, OutputDrive::Standard),
        reset: Output::new(p.P0_17, Level::High, OutputDrive::Standard),
        contacts: [Input::new(p.P0_26, Pull::Up), Input::new(p.P0_27, Pull::Up)],
        button: Input::new(p.P0_02, Pull::Up),
    }
}

/// For tasks that do not wait until a band is drawn: an interrupt runs them.
static URGENT: InterruptExecutor = InterruptExecutor::new();

#[allow(unsafe_code)]
#[interrupt]
unsafe fn EGU0_SWI0() {
    // SAFETY: nothing else calls it, and `start` enables this interrupt.
    unsafe { URGENT.on_interrupt() }
}

/// Starts the executor of urgent tasks.
pub fn urgent() -> SendSpawner {
    interrupt::EGU0_SWI0.set_priority(Priority::P3);
    URGENT.start(interrupt::EGU0_SWI0)
}
