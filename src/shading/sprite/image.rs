//! Images of embedded-graphics as pictures of sprites.

use super::source::SpriteSource;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::image::GetPixel;

/// An image of embedded-graphics as the picture of a [`Sprite`](crate::sprite::Sprite): `ImageRaw` in any colour and byte order, a
/// `Framebuffer`, tinybmp's `Bmp`, or any other type with `GetPixel` and `OriginDimensions`. It may have any size.
///
/// A pixel that the image does not give, such as those of a compressed `Bmp`, is transparent.
///
/// ```
/// use embedded_graphics::{image::ImageRaw, pixelcolor::{raw::BigEndian, Rgb565}, prelude::*};
/// use pinhole::sprite::{SpriteImage, SpriteSource};
/// // Three texels: red, the key, blue.
/// const BYTES: [u8; 6] = [0xf8, 0x00, 0xf8, 0x1f, 0x00, 0x1f];
/// let image = ImageRaw::<Rgb565, BigEndian>::new(&BYTES, 3);
/// let picture = SpriteImage::new(&image).with_key(Rgb565::MAGENTA);
/// assert_eq!([0, 1, 2].map(|column| picture.texel_at(column, 0)), [Some(Rgb565::RED), None, Some(Rgb565::BLUE)]);
/// ```
#[derive(Debug)]
pub struct SpriteImage<'i, I: GetPixel> {
    image: &'i I,
    /// The colour of transparent texels, if there are any.
    key: Option<I::Color>,
}

// Not derived: the image need not be `Copy` for a reference to be.
impl<I: GetPixel> Clone for SpriteImage<'_, I> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<I: GetPixel> Copy for SpriteImage<'_, I> {}

impl<'i, I: GetPixel + OriginDimensions> SpriteImage<'i, I> {
    /// All pixels of an image.
    pub const fn new(image: &'i I) -> Self {
        Self { image, key: None }
    }

    /// The pixels of an image but those of the colour `key`, which are transparent.
    #[must_use]
    pub const fn with_key(self, key: I::Color) -> Self {
        Self { key: Some(key), ..self }
    }
}

impl<I: GetPixel + OriginDimensions> SpriteSource for SpriteImage<'_, I> {
    type Color = I::Color;
    type Ink = Option<I::Color>;

    fn picture_size(&self) -> Size {
        self.image.size()
    }

    #[inline(always)]
    fn texel_at(&self, column: u32, row: u32) -> Option<I::Color> {
        // Numbers of 2³¹ and more become negative, where an image has no pixel.
        let color = self.image.pixel(Point::new(column as i32, row as i32))?;
        match self.key {
            Some(key) if key == color => None,
            _ => Some(color),
        }
    }
}

// Image and colour are not printed: they need not implement `Format`.
defmt_format!([I: GetPixel + OriginDimensions] SpriteImage<'_, I>, self, "picture of {}", self.image.size());
