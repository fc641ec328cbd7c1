//! Counts of how often each pixel was drawn.

use core::convert::Infallible;
use pinhole::raster::{self, Pixel, Scissor, ScreenPoint, Span};

/// Every row holds the differences between neighbouring pixels, and one more for what ends at the right border:
/// a span then costs two additions a row, however wide it is.
pub(crate) struct Picture {
    differences: Vec<u32>,
    stride: usize,
    scissor: Scissor,
}

impl Picture {
    /// A picture with sides of at most 4096 pixels.
    pub(crate) fn new(width: u16, height: u16) -> Self {
        let stride = usize::from(width) + 1;
        Self {
            differences: vec![0; stride * usize::from(height)],
            stride,
            scissor: Scissor::new(0, 0, width.into(), height.into()),
        }
    }

    pub(crate) fn triangle(&mut self, vertices: [ScreenPoint; 3]) {
        let Self { differences, stride, scissor } = self;
        let Ok(()) = raster::triangle(vertices, scissor, |span| draw(differences, *stride, span));
    }

    pub(crate) fn line(&mut self, [a, b]: [Pixel; 2]) {
        let Self { differences, stride, scissor } = self;
        let Ok(()) = raster::line(a, b, scissor, |span| draw(differences, *stride, span));
    }

    /// Row by row from the top. A file cannot hold enough triangles and lines for a count to pass 32 bits.
    pub(crate) fn counts(self) -> Vec<u32> {
        let mut counts = self.differences;
        for row in counts.chunks_mut(self.stride) {
            let mut sum = 0u32;
            for pixel in row {
                sum = sum.wrapping_add(*pixel);
                *pixel = sum;
            }
        }
        // Without the last column, which is back at zero.
        let mut column = 0;
        counts.retain(|_| {
            column = if column == self.stride { 1 } else { column + 1 };
            column != self.stride
        });
        counts
    }
}

/// Panics if the span leaves the picture: the rasteriser keeps to its scissor.
fn draw(differences: &mut [u32], stride: usize, span: Span) -> Result<(), Infallible> {
    let Span { x, y, width, height } = span;
    assert!(x >= 0 && y >= 0 && width >= 1 && height >= 1, "{span:?}");
    let (x, y, width, height) = (x as usize, y as usize, width as usize, height as usize);
    for row in differences[y * stride..(y + height) * stride].chunks_mut(stride) {
        row[x] = row[x].wrapping_add(1);
        row[x + width] = row[x + width].wrapping_sub(1);
    }
    Ok(())
}
