//! Primitives of a mesh (faces or edges), binned by their first rows.
//!
//! The primitives of a bin are linked, as the edges of a scan line are in an edge table (Foley, van Dam, Feiner, Hughes, *Computer
//! Graphics: Principles and Practice*, 2nd ed., section 3.6.3): one pass over the mesh fills all bins. As in an active-edge table, a band
//! activates the bins that begin above its end: it sets a bit for each of their primitives. The bit stays set until the primitive ends.
//! Bits are visited in ascending order, so primitives are drawn in the order of the mesh, whatever the bands.

use crate::math::hints::keep_rolled;
use crate::raster::Scissor;
use crate::scene::{bin_count, bins_len, MOST_BINS};
use crate::surface::BufferError;
use core::ops::Range;

/// The number of no primitive: a mesh has at most 65535, whose numbers are smaller.
pub(super) const NONE: u16 = u16::MAX;

/// The visible primitives of a mesh in bins of rows, in memory that the caller provides.
#[derive(Debug)]
pub(super) struct Bins<'s> {
    /// The first primitive of each bin, and for each primitive of the mesh the next one in its bin: [forks](Self::fork) share them.
    first: &'s [u16],
    next: &'s [u16],
    /// A bit for each primitive of the mesh: set if the primitive is active, that is, it has begun and not ended.
    active: &'s mut [u16],
    rows: BinRows,
    /// Where the next band continues.
    pub(super) cursor: Cursor,
    /// The bounding box of the visible primitives inside the viewport.
    bounds: Scissor,
}

/// Up to where primitives are activated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor {
    /// The first bin that is not activated.
    bin: usize,
    /// The end of the last band; [marked](Self::MARK) if primitives reached beyond their rows.
    row: i32,
}

impl Cursor {
    /// The next band begins above its row, and so at the top of the bins.
    const TOP: Self = Self { bin: 0, row: i32::MAX };

    /// Added to a row for each row that primitives reach beyond their own: more than any row, so that a band whose primitives do not
    /// reach beyond their rows begins again.
    const MARK: i32 = 1 << 16;
}

/// The rows of bins.
#[derive(Clone, Copy, Debug)]
pub(super) struct BinRows {
    /// The first row of the first bin.
    top: i32,
    /// A bin has 2^shift rows.
    shift: u32,
}

impl BinRows {
    /// The rows of `bins` bins, a power of two, in a viewport.
    fn new(viewport: &Scissor, bins: usize) -> Self {
        let height = viewport.bottom.saturating_sub(viewport.top).max(1).unsigned_abs();
        let bits = 32 - (height - 1).leading_zeros(); // (height − 1) >> shift < bins
        Self { top: viewport.top, shift: bits.saturating_sub(bins.trailing_zeros()) % 32 }
    }

    pub(super) fn bin(&self, row: i32) -> usize {
        (row.saturating_sub(self.top).max(0) >> self.shift) as usize
    }
}

/// Bin storage in its parts, before the bins are filled.
#[derive(Debug, Default)]
pub(super) struct BinStorage<'s> {
    active: &'s mut [u16],
    first: &'s mut [u16],
    pub(super) next: &'s mut [u16],
}

/// Bins that are filled: [add](Self::add) each visible primitive.
#[derive(Debug)]
pub(super) struct BinFill<'s> {
    storage: BinStorage<'s>,
    /// The primitive whose link is the first of the storage.
    base: usize,
    rows: BinRows,
    viewport: Scissor,
    /// The bounding box of the primitives added so far, inside the viewport.
    pub(super) bounds: Scissor,
}

/// A part of the primitives, linked by one of two cores.
#[derive(Debug)]
pub(super) struct BinPart {
    first: [u16; MOST_BINS],
    /// The bounding box of the primitives of this part.
    pub(super) bounds: Scissor,
}

impl<'s> BinStorage<'s> {
    /// Storage for `items` primitives, with `bits` bits for each.
    ///
    /// # Errors
    ///
    /// [`BufferError`] if the storage is too short or there are too many primitives.
    #[inline(never)] // once per frame, like most of this file: code size counts
    pub(super) fn new(storage: &'s mut [u16], items: usize, bits: usize) -> Result<Self, BufferError> {
        if items > usize::from(NONE) {
            return Err(BufferError::TooManyItems { items });
        }
        let words = items.div_ceil(16);
        let (needed, given) = (bins_len(items) + (bits - 1) * words, storage.len());
        let all = storage.get_mut(..needed);
        let Some((active, links)) = all.and_then(|all| all.split_at_mut_checked(bits * words)) else {
            return Err(BufferError::Bins { needed, given });
        };
        let (first, next) = links.split_at_mut_checked(bin_count(items)).unwrap_or_default();
        Ok(Self { active, first, next })
    }

