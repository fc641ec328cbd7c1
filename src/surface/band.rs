//! A frame drawn in bands, through a strip of memory that is shorter than the frame.

use super::pixels::Pixels;
use super::row::{
    bits_of_bytes, copy_pixels, fill_all, fill_pixels, get_pixel, is_whole_bytes, row_bytes, set_pixel,
};
use crate::color::Color;
use crate::color::StoredPixel;
use crate::surface::BufferError;
use core::convert::Infallible;
use core::marker::PhantomData;
use core::ops::{ControlFlow, Range};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

/// A frame, or any rectangle of the display, drawn and sent in bands from top to bottom. All bands use one strip of memory, or
/// two by turns, so that one is sent while the next is drawn.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
/// use pinhole::bands::Frame;
/// let mut display = MockDisplay::<Rgb565>::new();
/// let mut strip = [0; 64 * 10 * 2]; // ten of the 64 rows, two bytes per pixel
/// let mut frame = Frame::new(display.bounding_box(), Rgb565::BLUE);
/// let mut heights = Vec::new();
/// while let Some(mut band) = frame.next_band(&mut strip)? {
///     // Draw the scene, then the overlay; a band clips like any target.
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
    /// The number of rows in the bands made so far.
    done: u32,
}

impl<C: Color> Frame<C> {
    /// The frame for the pixels of `area`, in the coordinates of the display. Each band begins filled with the background.
    pub const fn new(area: Rectangle, background: C) -> Self {
        Self { area, background, done: 0 }
    }

    /// The rectangle of the frame, in the coordinates of the display.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// The number of bytes that a strip of `rows` rows needs; saturates.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{BinaryColor, Rgb565};
    /// use pinhole::bands::Frame;
    /// const STRIP: usize = Frame::<Rgb565>::strip_bytes(240, 8);
    /// assert_eq!(STRIP, 3840);
    /// assert_eq!(Frame::<BinaryColor>::strip_bytes(130, 8), 136);
    /// ```
    pub const fn strip_bytes(width: u32, rows: u32) -> usize {
        row_bytes::<C>(width).saturating_mul(rows as usize)
    }

