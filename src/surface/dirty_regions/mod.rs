//! DirtyRegions rectangles: which parts of the target a new frame has to send.

mod cells;
mod cover;

use cells::Cells;
use core::num::{NonZeroU16, NonZeroU32};
use cover::Price;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use heapless::Vec;

/// What a target charges for a rectangle of pixels: what decides whether two rectangles are sent as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TransferCost {
    pixel_bits: u16,
    window_bytes: u16,
}

impl TransferCost {
    /// The bytes of one window for controllers with the MIPI Display Command Set (ST7789, ILI9341,
    /// GC9A01 and kin) on a bus of 8 bits: `set_column_address` and `set_page_address` with four bytes
    /// each, and `write_memory_start` (MIPI Alliance, *Specification for Display Command Set*).
    pub const MIPI_DCS: u16 = 11;

    /// A pixel of `pixel_bits`, [`PixelFormat::BITS`](crate::PixelFormat::BITS) (beyond 256 they count as 256), and
    /// windows of `window_bytes` in commands before their first pixel. A row of pixels takes whole bytes; with
    /// [steps](DirtyRegions::with_steps) a row of these does, and each counts whole. 2³¹ bytes and more count as equal.
    pub const fn new(pixel_bits: u32, window_bytes: u16) -> Self {
        let pixel_bits = if pixel_bits < 256 { pixel_bits as u16 } else { 256 };
        Self { pixel_bits, window_bytes }
    }
}

/// The rectangles of a target that differ from what it shows: those drawn in the last frame, which are
/// erased, and those of this one. Integers only; 16 bytes a rectangle.
///
/// For every frame, [`mark`](Self::mark) what is drawn, then [`take`](Self::take) the rectangles and draw each
/// anew with its background: everything outside them is as it was. Marks are merged where the rectangle about both
/// costs no more bytes than both apart. What rests need not be marked. When it starts to move, mark both its old
/// and its new place, since its last mark is gone; in the frame after it stops it is sent once more.
///
/// `N` is how many rectangles are marked in a frame, and how many are taken, at most. Two for each thing
/// that moves are room for where it was and where it is; a third one for leaving out the corners that
/// neither has. With more marks nothing is lost: the two that cost least are merged.
///
/// ```
/// use embedded_graphics::{geometry::{Point, Size}, pixelcolor::Rgb565, primitives::Rectangle};
/// use pinhole::{DirtyRegions, TransferCost, PixelFormat};
/// let screen = Rectangle::new(Point::zero(), Size::new(240, 240));
/// let mut dirty = DirtyRegions::<4>::new(screen, TransferCost::new(Rgb565::BITS, TransferCost::MIPI_DCS));
/// let at = |x, y| Rectangle::new(Point::new(x, y), Size::new(10, 10));
///
/// dirty.mark(at(20, 50));
/// assert_eq!(dirty.take(), [screen]); // nothing is known of a new target
/// dirty.mark(at(200, 50));
/// assert_eq!(dirty.take(), [at(20, 50), at(200, 50)]); // where it was, and where it is
/// dirty.mark(at(201, 50));
/// assert_eq!(dirty.take(), [Rectangle::new(Point::new(200, 50), Size::new(11, 10))]);
/// assert_eq!(dirty.take(), [at(201, 50)]); // gone
/// assert_eq!(dirty.take(), []);
/// dirty.invalidate(); // after an error of the target, say
/// assert_eq!(dirty.take(), [screen]);
/// ```
///
/// A frame, drawn in bands of its dirty rectangles:
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
/// use embedded_graphics::primitives::{Circle, PrimitiveStyle};
/// use pinhole::{DirtyRegions, Frame, TransferCost, PixelFormat};
/// let mut display = MockDisplay::<Gray8>::new();
/// display.set_allow_overdraw(true);
/// let mut dirty = DirtyRegions::<4>::new(display.bounding_box(), TransferCost::new(Gray8::BITS, 11));
/// let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
/// for x in [5, 9, 30] {
///     let ball = Circle::new(Point::new(x, 20), 12).into_styled(PrimitiveStyle::with_fill(Gray8::WHITE));
///     dirty.mark(ball.bounding_box()); // of a mesh: `BinnedFaces::bounds`
///     for area in dirty.take() {
///         let mut frame = Frame::new(area, Gray8::BLACK);
///         while let Some(mut band) = frame.next_band(&mut strip)? {
///             ball.draw(&mut band)?; // and all else that lies there
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
    last: Vec<Cells, N>,
    now: Vec<Cells, N>,
    /// Nothing is known of the target.
    all: bool,
}

