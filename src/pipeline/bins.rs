//! Primitives of a mesh (faces or edges), binned by their first rows.
//!
//! One list holds the indices of the primitives, sorted into bins of rows by a counting sort (Knuth, *The Art of Computer
//! Programming*, vol. 3, 2nd ed., section 5.2), which visits each primitive twice. As in an active-edge table, a band activates
//! the bins that begin above its end: it sets a bit for each of their primitives. The bit stays set until the primitive ends.
//! Bits are visited in ascending order, so primitives are drawn in the order of the mesh, whatever the bands.

use crate::math::hints::keep_rolled;
use crate::raster::Scissor;
use crate::surface::BufferError;
use core::ops::Range;

/// The number of bins. With 240 rows, each bin has four.
const BINS: usize = 64;

/// The visible primitives of a mesh, sorted for bands, in memory that the caller provides.
#[derive(Debug)]
pub(super) struct Bins<'s> {
    /// Indices of primitives, bin after bin: [forks](Self::fork) share them. Empty before the sort.
    order: &'s [u16],
    /// A bit for each primitive of the mesh: set if the primitive is active, that is, it has begun and not ended. During the
    /// sort: set if the primitive is visible, and behind these bits lies the storage of `order`.
    active: &'s mut [u16],
    /// The first row of the first bin.
    top: i32,
    /// A bin has 2^shift rows.
    shift: u32,
    /// Where the next band continues.
    pub(super) cursor: Cursor,
    /// The bounding box of the visible primitives inside the viewport. Before the sort: the viewport.
    bounds: Scissor,
}

/// Up to where primitives are activated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor {
    /// How many entries of `order` were activated. During the sort: how many primitives are visible.
    activated: usize,
    /// The bin of the first primitive that was not activated, or a lower bound for it.
    next: usize,
    /// The end of the last band.
    row: i32,
}

/// The sort that fills [`Bins`]: primitives are counted, and then distributed.
pub(super) struct BinSort<'b, 's> {
    bins: &'b mut Bins<'s>,
    /// A primitive that does not meet the viewport is dropped.
    viewport: Scissor,
    /// The number of primitives in each bin; then the index in `order` of the bin's next primitive. Not a field of [`Bins`],
    /// which stays on the stack while bands are drawn.
    ends: [u16; BINS],
}

/// The primitives that were counted in a part of the mesh: their sum is that of the mesh.
#[derive(Debug)]
pub(super) struct Counts {
    visible: usize,
    bounds: Scissor,
    bins: [u16; BINS],
}

impl Counts {
    pub(super) const NONE: Self = Self { visible: 0, bounds: Scissor::UNION_IDENTITY, bins: [0; BINS] };
}

impl<'s> Bins<'s> {
    /// Empty bins for `items` primitives that may be drawn in a viewport.
    #[inline(never)] // once per frame, like most of this file: code size matters more than speed
    pub(super) fn new(storage: &'s mut [u16], items: usize, viewport: Scissor) -> Self {
        // `make_room` reports storage that is too short even for the bits.
        let words = items.div_ceil(16).min(storage.len());
        storage.get_mut(..words).unwrap_or_default().fill(0);
        Self::over(storage, viewport)
    }

    /// Bins over storage whose bits are set, or zero.
    #[inline(always)]
    pub(super) fn over(storage: &'s mut [u16], viewport: Scissor) -> Self {
        let rows = viewport.rows();
        let height = rows.end.saturating_sub(rows.start).max(1).unsigned_abs();
        let shift = (26 - (height - 1).leading_zeros().min(26)) % 32; // (height − 1) >> shift < 64
        Self {
            order: &[],
            active: storage,
            top: rows.start,
            shift,
            cursor: Cursor { activated: 0, next: 0, row: i32::MIN },
            bounds: viewport,
        }
    }

    /// Begins the sort: [add](BinSort::add) each primitive in the order of the mesh, then [finish](BinSort::finish) the sort.
    #[inline(always)]
    pub(super) fn sort(&mut self) -> BinSort<'_, 's> {
        let viewport = core::mem::replace(&mut self.bounds, Scissor::UNION_IDENTITY);
        BinSort { bins: self, viewport, ends: [0; BINS] }
    }