    /// The next band, filled with the background. It has as many rows as fit in the strip, or as the frame has left. `None`
    /// after the last band, and for a frame without pixels. A depth buffer for the band needs one `u16` per pixel of the band.
    ///
    /// Each call continues below the band before, whether that was sent or not. To start again, make a new `Frame`, or clone one
    /// before the first band.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when the strip has no room for a row.
    pub fn next_band<'s>(&mut self, strip: &'s mut [u8]) -> Result<Option<Band<'s, C>>, BufferError> {
        let Size { width, height } = self.area.size;
        let left = height.saturating_sub(self.done);
        if left == 0 || width == 0 {
            return Ok(None);
        }
        let (needed, given) = (row_bytes::<C>(width), strip.len());
        let error = BufferError::Strip { of: "a strip of one row", needed, given };
        // `needed` is not zero: a row has at least one byte.
        let fits = given.checked_div(needed).unwrap_or(0).min(left as usize);
        if fits == 0 {
            return Err(error);
        }
        let top = self.area.top_left.y.saturating_add_unsigned(self.done);
        let rows = fits as u32; // ≤ left
        self.done += rows;
        let area = Rectangle::new(Point::new(self.area.top_left.x, top), Size::new(width, rows));
        let mut band = Band { area, stride: needed, strip, color: PhantomData };
        band.fill(self.background);
        Ok(Some(band))
    }

    /// Band `index` of the frame, counted from 0 at the top, filled with the background: for bands that several cores draw,
    /// each into a strip of its own. All strips must have equal lengths. A band has as many rows as fit in the strip, the last
    /// one as many as are left. `None` below the frame. This is independent of the bands made so far, and does not count as one.
    /// [`BinnedFaces::fork`](crate::draw::BinnedFaces::fork) has an example.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when the strip has no room for a row.
    pub fn nth_band<'s>(&self, index: u32, strip: &'s mut [u8]) -> Result<Option<Band<'s, C>>, BufferError> {
        let rows = strip.len().checked_div(row_bytes::<C>(self.area.size.width)).unwrap_or(0);
        // Beyond 2³² rows there is no band: `next_band` says so of saturated rows.
        let done = index.saturating_mul(u32::try_from(rows).unwrap_or(u32::MAX));
        Self { area: self.area, background: self.background, done }.next_band(strip)
    }

    /// The next band, or the strip back after the last one: for transfers by DMA that own their buffer, such as those of
    /// embedded-dma. [`next_band`](Self::next_band) would keep such a strip at the end of the frame.
    ///
    /// All bands have as many rows as fit in the strip, so that [`Band::into_bytes`] never makes a strip shorter that has whole
    /// rows: where fewer rows are left, the last band begins above the end of the band before, and the rows in both are drawn
    /// and sent twice. Only a frame with fewer rows than the strip has a shorter band.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*, primitives::Rectangle};
    /// use pinhole::bands::Frame;
    /// use core::ops::ControlFlow::{Break, Continue};
    ///
    /// /// A driver's DMA transfer: it owns the strip until `wait`.
    /// struct Transfer(&'static mut [u8]);
    /// impl Transfer {
    ///     fn wait(self) -> &'static mut [u8] {
    ///         self.0
    ///     }
    /// }
    ///
    /// let [mut free, other] = [0; 2].map(|_| vec![0; 40 * 4].leak()); // two statics in firmware
    /// let mut transfer = Transfer(other);
    /// let mut rows = Vec::new();
    /// for _ in 0..2 {
    ///     let mut frame = Frame::new(Rectangle::new(Point::zero(), Size::new(40, 10)), Gray8::BLACK);
    ///     free = loop {
    ///         match frame.band_or_strip(free)? {
    ///             Break(strip) => break strip,
    ///             Continue(band) => {
    ///                 rows.push(band.area().rows()); // draw the scene
    ///                 free = transfer.wait();
    ///                 transfer = Transfer(band.into_bytes()); // start to send it
    /// #               assert_eq!(transfer.0.len(), 40 * 4);
    ///             }
    ///         }
    ///     }
    /// }
    /// assert_eq!(rows, [0..4, 4..8, 6..10, 0..4, 4..8, 6..10]);
    /// # Ok::<(), pinhole::target::BufferError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`BufferError`] when the strip has no room for a row.
    pub fn band_or_strip<'s>(
        &mut self,
        strip: &'s mut [u8],
    ) -> Result<ControlFlow<&'s mut [u8], Band<'s, C>>, BufferError> {
        let Size { width, height } = self.area.size;
        if self.done >= height || width == 0 {
            return Ok(ControlFlow::Break(strip));
        }
        let rows = strip.len().checked_div(row_bytes::<C>(width)).unwrap_or(0);
        self.done = self.done.min(height.saturating_sub(u32::try_from(rows).unwrap_or(u32::MAX)));
        // `None` has been returned above: rows are left.
        Ok(self.next_band(strip)?.map_or(ControlFlow::Break(&mut []), ControlFlow::Continue))
    }
}

/// Some rows of a frame in memory: a DrawTarget with the coordinates of the frame, so that code that draws on the display, 3D or
/// not, also draws on a band. Pixels outside the band are ignored.
///
/// The memory has the bytes that the display takes: see [`Color`]. [`Frame`] has an example.
#[derive(Debug)]
pub struct Band<'s, C> {
    area: Rectangle,
    stride: usize,
    /// The bytes of all rows, and perhaps more: `stride` times the height of the area is at most their number.
    strip: &'s mut [u8],
    color: PhantomData<C>,
}

impl<'s, C: Color> Band<'s, C> {
    /// A band whose rows are the first ones of a strip.
    pub(super) fn unchecked(area: Rectangle, strip: &'s mut [u8]) -> Self {
        Self { area, stride: row_bytes::<C>(area.size.width), strip, color: PhantomData }
    }

