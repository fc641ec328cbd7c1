//! L1–L3: line pixels equal the exact ones, in every octant, under every scissor, in every order of the ends; each run is one span.
//! Into any DrawTarget and into memory: equal pixels through single pixels, through fills and in memory; the number of calls, their
//! order, and errors.

use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::Gray8;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::{
    draw::draw_line,
    target::{LeastRun, Pixels, Surface},
};
use support::bridge;
use support::bridge::compare::line_both_ways as both_ways;
use support::oracle::cases;
use support::oracle::coverage::Area;
use support::oracle::line::{self, P};
use support::oracle::rng::Rng;
use support::oracle::target::{Call, Recorder, Refused};

const INK: Gray8 = Gray8::new(1);

fn rectangle(area: Area) -> Rectangle {
    let (from, to) = ((area.left as i32, area.top as i32), (area.right as i32, area.bottom as i32));
    Rectangle::new(Point::new(from.0, from.1), Size::new((to.0 - from.0) as u32, (to.1 - from.1) as u32))
}

/// Draws a line in either direction into a recorder whose least run is `N`, and compares the pixels with the oracle's. Returns
/// the calls.
fn check<const N: u16>(a: P, b: P, area: Area) -> Vec<Call<Gray8>> {
    let mut exact: Vec<_> =
        line::clipped(a, b, area).into_iter().map(|(x, y)| ((x as i32, y as i32), (INK, 1))).collect();
    exact.sort_unstable_by_key(|&(at, _)| at);
    let mut calls = [a, b].map(|first| {
        let mut target = Recorder::new(rectangle(area));
        let (from, to) = (bridge::pixel(first), bridge::pixel(if first == a { b } else { a }));
        draw_line(from, to, INK, &mut LeastRun::<_, N>(&mut target)).expect("no failure");
        assert_eq!(target.outside, 0, "{a:?} {b:?} {area:?}");
        assert!(target.pixels.into_iter().eq(exact.iter().copied()), "{a:?} {b:?} {area:?} {N}");
        target.calls
    });
    assert_eq!(calls[0], calls[1], "{a:?} {b:?} {area:?}");
    core::mem::take(&mut calls[0])
}

/// The loops that draw lines into memory, in either direction, with and without gaps between rows; memory behind the picture must not change.
fn check_memory(a: P, b: P, area: Area) {
    let stride = area.width() + if a.1 % 2 == 0 { 0 } else { 2 };
    let count = stride * area.height();
    let mut exact = vec![Gray8::new(0); count + 3];
    for (x, y) in line::clipped(a, b, area) {
        exact[(y - area.top) as usize * stride + (x - area.left) as usize] = INK;
    }
    for [a, b] in [[a, b], [b, a]] {
        let mut memory = vec![Gray8::new(0); count + 3];
        let mut target = Pixels::with_stride(&mut memory, rectangle(area), stride).expect("enough memory");
        let Ok(()) = draw_line(bridge::pixel(a), bridge::pixel(b), INK, &mut target);
        assert!(memory == exact, "{a:?} {b:?} {area:?}");
    }
}

/// Compares every way to draw a line, and `raster::line`, and the number of calls of each. Returns the number of calls and of fills.
fn check_calls(a: P, b: P, area: Area) -> (usize, usize) {
    check_memory(a, b, area);
    both_ways(a, b, area);
    let is_fill = |call: &Call<Gray8>| matches!(call, Call::Solid(..));
    let (fills, few, pixels, some) = (
        check::<1>(a, b, area),
        check::<8>(a, b, area),
        check::<{ u16::MAX }>(a, b, area),
        check::<3>(a, b, area),
    );
    assert!(fills.iter().all(is_fill), "{a:?} {b:?}");
    let count = line::clipped(a, b, area).len();
    if cfg!(pinhole_plain) {
        assert!(few == fills && pixels == fills && some == fills);
        return (count, few.len());
    }
    let (width, height) = ((b.0 - a.0).abs(), (b.1 - a.1).abs());
    let is_inside = area.contains(a.0, a.1) && area.contains(b.0, b.1);
    for (least, calls) in [(8, &few), (u16::MAX.into(), &pixels), (3, &some)] {
        let is_flat = width >= height && (height + 1) * least <= width + 1;
        if is_inside && !is_flat && width.max(height) <= 6688 {
            assert_eq!(calls[..], [Call::Pixels(count)], "{a:?} {b:?} {area:?} {least}");
        } else {
            assert_eq!(calls, &fills, "{a:?} {b:?} {least}: one fill for each run");
        }
    }
    (few.len(), fills.len())
}

