//! The bytes that a film sends over the wire. Each frame on the panel is compared with the frame drawn in memory.

use super::films::{Film, Memory, Thing, BACKGROUND};
use super::framebuffer::Framebuffer;
use super::screen::{Kind, Screen, StoredPixel};
use super::ways::{changes, dirty, in_bands, in_pixels, in_spans, strip, Colour};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{draw_line, raster, LeastRun, PixelFormat};

/// A frame, drawn in memory at once.
pub fn reference<C: Colour>(things: &[Thing], size: Size) -> Framebuffer<C> {
    let mut picture = Framebuffer::new(size, C::from(BACKGROUND));
    for thing in things {
        let Ok(()) = thing.draw(&mut picture);
    }
    picture
}

impl<M: Kind<ColorFormat: Colour>> Screen<M> {
    /// The panel shows a picture, to the pixel.
    #[track_caller]
    pub fn assert_shows(&self, picture: &Framebuffer<M::ColorFormat>, what: impl core::fmt::Debug) {
        let differing =
            self.picture().iter().zip(picture.pixels()).filter(|(a, b)| **a != b.stored()).count();
        assert_eq!(differing, 0, "{}: pixels of {what:?}", M::NAME);
    }
}

/// The bytes of the pixels of an area.
pub fn pixel_bytes<C: PixelFormat>(size: Size) -> usize {
    size.width as usize * size.height as usize * C::BITS as usize / 8
}

/// The smallest rectangle that contains the pixels that differ.
fn difference<C: PixelColor>(a: &Framebuffer<C>, b: &Framebuffer<C>) -> Rectangle {
    let width = a.size().width as usize;
    let differing = a.pixels().iter().zip(b.pixels()).enumerate().filter(|(_, (a, b))| a != b);
    let at = |(i, _)| Point::new((i % width) as i32, (i / width) as i32);
    let points: Vec<Point> = differing.map(at).collect();
    let low = points.iter().copied().reduce(|a, b| a.component_min(b));
    let high = points.iter().copied().reduce(|a, b| a.component_max(b));
    low.zip(high).map_or(Rectangle::zero(), |(low, high)| Rectangle::with_corners(low, high))
}

/// How frames are sent.
#[derive(Clone, Copy, Debug)]
pub enum Way {
    /// All of every frame.
    Bands,
    DirtyRegions,
    Spans,
    Pixels,
}

/// The number of rows of a band, which is as wide as the panel.
pub const ROWS: u32 = 8;

/// The traffic of a frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    pub bytes: usize,
    pub windows: usize,
    /// The bytes of the pixels of the smallest rectangle that contains all changes.
    pub changed: usize,
}

/// The traffic of each frame of a film after the first. Asserts that the panel shows the reference after every frame.
pub fn film<M: Kind<ColorFormat: Colour>>(film: Film, frames: u32, way: Way) -> Vec<Cost> {
    let mut screen = Screen::<M>::new();
    let area = screen.display.bounding_box();
    let mut dirty = dirty::<M::ColorFormat>(area);
    let mut strip = strip::<M::ColorFormat>(M::SIZE.width, ROWS);
    let mut last: Option<Framebuffer<M::ColorFormat>> = None;
    let (mut memory, mut costs) = (Memory::default(), Vec::new());
    for frame in 0..frames {
        let things = film.frame(M::SIZE, frame);
        let mut recorded = memory.record(&things);
        let display = &mut screen.display;
        let sent = match way {
            Way::Bands => in_bands(&mut recorded, area, &mut strip, display),
            Way::DirtyRegions => changes(&mut recorded, &mut dirty, &mut strip, display),
            Way::Spans => in_spans(&things, display),
            Way::Pixels => in_pixels(&things, display),
        };
        sent.expect("a bus that works");
        let picture = reference(&things, M::SIZE);
        screen.assert_shows(&picture, (film, frame, way));
        let (bytes, windows) = screen.count();
        if let Some(last) = &last {
            let changed = pixel_bytes::<M::ColorFormat>(difference(last, &picture).size);
            costs.push(Cost { bytes, windows, changed });
        }
        last = Some(picture);
    }
    assert_eq!(screen.panel.controller().cut_off, 0);
    costs
}

/// The ends of lines from the middle of a panel to every eighth point of its border: every direction.
pub fn lines(size: Size) -> Vec<[raster::Pixel; 2]> {
    let (width, height) = (size.width as i16, size.height as i16);
    let across = (0..width).step_by(8).flat_map(|x| [(x, 0), (x, height - 1)]);
    let down = (8..height - 1).step_by(8).flat_map(|y| [(0, y), (width - 1, y)]);
    let middle = raster::Pixel { x: width / 2, y: height / 2 };
    across.chain(down).map(|(x, y)| [middle, raster::Pixel { x, y }]).collect()
}

/// The bytes and windows of [`lines`], drawn with this [`LEAST_RUN`](pinhole::Target::LEAST_RUN). Asserts that the panel shows
/// them.
pub fn line_traffic<M: Kind<ColorFormat: Colour>, const LEAST_RUN: u16>() -> (usize, usize) {
    let (mut screen, background, ink) =
        (Screen::<M>::new(), BACKGROUND.into(), M::ColorFormat::from(Rgb888::WHITE));
    let mut picture = Framebuffer::new(M::SIZE, background);
    screen.display.clear(background).expect("a bus that works");
    screen.count();
    for [from, to] in lines(M::SIZE) {
        draw_line(from, to, ink, &mut LeastRun::<_, LEAST_RUN>(&mut screen.display))
            .expect("a bus that works");
        let Ok(()) = draw_line(from, to, ink, &mut picture);
    }
    screen.assert_shows(&picture, "lines");
    screen.count()
}

/// The sum over all frames.
pub fn sum(costs: &[Cost]) -> Cost {
    costs.iter().fold(Cost::default(), |sum, cost| Cost {
        bytes: sum.bytes + cost.bytes,
        windows: sum.windows + cost.windows,
        changed: sum.changed + cost.changed,
    })
}
