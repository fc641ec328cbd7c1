//! The pixels of PNG and BMP files, pictures of another size, and palettes.

use crate::picture::Indexed;
use crate::{IndexedPicture, Problem, TextureFormat, Warning};
use std::collections::BTreeMap;
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
        bmp(file).map_err(|problem| format!("cannot be read: {problem}"))
    } else {
        Err("is neither PNG nor BMP: convert it".into())
    }
}

/// The picture in the format. What was done to it is a warning, which has its name in the materials.
pub(crate) fn indexed(
    named: &str,
    bytes: &[u8],
    format: &TextureFormat,
    warnings: &mut Vec<Warning>,
) -> Result<Indexed, Problem> {
    let picture = match read(bytes) {
        Ok(picture) => picture,
        Err(problem) => return Ok(Err(problem)),
    };
    let named = || named.to_string();
    let transparent = picture.colors.iter().filter(|color| color[3] < 255).count();
    if transparent > 0 {
        warnings.push(Warning::PictureTransparent { name: named(), pixels: transparent });
    }
    let rows = side(picture.height).min(if format.mip_levels { 128 } else { 256 });
    let (from, to) = ([picture.width, picture.height], [side(picture.width), rows]);
    let mut pixels: Vec<[u8; 3]> = picture.colors.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
    if from != to {
        warnings.push(Warning::PictureResized { name: named(), from, to });
        pixels = resampled(&pixels, from, to);
    }
    if format.mip_levels {
        pixels = [mip_levels(&pixels, to[0]), pixels].concat();
    }
    let (palette, indices, all) = reduce(&pixels, format.colors);
    let difference = |(pixel, &index): (&[u8; 3], &u8)| {
        let color = palette[usize::from(index)];
        (0..3).map(|i| pixel[i].abs_diff(color[i])).max().unwrap_or_default()
    };
    let error = pixels.iter().zip(&indices).map(difference).max().unwrap_or_default();
    if all > format.colors {
        warnings.push(Warning::PictureColors { name: named(), count: all, kept: format.colors, error });
    }
    let bits = format.colors.ilog2(); // 1, 2, 4 or 8
    let texels = indices
        .chunks(8 / bits as usize)
        .map(|texels| texels.iter().fold(0u32, |byte, &texel| byte << bits | u32::from(texel)) as u8)
        .collect();
    let name = String::new();
    let TextureFormat { color, mip_levels, .. } = format.clone();
    let [width, height] = to;
    Ok(Ok(IndexedPicture { name, width, height, mip_levels, palette, texels, color, error }))
}

/// The power of two of 8 to 256 next to a side, the larger one from √2 of the smaller on.
fn side(given: usize) -> usize {
    [8, 16, 32, 64, 128].into_iter().find(|&side| given * given < 2 * side * side).unwrap_or(256)
}

/// The reduced copies of a picture in the rows in which `pinhole::texture::MipTexels` finds them: row number (2·i + 1)·2ⁿ⁻¹, from 1, has the means
/// of 2ⁿ rows from 2ⁿ·i on and of 2ⁿ columns about each, of which both outer ones count half. The picture repeats.
fn mip_levels(picture: &[[u8; 3]], width: usize) -> Vec<[u8; 3]> {
    let height = picture.len() / width;
    let mut levels = Vec::with_capacity(picture.len());
    for (number, column) in (1..=height).flat_map(|number| (0..width).map(move |column| (number, column))) {
        let half = 1 << number.trailing_zeros();
        let mut sum = [0; 3];
        for (y, x) in (number - half..number + half).flat_map(|y| (0..=2 * half).map(move |x| (y, x))) {
            let texel = picture[y % height * width + (column + x).wrapping_sub(half) % width];
            let weight = if x == 0 || x == 2 * half { 1 } else { 2 };
            (0..3).for_each(|i| sum[i] += weight * usize::from(texel[i]));
        }
        let weights = 8 * half * half;
        levels.push(sum.map(|sum| ((sum + weights / 2) / weights) as u8)); // a mean of levels
    }
    levels
}