#[test]
fn l1_every_line_in_every_octant() {
    for a in [(12, 12), (2, 3), (21, 20)] {
        for (x, y) in Area::new(-4, -4, 29, 29).pixels() {
            check_calls(a, (x, y), Area::new(0, 0, 25, 24));
        }
    }
}

#[test]
fn l2_lines_on_targets_of_every_shape_take_few_calls() {
    let mut rng = Rng::new(0x4C50);
    let (mut few, mut fills) = (0, 0);
    for (width, height) in
        [(1, 1), (1, 40), (40, 1), (2, 2), (2, 60), (60, 2), (37, 53), (240, 17), (240, 240)]
    {
        let (left, top) = (rng.int(-300, 300), rng.int(-300, 300));
        let area = Area::new(left, top, left + width, top + height);
        for _ in 0..500 {
            let mut end = || (left + rng.int(-3, width + 2), top + rng.int(-3, height + 2));
            let counts = check_calls(end(), end(), area);
            (few, fills) = (few + counts.0, fills + counts.1);
        }
    }
    assert!(few * 2 < fills || cfg!(pinhole_plain), "{few} of {fills}");
}

#[test]
fn l2_lines_to_the_ends_of_the_range() {
    let mut rng = Rng::new(0x4C51);
    for _ in 0..20_000 {
        let (a, b) = cases::line(&mut rng);
        let (width, height) = [(64, 48), (48, 70), (5, 90), (2, 9)][rng.below(4)];
        check_memory(a, b, Area::new(0, 0, width, height));
    }
    for _ in 0..1000 {
        let (a, b) = cases::line(&mut rng);
        let (width, height) = [(64, 48), (48, 70), (5, 90), (700, 600)][rng.below(4)];
        check_calls(a, b, Area::new(0, 0, width, height));
    }
}

/// A slope in 32 bits is exact for lines of up to 6688 pixels.
#[test]
fn l2_the_longest_lines_are_exact() {
    let mut rng = Rng::new(0x4C52);
    let all = Area::new(-32_768, -32_768, 32_768, 32_768);
    for length in [6686, 6687, 6688, 6689, 65_535] {
        for minor in [0, 1, 2, length / 3, length / 2, length - 1, length, rng.int(0, length)] {
            let (low, minor_low) = (-(length / 2) - 1, -(minor / 2) - 1);
            let (a, b) = ((low, minor_low), (low + length, minor_low + minor));
            let swapped = |(x, y): P| (y, x);
            let mirrored = |(x, y): P| (x, -1 - y);
            check::<{ u16::MAX }>(a, b, all);
            check::<{ u16::MAX }>(mirrored(a), mirrored(b), all);
            check::<{ u16::MAX }>(swapped(a), swapped(b), all);
            check::<{ u16::MAX }>(swapped(mirrored(a)), swapped(mirrored(b)), all);
        }
    }
}

