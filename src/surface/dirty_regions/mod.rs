//! Dirty rectangles: the parts of the target that a new frame has to send.

mod cells;
mod cover;
mod tracked;

use cells::Cells;
use core::num::{NonZeroU16, NonZeroU32};
use cover::TransferBytes;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use heapless::Vec;
pub use tracked::Tracked;

/// How many bytes it takes to send a rectangle of pixels. By this [`DirtyRegions`] decides whether to send two rectangles as
/// one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TransferCost {
    pixel_bits: u16,
    window_bytes: u16,
}

impl TransferCost {
    /// The command bytes of one window for controllers with the MIPI Display Command Set (such as ST7789, ILI9341 and GC9A01)
    /// on a bus of 8 bits: `set_column_address` and `set_page_address` with four bytes each, and `write_memory_start` (MIPI
    /// Alliance, *Specification for Display Command Set*).
    pub const MIPI_DCS: u16 = 11;

    /// The cost for `pixel_bits` per pixel (see [`Color::FORMAT.bits()`](crate::color::Color::FORMAT.bits()); more than 256 count as 256) and
    /// `window_bytes` of commands before the first pixel of each rectangle. A row of pixels is rounded up to bytes; if there are
    /// [steps](DirtyRegions::with_steps), a row of steps is, and a step at the border counts as a whole one. 2³¹ bytes and more count as equal.
    pub const fn new(pixel_bits: u32, window_bytes: u16) -> Self {
        let pixel_bits = if pixel_bits < 256 { pixel_bits as u16 } else { 256 };
        Self { pixel_bits, window_bytes }
    }
}

/// The rectangles of a target that a new frame changes: those drawn in the last frame, which have to be erased, and those drawn
/// in this frame. It takes 16 bytes of memory per rectangle, and computes with integers only.
///
/// In every frame, first [show](Tracked::show) each object by a [`Tracked`] of its own: what has not changed is not sent. Then
/// [`take`](Self::take) the dirty rectangles and draw the background and the objects in each of them. Pixels outside do not change.
/// Two rectangles are merged where the rectangle around both takes no more bytes to send than the two separately.
///
/// An object that changes in every frame needs no `Tracked`: [`mark`](Self::mark) the rectangle that it is drawn in. The
/// rectangle is sent in this frame and once more in the next one, which erases it, whether anything has changed or not.
///
/// `N` is the largest number of rectangles that are stored per frame, and the largest number returned by `take`. A moving
/// object needs two, its old and its new rectangle; with a third, the corners of the enclosing rectangle that lie in neither
/// are not sent. No mark is lost when `N` is too small: the two rectangles whose merging adds the fewest bytes are merged.
///
/// ```
/// use embedded_graphics::{geometry::{Point, Size}, pixelcolor::Rgb565, primitives::Rectangle};
/// use pinhole::{bands::{DirtyRegions, Tracked, TransferCost}, color::Color};
/// let screen = Rectangle::new(Point::zero(), Size::new(240, 240));
/// let mut dirty = DirtyRegions::<4>::new(screen, TransferCost::new(Rgb565::FORMAT.bits(), TransferCost::MIPI_DCS));
/// let at = |x, y| Rectangle::new(Point::new(x, y), Size::new(10, 10));
///
/// let mut ball = Tracked::new();
/// let sent = [20, 20, 24].map(|x| {
///     ball.show((), at(x, 50), &mut dirty);
///     dirty.take()
/// });
/// assert_eq!(sent[0], [screen]); // a new target shows anything
/// assert_eq!(sent[1], []); // nothing has changed
/// assert_eq!(sent[2], [Rectangle::new(Point::new(20, 50), Size::new(14, 10))]); // the old and the new rectangle
/// ball.hide(&mut dirty);
/// dirty.take();
/// dirty.invalidate(); // for example after an error of the target
/// assert_eq!(dirty.take(), [screen]);
/// ```
///
/// Without [`Tracked`], each mark is sent twice:
///
/// ```
/// use embedded_graphics::{geometry::{Point, Size}, primitives::Rectangle};
/// use pinhole::bands::{DirtyRegions, TransferCost};
/// let screen = Rectangle::new(Point::zero(), Size::new(240, 240));
/// let mut dirty = DirtyRegions::<4>::new(screen, TransferCost::new(16, 11));
/// let at = |x, y| Rectangle::new(Point::new(x, y), Size::new(10, 10));
/// dirty.mark(at(20, 50));
/// assert_eq!(dirty.take(), [screen]); // a new target shows anything
/// dirty.mark(at(200, 50));
/// assert_eq!(dirty.take(), [at(20, 50), at(200, 50)]); // the old and the new rectangle
/// dirty.mark(at(201, 50));
/// assert_eq!(dirty.take(), [Rectangle::new(Point::new(200, 50), Size::new(11, 10))]);
/// assert_eq!(dirty.take(), [at(201, 50)]); // erased
/// assert_eq!(dirty.take(), []);
/// ```
///
/// A frame, drawn in bands of its dirty rectangles:
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
/// use embedded_graphics::primitives::{Circle, PrimitiveStyle};
/// use pinhole::{bands::{DirtyRegions, Frame, Tracked, TransferCost}, color::Color};
/// let mut display = MockDisplay::<Gray8>::new();
/// display.set_allow_overdraw(true);
/// let mut dirty = DirtyRegions::<4>::new(display.bounding_box(), TransferCost::new(Gray8::FORMAT.bits(), 11));
/// let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
/// let mut tracked = Tracked::new();
/// for x in [5, 9, 30] {
///     let ball = Circle::new(Point::new(x, 20), 12).into_styled(PrimitiveStyle::with_fill(Gray8::WHITE));
///     tracked.show((), ball.bounding_box(), &mut dirty); // for a mesh: `BinnedFaces::bounds`
///     for area in dirty.take() {
///         let mut frame = Frame::new(area, Gray8::BLACK);
///         while let Some(mut band) = frame.next_band(&mut strip)? {
///             ball.draw(&mut band)?; // and everything else in this band
///             band.send(&mut display)?;
///         }
///     }
/// }
/// let seen = |x| display.get_pixel(Point::new(x, 26));
/// assert_eq!((seen(11), seen(15), seen(36)), (Some(Gray8::BLACK), Some(Gray8::BLACK), Some(Gray8::WHITE)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DirtyRegions<const N: usize> {
    area: Rectangle,
    cost: TransferCost,
    columns: NonZeroU16,
    rows: NonZeroU16,
    /// The marks of the last frame and of this one.
    last: Vec<Cells, N>,
    now: Vec<Cells, N>,
    /// Whether all of the area is dirty, because it is not known what the target shows.
    all: bool,
}

