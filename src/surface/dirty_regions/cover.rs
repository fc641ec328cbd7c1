//! A few rectangles that hold whatever was added, at little cost. The functions know no capacity: one copy of each
//! serves all.

use super::cells::Cells;
use core::hint::black_box;
use heapless::VecView;

/// What it costs to send cells, in bytes; 2³¹ and more are all the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Price {
    pub(super) cell_bits: i32,
    pub(super) window: i32,
}

impl Price {
    /// One window. A row of cells ends with a whole byte.
    #[inline(never)] // once a pair: small is better
    pub(super) fn of(&self, cells: &Cells) -> i32 {
        let row = i32::from(cells.width()).saturating_mul(self.cell_bits).saturating_add(7) >> 3;
        row.saturating_mul(i32::from(cells.height())).saturating_add(self.window)
    }

    #[inline(never)] // once a pair: small is better
    pub(super) fn sum(&self, all: &[Cells]) -> i32 {
        all.iter().fold(0, |sum: i32, cells| sum.saturating_add(self.of(cells)))
    }

    /// How much more it costs to send both in one rectangle than to send one, and of the other what
    /// that leaves.
    #[inline(never)] // once a pair: small is better
    fn loss(&self, a: Cells, b: Cells) -> i32 {
        let apart = self.sum(&[a, b]).min(self.beside(a, b)).min(self.beside(b, a));
        self.of(&a.enclosing(b)).saturating_sub(apart)
    }

    /// One, and of the other what that leaves.
    fn beside(&self, a: Cells, b: Cells) -> i32 {
        self.of(&a).saturating_add(self.sum(&b.without(a)))
    }
}

/// Takes `cells` into a list: merged into no other are those that cost less apart. Without room for it, the
/// two that cost least to merge are merged.
#[inline(never)] // once a mark: small is better
pub(super) fn add(list: &mut VecView<Cells>, cells: Cells, price: &Price) {
    let mut open = cells;
    // Each turn leaves one rectangle fewer, the open one counted.
    loop {
        let best = partner(list, open, price);
        let gains = best.is_some_and(|(_, loss)| loss <= 0);
        if !gains && list.push(open).is_ok() {
            return;
        }
        // None only without any capacity: no `DirtyRegions` has that.
        let Some((mut partner, loss)) = best else { return };
        if let Some((a, b)) = if gains { None } else { pair(list, loss, price) } {
            remove(list, a);
            let _ = list.push(open); // in the place of a
            (open, partner) = (a, b);
        }
        remove(list, partner);
        open = open.enclosing(partner);
    }
}

/// With whom merging costs least, and how much.
#[inline(never)] // once a mark: small is better
fn partner(list: &[Cells], cells: Cells, price: &Price) -> Option<(Cells, i32)> {
    let mut best = None;
    for &other in list {
        let loss = price.loss(cells, other);
        if best.is_none_or(|(_, least)| loss < least) {
            best = Some((other, loss));
        }
    }
    best
}

/// Which two of them cost least to merge, where that is less than `limit`.
fn pair(list: &[Cells], mut limit: i32, price: &Price) -> Option<(Cells, Cells)> {
    let (mut best, mut rest) = (None, list);
    while let Some((&a, others)) = rest.split_first() {
        rest = others;
        if let Some((b, loss)) = partner(others, a, price).filter(|(_, loss)| *loss < limit) {
            (best, limit) = (Some((a, b)), loss);
        }
    }
    best
}

/// And what is equal to it: that holds the same cells. Cuts may leave two that are equal; they go as one.
#[inline(never)] // once a mark: small is better
fn remove(list: &mut VecView<Cells>, cells: Cells) {
    list.retain(|other| *other != cells);
}

/// Sends nothing twice, but where that costs less than another window or there is no room for
/// the pieces; then all in one where that is no dearer.
#[inline(never)] // once a frame: small is better
pub(super) fn settle(list: &mut VecView<Cells>, price: &Price) {
    // Each turn costs less than the one before.
    while let Some((cells, hole)) = overlap(list, price) {
        remove(list, cells);
        for &piece in cells.without(hole).iter() {
            let _ = list.push(piece); // there is room
        }
    }
    let Some(&first) = list.first() else { return };
    let all = list.iter().fold(first, |all, cells| {
        black_box(()); // as below
        all.enclosing(*cells)
    });
    if price.of(&all) <= price.sum(list) {
        list.clear();
        let _ = list.push(all);
    }
}

/// The one that gains most when it is cut to what another leaves of it, and that other.
fn overlap(list: &VecView<Cells>, price: &Price) -> Option<(Cells, Cells)> {
    let room = list.capacity().saturating_sub(list.len()).saturating_add(1);
    let (mut best, mut most) = (None, 1);
    for &cells in list.iter() {
        for &other in list.iter().filter(|other| **other != cells) {
            let pieces = cells.without(other);
            let gain = price.of(&cells).saturating_sub(price.sum(&pieces));
            if pieces.len() <= room && gain >= most {
                (best, most) = (Some((cells, other)), gain);
            }
        }
    }
    best
}

/// The one that begins highest, and of those the leftmost; it goes.
#[inline(never)] // once a window: small is better
pub(super) fn take_first(list: &mut VecView<Cells>) -> Option<Cells> {
    let mut first: Option<Cells> = None;
    for &cells in list.iter() {
        black_box(()); // once is enough: the compiler would copy the body
        if first.is_none_or(|first| (cells.top, cells.left) < (first.top, first.left)) {
            first = Some(cells);
        }
    }
    remove(list, first?);
    first
}
