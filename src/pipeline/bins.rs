//! What is drawn where: faces or edges by the rows in which they begin.
//!
//! Numbers of items stand in one list, sorted into bins of rows by counting (Knuth, *The Art of Computer
//! Programming*, vol. 3, 2nd ed., section 5.2): every item is looked at twice. A band takes in the bins that begin above its end and sets a bit for
//! each item; bits stay until their item has ended, and are visited in rising order: so whatever the
//! bands, items are drawn in the order of the mesh.

use crate::raster::Scissor;
use core::hint::black_box;
use core::ops::Range;

/// How many bins there are: for 240 rows one in four.
const BINS: usize = 64;

/// Items of a mesh, sorted for bands.
#[derive(Debug)]
pub(super) struct Bins<'s> {
    /// Numbers of items, bin after bin.
    order: &'s mut [u16],
    /// A bit for each item of the mesh: taken in, and not ended. While sorting: to be sorted.
    open: &'s mut [u16],
    /// The first row of the first bin.
    top: i32,
    /// A bin has 2^shift rows.
    shift: u32,
    /// How many of `order` were taken in. While counting and sorting: how many items were kept.
    taken: usize,
    /// The bin of the first item not yet taken in, or a lower bound for it.
    next: usize,
    /// Where the last band ended.
    row: i32,
    /// The reach of all that were kept, in the viewport. Before they are sorted: the viewport.
    bounds: Scissor,
}

/// The same while they are sorted.
pub(super) struct Sorting<'b, 's> {
    bins: &'b mut Bins<'s>,
    /// What reaches nothing of it is not kept.
    viewport: Scissor,
    /// How many items each bin has; then where its next one goes. Where a bin ends is not kept: it would take most of what
    /// [`Bins`] take, which are moved and stay on the stack.
    ends: [u16; BINS],
}

/// Why faces or edges were not recorded: none of them were.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum BinError {
    /// The records are too short: lend as many numbers as are needed.
    Storage {
        /// One number for each face or edge that is visible, and one for every 16 of the mesh.
        needed: usize,
        /// What there is.
        given: usize,
    },
    /// More faces or edges than a `u16` can count: split the mesh.
    TooMany {
        /// How many there are; 65535 may be.
        items: usize,
    },
}

impl core::fmt::Display for BinError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Storage { needed, given } => {
                write!(f, "records of {given} numbers, but {needed} are needed: lend more")
            }
            Self::TooMany { items } => {
                write!(f, "{items} faces or edges, but records count 65535: split the mesh")
            }
        }
    }
}

impl core::error::Error for BinError {}

impl<'s> Bins<'s> {
    /// For `items` items and where they may be drawn.
    #[inline(never)] // rare, as all here: small is better
    pub(super) fn new(records: &'s mut [u16], items: usize, viewport: Scissor) -> Self {
        let words = items.div_ceil(16);
        // The list in front, the bits behind it. Where there is no room even for these, `turn` says so.
        let list = records.len().saturating_sub(words);
        let (order, open) = records.split_at_mut_checked(list).unwrap_or_default();
        open.fill(0);
        let rows = viewport.rows();
        let height = rows.end.saturating_sub(rows.start).max(1).unsigned_abs();
        let shift = (26 - (height - 1).leading_zeros().min(26)) % 32; // (height − 1) >> shift < 64
        Self { order, open, top: rows.start, shift, taken: 0, next: 0, row: i32::MIN, bounds: viewport }
    }

    /// First all items are [put](Sorting::put) in their order; the bins [turn](Sorting::turn), and the kept ones are
    /// [sorted](Sorting::sort).
    #[inline(always)]
    pub(super) fn sorting(&mut self) -> Sorting<'_, 's> {
        let viewport = core::mem::replace(&mut self.bounds, Scissor::UNION_IDENTITY);
        Sorting { bins: self, viewport, ends: [0; BINS] }
    }

    /// The reach of all that were kept, in the viewport.
    pub(super) fn bounds(&self) -> Scissor {
        self.bounds
    }

    fn bin(&self, row: i32) -> usize {
        (row.saturating_sub(self.top).max(0) >> self.shift).min(BINS as i32 - 1) as usize
    }

    /// Calls `draw` for the items that may lie in the band that was [taken in](Self::advance_to_band), in the order of the mesh,
    /// until it tells that an item ends in or above the band.
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

    /// Takes in the items that begin in a band or above it. `first_row` is that by which they were sorted.
    #[inline(always)]
    pub(super) fn advance_to_band(&mut self, rows: &Range<i32>, first_row: impl Fn(usize) -> i32) {
        if rows.is_empty() {
            return;
        }
        if rows.start < self.row {
            // From the top: the same band once more, another frame, or another rectangle of it.
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
        // Where these bins end is searched by halves, not kept: a few first rows are worked out once more.
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

impl Sorting<'_, '_> {
    /// First: keeps an item with this reach, unless none of that may be drawn, and counts it.
    #[inline(never)] // small is better: once an item that is seen
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

    /// Then, after all of `items` were looked at: those that were kept to their places, by the first rows of their reaches.
    ///
    /// # Errors
    ///
    /// [`BinError`] where there is no room for them.
    #[inline(always)]
    pub(super) fn finish(
        &mut self,
        items: usize,
        first_row: impl FnMut(usize) -> i32,
    ) -> Result<(), BinError> {
        self.make_room(items)?;
        self.sort(first_row);
        Ok(())
    }

    /// Bins begin where those before them end.
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
        // From counts to beginnings.
        let mut sum = 0u16;
        for end in &mut self.ends {
            black_box(()); // keeps the loop as short as it is
            let count = core::mem::replace(end, sum);
            sum = sum.wrapping_add(count); // all that were kept, in the end
        }
        Ok(())
    }

    /// The kept items once more, to their places.
    #[inline(always)]
    fn sort(&mut self, mut first_row: impl FnMut(usize) -> i32) {
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
        // Each of them lies in the viewport in part.
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
        let mut sorting = bins.sorting();
        (0..3).for_each(|item| sorting.put(item, &reach(item)));
        assert_eq!(sorting.finish(3, first_row), Ok(()));
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
