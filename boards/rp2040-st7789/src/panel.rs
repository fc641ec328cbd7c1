//! The ST7789 at the end of its bus: mipidsi sets it up and knows its commands, DMA fills its windows. Nothing waits for ever.

use crate::stop::stop;
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::primitives::Rectangle;
use embedded_hal::{delay::DelayNs, digital::OutputPin, spi::SpiBus};
use embedded_hal_bus::spi::{ExclusiveDevice, NoDelay};
use mipidsi::dcs::{
    BitsPerPixel, EnterNormalMode, ExitSleepMode, InterfaceExt, PixelFormat, SetAddressMode,
    SetColumnAddress, SetDisplayOn, SetInvertMode, SetPageAddress, SetPixelFormat, WriteMemoryStart,
};
use mipidsi::options::{ColorInversion, ColorOrder, Orientation, RefreshOrder};
use mipidsi::{interface::SpiInterface, models::ST7789, Builder};
use rp2040_hal::dma::{single_buffer, SingleChannel, WriteTarget};
use rp2040_hal::Timer;

/// Where the glass's first pixel lies in the controller's memory, which is 240 × 320: (0, 80) on modules that show the
/// lower part of it. mipidsi's own offset is for windows that it opens itself.
const OFFSET: Point = Point::new(0, 0);
const INVERSION: ColorInversion = ColorInversion::Inverted;
/// The longest time, in µs, that a strip may take. One of 40 rows takes 2.5 ms.
const PATIENCE: u32 = 20_000;

/// Why something has not reached the panel.
pub type Problem = &'static str;

/// The panel, with a strip that DMA sends or has sent.
pub struct Panel<Bus: WriteTarget, Channel: SingleChannel, Pin> {
    /// `None` only while it changes.
    line: Option<Line<Bus, Channel>>,
    pins: Pins<Pin>,
    timer: Timer,
}

/// The pins that select the panel, tell commands from data, and reset the panel.
pub struct Pins<Pin> {
    pub select: Pin,
    pub command: Pin,
    pub reset: Pin,
}

enum Line<Bus: WriteTarget, Channel: SingleChannel> {
    Idle(Channel, &'static mut [u8], Bus),
    Sending(single_buffer::Transfer<Channel, &'static mut [u8], Bus>),
}

impl<Bus, Channel, Pin> Panel<Bus, Channel, Pin>
where
    Bus: SpiBus + WriteTarget<TransmittedWord = u8>,
    Channel: SingleChannel,
    Pin: OutputPin,
{
    /// `free` is a strip that is kept until there is another one.
    pub fn new(bus: Bus, channel: Channel, pins: Pins<Pin>, timer: Timer, free: &'static mut [u8]) -> Self {
        Self { line: Some(Line::Idle(channel, free, bus)), pins, timer }
    }

    /// Resets the panel and sets it up: at the start, and after an error of the bus.
    pub fn start(&mut self) -> Result<(), Problem> {
        let mut delay = Delay(self.timer);
        self.finish().ok(); // what is on its way is given up
        let (mut interface, reset) = self.interface();
        let builder = Builder::new(ST7789, &mut interface).display_size(240, 240);
        let builder = builder.invert_colors(INVERSION).reset_pin(reset);
        builder.init(&mut delay).map(|_| ()).map_err(|_| "the display does not start")
    }

    /// Writes the registers again, without a reset: nothing is to be seen of it, unless the panel has lost its state.
    pub fn refresh(&mut self) -> Result<(), Problem> {
        self.finish()?;
        let mut delay = Delay(self.timer);
        let (mut interface, _) = self.interface();
        let access = SetAddressMode::new(ColorOrder::Rgb, Orientation::new(), RefreshOrder::default());
        let format = SetPixelFormat::new(PixelFormat::with_all(BitsPerPixel::Sixteen));
        let registers = interface
            .write_command(access)
            .and_then(|()| interface.write_command(SetInvertMode::new(INVERSION)))
            .and_then(|()| interface.write_command(format))
            .and_then(|()| interface.write_command(EnterNormalMode))
            .and_then(|()| interface.write_command(ExitSleepMode))
            .map(|()| delay.delay_ms(5))
            .and_then(|()| interface.write_command(SetDisplayOn));
        registers.map_err(|_| "the display refused a command")
    }

    /// Pixels in wire order into a window, by DMA, when all of the strip before has arrived. Returns that strip, or with an error the
    /// strip itself.
    pub fn send(
        &mut self,
        area: &Rectangle,
        strip: &'static mut [u8],
    ) -> Result<&'static mut [u8], (&'static mut [u8], Problem)> {
        if let Err(problem) = self.finish().and_then(|()| self.open(area)) {
            return Err((strip, problem));
        }
        // What follows is data.
        if self.pins.command.set_high().and_then(|()| self.pins.select.set_low()).is_err() {
            return Err((strip, "a pin of the display"));
        }
        let Some(Line::Idle(channel, sent, bus)) = self.line.take() else { stop("the display is in use") };
        self.line = Some(Line::Sending(single_buffer::Config::new(channel, strip, bus).start()));
        Ok(sent)
    }

    fn open(&mut self, area: &Rectangle) -> Result<(), Problem> {
        let (first, last) = (area.top_left + OFFSET, area.bottom_right().unwrap_or(area.top_left) + OFFSET);
        let [left, top, right, bottom] = [first.x, first.y, last.x, last.y].map(|border| border as u16);
        let (mut interface, _) = self.interface();
        let window = interface
            .write_command(SetColumnAddress::new(left, right))
            .and_then(|()| interface.write_command(SetPageAddress::new(top, bottom)))
            .and_then(|()| interface.write_command(WriteMemoryStart));
        window.map_err(|_| "the display refused a command")
    }

    /// Waits until all of the strip has arrived.
    fn finish(&mut self) -> Result<(), Problem> {
        let (line, arrived) = match self.line.take() {
            Some(Line::Sending(running)) => {
                let start = self.timer.get_counter_low();
                let is_late = || self.timer.get_counter_low().wrapping_sub(start) > PATIENCE;
                while !running.is_done() && !is_late() {}
                let is_done = running.is_done();
                let (channel, strip, mut bus) = if is_done { running.wait() } else { running.abort() };
                // DMA is done when the last bytes are in the bus's queue.
                let is_sent = bus.flush().is_ok() && self.pins.select.set_high().is_ok();
                let arrived = if is_done && is_sent { Ok(()) } else { Err("the bus does not go on") };
                (Line::Idle(channel, strip, bus), arrived)
            }
            Some(line) => (line, Ok(())),
            None => stop("the display is in use"),
        };
        self.line = Some(line);
        arrived
    }

    /// For commands, with the reset pin. Its buffer would be for pixels.
    #[allow(clippy::type_complexity)]
    fn interface(
        &mut self,
    ) -> (SpiInterface<'_, ExclusiveDevice<&mut Bus, &mut Pin, NoDelay>, &mut Pin>, &mut Pin) {
        let Some(Line::Idle(_, _, bus)) = &mut self.line else { stop("the display is in use") };
        let device = ExclusiveDevice::new_no_delay(bus, &mut self.pins.select);
        let device = device.unwrap_or_else(|_| stop("a pin of the display"));
        (SpiInterface::new(device, &mut self.pins.command, &mut []), &mut self.pins.reset)
    }
}

/// The timer counts microseconds: it may be up to one short.
struct Delay(Timer);

impl DelayNs for Delay {
    fn delay_ns(&mut self, time: u32) {
        self.0.delay_ns(time.saturating_add(1000));
    }
}
