//! A target that counts what is drawn on it.

use core::cell::Cell;
use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

pub(super) struct Watch<'f> {
    size: Size,
    /// Of a band.
    rows: u32,
    /// The face that is being drawn, and whether it is large.
    face: &'f Cell<(usize, bool)>,
    /// Of faces that are not large, and of those that are.
    pub(super) runs: [u32; 2],
    pub(super) pixels: u32,
    /// Faces in bands.
    pub(super) met: u32,
    /// The last face that was met, and the band where.
    last: Option<(usize, u32)>,
}

impl<'f> Watch<'f> {
    pub(super) fn new(size: Size, rows: u32, face: &'f Cell<(usize, bool)>) -> Self {
        Self { size, rows, face, runs: [0; 2], pixels: 0, met: 0, last: None }
    }
}

impl OriginDimensions for Watch<'_> {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Watch<'_> {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, _: I) -> Result<(), Infallible> {
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: Rgb565) -> Result<(), Infallible> {
        let (face, large) = self.face.get();
        let [small_runs, large_runs] = &mut self.runs;
        *if large { large_runs } else { small_runs } += 1;
        self.pixels += area.size.width * area.size.height;
        // A face comes row by row.
        let here = Some((face, area.top_left.y as u32 / self.rows));
        if here != self.last {
            (self.met, self.last) = (self.met + 1, here);
        }
        Ok(())
    }
}
