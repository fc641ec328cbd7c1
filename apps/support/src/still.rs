//! PNG files.

use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use std::collections::BTreeMap;
use std::error::Error;

/// Encodes a picture as a PNG file; equal pixels give equal bytes. Pictures of at most 256 colours have a palette, and of at
/// most 16 half a byte per pixel. Fails if the number of pixels is not that of `size`.
pub fn png(size: Size, pixels: &[Rgb888]) -> Result<Vec<u8>, Box<dyn Error>> {
    let bytes = |c: Rgb888| [c.r(), c.g(), c.b()];
    let mut palette: BTreeMap<[u8; 3], u8> = pixels.iter().map(|&c| (bytes(c), 0)).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, size.width, size.height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let data: Vec<u8> = if palette.len() <= 256 {
        for (index, place) in (0..=255).zip(palette.values_mut()) {
            *place = index;
        }
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_filter(png::Filter::NoFilter); // differences of indices say nothing
        encoder.set_palette(palette.keys().flatten().copied().collect::<Vec<u8>>());
        let indices: Vec<u8> = pixels.iter().map(|&c| palette[&bytes(c)]).collect();
        if palette.len() <= 16 {
            encoder.set_depth(png::BitDepth::Four);
            let row =
                |row: &[u8]| row.chunks(2).map(|pair| pair[0] << 4 | pair.get(1).unwrap_or(&0)).collect();
            indices.chunks(size.width as usize).flat_map::<Vec<u8>, _>(row).collect()
        } else {
            indices
        }
    } else {
        encoder.set_color(png::ColorType::Rgb);
        pixels.iter().flat_map(|&c| bytes(c)).collect()
    };
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(file)
}
