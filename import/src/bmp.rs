//! BMP files (Microsoft, "Bitmap Storage"): 1 to 32 bits a pixel, run lengths and bit fields, with headers of any version.

use crate::pixels::{Pixels, LONGEST};

const SHORT: &str = "ends too soon: copy or export it again";
const KIND: &str = "is a BMP of a kind that is not read: save it with 24 bits a pixel, or as PNG";

/// The pixels of a file.
pub(crate) fn read(file: &[u8]) -> Result<Pixels, &'static str> {
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