    /// The rectangle of the band, in the coordinates of the frame.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// The pixels as the display takes them, row by row, for example for DMA. Set the display's window to the
    /// [`area`](Self::area) first.
    pub const fn bytes(&self) -> &[u8] {
        match self.strip.split_at_checked(self.len()) {
            Some((bytes, _)) => bytes,
            None => &[],
        }
    }

    /// The number of bytes of the band's rows: at most those of the strip.
    const fn len(&self) -> usize {
        self.stride.wrapping_mul(self.area.size.height as usize)
    }

    /// The band's pixels as the fastest target, for colours of `N` whole bytes.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
    /// use pinhole::{bands::Frame, draw::draw_line};
    /// let mut strip = [0; Frame::<Rgb565>::strip_bytes(8, 2)];
    /// let mut frame = Frame::new(Rectangle::new(Point::zero(), Size::new(8, 2)), Rgb565::BLACK);
    /// let mut band = frame.next_band(&mut strip)?.ok_or("no rows")?;
    /// draw_line(Point::new(0, 1), Point::new(7, 1), Rgb565::RED, &mut band.pixels())?;
    /// assert_eq!(band.bytes()[14..18], [0, 0, 0xf8, 0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(always)]
    pub fn pixels<const N: usize>(&mut self) -> Pixels<'_, C, [u8; N]>
    where
        C: StoredPixel<[u8; N]>,
    {
        const {
            assert!(
                C::FORMAT.bits() as usize == 8 * N,
                "a pixel of the band is not as many bytes as one in memory: draw into the band itself"
            )
        };
        let (cells, _) = self.strip.as_chunks_mut();
        Pixels::unchecked(cells, self.area)
    }

