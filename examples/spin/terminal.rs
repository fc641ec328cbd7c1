//! Prints a picture as text.

use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use std::io::IsTerminal;

/// Width of the text.
const COLUMNS: u32 = 72;

/// The rows of the picture that are not all background, as text: half blocks in colour on a
/// terminal, shades of ASCII in a file or a pipe and where the user asked for no colour (`NO_COLOR`).
pub(crate) fn picture(pixels: &[Rgb565], size: Size, background: Rgb565) -> String {
    let width = size.width as usize;
    let empty = |row: &&[Rgb565]| row.iter().all(|&c| c == background);
    let above = pixels.chunks_exact(width).take_while(empty).count();
    let pixels = &pixels[above * width..];
    let below = pixels.rchunks_exact(width).take_while(empty).count();
    let pixels = &pixels[..pixels.len() - below * width];
    let size = Size::new(size.width, (pixels.len() / width) as u32);

    let columns = COLUMNS.min(size.width);
    let rows = (columns * size.height / size.width).div_ceil(2);
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let mut text = String::new();
    for row in 0..rows {
        let mut line = String::new();
        for column in 0..columns {
            if colour {
                let [top, bottom] = [2 * row, 2 * row + 1].map(|half| {
                    let c = mean(pixels, size, (column, columns), (half, 2 * rows));
                    format!("{};{};{}", c.r(), c.g(), c.b())
                });
                line += &format!("\x1b[38;2;{top}m\x1b[48;2;{bottom}m▀");
            } else {
                line.push(shade(mean(pixels, size, (column, columns), (row, rows))));
            }
        }
        text += line.trim_end();
        text += if colour { "\x1b[0m\n" } else { "\n" };
    }
    text
}

/// The mean colour of the cell at `x.0` of `x.1` columns and `y.0` of `y.1` rows; at least a pixel.
fn mean(pixels: &[Rgb565], size: Size, x: (u32, u32), y: (u32, u32)) -> Rgb888 {
    let range = |(at, of): (u32, u32), extent: u32| {
        let start = at * extent / of;
        start..((at + 1) * extent / of).max(start + 1)
    };
    let (mut sum, mut count) = ([0, 0, 0], 0);
    for row in range(y, size.height) {
        for column in range(x, size.width) {
            let c = Rgb888::from(pixels[(row * size.width + column) as usize]);
            for (total, channel) in sum.iter_mut().zip([c.r(), c.g(), c.b()]) {
                *total += u32::from(channel);
            }
            count += 1;
        }
    }
    // A mean of bytes is a byte.
    let [r, g, b] = sum.map(|total| (total / count) as u8);
    Rgb888::new(r, g, b)
}

/// A character with the brightness of a colour.
fn shade(c: Rgb888) -> char {
    const SHADES: &[u8; 10] = b" .:-=+*#%@";
    let luminance = (u32::from(c.r()) * 30 + u32::from(c.g()) * 59 + u32::from(c.b()) * 11) / 100;
    char::from(SHADES[(luminance * 10 / 256) as usize])
}
