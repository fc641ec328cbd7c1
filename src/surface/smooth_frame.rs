//! A frame drawn in bands whose edges are smoothed: the last rows of each band wait for those below them.

use super::band::Band;
use super::pixels::Pixels;
use super::row::{fill_all, is_whole_bytes, pack};
use super::smoothing::SmoothPass;
use super::{inside, BufferError, DepthBuffer};
use crate::color::{Color, StoredPixel};
use crate::math::hints::keep_rolled;
use crate::raster::PixelLayout;
use bytemuck::{must_cast_slice, must_cast_slice_mut, pod_align_to, pod_align_to_mut};
use core::marker::PhantomData;
use core::ops::Range;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// The rows that wait for the next band: the second pass cannot mix the last row with the row below it, which is not drawn yet, so the third pass
/// cannot mix the last two rows with each other.
const WAITING: usize = 2;

/// The fewest rows of a strip. The first band then has three new rows, of which it finishes one.
const LEAST: usize = 6;

/// The fewest rows of a strip for a band by its number: three on each side of the row that is sent.
const LEAST_BY_NUMBER: usize = 7;

/// A [`Frame`](crate::bands::Frame) whose edges are smoothed. Smoothing a row needs the rows below it, so the last two rows of each band, with their
/// depths, are kept for the next band. In the strip a pixel takes whole bytes: one of Gray2 and Gray4, two of 12 bits. Rows that are finished are packed as the
/// display takes them. A type of two colours, such as `BinaryColor`, has none between them, and cannot be smoothed.
///
/// Two cores smooth a part of the screen each, such as a half, drawn three pixels larger as in the example: with a [fork](crate::draw::BinnedFaces::fork) of
/// the faces, and edges that each core finds in the shared [`TransformedMesh`](crate::draw::TransformedMesh), into storage of its own.
///
/// Bands are always equal to one piece. A part of the screen is, too, and needs no margin, if it contains the [bounds](crate::draw::SmoothEdges::bounds) of
/// all edges: mark every object in a [`DirtyRegions::<1>`](crate::bands::DirtyRegions), and each frame has one such part. The parts of
/// [`Tracked`](crate::bands::Tracked) objects cut through those that stand still. Parts that cut edges are equal to one piece if no two edges are less than three
/// pixels apart; where bars are a pixel wide, a mixed pixel is mixed again by the next edge of its row, so pixels at the border of a part may be off by
/// some levels. No difference was found when parts are drawn eight pixels larger.
///
/// ```
/// use embedded_graphics::{draw_target::DrawTargetExt, mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
/// use pinhole::{bands::{DirtyRegions, SmoothFrame, TransferCost}, meshes::CUBE, prelude::*, Angle};
/// let mut display = MockDisplay::<Gray8>::new();
/// display.set_allow_overdraw(true);
/// let viewport = Viewport::new(Point::zero(), display.size())?;
/// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::degrees(20))?;
/// let instance = camera.place(&CUBE, &Affine::identity());
/// // `pinhole-import --edges creases-first --edge-faces` writes such a `const`. Firmware has these buffers in statics.
/// let mut buffers = mesh_buffers!(smooth: CUBE);
/// let mut strip = strip_buffers!(Gray8, 64, 8, smooth); // 8 rows, and two that wait
///
/// let mesh = instance.transform_depth(&mut buffers.cache);
/// let mut faces = mesh.bin_faces(&mut buffers.bins)?;
/// let mut edges = mesh.bin_smooth_edges(|_| false, &mut buffers.edge_bins)?;
/// let mut frame = SmoothFrame::new(display.bounding_box(), Gray8::BLACK, &mut strip.kept, &mut strip.depths)?;
/// let mut heights = Vec::new();
/// while let Some(mut band) = frame.next_band(&mut strip.colors)? {
///     let (mut pixels, mut depth) = band.new_rows();
///     faces.draw(|_| Gray8::WHITE, &mut pixels.depth_tested(&mut depth))?;
///     let band = band.smooth(|pass| edges.draw(pass)); // a `Band` of the rows that are finished
///     heights.push(band.area().size.height);
///     band.send(&mut display)?;
/// }
/// assert_eq!(heights, [6, 8, 8, 8, 8, 8, 8, 10]);
///
/// // A part of the screen lacks neighbours at its border: draw three pixels more on each side, which are not sent.
/// let mut dirty = DirtyRegions::<4>::new(display.bounding_box(), TransferCost::new(8, TransferCost::MIPI_DCS));
/// let mut strip = strip_buffers!(Gray8, 64 + 6, 8, smooth);
/// dirty.mark(edges.bounds(faces.bounds()));
/// for part in dirty.take() {
///     let mut frame = SmoothFrame::new(part.offset(3), Gray8::BLACK, &mut strip.kept, &mut strip.depths)?;
///     while let Some(mut band) = frame.next_band(&mut strip.colors)? {
///         let (mut pixels, mut depth) = band.new_rows();
///         faces.draw(|_| Gray8::WHITE, &mut pixels.depth_tested(&mut depth))?;
///         let band = band.smooth(|pass| edges.draw(pass));
///         band.send(&mut display.clipped(&part))?; // of `embedded_graphics::draw_target::DrawTargetExt`
///     }
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SmoothFrame<'k, C> {
    area: Rectangle,
    background: C,
    /// The number of rows drawn so far.
    done: u32,
    /// Whether the last rows of the band before wait: then `kept` has their pixels, and `depths` begins with their depths.
    waits: bool,
    kept: &'k mut [u8],
    depths: &'k mut [u16],
}

