//! What is drawn where: faces or edges by the rows in which they begin.
//!
//! Numbers of items stand in one list, sorted into bins of rows in place (McIlroy, Bostic and McIlroy,
//! *Engineering radix sort*, 1993). A band takes in the bins that begin above its end and sets a bit for
//! each item; bits stay until their item has ended, and are visited in rising order: so whatever the
//! bands, items are drawn in the order of the mesh.

use core::cell::Cell;
use core::ops::Range;

/// How many bins there are: for 240 rows one in four.
const BINS: usize = 64;

/// Items of a mesh, sorted for bands.
#[derive(Debug)]
pub(super) struct Bins<'s> {
    /// Numbers of items, bin after bin.
    order: &'s [u16],
    /// A bit for each item of the mesh: taken in, and not ended.
    open: &'s mut [u16],
    /// Where each bin ends in `order`.
    ends: [u16; BINS],
    /// The first row of the first bin.
    top: i32,
    /// A bin has 2^shift rows.
    shift: u32,
    /// How many of `order` were taken in.
    taken: usize,
    /// Where the last band ended.
    row: i32,
}

/// Why faces or edges were not recorded: none of them were.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum BinsError {
    /// The records are too short: lend as many numbers as are needed.
    Records {
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

impl core::fmt::Display for BinsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Records { needed, given } => {
                write!(f, "records of {given} numbers, but {needed} are needed: lend more")
            }
            Self::TooMany { items } => {
                write!(f, "{items} faces or edges, but records count 65535: split the mesh")
            }
        }
    }
}

impl core::error::Error for BinsError {}

impl<'s> Bins<'s> {
    /// Sorts those of `items` items for which `begins` tells a row; it is asked once for every item in
    /// their order, and `row` once more for each that is kept. `rows` are all that may be drawn.
    pub(super) fn new(
        records: &'s mut [u16],
        items: usize,
        rows: Range<i32>,
        mut begins: impl FnMut(usize) -> Option<i32>,
        mut row: impl FnMut(usize) -> i32,
    ) -> Result<Self, BinsError> {
        if items > usize::from(u16::MAX) {
            return Err(BinsError::TooMany { items });
        }
        let given = records.len();
        let words = items.div_ceil(16);
        // The list in front, the bits behind it.
        let (list, open) = records.split_at_mut_checked(given.saturating_sub(words)).unwrap_or_default();
        let height = rows.end.saturating_sub(rows.start).max(1).unsigned_abs();
        let shift = (26 - (height - 1).leading_zeros().min(26)) % 32; // (height − 1) >> shift < 64
        let bin = |row: i32| (row.saturating_sub(rows.start).max(0) >> shift).min(BINS as i32 - 1) as usize;
        let (mut kept, mut ends) = (0usize, [0u16; BINS]);
        for item in 0..items {
            if let Some(row) = begins(item) {
                if let Some(place) = list.get_mut(kept) {
                    *place = item as u16; // fewer than 65536
                }
                kept += 1; // at most `items`
                if let Some(count) = ends.get_mut(bin(row)) {
                    *count += 1; // at most `items`
                }
            }
        }
        let needed = kept + words;
        let list = match list.get_mut(..kept) {
            Some(list) if given >= needed => list,
            _ => return Err(BinsError::Records { needed, given }),
        };
        // From counts to ends; every bin's next place is its beginning.
        let mut next = [0u16; BINS];
        let mut sum = 0u16;
        for (next, end) in next.iter_mut().zip(&mut ends) {
            *next = sum;
            sum += *end; // `kept` in the end
            *end = sum;
        }
        let cells = Cell::from_mut(&mut *list).as_slice_of_cells();
        for (own, end) in ends.iter().enumerate() {
            // Each turn brings one item to its bin.
            while let Some(at) = next.get(own).copied().filter(|at| at < end) {
                let Some(here) = cells.get(usize::from(at)) else { break };
                let home = bin(row(here.get().into()));
                let Some(place) = next.get_mut(home) else { break };
                if let Some(there) = cells.get(usize::from(*place)) {
                    here.swap(there);
                }
                *place += 1; // at most its bin's end
            }
        }
        open.fill(0);
        Ok(Self { order: list, open, ends, top: rows.start, shift, taken: 0, row: i32::MIN })
    }

    /// Calls `draw` for the items that may lie in a band, in the order of the mesh, until it tells that
    /// an item ends in or above the band.
    ///
    /// # Errors
    ///
    /// The first error of `draw`.
    #[inline(always)]
    pub(super) fn band<E>(
        &mut self,
        rows: Range<i32>,
        mut draw: impl FnMut(usize) -> Result<bool, E>,
    ) -> Result<(), E> {
        if rows.is_empty() {
            return Ok(());
        }
        self.take_in(&rows);
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

    fn take_in(&mut self, rows: &Range<i32>) {
        if rows.start < self.row {
            // From the top: the same band once more, another frame, or another rectangle of it.
            self.open.fill(0);
            self.taken = 0;
        }
        self.row = rows.end;
        if rows.end <= self.top {
            return;
        }
        let last = ((rows.end - 1).saturating_sub(self.top) >> self.shift).min(BINS as i32 - 1);
        let until = self.ends.get(last as usize).map_or(0, |&end| usize::from(end));
        for &item in self.order.get(self.taken..until).unwrap_or_default() {
            if let Some(bits) = self.open.get_mut(usize::from(item / 16)) {
                *bits |= 1 << (item % 16);
            }
        }
        self.taken = self.taken.max(until);
    }
}

#[cfg(test)]
mod tests {
    use super::Bins;
    use core::convert::Infallible;

    /// Three items, in rows 0 … 9, 5 … 14 and 20 … 29.
    const ITEMS: [(i32, i32); 3] = [(0, 10), (5, 15), (20, 30)];

    /// Bands in any order, as those of several rectangles: each meets what lies in it.
    #[test]
    fn a_band_that_is_not_below_the_last_begins_anew() {
        let mut records = [0; 4];
        let first = |item: usize| ITEMS[item].0;
        let bins = Bins::new(&mut records, 3, 0..40, |item| Some(first(item)), first);
        let Ok(mut bins) = bins else { panic!() };
        for (from, to) in [(0, 16), (16, 32), (0, 16), (0, 16), (8, 12), (12, 40), (25, 26), (0, 3), (3, 4)] {
            let mut met = [false; 3];
            let Ok(()) = bins.band(from..to, |item| {
                met[item] = true;
                Ok::<_, Infallible>(ITEMS[item].1 <= to)
            });
            for (met, (first, end)) in met.into_iter().zip(ITEMS) {
                assert!(met || first >= to || end <= from, "{first}..{end} in {from}..{to}");
            }
        }
    }
}