    /// Converts the band into its [`bytes`](Self::bytes), for transfers that own their buffer. They end with the band's last
    /// row: a strip that comes back from such a transfer is shorter after a band that did not fill it. Bands from
    /// [`Frame::band_or_strip`] fill it.
    pub fn into_bytes(self) -> &'s mut [u8] {
        let len = self.len();
        self.strip.get_mut(..len).unwrap_or_default()
    }

    /// Converts the band into all of its strip and the number of bytes of the band, which are the first ones: for transfers
    /// that own a buffer and send a part of it. The strip comes back whole, also for dirty rectangles of all sizes.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*, primitives::Rectangle};
    /// use pinhole::bands::Frame;
    /// let mut strip = [0; 100];
    /// let mut frame = Frame::new(Rectangle::new(Point::zero(), Size::new(40, 10)), Gray8::BLACK);
    /// let band = frame.next_band(&mut strip)?.ok_or("no rows")?;
    /// assert_eq!(band.area().size.height, 2);
    /// let (strip, sent) = band.into_strip();
    /// assert_eq!((strip.len(), sent), (100, 80));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn into_strip(self) -> (&'s mut [u8], usize) {
        let len = self.len();
        (self.strip, len)
    }

    /// The colours of the [`area`](Self::area)'s pixels, row by row, decoded from the strip's bytes.
    pub fn colors(&self) -> impl Iterator<Item = C> + '_ {
        let Size { width, height } = self.area.size;
        if is_whole_bytes::<C>() {
            // Rows of whole bytes follow each other without gaps: one long row.
            let pixels = (width as usize).wrapping_mul(height as usize);
            BandColors { bytes: self.strip, stride: usize::MAX, width: pixels, x: 0, color: PhantomData }
        } else {
            BandColors {
                bytes: self.bytes(),
                stride: self.stride,
                width: width as usize,
                x: 0,
                color: PhantomData,
            }
        }
    }

    /// Sends the band to the display by one `fill_contiguous`.
    ///
    /// # Errors
    ///
    /// The error of the display. The band is unchanged and can be sent again.
    pub fn send<D: DrawTarget<Color = C>>(&self, display: &mut D) -> Result<(), D::Error> {
        // Pixels of whole bytes are decoded without a bounds check each: into a DrawTarget that copies them, 7.9 instructions a pixel
        // in place of 15 on an M3 (`tools/bench/run cells S3 send bands8-z M3`).
        match C::FORMAT.bits() {
            8 => display.fill_contiguous(&self.area, self.colors_of_bytes::<1>()),
            16 => display.fill_contiguous(&self.area, self.colors_of_bytes::<2>()),
            24 => display.fill_contiguous(&self.area, self.colors_of_bytes::<3>()),
            32 => display.fill_contiguous(&self.area, self.colors_of_bytes::<4>()),
            _ => display.fill_contiguous(&self.area, self.colors()),
        }
    }

    /// The colours of all pixels, of `N` bytes each.
    #[inline(always)]
    fn colors_of_bytes<const N: usize>(&self) -> impl Iterator<Item = C> + '_ {
        self.bytes().as_chunks::<N>().0.iter().map(|pixel| bits_of_bytes(pixel)).map(C::from_bits)
    }

    fn fill(&mut self, color: C) {
        let len = self.len();
        if is_whole_bytes::<C>() {
            fill_all(self.strip.get_mut(..len).unwrap_or_default(), color);
        } else if let Some(pixels) = 8_u32.checked_div(C::FORMAT.bits()).filter(|&pixels| pixels > 0) {
            // All bits, the unused ones at the end of each row included.
            fill_pixels(self.strip, 0, len.saturating_mul(pixels as usize), color);
        } else {
            for row in self.strip.get_mut(..len).unwrap_or_default().chunks_exact_mut(self.stride.max(1)) {
                // The upper half of the last byte belongs to the last pixel if their number is odd.
                if let Some(last) = row.last_mut() {
                    *last = 0;
                }
                fill_pixels(row, 0, self.area.size.width as usize, color);
            }
        }
    }

    /// The first column and row of a rectangle, counted from the band's first pixel; `None` unless all of it lies in the band.
    #[inline(always)]
    fn position(
        &self,
        &Rectangle { top_left: Point { x, y }, size: Size { width, height } }: &Rectangle,
    ) -> Option<(u32, u32)> {
        let Rectangle { top_left, size } = self.area;
        // The subtraction wraps: a pixel to the left or above gets a column or row beyond any size.
        let (column, row) = (x.wrapping_sub(top_left.x) as u32, y.wrapping_sub(top_left.y) as u32);
        let fits = |low: u32, extent: u32, all: u32| low <= all && extent <= all - low;
        (fits(column, width, size.width) && fits(row, height, size.height)).then_some((column, row))
    }

    #[inline(never)] // code size: a target's fill is inlined into several loops, and `pixels()` is the fast way to draw
    fn fill_run(&mut self, (column, row): (u32, u32), width: u32, color: C) {
        let (bytes, start) = self.row(row);
        let from = start.wrapping_add(column as usize);
        fill_pixels(bytes, from, from.wrapping_add(width as usize), color);
    }

    #[inline(never)]
    fn fill_rows(&mut self, (column, row): (u32, u32), Size { width, height }: Size, color: C) {
        for row in row..row.wrapping_add(height) {
            self.fill_run((column, row), width, color);
        }
    }

    /// Fills the part of a rectangle that lies in the band.
    #[inline(never)]
    fn fill_part(&mut self, Point { x, y }: Point, part: Size, color: C) {
        let Rectangle { top_left, size } = self.area;
        let columns = intersection(x, part.width, top_left.x, size.width);
        let rows = intersection(y, part.height, top_left.y, size.height);
        let part = Size::new(columns.end.wrapping_sub(columns.start), rows.end.wrapping_sub(rows.start));
        self.fill_rows((columns.start, rows.start), part, color);
    }

    /// Bytes that contain a row, and the index of the row's first pixel in them: the strip if pixels are
    /// whole bytes, otherwise the row alone.
    #[inline(always)]
    fn row(&mut self, row: u32) -> (&mut [u8], usize) {
        let row = row as usize;
        if is_whole_bytes::<C>() {
            // Does not wrap for a row of the band.
            return (self.strip, row.wrapping_mul(self.area.size.width as usize));
        }
        let start = row.wrapping_mul(self.stride);
        (self.strip.get_mut(start..start.wrapping_add(self.stride)).unwrap_or_default(), 0)
    }

    /// Sets a pixel, if it lies in the band.
    #[inline(always)]
    fn set(&mut self, Point { x, y }: Point, color: C) {
        let Rectangle { top_left, size } = self.area;
        // The subtraction wraps: a pixel to the left or above gets a column or row beyond any size.
        let (column, row) = (x.wrapping_sub(top_left.x) as u32, y.wrapping_sub(top_left.y) as u32);
        if column < size.width && row < size.height {
            let (bytes, start) = self.row(row);
            set_pixel(bytes, start.wrapping_add(column as usize), color);
        }
    }
}

