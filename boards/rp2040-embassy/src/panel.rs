//! The ST7789 at the end of its bus: mipidsi sets it up and opens windows, and pixels are sent by a transfer that is awaited.

use embedded_graphics::geometry::Point;
use embedded_graphics::primitives::Rectangle;
use embedded_hal::{delay::DelayNs, digital::OutputPin};
use embedded_hal_bus::spi::{ExclusiveDevice, NoDelay};
use mipidsi::dcs::{InterfaceExt, SetColumnAddress, SetPageAddress, WriteMemoryStart};
use mipidsi::{interface::SpiInterface, models::ST7789, options::ColorInversion, Builder};

/// Where the glass's first pixel lies in the controller's memory, which is 240 × 320: (0, 80) on modules that show the
/// lower part of it. mipidsi's own offset is for windows that it opens itself.
const OFFSET: Point = Point::new(0, 0);
/// Commands and their arguments before the pixels of a window, in bytes.
pub const WINDOW_BYTES: u16 = pinhole::bands::TransferCost::MIPI_DCS;

/// The display's bus, which is blocking for a few bytes of commands and awaited for pixels, and its pins: `select` is low while
/// it is addressed, `command` is low while commands are sent, `reset` stays high.
pub struct Panel<Bus, Pin> {
    bus: Bus,
    select: Pin,
    command: Pin,
    reset: Pin,
}

impl<Bus, Pin> Panel<Bus, Pin>
where
    Bus: embedded_hal::spi::SpiBus + embedded_hal_async::spi::SpiBus,
    Pin: OutputPin,
{
    /// Sets the controller up, which takes 0.3 s. All pins are high.
    pub fn new(
        bus: Bus,
        select: Pin,
        command: Pin,
        reset: Pin,
        delay: &mut impl DelayNs,
    ) -> Result<Self, &'static str> {
        let mut panel = Self { bus, select, command, reset };
        let interface = interface(&mut panel.bus, &mut panel.select, &mut panel.command)?;
        let builder = Builder::new(ST7789, interface).display_size(240, 240);
        let builder = builder.invert_colors(ColorInversion::Inverted).reset_pin(&mut panel.reset);
        builder.init(delay).map_err(|_| "the display does not start")?;
        Ok(panel)
    }

    /// Sends pixels in wire order into a window. The bytes of the window's commands are sent at once; other tasks run while the
    /// pixels are sent.
    pub async fn send(&mut self, area: &Rectangle, bytes: &[u8]) -> Result<(), &'static str> {
        let (first, last) = (area.top_left + OFFSET, area.bottom_right().unwrap_or(area.top_left) + OFFSET);
        // All lie on the display.
        let [left, top, right, bottom] = [first.x, first.y, last.x, last.y].map(|border| border as u16);
        let mut interface = interface(&mut self.bus, &mut self.select, &mut self.command)?;
        interface
            .write_command(SetColumnAddress::new(left, right))
            .and_then(|()| interface.write_command(SetPageAddress::new(top, bottom)))
            .and_then(|()| interface.write_command(WriteMemoryStart))
            .map_err(|_| "the display refuses a command")?;

        let selected = self.command.set_high().and_then(|()| self.select.set_low());
        selected.map_err(|_| "a pin of the display cannot be set")?;
        let sent = embedded_hal_async::spi::SpiBus::write(&mut self.bus, bytes).await;
        let sent = match sent {
            Ok(()) => embedded_hal_async::spi::SpiBus::flush(&mut self.bus).await,
            error => error,
        };
        self.select.set_high().map_err(|_| "a pin of the display cannot be set")?;
        sent.map_err(|_| "the bus of the display fails")
    }
}

type Interface<'a, Bus, Pin> =
    SpiInterface<'a, ExclusiveDevice<&'a mut Bus, &'a mut Pin, NoDelay>, &'a mut Pin>;

/// For commands. Its buffer would be for pixels.
fn interface<'a, Bus: embedded_hal::spi::SpiBus, Pin: OutputPin>(
    bus: &'a mut Bus,
    select: &'a mut Pin,
    command: &'a mut Pin,
) -> Result<Interface<'a, Bus, Pin>, &'static str> {
    let device =
        ExclusiveDevice::new_no_delay(bus, select).map_err(|_| "a pin of the display cannot be set")?;
    Ok(SpiInterface::new(device, command, &mut []))
}