/// A palette of at most `most` colours, the index of each pixel's colour in it, and the number of colours of the picture. If
/// the palette holds them, its colours are those of the picture, by their first use; otherwise NeuQuant (Dekker 1994) finds
/// them.
fn reduce(pixels: &[[u8; 3]], most: usize) -> (Vec<[u8; 3]>, Vec<u8>, usize) {
    let mut numbers = BTreeMap::new();
    let mut palette = Vec::new();
    for &pixel in pixels {
        numbers.entry(pixel).or_insert_with(|| {
            palette.push(pixel);
            palette.len() - 1
        });
    }
    let all = palette.len();
    if all > most {
        let rgba: Vec<u8> = pixels.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect();
        let found = color_quant::NeuQuant::new(1, most, &rgba).color_map_rgb();
        palette = found.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        palette.truncate(most);
        let distance =
            |a: [u8; 3], b: [u8; 3]| (0..3).map(|i| u32::from(a[i].abs_diff(b[i])).pow(2)).sum::<u32>();
        for (&pixel, number) in &mut numbers {
            let nearest = (0..palette.len()).min_by_key(|&i| distance(palette[i], pixel));
            *number = nearest.unwrap_or_default();
        }
    }
    let indices = pixels.iter().map(|pixel| numbers[pixel] as u8).collect(); // below 256
    palette.resize(most, [0; 3]);
    (palette, indices, all)
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

const SHORT: &str = "ends too soon: copy or export it again";
const KIND: &str = "is a BMP of a kind that is not read: save it with 24 bits a pixel, or as PNG";

/// The pixels of a BMP file (Microsoft, "Bitmap Storage"): 1 to 32 bits a pixel, run lengths and bit fields, with headers of any version.
fn bmp(file: &[u8]) -> Result<Pixels, &'static str> {
    let header = number(file, 14, 4)?;
    let is_old = header == 12;
    if !is_old && !(40..=256).contains(&header) {
        return Err(KIND);
    }
    let [width, height, depth] = match is_old {
        true => [number(file, 18, 2)?, number(file, 20, 2)?, number(file, 24, 2)?],
        false => [number(file, 18, 4)?, number(file, 22, 4)?, number(file, 28, 2)?],
    };
    let [compression, count] = if is_old { [0; 2] } else { [number(file, 30, 4)?, number(file, 46, 4)?] };
    // A negative height: the upper row comes first.
    let (is_top_down, height) = ((height as i32) < 0, (height as i32).unsigned_abs());
    if !(1..=LONGEST).contains(&width) || !(1..=LONGEST).contains(&height) {
        return Err("has a side of no pixel, or of more than 8192");
    }
    let (width, height) = (width as usize, height as usize);
    let pixels = file.get(number(file, 10, 4)? as usize..).ok_or(SHORT)?;
    let colors = Palette {
        entries: file.get(14 + header as usize..).ok_or(SHORT)?,
        bytes: if is_old { 3 } else { 4 },
        count: if count == 0 { 1 << depth.min(8) } else { count as usize },
    };
    let rows = || {
        let stride = (width * depth as usize).div_ceil(32) * 4;
        pixels.get(..stride * height).map(|rows| rows.chunks_exact(stride)).ok_or(SHORT)
    };
    let mut read = match (compression, depth) {
        (0, 1 | 2 | 4 | 8) => {
            let depth = depth as usize;
            let index = |row: &[u8], x: usize| {
                row[x * depth / 8] >> (8 - depth - x * depth % 8) & (255 >> (8 - depth))
            };
            let row = |row| (0..width).map(move |x| colors.at(index(row, x)));
            rows()?.flat_map(row).collect::<Result<Vec<_>, _>>()?
        }
        (1, 8) | (2, 4) => runs(pixels, depth as usize, [width, height], &colors)?,
        (0, 16 | 24 | 32) | (3 | 6, 16 | 32) => {
            let mut masks = match depth {
                16 => [0x7c00, 0x3e0, 0x1f, 0],
                _ => [0xff_0000, 0xff00, 0xff, 0],
            };
            if compression != 0 {
                // Behind the oldest of these headers, or within a newer one, which may have a mask of opacity, too.
                let has_opacity = header >= 56 || compression == 6;
                for (at, mask) in (54..).step_by(4).zip(&mut masks[..if has_opacity { 4 } else { 3 }]) {
                    *mask = number(file, at, 4)?;
                }
            }
            let color = |pixel: &[u8]| {
                let bits = pixel.iter().rev().fold(0, |bits, &byte| bits << 8 | u32::from(byte));
                let [r, g, b, a] = masks.map(|mask| level(bits, mask));
                [r.unwrap_or(0), g.unwrap_or(0), b.unwrap_or(0), a.unwrap_or(255)]
            };
            let bytes = depth as usize / 8;
            rows()?.flat_map(|row| row.chunks_exact(bytes).take(width).map(color)).collect()
        }
        _ => return Err(KIND),
    };
    if !is_top_down {
        read = read.chunks_exact(width).rev().flatten().copied().collect();
    }
    Ok(Pixels { width, height, colors: read })
}

