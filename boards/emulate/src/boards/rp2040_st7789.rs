//! The pictures of `boards/rp2040-st7789`, whose drawing code and build script are compiled here, too.

use super::Pictures;
use pinhole::{Angle, ScreenVertex};
use std::path::Path;

#[allow(dead_code, unreachable_pub)] // as a file of its own it is right; the first transfer is the firmware's
#[path = "../../../rp2040-st7789/src/picture.rs"]
mod picture;
#[allow(dead_code, unreachable_pub)] // its `main` is for cargo
#[path = "../../../rp2040-st7789/build.rs"]
mod script;

/// As in the firmware's `src/main.rs`.
pub(crate) const FRAMES: u32 = 120;

pub(crate) fn pictures(model: &Path) -> Result<Pictures, String> {
    let imported = super::import(model, &script::options())?;
    Ok(Box::new(move |frame| {
        let mesh = imported.mesh().map_err(|error| error.to_string())?;
        let mut cache = vec![ScreenVertex::EMPTY; mesh.cache_len()];
        let mut bins = vec![0; mesh.face_bins_len()];
        let pixels = picture::FIRST_BAND.size.width as usize * picture::ROWS as usize;
        let mut depths = vec![0; pixels];
        let mut strip = vec![0; 2 * pixels];
        let mut picture = picture::Picture::new(&mesh, &mut cache, &mut bins, &mut depths)?;
        let mut turned = picture.turned(Angle::turns(frame as i32, FRAMES))?;
        let mut stored = Vec::new();
        for _ in 0..picture::BANDS {
            let bytes = turned.next_band(&mut strip)?.into_bytes();
            // As on the bus: the high byte first.
            stored.extend(bytes.as_chunks().0.iter().map(|&pair| u32::from(u16::from_be_bytes(pair))));
        }
        Ok(stored)
    }))
}
