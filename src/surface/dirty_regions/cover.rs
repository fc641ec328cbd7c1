//! A cover: a list of few rectangles that contain every rectangle that was added, and take few bytes to send. The functions take a
//! `VecView`, so that one copy of each serves all capacities.

use super::cells::Cells;
use core::hint::black_box;
use heapless::VecView;

/// The number of bytes that it takes to send cells. It saturates: 2³¹ bytes and more count as equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TransferBytes {
    pub(super) cell_bits: i32,
    pub(super) window: i32,
}

impl TransferBytes {
    /// The bytes of one window. A row of cells ends with a whole byte.
    #[inline(never)] // called once a pair: size matters more than time
    pub(super) fn of(&self, cells: &Cells) -> i32 {
        let row = i32::from(cells.width()).saturating_mul(self.cell_bits).saturating_add(7) >> 3;
        row.saturating_mul(i32::from(cells.height())).saturating_add(self.window)
    }

    /// The bytes of all these windows.
    #[inline(never)] // called once a pair: size matters more than time
    pub(super) fn sum(&self, all: &[Cells]) -> i32 {
        all.iter().fold(0, |sum: i32, cells| sum.saturating_add(self.of(cells)))
    }

    /// How many more bytes it takes to send both in one rectangle than to send them apart, with or without their overlap.
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

/// Adds `cells` to a list. It is merged with another rectangle as long as that saves bytes. When the list is full, the two
/// rectangles whose merging loses least are merged.
#[inline(never)] // called once a mark: size matters more than time
pub(super) fn add(list: &mut VecView<Cells>, cells: Cells, bytes: &TransferBytes) {
    let mut open = cells;
    // Each iteration leaves one rectangle fewer, counting the open one.
    loop {
        let best = cheapest_merge(list, open, bytes);
        let gains = best.is_some_and(|(_, loss)| loss <= 0);
        if !gains && list.push(open).is_ok() {
            return;
        }
        // `None` only for a list without capacity, which no `DirtyRegions` has.
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

/// The rectangle in the list whose merging with `cells` loses least, and the loss.
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

/// The two rectangles in the list whose merging loses least, if that is less than `limit`.
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

/// Removes a rectangle, and its equals: cuts may leave two equal rectangles, which count as one.
#[inline(never)] // called once a mark: size matters more than time
fn remove(list: &mut VecView<Cells>, cells: Cells) {
    list.retain(|other| *other != cells);
}

/// Cuts overlaps out of the list, as long as a cut saves more than the windows of its pieces take and there is room for them. Then
/// replaces all rectangles by the one that encloses them, if that takes no more bytes.
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
        black_box(()); // not unrolled, as in `take_first`
        all.union(*cells)
    });
    if bytes.of(&all) <= bytes.sum(list) {
        list.clear();
        let _ = list.push(all);
    }
}

/// The cut that saves most bytes: a rectangle, and the other one that is cut out of it.
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

/// Removes and returns the rectangle that begins highest, and of several such the leftmost.
#[inline(never)] // called once a window: size matters more than time
pub(super) fn take_first(list: &mut VecView<Cells>) -> Option<Cells> {
    let mut first: Option<Cells> = None;
    for &cells in list.iter() {
        black_box(()); // not unrolled: LLVM would copy the body
        if first.is_none_or(|first| (cells.top, cells.left) < (first.top, first.left)) {
            first = Some(cells);
        }
    }
    remove(list, first?);
    first
}
