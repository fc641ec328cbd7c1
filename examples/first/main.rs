//! The README's first firmware on the host. `picture.rs` is exactly its code: `tests/device/first.rs` compares them, and follows the
//! README from an empty folder.
//!
//! ```text
//! cargo run --release --example first     # writes target/first/first.png
//! ```

#[allow(unreachable_pub)] // as a file of its own it is right
mod picture;

use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use embedded_graphics::prelude::{DrawTarget, OriginDimensions, Pixel, Size};
use pinhole::Angle;
use pinhole_apps_support::{command, files, still};
use std::convert::Infallible;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::run(run)
}

fn run() -> Result<ExitCode, Box<dyn Error>> {
    let mut screen = Screen(vec![Rgb565::MAGENTA; 240 * 240]);
    picture::draw(&mut screen, Angle::degrees(30))?;
    let folder = Path::new("target/first");
    command::folder(folder)?;
    let file = folder.join("first.png");
    let pixels: Vec<Rgb888> = screen.0.iter().map(|&colour| colour.into()).collect();
    let png = still::png(screen.size(), &pixels)?;
    files::write(&[(&*file, png)])?;
    command::say(format_args!("{}: a picture", file.display()))?;
    Ok(ExitCode::SUCCESS)
}

/// Stands for a display and its driver.
struct Screen(Vec<Rgb565>);

impl OriginDimensions for Screen {
    fn size(&self) -> Size {
        Size::new(240, 240)
    }
}

impl DrawTarget for Screen {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, colour) in pixels {
            let inside = (0..240).contains(&at.x) && (0..240).contains(&at.y);
            if let Some(pixel) = self.0.get_mut((at.y * 240 + at.x) as usize).filter(|_| inside) {
                *pixel = colour;
            }
        }
        Ok(())
    }
}