    /// The bits of primitives, for lists that need none of active ones.
    pub(super) fn take_bits(&mut self) -> &'s mut [u16] {
        core::mem::take(&mut self.active)
    }

    /// Begins to fill bins for a viewport.
    pub(super) fn fill(self, viewport: Scissor) -> BinFill<'s> {
        BinFill::new(self, 0, viewport)
    }

    /// Filled bins. `bounds`: those of all primitives that were added.
    #[inline(always)]
    fn bins(self, viewport: &Scissor, bounds: &Scissor) -> Bins<'s> {
        let Self { active, first, next } = self;
        let rows = BinRows::new(viewport, first.len());
        // Without a primitive they are no box yet.
        Bins { first, next, active, rows, cursor: Cursor::TOP, bounds: bounds.clipped_to(viewport) }
    }

    /// Bins that were filled in two parts.
    pub(super) fn joined(self, viewport: &Scissor, [front, back]: [&BinPart; 2]) -> Bins<'s> {
        for ((first, &front), &back) in self.first.iter_mut().zip(&front.first).zip(&back.first) {
            // As if one pass had linked all: the last face of the mesh first.
            let mut last = back;
            while let Some(&next) = self.next.get(usize::from(last)).filter(|next| **next != NONE) {
                keep_rolled();
                last = next;
            }
            *first = if back == NONE { front } else { back };
            if let Some(next) = self.next.get_mut(usize::from(last)) {
                *next = front;
            }
        }
        self.bins(viewport, &front.bounds.union(&back.bounds))
    }
}

impl BinPart {
    pub(super) const EMPTY: Self = Self { first: [NONE; MOST_BINS], bounds: Scissor::UNION_IDENTITY };

    /// Begins to fill the bins of a part of `items` primitives with those from `base` on, whose links are `next`.
    pub(super) fn fill<'b>(
        &'b mut self,
        next: &'b mut [u16],
        base: usize,
        items: usize,
        viewport: Scissor,
    ) -> BinFill<'b> {
        let first = self.first.get_mut(..bin_count(items)).unwrap_or_default(); // at most `MOST_BINS`
        BinFill::new(BinStorage { active: &mut [], first, next }, base, viewport)
    }
}

impl<'s> BinFill<'s> {
    #[inline(never)] // once per frame, like most of this file: code size counts
    fn new(storage: BinStorage<'s>, base: usize, viewport: Scissor) -> Self {
        storage.first.fill(NONE);
        let rows = BinRows::new(&viewport, storage.first.len());
        Self { storage, base, rows, viewport, bounds: Scissor::UNION_IDENTITY }
    }

    /// The filled bins.
    #[inline(always)]
    pub(super) fn bins(self) -> Bins<'s> {
        self.storage.bins(&self.viewport, &self.bounds)
    }

    /// The first primitive of each bin, the next one of each primitive, and the rows of the bins.
    #[inline(always)]
    pub(super) fn links(self) -> (&'s mut [u16], &'s mut [u16], BinRows) {
        let Self { storage: BinStorage { first, next, .. }, rows, .. } = self;
        (first, next, rows)
    }

    /// Links a primitive with this bounding box, and returns `true`, if it meets the viewport. `item` counts from the first primitive of this part.
    #[inline(always)]
    pub(super) fn add(&mut self, item: usize, bounds: &Scissor) -> bool {
        // A box inside of those before it meets the viewport, as they do: one test for most primitives.
        if bounds.is_empty() || !(self.bounds.contains(bounds) || self.extend(bounds)) {
            return false;
        }
        let BinStorage { first, next, .. } = &mut self.storage;
        let first = first.get_mut(self.rows.bin(bounds.top));
        if let (Some(first), Some(next)) = (first, next.get_mut(item)) {
            *next = core::mem::replace(first, (self.base + item) as u16); // fewer than 65535
        }
        true
    }
}

impl BinFill<'_> {
    /// Extends the bounding box by the part of a box inside the viewport, if there is one.
    #[inline(never)]
    fn extend(&mut self, bounds: &Scissor) -> bool {
        let meets = bounds.meets(&self.viewport);
        if meets {
            self.bounds = self.bounds.union(&bounds.clipped_to(&self.viewport));
        }
        meets
    }
}

