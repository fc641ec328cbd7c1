//! The ILI9341 at the end of its bus: mipidsi sets it up and knows its commands, the core writes them, and DMA sends the pixels.
//! Nothing waits for ever.

use cortex_m::peripheral::DWT;
use embedded_graphics_core::primitives::Rectangle;
use embedded_hal::delay::DelayNs;
use mipidsi::dcs::{
    BitsPerPixel, EnterNormalMode, ExitSleepMode, InterfaceExt, PixelFormat, SetAddressMode,
    SetColumnAddress, SetDisplayOn, SetInvertMode, SetPageAddress, SetPixelFormat, WriteMemoryStart,
};
use mipidsi::interface::{Interface, InterfaceKind};
use mipidsi::options::{ColorInversion, ColorOrder, Orientation, RefreshOrder, Rotation};
use mipidsi::{models::ILI9341Rgb565, Builder};
use stm32f4xx_hal::dma::traits::DmaFlagExt;
use stm32f4xx_hal::dma::{config::DmaConfig, DMAError, MemoryToPeripheral, Stream3, Transfer};
use stm32f4xx_hal::gpio::{Output, PA2, PA3, PA4};
use stm32f4xx_hal::pac::{DMA2, SPI1};
use stm32f4xx_hal::spi::{Spi, Tx};
use stm32f4xx_hal::{ClearFlags, ReadFlags};

/// The core's clock.
pub const MEGAHERTZ: u32 = 100;
/// Such a panel's columns run from right to left: a landscape that is not mirrored, MADCTL 0x28.
const ORIENTATION: Orientation = Orientation::new().rotate(Rotation::Deg90).flip_vertical();
const COLOR_ORDER: ColorOrder = ColorOrder::Bgr;
const INVERSION: ColorInversion = ColorInversion::Normal;
/// The longest time, in cycles, for which the bus may be busy: 20 ms. A strip of 8 rows takes 1.6 ms.
const PATIENCE: u32 = 20_000 * MEGAHERTZ;

/// Why something has not reached the panel.
pub type Problem = &'static str;

pub struct Panel {
    wire: Wire,
    reset: PA2<Output>,
    /// It has a strip always: the one that is being sent, or was sent last.
    transfer: Transfer<Stream3<DMA2>, 3, Tx<SPI1>, MemoryToPeripheral, &'static mut [u8]>,
    is_sending: bool,
}

/// The bus with the pins that select the panel and tell commands from data.
pub struct Wire {
    pub bus: Spi<SPI1, true>,
    pub select: PA4<Output>,
    pub command: PA3<Output>,
}

impl Panel {
    /// `free` is a strip that DMA keeps until it gets another one.
    pub fn new(
        wire: Wire,
        reset: PA2<Output>,
        (stream, sender): (Stream3<DMA2>, Tx<SPI1>),
        free: &'static mut [u8],
    ) -> Self {
        let config = DmaConfig::default().memory_increment(true);
        let transfer = Transfer::init_memory_to_peripheral(stream, sender, free, None, config);
        Self { wire, reset, transfer, is_sending: false }
    }

    /// Resets the panel and sets it up: at the start, and after an error of the bus.
    pub fn start(&mut self) -> Result<(), Problem> {
        // A strip that DMA still sends is given up.
        self.transfer.pause(|_| ());
        self.transfer.clear_all_flags();
        self.is_sending = false;
        let builder = Builder::new(ILI9341Rgb565, &mut self.wire).reset_pin(&mut self.reset);
        let builder = builder.orientation(ORIENTATION).color_order(COLOR_ORDER).invert_colors(INVERSION);
        builder.init(&mut Delay).map_err(|_| "the display does not start")?;
        Ok(())
    }

    /// Writes the registers again, without a reset: nothing is to be seen of it, unless the panel has lost its state.
    pub fn refresh(&mut self) -> Result<(), Problem> {
        self.finish()?;
        let wire = &mut self.wire;
        wire.write_command(SetAddressMode::new(COLOR_ORDER, ORIENTATION, RefreshOrder::default()))?;
        wire.write_command(SetInvertMode::new(INVERSION))?;
        wire.write_command(SetPixelFormat::new(PixelFormat::with_all(BitsPerPixel::Sixteen)))?;
        wire.write_command(EnterNormalMode)?;
        wire.write_command(ExitSleepMode)?;
        Delay.delay_ms(5);
        wire.write_command(SetDisplayOn)
    }

