//! Rectangles that changed are merged where that sends no more bytes.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::bands::{DirtyRegions, TransferCost};
use support::bridge::rectangle as at;

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));

fn taken<const N: usize>(bits: u32, marks: &[Rectangle]) -> Vec<Rectangle> {
    let mut dirty = DirtyRegions::<N>::new(SCREEN, TransferCost::new(bits, TransferCost::MIPI_DCS));
    assert_eq!(dirty.take(), [SCREEN]);
    marks.iter().for_each(|r| dirty.mark(*r));
    dirty.take().to_vec()
}

/// A gap of 5 pixels of 16 bits takes 10 bytes, fewer than the 11 bytes of commands of a second rectangle; a gap of 6 takes
/// more.
#[test]
fn two_marks_are_merged_where_that_takes_no_more_bytes() {
    assert_eq!(taken::<8>(16, &[at(0, 0, 9, 5), at(10, 0, 9, 5)]), [at(0, 0, 19, 5)]);
    assert_eq!(taken::<8>(16, &[at(0, 0, 9, 6), at(10, 0, 9, 6)]), [at(0, 0, 9, 6), at(10, 0, 9, 6)]);
    assert_eq!(taken::<8>(24, &[at(0, 0, 9, 4), at(10, 0, 9, 4)]), [at(0, 0, 9, 4), at(10, 0, 9, 4)]);
    assert_eq!(taken::<8>(16, &[at(7, 7, 9, 9), at(8, 8, 2, 2), at(7, 7, 9, 9)]), [at(7, 7, 9, 9)]);
}

#[test]
fn no_pixel_is_sent_twice() {
    // A stem under a bar, the bar first or last.
    let (bar, stem) = (at(0, 20, 100, 10), at(40, 25, 10, 100));
    for marks in [[bar, stem], [stem, bar]] {
        assert_eq!(taken::<8>(16, &marks), [bar, at(40, 30, 10, 95)]);
    }
    // An object that moved by half its size: its new square, and the L that it left.
    let moved = [at(10, 10, 40, 40), at(30, 30, 40, 40)];
    assert_eq!(taken::<8>(16, &moved).len(), 3);
    assert_eq!(taken::<2>(16, &moved), moved); // no room for three
    let mut pixels: u32 = 0;
    for r in taken::<8>(16, &moved) {
        pixels += r.size.width * r.size.height;
    }
    assert_eq!(pixels, 2 * 1600 - 400);
}

/// A square moved by d pixels along both axes: one rectangle around both has 2·d² pixels of 2 bytes that lie in neither, and
/// saves two windows of 11 bytes.
#[test]
fn corners_in_neither_square_are_left_out() {
    let moved = |d: i32| taken::<8>(16, &[at(10, 10, 40, 40), at(10 + d, 10 + d, 40, 40)]);
    assert_eq!(moved(2), [at(10, 10, 42, 42)]);
    assert_eq!(moved(3), [at(10, 10, 40, 40), at(50, 13, 3, 37), at(13, 50, 40, 3)]);
}

#[test]
fn without_room_the_two_whose_merging_loses_least_are_merged() {
    let far = [at(0, 0, 20, 20), at(200, 200, 20, 20), at(200, 0, 20, 20)];
    let near = at(225, 0, 10, 20);
    for order in [[far[0], far[1], far[2], near], [near, far[2], far[1], far[0]]] {
        assert_eq!(taken::<3>(16, &order), [far[0], at(200, 0, 35, 20), far[1]]);
    }
    assert_eq!(taken::<1>(16, &far), [at(0, 0, 220, 220)]);
}
