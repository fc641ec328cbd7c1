//! A frame drawn in bands whose edges are smoothed: each band waits for the row below it.

use super::band::{Band, Frame};
use super::pixels::Pixels;
use super::row::row_bytes;
use super::smoothing::SmoothPass;
use super::{inside, BufferError, DepthBuffer};
use crate::color::{Color, StoredPixel};
use crate::raster::PixelLayout;
use core::marker::PhantomData;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// A [`Frame`] whose edges are smoothed. To smooth a band's last row takes the row below, which the next band draws: so a band is finished but
/// for its last row, which is kept for the next one, with its depths and the row above it.
///
/// ```
/// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
/// # use pinhole::{bands::SmoothFrame, mesh::edge_faces, prelude::*, strip_buffers, Angle};
/// # const VERTICES: [[i16; 3]; 4] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
/// # const FACES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
/// # const EDGES: [[u16; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
/// # const BESIDE: [[u16; 2]; 6] = edge_faces(&EDGES, &FACES);
/// # let mesh = Mesh::new(&VERTICES, 0, &FACES)?.with_edges(&EDGES)?.with_edge_faces(&BESIDE)?;
/// # let mut display = MockDisplay::<Gray8>::new();
/// # let viewport = Viewport::new(Point::zero(), display.size())?;
/// # let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::degrees(20))?;
/// # let instance = camera.place(&mesh, &Affine::identity());
/// let mut strip = strip_buffers!(Gray8, 64, 9); // 8 rows, and the one that waits
/// let mut kept = strip_buffers!(Gray8, 64, 2);
/// # let (mut cache, mut bins, mut edge_bins) = ([ScreenVertex::EMPTY; 4], [0; 7], [0; 16]);
/// let mesh = instance.transform_depth(&mut cache);
/// let mut faces = mesh.bin_faces(&mut bins)?;
/// let mut edges = mesh.bin_smooth_edges(|_| false, &mut edge_bins)?;
/// let mut frame = SmoothFrame::new(display.bounding_box(), Gray8::BLACK, &mut kept.colors, &mut kept.depths)?;
/// let mut heights = Vec::new();
/// while let Some(mut band) = frame.next_band(&mut strip.colors, &mut strip.depths)? {
///     let (mut pixels, mut depth) = band.new_rows();
///     faces.draw(|_| Gray8::WHITE, &mut pixels.depth_tested(&mut depth))?;
///     let band = band.smooth(|pass| edges.draw(pass)); // a `Band` of the rows that are finished
///     heights.push(band.area().size.height);
///     band.send(&mut display)?;
/// }
/// assert_eq!(heights, [7, 8, 8, 8, 8, 8, 8, 9]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SmoothFrame<'k, C> {
    area: Rectangle,
    background: C,
    /// The number of rows drawn so far.
    done: u32,
    /// Whether the last row of the band before waits. Then these are the row above it, which is finished, and this row, with their depths.
    waits: bool,
    kept: Kept<'k>,
}

/// Two rows.
#[derive(Debug)]
struct Kept<'k> {
    colors: &'k mut [u8],
    depths: &'k mut [u16],
}

/// A band of a [`SmoothFrame`]: the row that waited, and new rows.
#[derive(Debug)]
pub struct SmoothBand<'s, 'k, C> {
    /// All rows, and the new ones.
    all: Rectangle,
    new: Rectangle,
    /// The pixels and depths of all rows.
    strip: &'s mut [u8],
    depths: &'k mut [u16],
    kept: Kept<'k>,
    /// Whether the last row waits for the next band.
    waits: bool,
    color: PhantomData<C>,
}

impl<'k, C: Color> SmoothFrame<'k, C> {
    /// The frame for the pixels of `area`. `kept` and `kept_depths` hold two rows between bands: they have the lengths of
    /// [`strip_buffers!`](crate::strip_buffers) for two rows.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when one of them has no room for two rows.
    pub fn new(
        area: Rectangle,
        background: C,
        kept: &'k mut [u8],
        kept_depths: &'k mut [u16],
    ) -> Result<Self, BufferError> {
        let needed = row_bytes::<C>(area.size.width).saturating_mul(2);
        let error = BufferError::Strip { needed, given: kept.len() };
        let colors = kept.get_mut(..needed).ok_or(error)?;
        let (needed, given) = ((area.size.width as usize).saturating_mul(2), kept_depths.len());
        let error = BufferError::Depth { needed: needed as u64, given };
        let depths = kept_depths.get_mut(..needed).ok_or(error)?;
        Ok(Self { area, background, done: 0, waits: false, kept: Kept { colors, depths } })
    }