/// The largest width and height of an area, in pixels.
const LARGEST: u32 = u16::MAX as u32;

const fn step(n: u16) -> NonZeroU16 {
    match NonZeroU16::new(n) {
        Some(n) => n,
        None => NonZeroU16::MIN,
    }
}

const fn at_most_largest(extent: u32) -> u32 {
    if extent < LARGEST {
        extent
    } else {
        LARGEST
    }
}

impl<const N: usize> DirtyRegions<N> {
    /// Dirty regions of the pixels of `area`, without marks. In the first frame all of the area is dirty. Pixels beyond 65535 ×
    /// 65535 are never sent. Use one value for all frames, for example in a static: it remembers the marks of the last frame.
    ///
    /// `DirtyRegions<0>` does not compile.
    pub const fn new(area: Rectangle, cost: TransferCost) -> Self {
        const { assert!(N > 0, "DirtyRegions<0> has no room for any rectangle") };
        let (width, height) = (at_most_largest(area.size.width), at_most_largest(area.size.height));
        Self {
            area: Rectangle::new(area.top_left, Size::new(width, height)),
            cost,
            columns: NonZeroU16::MIN,
            rows: NonZeroU16::MIN,
            last: Vec::new(),
            now: Vec::new(),
            all: true,
        }
    }

    /// Rounds rectangles outward to multiples of `columns` and `rows` (0 counts as 1), from the area's top left corner, for
    /// controllers that address several pixels at once: 2 columns where a byte holds two pixels of Gray4 or three bytes two of 12 bits, 8 rows where a byte
    /// holds a column of eight (SSD1306). If the area is not a multiple, rectangles at its right and bottom border end with it.
    /// Marks are dropped, and in the next frame all of the area is dirty.
    #[must_use]
    pub const fn with_steps(self, columns: u16, rows: u16) -> Self {
        let mut anew = Self::new(self.area, self.cost);
        core::mem::forget(self); // nothing to drop, which a const function must not do
        (anew.columns, anew.rows) = (step(columns), step(rows));
        anew
    }

    /// The rectangle of the target.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// Marks a rectangle that this frame draws, and that the next frame erases: it is sent in both frames, even if its pixels do
    /// not change. [`Tracked`] sends a rectangle only when it changes. Parts outside the area are ignored.
    pub fn mark(&mut self, rectangle: Rectangle) {
        let bytes = self.transfer_bytes();
        if let Some(cells) = self.cells(&rectangle) {
            cover::add(&mut self.now, cells, &bytes);
        }
    }

