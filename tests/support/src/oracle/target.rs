//! Draw targets that record the calls of the library.

use super::coverage::Area;
use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use std::collections::BTreeMap;

/// A call that reached the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Call<C> {
    Solid(Rectangle, C),
    /// The rectangle and the number of colours that came.
    Contiguous(Rectangle, usize),
    /// The number of single pixels that came.
    Pixels(usize),
    Clear,
}

/// Records everything; sparse, so that its bounds may be as large as they like.
pub struct Recorder<C> {
    bounds: Rectangle,
    /// The last colour and the number of times each pixel was drawn.
    pub pixels: BTreeMap<(i32, i32), (C, u32)>,
    pub calls: Vec<Call<C>>,
    /// Pixels that the caller sent outside the bounds.
    pub outside: u64,
    /// Fails at this call (counted from 0) and at every later one.
    pub fails_at: Option<usize>,
}

/// The error of a failing [`Recorder`]: the number of the call that failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused(pub usize);

impl<C: PixelColor> Recorder<C> {
    pub fn new(bounds: Rectangle) -> Self {
        Recorder { bounds, pixels: BTreeMap::new(), calls: Vec::new(), outside: 0, fails_at: None }
    }

    pub fn sized(width: u32, height: u32) -> Self {
        Self::new(Rectangle::new(Point::zero(), Size::new(width, height)))
    }

    pub fn failing(width: u32, height: u32, after: usize) -> Self {
        let mut target = Self::sized(width, height);
        target.fails_at = Some(after);
        target
    }

    pub fn count(&self, x: i32, y: i32) -> u32 {
        self.pixels.get(&(x, y)).map_or(0, |&(_, n)| n)
    }

    pub fn colour(&self, x: i32, y: i32) -> Option<C> {
        self.pixels.get(&(x, y)).map(|&(c, _)| c)
    }

    /// Whether a single pixel came through `draw_iter`.
    pub fn pixel_by_pixel(&self) -> bool {
        self.calls.iter().any(|c| matches!(c, Call::Pixels(_)))
    }

    fn refuse(&mut self, call: Call<C>) -> Result<(), Refused> {
        let number = self.calls.len();
        self.calls.push(call);
        match self.fails_at {
            Some(n) if number >= n => Err(Refused(number)),
            _ => Ok(()),
        }
    }

    fn put(&mut self, at: Point, colour: C) {
        if !area(self.bounds).contains(at.x.into(), at.y.into()) {
            self.outside += 1;
            return;
        }
        let slot = self.pixels.entry((at.x, at.y)).or_insert((colour, 0));
        *slot = (colour, slot.1 + 1);
    }

    /// An ASCII picture of the rectangle from (0, 0): `letter` names each colour, nothing is `.`.
    pub fn picture(&self, width: i32, height: i32, letter: impl Fn(C) -> char) -> String {
        let mut text = String::new();
        for y in 0..height {
            for x in 0..width {
                text.push(self.colour(x, y).map_or('.', &letter));
            }
            text.push('\n');
        }
        text
    }
}

impl<C: PixelColor> Dimensions for Recorder<C> {
    fn bounding_box(&self) -> Rectangle {
        self.bounds
    }
}

/// The pixels of a rectangle, which may end beyond 32 bits.
pub fn area(Rectangle { top_left, size }: Rectangle) -> Area {
    let (left, top) = (i64::from(top_left.x), i64::from(top_left.y));
    Area::new(left, top, left + i64::from(size.width), top + i64::from(size.height))
}

fn points(area: &Rectangle) -> impl Iterator<Item = Point> {
    let (from, size) = (area.top_left, area.size);
    assert!(
        u64::from(size.width) * u64::from(size.height) < 1 << 24,
        "a span of {size:?} is out of proportion"
    );
    (0..size.height as i32).flat_map(move |y| (0..size.width as i32).map(move |x| from + Point::new(x, y)))
}

impl<C: PixelColor> DrawTarget for Recorder<C> {
    type Color = C;
    type Error = Refused;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Refused>
    where
        I: IntoIterator<Item = Pixel<C>>,
    {
        let pixels: Vec<_> = pixels.into_iter().collect();
        self.refuse(Call::Pixels(pixels.len()))?;
        for Pixel(at, colour) in pixels {
            self.put(at, colour);
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, colour: C) -> Result<(), Refused> {
        self.refuse(Call::Solid(*area, colour))?;
        for at in points(area) {
            self.put(at, colour);
        }
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colours: I) -> Result<(), Refused>
    where
        I: IntoIterator<Item = C>,
    {
        let colours: Vec<_> = points(area).zip(colours).collect();
        self.refuse(Call::Contiguous(*area, colours.len()))?;
        for (at, colour) in colours {
            self.put(at, colour);
        }
        Ok(())
    }

    fn clear(&mut self, colour: C) -> Result<(), Refused> {
        self.refuse(Call::Clear)?;
        for at in points(&self.bounds.clone()) {
            self.put(at, colour);
        }
        Ok(())
    }
}

/// A DrawTarget of one area that takes single pixels, fills and runs: the last colour of each pixel, and how often it was drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Screen<C> {
    area: Rectangle,
    pub pixels: Vec<Option<C>>,
    pub counts: Vec<u32>,
}

impl<C: PixelColor> Screen<C> {
    pub fn new(area: Rectangle) -> Self {
        let count = (area.size.width * area.size.height) as usize;
        Screen { area, pixels: vec![None; count], counts: vec![0; count] }
    }

    /// From (0, 0) on.
    pub fn sized(width: u32, height: u32) -> Self {
        Self::new(Rectangle::new(Point::zero(), Size::new(width, height)))
    }

    /// The index of a pixel of the area.
    fn index(&self, at: Point) -> usize {
        assert!(self.area.contains(at), "{at} is outside {:?}", self.area);
        let at = at - self.area.top_left;
        at.y as usize * self.area.size.width as usize + at.x as usize
    }

    fn put(&mut self, at: Point, colour: C) {
        let index = self.index(at);
        self.pixels[index] = Some(colour);
        self.counts[index] += 1;
    }

    pub fn at(&self, pixel: Point) -> Option<C> {
        self.pixels[self.index(pixel)]
    }

    /// The drawn pixels, row by row.
    pub fn drawn(&self) -> impl Iterator<Item = (Point, C)> + '_ {
        points(&self.area).zip(&self.pixels).filter_map(|(at, &colour)| Some((at, colour?)))
    }

    /// All pixels, drawn over a background.
    pub fn over(&self, background: C) -> Vec<C> {
        self.pixels.iter().map(|colour| colour.unwrap_or(background)).collect()
    }
}

impl<C: PixelColor> Dimensions for Screen<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Screen<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, colour) in pixels {
            self.put(at, colour);
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, colour: C) -> Result<(), Infallible> {
        points(area).for_each(|at| self.put(at, colour));
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colours: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = C>,
    {
        let mut colours = colours.into_iter();
        for y in 0..area.size.height as i32 {
            for x in 0..area.size.width as i32 {
                self.put(area.top_left + Point::new(x, y), colours.next().expect("a colour for each pixel"));
            }
        }
        assert!(colours.next().is_none(), "a pixel for each colour");
        Ok(())
    }
}
