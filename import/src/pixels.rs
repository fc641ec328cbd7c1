//! The pixels of PNG and BMP files, and pictures of another size.

use crate::bmp;
use std::io::Cursor;

/// The longest side of a picture that is read: more would take minutes, and memory.
pub(crate) const LONGEST: u32 = 8192;

/// A picture: red, green, blue and opacity of each pixel, row by row, the upper row first.
pub(crate) struct Pixels {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) colors: Vec<[u8; 4]>,
}

/// The picture in a file, whose format its first bytes say, not its name.
pub(crate) fn read(file: &[u8]) -> Result<Pixels, String> {
    if file.starts_with(b"\x89PNG") {
        png(file).map_err(|problem| format!("cannot be read: {problem}"))
    } else if file.starts_with(b"BM") {
        bmp::read(file).map_err(|problem| format!("cannot be read: {problem}"))
    } else {
        Err("is neither PNG nor BMP: convert it".into())
    }
}

fn png(file: &[u8]) -> Result<Pixels, Box<dyn std::error::Error>> {
    let mut decoder = png::Decoder::new(Cursor::new(file));
    // Without a palette, with opacity, of 8 or 16 bits.
    decoder.set_transformations(png::Transformations::ALPHA);
    let mut reader = decoder.read_info()?;
    let (width, height) = reader.info().size();
    if width.max(height) > LONGEST {
        return Err("has a side of more than 8192 pixels".into());
    }
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("is too large")?];
    let frame = reader.next_frame(&mut bytes)?;
    if frame.bit_depth == png::BitDepth::Sixteen {
        let level = |pair: &[u8]| ((u32::from(pair[0]) << 8 | u32::from(pair[1])) + 128) / 257;
        bytes = bytes.chunks_exact(2).map(|pair| level(pair) as u8).collect(); // at most 255
    }
    let colors = match frame.color_type {
        png::ColorType::GrayscaleAlpha => bytes.chunks_exact(2).map(|c| [c[0], c[0], c[0], c[1]]).collect(),
        _ => bytes.chunks_exact(4).map(|c| [c[0], c[1], c[2], c[3]]).collect(),
    };
    Ok(Pixels { width: width as usize, height: height as usize, colors })
}

/// The colours, row by row, of a picture of another size: each is the mean of the given pixels around it, weighted by a triangle
/// as wide as two of the larger pixels.
pub(crate) fn resampled(colors: &[[u8; 3]], from: [usize; 2], to: [usize; 2]) -> Vec<[u8; 3]> {
    let columns = turned(colors, from[0], to[0]);
    let rows = turned(&columns, from[1], to[1]);
    rows.into_iter().map(|color| color.map(|c| c.round().clamp(0.0, 255.0) as u8)).collect()
}

/// Rows of `from` pixels made rows of `to`, which are then the columns.
fn turned<T: Copy + Into<f32>>(colors: &[[T; 3]], from: usize, to: usize) -> Vec<[f32; 3]> {
    let ratio = from as f32 / to as f32;
    let reach = ratio.max(1.0);
    let mut out = Vec::with_capacity(colors.len() / from * to);
    for column in 0..to {
        let middle = (column as f32 + 0.5) * ratio;
        let first = (middle - reach).floor().max(0.0) as usize;
        let end = ((middle + reach).ceil() as usize).min(from);
        let weight = |x: usize| (1.0 - ((x as f32 + 0.5 - middle) / reach).abs()).max(0.0);
        let weights: Vec<f32> = (first..end).map(weight).collect();
        let sum: f32 = weights.iter().sum();
        for row in colors.chunks_exact(from) {
            let mut mean = [0.0; 3];
            for (color, weight) in row[first..end].iter().zip(&weights) {
                for (mean, &channel) in mean.iter_mut().zip(color) {
                    *mean += channel.into() * weight / sum;
                }
            }
            out.push(mean);
        }
    }
    out
}