/// Rectangles are no larger than this.
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
    /// For the pixels of `area`, cut to 65535 × 65535: what is beyond is never sent. The first frame is all of
    /// what remains. It lives as long as what the target shows: a variable of the program, or a static.
    ///
    /// A capacity `N` of 0 does not compile.
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

    /// Rounds rectangles outward to whole multiples of `columns` and `rows` (0 is 1), counted from the
    /// area's corner, for controllers that address several pixels at once: 2 columns where a byte is
    /// two pixels of Gray4, 8 rows where a byte is a column of eight (SSD1306). Where the area is no
    /// multiple, its last rectangles end with it. The first frame is all of the area again.
    #[must_use]
    pub const fn with_steps(self, columns: u16, rows: u16) -> Self {
        let mut anew = Self::new(self.area, self.cost);
        core::mem::forget(self); // nothing to drop, which a const function must not do
        (anew.columns, anew.rows) = (step(columns), step(rows));
        anew
    }

    /// The pixels it stands for.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// Marks what this frame draws; parts outside the area do not count.
    pub fn mark(&mut self, rectangle: Rectangle) {
        let price = self.price();
        if let Some(cells) = self.cells(&rectangle) {
            cover::add(&mut self.now, cells, &price);
        }
    }

    /// Nothing is known of the target any more, as at the beginning, or after an error of the
    /// target: the next frame is all of the area.
    pub fn invalidate(&mut self) {
        self.all = true;
    }

    /// Ends the frame: the rectangles that hold all marks of the last frame and of this one, from top to
    /// bottom (of those that begin in the same row, from left to right). They lie in the area; none is
    /// empty.
    ///
    /// They cost no more bytes than one rectangle about all marks; and as long as the marks of two frames
    /// are `N` at most, no more than each by itself. They overlap only where cutting saves less
    /// than another window costs, or there is no room for more of them.
    #[inline(never)] // its lists are gone when it returns
    pub fn take(&mut self) -> Vec<Rectangle, N> {
        let price = self.price();
        let now = core::mem::take(&mut self.now);
        let mut cover = core::mem::replace(&mut self.last, now);
        if core::mem::take(&mut self.all) {
            let all = self.cells(&self.area);
            cover.clear();
            all.into_iter().for_each(|all| cover::add(&mut cover, all, &price));
        } else {
            self.last.iter().for_each(|cells| cover::add(&mut cover, *cells, &price));
            cover::settle(&mut cover, &price);
        }
        let mut rectangles = Vec::new();
        while let Some(cells) = cover::take_first(&mut cover) {
            let _ = rectangles.push(self.rectangle(cells)); // as many as a cover has room for
        }
        rectangles
    }

    fn price(&self) -> Price {
        let TransferCost { pixel_bits, window_bytes } = self.cost;
        let pixels = i32::from(self.columns.get()).saturating_mul(self.rows.get().into());
        Price { cell_bits: pixels.saturating_mul(pixel_bits.into()), window: window_bytes.into() }
    }

    /// The cells that a rectangle touches.
    fn cells(&self, rectangle: &Rectangle) -> Option<Cells> {
        // One direction: 35 bits before they are brought into the area.
        let along = |low: i32, extent: u32, start: i32, length: u32, step: NonZeroU16| {
            let from = i64::from(low) - i64::from(start);
            let inside = |v: i64| v.clamp(0, length.min(LARGEST).into()) as u32;
            let (from, to) = (inside(from), inside(from + i64::from(extent)));
            let step = NonZeroU32::from(step);
            // At most 2¹⁶ − 1 again.
            (from < to).then(|| ((from / step) as u16, ((to - 1) / step + 1) as u16))
        };
        let (r, area) = (rectangle, &self.area);
        let (left, right) =
            along(r.top_left.x, r.size.width, area.top_left.x, area.size.width, self.columns)?;
        let (top, bottom) = along(r.top_left.y, r.size.height, area.top_left.y, area.size.height, self.rows)?;
        Cells::new(left, top, right, bottom)
    }

    /// The pixels of cells.
    fn rectangle(&self, cells: Cells) -> Rectangle {
        let along = |from: u16, to: u16, length: u32, step: NonZeroU16| {
            let pixels = |n: u16| (u32::from(n) * u32::from(step.get())).min(length);
            (pixels(from), pixels(to).saturating_sub(pixels(from)))
        };
        let (x, width) = along(cells.left, cells.right, self.area.size.width, self.columns);
        let (y, height) = along(cells.top, cells.bottom, self.area.size.height, self.rows);
        let Point { x: left, y: top } = self.area.top_left;
        // Inside the area; an area that leaves i32 has no rectangles there that a target could show.
        let corner = Point::new(left.saturating_add_unsigned(x), top.saturating_add_unsigned(y));
        Rectangle::new(corner, Size::new(width, height))
    }
}

