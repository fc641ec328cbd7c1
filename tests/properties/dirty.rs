//! Dirty regions against sets of pixels.

use crate::cases;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::bands::{DirtyRegions, TransferCost};
use proptest::prelude::*;
use std::collections::BTreeSet;

type Pixels = BTreeSet<(i64, i64)>;

/// Left, top, right and bottom: the last two are outside.
type Borders = [i64; 4];

fn borders(r: &Rectangle) -> Borders {
    let (x, y) = (i64::from(r.top_left.x), i64::from(r.top_left.y));
    [x, y, x + i64::from(r.size.width), y + i64::from(r.size.height)]
}

/// A target and its transfer cost.
#[derive(Clone, Debug)]
struct Target {
    area: Rectangle,
    steps: (u16, u16),
    bits: u32,
    window: u16,
}

impl Target {
    fn dirty<const N: usize>(&self) -> DirtyRegions<N> {
        let dirty = DirtyRegions::new(self.area, TransferCost::new(self.bits, self.window));
        dirty.with_steps(self.steps.0, self.steps.1)
    }

    /// The whole steps that a rectangle touches, or `None` where it is empty or outside.
    fn rounded(&self, r: &Rectangle) -> Option<Borders> {
        let [left, top, right, bottom] = borders(&self.area);
        let [l, t, r, b] = borders(r);
        let (l, t, r, b) = (l.max(left), t.max(top), r.min(right), b.min(bottom));
        let (columns, rows) = (i64::from(self.steps.0), i64::from(self.steps.1));
        let down = |v: i64, start: i64, step: i64| start + (v - start).div_euclid(step) * step;
        let up = |v: i64, start: i64, step: i64| start - (start - v).div_euclid(step) * step;
        (l < r && t < b)
            .then(|| [down(l, left, columns), down(t, top, rows), up(r, left, columns), up(b, top, rows)])
    }

    fn pixels<'a>(&self, all: impl IntoIterator<Item = &'a Rectangle>) -> Pixels {
        let [.., right, bottom] = borders(&self.area);
        all.into_iter()
            .filter_map(|r| self.rounded(r))
            .flat_map(|[l, t, r, b]| {
                (t..b.min(bottom)).flat_map(move |y| (l..r.min(right)).map(move |x| (x, y)))
            })
            .collect()
    }

    /// Bytes to send one window: each row of pixels takes a whole number of bytes.
    fn bytes([l, t, r, b]: Borders, steps: (u16, u16), bits: u32, window: u16) -> i64 {
        let (columns, rows) = (i64::from(steps.0), i64::from(steps.1));
        let cell = columns * rows * i64::from(bits);
        let row = ((r - l) / columns * cell + 7) / 8;
        row * ((b - t) / rows) + i64::from(window)
    }

    fn cost<'a>(&self, all: impl IntoIterator<Item = &'a Rectangle>) -> i64 {
        let each = all.into_iter().filter_map(|r| self.rounded(r));
        each.map(|r| Self::bytes(r, self.steps, self.bits, self.window)).sum()
    }

    fn cost_in_one<'a>(&self, all: impl IntoIterator<Item = &'a Rectangle>) -> i64 {
        let each = all.into_iter().filter_map(|r| self.rounded(r));
        let about = |a: Borders, b: Borders| [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])];
        each.reduce(about).map_or(0, |r| Self::bytes(r, self.steps, self.bits, self.window))
    }
}

fn rectangle(low: i32, high: i32, size: u32) -> impl Strategy<Value = Rectangle> {
    (low..high, low..high, 0..size, 0..size)
        .prop_map(|(x, y, width, height)| Rectangle::new(Point::new(x, y), Size::new(width, height)))
}

fn target() -> impl Strategy<Value = Target> {
    let steps = prop::sample::select(vec![(1, 1), (2, 1), (1, 8), (3, 2)]);
    let bits = prop::sample::select(vec![1, 4, 16, 24]);
    let window = prop::sample::select(vec![0, 3, 11, 100]);
    (rectangle(-9, 9, 48), steps, bits, window).prop_map(|(area, steps, bits, window)| Target {
        area,
        steps,
        bits,
        window,
    })
}

/// Frames with a few marks each; now and then the target is lost.
fn frames(marks: usize) -> impl Strategy<Value = Vec<(Vec<Rectangle>, bool)>> {
    let marks = prop::collection::vec(
        prop_oneof![rectangle(-20, 50, 12), rectangle(-20, 50, 60), rectangle(0, 20, 4)],
        0..marks,
    );
    prop::collection::vec((marks, prop::bool::weighted(0.1)), 1..6)
}