#[test]
fn l2_the_longest_lines_of_each_loop_into_memory_are_exact() {
    // A slope in 32 bits is for lines up to 6688; in narrow pictures, whole, and in wide ones, cut.
    let mut rng = Rng::new(0x4C4B);
    let check = |a: P, b: P, (width, height): (i64, i64)| check_memory(a, b, Area::new(0, 0, width, height));
    for length in [6600, 6687, 6688, 6689, 6690, 8000] {
        for width in [2, 5, 30] {
            for rise in [0, 1, width - 1, rng.int(0, width - 1)] {
                check((0, 0), (rise, length), (width, length + 1));
                check((0, length), (rise, 0), (width, length + 1));
                check((0, 0), (length, rise), (length + 1, width));
                check((0, rise), (length, 0), (length + 1, width));
            }
        }
        for _ in 0..400 {
            // Through the middle of a picture, at any slope.
            let (x, y) = (rng.int(0, 40), rng.int(0, 40));
            let (dx, dy) = (rng.int(-length / 2, length / 2), length / 2);
            check((x - dx, y - dy), (x + dx, y - dy + length), (41, 41));
            check((x - dy, y - dx), (x - dy + length, y + dx), (41, 41));
        }
    }
}

/// A target in memory that remembers the pixels in their order, and how many calls brought them.
struct Ordered {
    pixels: Vec<Point>,
    calls: usize,
}

impl Dimensions for Ordered {
    fn bounding_box(&self) -> Rectangle {
        Rectangle::new(Point::new(-50, -50), Size::new(100, 100))
    }
}

impl DrawTarget for Ordered {
    type Color = Gray8;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        self.calls += 1;
        self.pixels.extend(pixels.into_iter().map(|Pixel(at, _)| at));
        Ok(())
    }
}

#[test]
fn pixels_come_in_the_order_of_a_window() {
    let mut rng = Rng::new(0x4C53);
    for _ in 0..2000 {
        let mut end = || (rng.int(-50, 49), rng.int(-50, 49));
        let (a, b) = (end(), end());
        let mut target = Ordered { pixels: Vec::new(), calls: 0 };
        let Ok(()) =
            draw_line(bridge::pixel(a), bridge::pixel(b), INK, &mut LeastRun::<_, { u16::MAX }>(&mut target));
        let is_steep = line::is_steep(a, b);
        let is_next = |p: &[Point]| if is_steep { p[1].y == p[0].y + 1 } else { p[1].x == p[0].x + 1 };
        assert!(
            cfg!(pinhole_plain) || target.pixels.windows(2).all(is_next),
            "{a:?} {b:?} {:?}",
            target.pixels
        );
    }
}

/// Columns and rows that 16 bits do not hold count as the nearest that they do.
#[test]
fn ends_far_away_are_moved_to_the_border_of_16_bits() {
    for [x, y] in [[i32::MAX, 40_000], [-40_000, i32::MIN], [40_000, 7]] {
        let near = [x, y].map(|at| at.clamp(-32_768, 32_767));
        let [far, near] = [[x, y], near].map(|[x, y]| {
            let mut target = Recorder::sized(100, 100);
            assert_eq!(draw_line(Point::new(x, y), Point::new(20, 40), INK, &mut target), Ok(()));
            target.calls
        });
        assert_eq!(far, near);
    }
}

