//! SPI, and DMA that sends a strip while the next one is drawn.

use crate::panel::{self, Problem};
use crate::stop::stop;
use embedded_hal::spi::SpiBus;
use rp2040_hal::dma::{single_buffer, ReadTarget, SingleChannel, WriteTarget};
use rp2040_hal::Timer;

/// The longest time, in µs, that a strip may take. One of 40 rows takes 2.5 ms.
const PATIENCE: u32 = 20_000;

/// With a strip always: the one that is being sent, or was sent last.
pub struct Bus<Spi: WriteTarget, Channel: SingleChannel, Strip: ReadTarget> {
    /// `None` only while it changes.
    line: Option<Line<Spi, Channel, Strip>>,
    timer: Timer,
}

enum Line<Spi: WriteTarget, Channel: SingleChannel, Strip: ReadTarget> {
    Idle(Channel, Strip, Spi),
    Sending(single_buffer::Transfer<Channel, Strip, Spi>),
}

impl<
        Spi: SpiBus + WriteTarget<TransmittedWord = u8>,
        Channel: SingleChannel,
        Strip: ReadTarget<ReceivedWord = u8>,
    > Bus<Spi, Channel, Strip>
{
    pub fn new(spi: Spi, channel: Channel, timer: Timer, strip: Strip) -> Self {
        Self { line: Some(Line::Idle(channel, strip, spi)), timer }
    }

    /// Sends pixels in wire order, and returns the strip that was sent before.
    pub fn send(&mut self, strip: Strip) -> Strip {
        let Some(Line::Idle(channel, sent, spi)) = self.line.take() else { stop("the bus is in use") };
        self.line = Some(Line::Sending(single_buffer::Config::new(channel, strip, spi).start()));
        sent
    }
}

impl<
        Spi: SpiBus + WriteTarget<TransmittedWord = u8>,
        Channel: SingleChannel,
        Strip: ReadTarget<ReceivedWord = u8>,
    > panel::Bus for Bus<Spi, Channel, Strip>
{
    fn write(&mut self, bytes: &[u8]) -> Result<(), Problem> {
        let Some(Line::Idle(_, _, spi)) = &mut self.line else { stop("the bus is in use") };
        spi.write(bytes).and_then(|()| spi.flush()).map_err(|_| "the bus has an error")
    }

    fn finish(&mut self) -> Result<(), Problem> {
        let Some(Line::Sending(running)) = self.line.take_if(|line| matches!(line, Line::Sending(_))) else {
            return Ok(());
        };
        let start = self.timer.get_counter_low();
        let is_late = || self.timer.get_counter_low().wrapping_sub(start) > PATIENCE;
        while !running.is_done() && !is_late() {}
        let is_done = running.is_done();
        let (channel, strip, mut spi) = if is_done { running.wait() } else { running.abort() };
        let control = channel.ch().ch_al1_ctrl();
        let has_failed = control.read().ahb_error().bit_is_set();
        if has_failed {
            // Until its flags are cleared, the channel does not start again.
            control.modify(|_, w| w.read_error().clear_bit_by_one().write_error().clear_bit_by_one());
        }
        // DMA is done when the last bytes are in the queue.
        let is_sent = spi.flush().is_ok();
        self.line = Some(Line::Idle(channel, strip, spi));
        if has_failed {
            Err("DMA has an error")
        } else if is_done && is_sent {
            Ok(())
        } else {
            Err("the bus does not go on")
        }
    }
}
