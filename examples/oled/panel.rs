//! A driver for the SSD0323, a controller of OLED panels of 128 × 64 pixels in 16 shades, on SPI.
//! (Solomon Systech, *SSD0323*, chapters on the command table and the graphic display data RAM.)

use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::primitives::Rectangle;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiBus;

/// Width and height in pixels. A byte is two pixels beside each other, the left one in the upper half.
pub(crate) const SIZE: Size = Size::new(128, 64);

const COLUMNS: u8 = 0x15;
const ROWS: u8 = 0x75;
const NORMAL: u8 = 0xA4;
const ON: u8 = 0xAF;

/// The panel, alone on its bus and selected.
pub(crate) struct Ssd0323<SPI, DC> {
    spi: SPI,
    data_command: DC,
}

/// Why nothing, or not all, was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Error<S, P> {
    /// The bus failed.
    Spi(S),
    /// The D/C pin failed.
    Pin(P),
    /// Pixels that share no whole bytes, or lie beside the panel, or are not as many as their window has. The panel
    /// cannot be read over SPI, so half a byte cannot be written: x and width are even.
    Window,
}

type Result<SPI, DC> = core::result::Result<
    (),
    Error<<SPI as embedded_hal::spi::ErrorType>::Error, <DC as embedded_hal::digital::ErrorType>::Error>,
>;

impl<SPI: SpiBus, DC: OutputPin> Ssd0323<SPI, DC> {
    /// Turns the panel on: normal mode, the memory as it is. How its glass is wired to the controller (remap, offset,
    /// multiplex ratio) and its currents are a module's own; they stay as after reset.
    ///
    /// # Errors
    ///
    /// [`Error::Spi`] and [`Error::Pin`].
    pub(crate) fn new(
        spi: SPI,
        data_command: DC,
    ) -> core::result::Result<Self, Error<SPI::Error, DC::Error>> {
        let mut panel = Self { spi, data_command };
        panel.command(&[NORMAL, ON])?;
        Ok(panel)
    }

    /// Sends the pixels of a window row by row, two a byte: what [`Band::bytes`](pinhole::bands::Band::bytes) has.
    ///
    /// # Errors
    ///
    /// [`Error::Window`], and nothing was sent; [`Error::Spi`] and [`Error::Pin`].
    pub(crate) fn write(&mut self, area: &Rectangle, pixels: &[u8]) -> Result<SPI, DC> {
        if pixels.len() as u64 * 2 != u64::from(area.size.width) * u64::from(area.size.height) {
            return Err(Error::Window);
        }
        self.window(area)?;
        self.data_command.set_high().map_err(Error::Pin)?;
        self.send(pixels)
    }

    /// Where the next pixels go: from left to right, row by row.
    fn window(&mut self, area: &Rectangle) -> Result<SPI, DC> {
        let Size { width, height } = area.size;
        let (Ok(x), Ok(y)) = (u32::try_from(area.top_left.x), u32::try_from(area.top_left.y)) else {
            return Err(Error::Window);
        };
        let (right, bottom) = (x.saturating_add(width), y.saturating_add(height));
        let inside = right <= SIZE.width && bottom <= SIZE.height;
        if !inside || width == 0 || height == 0 || x % 2 != 0 || width % 2 != 0 {
            return Err(Error::Window);
        }
        // Columns are counted in bytes; all below 128.
        self.command(&[COLUMNS, (x / 2) as u8, (right / 2 - 1) as u8, ROWS, y as u8, (bottom - 1) as u8])
    }

    /// Sends a command with what belongs to it, whatever it is.
    ///
    /// # Errors
    ///
    /// [`Error::Spi`] and [`Error::Pin`].
    pub(crate) fn command(&mut self, bytes: &[u8]) -> Result<SPI, DC> {
        self.data_command.set_low().map_err(Error::Pin)?;
        self.send(bytes)
    }

    /// All of it is on the wire when this ends: the D/C pin may change then.
    fn send(&mut self, bytes: &[u8]) -> Result<SPI, DC> {
        self.spi.write(bytes).map_err(Error::Spi)?;
        self.spi.flush().map_err(Error::Spi)
    }
}