#[cfg(feature = "defmt")]
impl<const N: usize> defmt::Format for DirtyRegions<N> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let (marks, last) = (self.now.len(), self.last.len());
        let Rectangle { top_left, size } = self.area;
        defmt::write!(
            f,
            "dirty of {} at {}: {=usize}/{=usize} marks, {=usize} before, all: {=bool}",
            size,
            top_left,
            marks,
            N,
            last,
            self.all
        );
    }
}

#[cfg(test)]
mod tests {
    use super::{DirtyRegions, TransferCost};
    use embedded_graphics_core::geometry::{Point, Size};
    use embedded_graphics_core::primitives::Rectangle;

    const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));

    fn at(x: i32, y: i32, width: u32, height: u32) -> Rectangle {
        Rectangle::new(Point::new(x, y), Size::new(width, height))
    }

    fn taken<const N: usize>(bits: u32, marks: &[Rectangle]) -> heapless::Vec<Rectangle, N> {
        let mut dirty = DirtyRegions::<N>::new(SCREEN, TransferCost::new(bits, TransferCost::MIPI_DCS));
        assert_eq!(dirty.take(), [SCREEN]);
        marks.iter().for_each(|r| dirty.mark(*r));
        dirty.take()
    }

    /// 5 pixels of 16 bits are less than a window's 11 bytes, 6 are more.
    #[test]
    fn two_are_merged_where_that_is_no_dearer() {
        assert_eq!(taken::<8>(16, &[at(0, 0, 9, 5), at(10, 0, 9, 5)]), [at(0, 0, 19, 5)]);
        assert_eq!(taken::<8>(16, &[at(0, 0, 9, 6), at(10, 0, 9, 6)]), [at(0, 0, 9, 6), at(10, 0, 9, 6)]);
        assert_eq!(taken::<8>(24, &[at(0, 0, 9, 4), at(10, 0, 9, 4)]), [at(0, 0, 9, 4), at(10, 0, 9, 4)]);
        assert_eq!(taken::<8>(16, &[at(7, 7, 9, 9), at(8, 8, 2, 2), at(7, 7, 9, 9)]), [at(7, 7, 9, 9)]);
    }

    #[test]
    fn no_pixel_is_sent_twice() {
        // A stem under a bar, the bar first or last.
        let (bar, stem) = (at(0, 20, 100, 10), at(40, 25, 10, 100));
        for marks in [[bar, stem], [stem, bar]] {
            assert_eq!(taken::<8>(16, &marks), [bar, at(40, 30, 10, 95)]);
        }
        // A thing that moved by half its size: where it is whole, and the angle it left.
        let moved = [at(10, 10, 40, 40), at(30, 30, 40, 40)];
        assert_eq!(taken::<8>(16, &moved).len(), 3);
        assert_eq!(taken::<2>(16, &moved), moved); // no room for three
        let mut pixels: u32 = 0;
        for r in taken::<8>(16, &moved) {
            pixels += r.size.width * r.size.height;
        }
        assert_eq!(pixels, 2 * 1600 - 400);
    }

    /// A square moved by d pixels both ways: one rectangle about both has 2·d² pixels, of 2 bytes, that
    /// neither has, and saves two windows of 11 bytes.
    #[test]
    fn corners_that_neither_has_are_left_out() {
        let moved = |d: i32| taken::<8>(16, &[at(10, 10, 40, 40), at(10 + d, 10 + d, 40, 40)]);
        assert_eq!(moved(2), [at(10, 10, 42, 42)]);
        assert_eq!(moved(3), [at(10, 10, 40, 40), at(50, 13, 3, 37), at(13, 50, 40, 3)]);
    }

    #[test]
    fn without_room_the_two_that_cost_least_are_merged() {
        let far = [at(0, 0, 20, 20), at(200, 200, 20, 20), at(200, 0, 20, 20)];
        let near = at(225, 0, 10, 20);
        for order in [[far[0], far[1], far[2], near], [near, far[2], far[1], far[0]]] {
            assert_eq!(taken::<3>(16, &order), [far[0], at(200, 0, 35, 20), far[1]]);
        }
        assert_eq!(taken::<1>(16, &far), [at(0, 0, 220, 220)]);
    }

    #[test]
    fn what_stands_still_and_is_not_marked_is_not_sent() {
        let mut dirty = DirtyRegions::<2>::new(SCREEN, TransferCost::new(16, TransferCost::MIPI_DCS));
        dirty.mark(at(10, 10, 9, 9));
        assert_eq!(dirty.take(), [SCREEN]);
        assert_eq!(dirty.take(), [at(10, 10, 9, 9)]);
        assert_eq!(dirty.take(), []);
        dirty.mark(at(-5, 230, 20, 20));
        dirty.mark(at(0, 240, 20, 20));
        dirty.mark(at(10, 10, 0, 20));
        assert_eq!(dirty.take(), [at(0, 230, 15, 10)]);
    }

    #[test]
    fn a_lost_transfer_is_made_good() {
        let mut dirty = DirtyRegions::<2>::new(SCREEN, TransferCost::new(16, TransferCost::MIPI_DCS));
        dirty.take();
        dirty.mark(at(10, 10, 9, 9));
        dirty.take();
        dirty.invalidate();
        dirty.mark(at(50, 10, 9, 9));
        assert_eq!(dirty.take(), [SCREEN]);
        assert_eq!(dirty.take(), [at(50, 10, 9, 9)]); // that frame's mark is not forgotten
    }

    /// Gray4 in bytes of two pixels, and the pages of an SSD1306.
    #[test]
    fn rectangles_are_whole_steps() {
        let area = at(0, 0, 127, 64);
        let mut gray = DirtyRegions::<4>::new(area, TransferCost::new(4, 6)).with_steps(2, 1);
        assert_eq!(gray.take(), [area]);
        gray.mark(at(3, 5, 4, 4));
        gray.mark(at(125, 60, 2, 1));
        assert_eq!(gray.take(), [at(2, 5, 6, 4), at(124, 60, 3, 1)]);
        let mut pages = DirtyRegions::<4>::new(area, TransferCost::new(1, 6)).with_steps(1, 8);
        pages.take();
        pages.mark(at(3, 7, 30, 2));
        assert_eq!(pages.take(), [at(3, 0, 30, 16)]);
    }
}
