//! A frame in bands: a strip of memory in place of a framebuffer.

use super::pixel_format::{self as wire, PixelFormat};
use super::pixels::{Pixels, StoredPixel};
use core::convert::Infallible;
use core::marker::PhantomData;
use core::ops::Range;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

/// A frame, or any rectangle of the display, that is drawn and sent band by band, from top to bottom,
/// through one strip of memory, or two in turn.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
/// use pinhole::Frame;
/// let mut display = MockDisplay::<Rgb565>::new();
/// let mut strip = [0; 64 * 10 * 2]; // ten rows of the 64, two bytes a pixel
/// let mut frame = Frame::new(display.bounding_box(), Rgb565::BLUE);
/// let mut heights = Vec::new();
/// while let Some(mut band) = frame.next_band(&mut strip)? {
///     // Draw the scene, then what goes on top; a band clips like any target.
///     Rectangle::new(Point::new(8, 8), Size::new(9, 40)).into_styled(
///         embedded_graphics::primitives::PrimitiveStyle::with_fill(Rgb565::WHITE),
///     ).draw(&mut band)?;
///     heights.push(band.area().size.height);
///     band.send(&mut display)?;
/// }
/// assert_eq!(heights, [10, 10, 10, 10, 10, 10, 4]);
/// assert_eq!(display.get_pixel(Point::new(8, 47)), Some(Rgb565::WHITE));
/// assert_eq!(display.get_pixel(Point::new(8, 48)), Some(Rgb565::BLUE));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<C> {
    area: Rectangle,
    background: C,
    /// Rows given out so far.
    done: u32,
}

/// A strip has room for less than a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BandError {
    /// Bytes of a row: the least a strip needs.
    pub needed: usize,
    /// What there is.
    pub given: usize,
}

impl core::fmt::Display for BandError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { needed, given } = self;
        write!(f, "a strip of {given} bytes has no room for a row: give it {needed}, or some times that")
    }
}

impl core::error::Error for BandError {}

impl<C: PixelFormat> Frame<C> {
    /// The pixels of `area`, in the coordinates of the display, before a background.
    pub const fn new(area: Rectangle, background: C) -> Self {
        Self { area, background, done: 0 }
    }

    /// All of it.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// The bytes that a strip of `rows` rows takes; saturates.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::{BinaryColor, Rgb565}, prelude::*};
    /// use pinhole::Frame;
    /// const STRIP: usize = Frame::<Rgb565>::strip_bytes(240, 8);
    /// assert_eq!(STRIP, 3840);
    /// assert_eq!(Frame::<BinaryColor>::strip_bytes(130, 8), 136);
    /// ```
    pub const fn strip_bytes(width: u32, rows: u32) -> usize {
        wire::stride::<C>(width).saturating_mul(rows as usize)
    }

    /// The next band, filled with the background: as many rows as the strip has room for and the frame
    /// still has. `None` after the last one, and for a frame without pixels.
    ///
    /// A band has as many whole rows as the strip holds; bytes left over are unused. A depth strip needs a number
    /// for each pixel of the band.
    ///
    /// Each call goes on below the last band, sent or not. To start again make a new `Frame`, or clone one
    /// beforehand.
    ///
    /// # Errors
    ///
    /// [`BandError`] when the strip has no room for a row.
    pub fn next_band<'s>(&mut self, strip: &'s mut [u8]) -> Result<Option<Band<'s, C>>, BandError> {
        let Size { width, height } = self.area.size;
        let left = height.saturating_sub(self.done);
        if left == 0 || width == 0 {
            return Ok(None);
        }
        let (needed, given) = (wire::stride::<C>(width), strip.len());
        let error = BandError { needed, given };
        // A row has a byte at least.
        let fits = given.checked_div(needed).unwrap_or(0).min(left as usize);
        let bytes =
            strip.get_mut(..fits.wrapping_mul(needed)).filter(|bytes| !bytes.is_empty()).ok_or(error)?;
        let top = self.area.top_left.y.saturating_add_unsigned(self.done);
        let rows = fits as u32; // ≤ left
        self.done += rows;
        let area = Rectangle::new(Point::new(self.area.top_left.x, top), Size::new(width, rows));
        let mut band = Band { area, stride: needed, bytes, colour: PhantomData };
        band.fill(self.background);
        Ok(Some(band))
    }
}

/// Some rows of a frame in memory: a DrawTarget in the frame's coordinates, so that all that draws on
/// the display draws on it, 3D or not; what lies above or below is left out.
///
/// Pixels are held as the wire takes them: see [`PixelFormat`]. [`Frame`] has an example.
#[derive(Debug)]
pub struct Band<'s, C> {
    area: Rectangle,
    stride: usize,
    bytes: &'s mut [u8],
    colour: PhantomData<C>,
}