    /// Marks a rectangle whose pixels this frame changes, without having the next frame erase it, as [`mark`](Self::mark) does.
    fn mark_changed(&mut self, rectangle: Rectangle) {
        let bytes = self.transfer_bytes();
        if let Some(cells) = self.cells(&rectangle) {
            cover::add(&mut self.last, cells, &bytes); // it is gone when the frame is taken
        }
    }

    /// Makes all of the area dirty in the next frame, for example after a reset or an error, when the display may show anything.
    pub fn invalidate(&mut self) {
        self.all = true;
    }

    /// Ends the frame and returns the dirty rectangles: they contain all [marked](Self::mark) rectangles of the frame before
    /// and of the one that ends. They are in order from top to bottom, and from left to right where they begin in the same row.
    /// All lie in the area that the regions were made for; none is empty.
    ///
    /// The result never costs more bytes than the bounding rectangle of all marks; if both frames together have at most `N` marks,
    /// it also never costs more than sending each mark separately. Rectangles overlap only where cutting the overlap out would take more bytes
    /// of commands than it saves, or when the list of `N` rectangles is full.
    #[inline(never)] // its lists are gone when it returns
    pub fn take(&mut self) -> Vec<Rectangle, N> {
        let bytes = self.transfer_bytes();
        let now = core::mem::take(&mut self.now);
        let mut cover = core::mem::replace(&mut self.last, now);
        if core::mem::take(&mut self.all) {
            let all = self.cells(&self.area);
            cover.clear();
            all.into_iter().for_each(|all| cover::add(&mut cover, all, &bytes));
        } else {
            self.last.iter().for_each(|cells| cover::add(&mut cover, *cells, &bytes));
            cover::simplify(&mut cover, &bytes);
        }
        let mut rectangles = Vec::new();
        while let Some(cells) = cover::take_first(&mut cover) {
            let _ = rectangles.push(self.rectangle(cells)); // both have the capacity `N`
        }
        rectangles
    }

    fn transfer_bytes(&self) -> TransferBytes {
        let TransferCost { pixel_bits, window_bytes } = self.cost;
        let pixels = i32::from(self.columns.get()).saturating_mul(self.rows.get().into());
        TransferBytes { cell_bits: pixels.saturating_mul(pixel_bits.into()), window: window_bytes.into() }
    }

    /// The cells that a rectangle touches.
    fn cells(&self, rectangle: &Rectangle) -> Option<Cells> {
        // First and last cell along one axis. Differences have up to 35 bits before they are clamped to the area.
        let along = |low: i32, extent: u32, start: i32, length: u32, step: NonZeroU16| {
            let from = i64::from(low) - i64::from(start);
            let inside = |v: i64| v.clamp(0, length.min(LARGEST).into()) as u32;
            let (from, to) = (inside(from), inside(from + i64::from(extent)));
            let step = NonZeroU32::from(step);
            // At most 2¹⁶ − 1.
            (from < to).then(|| ((from / step) as u16, ((to - 1) / step + 1) as u16))
        };
        let (r, area) = (rectangle, &self.area);
        let (left, right) =
            along(r.top_left.x, r.size.width, area.top_left.x, area.size.width, self.columns)?;
        let (top, bottom) = along(r.top_left.y, r.size.height, area.top_left.y, area.size.height, self.rows)?;
        Cells::new(left, top, right, bottom)
    }

    /// The pixels of a rectangle of cells.
    fn rectangle(&self, cells: Cells) -> Rectangle {
        let along = |from: u16, to: u16, length: u32, step: NonZeroU16| {
            let pixels = |n: u16| (u32::from(n) * u32::from(step.get())).min(length);
            (pixels(from), pixels(to).saturating_sub(pixels(from)))
        };
        let (x, width) = along(cells.left, cells.right, self.area.size.width, self.columns);
        let (y, height) = along(cells.top, cells.bottom, self.area.size.height, self.rows);
        let Point { x: left, y: top } = self.area.top_left;
        // Saturates only for an area with pixels beyond the range of `i32`, which no target has.
        let corner = Point::new(left.saturating_add_unsigned(x), top.saturating_add_unsigned(y));
        Rectangle::new(corner, Size::new(width, height))
    }
}

defmt_format!(
    [const N: usize] DirtyRegions<N>, self,
    "dirty regions of {} at {}: {=usize}/{=usize} marks, {=usize} before, all: {=bool}",
    self.area.size, self.area.top_left, self.now.len(), N, self.last.len(), self.all
);