/// A band of a [`SmoothFrame`]: the rows that waited, and new rows.
#[derive(Debug)]
pub struct SmoothBand<'s, 'k, C> {
    /// All rows, and the new ones.
    all: Rectangle,
    new: Rectangle,
    /// Which of all rows are sent.
    sent: Range<u32>,
    /// The pixels and depths of all rows.
    strip: &'s mut [u8],
    depths: &'k mut [u16],
    kept: &'k mut [u8],
    /// Whether the last rows wait for the next band.
    waits: bool,
    color: PhantomData<C>,
}

/// The number of bytes of a row of `width` pixels before it is packed.
const fn cell_bytes<C: Color>(width: u32) -> usize {
    (width as usize).saturating_mul(C::FORMAT.bits().div_ceil(8) as usize)
}

impl<'k, C: Color> SmoothFrame<'k, C> {
    /// The number of bytes that a strip of `rows` rows needs, in which each pixel has whole bytes; saturates.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Gray4, Rgb565};
    /// use pinhole::bands::SmoothFrame;
    /// assert_eq!(SmoothFrame::<Rgb565>::strip_bytes(240, 8), 3840);
    /// assert_eq!(SmoothFrame::<Gray4>::strip_bytes(240, 8), 1920);
    /// ```
    pub const fn strip_bytes(width: u32, rows: u32) -> usize {
        cell_bytes::<C>(width).saturating_mul(rows as usize)
    }

    /// The frame for the pixels of `area`. `kept` holds two rows between bands, in [`strip_bytes`](Self::strip_bytes) of two rows; `depths`
    /// has the depths of a band, and between bands those of these rows. `strip_buffers!(COLOR, WIDTH, ROWS, smooth)` has all three.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when there is no room for two rows in `kept`, or for six in `depths`.
    pub fn new(
        area: Rectangle,
        background: C,
        kept: &'k mut [u8],
        depths: &'k mut [u16],
    ) -> Result<Self, BufferError> {
        let (needed, given) = (Self::strip_bytes(area.size.width, WAITING as u32), kept.len());
        let kept =
            kept.get_mut(..needed).ok_or(BufferError::Strip { of: "`kept` of two rows", needed, given })?;
        let (needed, given) = ((area.size.width as usize).saturating_mul(LEAST), depths.len());
        if given < needed {
            return Err(BufferError::Depth { needed: needed as u64, given });
        }
        Ok(Self { area, background, done: 0, waits: false, kept, depths })
    }