/// The type of the error decides: none means memory, and a call for a line; else a fill for each run.
#[test]
fn a_target_that_cannot_fail_gets_a_line_in_one_call() {
    let (a, b) = (bridge::pixel((0, 0)), bridge::pixel((20, 40)));
    let mut target = Ordered { pixels: Vec::new(), calls: 0 };
    let Ok(()) = draw_line(a, b, INK, &mut target);
    assert_eq!((target.pixels.len(), target.calls), (41, if cfg!(pinhole_plain) { 21 } else { 1 }));

    let mut target = Recorder::sized(100, 100);
    assert_eq!(draw_line(a, b, INK, &mut target), Ok(()));
    assert_eq!((target.calls.len(), target.pixel_by_pixel()), (21, false));

    /// An enum, like the error of a driver whose bus cannot fail.
    #[allow(dead_code)]
    enum NoError {
        Bus(Infallible),
        Pin(Infallible),
    }
    struct Driver;
    impl Dimensions for Driver {
        fn bounding_box(&self) -> Rectangle {
            Rectangle::zero()
        }
    }
    impl DrawTarget for Driver {
        type Color = Gray8;
        type Error = NoError;
        fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(&mut self, _: I) -> Result<(), NoError> {
            Ok(())
        }
    }
    assert_eq!([<Driver as Surface>::LEAST_RUN, <Recorder<Gray8> as Surface>::LEAST_RUN], [16, 1]);
    assert_eq!(<LeastRun<'_, Driver, 5> as Surface>::LEAST_RUN, 5);
}

#[test]
fn the_first_error_ends_the_line() {
    fn test<const N: u16>() {
        // A flat line of 21 runs, a tall one, and a clipped one.
        for (a, b) in [((0, 0), (400, 20)), ((3, 90), (9, 0)), ((-9000, 0), (9000, 70))] {
            let count = check::<N>(a, b, Area::new(0, 0, 1200, 100)).len();
            for fails_at in 0..=count {
                let mut target = Recorder::failing(1200, 100, fails_at);
                let result =
                    draw_line(bridge::pixel(a), bridge::pixel(b), INK, &mut LeastRun::<_, N>(&mut target));
                assert_eq!(result, if fails_at < count { Err(Refused(fails_at)) } else { Ok(()) });
                assert_eq!(target.calls.len(), count.min(fails_at + 1), "{a:?} {b:?} {N}");
            }
        }
    }
    test::<1>();
    test::<3>();
    test::<8>();
    test::<{ u16::MAX }>();
}

/// A target that takes spans, and `draw_pixels` as the trait has it.
struct Spans(Recorder<Gray8>);

impl Surface for Spans {
    type Color = Gray8;
    type Error = Refused;
    type Store = [Gray8; 0];
    const LEAST_RUN: u16 = 4;

    fn area(&self) -> Rectangle {
        self.0.bounding_box()
    }
    fn fill(&mut self, span: pinhole::raster::Span, color: Gray8) -> Result<(), Refused> {
        self.0.fill(span, color)
    }
    fn fill_run(
        &mut self,
        span: pinhole::raster::Span,
        colors: impl Iterator<Item = Gray8>,
    ) -> Result<(), Refused> {
        self.0.fill_run(span, colors)
    }
}

#[test]
fn pixels_are_spans_by_default() {
    for (a, b) in [((1, 2), (30, 40)), ((30, 2), (1, 20)), ((0, 0), (50, 5)), ((-20, -3), (90, 50))] {
        let mut target = Spans(Recorder::sized(60, 50));
        assert_eq!(draw_line(bridge::pixel(a), bridge::pixel(b), INK, &mut target), Ok(()));
        let exact = line::clipped(a, b, Area::new(0, 0, 60, 50));
        assert_eq!(target.0.pixels.len(), exact.len());
        assert!(exact.iter().all(|&(x, y)| target.0.count(x as i32, y as i32) == 1));
        assert!(!target.0.pixel_by_pixel());
    }
}

/// The documented range ends at −32767; the type holds one more. No panic, no wrapped line.
#[test]
fn l2_lines_to_the_ends_of_i16_do_not_wrap() {
    let low = -32_768;
    for (a, b) in [
        ((low, low), (32_767, 32_767)),
        ((low, 32_767), (32_767, low)),
        ((low, 0), (32_767, 1)),
        ((0, low), (1, 32_767)),
        ((low, low), (low, low)),
        ((low, 3), (low + 9, 5)),
    ] {
        for s in [0, 1 << 19, 1 << 20] {
            let x = a.0 + (((b.0 - a.0) * s) >> 20);
            let y = a.1 + (((b.1 - a.1) * s) >> 20);
            both_ways(a, b, Area::new(x - 5, y - 5, x + 6, y + 6));
        }
    }
}
