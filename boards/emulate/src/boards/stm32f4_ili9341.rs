//! The pictures of `boards/stm32f4-ili9341`. Its drawing code is that of `boards/any-cortex-m`, word by word (`boards/share`), which
//! `pinhole-render` draws with.

use super::Pictures;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb565;
use pinhole::Angle;
use pinhole_render::firmware;
use std::path::Path;
use support::panel::framebuffer::Framebuffer;
use support::panel::screen::StoredPixel;

/// As in the firmware's `src/main.rs`.
pub(crate) const FRAMES: u32 = 48;
const SIZE: Size = Size::new(320, 240);

pub(crate) fn pictures(model: &Path) -> Result<Pictures, String> {
    let imported = super::import(model)?;
    Ok(Box::new(move |frame| {
        let mut picture = Framebuffer::new(SIZE, Rgb565::new(31, 0, 31));
        firmware::draw(&imported, Angle::turns(frame as i32, FRAMES), &mut picture)?;
        Ok(picture.pixels().iter().map(|color| color.stored()).collect())
    }))
}
