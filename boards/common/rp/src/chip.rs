//! The pins of an RP2040 or RP2350, and the interrupt of urgent tasks.

use embassy_executor::{InterruptExecutor, SendSpawner};
use embassy_rp::gpio::{Level, Pull};
use embassy_rp::interrupt;
use embassy_rp::interrupt::{InterruptExt, Priority};
use embassy_rp::peripherals::{DMA_CH0, SPI0};
use embassy_rp::spi::{self, Async, Config, Phase, Polarity};
use embassy_rp::{bind_interrupts, dma};
use embassy_time::Duration;

pub use embassy_rp::gpio::{Input, Output};

bind_interrupts!(struct Interrupts {
    DMA_IRQ_0 => dma::InterruptHandler<DMA_CH0>;
});

pub type Spi = spi::Spi<'static, SPI0, Async>;

/// The chip is reset when a frame takes longer; zero: no watchdog.
const WATCHDOG: Duration = Duration::from_secs(1);

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
pub struct Watchdog(embassy_rp::watchdog::Watchdog);

impl Watchdog {
    pub fn feed(&mut self) {
        self.0.feed(WATCHDOG);
    }
}

/// Starts the clocks, and sets the bus and the pins up.
pub fn start() -> Board {
    let p = embassy_rp::init(crate::config());
    let mut watchdog = embassy_rp::watchdog::Watchdog::new(p.WATCHDOG);
    if WATCHDOG > Duration::MIN {
        watchdog.pause_on_debug(true);
        watchdog.start(WATCHDOG);
    }
    let mut config = Config::default();
    config.frequency = 62_500_000; // the display's limit; of 200 MHz, 50 MHz can be made, of 150 MHz 37.5 MHz
    (config.polarity, config.phase) = (Polarity::IdleHigh, Phase::CaptureOnSecondTransition);
    Board {
        spi: Spi::new_txonly(p.SPI0, p.PIN_18, p.PIN_19, p.DMA_CH0, Interrupts, config),
        select: Output::new(p.PIN_17, Level::High),
        command: Output::new(p.PIN_20, Level::High),
        reset: Output::new(p.PIN_21, Level::High),
        contacts: [Input::new(p.PIN_10, Pull::Up), Input::new(p.PIN_11, Pull::Up)],
        button: Input::new(p.PIN_12, Pull::Up),
        tearing: Input::new(p.PIN_13, Pull::Down),
        watchdog: Watchdog(watchdog),
    }
}

/// For tasks that do not wait until a band is drawn: an interrupt runs them.
static URGENT: InterruptExecutor = InterruptExecutor::new();

#[allow(unsafe_code)]
#[interrupt]
unsafe fn SWI_IRQ_1() {
    // SAFETY: nothing else calls it, and `start` enables this interrupt.
    unsafe { URGENT.on_interrupt() }
}

/// Starts the executor of urgent tasks.
pub fn urgent() -> SendSpawner {
    interrupt::SWI_IRQ_1.set_priority(Priority::P2);
    URGENT.start(interrupt::SWI_IRQ_1)
}