impl Bins<'_> {
    /// Two cursors over these bins, each for bands of its own: they share the links, and `cursor` holds the second one's bits. The first one
    /// uses the bits of these bins, which begin again at their next band.
    ///
    /// # Errors
    ///
    /// [`BufferError::Bins`] if `cursor` has fewer numbers than the bits take.
    pub(super) fn fork<'b>(&'b mut self, cursor: &'b mut [u16]) -> Result<[Bins<'b>; 2], BufferError> {
        let (needed, given) = (self.active.len(), cursor.len());
        let second = cursor.get_mut(..needed).ok_or(BufferError::Bins { needed, given })?;
        self.restart();
        let Bins { first, next, rows, cursor, bounds, .. } = *self;
        let active = [&mut *self.active, second];
        Ok(active.map(|active| Bins { first, next, active, rows, cursor, bounds }))
    }

    /// A copy of the bins for one band, which borrows their active bits. Its cursor after the band must be copied back.
    pub(super) fn reborrowed(&mut self) -> Bins<'_> {
        Bins { active: self.active, ..*self }
    }

    /// The bounding box of the visible primitives inside the viewport.
    pub(super) fn bounds(&self) -> Scissor {
        self.bounds
    }

    /// A bit for each primitive of the mesh: set if the primitive may lie in the band of the last
    /// [`advance_to_band`](Self::advance_to_band).
    pub(super) fn active(&mut self) -> &mut [u16] {
        self.active
    }

    /// Begins again at the next band.
    pub(super) fn restart(&mut self) {
        self.cursor = Cursor::TOP;
    }

    /// [`advance_to_band`](Self::advance_to_band) for primitives that reach `BEYOND` rows, at least one, beyond their own. Begins again unless
    /// the last band ended where this one begins and had as many rows beyond: other primitives end earlier.
    #[inline(always)]
    pub(super) fn advance_beyond<const BEYOND: i32>(&mut self, rows: &Range<i32>) {
        if rows.is_empty() {
            return;
        }
        let marked = |row: i32| row + BEYOND * Cursor::MARK; // inside the guard band before
        self.cursor.row = if self.cursor.row == marked(rows.start) { rows.start + BEYOND } else { i32::MAX };
        self.advance_to_band(&(rows.start + BEYOND..rows.end + BEYOND));
        self.cursor.row = marked(rows.end);
    }

    /// Activates the primitives that begin in a band or above it.
    #[inline(never)] // one copy for all draw calls
    pub(super) fn advance_to_band(&mut self, rows: &Range<i32>) {
        if rows.is_empty() {
            return;
        }
        if rows.start < self.cursor.row {
            // This band does not follow the last one: start again at the top.
            self.active.fill(0);
            self.cursor = Cursor::TOP;
        }
        self.cursor.row = rows.end;
        if rows.end <= self.rows.top {
            return;
        }
        let end = (self.rows.bin(rows.end - 1) + 1).min(self.first.len());
        for &first in self.first.get(self.cursor.bin..end).unwrap_or_default() {
            let mut item = first;
            // `NONE` has no next one.
            while let Some(&next) = self.next.get(usize::from(item)) {
                keep_rolled();
                if let Some(bits) = self.active.get_mut(usize::from(item / 16)) {
                    *bits |= 1 << (item % 16);
                }
                item = next;
            }
        }
        self.cursor.bin = self.cursor.bin.max(end);
    }
}

/// Calls `draw` with the index of each primitive whose bit is set, in the order of the mesh. `draw` returns whether the primitive ends in or
/// above the band: then it is no longer active.
///
/// # Errors
///
/// The first error of `draw`.
#[inline(always)]
pub(super) fn each_active<E>(
    active: &mut [u16],
    mut draw: impl FnMut(usize) -> Result<bool, E>,
) -> Result<(), E> {
    let mut words = active.iter_mut().enumerate();
    // A loop of its own skips words without an active primitive: most words of a band.
    let is_active = |(_, bits): &(usize, &mut u16)| {
        keep_rolled();
        **bits != 0
    };
    while let Some((word, bits)) = words.find(is_active) {
        let mut remaining = u32::from(*bits);
        while remaining != 0 {
            let lowest = remaining & remaining.wrapping_neg();
            remaining ^= lowest;
            if draw(word * 16 + lowest.trailing_zeros() as usize)? {
                *bits ^= lowest as u16; // one of 16 bits
            }
        }
    }
    Ok(())
}
