//! SPI, and DMA that sends a strip while the next one is drawn.

use crate::panel::{self, Problem};
use crate::stop::stop;
use esp_hal::dma::DmaTxBuf;
use esp_hal::spi::master::{SpiDma, SpiDmaTransfer};
use esp_hal::time::{Duration, Instant};
use esp_hal::Blocking;

/// The longest time that a strip may take. One of 24 rows takes 2.3 ms.
const PATIENCE: Duration = Duration::from_millis(20);

type Spi = SpiDma<'static, Blocking>;

/// With a strip always: the one that is being sent, or was sent last.
pub struct Bus(Option<Line>); // `None` only while it changes

enum Line {
    Idle(Spi, DmaTxBuf),
    Sending(SpiDmaTransfer<'static, Blocking, DmaTxBuf>),
}

impl Bus {
    pub fn new(spi: Spi, strip: DmaTxBuf) -> Self {
        Self(Some(Line::Idle(spi, strip)))
    }

    /// Sends the first bytes of a strip, pixels in wire order, and returns the strip that was sent before.
    pub fn send(&mut self, strip: DmaTxBuf, bytes: usize) -> DmaTxBuf {
        let Some(Line::Idle(spi, sent)) = self.0.take() else { stop("the bus is in use") };
        let Ok(sending) = spi.write_buffer(bytes, strip) else { stop("DMA does not start") };
        self.0 = Some(Line::Sending(sending));
        sent
    }
}

impl panel::Bus for Bus {
    fn write(&mut self, bytes: &[u8]) -> Result<(), Problem> {
        let Some(Line::Idle(spi, _)) = &mut self.0 else { stop("the bus is in use") };
        spi.write(bytes).map_err(|_| "the bus has an error")
    }

    /// DMA that has an error stops, which shows as a bus that does not go on.
    fn finish(&mut self) -> Result<(), Problem> {
        let Some(Line::Sending(mut sending)) = self.0.take_if(|line| matches!(line, Line::Sending(_))) else {
            return Ok(());
        };
        let is_done = within_time(&sending);
        if !is_done {
            sending.cancel();
            if !within_time(&sending) {
                stop("the bus does not give up")
            }
        }
        let (spi, strip) = sending.wait();
        self.0 = Some(Line::Idle(spi, strip));
        if is_done {
            Ok(())
        } else {
            Err("the bus does not go on")
        }
    }
}

fn within_time(sending: &SpiDmaTransfer<'static, Blocking, DmaTxBuf>) -> bool {
    let start = Instant::now();
    while !sending.is_done() && start.elapsed() < PATIENCE {}
    sending.is_done()
}