    /// The rectangle of the frame, in the coordinates of the display.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// The next band: the row that waited, and new rows, filled with the background. It has as many rows as fit in the strip and have room
    /// for their depths, or one less: the row that waits has an odd number. `None` after the last band.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when there is no room for three rows.
    pub fn next_band<'s, 'b>(
        &'b mut self,
        strip: &'s mut [u8],
        depths: &'b mut [u16],
    ) -> Result<Option<SmoothBand<'s, 'b, C>>, BufferError> {
        let Rectangle { top_left, size: Size { width, height } } = self.area;
        let left = height.saturating_sub(self.done);
        if left == 0 || width == 0 {
            return Ok(None);
        }
        let (row, columns) = (row_bytes::<C>(width), width as usize);
        let rows = |given: usize, row: usize| given.checked_div(row).unwrap_or(0);
        let waiting = u32::from(self.waits);
        let room = u32::try_from(rows(strip.len(), row).min(rows(depths.len(), columns))).unwrap_or(u32::MAX);
        let mut new = room.saturating_sub(waiting).min(left);
        let top = top_left.y.saturating_add_unsigned(self.done);
        let waits = new < left;
        if waits {
            new -= top.saturating_add_unsigned(new) as u32 & 1 & u32::from(new > 0);
            if room < 3 {
                let depths_needed = columns.saturating_mul(3);
                return Err(if depths.len() < depths_needed {
                    BufferError::Depth { needed: depths_needed as u64, given: depths.len() }
                } else {
                    BufferError::Strip { needed: row.saturating_mul(3), given: strip.len() }
                });
            }
        }
        let kept = Kept { colors: self.kept.colors, depths: self.kept.depths };
        if self.waits {
            copy(strip, kept.colors.get(row..).unwrap_or_default());
            copy(depths, kept.depths.get(columns..).unwrap_or_default());
        }
        let area_of =
            |top: i32, rows: u32| Rectangle::new(Point::new(top_left.x, top), Size::new(width, rows));
        let new_area = area_of(top, new);
        let before = waiting as usize;
        let fresh = strip.get_mut(row.wrapping_mul(before)..).unwrap_or_default();
        Frame::new(new_area, self.background).next_band(fresh)?;
        let depths = depths.get_mut(..columns.wrapping_mul((waiting + new) as usize)).unwrap_or_default();
        DepthBuffer::new(new_area, depths.get_mut(columns.wrapping_mul(before)..).unwrap_or_default())?;
        self.done += new; // at most `height`
        self.waits = waits;
        let all = area_of(top - waiting as i32, waiting + new);
        Ok(Some(SmoothBand { all, new: new_area, strip, depths, kept, waits, color: PhantomData }))
    }
}

/// Copies as much as both have room for.
#[inline(never)]
fn copy<T: Copy>(to: &mut [T], from: &[T]) {
    let count = to.len().min(from.len());
    if let (Some(to), Some(from)) = (to.get_mut(..count), from.get(..count)) {
        to.copy_from_slice(from);
    }
}

impl<'s, C: Color> SmoothBand<'s, '_, C> {
    /// The new rows and their depths, to draw faces into.
    #[inline(always)]
    pub fn new_rows<const N: usize>(&mut self) -> (Pixels<'_, C, [u8; N]>, DepthBuffer<'_>)
    where
        C: StoredPixel<[u8; N]>,
    {
        let before = (self.all.size.height - self.new.size.height) as usize; // 0 or 1
        let cells = self.strip.get_mut(before.wrapping_mul(row_bytes::<C>(self.all.size.width))..);
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
    pub fn smooth<const N: usize>(self, mut edges: impl FnMut(&mut SmoothPass<'_, C, [u8; N]>)) -> Band<'s, C>
    where
        C: StoredPixel<[u8; N]>,
    {
        let Self { all, new, strip, depths, kept, waits, .. } = self;
        let Rectangle { top_left, size: Size { width, height } } = all;
        let (row, columns) = (row_bytes::<C>(width), width as usize);
        let layout = PixelLayout::new(top_left.x, top_left.y, columns);
        let pixels = inside(&all);
        // Without a row that waited, nothing lies above.
        let has_above = height > new.size.height;
        let above: (&[[u8; N]], &[u16]) = match (kept.colors.get(..row), kept.depths.get(..columns)) {
            (Some(colors), Some(depths)) if has_above => (colors.as_chunks().0, depths),
            _ => (&[], &[]),
        };
        let end = pixels.bottom - i32::from(waits);
        for (odd, rows) in [(0, new.top_left.y..pixels.bottom), (1, pixels.top..end)] {
            edges(&mut SmoothPass {
                cells: cells_of::<C, N>(strip),
                layout,
                depths,
                depth_layout: layout,
                pixels,
                above,
                rows,
                odd,
                color: PhantomData,
            });
        }
        let finished = height - u32::from(waits);
        if waits {
            // The last two rows: a band that waits has at least two.
            let first = (height as usize).wrapping_sub(2);
            copy(kept.colors, strip.get(first.wrapping_mul(row)..).unwrap_or_default());
            copy(kept.depths, depths.get(first.wrapping_mul(columns)..).unwrap_or_default());
        }
        Band::unchecked(Rectangle::new(top_left, Size::new(width, finished)), strip)
    }
}

/// The pixels of a strip.
#[inline(always)]
fn cells_of<C: Color, const N: usize>(strip: &mut [u8]) -> &mut [[u8; N]] {
    const { assert!(C::FORMAT.bits() as usize == 8 * N, "a pixel is not as many bytes as one in memory") };
    strip.as_chunks_mut().0
}

defmt_format!([C] SmoothFrame<'_, C>, self, "smooth frame of {} at {}", self.area.size, self.area.top_left);
defmt_format!([C] SmoothBand<'_, '_, C>, self, "smooth band of {} at {}", self.all.size, self.all.top_left);
