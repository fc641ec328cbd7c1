//! Rectangles on a grid of cells.

/// What a controller can address: from `left`, `top` up to but not including `right`, `bottom`. Never
/// empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cells {
    pub(super) left: u16,
    pub(super) top: u16,
    pub(super) right: u16,
    pub(super) bottom: u16,
}

impl Cells {
    /// `None` when there is nothing between the borders.
    pub(super) fn new(left: u16, top: u16, right: u16, bottom: u16) -> Option<Self> {
        (left < right && top < bottom).then_some(Self { left, top, right, bottom })
    }

    pub(super) const fn width(&self) -> u16 {
        self.right.saturating_sub(self.left)
    }

    pub(super) const fn height(&self) -> u16 {
        self.bottom.saturating_sub(self.top)
    }

    /// The least one that holds both.
    pub(super) fn enclosing(self, other: Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// What a hole leaves, in at most four pieces: the rows above and below it, then what stands
    /// beside it. All of it in one piece where the hole is elsewhere.
    #[inline(never)] // once a pair: small is better
    pub(super) fn without(self, hole: Self) -> heapless::Vec<Self, 4> {
        let Self { left, top, right, bottom } = self;
        let (first, end) = (top.max(hole.top), bottom.min(hole.bottom));
        let apart = first >= end || left.max(hole.left) >= right.min(hole.right);
        let mut left_over = heapless::Vec::new();
        let mut keep = |left, top, right, bottom| {
            if left < right && top < bottom {
                let _ = left_over.push(Self { left, top, right, bottom }); // at most four
            }
        };
        if apart {
            keep(left, top, right, bottom);
        } else {
            keep(left, top, right, first);
            keep(left, first, hole.left, end);
            keep(hole.right, first, right, end);
            keep(left, end, right, bottom);
        }
        left_over
    }
}

#[cfg(test)]
mod tests {
    use super::Cells;

    fn all() -> impl Iterator<Item = Cells> {
        let pairs = || (0..5u16).flat_map(|low| (low + 1..6).map(move |high| (low, high)));
        pairs().flat_map(move |(left, right)| pairs().filter_map(move |(t, b)| Cells::new(left, t, right, b)))
    }

    fn holds(c: &Cells, x: u16, y: u16) -> bool {
        (c.left..c.right).contains(&x) && (c.top..c.bottom).contains(&y)
    }

    /// Every rectangle and every hole of a small grid, cell by cell.
    #[test]
    fn a_hole_leaves_all_but_itself_once() {
        assert_eq!(all().count(), 225);
        for whole in all() {
            for hole in all() {
                let pieces = whole.without(hole);
                let both = whole.enclosing(hole);
                for (x, y) in (0..6).flat_map(|x| (0..6).map(move |y| (x, y))) {
                    let times = pieces.iter().filter(|piece| holds(piece, x, y)).count();
                    let left = holds(&whole, x, y) && !holds(&hole, x, y);
                    assert_eq!(times, usize::from(left), "{whole:?} without {hole:?} at {x}, {y}");
                    assert!(holds(&both, x, y) || !(holds(&whole, x, y) || holds(&hole, x, y)));
                }
            }
        }
    }

    #[test]
    fn what_is_apart_stays_in_one_piece() {
        let (Some(whole), Some(beside)) = (Cells::new(0, 0, 2, 6), Cells::new(2, 2, 4, 4)) else { panic!() };
        assert_eq!(whole.without(beside), [whole]);
    }
}
