//! The pictures of `boards/rp2040-st7789`, whose drawing code is compiled here, too.

use super::Pictures;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb565;
use pinhole::Angle;
use std::path::Path;
use support::panel::framebuffer::Framebuffer;
use support::panel::screen::StoredPixel;

#[allow(dead_code, unreachable_pub)] // as a file of its own it is right
#[path = "../../../rp2040-st7789/src/picture.rs"]
mod picture;
#[allow(unreachable_pub)] // as the macro writes it
mod drawing {
    use super::picture;
    pinhole_render::draws_bands!(picture);
}

/// As in the firmware's `src/main.rs`.
pub(crate) const FRAMES: u32 = 120;
const SIZE: Size = Size::new(240, 240);

pub(crate) fn pictures(model: &Path) -> Result<Pictures, String> {
    let imported = super::import(model)?;
    Ok(Box::new(move |frame| {
        let mut picture = Framebuffer::new(SIZE, Rgb565::new(31, 0, 31));
        drawing::draw(&imported, Angle::turns(frame as i32, FRAMES), &mut picture)?;
        Ok(picture.pixels().iter().map(|color| color.stored()).collect())
    }))
}
