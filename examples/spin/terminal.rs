//! A picture as text.

use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use std::io::IsTerminal;

/// The picture, `columns` characters wide: half blocks in colour on a terminal, shades of ASCII in a file or a pipe and
/// where the user asked for no colour (`NO_COLOR`).
pub(crate) fn picture(pixels: &[Rgb565], size: Size, columns: u32) -> String {
    let columns = columns.min(size.width);
    let rows = (columns * size.height / size.width / 2).max(1);
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let mut text = String::new();
    for row in 0..rows {
        for column in 0..columns {
            if colour {
                let [top, bottom] = [2 * row, 2 * row + 1].map(|half| {
                    let c = mean(pixels, size, (column, columns), (half, 2 * rows));
                    format!("{};{};{}", c.r(), c.g(), c.b())
                });
                text += &format!("\x1b[38;2;{top}m\x1b[48;2;{bottom}m▀");
            } else {
                let c = mean(pixels, size, (column, columns), (row, rows));
                text.push(shade(c));
            }
        }
        let line = text.trim_end_matches(' ').len();
        text.truncate(line);
        text += if colour { "\x1b[0m\n" } else { "\n" };
    }
    text
}

/// The mean colour of the cell at `x.0` of `x.1` columns and `y.0` of `y.1` rows.
fn mean(pixels: &[Rgb565], size: Size, x: (u32, u32), y: (u32, u32)) -> Rgb888 {
    let range = |(at, of): (u32, u32), extent: u32| {
        let start = at * extent / of;
        start..((at + 1) * extent / of).clamp(start + 1, extent.max(start + 1))
    };
    let (mut sum, mut count) = ([0, 0, 0], 0);
    for row in range(y, size.height) {
        for column in range(x, size.width) {
            let Some(&pixel) = pixels.get((row * size.width + column) as usize) else {
                continue;
            };
            let c = Rgb888::from(pixel);
            for (total, channel) in sum.iter_mut().zip([c.r(), c.g(), c.b()]) {
                *total += u32::from(channel);
            }
            count += 1;
        }
    }
    // A mean of bytes is a byte.
    let [r, g, b] = sum.map(|total| (total / count.max(1)) as u8);
    Rgb888::new(r, g, b)
}

/// A character as bright as the colour.
fn shade(c: Rgb888) -> char {
    const SHADES: &[u8; 10] = b" .:-=+*#%@";
    let luminance = (u32::from(c.r()) * 30 + u32::from(c.g()) * 59 + u32::from(c.b()) * 11) / 100;
    char::from(SHADES[(luminance * 10 / 256) as usize])
}
