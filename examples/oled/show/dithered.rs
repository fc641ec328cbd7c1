//! Greys on a display of black and white.

use embedded_graphics::pixelcolor::{BinaryColor, Gray8};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;

/// A target in greys that is drawn into one of black and white, by ordered dithering: whatever draws in greys can be shown there,
/// textures in fog and sprites too, and no picture in greys is stored.
pub(super) struct Dithered<'a, T>(pub(super) &'a mut T);

/// The ranks of an 8 × 8 Bayer matrix, 0 to 63. (Bayer, *An optimum method for two-level rendition of continuous-tone pictures*, 1973.)
const RANKS: [[u8; 8]; 8] = [
    [0, 32, 8, 40, 2, 34, 10, 42],
    [48, 16, 56, 24, 50, 18, 58, 26],
    [12, 44, 4, 36, 14, 46, 6, 38],
    [60, 28, 52, 20, 62, 30, 54, 22],
    [3, 35, 11, 43, 1, 33, 9, 41],
    [51, 19, 59, 27, 49, 17, 57, 25],
    [15, 47, 7, 39, 13, 45, 5, 37],
    [63, 31, 55, 23, 61, 29, 53, 21],
];

/// White where the grey and the threshold of the pixel, an odd number of 128ths, make at least 1.
fn ink(at: Point, grey: Gray8) -> BinaryColor {
    let rank = RANKS[at.y as usize & 7][at.x as usize & 7];
    (u32::from(grey.luma()) * 128 + (2 * u32::from(rank) + 1) * 255 >= 128 * 255).into()
}

impl<T: Dimensions> Dimensions for Dithered<'_, T> {
    fn bounding_box(&self) -> Rectangle {
        self.0.bounding_box()
    }
}

impl<T: DrawTarget<Color = BinaryColor>> DrawTarget for Dithered<'_, T> {
    type Color = Gray8;
    type Error = T::Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(&mut self, pixels: I) -> Result<(), T::Error> {
        self.0.draw_iter(pixels.into_iter().map(|Pixel(at, grey)| Pixel(at, ink(at, grey))))
    }

    fn fill_contiguous<I: IntoIterator<Item = Gray8>>(
        &mut self,
        area: &Rectangle,
        greys: I,
    ) -> Result<(), T::Error> {
        self.0.fill_contiguous(area, area.points().zip(greys).map(|(at, grey)| ink(at, grey)))
    }

    fn fill_solid(&mut self, area: &Rectangle, grey: Gray8) -> Result<(), T::Error> {
        self.fill_contiguous(area, core::iter::repeat(grey))
    }
}

/// Where `tests/device` includes this file.
#[cfg(test)]
mod tests {
    use super::*;
    use embedded_graphics::mock_display::MockDisplay;
    use embedded_graphics::pixelcolor::Rgb888;
    use pinhole::raster::ScreenPoint;
    use pinhole::{draw::fill_triangle, shading::Flat};

    /// A grey looks as a face of this grey does whose shader is dithered.
    #[test]
    fn greys_are_dithered_as_faces_are() {
        for level in 0..=255 {
            let (mut greys, mut face) = (MockDisplay::new(), MockDisplay::new());
            let Ok(()) = Dithered(&mut greys).clear(Gray8::new(level));
            let corner = |x, y| ScreenPoint::from_subpixels(x << 8, y << 8).expect("a point");
            let shader = Flat::from(Rgb888::new(level, level, level)).dithered();
            let Ok(()) = fill_triangle([corner(0, 0), corner(128, 0), corner(0, 128)], shader, &mut face);
            assert!(face.eq(&greys), "{level}: {greys:?} {face:?}");
        }
    }
}
