//! The ST7789 at the end of its bus: mipidsi sets it up and opens windows, DMA fills them.

use crate::stop::stop;
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::primitives::Rectangle;
use embedded_hal::{delay::DelayNs, digital::OutputPin, spi::SpiBus};
use embedded_hal_bus::spi::{ExclusiveDevice, NoDelay};
use mipidsi::dcs::{InterfaceExt, SetColumnAddress, SetPageAddress, WriteMemoryStart};
use mipidsi::{interface::SpiInterface, models::ST7789, options::ColorInversion, Builder};
use rp2040_hal::dma::{single_buffer, SingleChannel, WriteTarget};

/// Where the glass's first pixel lies in the controller's memory, which is 240 × 320: (0, 80) on modules that show the
/// lower part of it. mipidsi's own offset is for windows that it opens itself.
const OFFSET: Point = Point::new(0, 0);

/// At rest: its bus, a channel of DMA, and the pins that select it and tell commands from data.
pub struct Panel<Bus, Channel, Pin> {
    bus: Bus,
    channel: Channel,
    select: Pin,
    command: Pin,
}

/// A strip that is being sent.
pub struct Transfer<Bus: WriteTarget, Channel: SingleChannel, Pin> {
    running: single_buffer::Transfer<Channel, &'static mut [u8], Bus>,
    select: Pin,
    command: Pin,
}

impl<Bus, Channel, Pin> Panel<Bus, Channel, Pin>
where
    Bus: SpiBus + WriteTarget<TransmittedWord = u8>,
    Channel: SingleChannel,
    Pin: OutputPin,
{
    /// Sets the controller up.
    pub fn new(
        bus: Bus,
        channel: Channel,
        select: Pin,
        command: Pin,
        reset: Pin,
        delay: &mut impl DelayNs,
    ) -> Self {
        let mut panel = Self { bus, channel, select, command };
        let builder = Builder::new(ST7789, panel.interface()).display_size(240, 240);
        let builder = builder.invert_colors(ColorInversion::Inverted).reset_pin(reset);
        if builder.init(delay).is_err() {
            stop("the display does not start")
        }
        panel
    }

    /// Pixels in wire order into a window, by DMA.
    pub fn send(mut self, area: &Rectangle, strip: &'static mut [u8]) -> Transfer<Bus, Channel, Pin> {
        let (first, last) = (area.top_left + OFFSET, area.bottom_right().unwrap_or(area.top_left) + OFFSET);
        let [left, top, right, bottom] = [first.x, first.y, last.x, last.y].map(|border| border as u16);
        let mut interface = self.interface();
        let window = interface
            .write_command(SetColumnAddress::new(left, right))
            .and_then(|()| interface.write_command(SetPageAddress::new(top, bottom)))
            .and_then(|()| interface.write_command(WriteMemoryStart));
        if window.is_err() {
            stop("the display refused a command")
        }

        let Self { bus, channel, mut select, mut command } = self;
        // What follows is data.
        if command.set_high().and_then(|()| select.set_low()).is_err() {
            stop("a pin of the display")
        }
        Transfer { running: single_buffer::Config::new(channel, strip, bus).start(), select, command }
    }

    /// For commands. Its buffer would be for pixels.
    fn interface(&mut self) -> SpiInterface<'_, ExclusiveDevice<&mut Bus, &mut Pin, NoDelay>, &mut Pin> {
        let device = ExclusiveDevice::new_no_delay(&mut self.bus, &mut self.select);
        SpiInterface::new(device.unwrap_or_else(|_| stop("a pin of the display")), &mut self.command, &mut [])
    }
}

impl<Bus, Channel, Pin> Transfer<Bus, Channel, Pin>
where
    Bus: SpiBus + WriteTarget<TransmittedWord = u8>,
    Channel: SingleChannel,
    Pin: OutputPin,
{
    /// The panel and the strip, when all has arrived.
    pub fn wait(self) -> (Panel<Bus, Channel, Pin>, &'static mut [u8]) {
        let Self { running, mut select, command } = self;
        let (channel, strip, mut bus) = running.wait();
        // DMA is done when the last bytes are in the bus's queue.
        if bus.flush().is_err() || select.set_high().is_err() {
            stop("the bus of the display")
        }
        (Panel { bus, channel, select, command }, strip)
    }
}
