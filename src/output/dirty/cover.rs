//! A few rectangles that hold whatever was added, at little cost.

use super::cells::Cells;
use heapless::Vec;

/// What it costs to send cells, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Price {
    /// At most 2⁴⁰: 2⁸ bits a pixel and 2³² pixels a cell.
    pub(super) cell_bits: i64,
    pub(super) window: i64,
}

impl Price {
    /// One window. A row of cells ends with a whole byte.
    pub(super) fn of(&self, cells: &Cells) -> i64 {
        // A row is below 2⁵⁶ bits. As all cells are less than 2¹⁷ pixels wide and high, the product is
        // below 2³⁹ bytes.
        let row = (i64::from(cells.width()).saturating_mul(self.cell_bits).saturating_add(7)) >> 3;
        row.saturating_mul(i64::from(cells.height())).saturating_add(self.window)
    }

    pub(super) fn sum(&self, all: &[Cells]) -> i64 {
        all.iter().fold(0, |sum: i64, cells| sum.saturating_add(self.of(cells)))
    }

    /// How much more it costs to send both in one rectangle than to send one, and of the other what
    /// that leaves.
    fn loss(&self, a: Cells, b: Cells) -> i64 {
        let beside = |a: Cells, b: Cells| self.of(&a).saturating_add(self.sum(&b.without(a)));
        let apart = self.sum(&[a, b]).min(beside(a, b)).min(beside(b, a));
        self.of(&a.enclosing(b)).saturating_sub(apart)
    }
}

/// The rectangles. Cuts may leave two that are equal; they go as one.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Cover<const N: usize>(Vec<Cells, N>);

impl<const N: usize> Cover<N> {
    pub(super) const fn new() -> Self {
        Self(Vec::new())
    }

    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    pub(super) fn parts(&self) -> &[Cells] {
        &self.0
    }

    /// Takes in what is merged into no other: those that cost less apart. Without room for it, the
    /// two that cost least to merge are merged.
    pub(super) fn add(&mut self, cells: Cells, price: &Price) {
        let mut open = cells;
        // Each turn leaves one rectangle fewer, the open one counted.
        loop {
            let best = self.partner(open, price);
            let gains = best.is_some_and(|(_, loss)| loss <= 0);
            if !gains && self.0.push(open).is_ok() {
                return;
            }
            // None only without any capacity: no `Dirty` has that.
            let Some((mut partner, loss)) = best else { return };
            let others = if gains { None } else { self.pair(price) };
            if let Some((a, b, _)) = others.filter(|(_, _, less)| *less < loss) {
                self.remove(a);
                let _ = self.0.push(open); // in the place of a
                (open, partner) = (a, b);
            }
            self.remove(partner);
            open = open.enclosing(partner);
        }
    }

    /// With whom merging costs least.
    fn partner(&self, cells: Cells, price: &Price) -> Option<(Cells, i64)> {
        self.0.iter().map(|&other| (other, price.loss(cells, other))).min_by_key(|(_, loss)| *loss)
    }

    /// Which two of them cost least to merge.
    fn pair(&self, price: &Price) -> Option<(Cells, Cells, i64)> {
        let pairs = self.0.iter().enumerate().flat_map(|(i, &a)| {
            let others = self.0.iter().skip(i.saturating_add(1));
            others.map(move |&b| (a, b, price.loss(a, b)))
        });
        pairs.min_by_key(|(_, _, loss)| *loss)
    }

    /// And what is equal to it: that holds the same cells.
    fn remove(&mut self, cells: Cells) {
        self.0.retain(|other| *other != cells);
    }

    /// Sends nothing twice, but where that costs less than another window or there is no room for
    /// the pieces; then all in one where that is no dearer.
    pub(super) fn settle(&mut self, price: &Price) {
        // Each turn costs less than the one before.
        while let Some((cells, pieces)) = self.overlap(price) {
            self.remove(cells);
            for piece in pieces {
                let _ = self.0.push(piece); // there is room
            }
        }
        let all = self.0.iter().copied().reduce(Cells::enclosing);
        if let Some(all) = all.filter(|all| price.of(all) <= price.sum(&self.0)) {
            self.clear();
            let _ = self.0.push(all);
        }
    }

    /// The one that gains most when it is cut to what another leaves of it.
    fn overlap(&self, price: &Price) -> Option<(Cells, Vec<Cells, 4>)> {
        let room = N.saturating_sub(self.0.len()).saturating_add(1);
        let cuts = self.0.iter().flat_map(|&cells| {
            let others = self.0.iter().filter(move |other| **other != cells);
            others.map(move |&other| (cells, cells.without(other)))
        });
        cuts.filter(|(_, pieces)| pieces.len() <= room)
            .map(|(cells, pieces)| (price.of(&cells).saturating_sub(price.sum(&pieces)), cells, pieces))
            .filter(|(gain, _, _)| *gain > 0)
            .max_by_key(|(gain, _, _)| *gain)
            .map(|(_, cells, pieces)| (cells, pieces))
    }

    /// The one that begins highest, and of those the leftmost; it goes.
    pub(super) fn take_first(&mut self) -> Option<Cells> {
        let first = self.0.iter().copied().min_by_key(|cells| (cells.top, cells.left))?;
        self.remove(first);
        Some(first)
    }
}
