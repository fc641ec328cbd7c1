//! The pictures of `boards/rp2040-embassy`, whose drawing code is compiled here, too.

use super::Pictures;
use pinhole::ScreenVertex;
use std::path::Path;

#[allow(dead_code, unreachable_pub)] // as a file of its own it is right; the rectangles of changes are the firmware's
#[path = "../../../rp2040-embassy/src/picture.rs"]
mod picture;

pub(crate) const FRAMES: u32 = picture::STEPS as u32;

/// Complete pictures, while the firmware sends only the rectangles that have changed.
pub(crate) fn pictures(model: &Path) -> Result<Pictures, String> {
    let imported = super::import(model)?;
    Ok(Box::new(move |frame| {
        let mesh = imported.mesh().map_err(|error| error.to_string())?;
        let colors = imported.colors().map_err(|error| error.to_string())?;
        let color = |face: usize, level: u16| match colors {
            Some(colors) => colors.lit(face, level),
            None => pinhole::Dim::dim(picture::COLOR, level),
        };
        let mut cache = vec![ScreenVertex::EMPTY; mesh.cache_len()];
        let mut bins = vec![0; mesh.face_bins_len()];
        let mut depths = vec![0; picture::PIXELS];
        let mut strip = vec![0; 2 * picture::PIXELS];
        let mut picture = picture::Picture::new(&mesh, &mut cache, &mut bins, &mut depths)?;
        let mut turned = picture.turned(frame as i32)?;
        let mut frame = picture::frame(picture::SCREEN);
        let mut stored = Vec::new();
        for _ in 0..picture::SCREEN.size.height.div_ceil(picture::ROWS) {
            let bytes = turned.next_band(color, &mut frame, &mut strip)?.into_bytes();
            // As on the bus: the high byte first.
            stored.extend(bytes.as_chunks().0.iter().map(|&pair| u32::from(u16::from_be_bytes(pair))));
        }
        Ok(stored)
    }))
}
