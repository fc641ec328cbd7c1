//! The OLED driver of `examples/oled` against a controller in memory: full and partial windows, and the windows that it refuses.

#[path = "../../examples/oled/panel.rs"]
mod panel;

use self::panel::{Error, Ssd0323, SIZE};
use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{PrimitiveStyle, Rectangle};
use pinhole::{DirtyRegions, Frame, PixelFormat, TransferCost};
use support::ssd0323::{Failure, Pin, Wires};

type Panel = Ssd0323<Wires, Pin>;

fn panel() -> (Wires, Panel) {
    let wires = Wires::new();
    let panel = Ssd0323::new(wires.clone(), wires.pin()).expect("a sound bus");
    assert!(wires.on());
    (wires, panel)
}

fn window(x: i32, y: i32, width: u32, height: u32) -> Rectangle {
    Rectangle::new(Point::new(x, y), Size::new(width, height))
}

/// Levels that tell each pixel of a window from its neighbours.
fn level(x: i32, y: i32) -> u8 {
    (3 * x + 5 * y + x / 16).rem_euclid(16) as u8
}

fn bytes(area: &Rectangle) -> Vec<u8> {
    let levels: Vec<u8> = area.points().map(|p| level(p.x, p.y)).collect();
    levels.chunks(2).map(|pair| pair[0] << 4 | pair[1]).collect()
}

/// Writing a window changes the pixels in it and no others.
fn only(area: &Rectangle, before: &[u8], after: &[u8]) {
    for (at, (before, after)) in window(0, 0, 128, 64).points().zip(before.iter().zip(after)) {
        let wanted = if area.contains(at) { level(at.x, at.y) } else { *before };
        assert_eq!(*after, wanted, "{at:?} of {area:?}");
    }
}

#[test]
fn a_window_is_written_and_nothing_beside_it() {
    for (x, y, width, height) in
        [(0, 0, 128, 64), (0, 0, 2, 1), (126, 63, 2, 1), (34, 7, 2, 57), (2, 63, 126, 1), (20, 30, 50, 11)]
    {
        let area = window(x, y, width, height);
        let (wires, mut panel) = panel();
        let before = wires.levels();
        // Twice, all there is of it: the address is at the window's start again.
        for _ in 0..2 {
            panel.write(&area, &bytes(&area)).expect("a window");
            only(&area, &before, &wires.levels());
        }
    }
    // As for any DrawTarget, the colours of pixels outside are skipped.
    for (x, y, width, height) in [
        (0, 0, 128, 64),
        (20, 30, 50, 11),
        (-4, -3, 10, 7),
        (120, 60, 20, 9),
        (-6, 5, 200, 3),
        (200, 0, 4, 4),
    ] {
        let area = window(x, y, width, height);
        let (wires, mut panel) = panel();
        let before = wires.levels();
        let colours = area.points().map(|p| Gray4::new(level(p.x, p.y)));
        panel.fill_contiguous(&area, colours).expect("a window");
        only(&area, &before, &wires.levels());
    }
}

/// The controller fills the window row by row and wraps from its end to its start.
#[test]
fn the_controller_wraps_inside_its_window() {
    let wires = Wires::new();
    wires.receive(&[0x15, 10, 11, 0x75, 5, 6], false);
    wires.receive(&[0x12, 0x34, 0x56, 0x78, 0x9a], true);
    let at = |x: usize, y: usize| wires.levels()[y * 128 + x];
    assert_eq!([20, 21, 22, 23].map(|x| at(x, 5)), [9, 10, 3, 4]);
    assert_eq!([20, 21, 22, 23].map(|x| at(x, 6)), [5, 6, 7, 8]);
}

