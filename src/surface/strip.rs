//! The memory of a strip, with the lengths computed from its width, rows and colour.

/// The bytes of a strip's pixels, and its depths, for [`Frame::next_band`](crate::bands::Frame::next_band) and
/// [`DepthBuffer::new`](crate::target::DepthBuffer::new), and the rows that a [`SmoothFrame`](crate::bands::SmoothFrame) keeps. [`strip_buffers!`](crate::strip_buffers) makes one with the lengths that a band
/// needs, and the macro `StripBuffers!` names the type. [`MeshBuffers`](struct@crate::MeshBuffers) has an example.
///
/// The bytes are aligned to 4, so that DMA can send them as words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C, align(4))]
pub struct StripBuffers<const BYTES: usize, const PIXELS: usize = 0, const KEPT: usize = 0> {
    /// The pixels in wire order.
    pub colors: [u8; BYTES],
    /// The depth of each pixel.
    pub depths: [u16; PIXELS],
    /// The rows that wait for the next band of a [`SmoothFrame`](crate::bands::SmoothFrame).
    pub kept: [u8; KEPT],
}

impl<const BYTES: usize, const PIXELS: usize, const KEPT: usize> StripBuffers<BYTES, PIXELS, KEPT> {
    /// Buffers of zeros: a static is in `.bss` and takes no flash.
    pub const fn new() -> Self {
        Self { colors: [0; BYTES], depths: [0; PIXELS], kept: [0; KEPT] }
    }
}

impl<const BYTES: usize, const PIXELS: usize, const KEPT: usize> Default
    for StripBuffers<BYTES, PIXELS, KEPT>
{
    fn default() -> Self {
        Self::new()
    }
}

defmt_format!(
    [const BYTES: usize, const PIXELS: usize, const KEPT: usize] StripBuffers<BYTES, PIXELS, KEPT>, self,
    "strip of {=usize} bytes and {=usize} depths", BYTES, PIXELS
);

/// Declares the memory of a strip, `strip_buffers!(COLOR, WIDTH, ROWS)`: [`StripBuffers`] with the bytes and the depths of `ROWS`
/// rows of `WIDTH` pixels. `strip_buffers!(COLOR, WIDTH, ROWS, no depth)` has no depths, and `strip_buffers!(COLOR, WIDTH, ROWS, smooth)`, for a
/// [`SmoothFrame`](crate::bands::SmoothFrame) and at least four `ROWS`, two rows more, which wait for the next band, and `kept`, which has them between bands; its pixels have whole bytes.
/// [`StripBuffers!`](macro@crate::StripBuffers) with equal arguments is the type, for statics:
///
/// ```
/// use embedded_graphics::pixelcolor::{BinaryColor, Rgb565};
/// use pinhole::{strip_buffers, StripBuffers};
/// use std::sync::Mutex; // in firmware `ConstStaticCell` of the crate static_cell
/// static STRIP: Mutex<StripBuffers!(Rgb565, 240, 8)> = Mutex::new(strip_buffers!(Rgb565, 240, 8));
/// # assert_eq!(STRIP.lock().map(|strip| (strip.colors.len(), strip.depths.len())).ok(), Some((240 * 8 * 2, 240 * 8)));
/// let strip = strip_buffers!(BinaryColor, 130, 8, no depth);
/// assert_eq!((strip.colors.len(), strip.depths.len()), (17 * 8, 0)); // rows of whole bytes
/// # let smooth = strip_buffers!(embedded_graphics::pixelcolor::Gray4, 61, 8, smooth);
/// # assert_eq!((smooth.colors.len(), smooth.depths.len(), smooth.kept.len()), (61 * 10, 61 * 10, 61 * 2));
/// ```
#[macro_export]
macro_rules! strip_buffers {
    ($($argument:tt)+) => {
        <$crate::StripBuffers!($($argument)+)>::new()
    };
}

/// The type of [`strip_buffers!`](crate::strip_buffers) with equal arguments: [`StripBuffers`] with the lengths that a band needs.
#[macro_export]
macro_rules! StripBuffers {
    ($color:ty, $width:expr, $rows:expr, no depth) => {
        $crate::StripBuffers<{ $crate::bands::Frame::<$color>::strip_bytes($width as u32, $rows as u32) }>
    };
    ($color:ty, $width:expr, $rows:expr, smooth) => {
        $crate::StripBuffers<
            { $crate::bands::SmoothFrame::<$color>::strip_bytes($width as u32, $rows as u32 + 2) },
            { ($width as usize).saturating_mul($rows as usize + 2) },
            { $crate::bands::SmoothFrame::<$color>::strip_bytes($width as u32, 2) },
        >
    };
    ($color:ty, $width:expr, $rows:expr) => {
        $crate::StripBuffers<
            { $crate::bands::Frame::<$color>::strip_bytes($width as u32, $rows as u32) },
            { ($width as usize).saturating_mul($rows as usize) },
        >
    };
}
