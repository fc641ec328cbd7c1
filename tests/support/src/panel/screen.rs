//! The driver mipidsi at the bus of the controller, for the panels and colours that the tests use.

use super::bus::{DataOrCommand, NoDelay, Panel};
use super::Held;
use embedded_graphics::pixelcolor::{Rgb565, Rgb666};
use embedded_graphics::prelude::*;
use mipidsi::interface::{InterfacePixelFormat, SpiInterface};
use mipidsi::models::{ILI9341Rgb565, ILI9341Rgb666, Model, ST7789};
use mipidsi::options::{Orientation, Rotation};
use mipidsi::{Builder, Display, NoResetPin};

/// The driver's interface, with a buffer that it gathers pixels in: one that no band's end meets.
pub type Bus = SpiInterface<'static, Panel, DataOrCommand>;

/// A panel and its driver.
pub struct Screen<M: Kind> {
    pub panel: Panel,
    pub display: Display<Bus, M, NoResetPin>,
    held: Held,
}

/// A panel that the driver supports, with its settings.
pub trait Kind: Model<ColorFormat: InterfacePixelFormat<u8>> + Sized {
    const NAME: &'static str;
    const SIZE: Size;
    const HELD: Held;
    fn model() -> Self;
}

macro_rules! kinds {
    ($($model:ident, $name:literal, [$width:literal, $height:literal], $held:ident;)*) => {$(
        impl Kind for $model {
            const NAME: &'static str = $name;
            const SIZE: Size = Size::new($width, $height);
            const HELD: Held = Held::$held;
            fn model() -> Self {
                $model
            }
        }
    )*};
}

kinds! {
    ST7789, "ST7789, 240 × 240, Rgb565", [240, 240], Upright;
    ILI9341Rgb565, "ILI9341, 320 × 240, Rgb565", [320, 240], Landscape;
    ILI9341Rgb666, "ILI9341, 320 × 240, Rgb666", [320, 240], Landscape;
}

/// A colour as the controller's memory stores it.
pub trait StoredPixel: PixelColor {
    fn stored(self) -> u32;
}

impl StoredPixel for Rgb565 {
    fn stored(self) -> u32 {
        u32::from(self.r()) << 11 | u32::from(self.g()) << 5 | u32::from(self.b())
    }
}

impl StoredPixel for Rgb666 {
    fn stored(self) -> u32 {
        u32::from(self.r()) << 12 | u32::from(self.g()) << 6 | u32::from(self.b())
    }
}

impl<M: Kind> Screen<M> {
    /// An initialized panel; the bytes of the initialization are not counted.
    pub fn new() -> Self {
        let panel = Panel::new();
        let buffer = Vec::leak(vec![0; 100]);
        let bus = SpiInterface::new(panel.clone(), panel.data_or_command(), buffer);
        let (size, landscape) = (M::SIZE, M::HELD == Held::Landscape);
        let (width, height) = if landscape { (size.height, size.width) } else { (size.width, size.height) };
        let turn = if landscape { Rotation::Deg90 } else { Rotation::Deg0 };
        let Ok(display) = Builder::new(M::model(), bus)
            .display_size(width as u16, height as u16)
            .orientation(Orientation::new().rotate(turn))
            .init(&mut NoDelay)
        else {
            panic!("{} cannot be set up", M::NAME);
        };
        panel.controller_mut().count();
        Self { panel, display, held: M::HELD }
    }

    /// Bytes and windows since the last call.
    pub fn count(&self) -> (usize, usize) {
        self.panel.controller_mut().count()
    }

    /// The visible picture; panics if the controller received a wrong command.
    pub fn picture(&self) -> Vec<u32> {
        let controller = self.panel.controller();
        assert!(controller.errors.is_empty(), "{:?}", controller.errors);
        controller.picture(self.held, M::SIZE.width as usize, M::SIZE.height as usize)
    }
}
