//! Passes the oracles' plain numbers to the library and its answers back, and compares them. It does no arithmetic.

pub mod compare;
pub mod draw;
pub mod pair;
pub mod texels;
pub mod ways;

use crate::oracle::coverage::{Area, Counts, P};
use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::{BinaryColor, PixelColor};
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::draw::{draw_line, fill_triangle};
use pinhole::prelude::*;
use pinhole::raster::{ScreenPoint, Span};
use pinhole::target::LeastRun;

pub fn scalar(bits: i32) -> Scalar {
    Scalar::from_bits(bits)
}

pub fn point<S>(bits: [i32; 3]) -> Point3<S> {
    let [x, y, z] = bits.map(scalar);
    Point3::new(x, y, z)
}

pub fn vector<S>(bits: [i32; 3]) -> Vector3<S> {
    let [x, y, z] = bits.map(scalar);
    Vector3::new(x, y, z)
}

/// The coordinates of a point, as reals.
pub fn reals<S>(p: Point3<S>) -> [f64; 3] {
    [p.x(), p.y(), p.z()].map(|c| f64::from(c.to_bits()) / 65536.0)
}

pub fn viewport(x: i32, y: i32, width: u32, height: u32) -> Viewport {
    let Rectangle { top_left, size } = rectangle(x, y, width, height);
    Viewport::new(top_left, size).expect("a viewport")
}

pub fn rectangle(x: i32, y: i32, width: u32, height: u32) -> Rectangle {
    Rectangle::new(Point::new(x, y), Size::new(width, height))
}

pub fn screen_point(p: P) -> ScreenPoint {
    let (Ok(x), Ok(y)) = (i32::try_from(p.0), i32::try_from(p.1)) else {
        panic!("{p:?} is no i32");
    };
    ScreenPoint::from_subpixels(x, y).expect("inside the guard band")
}

pub fn pixel(p: P) -> Point {
    let (Ok(x), Ok(y)) = (i32::try_from(p.0), i32::try_from(p.1)) else {
        panic!("{p:?} is no i32");
    };
    Point::new(x, y)
}

/// A target that is not the library's: it keeps the spans that it is filled with, each as a rectangle of one row or one column, and the
/// colours of their pixels.
pub struct Spans<C> {
    area: Rectangle,
    pub spans: Vec<Span>,
    pub colors: Vec<C>,
}

impl<C> Spans<C> {
    /// Of an area whose bounds may lie anywhere; those on the wrong side of each other make it empty.
    pub fn new(area: Area) -> Self {
        let clamped = |c: i64| c.clamp(i64::from(i32::MIN), i64::from(i32::MAX));
        let size = |low: i64, high: i64| u32::try_from(clamped(high) - clamped(low)).unwrap_or(0);
        let at = Point::new(clamped(area.left) as i32, clamped(area.top) as i32);
        let size = Size::new(size(area.left, area.right), size(area.top, area.bottom));
        Self { area: Rectangle::new(at, size), spans: Vec::new(), colors: Vec::new() }
    }
}

impl<C> Dimensions for Spans<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Spans<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, _: I) -> Result<(), Infallible> {
        panic!("triangles and lines are drawn as spans")
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = C>,
    {
        let Rectangle { top_left: Point { x, y }, size: Size { width, height } } = *area;
        self.spans.push(Span { x, y, width: width as i32, height: height as i32 });
        self.colors.extend(colors);
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: C) -> Result<(), Infallible> {
        let pixels = area.size.width * area.size.height;
        self.fill_contiguous(area, (0..pixels).map(|_| color))
    }
}

/// All spans of a triangle.
pub fn triangle_spans(t: [P; 3], area: Area) -> Vec<Span> {
    let mut target = Spans::new(area);
    let Ok(()) = fill_triangle(t.map(screen_point), BinaryColor::On, &mut target);
    target.spans
}

/// All spans of a line.
pub fn line_spans(a: P, b: P, area: Area) -> Vec<Span> {
    let mut target = Spans::new(area);
    let Ok(()) = draw_line(pixel(a), pixel(b), BinaryColor::On, &mut LeastRun::<_, 1>(&mut target));
    target.spans
}

/// The pixels of spans; panics if a span is not one row or column, or leaves the area.
pub fn counts(spans: &[Span], area: Area) -> Counts {
    let mut counts = Counts::new(area);
    for s in spans {
        assert!(s.width >= 1 && s.height >= 1 && (s.width == 1 || s.height == 1), "{s:?} is no span");
        for y in 0..i64::from(s.height) {
            for x in 0..i64::from(s.width) {
                counts.hit(i64::from(s.x) + x, i64::from(s.y) + y);
            }
        }
    }
    counts
}

/// The triangle as the library draws it. At most one span a row, as a triangle is convex.
pub fn triangle(t: [P; 3], area: Area) -> Counts {
    let spans = triangle_spans(t, area);
    let mut rows: Vec<_> = spans.iter().map(|s| s.y).collect();
    rows.sort_unstable();
    rows.dedup();
    assert_eq!(rows.len(), spans.len(), "{t:?}: a row in several spans");
    counts(&spans, area)
}

pub fn line(a: P, b: P, area: Area) -> Counts {
    counts(&line_spans(a, b, area), area)
}
