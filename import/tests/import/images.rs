//! Picture files for tests.

use std::path::Path;

/// A picture: red, green, blue and opacity of each pixel, row by row.
#[derive(Clone)]
pub(crate) struct Image {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) pixels: Vec<[u8; 4]>,
}

impl Image {
    pub(crate) fn from_fn(width: u32, height: u32, color: impl Fn(u32, u32) -> [u8; 3]) -> Self {
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let opaque = |(x, y)| {
            let [r, g, b] = color(x, y);
            [r, g, b, 255]
        };
        Self { width, height, pixels: places.map(opaque).collect() }
    }

    /// Each pixel's column, row and colour.
    pub(crate) fn colors(&self) -> impl Iterator<Item = (u32, u32, [u8; 3])> + '_ {
        let place = |i: usize| (i as u32 % self.width, i as u32 / self.width);
        self.pixels.iter().enumerate().map(move |(i, &[r, g, b, _])| (place(i).0, place(i).1, [r, g, b]))
    }

    pub(crate) fn png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(self.pixels.as_flattened()).unwrap();
        writer.finish().unwrap();
        bytes
    }

    /// 24 bits a pixel, the lower row first.
    pub(crate) fn bmp(&self) -> Vec<u8> {
        let row = |row: &[[u8; 4]]| {
            let mut bytes: Vec<u8> = row.iter().flat_map(|&[r, g, b, _]| [b, g, r]).collect();
            bytes.resize(bytes.len().div_ceil(4) * 4, 0);
            bytes
        };
        let rows = self.pixels.chunks(self.width as usize).rev().flat_map(row);
        bmp([self.width as i32, self.height as i32], 24, 0, &[], rows)
    }

    /// As PNG or BMP, by the file's name.
    pub(crate) fn save(&self, path: &Path) {
        let bytes = if path.extension().is_some_and(|e| e == "bmp") { self.bmp() } else { self.png() };
        std::fs::write(path, bytes).unwrap();
    }
}

/// A BMP file with a header of 40 bytes: what follows the header (masks or a palette), and the pixels.
pub(crate) fn bmp(
    [width, height]: [i32; 2],
    depth: u16,
    compression: u32,
    after: &[u8],
    pixels: impl IntoIterator<Item = u8>,
) -> Vec<u8> {
    let mut bytes = b"BM\0\0\0\0\0\0\0\0".to_vec();
    bytes.extend((54 + after.len() as u32).to_le_bytes());
    bytes.extend(40u32.to_le_bytes());
    bytes.extend(width.to_le_bytes());
    bytes.extend(height.to_le_bytes());
    bytes.extend(1u16.to_le_bytes());
    bytes.extend(depth.to_le_bytes());
    bytes.extend(compression.to_le_bytes());
    bytes.extend([0; 20]);
    bytes.extend(after);
    bytes.extend(pixels);
    bytes
}
