//! Tracked objects: what a display shows equals the frame drawn anew, and nothing is sent while nothing changes.

use embedded_graphics_core::pixelcolor::Gray8;
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{DirtyRegions, Frame, PixelFormat, Tracked, TransferCost};
use support::bridge::rectangle;
use support::oracle::rng::Rng;

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(60, 40));

/// Memory of a display that counts what it receives.
struct Display {
    pixels: Vec<Gray8>,
    received: usize,
}

impl OriginDimensions for Display {
    fn size(&self) -> Size {
        SCREEN.size
    }
}

impl DrawTarget for Display {
    type Color = Gray8;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        for Pixel(at, color) in pixels {
            self.received += 1;
            self.pixels[(at.y * 60 + at.x) as usize] = color;
        }
        Ok(())
    }
}

/// An object: filled with its shade.
#[derive(Clone, Copy)]
struct Object {
    shade: u8,
    area: Rectangle,
    is_shown: bool,
}

fn draw(objects: &[Object], target: &mut impl DrawTarget<Color = Gray8, Error = core::convert::Infallible>) {
    for object in objects.iter().filter(|object| object.is_shown) {
        let Ok(()) = target.fill_solid(&object.area.intersection(&SCREEN), Gray8::new(object.shade));
    }
}

#[test]
fn the_display_shows_the_frame_and_receives_nothing_while_nothing_changes() {
    let mut rng = Rng::new(0x7a);
    let (mut quiet, mut busy, mut erased) = (0, 0, 0);
    for _ in 0..40 {
        let mut dirty =
            DirtyRegions::<5>::new(SCREEN, TransferCost::new(Gray8::BITS, TransferCost::MIPI_DCS));
        let mut display = Display { pixels: vec![Gray8::WHITE; 2400], received: 0 };
        let mut tracked = [Tracked::new(); 4];
        let mut objects = [Object { shade: 9, area: Rectangle::zero(), is_shown: false }; 4];
        for frame in 0..60 {
            let mut is_changed = frame == 0;
            if rng.one_in(2) {
                let object = &mut objects[rng.below(4)];
                match rng.below(4) {
                    0 => object.is_shown = !object.is_shown,
                    1 => object.shade = object.shade.wrapping_add(1),
                    _ => {
                        let [x, y] = [rng.int(-20, 70), rng.int(-20, 50)].map(|v| v as i32);
                        let [width, height] = [0; 2].map(|_| rng.int(0, 25) as u32);
                        object.area = rectangle(x, y, width, height);
                    }
                }
                is_changed = true;
            }
            for (tracked, object) in tracked.iter_mut().zip(&objects) {
                match object.is_shown {
                    true => tracked.show(object.shade, object.area, &mut dirty),
                    false => tracked.hide(&mut dirty),
                }
            }
            display.received = 0;
            for area in dirty.take() {
                let mut strip = [0; 400];
                let mut frame = Frame::new(area, Gray8::BLACK);
                while let Some(mut band) = frame.next_band(&mut strip).expect("room") {
                    draw(&objects, &mut band);
                    let Ok(()) = band.send(&mut display);
                }
            }
            let mut whole = Display { pixels: vec![Gray8::BLACK; 2400], received: 0 };
            draw(&objects, &mut whole);
            assert!(display.pixels == whole.pixels, "frame {frame}");
            match is_changed {
                true => busy += usize::from(display.received > 0),
                false => {
                    assert_eq!(display.received, 0, "frame {frame}");
                    quiet += 1;
                }
            }
            erased += usize::from(frame > 0 && display.received > 0 && objects.iter().all(|o| !o.is_shown));
        }
    }
    assert!(quiet > 500 && busy > 300 && erased > 5, "{quiet} {busy} {erased}");
}
