//! Arguments beyond their documented range: weights of a clipped corner and spans that leave the area.

use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics::prelude::Size;
use pinhole::clip::{Barycentric, Varying};
use pinhole::raster::Span;
use pinhole::{Picture, Target};

/// A parameter beyond its range counts as the nearer end of the range.
#[test]
fn weights_stay_between_both_ends_whatever_the_parameter() {
    let (from, to) = (Barycentric::of(0), Barycentric::of(1));
    for below in [-1, -(1 << 31), i64::MIN] {
        assert_eq!(from.towards(&to, below).weights(), [1 << 30, 0, 0], "{below}");
    }
    let last = from.towards(&to, (1 << 31) - 1);
    for beyond in [1 << 31, 1 << 32, (1 << 32) + (1 << 30), i64::MAX] {
        assert_eq!(from.towards(&to, beyond), last, "{beyond}");
    }
}

/// Repeated steps beyond the range neither leave it nor overflow.
#[test]
fn weights_of_many_steps_stay_in_range() {
    let corners = [0, 1, 2].map(Barycentric::of);
    for step in [i64::MIN, -(1 << 32), -1, 1 << 31, 3 << 31, i64::MAX] {
        let mut point = corners[0];
        for turn in 0..200 {
            point = point.towards(&corners[turn % 3], step);
            let weights = point.weights();
            assert_eq!(weights.iter().map(|&weight| i64::from(weight)).sum::<i64>(), 1 << 30);
            // Half a unit for each rounding of two weights.
            let slack = turn as i32 + 1;
            assert!(
                weights.iter().all(|weight| (-slack..=(1 << 30) + slack).contains(weight)),
                "{weights:?}"
            );
        }
    }
}

/// The rows of a span that lie outside of the picture are left out, however many there are: this test would take minutes
/// if they were visited, and with 32-bit indices a row far outside could be taken for one inside.
#[test]
fn a_span_higher_than_the_picture_fills_its_rows_alone() {
    let fill = |span: Span| {
        let mut memory = [Rgb565::BLACK; 4 * 3];
        let mut picture = Picture::new(&mut memory, Size::new(4, 3)).unwrap();
        let mut pixels = picture.pixels();
        (0..1000).for_each(|_| pixels.fill(span, Rgb565::WHITE).unwrap());
        memory.map(|pixel| i32::from(pixel == Rgb565::WHITE))
    };
    let column = [0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0];
    let high = [(0, i32::MAX), (0, 3), (-5, i32::MAX), (i32::MIN, i32::MAX), (i32::MIN + 3, i32::MAX)];
    let drawn = high.map(|(y, height)| fill(Span { x: 1, y, width: 1, height }));
    // Rows up to −1 + i32::MIN + i32::MAX = −2, and with three more up to 1.
    assert_eq!(drawn, [column, column, column, [0; 12], [0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(fill(Span { x: 1, y: 2, width: 2, height: i32::MAX }), [0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0]);
    assert_eq!(fill(Span { x: 1, y: 3, width: 2, height: i32::MAX }), [0; 12]);
    assert_eq!(fill(Span { x: 1, y: 1, width: 2, height: -5 }), [0; 12]);
}