impl<'s, C: PixelFormat> Band<'s, C> {
    /// Its pixels, in the coordinates of the frame.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// Its pixels as the wire takes them, row by row: for DMA, after the display was told the
    /// [`area`](Self::area).
    pub const fn bytes(&self) -> &[u8] {
        self.bytes
    }

    /// Its pixels as the fastest target, for colours of whole bytes (`N` each).
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
    /// use pinhole::{draw_line, raster::Pixel, Frame};
    /// let mut strip = [0; Frame::<Rgb565>::strip_bytes(8, 2)];
    /// let mut frame = Frame::new(Rectangle::new(Point::zero(), Size::new(8, 2)), Rgb565::BLACK);
    /// let mut band = frame.next_band(&mut strip)?.ok_or("no rows")?;
    /// draw_line(Pixel { x: 0, y: 1 }, Pixel { x: 7, y: 1 }, Rgb565::RED, &mut band.pixels())?;
    /// assert_eq!(band.bytes()[14..18], [0, 0, 0xf8, 0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(always)]
    pub fn pixels<const N: usize>(&mut self) -> Pixels<'_, C, [u8; N]>
    where
        C: StoredPixel<[u8; N]>,
    {
        const { assert!(C::BITS as usize == 8 * N, "StoredPixel's bytes are not as many as PixelFormat has bits") };
        let (cells, _) = self.bytes.as_chunks_mut();
        Pixels::unchecked(cells, self.area)
    }

    /// The [`bytes`](Self::bytes), no longer a band: for transfers that own their buffer. A strip that is longer does not get
    /// its end back: where frames are to be drawn into it again and again, have it as long as some rows of which the frame
    /// has a multiple.
    pub fn into_bytes(self) -> &'s mut [u8] {
        self.bytes
    }

    /// Its pixels, row by row, decoded from the strip's bytes: as many as the [`area`](Self::area) has.
    pub fn colors(&self) -> impl Iterator<Item = C> + '_ {
        let Size { width, height } = self.area.size;
        if C::BITS >= 8 {
            // Row after row, without bytes between them.
            let pixels = (width as usize).wrapping_mul(height as usize);
            Colours { bytes: self.bytes, stride: usize::MAX, width: pixels, x: 0, colour: PhantomData }
        } else {
            Colours {
                bytes: self.bytes,
                stride: self.stride,
                width: width as usize,
                x: 0,
                colour: PhantomData,
            }
        }
    }

    /// Sends it to the display: one `fill_contiguous`.
    ///
    /// # Errors
    ///
    /// The display's own; the band is as it was, and may be sent again.
    pub fn send<D: DrawTarget<Color = C>>(&self, display: &mut D) -> Result<(), D::Error> {
        display.fill_contiguous(&self.area, self.colors())
    }

    fn fill(&mut self, colour: C) {
        if C::BITS < 8 {
            // Also the bits beyond the end of a row.
            let pixels = (8 / C::BITS.max(1)) as usize;
            wire::fill(self.bytes, 0, self.bytes.len().saturating_mul(pixels), colour);
        } else {
            let Size { width, height } = self.area.size; // as many as the strip has bytes for
            wire::fill(self.bytes, 0, width.wrapping_mul(height) as usize, colour);
        }
    }

    /// The column and row of a rectangle that lies in the band.
    #[inline(always)]
    fn place(
        &self,
        &Rectangle { top_left: Point { x, y }, size: Size { width, height } }: &Rectangle,
    ) -> Option<(u32, u32)> {
        let Rectangle { top_left, size } = self.area;
        // Far too large to the left and above.
        let (column, row) = (x.wrapping_sub(top_left.x) as u32, y.wrapping_sub(top_left.y) as u32);
        let fits = |low: u32, extent: u32, all: u32| low <= all && extent <= all - low;
        (fits(column, width, size.width) && fits(row, height, size.height)).then_some((column, row))
    }

    #[inline(always)]
    fn fill_run(&mut self, (column, row): (u32, u32), width: u32, colour: C) {
        let (bytes, start) = self.row(row);
        let from = start.wrapping_add(column as usize);
        wire::fill(bytes, from, from.wrapping_add(width as usize), colour);
    }

    #[inline(never)]
    fn fill_rows(&mut self, (column, row): (u32, u32), Size { width, height }: Size, colour: C) {
        for row in row..row.wrapping_add(height) {
            self.fill_run((column, row), width, colour);
        }
    }

    /// Of what does not lie in the band whole.
    #[inline(never)]
    fn fill_part(&mut self, Point { x, y }: Point, part: Size, colour: C) {
        let Rectangle { top_left, size } = self.area;
        let columns = common(x, part.width, top_left.x, size.width);
        let rows = common(y, part.height, top_left.y, size.height);
        let part = Size::new(columns.end.wrapping_sub(columns.start), rows.end.wrapping_sub(rows.start));
        self.fill_rows((columns.start, rows.start), part, colour);
    }

    /// A row, and where in it its pixels begin.
    #[inline(always)]
    fn row(&mut self, row: u32) -> (&mut [u8], usize) {
        let row = row as usize;
        if C::BITS >= 8 {
            // A pixel inside has a place.
            return (self.bytes, row.wrapping_mul(self.area.size.width as usize));
        }
        let start = row.wrapping_mul(self.stride);
        (self.bytes.get_mut(start..start.wrapping_add(self.stride)).unwrap_or_default(), 0)
    }

    /// A pixel, if it is there.
    #[inline(always)]
    fn set(&mut self, Point { x, y }: Point, colour: C) {
        let Rectangle { top_left, size } = self.area;
        // Far too large to the left and above.
        let (column, row) = (x.wrapping_sub(top_left.x) as u32, y.wrapping_sub(top_left.y) as u32);
        if column < size.width && row < size.height {
            let (bytes, start) = self.row(row);
            wire::set(bytes, start.wrapping_add(column as usize), colour);
        }
    }
}