/// A number of up to 4 bytes, the lowest first.
fn number(file: &[u8], at: usize, bytes: usize) -> Result<u32, &'static str> {
    let bytes = file.get(at..at + bytes).ok_or(SHORT)?;
    Ok(bytes.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte)))
}

/// The level, of 255, in the bits of a mask, rounded; none without a mask.
fn level(bits: u32, mask: u32) -> Option<u8> {
    let shift = mask.trailing_zeros();
    let [level, most] = [bits & mask, mask].map(|bits| u64::from(bits.checked_shr(shift).unwrap_or(0)));
    Some((level * 255 + most / 2).checked_div(most)? as u8) // at most 255
}

/// The colours that indices name: blue, green, red, and in newer files a byte that means nothing.
#[derive(Clone, Copy)]
struct Palette<'f> {
    entries: &'f [u8],
    bytes: usize,
    count: usize,
}

impl Palette<'_> {
    /// The colour of an index; black beyond the palette.
    fn at(&self, index: u8) -> Result<[u8; 4], &'static str> {
        let index = usize::from(index);
        if index >= self.count {
            return Ok([0, 0, 0, 255]);
        }
        let start = index * self.bytes;
        match self.entries.get(start..start + 3) {
            Some(&[b, g, r]) => Ok([r, g, b, 255]),
            _ => Err(SHORT),
        }
    }
}

/// Pixels as runs of one index, of two in 4 bits, and of given ones. Those that no run covers are black.
fn runs(
    mut data: &[u8],
    depth: usize,
    [width, height]: [usize; 2],
    colors: &Palette<'_>,
) -> Result<Vec<[u8; 4]>, &'static str> {
    let mut pixels = vec![[0, 0, 0, 255]; width * height];
    let (mut x, mut y) = (0, 0);
    let mut take = |bytes: usize| {
        let (taken, rest) = data.split_at_checked(bytes).ok_or(SHORT)?;
        data = rest;
        Ok(taken)
    };
    while y < height {
        let pair = take(2)?;
        let &[count, value] = pair else { return Err(SHORT) };
        let indices = match (count, value) {
            (0, 0) => {
                (x, y) = (0, y + 1);
                continue;
            }
            (0, 1) => break,
            (0, 2) => {
                let &[right, up] = take(2)? else { return Err(SHORT) };
                (x, y) = (x + usize::from(right), y + usize::from(up));
                continue;
            }
            // An even number of bytes.
            (0, count) => take((usize::from(count) * depth).div_ceil(16) * 2)?,
            _ => &pair[1..],
        };
        let count = usize::from(if count == 0 { value } else { count });
        for i in 0..count.min(width.saturating_sub(x)) {
            let byte = indices[i * depth / 8 % indices.len()];
            let index = if depth == 8 { byte } else { byte >> (4 - i % 2 * 4) & 15 };
            pixels[y * width + x + i] = colors.at(index)?;
        }
        x += count;
    }
    Ok(pixels)
}
