//! SPI1, and DMA that sends a strip while the next one is drawn.

use crate::panel::{self, Problem};
use crate::stop::stop;
use core::cell::Ref;
use cortex_m::peripheral::DWT;
use embedded_hal::delay::DelayNs;
use stm32f4xx_hal::dma::traits::DmaFlagExt;
use stm32f4xx_hal::dma::{config::DmaConfig, MemoryToPeripheral, Stream3, Transfer};
use stm32f4xx_hal::pac::{DMA2, SPI1};
use stm32f4xx_hal::spi::{Spi, Tx};
use stm32f4xx_hal::{ClearFlags, ReadFlags};

/// The core's clock.
pub const MEGAHERTZ: u32 = 100;
/// The longest time, in cycles, for which the bus may be busy: 20 ms. A strip of 8 rows takes 1.6 ms.
const PATIENCE: u32 = 20_000 * MEGAHERTZ;

pub struct Bus {
    spi: Spi<SPI1, true>,
    /// It borrows of a strip always: of the one that is being sent, or was sent last.
    transfer: Transfer<Stream3<DMA2>, 3, Tx<SPI1>, MemoryToPeripheral, Ref<'static, [u8]>>,
    is_sending: bool,
}

impl Bus {
    pub fn new(
        spi: Spi<SPI1, true>,
        stream: Stream3<DMA2>,
        sender: Tx<SPI1>,
        strip: Ref<'static, [u8]>,
    ) -> Self {
        let config = DmaConfig::default().memory_increment(true);
        let transfer = Transfer::init_memory_to_peripheral(stream, sender, strip, None, config);
        Self { spi, transfer, is_sending: false }
    }

    /// Sends bytes of a strip, pixels in wire order. The strip that was sent before is free again.
    pub fn send(&mut self, bytes: Ref<'static, [u8]>) {
        let Ok(_) = self.transfer.next_transfer(bytes) else { stop("DMA does not start") };
        self.is_sending = true;
    }
}

impl panel::Bus for Bus {
    fn write(&mut self, bytes: &[u8]) -> Result<(), Problem> {
        self.spi.write(bytes).map_err(|_| "the bus has an error")?;
        within_time(|| !self.spi.is_busy())
    }

    fn finish(&mut self) -> Result<(), Problem> {
        if !core::mem::take(&mut self.is_sending) {
            return Ok(());
        }
        let mut failed = false;
        let done = within_time(|| {
            let flags = self.transfer.flags();
            failed = flags.is_transfer_error() || flags.is_direct_mode_error();
            failed || flags.is_transfer_complete()
        });
        // DMA is done when the last two bytes are in the bus's registers.
        let arrived = done.and_then(|()| within_time(|| !self.spi.is_busy()));
        if failed || arrived.is_err() {
            self.transfer.pause(|_| ());
            self.transfer.clear_all_flags();
        }
        if failed {
            Err("DMA has an error")
        } else {
            arrived
        }
    }
}

fn within_time(mut is_done: impl FnMut() -> bool) -> Result<(), Problem> {
    let start = DWT::cycle_count();
    while !is_done() {
        if DWT::cycle_count().wrapping_sub(start) > PATIENCE {
            return Err("the bus does not go on");
        }
    }
    Ok(())
}

/// Waits by the cycle counter. The timers of the HAL would link `core::fmt`, by an `unwrap` of their own.
pub struct Delay;

impl DelayNs for Delay {
    fn delay_ns(&mut self, time: u32) {
        let start = DWT::cycle_count();
        while DWT::cycle_count().wrapping_sub(start) < time.div_ceil(1000) * MEGAHERTZ {}
        // at most 4.3 million µs, times 100
    }
}