/// What two runs have in common, counted from the start of the second.
#[inline(never)]
fn common(low: i32, extent: u32, origin: i32, all: u32) -> Range<u32> {
    // What lies before the origin counts as there: not negative, and below 2³².
    let from_origin = |at: i32| (at.max(origin).wrapping_sub(origin) as u32).min(all);
    from_origin(low)..from_origin(low.saturating_add_unsigned(extent))
}

/// Pixels row by row.
struct Colours<'b, C> {
    /// From the row of the next pixel on.
    bytes: &'b [u8],
    stride: usize,
    width: usize,
    /// The next pixel.
    x: usize,
    colour: PhantomData<C>,
}

impl<C: PixelFormat> Iterator for Colours<'_, C> {
    type Item = C;

    #[inline(always)]
    fn next(&mut self) -> Option<C> {
        if self.x == self.width {
            (self.bytes, self.x) = (self.bytes.get(self.stride..)?, 0);
        }
        let colour = wire::get(self.bytes, self.x)?;
        self.x += 1;
        Some(colour)
    }
}

impl<C: PixelFormat> Dimensions for Band<'_, C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelFormat> DrawTarget for Band<'_, C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, colour) in pixels {
            self.set(at, colour);
        }
        Ok(())
    }

    #[inline(always)]
    fn fill_solid(&mut self, area: &Rectangle, colour: C) -> Result<(), Infallible> {
        match self.place(area) {
            // Most are: the spans of triangles.
            Some(place) if area.size.height == 1 => self.fill_run(place, area.size.width, colour),
            Some(place) => self.fill_rows(place, area.size, colour),
            None => self.fill_part(area.top_left, area.size, colour),
        }
        Ok(())
    }

    #[inline(always)]
    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        let mut colours = colours.into_iter();
        if let Some((column, row)) = self.place(area).filter(|_| area.size.height == 1) {
            let (bytes, start) = self.row(row);
            let from = start.wrapping_add(column as usize);
            wire::copy(bytes, from, from.wrapping_add(area.size.width as usize), colours);
            return Ok(());
        }
        // Rows below the band need no colours.
        let (top, bottom) =
            (area.top_left.y, self.area.top_left.y.saturating_add_unsigned(self.area.size.height));
        if area.size.width == 0 || bottom <= top {
            return Ok(());
        }
        let rows = area.size.height.min(bottom.wrapping_sub(top) as u32);
        for row in 0..rows {
            for column in 0..area.size.width {
                let Some(colour) = colours.next() else { return Ok(()) };
                let Point { x, y } = area.top_left;
                self.set(Point::new(x.wrapping_add_unsigned(column), y.wrapping_add_unsigned(row)), colour);
            }
        }
        Ok(())
    }

    fn clear(&mut self, colour: C) -> Result<(), Infallible> {
        self.fill(colour);
        Ok(())
    }
}

// Of colours and pixels nothing is said: a colour need not have a Format, and a strip is kilobytes.
#[cfg(feature = "defmt")]
impl<C> defmt::Format for Frame<C> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let (Rectangle { top_left, size }, done) = (self.area, self.done);
        defmt::write!(f, "frame of {} at {}, {=u32} rows given out", size, top_left, done);
    }
}

#[cfg(feature = "defmt")]
impl<C> defmt::Format for Band<'_, C> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Rectangle { top_left, size } = self.area;
        defmt::write!(f, "band of {} at {}", size, top_left);
    }
}