    /// The next band: the rows that waited, and new rows, filled with the background. `None` after the last band. The last
    /// band has all rows that are left. Every other band has two new rows fewer than the strip and the depths have room for, and one fewer still if it
    /// would end at an even row.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when the strip has no room for six rows.
    pub fn next_band<'s, 'b>(
        &'b mut self,
        strip: &'s mut [u8],
    ) -> Result<Option<SmoothBand<'s, 'b, C>>, BufferError> {
        let left = self.area.size.height.saturating_sub(self.done);
        if left == 0 || self.area.size.width == 0 {
            return Ok(None);
        }
        let room = self.room(strip, LEAST, "a strip of six rows")?;
        let before = if self.waits { WAITING as u32 } else { 0 };
        let mut new = left;
        let top = self.area.top_left.y.saturating_add_unsigned(self.done);
        let waits = new > room - before;
        if waits {
            new = room - WAITING as u32; // as many in the first band as in others, so that bands end where bins do
            new -= top.saturating_add_unsigned(new) as u32 & 1; // at least 3
        }
        if self.waits {
            copy(strip, self.kept);
        }
        self.done += new; // at most `height`
        self.waits = waits;
        let finished = before + new - if waits { WAITING as u32 } else { 0 };
        Ok(Some(self.band(top, [before, new], 0..finished, strip)))
    }

    /// Band `index` of the frame, counted from 0 at the top: for single bands, in any order. All strips must have equal lengths. `None` below the frame. The
    /// pixels are those of [`next_band`](Self::next_band), which begins at the top after a band. Each core needs a frame of its own.
    ///
    /// The rows beside a band are drawn, too, and not sent: two on each side if the frame begins at an even row, and the strip and the depths have room for
    /// an even number of rows, otherwise three. The other rows that fit are the band, of which the last one may have fewer: strips of 14 rows send ten, strips
    /// of eight rows four.
    ///
    /// A band begins again with all faces and edges unless the rows that it draws lie below those of the band before. A whole frame is several times as fast by
    /// `next_band`, and two cores are faster with a half of the screen each than with bands in turn.
    ///
    /// The memory of the [`Band`] begins with its rows: [`into_strip`](Band::into_strip) returns the strip from there on.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when the strip or the depths have no room for seven rows.
    pub fn nth_band<'s, 'b>(
        &'b mut self,
        index: u32,
        strip: &'s mut [u8],
    ) -> Result<Option<SmoothBand<'s, 'b, C>>, BufferError> {
        let Rectangle { top_left, size: Size { width, height } } = self.area;
        if width == 0 || height == 0 {
            return Ok(None);
        }
        let room = self.room(strip, LEAST_BY_NUMBER, "a strip of seven rows")?;
        let (needed, given) = ((width as usize).saturating_mul(LEAST_BY_NUMBER), self.depths.len());
        if given < needed {
            return Err(BufferError::Depth { needed: needed as u64, given });
        }
        // The third pass mixes a row with one beside it, the second pass both of them with rows beyond, and the first pass these with rows beyond them. From an
        // even row that takes two rows above and three below, from an odd row three above and two below.
        let beside = if (top_left.y as u32 | room) & 1 == 0 { 2 } else { 3 };
        let rows = room - 2 * beside; // at least 1
        let start = index.saturating_mul(rows); // at least `height` where it saturates
        if start >= height {
            return Ok(None);
        }
        let end = height.min(start.saturating_add(rows));
        (self.done, self.waits) = (0, false);
        let drawn = start.saturating_sub(beside)..height.min(end.saturating_add(beside));
        let top = top_left.y.saturating_add_unsigned(drawn.start);
        let sent = start - drawn.start..end - drawn.start;
        Ok(Some(self.band(top, [0, drawn.end - drawn.start], sent, strip)))
    }

    /// The number of rows that fit into a strip and have room for their depths.
    #[inline(always)]
    fn room(&self, strip: &[u8], least: usize, of: &'static str) -> Result<u32, BufferError> {
        let Size { width, .. } = self.area.size;
        let rows = |given: usize, row: usize| given.checked_div(row).unwrap_or(0);
        let (row, given) = (cell_bytes::<C>(width), strip.len());
        let fits = rows(given, row);
        if fits < least {
            return Err(BufferError::Strip { of, needed: row.saturating_mul(least), given });
        }
        Ok(u32::try_from(fits.min(rows(self.depths.len(), width as usize))).unwrap_or(u32::MAX))
    }

