//! Where pixels lie in a row-major buffer.

/// The layout of a row-major buffer of pixels. The index of a pixel outside the buffer may wrap, or be that of another pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelLayout {
    /// The number of pixels in a row: the index of the pixel below is larger by this.
    pub(crate) stride: usize,
    /// The index of pixel (0, 0), wrapped if that pixel is outside the buffer.
    pub(crate) origin: usize,
}

impl PixelLayout {
    /// The layout of a buffer whose first pixel is (left, top).
    #[inline(always)]
    pub(crate) fn new(left: i32, top: i32, stride: usize) -> Self {
        Self { stride, origin: pixel_index(left, top, stride).wrapping_neg() }
    }

    /// Index of pixel (x, y) in the buffer.
    #[inline(always)]
    pub(crate) fn at(self, x: i32, y: i32) -> usize {
        pixel_index(x, y, self.stride).wrapping_add(self.origin)
    }
}

/// Index of pixel (x, y) in a row-major buffer whose first pixel is (0, 0).
#[inline(always)]
fn pixel_index(x: i32, y: i32, stride: usize) -> usize {
    (y as usize).wrapping_mul(stride).wrapping_add(x as usize)
}
