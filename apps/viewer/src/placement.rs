//! The display in a window of another size: magnified by a whole factor, so that all pixels are equal squares.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};

/// Around the display.
const BORDER: u32 = 0x0018_1a1e;

/// Where a display lies in a window: in its middle, as large as fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    display: [usize; 2],
    window: [usize; 2],
    factor: usize,
    /// Where the display begins, from the left and from above.
    first: [usize; 2],
}

impl Placement {
    /// A display in a window. If that is smaller, it shows the display's upper left part.
    pub fn new(display: Size, window: [u32; 2]) -> Self {
        let (display, window) =
            ([display.width, display.height].map(|side| side as usize), window.map(|side| side as usize));
        let factor = (0..2).map(|i| window[i] / display[i].max(1)).fold(usize::MAX, usize::min).max(1);
        let first = [0, 1].map(|i| window[i].saturating_sub(factor * display[i]) / 2);
        Self { display, window, factor, first }
    }

    /// The pixel of the display at a position in the window, in display pixels; it may lie outside the display.
    pub fn pixel(&self, position: [f64; 2]) -> [i32; 2] {
        [0, 1].map(|i| ((position[i] - self.first[i] as f64) / self.factor as f64).floor() as i32)
    }

    /// Writes the display's pixels into those of the window, row by row: 0x00RRGGBB.
    pub fn fill(&self, pixels: &[Rgb888], window: &mut [u32]) {
        window.fill(BORDER);
        let [width, height] = self.display;
        let [left, top] = self.first;
        let rows = window.chunks_exact_mut(self.window[0].max(1)).skip(top).take(self.factor * height);
        for (y, row) in rows.enumerate() {
            let colours = pixels[y / self.factor * width..][..width].iter();
            for (cells, colour) in row[left..].chunks_mut(self.factor).zip(colours) {
                cells.fill(u32::from_be_bytes([0, colour.r(), colour.g(), colour.b()]));
            }
        }
    }
}