    /// A band of rows that waited and, from row `top` on, new ones, filled with the background.
    #[inline(always)]
    fn band<'s, 'b>(
        &'b mut self,
        top: i32,
        [before, rows]: [u32; 2],
        sent: Range<u32>,
        strip: &'s mut [u8],
    ) -> SmoothBand<'s, 'b, C> {
        let Rectangle { top_left: Point { x, .. }, size: Size { width, .. } } = self.area;
        let (row, columns, above) = (cell_bytes::<C>(width), width as usize, before as usize);
        let area_of = |top: i32, rows: u32| Rectangle::new(Point::new(x, top), Size::new(width, rows));
        let new = area_of(top, rows);
        let fresh = row.wrapping_mul(above)..row.wrapping_mul((before + rows) as usize);
        fill_all(strip.get_mut(fresh).unwrap_or_default(), self.background);
        let depths =
            self.depths.get_mut(..columns.wrapping_mul((before + rows) as usize)).unwrap_or_default();
        DepthBuffer::unchecked(new, depths.get_mut(columns.wrapping_mul(above)..).unwrap_or_default())
            .clear();
        let all = area_of(top - before as i32, before + rows);
        let (kept, waits) = (&mut *self.kept, self.waits);
        SmoothBand { all, new, sent, strip, depths, kept, waits, color: PhantomData }
    }
}

/// As many words as LLVM copies without a call: on Arm by three loads and three stores of several registers.
type Words = [u32; if cfg!(target_arch = "arm") { 16 } else { 8 }];

/// Copies as much as both have room for: many words at a time if both are aligned alike, which takes a tenth of the instructions on an M3.
#[inline(never)]
fn copy(to: &mut [u8], from: &[u8]) {
    let count = to.len().min(from.len());
    let (Some(to), Some(from)) = (to.get_mut(..count), from.get(..count)) else { return };
    let (from_start, from_words, from_end) = pod_align_to::<u8, Words>(from);
    if pod_align_to_mut::<u8, Words>(to).0.len() != from_start.len() {
        return copy_all(to, from);
    }
    let (start, words, end) = pod_align_to_mut::<u8, Words>(to);
    copy_all(start, from_start);
    copy_all(end, from_end);
    copy_words(words, from_words);
}

#[inline(never)] // LLVM knows of arguments that they do not overlap
fn copy_words(to: &mut [Words], from: &[Words]) {
    for (to, from) in to.iter_mut().zip(from) {
        keep_rolled(); // LLVM would call `memcpy`
        *to = *from;
    }
}

