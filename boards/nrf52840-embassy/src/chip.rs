//! The nRF52840, its clocks and pins.

use crate::stop::stop;
use embassy_executor::{InterruptExecutor, SendSpawner};
use embassy_nrf::gpio::{Level, OutputDrive, Pull};
use embassy_nrf::interrupt;
use embassy_nrf::interrupt::{InterruptExt, Priority};
use embassy_nrf::spim::{Config, Frequency, InterruptHandler, Spim, MODE_3};
use embassy_nrf::{bind_interrupts, peripherals::SPI3, wdt};

pub use embassy_nrf::gpio::{Input, Output};

bind_interrupts!(struct Interrupts {
    SPIM3 => InterruptHandler<SPI3>;
});

pub type Spi = Spim<'static>;

/// The chip is reset when a frame takes longer, in ticks of 1/32768 s; 0: no watchdog.
const WATCHDOG: u32 = 32_768;

/// The bus and the pins of the display, which are high, and those of the encoder.
pub struct Board {
    pub spi: Spi,
    pub select: Output<'static>,
    pub command: Output<'static>,
    pub reset: Output<'static>,
    pub contacts: [Input<'static>; 2],
    pub button: Input<'static>,
    /// The display's TE; low, if it is not connected.
    pub tearing: Input<'static>,
    pub watchdog: Watchdog,
}

/// Resets the chip when a frame takes longer.
pub struct Watchdog(Option<wdt::WatchdogHandle>);

impl Watchdog {
    pub fn feed(&mut self) {
        if let Some(handle) = &mut self.0 {
            handle.pet();
        }
    }
}

/// Starts the clocks, and sets the bus and the pins up.
pub fn start() -> Board {
    let mut config = embassy_nrf::config::Config::default();
    config.time_interrupt_priority = Priority::P2;
    let p = embassy_nrf::init(config);
    let mut timing = wdt::Config::default();
    timing.timeout_ticks = WATCHDOG;
    timing.action_during_debug_halt = wdt::HaltConfig::Pause;
    let watchdog = (WATCHDOG > 0).then(|| wdt::Watchdog::try_new(p.WDT, timing));
    let watchdog = watchdog.map(|started| started.map(|(_, [handle])| handle));
    let Ok(watchdog) = watchdog.transpose() else { stop("the watchdog runs already, otherwise") };
    let mut config = Config::default();
    (config.frequency, config.mode) = (Frequency::M32, MODE_3);
    // Of all SPIs, only this one is as fast.
    interrupt::SPIM3.set_priority(Priority::P2);
    Board {
        spi: Spim::new_txonly(p.SPI3, Interrupts, p.P0_13, p.P0_14, config),
        select: Output::new(p.P0_15, Level::High, OutputDrive::Standard),
        command: Output::new(p.P0_16, Level::High, OutputDrive::Standard),
        reset: Output::new(p.P0_17, Level::High, OutputDrive::Standard),
        contacts: [Input::new(p.P0_26, Pull::Up), Input::new(p.P0_27, Pull::Up)],
        button: Input::new(p.P0_02, Pull::Up),
        tearing: Input::new(p.P0_03, Pull::Down),
        watchdog: Watchdog(watchdog),
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
