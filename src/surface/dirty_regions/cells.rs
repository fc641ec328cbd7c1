//! Rectangles of cells. A cell is the smallest block of pixels that a display controller can address.

/// A rectangle of cells, from `left`, `top` up to but not including `right`, `bottom`. It is never empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cells {
    pub(super) left: u16,
    pub(super) top: u16,
    pub(super) right: u16,
    pub(super) bottom: u16,
}

impl Cells {
    /// The cells of columns `left..right` and rows `top..bottom`; `None` if there is none.
    pub(super) fn new(left: u16, top: u16, right: u16, bottom: u16) -> Option<Self> {
        (left < right && top < bottom).then_some(Self { left, top, right, bottom })
    }

    pub(super) const fn width(&self) -> u16 {
        self.right.saturating_sub(self.left)
    }

    pub(super) const fn height(&self) -> u16 {
        self.bottom.saturating_sub(self.top)
    }

    /// The smallest rectangle that contains both.
    pub(super) fn union(self, other: Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// The cells outside `hole`, as at most four rectangles: the rows above the hole, the cells to its left and right, and the
    /// rows below it. If the hole does not overlap the rectangle, the result is the rectangle.
    #[inline(never)] // called once a pair: size matters more than time
    pub(super) fn without(self, hole: Self) -> heapless::Vec<Self, 4> {
        let Self { left, top, right, bottom } = self;
        let (first, end) = (top.max(hole.top), bottom.min(hole.bottom));
        let is_disjoint = first >= end || left.max(hole.left) >= right.min(hole.right);
        let mut pieces = heapless::Vec::new();
        let mut push = |left, top, right, bottom| {
            if left < right && top < bottom {
                let _ = pieces.push(Self { left, top, right, bottom }); // at most four
            }
        };
        if is_disjoint {
            push(left, top, right, bottom);
        } else {
            push(left, top, right, first);
            push(left, first, hole.left, end);
            push(hole.right, first, right, end);
            push(left, end, right, bottom);
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::Cells;

    fn all() -> impl Iterator<Item = Cells> {
        let pairs = || (0..5u16).flat_map(|low| (low + 1..6).map(move |high| (low, high)));
        pairs().flat_map(move |(left, right)| pairs().filter_map(move |(t, b)| Cells::new(left, t, right, b)))
    }

    fn contains(c: &Cells, x: u16, y: u16) -> bool {
        (c.left..c.right).contains(&x) && (c.top..c.bottom).contains(&y)
    }

    /// Every rectangle and every hole on a grid of 5 × 5 cells, compared cell by cell.
    #[test]
    fn pieces_cover_each_cell_outside_the_hole_once() {
        assert_eq!(all().count(), 225);
        for rectangle in all() {
            for hole in all() {
                let pieces = rectangle.without(hole);
                let both = rectangle.union(hole);
                for (x, y) in (0..6).flat_map(|x| (0..6).map(move |y| (x, y))) {
                    let times = pieces.iter().filter(|piece| contains(piece, x, y)).count();
                    let left = contains(&rectangle, x, y) && !contains(&hole, x, y);
                    assert_eq!(times, usize::from(left), "{rectangle:?} without {hole:?} at {x}, {y}");
                    assert!(contains(&both, x, y) || !(contains(&rectangle, x, y) || contains(&hole, x, y)));
                }
            }
        }
    }

    #[test]
    fn a_hole_elsewhere_leaves_the_rectangle_in_one_piece() {
        let (Some(rectangle), Some(hole)) = (Cells::new(0, 0, 2, 6), Cells::new(2, 2, 4, 4)) else {
            panic!()
        };
        assert_eq!(rectangle.without(hole), [rectangle]);
    }
}