    /// Pixels in wire order into a window, by DMA, when all of the strip before has arrived. Returns that strip, or with an error the
    /// strip itself.
    pub fn send(
        &mut self,
        area: &Rectangle,
        strip: &'static mut [u8],
    ) -> Result<&'static mut [u8], (&'static mut [u8], Problem)> {
        if let Err(problem) = self.finish().and_then(|()| self.wire.open(area)) {
            return Err((strip, problem));
        }
        // What follows is data.
        self.wire.select.set_low();
        match self.transfer.next_transfer(strip) {
            Ok((sent, _)) => {
                self.is_sending = true;
                Ok(sent)
            }
            Err(DMAError::NotReady(strip) | DMAError::SmallBuffer(strip) | DMAError::Overrun(strip)) => {
                Err((strip, "DMA does not start"))
            }
        }
    }

    /// Waits until all of the strip has arrived.
    fn finish(&mut self) -> Result<(), Problem> {
        if !core::mem::take(&mut self.is_sending) {
            return Ok(());
        }
        within_time(|| {
            let flags = self.transfer.flags();
            match flags.is_transfer_error() || flags.is_direct_mode_error() {
                true => Some(Err("DMA has an error")),
                false => flags.is_transfer_complete().then_some(Ok(())),
            }
        })??;
        // DMA is done when the last two bytes are in the bus's registers.
        self.wire.finish()
    }
}

impl Wire {
    fn open(&mut self, area: &Rectangle) -> Result<(), Problem> {
        let (first, last) = (area.top_left, area.bottom_right().unwrap_or(area.top_left));
        let [left, top, right, bottom] = [first.x, first.y, last.x, last.y].map(|border| border as u16);
        self.write_command(SetColumnAddress::new(left, right))?;
        self.write_command(SetPageAddress::new(top, bottom))?;
        self.write_command(WriteMemoryStart)
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), Problem> {
        for &byte in bytes {
            within_time(|| self.bus.is_tx_empty().then_some(()))?;
            self.bus.write_nonblocking(byte).map_err(|_| "the bus has an error")?;
        }
        within_time(|| (!self.bus.is_busy()).then_some(()))
    }

    /// Waits for the last bit.
    fn finish(&mut self) -> Result<(), Problem> {
        within_time(|| (!self.bus.is_busy()).then_some(()))?;
        self.select.set_high();
        Ok(())
    }
}

/// For mipidsi's commands.
impl Interface for Wire {
    type Word = u8;
    type Error = Problem;

    const KIND: InterfaceKind = InterfaceKind::Serial4Line;

    fn send_command(&mut self, command: u8, parameters: &[u8]) -> Result<(), Problem> {
        self.command.set_low();
        self.select.set_low();
        self.write(&[command])?;
        self.command.set_high();
        self.write(parameters)?;
        self.finish()
    }

    fn send_pixels<const N: usize>(&mut self, _: impl IntoIterator<Item = [u8; N]>) -> Result<(), Problem> {
        Err("pixels go by DMA")
    }

    fn send_repeated_pixel<const N: usize>(&mut self, _: [u8; N], _: u32) -> Result<(), Problem> {
        Err("pixels go by DMA")
    }
}

/// Asks until there is an answer, for a limited time.
fn within_time<T>(mut ask: impl FnMut() -> Option<T>) -> Result<T, Problem> {
    let start = DWT::cycle_count();
    loop {
        if let Some(answer) = ask() {
            return Ok(answer);
        }
        if DWT::cycle_count().wrapping_sub(start) > PATIENCE {
            return Err("the bus does not go on");
        }
    }
}

/// Waits by counting, two cycles a round or a little more. The timers of the HAL would link `core::fmt`, by an `unwrap` of their own.
struct Delay;

impl DelayNs for Delay {
    fn delay_ns(&mut self, time: u32) {
        cortex_m::asm::delay(time.div_ceil(1000) * (MEGAHERTZ / 2)); // at most 4.3 million µs, times 50
    }
}
