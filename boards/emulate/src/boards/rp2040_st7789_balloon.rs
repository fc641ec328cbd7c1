//! The pictures of the example `balloon` of `boards/rp2040-st7789`, whose scene is compiled here, too.

use super::Pictures;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::DepthBuffer;
use std::path::Path;
use support::panel::framebuffer::Framebuffer;
use support::panel::screen::StoredPixel;

#[allow(dead_code, unreachable_pub)] // as a file of its own it is right
#[path = "../../../rp2040-st7789/examples/balloon/scene.rs"]
mod scene;

use scene::{Buffers, Scene, MORNING, WAY};

/// As in the firmware's `main.rs`.
pub(crate) const FRAMES: u32 = 96;
const SIZE: Size = Size::new(240, 240);

/// Drawn in one piece, pixel by pixel; there is no model.
pub(crate) fn pictures(_: &Path) -> Result<Pictures, String> {
    let scene = Scene::new(SIZE, &MORNING)?;
    let mut buffers = Buffers::new();
    let mut depths = vec![0; (SIZE.width * SIZE.height) as usize];
    Ok(Box::new(move |frame| {
        let mut picture = Framebuffer::new(SIZE, Rgb565::from(MORNING.mist));
        let depth = DepthBuffer::new(Rectangle::new(Point::zero(), SIZE), &mut depths);
        let mut depth = depth.map_err(|error| error.to_string())?;
        let Ok(()) =
            scene.frame(frame as i32 * WAY / FRAMES as i32, &mut buffers)?.draw(&mut depth, &mut picture);
        Ok(picture.pixels().iter().map(|color| color.stored()).collect())
    }))
}