#[test]
fn windows_that_split_a_byte_are_refused_and_nothing_is_sent() {
    for (x, y, width, height) in [
        (1, 0, 2, 1),
        (0, 0, 3, 2),
        (0, 0, 1, 2),
        (-2, 0, 4, 1),
        (126, 0, 4, 1),
        (0, 63, 2, 2),
        (0, -1, 2, 2),
        (0, 0, 0, 0),
        (0, 0, 2, 0),
        (i32::MAX - 1, 0, 2, 1),
    ] {
        let area = window(x, y, width, height);
        let (wires, mut panel) = panel();
        let (before, count) = (wires.levels(), wires.count());
        let pixels = vec![0; (area.size.width * area.size.height / 2) as usize];
        assert_eq!(panel.write(&area, &pixels), Err(Error::Window), "{area:?}");
        assert_eq!((wires.levels(), wires.count()), (before, count), "{area:?}");
    }
    let (wires, mut panel) = panel();
    let (area, count) = (window(4, 4, 4, 4), wires.count());
    for wrong in [0, 7, 9, 16] {
        assert_eq!(panel.write(&area, &vec![0; wrong]), Err(Error::Window));
    }
    let grey = Gray4::new(7);
    assert_eq!(panel.fill_solid(&window(1, 0, 4, 4), grey), Err(Error::Window));
    let alone = [Pixel(Point::new(4, 4), grey), Pixel(Point::new(6, 4), grey)];
    assert_eq!(panel.draw_iter(alone), Err(Error::Window));
    assert_eq!(panel.draw_iter([Pixel(Point::new(4, 4), grey)]), Err(Error::Window));
    assert_eq!(panel.draw_iter([3, 4].map(|x| Pixel(Point::new(x, 4), grey))), Err(Error::Window));
    assert_eq!(wires.count(), count);
}

#[test]
fn clearing_and_drawing_write_pairs_of_pixels() {
    let (wires, mut panel) = panel();
    panel.clear(Gray4::new(5)).expect("all of it");
    assert_eq!(wires.levels(), [5; 128 * 64]);
    let row = (8..12).map(|x| Pixel(Point::new(x, 9), Gray4::new(x as u8)));
    panel.draw_iter(row).expect("two pairs");
    assert_eq!(wires.levels()[9 * 128 + 7..9 * 128 + 13], [5, 8, 9, 10, 11, 5]);
}

/// The firmware's method: bands of the regions that changed.
#[test]
fn bands_of_dirty_regions_show_the_full_picture() {
    let (wires, mut panel) = panel();
    let screen = Rectangle::new(Point::zero(), SIZE);
    let mut dirty = DirtyRegions::<4>::new(screen, TransferCost::new(Gray4::BITS, 6)).with_steps(2, 1);
    let mut strip = [0; Frame::<Gray4>::strip_bytes(128, 8)];
    for (left, top) in [(3, 3), (8, 5), (61, 20), (62, 21), (110, 50), (117, 53)] {
        let thing = window(left, top, 11, 11);
        dirty.mark(thing);
        for area in dirty.take() {
            let mut frame = Frame::new(area, Gray4::new(2));
            while let Some(mut band) = frame.next_band(&mut strip).expect("a strip of eight rows") {
                let Ok(()) = thing.into_styled(PrimitiveStyle::with_fill(Gray4::new(13))).draw(&mut band);
                panel.write(&band.area(), band.bytes()).expect("even windows");
            }
        }
        for (at, is) in screen.points().zip(wires.levels()) {
            assert_eq!(is, if thing.contains(at) { 13 } else { 2 }, "{at:?}, {thing:?}");
        }
    }
}

#[test]
fn errors_of_the_bus_and_of_a_pin_are_returned() {
    let area = window(0, 0, 4, 4);
    // Two transfers each: the window's commands, and pixels; the pin goes low and high.
    for good in 0..2 {
        let (wires, mut panel) = panel();
        wires.fail(Failure::Bus, good);
        assert_eq!(panel.write(&area, &[0; 8]), Err(Error::Spi(Failure::Bus)));
        assert_eq!(panel.write(&area, &[0; 8]), Ok(()));
        wires.fail(Failure::Pin, good);
        assert_eq!(panel.write(&area, &[0; 8]), Err(Error::Pin(Failure::Pin)));
        assert_eq!(panel.write(&area, &[0; 8]), Ok(()));
    }
}