/// The intersection of two ranges of pixels, counted from the start of the second.
#[inline(never)]
fn intersection(low: i32, extent: u32, origin: i32, all: u32) -> Range<u32> {
    // Positions before the origin are moved to it, so that the difference is 0 … 2³² − 1.
    let from_origin = |at: i32| (at.max(origin).wrapping_sub(origin) as u32).min(all);
    from_origin(low)..from_origin(low.saturating_add_unsigned(extent))
}

/// The colours of a band, row by row.
struct BandColors<'b, C> {
    /// The bytes of the row of the next pixel and of all rows below it.
    bytes: &'b [u8],
    stride: usize,
    width: usize,
    /// The column of the next pixel.
    x: usize,
    color: PhantomData<C>,
}

impl<C: Color> Iterator for BandColors<'_, C> {
    type Item = C;

    #[inline(always)]
    fn next(&mut self) -> Option<C> {
        if self.x == self.width {
            (self.bytes, self.x) = (self.bytes.get(self.stride..)?, 0);
        }
        let color = get_pixel(self.bytes, self.x)?;
        self.x += 1;
        Some(color)
    }
}

impl<C: Color> Dimensions for Band<'_, C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: Color> DrawTarget for Band<'_, C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, color) in pixels {
            self.set(at, color);
        }
        Ok(())
    }

    #[inline(always)]
    fn fill_solid(&mut self, area: &Rectangle, color: C) -> Result<(), Infallible> {
        match self.position(area) {
            // The spans of triangles, the common case.
            Some(position) if area.size.height == 1 => self.fill_run(position, area.size.width, color),
            Some(position) => self.fill_rows(position, area.size, color),
            None => self.fill_part(area.top_left, area.size, color),
        }
        Ok(())
    }

    #[inline(always)]
    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        let mut colors = colors.into_iter();
        if let Some((column, row)) = self.position(area).filter(|_| area.size.height == 1) {
            let (bytes, start) = self.row(row);
            let from = start.wrapping_add(column as usize);
            copy_pixels(bytes, from, from.wrapping_add(area.size.width as usize), colors);
            return Ok(());
        }
        // The iterator is not advanced for rows below the band.
        let (top, bottom) =
            (area.top_left.y, self.area.top_left.y.saturating_add_unsigned(self.area.size.height));
        if area.size.width == 0 || bottom <= top {
            return Ok(());
        }
        let rows = area.size.height.min(bottom.wrapping_sub(top) as u32);
        for row in 0..rows {
            for column in 0..area.size.width {
                let Some(color) = colors.next() else { return Ok(()) };
                let Point { x, y } = area.top_left;
                self.set(Point::new(x.wrapping_add_unsigned(column), y.wrapping_add_unsigned(row)), color);
            }
        }
        Ok(())
    }

    fn clear(&mut self, color: C) -> Result<(), Infallible> {
        self.fill(color);
        Ok(())
    }
}

// Colours and pixels are not printed: a colour need not implement `Format`, and a strip is kilobytes.
defmt_format!(
    [C] Frame<C>, self,
    "frame of {} at {}, {=u32} rows drawn", self.area.size, self.area.top_left, self.done
);

defmt_format!([C] Band<'_, C>, self, "band of {} at {}", self.area.size, self.area.top_left);
