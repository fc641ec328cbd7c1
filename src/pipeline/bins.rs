//! Primitives of a mesh, faces or edges, binned by the rows in which they begin.
//!
//! The indices of the primitives stand in one list, sorted into bins of rows by counting (Knuth, *The Art of Computer
//! Programming*, vol. 3, 2nd ed., section 5.2): each primitive is looked at twice. A band takes in the bins that begin
//! above its end and sets a bit for each of their primitives. The bit stays until the primitive has ended, and bits are
//! visited in rising order: so whatever the bands, primitives are drawn in the order of the mesh.

use crate::raster::Scissor;
use core::hint::black_box;
use core::ops::Range;

/// The number of bins: with 240 rows, a bin has four rows.
const BINS: usize = 64;

/// The visible primitives of a mesh, sorted for bands, in memory that the caller provides.
#[derive(Debug)]
pub(super) struct Bins<'s> {
    /// Indices of primitives, bin after bin.
    order: &'s mut [u16],
    /// A bit for each primitive of the mesh: taken in, and not ended. During the sort: to be sorted.
    open: &'s mut [u16],
    /// The first row of the first bin.
    top: i32,
    /// A bin has 2^shift rows.
    shift: u32,
    /// How many of `order` were taken in. During the sort: how many primitives are visible.
    taken: usize,
    /// The bin of the first primitive that was not taken in, or a lower bound for it.
    next: usize,
    /// Where the last band ended.
    row: i32,
    /// The bounding box of the visible primitives inside the viewport. Before the sort: the viewport.
    bounds: Scissor,
}

/// The sort that fills [`Bins`]: primitives are counted, and then distributed.
pub(super) struct BinSort<'b, 's> {
    bins: &'b mut Bins<'s>,
    /// A primitive that does not meet the viewport is dropped.
    viewport: Scissor,
    /// The number of primitives in each bin; then the position of the bin's next one. Not part of [`Bins`], which stay on
    /// the stack while bands are drawn.
    ends: [u16; BINS],
}

/// Why faces or edges were not binned: none of them was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum BinError {
    /// The storage is too short: provide as many numbers as are needed.
    Storage {
        /// One number for each visible face or edge, and one for every 16 of the mesh.
        needed: usize,
        /// The length of the storage.
        given: usize,
    },
    /// More faces or edges than a `u16` can count: split the mesh.
    TooMany {
        /// The number of faces or edges; at most 65535.
        items: usize,
    },
}

impl core::fmt::Display for BinError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Storage { needed, given } => {
                write!(
                    f,
                    "bin storage of {given} numbers, but {needed} are needed: provide at least {needed}"
                )
            }
            Self::TooMany { items } => {
                write!(f, "{items} faces or edges, but bins hold at most 65535: split the mesh")
            }
        }
    }
}

impl core::error::Error for BinError {}

impl<'s> Bins<'s> {
    /// Empty bins for `items` primitives that may be drawn in a viewport.
    #[inline(never)] // rare, as all of this file: small is better
    pub(super) fn new(storage: &'s mut [u16], items: usize, viewport: Scissor) -> Self {
        let words = items.div_ceil(16);
        // The list comes first, the bits after it. `make_room` reports storage that is too short even for the bits.
        let list = storage.len().saturating_sub(words);
        let (order, open) = storage.split_at_mut_checked(list).unwrap_or_default();
        open.fill(0);
        let rows = viewport.rows();
        let height = rows.end.saturating_sub(rows.start).max(1).unsigned_abs();
        let shift = (26 - (height - 1).leading_zeros().min(26)) % 32; // (height − 1) >> shift < 64
        Self { order, open, top: rows.start, shift, taken: 0, next: 0, row: i32::MIN, bounds: viewport }
    }

    /// Begins the sort: each primitive is [put](BinSort::put) in the order of the mesh, then the sort is
    /// [finished](BinSort::finish).
    #[inline(always)]
    pub(super) fn sort(&mut self) -> BinSort<'_, 's> {
        let viewport = core::mem::replace(&mut self.bounds, Scissor::UNION_IDENTITY);
        BinSort { bins: self, viewport, ends: [0; BINS] }
    }

    /// The bounding box of the visible primitives inside the viewport.
    pub(super) fn bounds(&self) -> Scissor {
        self.bounds
    }

    fn bin(&self, row: i32) -> usize {
        (row.saturating_sub(self.top).max(0) >> self.shift).min(BINS as i32 - 1) as usize
    }

    /// Calls `draw` with the index of each primitive that may meet the band of the last
    /// [`advance_to_band`](Self::advance_to_band), in the order of the mesh. `draw` returns whether the primitive ends in or
    /// above the band: then no later band meets it.
    ///
    /// # Errors
    ///
    /// The first error of `draw`.
    #[inline(always)]
    pub(super) fn band<E>(&mut self, mut draw: impl FnMut(usize) -> Result<bool, E>) -> Result<(), E> {
        for (word, bits) in self.open.iter_mut().enumerate() {
            let mut left = *bits;
            while left != 0 {
                let lowest = left & left.wrapping_neg();
                left ^= lowest;
                if draw(word * 16 + lowest.trailing_zeros() as usize)? {
                    *bits ^= lowest;
                }
            }
        }
        Ok(())
    }

