//! A cover: a short list of rectangles that together contain every rectangle that was added, chosen so that few bytes are sent.
//! Functions take a `VecView`, so that one copy of each serves lists of all capacities.

use super::cells::Cells;
use crate::math::hints::keep_rolled;
use heapless::VecView;

/// Computes how many bytes it takes to send rectangles of cells. Sums saturate: 2³¹ bytes and more count as equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TransferBytes {
    /// Bits of one cell.
    pub(super) cell_bits: i32,
    /// Bytes of commands per rectangle.
    pub(super) window: i32,
}

impl TransferBytes {
    /// The bytes of one rectangle with its commands. Each row of cells is rounded up to bytes.
    #[inline(never)] // called once a pair: size matters more than time
    pub(super) fn of(&self, cells: &Cells) -> i32 {
        let row = i32::from(cells.width()).saturating_mul(self.cell_bits).saturating_add(7) >> 3;
        row.saturating_mul(i32::from(cells.height())).saturating_add(self.window)
    }

    /// The bytes of several rectangles.
    #[inline(never)] // called once a pair: size matters more than time
    pub(super) fn sum(&self, all: &[Cells]) -> i32 {
        all.iter().fold(0, |sum: i32, cells| sum.saturating_add(self.of(cells)))
    }

    /// The bytes added by sending both as one rectangle instead of separately; negative if merging saves bytes. Separately means
    /// as two rectangles or, if that takes fewer bytes, as one of them and the part of the other outside it.
    #[inline(never)] // called once a pair: size matters more than time
    fn merge_loss(&self, a: Cells, b: Cells) -> i32 {
        let apart = self.sum(&[a, b]).min(self.with_rest(a, b)).min(self.with_rest(b, a));
        self.of(&a.union(b)).saturating_sub(apart)
    }

    /// The bytes of `a` and of the part of `b` outside it.
    fn with_rest(&self, a: Cells, b: Cells) -> i32 {
        self.of(&a).saturating_add(self.sum(&b.without(a)))
    }
}

/// Adds the rectangle `cells` to a list. It is merged with rectangles of the list as long as that adds no bytes. When the list
/// is full, the two rectangles whose merging adds the fewest bytes are merged.
#[inline(never)] // called once a mark: size matters more than time
pub(super) fn add(list: &mut VecView<Cells>, cells: Cells, bytes: &TransferBytes) {
    let mut open = cells;
    // This ends: each iteration merges two rectangles, of the list or the open one, into one.
    loop {
        let best = cheapest_merge(list, open, bytes);
        let gains = best.is_some_and(|(_, loss)| loss <= 0);
        if !gains && list.push(open).is_ok() {
            return;
        }
        // `None` only for a list of capacity 0, which no `DirtyRegions` has.
        let Some((mut partner, loss)) = best else { return };
        if let Some((a, b)) = if gains { None } else { cheapest_pair(list, loss, bytes) } {
            remove(list, a);
            let _ = list.push(open); // there is room: `a` was removed
            (open, partner) = (a, b);
        }
        remove(list, partner);
        open = open.union(partner);
    }
}

/// The rectangle in the list whose merging with `cells` adds the fewest bytes, and how many.
#[inline(never)] // called once a mark: size matters more than time
fn cheapest_merge(list: &[Cells], cells: Cells, bytes: &TransferBytes) -> Option<(Cells, i32)> {
    let mut best = None;
    for &other in list {
        let loss = bytes.merge_loss(cells, other);
        if best.is_none_or(|(_, least)| loss < least) {
            best = Some((other, loss));
        }
    }
    best
}

/// The two rectangles in the list whose merging adds the fewest bytes, if these are fewer than `limit`.
fn cheapest_pair(list: &[Cells], mut limit: i32, bytes: &TransferBytes) -> Option<(Cells, Cells)> {
    let (mut best, mut rest) = (None, list);
    while let Some((&a, others)) = rest.split_first() {
        rest = others;
        if let Some((b, loss)) = cheapest_merge(others, a, bytes).filter(|(_, loss)| *loss < limit) {
            (best, limit) = (Some((a, b)), loss);
        }
    }
    best
}

/// Removes a rectangle and all equal ones: `simplify` may leave two equal rectangles, which count as one.
#[inline(never)] // called once a mark: size matters more than time
fn remove(list: &mut VecView<Cells>, cells: Cells) {
    list.retain(|other| *other != cells);
}

/// Removes overlaps: cuts one rectangle out of another, which up to four replace, as long as this saves bytes and the list has
/// room. Then replaces all rectangles by their bounding rectangle, if it takes no more bytes.
#[inline(never)] // called once a frame: size matters more than time
pub(super) fn simplify(list: &mut VecView<Cells>, bytes: &TransferBytes) {
    // This ends: each iteration leaves a list that takes fewer bytes.
    while let Some((cells, hole)) = best_cut(list, bytes) {
        remove(list, cells);
        for &piece in cells.without(hole).iter() {
            let _ = list.push(piece); // there is room
        }
    }
    let Some(&first) = list.first() else { return };
    let all = list.iter().fold(first, |all, cells| {
        keep_rolled(); // as in `take_first`
        all.union(*cells)
    });
    if bytes.of(&all) <= bytes.sum(list) {
        list.clear();
        let _ = list.push(all);
    }
}

/// The cut that saves the most bytes: a rectangle, and the one to be cut out of it.
fn best_cut(list: &VecView<Cells>, bytes: &TransferBytes) -> Option<(Cells, Cells)> {
    let room = list.capacity().saturating_sub(list.len()).saturating_add(1);
    let (mut best, mut most) = (None, 1);
    for &cells in list.iter() {
        for &other in list.iter().filter(|other| **other != cells) {
            let pieces = cells.without(other);
            let gain = bytes.of(&cells).saturating_sub(bytes.sum(&pieces));
            if pieces.len() <= room && gain >= most {
                (best, most) = (Some((cells, other)), gain);
            }
        }
    }
    best
}

/// Removes and returns the topmost rectangle, the leftmost of several that begin in one row.
#[inline(never)] // called once a window: size matters more than time
pub(super) fn take_first(list: &mut VecView<Cells>) -> Option<Cells> {
    let mut first: Option<Cells> = None;
    for &cells in list.iter() {
        keep_rolled(); // LLVM would copy the body
        if first.is_none_or(|first| (cells.top, cells.left) < (first.top, first.left)) {
            first = Some(cells);
        }
    }
    remove(list, first?);
    first
}
