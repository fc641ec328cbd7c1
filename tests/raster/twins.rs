//! Fast triangles against the plain ones: `fill_triangle`, into memory and as spans of any other target, draws the pixels that
//! `raster::triangle` defines, for triangles of every tier, clipped or not.

use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, Rgb888};
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::raster::Span;
use pinhole::{fill_triangle, Gouraud, Picture};
use support::bridge;
use support::oracle::cases::{self, CLASSES};
use support::oracle::coverage::{Area, P};
use support::oracle::rng::Rng;

const SIZE: (i64, i64) = (60, 50);
const WHITE: Gray8 = Gray8::WHITE;

/// A target of the size of `SIZE` that records spans and their colours.
#[derive(Default)]
struct Recorder {
    spans: Vec<Span>,
    colors: Vec<Gray8>,
}

impl Dimensions for Recorder {
    fn bounding_box(&self) -> Rectangle {
        bridge::rectangle(0, 0, SIZE.0 as u32, SIZE.1 as u32)
    }
}

impl DrawTarget for Recorder {
    type Color = Gray8;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(&mut self, _: I) -> Result<(), Infallible> {
        panic!("triangles are drawn as spans")
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Gray8>,
    {
        let Rectangle { top_left, size } = *area;
        let (width, height) = (size.width as i32, size.height as i32);
        self.spans.push(Span { x: top_left.x, y: top_left.y, width, height });
        self.colors.extend(colors);
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: Gray8) -> Result<(), Infallible> {
        let pixels = area.size.width * area.size.height;
        self.fill_contiguous(area, (0..pixels).map(|_| color))
    }
}

/// The pixels of spans that are one row each, in the order of the rows.
fn pixels(spans: &[Span]) -> impl Iterator<Item = usize> + '_ {
    spans.iter().flat_map(|s| (s.x..s.x + s.width).map(|x| s.y as usize * SIZE.0 as usize + x as usize))
}

fn assert_twins(t: [P; 3]) -> usize {
    let corners = t.map(bridge::screen_point);
    let plain = bridge::triangle_spans(t, Area::new(0, 0, SIZE.0, SIZE.1));
    let mut expected = vec![Gray8::BLACK; (SIZE.0 * SIZE.1) as usize];
    pixels(&plain).for_each(|at| expected[at] = WHITE);

    let (mut solid, mut smooth) = (Recorder::default(), Recorder::default());
    let mut memory = vec![Gray8::BLACK; expected.len()];
    let Ok(()) = fill_triangle(corners, WHITE, &mut solid);
    assert_eq!(solid.spans, plain, "{t:?}");
    let size = Size::new(SIZE.0 as u32, SIZE.1 as u32);
    let mut picture = Picture::new(&mut memory, size).expect("enough memory");
    let Ok(()) = fill_triangle(corners, WHITE, &mut picture.pixels());
    assert!(memory == expected, "{t:?}");

    // Colours of their own per pixel: spans to any target, and another loop over spans into memory.
    let colors = [Rgb888::new(10, 10, 10), Rgb888::new(90, 90, 90), Rgb888::new(250, 250, 250)];
    let Ok(()) = fill_triangle(corners, Gouraud::new(colors), &mut smooth);
    assert_eq!(smooth.spans, plain, "{t:?}");
    let mut expected = vec![Gray8::BLACK; expected.len()];
    pixels(&plain).zip(&smooth.colors).for_each(|(at, &color)| expected[at] = color);
    memory.fill(Gray8::BLACK);
    let mut picture = Picture::new(&mut memory, size).expect("enough memory");
    let Ok(()) = fill_triangle(corners, Gouraud::new(colors), &mut picture.pixels());
    assert!(memory == expected, "{t:?}");
    plain.len()
}

#[test]
fn triangles_of_every_class_are_those_of_the_definition() {
    let mut rng = Rng::new(0x7313);
    let mut rows = 0;
    for class in CLASSES {
        for _ in 0..5000 {
            rows += assert_twins(cases::triangle(&mut rng, class));
        }
    }
    assert!(rows > 50_000, "{rows}");
}

/// Extents at the limits of the tiers, 32 × 30, 31 and 32 rows, inside the target and across its borders.
#[test]
fn triangles_at_the_limits_of_the_tiers_are_those_of_the_definition() {
    let mut rng = Rng::new(0x7314);
    let mut rows = 0;
    for _ in 0..40_000 {
        let limit =
            |rng: &mut Rng| [256, 7680, 7681, 7936, 7937, 8160, 8161, 8191, 8192, 12_000][rng.below(10)];
        let (width, height) = (limit(&mut rng), limit(&mut rng));
        let inside = rng.one_in(2);
        let mut first = |size: i64, extent: i64| {
            if inside {
                rng.int(0, (256 * size - extent).max(0))
            } else {
                rng.int(-extent, 256 * size)
            }
        };
        let (x, y) = (first(SIZE.0, width), first(SIZE.1, height));
        let mut t = [(x, y), (x + width, y + rng.int(0, height)), (x + rng.int(0, width), y + height)];
        rng.shuffle(&mut t);
        rows += assert_twins(t);
    }
    assert!(rows > 300_000, "{rows}");
}
