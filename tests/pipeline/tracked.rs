//! Tracked objects: what a display shows equals the frame drawn anew, and nothing is sent while nothing changes.

use core::convert::Infallible;
use embedded_graphics_core::pixelcolor::Gray8;
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Color, DirtyRegions, Frame, Tracked, TransferCost};
use support::bridge::rectangle;
use support::oracle::rng::Rng;
use support::oracle::target::Screen;

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(60, 40));

/// An object: filled with its shade.
#[derive(Clone, Copy)]
struct Object {
    shade: u8,
    area: Rectangle,
    is_shown: bool,
}

fn draw(objects: &[Object], target: &mut impl DrawTarget<Color = Gray8, Error = Infallible>) {
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
            DirtyRegions::<5>::new(SCREEN, TransferCost::new(Gray8::FORMAT.bits(), TransferCost::MIPI_DCS));
        let mut display = Screen::new(SCREEN);
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
            display.counts.fill(0);
            for area in dirty.take() {
                let mut strip = [0; 400];
                let mut frame = Frame::new(area, Gray8::BLACK);
                while let Some(mut band) = frame.next_band(&mut strip).expect("room") {
                    draw(&objects, &mut band);
                    let Ok(()) = band.send(&mut display);
                }
            }
            let mut whole = Screen::new(SCREEN);
            draw(&objects, &mut whole);
            assert!(display.over(Gray8::WHITE) == whole.over(Gray8::BLACK), "frame {frame}");
            let received = display.counts.iter().sum::<u32>();
            match is_changed {
                true => busy += usize::from(received > 0),
                false => {
                    assert_eq!(received, 0, "frame {frame}");
                    quiet += 1;
                }
            }
            erased += usize::from(frame > 0 && received > 0 && objects.iter().all(|o| !o.is_shown));
        }
    }
    assert!(quiet > 500 && busy > 300 && erased > 5, "{quiet} {busy} {erased}");
}
