//! Strips that a transfer owns, as with DMA: each comes back at the end of the frame, as long as before, and the display shows
//! the picture drawn in one piece, whatever the height of the frame and the length of the strips.

use core::ops::ControlFlow::{Break, Continue};
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray8, Rgb565};
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{BandError, Frame, PixelFormat};
use support::bridge::rectangle;

/// A display that takes windows of bytes, and the transfer that may be under way.
struct Bus {
    area: Rectangle,
    /// The number that each pixel shows.
    pixels: Vec<u32>,
    sent: usize,
}

impl Bus {
    /// Each pixel of a row of whole bytes, by hand.
    fn receive<C: PixelFormat>(&mut self, window: &Rectangle, bytes: &[u8]) {
        let stride = (window.size.width * C::BITS).div_ceil(8) as usize;
        assert_eq!(bytes.len(), stride * window.size.height as usize);
        self.sent += bytes.len();
        for at in window.points() {
            let bit = (at.x - window.top_left.x) as usize * C::BITS as usize;
            let row = &bytes[(at.y - window.top_left.y) as usize * stride..][..stride];
            let bits = (0..C::BITS as usize)
                .fold(0, |all, i| all << 1 | u32::from(row[(bit + i) / 8] >> (7 - (bit + i) % 8) & 1));
            let index = (at.y - self.area.top_left.y) as u32 * self.area.size.width
                + (at.x - self.area.top_left.x) as u32;
            self.pixels[index as usize] = bits;
        }
    }
}

/// What pixel (x, y) of frame n shows.
fn pixel<C: PixelFormat>(at: Point, frame: i32) -> C {
    let bits = (at.x * 7 + at.y * 13 + frame * 5) as u32;
    C::decode(bits & (u32::MAX >> (32 - C::BITS)))
}

fn frames_with_two_strips<C: PixelFormat>(area: Rectangle, bytes: usize) {
    let count = (area.size.width * area.size.height) as usize;
    let mut bus = Bus { area, pixels: vec![u32::MAX; count], sent: 0 };
    let [mut free, other] = [0; 2].map(|_| vec![0x55; bytes].leak());
    let mut busy = Some((Rectangle::zero(), other)); // an empty transfer
    let whole_rows = bytes - bytes % Frame::<C>::strip_bytes(area.size.width, 1);
    for number in 0..3 {
        let mut frame = Frame::new(area, pixel::<C>(Point::zero(), 0));
        free = loop {
            let mut band = match frame.band_or_strip(free).expect("room for a row") {
                Continue(band) => band,
                Break(strip) => break strip,
            };
            let window = band.area();
            let colors = window.points().map(|at| pixel::<C>(at, number));
            let Ok(()) = band.fill_contiguous(&window, colors);
            let (window, drawn) = (band.area(), band.into_bytes());
            let (sent_window, sent) = busy.take().expect("a transfer");
            if !sent_window.is_zero_sized() {
                bus.receive::<C>(&sent_window, sent);
            }
            busy = Some((window, drawn));
            free = sent;
        };
        let (window, last) = busy.take().expect("a transfer");
        bus.receive::<C>(&window, last);
        busy = Some((Rectangle::zero(), last));
        let shown = area.points().zip(&bus.pixels);
        for (at, &bits) in shown {
            assert!(C::decode(bits) == pixel::<C>(at, number), "{at} of frame {number}, strips of {bytes}");
        }
    }
    if whole_rows <= Frame::<C>::strip_bytes(area.size.width, area.size.height) {
        let lengths = [free.len(), busy.expect("a transfer").1.len()];
        assert!(lengths.iter().all(|&length| length >= whole_rows), "{lengths:?} of {bytes}");
    }
}

#[test]
fn frames_of_any_height_leave_the_strips_as_long_as_they_were() {
    for height in 1..14 {
        for rows in 1..7 {
            for extra in [0, 1, 3] {
                let area = rectangle(-3, 5, 11, height);
                frames_with_two_strips::<Gray8>(area, 11 * rows + extra);
                frames_with_two_strips::<Rgb565>(area, 22 * rows + extra);
                frames_with_two_strips::<BinaryColor>(area, 2 * rows + extra.min(1));
            }
        }
    }
}

/// Only where the strip is longer than the frame, or the rows do not divide the height, a row is sent twice.
#[test]
fn no_row_is_sent_twice_where_the_strip_divides_the_frame() {
    let mut strip: &mut [u8] = &mut [0; 8 * 4];
    let mut frame = Frame::new(rectangle(0, 0, 8, 12), Gray8::BLACK);
    let mut tops = Vec::new();
    while let Continue(band) = frame.band_or_strip(strip).expect("room") {
        tops.push(band.area().rows());
        (strip, _) = band.into_strip();
        assert_eq!(strip.len(), 32);
    }
    assert_eq!(tops, [0..4, 4..8, 8..12]);
    let mut frame = Frame::new(rectangle(0, 0, 8, 12), Gray8::BLACK);
    assert_eq!(frame.band_or_strip(&mut [0; 7]).err(), Some(BandError { needed: 8, given: 7 }));
    for empty in [rectangle(0, 0, 0, 5), rectangle(0, 0, 5, 0)] {
        let mut strip = [0; 3];
        let given =
            Frame::new(empty, Gray8::BLACK).band_or_strip(&mut strip).expect("nothing to hold").break_value();
        assert_eq!(given.map(|strip| strip.len()), Some(3));
    }
}
