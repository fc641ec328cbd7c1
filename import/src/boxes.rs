//! Boxes in a tree, to find those at a place without looking at all.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The lowest and the highest corner of a box of at most four axes: one type for all, so that the planner's page has its code once.
pub(crate) type Bounds = [[i64; AXES]; 2];

const AXES: usize = 4;

/// The bounds of a box of two axes.
pub(crate) fn flat(corners: [[i64; 2]; 2]) -> Bounds {
    corners.map(|[x, y]| [x, 0, 0, y])
}

/// A binary tree of boxes: at each node half of them go to either side, by their centres along the axis along which these lie
/// farthest apart (a bounding volume hierarchy; Ericson, "Real-Time Collision Detection", 2005, section 6.2).
pub(crate) struct Boxes {
    /// The boxes' numbers, those of each node together.
    order: Vec<usize>,
    /// The bounds of the nodes: a node, then all nodes of its first half, then all of its second half.
    nodes: Vec<Bounds>,
    /// How many nodes were looked at.
    #[cfg(test)]
    pub(crate) looks: std::cell::Cell<usize>,
}

impl Boxes {
    pub(crate) fn new(boxes: &[Bounds]) -> Self {
        let mut tree = Self {
            order: (0..boxes.len()).collect(),
            nodes: Vec::new(),
            #[cfg(test)]
            looks: std::cell::Cell::default(),
        };
        let mut left = vec![[0, boxes.len()]];
        while let Some([start, end]) = left.pop().filter(|[start, end]| start < end) {
            let items = &mut tree.order[start..end];
            let twice_centre = |item: usize, axis: usize| boxes[item][0][axis] + boxes[item][1][axis];
            let (mut bounds, mut centres) =
                ([[i64::MAX; AXES], [i64::MIN; AXES]], [[i64::MAX; AXES], [i64::MIN; AXES]]);
            for &item in &*items {
                for axis in 0..AXES {
                    bounds[0][axis] = bounds[0][axis].min(boxes[item][0][axis]);
                    bounds[1][axis] = bounds[1][axis].max(boxes[item][1][axis]);
                    centres[0][axis] = centres[0][axis].min(twice_centre(item, axis));
                    centres[1][axis] = centres[1][axis].max(twice_centre(item, axis));
                }
            }
            tree.nodes.push(bounds);
            let half = items.len() / 2;
            if half > 0 {
                let axis =
                    (0..AXES).max_by_key(|&axis| centres[1][axis] - centres[0][axis]).unwrap_or_default();
                items.sort_unstable_by_key(|&item| (twice_centre(item, axis), item));
                let middle = start + half;
                left.extend([[middle, end], [start, middle]]);
            }
        }
        tree
    }

    /// The first box that is accepted, in the order of their lower ends along the last axis. `may_hold` says of the bounds of some
    /// boxes whether one of these may be wanted, and `accepts` of a box whether it is.
    pub(crate) fn first(
        &self,
        may_hold: &mut dyn FnMut(&Bounds) -> bool,
        accepts: &mut dyn FnMut(usize) -> bool,
    ) -> Option<usize> {
        let mut left = BinaryHeap::new();
        let mut meet = |node: usize, start: usize, end: usize, left: &mut BinaryHeap<_>| {
            #[cfg(test)]
            self.looks.set(self.looks.get() + 1);
            if let Some(bounds) = self.nodes.get(node).filter(|bounds| may_hold(bounds)) {
                left.push(Reverse((bounds[0][AXES - 1], node, start, end)));
            }
        };
        meet(0, 0, self.order.len(), &mut left);
        while let Some(Reverse((_, node, start, end))) = left.pop() {
            let half = (end - start) / 2;
            if half == 0 {
                let item = self.order[start];
                if accepts(item) {
                    return Some(item);
                }
            } else {
                let middle = start + half;
                meet(node + 1, start, middle, &mut left);
                meet(node + 2 * half, middle, end, &mut left); // n boxes have 2 n − 1 nodes
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{flat, Bounds, Boxes};

    #[test]
    fn boxes_are_found_in_order_without_a_look_at_all() {
        // Squares in a row, of which each reaches over the next two.
        let boxes: Vec<Bounds> = (0..1000).map(|i| flat([[i, i % 10], [i + 2, 20]])).collect();
        let tree = Boxes::new(&boxes);
        for x in [-1, 0, 2, 500, 1001, 1002] {
            let (mut looks, mut found) = (0, Vec::new());
            let mut holds = |&[low, high]: &Bounds| {
                looks += 1;
                low[0] <= x && x <= high[0]
            };
            let first = tree.first(&mut holds, &mut |item| {
                found.push(item as i64);
                false
            });
            assert!(first.is_none() && looks < 80, "{looks}");
            let mut wanted: Vec<i64> = (0..1000).filter(|i| (*i..=i + 2).contains(&x)).collect();
            wanted.sort_by_key(|i| i % 10);
            assert_eq!(found, wanted);
            assert_eq!(tree.first(&mut |_| true, &mut |item| item == 77), Some(77));
        }
        assert_eq!(Boxes::new(&[]).first(&mut |_| true, &mut |_| true), None);
    }
}
