//! The picture of a material as texels that name colours of a palette.

use crate::materials::Pictures;
#[cfg(feature = "textures")]
use crate::pixels::indexed;
use crate::{rust, Problem, TextureFormat, Warning};

/// A picture as `pinhole::texture::IndexedTexels` borrows it, or with mip levels `MipTexels` of `IndexedTexels`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IndexedPicture {
    /// The file's name.
    pub name: String,
    /// Columns: 8, 16, 32, 64, 128 or 256.
    pub width: usize,
    /// Rows: 8, 16, 32, 64, 128 or 256; with mip levels at most 128.
    pub height: usize,
    /// Whether [`texels`](Self::texels) have as many rows of mip levels before those of the picture.
    pub mip_levels: bool,
    /// The colours `[red, green, blue]`: 2, 4, 16 or 256. Colours that no texel uses are black.
    pub palette: Vec<[u8; 3]>,
    /// Texels of 1, 2, 4 or 8 bits, as the palette has 2, 4, 16 or 256 colours: row by row, the upper row first, the left texel
    /// of a byte in its highest bits.
    pub texels: Vec<u8>,
    /// The type of the colours in Rust source, with its path.
    pub color: String,
    /// The largest difference of a channel of a texel from the picture of this size, of 255.
    pub error: u8,
}

impl IndexedPicture {
    /// Bits of a texel.
    pub fn bits(&self) -> u32 {
        self.palette.len().max(1).ilog2()
    }

    /// Rows of texels, those of mip levels too.
    pub fn rows(&self) -> usize {
        self.height << u32::from(self.mip_levels)
    }

    /// The colour of the texel in this column and row, `[red, green, blue]`; black outside.
    pub fn color(&self, column: usize, row: usize) -> [u8; 3] {
        let bits = self.bits() as usize;
        let is_inside = column < self.width && row < self.height;
        let row = row + self.rows() - self.height;
        let first = (row * self.width + column) * bits; // the texel's highest bit
        let byte = self.texels.get(first / 8).filter(|_| is_inside).copied();
        let index = byte.map(|byte| usize::from(byte) >> (8 - bits - first % 8) & ((1 << bits) - 1));
        index.and_then(|index| self.palette.get(index)).copied().unwrap_or_default()
    }

    /// The bytes that texels and palette take in flash.
    pub fn flash_bytes(&self) -> usize {
        let color = match channels(&self.color) {
            Some(Channels { bits: 1..=8, .. }) => 1,
            Some(Channels { bits: 9..=16, .. }) => 2,
            _ => 3,
        };
        // In embedded-graphics a colour of 18 or 24 bits is stored in 4 bytes.
        self.texels.len() + self.palette.len() * if color == 3 { 4 } else { color }
    }

    /// The colours as calls in Rust.
    pub(crate) fn color_calls(&self) -> Vec<String> {
        let Some(channels) = channels(&self.color) else { return Vec::new() }; // refused with the options
        let call = |&color: &[u8; 3]| {
            let levels = channels.levels(color).map(|level| level.to_string());
            let count = if channels.is_gray { 1 } else { 3 };
            format!("{}::new({})", self.color, levels[..count].join(", "))
        };
        self.palette.iter().map(call).collect()
    }
}

/// The channels of a colour type of embedded-graphics.
pub(crate) struct Channels {
    is_gray: bool,
    /// The highest level of each channel.
    max: [u8; 3],
    /// All channels.
    bits: u32,
}

impl Channels {
    /// The nearest levels, as embedded-graphics converts from `Rgb888`.
    fn levels(&self, color: [u8; 3]) -> [u8; 3] {
        let nearest = |value: u32, max: u8| ((value * u32::from(max) + 127) / 255) as u8; // ≤ max
        let [r, g, b] = color.map(u32::from);
        let [x, y, z] = self.max;
        match self.is_gray {
            true => [nearest((77 * r + 150 * g + 29 * b) >> 8, x), 0, 0],
            false => [nearest(r, x), nearest(g, y), nearest(b, z)],
        }
    }
}

/// The channels of a colour type, by the last name of its path.
pub(crate) fn channels(path: &str) -> Option<Channels> {
    let name = path.rsplit("::").next()?;
    let is_path = path.split("::").all(|name| {
        name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    });
    let (is_gray, max, bits) = match name {
        "Rgb555" | "Bgr555" => (false, [31, 31, 31], 15),
        "Rgb565" | "Bgr565" => (false, [31, 63, 31], 16),
        "Rgb666" | "Bgr666" => (false, [63, 63, 63], 18),
        "Rgb888" | "Bgr888" => (false, [255, 255, 255], 24),
        "Gray2" => (true, [3, 0, 0], 2),
        "Gray4" => (true, [15, 0, 0], 4),
        "Gray8" => (true, [255, 0, 0], 8),
        _ => return None,
    };
    is_path.then_some(Channels { is_gray, max, bits })
}

/// The picture, but for its file's name, or why it is none.
pub(crate) type Indexed = Result<IndexedPicture, String>;

/// Reads the picture that the materials name, in the format. What is doubtful is a warning.
pub(crate) fn read(
    pictures: &Pictures,
    format: &TextureFormat,
    warnings: &mut Vec<Warning>,
) -> Result<Option<IndexedPicture>, Problem> {
    let Some(name) = pictures.names.first() else {
        warnings.push(Warning::NoPicture);
        return Ok(None);
    };
    if let [_, other, ..] = &pictures.names[..] {
        let (written, other) = (name.clone(), other.clone());
        warnings.push(Warning::Pictures { count: pictures.names.len(), written, other });
    }
    let count = pictures.bare.iter().filter(|&&is_bare| is_bare).count();
    if count > 0 {
        warnings.push(Warning::NoPictureFaces { count });
    }
    let (path, bytes) = match &pictures.first {
        Some(Ok(read)) => read,
        Some(Err(why)) => {
            warnings.push(Warning::PictureUnread { name: name.clone(), why: why.clone() });
            return Ok(None);
        }
        None => return Ok(None), // not wanted
    };
    match indexed(name, bytes, format, warnings)? {
        Ok(picture) => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let name = rust::one_line(&name).replace('`', "'");
            Ok(Some(IndexedPicture { name, ..picture }))
        }
        Err(problem) => {
            warnings.push(Warning::Picture { name: name.clone(), problem });
            Ok(None)
        }
    }
}

/// A build that reads no pictures.
#[cfg(not(feature = "textures"))]
fn indexed(_: &str, _: &[u8], _: &TextureFormat, _: &mut Vec<Warning>) -> Result<Indexed, Problem> {
    Err(Problem::NoTextures)
}
