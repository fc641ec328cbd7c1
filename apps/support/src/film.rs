//! Films: an animated GIF and a contact sheet of its frames.

use crate::animation::Animation;
use crate::canvas::Canvas;
use crate::files::{self, unwritable, Part};
use crate::still;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use std::collections::HashMap;
use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// An endless animation, written frame by frame under a temporary name until it is finished.
pub struct Gif {
    animation: Animation<BufWriter<File>>,
    part: Part,
    file: PathBuf,
    index: HashMap<u16, u8>,
}

impl Gif {
    /// Begins a file. `palette` holds every colour of every frame, at most 256: no colour is approximated. The error names the file
    /// where it cannot be written.
    pub fn create(file: &Path, size: Size, palette: &[Rgb565]) -> Result<Self, Box<dyn Error>> {
        let colours: Vec<_> = palette.iter().map(|&c| rgb(c)).collect();
        let index = (0..=255).zip(palette).map(|(i, c)| (c.into_storage(), i)).collect();
        let (part, writer) = Part::begin(file).map_err(|e| unwritable(file, e))?;
        let animation = Animation::new(BufWriter::new(writer), [size.width, size.height], &colours)?;
        Ok(Gif { animation, part, file: file.into(), index })
    }

    /// Adds a frame, shown for 6/100 s. Fails if a colour is not in the palette, or the file cannot be written.
    pub fn add(&mut self, pixels: &[Rgb565]) -> Result<(), Box<dyn Error>> {
        let index = |c: &Rgb565| self.index.get(&c.into_storage()).copied();
        let indexed: Option<Vec<u8>> = pixels.iter().map(index).collect();
        let indexed = indexed.ok_or("a colour is missing in the palette")?;
        Ok(self.animation.add(indexed, None, 6).map_err(|e| unwritable(&self.file, e))?)
    }

    /// Completes the file and moves it to its name. Fails if the file cannot be written.
    pub fn finish(self) -> Result<(), Box<dyn Error>> {
        let Self { animation, part, file, .. } = self;
        let mut writer = animation.finish().map_err(|e| unwritable(&file, e))?;
        writer.flush().and_then(|()| part.settle()).map_err(|e| unwritable(&file, e))?;
        Ok(())
    }
}

/// Whether a frame is on the contact sheet: `most` frames at even distances, or all where there are fewer.
pub fn on_sheet(frame: u32, frames: u32, most: u32) -> bool {
    // Bresenham's step: true for exactly min(most, frames) of the frames.
    frame * most % frames < most
}

/// Writes a contact sheet, four pictures in a row. The error names the file where it cannot be written.
pub fn write_sheet(file: &Path, size: Size, pictures: &[Canvas<Rgb565>]) -> Result<(), Box<dyn Error>> {
    let columns = pictures.len().min(4) as u32;
    let rows = (pictures.len() as u32).div_ceil(columns);
    let mut sheet = Canvas::new(Size::new(columns * size.width, rows * size.height), Rgb565::BLACK);
    for (place, picture) in (0..).zip(pictures) {
        let corner = size.component_mul(Size::new(place % columns, place / columns));
        let area = Rectangle::new(Point::zero() + corner, size);
        sheet.fill_contiguous(&area, picture.pixels().iter().copied())?;
    }
    let pixels: Vec<Rgb888> = sheet.pixels().iter().map(|&c| c.into()).collect();
    Ok(files::write(&[(file, still::png(sheet.size(), &pixels)?)])?)
}

fn rgb(colour: Rgb565) -> [u8; 3] {
    let c = Rgb888::from(colour);
    [c.r(), c.g(), c.b()]
}
