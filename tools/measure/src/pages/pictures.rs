//! The pictures of the crate's documentation, as data URLs: docs.rs shows no file of the repository. Colours are rounded to 6 levels
//! a channel, so that all pictures together take less than 30 KB.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;
use pinhole_apps_support::still;
use png::{ColorType, Decoder, Transformations};
use std::error::Error;
use std::fmt::Write;
use std::io::Cursor;

/// The folder of the book's cookbook, all of whose pictures are shown.
const COOKBOOK: &str = "docs/cookbook";

pub(crate) fn definitions() -> Result<String, String> {
    let folder = std::fs::read_dir(super::root().join(COOKBOOK));
    let entries = folder.map_err(|e| format!("{COOKBOOK}: cannot be read: {e}"))?;
    let names = entries.flatten().map(|entry| format!("{COOKBOOK}/{}", entry.file_name().to_string_lossy()));
    let mut paths: Vec<String> = names.chain(["docs/part.png".to_string()]).collect();
    paths.sort();
    let mut text = String::new();
    for path in paths {
        let small = small(&path).map_err(|e| format!("{path}: {e}"))?;
        let _ = writeln!(text, "[{path}]: data:image/png;base64,{}", base64(&small));
    }
    text.push('\n');
    Ok(text)
}

/// A PNG file of fewer colours.
fn small(path: &str) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut decoder = Decoder::new(Cursor::new(std::fs::read(super::root().join(path))?));
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info()?;
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("too large")?];
    let info = reader.next_frame(&mut bytes)?;
    if info.color_type != ColorType::Rgb {
        return Err("has transparent pixels or greys".into());
    }
    let level = |byte: u8| (u16::from(byte) * 5 + 127) / 255 * 51;
    let [red, green, blue] = [0, 1, 2].map(|channel| bytes.iter().skip(channel).step_by(3));
    let channels = red.zip(green).zip(blue);
    let colors = channels.map(|((&r, &g), &b)| [r, g, b].map(|byte| level(byte) as u8));
    let pixels: Vec<Rgb888> = colors.map(|[r, g, b]| Rgb888::new(r, g, b)).collect();
    still::png(Size::new(info.width, info.height), &pixels)
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let word = (0..3).fold(0, |word, i| word << 8 | three.get(i).map_or(0, |&byte| u32::from(byte)));
        for digit in 0..4 {
            let index = word >> (18 - 6 * digit) & 63;
            text.push(if digit > three.len() { '=' } else { char::from(DIGITS[index as usize]) });
        }
    }
    text
}