fn holds<const N: usize>(target: &Target, frames: &[(Vec<Rectangle>, bool)]) -> Result<(), TestCaseError> {
    let mut dirty = target.dirty::<N>();
    let (mut last, mut all) = (Vec::new(), true);
    for (marks, lost) in frames {
        marks.iter().for_each(|r| dirty.mark(*r));
        if *lost {
            dirty.invalidate();
        }
        let taken = dirty.take();
        if all || *lost {
            let area = &target.area;
            let empty = area.size.width == 0 || area.size.height == 0;
            prop_assert_eq!(&taken[..], if empty { &[][..] } else { std::slice::from_ref(area) });
        } else {
            let both = || last.iter().chain(marks);
            prop_assert!(taken.len() <= N);
            // Nothing is lost, and nothing sent that is outside the area or an incomplete step.
            let sent = target.pixels(&taken);
            prop_assert!(target.pixels(both()).is_subset(&sent), "{:?}", taken);
            for r in &taken {
                let [.., right, bottom] = borders(&target.area);
                let [x0, y0, x1, y1] = target.rounded(r).expect("not empty, and in the area");
                prop_assert_eq!(borders(r), [x0, y0, x1.min(right), y1.min(bottom)]);
            }
            // From top to bottom, none twice.
            let corners: Vec<_> = taken.iter().map(|r| (r.top_left.y, r.top_left.x)).collect();
            prop_assert!(corners.is_sorted(), "{:?}", taken);
            // Bytes.
            let cost = target.cost(&taken);
            prop_assert!(cost <= target.cost_in_one(both()), "{:?}", taken);
            if last.len() + marks.len() <= N {
                prop_assert!(cost <= target.cost(both()), "{:?}", taken);
            }
        }
        (last, all) = (marks.clone(), false);
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(2_000))]

    #[test]
    fn dirty_regions_with_enough_room_cover_every_change(target in target(), frames in frames(5)) {
        holds::<8>(&target, &frames)?;
    }

    #[test]
    fn dirty_regions_with_too_little_room_cover_every_change(target in target(), frames in frames(12)) {
        holds::<1>(&target, &frames)?;
        holds::<2>(&target, &frames)?;
        holds::<5>(&target, &frames)?;
    }

    /// Whatever numbers a rectangle has.
    #[test]
    fn dirty_regions_at_the_ends_of_i32_do_not_wrap(
        area in (any::<i32>(), any::<i32>(), any::<u32>(), any::<u32>()),
        marks in prop::collection::vec((any::<i32>(), any::<i32>(), any::<u32>(), any::<u32>()), 0..9),
        steps in (any::<u16>(), any::<u16>()),
        cost in (any::<u32>(), any::<u16>()),
    ) {
        let rectangle = |(x, y, w, h)| Rectangle::new(Point::new(x, y), Size::new(w, h));
        let area = rectangle(area);
        let mut dirty = DirtyRegions::<4>::new(area, TransferCost::new(cost.0, cost.1)).with_steps(steps.0, steps.1);
        let [left, top, ..] = borders(&area);
        let [.., right, bottom] = borders(&dirty.area());
        prop_assert!(dirty.take().len() <= 1);
        marks.iter().for_each(|r| dirty.mark(rectangle(*r)));
        let taken = dirty.take();
        let inside = |r: &Rectangle| {
            let [l, t, r, b] = borders(r);
            left <= l && l < r && r <= right && top <= t && t < b && b <= bottom
        };
        prop_assert!(taken.iter().all(inside), "{taken:?}");
        // The first pixel of every mark that lies in the area.
        for [l, t, r, b] in marks.iter().map(|r| borders(&rectangle(*r))) {
            let (x, y) = (l.max(left), t.max(top));
            if x < r.min(right) && y < b.min(bottom) && x <= i64::from(i32::MAX) && y <= i64::from(i32::MAX) {
                let holds = |r: &Rectangle| {
                    let [l, t, r, b] = borders(r);
                    l <= x && x < r && t <= y && y < b
                };
                prop_assert!(taken.iter().any(holds), "{x}, {y} in {taken:?}");
            }
        }
    }
}

/// In a static, as a firmware's may be: the area is cut, and steps of nothing are steps of one.
#[test]
fn dirty_regions_can_be_built_at_compile_time() {
    const AREA: Rectangle = Rectangle::new(Point::new(-3, 5), Size::new(70_000, 9));
    const DIRTY: DirtyRegions<2> = DirtyRegions::new(AREA, TransferCost::new(4, 6)).with_steps(2, 0);
    let mut dirty = DIRTY;
    assert_eq!(dirty.area(), Rectangle::new(AREA.top_left, Size::new(65_535, 9)));
    assert_eq!(dirty.take(), [dirty.area()]);
    dirty.mark(Rectangle::new(Point::new(0, 6), Size::new(2, 1)));
    // Columns count from -3 in twos.
    assert_eq!(dirty.take(), [Rectangle::new(Point::new(-1, 6), Size::new(4, 1))]);
}