#[inline(never)]
fn copy_all(to: &mut [u8], from: &[u8]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

impl<'s, C: Color> SmoothBand<'s, '_, C> {
    /// The new rows and their depths, to draw faces into.
    #[inline(always)]
    pub fn new_rows<const N: usize>(&mut self) -> (Pixels<'_, C, [u8; N]>, DepthBuffer<'_>)
    where
        C: StoredPixel<[u8; N]>,
    {
        let before = (self.all.size.height - self.new.size.height) as usize; // 0 or 2
        let cells = self.strip.get_mut(before.wrapping_mul(cell_bytes::<C>(self.all.size.width))..);
        let depths = self.depths.get_mut(before.wrapping_mul(self.all.size.width as usize)..);
        let pixels = Pixels::unchecked(cells_of::<C, N>(cells.unwrap_or_default()), self.new);
        (pixels, DepthBuffer::unchecked(self.new, depths.unwrap_or_default()))
    }

    /// The rectangle of the new rows.
    pub const fn area(&self) -> Rectangle {
        self.new
    }

    /// Smooths edges, as [`smooth`](crate::target::DepthTestedSurface::smooth) does in a picture, and returns the rows that are finished: a band to draw
    /// text into, and to send.
    #[inline(always)]
    pub fn smooth<const N: usize>(self, edges: impl FnMut(&mut SmoothPass<'_, C, [u8; N]>)) -> Band<'s, C>
    where
        C: StoredPixel<[u8; N]>,
    {
        self.smooth_then(edges, |_, _| ())
    }

    /// [`smooth`](Self::smooth), and then draws what faces may hide and what is not smoothed itself, such as sprites, lines and translucent faces:
    /// `draw` gets the finished rows and their depths.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::Gray8;
    /// use pinhole::{bands::{Band, SmoothBand}, draw::SmoothEdges, prelude::*, sprite::PlacedSprites};
    /// fn finish<'s>(band: SmoothBand<'s, '_, Gray8>, edges: &mut SmoothEdges<'_>, flares: &PlacedSprites<'_>) -> Band<'s, Gray8> {
    ///     band.smooth_then(|pass| edges.draw(pass), |mut pixels, mut depth| {
    ///         let Ok(_) = flares.draw(|_| Sprite::square(Gray8::new(255), 3), &mut pixels.depth_tested(&mut depth));
    ///     })
    /// }
    /// ```
    #[inline(always)]
    pub fn smooth_then<const N: usize>(
        self,
        mut edges: impl FnMut(&mut SmoothPass<'_, C, [u8; N]>),
        draw: impl FnOnce(Pixels<'_, C, [u8; N]>, DepthBuffer<'_>),
    ) -> Band<'s, C>
    where
        C: StoredPixel<[u8; N]>,
    {
        let Self { all, new, sent, strip, depths, kept, waits, .. } = self;
        let Rectangle { top_left, size: Size { width, height } } = all;
        let (row, columns) = (cell_bytes::<C>(width), width as usize);
        let layout = PixelLayout::new(top_left.x, top_left.y, columns);
        let mixed = Rectangle::new(top_left, Size::new(width, if waits { sent.end } else { height }));
        for (number, rows) in [new, all, mixed].into_iter().enumerate() {
            let (cells, pixels) = (cells_of::<C, N>(strip), inside(&rows));
            edges(&mut SmoothPass {
                cells,
                layout,
                depths,
                depth_layout: layout,
                pixels,
                number,
                color: PhantomData,
            });
        }
        let (first, size) = (sent.start as usize, Size::new(width, sent.end - sent.start));
        let finished =
            Rectangle::new(Point::new(top_left.x, top_left.y.wrapping_add_unsigned(sent.start)), size);
        let cells = strip.get_mut(first.wrapping_mul(row)..).unwrap_or_default();
        let own = depths.get_mut(first.wrapping_mul(columns)..).unwrap_or_default();
        draw(Pixels::unchecked(cells_of::<C, N>(cells), finished), DepthBuffer::unchecked(finished, own));
        if waits {
            let last = sent.end as usize;
            copy(kept, strip.get(last.wrapping_mul(row)..).unwrap_or_default());
            for row in 0..WAITING {
                // One after the other: the first band may finish a single row.
                let split = depths.split_at_mut_checked((last + row).wrapping_mul(columns));
                let Some((to, from)) = split else { continue };
                let to = to.get_mut(row.wrapping_mul(columns)..).unwrap_or_default();
                copy(must_cast_slice_mut(to), must_cast_slice(from.get(..columns).unwrap_or_default()));
            }
        }
        let strip = strip.get_mut(first.wrapping_mul(row)..).unwrap_or_default();
        if !is_whole_bytes::<C>() {
            pack::<C, N>(strip, columns, size.height as usize);
        }
        Band::unchecked(finished, strip)
    }
}

/// The pixels of a strip.
#[inline(always)]
fn cells_of<C: Color, const N: usize>(strip: &mut [u8]) -> &mut [[u8; N]] {
    const {
        assert!(
            C::FORMAT.bits().div_ceil(8) as usize == N,
            "a pixel is not as many bytes as the color's `Raw` type"
        )
    };
    strip.as_chunks_mut().0
}

defmt_format!([C] SmoothFrame<'_, C>, self, "smooth frame of {} at {}", self.area.size, self.area.top_left);
defmt_format!([C] SmoothBand<'_, '_, C>, self, "smooth band of {} at {}", self.all.size, self.all.top_left);