    /// The sort of primitives that were counted in two parts, whose bits are set: [finish](BinSort::finish) it.
    pub(super) fn sort_counted(&mut self, parts: [&Counts; 2]) -> BinSort<'_, 's> {
        let mut sort = self.sort();
        for counts in parts {
            sort.bins.cursor.activated += counts.visible; // at most all items
            sort.bins.bounds = sort.bins.bounds.union(&counts.bounds);
            for (end, count) in sort.ends.iter_mut().zip(&counts.bins) {
                keep_rolled();
                *end = end.wrapping_add(*count); // at most all items
            }
        }
        sort
    }

    /// Two cursors over these bins, each for bands of its own: they share the list of primitives, and `cursor` holds the second
    /// one's bits. The first one uses the bits of these bins, which begin again at their next band.
    ///
    /// # Errors
    ///
    /// [`BufferError::Bins`] if `cursor` has fewer numbers than the bits take.
    pub(super) fn fork<'b>(&'b mut self, cursor: &'b mut [u16]) -> Result<[Bins<'b>; 2], BufferError> {
        let (needed, given) = (self.active.len(), cursor.len());
        let second = cursor.get_mut(..needed).ok_or(BufferError::Bins { needed, given })?;
        // Every band begins above this row, so the first band of each of the two cursors, and of these bins after them, clears its bits.
        self.cursor.row = i32::MAX;
        let Bins { order, top, shift, cursor, bounds, .. } = *self;
        let active = [&mut *self.active, second];
        Ok(active.map(|active| Bins { order, active, top, shift, cursor, bounds }))
    }

    /// A copy of the bins for one band, which borrows their active bits. Its cursor after the band must be copied back.
    pub(super) fn reborrowed(&mut self) -> Bins<'_> {
        Bins { active: self.active, ..*self }
    }

    /// The bounding box of the visible primitives inside the viewport.
    pub(super) fn bounds(&self) -> Scissor {
        self.bounds
    }

    fn bin(&self, row: i32) -> usize {
        (row.saturating_sub(self.top).max(0) >> self.shift).min(BINS as i32 - 1) as usize
    }

    /// A bit for each primitive of the mesh: set if the primitive may lie in the band of the last
    /// [`advance_to_band`](Self::advance_to_band).
    pub(super) fn active(&mut self) -> &mut [u16] {
        self.active
    }

    /// Begins again at the next band, unless the last one ended at this row: it was drawn with the same rows beyond.
    pub(super) fn continue_at(&mut self, row: i32) {
        if self.cursor.row != row {
            self.cursor.row = i32::MAX;
        }
    }

    /// Activates the primitives that begin in a band or above it. `first_row` returns the row by which a primitive was sorted.
    #[inline(always)]
    pub(super) fn advance_to_band(&mut self, rows: &Range<i32>, first_row: impl Fn(usize) -> i32) {
        if rows.is_empty() {
            return;
        }
        if rows.start < self.cursor.row {
            // This band does not follow the last one: start again at the top.
            self.active.fill(0);
            (self.cursor.activated, self.cursor.next) = (0, 0);
        }
        self.cursor.row = rows.end;
        if rows.end <= self.top {
            return;
        }
        let last = self.bin(rows.end - 1);
        if last < self.cursor.next {
            return;
        }
        // Bisection finds the end of these bins: storing the ends would take 128 bytes.
        let (begun, mut behind) = (self.cursor.activated, self.order.len());
        self.cursor.next = BINS;
        while self.cursor.activated < behind {
            let middle = (self.cursor.activated + behind) / 2; // at most 65535 each
            let bin = self.order.get(middle).map_or(BINS, |&item| self.bin(first_row(item.into())));
            if bin <= last {
                self.cursor.activated = middle + 1;
            } else {
                (behind, self.cursor.next) = (middle, bin);
            }
        }
        for &item in self.order.get(begun..self.cursor.activated).unwrap_or_default() {
            keep_rolled();
            if let Some(bits) = self.active.get_mut(usize::from(item / 16)) {
                *bits |= 1 << (item % 16);
            }
        }
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

impl<'s> BinSort<'_, 's> {
    /// The primitives counted so far, in place of a sort.
    pub(super) fn into_counts(self) -> Counts {
        Counts { visible: self.bins.cursor.activated, bounds: self.bins.bounds, bins: self.ends }
    }

    /// Counts a primitive with this bounding box if it meets the viewport.
    #[inline(never)] // code size matters more than speed: once per visible primitive
    pub(super) fn add(&mut self, item: usize, bounds: &Scissor) {
        let (rows, columns) = (bounds.rows(), bounds.columns());
        let (all_rows, all_columns) = (self.viewport.rows(), self.viewport.columns());
        let meets = |own: &Range<i32>, all: &Range<i32>| own.start < all.end && own.end > all.start;
        if bounds.is_empty() || !(meets(&rows, &all_rows) && meets(&columns, &all_columns)) {
            return;
        }
        self.bins.bounds = self.bins.bounds.union(bounds);
        self.bins.cursor.activated += 1; // at most all items
        if let Some(bits) = self.bins.active.get_mut(item / 16) {
            *bits |= 1 << (item % 16);
        }
        let bin = self.bins.bin(bounds.rows().start);
        if let Some(count) = self.ends.get_mut(bin) {
            *count = count.wrapping_add(1); // at most all items
        }
    }

    /// Distributes the counted primitives to their bins by their first rows. `items`: the number of primitives in the mesh.
    ///
    /// # Errors
    ///
    /// [`BufferError`] if the storage is too short or there are too many primitives.
    #[inline(always)]
    pub(super) fn finish(
        &mut self,
        items: usize,
        first_row: impl FnMut(usize) -> i32,
    ) -> Result<(), BufferError> {
        let order = self.make_room(items)?;
        self.distribute(order, first_row);
        Ok(())
    }

    /// Checks the storage, turns counts into the indices at which bins begin, and returns the storage of the list.
    #[inline(never)]
    fn make_room(&mut self, items: usize) -> Result<&'s mut [u16], BufferError> {
        if items > usize::from(u16::MAX) {
            return Err(BufferError::TooManyItems { items });
        }
        let Bins { active, cursor: Cursor { activated, .. }, .. } = &mut *self.bins;
        let words = items.div_ceil(16);
        let (needed, given) = (*activated + words, active.len());
        if given < needed {
            return Err(BufferError::Bins { needed, given });
        }
        let (bits, order) = core::mem::take(active).split_at_mut_checked(words).unwrap_or_default();
        *active = bits;
        let mut sum = 0u16;
        for end in &mut self.ends {
            keep_rolled();
            let count = core::mem::replace(end, sum);
            sum = sum.wrapping_add(count); // all counted primitives, in the end
        }
        Ok(order.get_mut(..*activated).unwrap_or_default())
    }

    /// Writes the index of each counted primitive to `order`, into its bin.
    #[inline(always)]
    fn distribute(&mut self, order: &'s mut [u16], mut first_row: impl FnMut(usize) -> i32) {
        for word in 0..self.bins.active.len() {
            let mut remaining = self.bins.active.get_mut(word).map_or(0, core::mem::take);
            while remaining != 0 {
                let item = word * 16 + remaining.trailing_zeros() as usize;
                remaining &= remaining.wrapping_sub(1);
                let bin = self.bins.bin(first_row(item));
                if let Some(end) = self.ends.get_mut(bin) {
                    if let Some(entry) = order.get_mut(usize::from(*end)) {
                        *entry = item as u16; // fewer than 65536
                    }
                    *end = end.wrapping_add(1); // at most all items
                }
            }
        }
        self.bins.order = order;
        self.bins.cursor.activated = 0;
        // Each primitive meets the viewport, but may extend beyond it.
        self.bins.bounds = self.bins.bounds.clipped_to(&self.viewport);
    }
}