    /// Takes in the primitives that begin in a band or above it. `first_row` gives the row by which a primitive was sorted.
    #[inline(always)]
    pub(super) fn advance_to_band(&mut self, rows: &Range<i32>, first_row: impl Fn(usize) -> i32) {
        if rows.is_empty() {
            return;
        }
        if rows.start < self.row {
            // Start again at the top: a band again, another frame, or another rectangle of the frame.
            self.open.fill(0);
            (self.taken, self.next) = (0, 0);
        }
        self.row = rows.end;
        if rows.end <= self.top {
            return;
        }
        let last = self.bin(rows.end - 1);
        if last < self.next {
            return;
        }
        // The end of these bins is found by bisection: to store the ends would take 128 bytes.
        let (begun, mut behind) = (self.taken, self.order.len());
        self.next = BINS;
        while self.taken < behind {
            let middle = (self.taken + behind) / 2; // at most 65535 each
            let bin = self.order.get(middle).map_or(BINS, |&item| self.bin(first_row(item.into())));
            if bin <= last {
                self.taken = middle + 1;
            } else {
                (behind, self.next) = (middle, bin);
            }
        }
        for &item in self.order.get(begun..self.taken).unwrap_or_default() {
            black_box(()); // keeps the loop as short as it is
            if let Some(bits) = self.open.get_mut(usize::from(item / 16)) {
                *bits |= 1 << (item % 16);
            }
        }
    }
}

impl BinSort<'_, '_> {
    /// Counts a primitive with this bounding box, unless it does not meet the viewport.
    #[inline(never)] // small is better: once for a visible primitive
    pub(super) fn put(&mut self, item: usize, reach: &Scissor) {
        let (rows, columns) = (reach.rows(), reach.columns());
        let (all_rows, all_columns) = (self.viewport.rows(), self.viewport.columns());
        let meets = |own: &Range<i32>, all: &Range<i32>| own.start < all.end && own.end > all.start;
        if reach.is_empty() || !(meets(&rows, &all_rows) && meets(&columns, &all_columns)) {
            return;
        }
        self.bins.bounds = self.bins.bounds.union(reach);
        self.bins.taken += 1; // at most all items
        if let Some(bits) = self.bins.open.get_mut(item / 16) {
            *bits |= 1 << (item % 16);
        }
        let bin = self.bins.bin(reach.rows().start);
        if let Some(count) = self.ends.get_mut(bin) {
            *count = count.wrapping_add(1); // at most all items
        }
    }

    /// Distributes the primitives that were counted, of `items` in the mesh, to their bins by their first rows.
    ///
    /// # Errors
    ///
    /// [`BinError`] where the storage is too short.
    #[inline(always)]
    pub(super) fn finish(
        &mut self,
        items: usize,
        first_row: impl FnMut(usize) -> i32,
    ) -> Result<(), BinError> {
        self.make_room(items)?;
        self.distribute(first_row);
        Ok(())
    }

    /// Turns counts into the positions where bins begin.
    #[inline(never)]
    fn make_room(&mut self, items: usize) -> Result<(), BinError> {
        if items > usize::from(u16::MAX) {
            return Err(BinError::TooMany { items });
        }
        let Bins { order, open, taken, .. } = &mut *self.bins;
        let (needed, given) = (*taken + items.div_ceil(16), order.len() + open.len());
        if given < needed {
            return Err(BinError::Storage { needed, given });
        }
        *order = core::mem::take(order).get_mut(..*taken).unwrap_or_default();
        let mut sum = 0u16;
        for end in &mut self.ends {
            black_box(()); // keeps the loop as short as it is
            let count = core::mem::replace(end, sum);
            sum = sum.wrapping_add(count); // all counted primitives, in the end
        }
        Ok(())
    }

    /// Moves the index of each counted primitive to its bin.
    #[inline(always)]
    fn distribute(&mut self, mut first_row: impl FnMut(usize) -> i32) {
        for word in 0..self.bins.open.len() {
            let mut left = self.bins.open.get_mut(word).map_or(0, core::mem::take);
            while left != 0 {
                let item = word * 16 + left.trailing_zeros() as usize;
                left &= left.wrapping_sub(1);
                let bin = self.bins.bin(first_row(item));
                if let Some(end) = self.ends.get_mut(bin) {
                    if let Some(place) = self.bins.order.get_mut(usize::from(*end)) {
                        *place = item as u16; // fewer than 65536
                    }
                    *end = end.wrapping_add(1); // at most all items
                }
            }
        }
        self.bins.taken = 0;
        // Each primitive meets the viewport.
        self.bins.bounds = self.bins.bounds.clipped_to(&self.viewport);
    }
}

#[cfg(test)]
mod tests {
    use super::{Bins, Scissor};
    use core::convert::Infallible;

    /// Three items, in rows 0 … 9, 5 … 14 and 20 … 29.
    const ITEMS: [(i32, i32); 3] = [(0, 10), (5, 15), (20, 30)];

    /// Bands in any order, as those of several rectangles: each meets what lies in it.
    #[test]
    fn a_band_that_is_not_below_the_last_begins_anew() {
        let mut records = [0; 4];
        let mut bins = Bins::new(&mut records, 3, Scissor::new(0, 0, 1, 40));
        let reach = |item: usize| Scissor::new(0, ITEMS[item].0, 1, ITEMS[item].1);
        let first_row = |item: usize| reach(item).rows().start;
        let mut sort = bins.sort();
        (0..3).for_each(|item| sort.put(item, &reach(item)));
        assert_eq!(sort.finish(3, first_row), Ok(()));
        for (from, to) in [(0, 16), (16, 32), (0, 16), (0, 16), (8, 12), (12, 40), (25, 26), (0, 3), (3, 4)] {
            let mut met = [false; 3];
            bins.advance_to_band(&(from..to), first_row);
            let Ok(()) = bins.band(|item| {
                met[item] = true;
                Ok::<_, Infallible>(ITEMS[item].1 <= to)
            });
            for (met, (first, end)) in met.into_iter().zip(ITEMS) {
                assert!(met || first >= to || end <= from, "{first}..{end} in {from}..{to}");
            }
        }
    }
}
