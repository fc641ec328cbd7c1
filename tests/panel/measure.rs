//! What a film costs on the wire, each of its frames held against one drawn whole in memory.

use super::films::{Film, Memory, Thing, BACKGROUND};
use super::screen::{Kind, Screen, Stored};
use super::ways::{changes, dirty, in_bands, in_pixels, in_spans, strip, Colour};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::Wire;
use pinhole_apps_support::canvas::Canvas;

/// A frame, drawn whole in memory.
pub(crate) fn reference<C: Colour>(things: &[Thing], size: Size) -> Canvas<C> {
    let mut canvas = Canvas::new(size, C::from(BACKGROUND));
    for thing in things {
        let Ok(()) = thing.draw(&mut canvas);
    }
    canvas
}

impl<M: Kind<ColorFormat: Colour>> Screen<M> {
    /// The panel shows a picture, to the pixel.
    #[track_caller]
    pub(crate) fn assert_shows(&self, picture: &Canvas<M::ColorFormat>, what: impl core::fmt::Debug) {
        let differing =
            self.picture().iter().zip(picture.pixels()).filter(|(a, b)| **a != b.stored()).count();
        assert_eq!(differing, 0, "{}: pixels of {what:?}", M::NAME);
    }
}

/// The bytes of the pixels of an area.
pub(crate) fn pixel_bytes<C: Wire>(size: Size) -> usize {
    size.width as usize * size.height as usize * C::BITS as usize / 8
}

/// The least rectangle about the pixels that differ.
fn difference<C: PixelColor>(a: &Canvas<C>, b: &Canvas<C>) -> Rectangle {
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
pub(crate) enum Way {
    /// All of every frame.
    Bands,
    Dirty,
    Spans,
    Pixels,
}

/// The rows that bands have room for, as wide as the panel.
pub(crate) const ROWS: u32 = 8;

/// What a frame cost.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cost {
    pub(crate) bytes: usize,
    pub(crate) windows: usize,
    /// The bytes of the pixels of the least rectangle about those that changed.
    pub(crate) changed: usize,
}

/// The frames of a film after its first one. Every frame that is seen is the reference.
pub(crate) fn film<M: Kind<ColorFormat: Colour>>(film: Film, frames: u32, way: Way) -> Vec<Cost> {
    let mut screen = Screen::<M>::new();
    let area = screen.display.bounding_box();
    let mut dirty = dirty::<M::ColorFormat>(area);
    let mut strip = strip::<M::ColorFormat>(M::SIZE.width, ROWS);
    let mut last: Option<Canvas<M::ColorFormat>> = None;
    let (mut memory, mut costs) = (Memory::default(), Vec::new());
    for frame in 0..frames {
        let things = film.frame(M::SIZE, frame);
        let mut recorded = memory.record(&things);
        let display = &mut screen.display;
        let sent = match way {
            Way::Bands => in_bands(&mut recorded, area, &mut strip, display),
            Way::Dirty => changes(&mut recorded, &mut dirty, &mut strip, display),
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

/// All frames together.
pub(crate) fn sum(costs: &[Cost]) -> Cost {
    costs.iter().fold(Cost::default(), |sum, cost| Cost {
        bytes: sum.bytes + cost.bytes,
        windows: sum.windows + cost.windows,
        changed: sum.changed + cost.changed,
    })
}
