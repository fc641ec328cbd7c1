//! On the wire: the bytes of the driver mipidsi, and the picture that a controller shows after them, against pictures drawn
//! in memory.

use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_hal::spi::SpiDevice;
use mipidsi::interface::SpiError;
use mipidsi::models::{ILI9341Rgb565, ILI9341Rgb666, ST7789};
use mipidsi::{Display, NoResetPin};
use pinhole::prelude::*;
use support::oracle::line;
use support::panel::bus::Failure;
use support::panel::films::{
    changes, dirty, film, in_bands, in_spans, line_traffic, lines, pixel_bytes, reference, strip, sum,
    Colour, Film, Way, BACKGROUND, FRAMES,
};
use support::panel::screen::{Bus, Kind, Screen, StoredPixel};
use support::panel::{Controller, Held};

/// The spinning cube, for tests that any film would serve.
const CUBE: Film = Film::Cube { axis: [0, 1, 0], turn: FRAMES };

/// The scene S2 covers 17964 pixels: see `tools/bench/scenes.json`.
#[test]
fn the_spinning_cube_is_scene_s2_of_the_benchmarks() {
    let picture = reference::<Rgb565>(&CUBE.frame(ST7789::SIZE, 0), ST7789::SIZE);
    let covered = picture.iter().filter(|colour| **colour != Rgb565::from(BACKGROUND)).count();
    assert_eq!(covered, 17964);
}

/// Runs a test for every panel.
macro_rules! for_every_panel {
    ($test:ident) => {
        $test::<ST7789>();
        $test::<ILI9341Rgb565>();
        $test::<ILI9341Rgb666>();
    };
}

#[test]
fn bands_of_every_height_show_the_picture_and_cost_little() {
    fn test<M: Kind<ColorFormat: Colour>>() {
        let mut screen = Screen::<M>::new();
        let area = screen.display.bounding_box();
        let pixels = pixel_bytes::<M::ColorFormat>(M::SIZE);
        for rows in 1..=M::SIZE.height {
            let frame = rows % FRAMES;
            let mut strip = strip::<M::ColorFormat>(M::SIZE.width, rows);
            let things = CUBE.frame(M::SIZE, frame);
            in_bands(&things, area, &mut strip, &mut screen.display).unwrap();
            screen.assert_shows(&reference(&things, M::SIZE), ("bands", rows));
            let (bytes, windows) = screen.count();
            assert_eq!(windows, M::SIZE.height.div_ceil(rows) as usize);
            assert_eq!(bytes, pixels + 11 * windows);
            assert!(rows < 4 || bytes * 100 <= pixels * 101, "{rows}: {bytes} of {pixels}");
        }
    }
    for_every_panel!(test);
}

#[test]
fn drawing_directly_onto_the_panel_shows_the_same_picture() {
    fn test<M: Kind<ColorFormat: Colour>>() {
        let mut screen = Screen::<M>::new();
        for film in [CUBE, Film::Small] {
            for frame in [0, 31] {
                let things = film.frame(M::SIZE, frame);
                let picture = reference(&things, M::SIZE);
                in_spans(&things, &mut screen.display).unwrap();
                screen.assert_shows(&picture, "spans");
                let (spans, _) = screen.count();
                let pixels = pixel_bytes::<M::ColorFormat>(M::SIZE);
                assert!(pixels < spans && spans < 2 * pixels, "{pixels}, {spans}");
            }
        }
    }
    for_every_panel!(test);
}

/// A window is a rectangle, and no rectangle contains pixels of two runs of a line and only pixels of the line: the runs lie in
/// different rows, or different columns, and share no column or row. So a window for each run is the fewest bytes.
#[test]
fn a_line_sends_one_window_per_run() {
    fn test<M: Kind<ColorFormat: Colour>>() {
        let (mut pixels, mut runs) = (0, 0);
        for ends in lines(M::SIZE) {
            let [a, b] = ends.map(|pixel| (i64::from(pixel.x), i64::from(pixel.y)));
            let line = line::pixels(a, b);
            let is_step = |p: &[line::P]| p[0].0 != p[1].0 && p[0].1 != p[1].1;
            pixels += line.len();
            runs += 1 + line.windows(2).filter(|pair| is_step(pair)).count();
        }
        assert_eq!(<Display<Bus, M, NoResetPin> as Surface>::LEAST_RUN, 1);
        let size = M::ColorFormat::FORMAT.bits() as usize / 8;
        let least = (runs * 11 + pixels * size, runs);
        assert_eq!(line_traffic::<M, 1>(), least);
        // The driver sets a window for each pixel of `draw_iter`, so this is what the default avoids.
        let (bytes, windows) = line_traffic::<M, { u16::MAX }>();
        assert!(
            cfg!(pinhole_plain) || bytes * 2 > 3 * least.0 && windows * 2 > 3 * runs,
            "{bytes} {windows} {least:?}"
        );
    }
    for_every_panel!(test);
}

/// The bytes of a window without the driver's conversion, as DMA would send them.
#[test]
fn the_bytes_of_a_band_are_in_wire_order() {
    fn test<M: Kind<ColorFormat: Colour>>() {
        let (mut sent, mut raw) = (Screen::<M>::new(), Screen::<M>::new());
        for (area, rows) in [
            (sent.display.bounding_box(), 16),
            (sent.display.bounding_box(), 7),
            (Rectangle::new(Point::new(33, 21), Size::new(101, 150)), 5),
        ] {
            let things = CUBE.frame(M::SIZE, rows);
            let mut strip = strip::<M::ColorFormat>(M::SIZE.width, rows);
            in_bands(&things, area, &mut strip, &mut sent.display).unwrap();
            let mut frame = Frame::new(area, M::ColorFormat::from(BACKGROUND));
            while let Some(mut band) = frame.next_band(&mut strip).unwrap() {
                for thing in &things {
                    let Ok(()) = thing.draw(&mut band);
                }
                let Point { x, y } = band.area().top_left;
                let end = band.area().bottom_right().unwrap();
                let [x, y, to_x, to_y] = [x, y, end.x, end.y].map(|v| v as u16);
                raw.display.set_pixels(x, y, to_x, to_y, []).unwrap();
                raw.panel.write(band.bytes()).unwrap();
            }
            assert_eq!(raw.count(), sent.count());
        }
        // Outside the areas each memory is as it was at first.
        assert!(raw.picture() == sent.picture());
        assert_eq!((raw.panel.controller().cut_off, sent.panel.controller().cut_off), (0, 0));
    }
    for_every_panel!(test);
}

/// The axes that the cube is spun about.
const AXES: [[i16; 3]; 5] = [[0, 1, 0], [1, 0, 0], [0, 0, 1], [1, 1, 1], [3, -2, 1]];

/// In every frame, where the cube turns by 5 degrees or more. Turned by one degree only, it may change less than its rectangle in some
/// frames: an edge stays within its pixels while the colours of its faces stay what they were. Over the turn it holds.
#[test]
fn the_spinning_cube_sends_no_more_than_what_changed() {
    fn test<M: Kind<ColorFormat: Colour>>() {
        for axis in AXES {
            for turn in [20, 36, FRAMES] {
                for cost in film::<M>(Film::Cube { axis, turn }, turn, Way::DirtyRegions) {
                    assert!(cost.bytes * 100 <= cost.changed * 105, "{} about {axis:?}: {cost:?}", M::NAME);
                }
            }
        }
    }
    for_every_panel!(test);
    for axis in AXES {
        let cost = sum(&film::<ST7789>(Film::Cube { axis, turn: 360 }, 360, Way::DirtyRegions));
        assert!(cost.bytes * 100 <= cost.changed * 105, "about {axis:?}: {cost:?}");
    }
}

/// Over the film it costs less than the one rectangle about what changed, in every frame at most 1.05 of it, and a 25th
/// of all pixels.
#[test]
fn a_small_moving_object_sends_few_bytes() {
    fn test<M: Kind<ColorFormat: Colour>>() {
        let costs = film::<M>(Film::Small, FRAMES, Way::DirtyRegions);
        let all = sum(&costs);
        assert!(all.bytes < all.changed, "{all:?}");
        let frame = pixel_bytes::<M::ColorFormat>(M::SIZE);
        for cost in costs {
            assert!(
                cost.bytes * 100 <= cost.changed * 105 && cost.bytes * 25 <= frame,
                "{}: {cost:?}",
                M::NAME
            );
        }
    }
    for_every_panel!(test);
}

/// The bus fails once, anywhere in a frame.
#[test]
fn the_frame_after_a_bus_failure_is_complete() {
    fn test<M: Kind<ColorFormat: Colour>>(film: Film) {
        /// From where the cube's rectangle shrinks.
        const START: u32 = 13;
        let mut spoilt = 0;
        let bytes = pixel_bytes::<M::ColorFormat>(M::SIZE);
        // Within the first window's commands, in its pixels, and later.
        for after in (0..14).chain([100, 101, 500, 999, 2001, bytes / 2 - 1]) {
            for told in [true, false] {
                let mut screen = Screen::<M>::new();
                let area = screen.display.bounding_box();
                let mut dirty = dirty::<M::ColorFormat>(area);
                let mut strip = strip::<M::ColorFormat>(M::SIZE.width, 8);
                let mut next = |screen: &mut Screen<M>, dirty: &mut _, frame| {
                    let things = film.frame(M::SIZE, frame);
                    changes(&things, dirty, &mut strip, &mut screen.display)
                };
                next(&mut screen, &mut dirty, START).unwrap();
                // The next frame may end before; the bus fails in a later one then.
                screen.panel.fail_after(after);
                let failed = (START + 1..)
                    .find_map(|frame| Some((frame, next(&mut screen, &mut dirty, frame).err()?)));
                let Some((frame, SpiError::Spi(Failure))) = failed else { panic!("{failed:?}") };
                if told {
                    dirty.invalidate();
                }
                next(&mut screen, &mut dirty, frame + 1).unwrap();
                let picture = reference::<M::ColorFormat>(&film.frame(M::SIZE, frame + 1), M::SIZE);
                if told {
                    screen.assert_shows(&picture, ("after a failure at", after));
                } else {
                    let seen = screen.picture();
                    spoilt += usize::from(picture.iter().zip(&seen).any(|(c, seen)| c.stored() != *seen));
                }
            }
        }
        assert!(spoilt > 0, "no failure showed, were the target not declared lost");
    }
    for film in [CUBE, Film::Small] {
        test::<ST7789>(film);
        test::<ILI9341Rgb666>(film);
    }
}

/// The model of the controller, by hand.
mod controller {
    use super::{Controller, Held};

    fn send(controller: &mut Controller, command: u8, data: &[u8]) {
        controller.receive(command, false);
        data.iter().for_each(|byte| controller.receive(*byte, true));
    }

    fn ready(access: u8, format: u8) -> Controller {
        let mut controller = Controller::new();
        let set_up = [(0x01, &[][..]), (0x11, &[]), (0x29, &[]), (0x36, &[access]), (0x3a, &[format])];
        set_up.into_iter().for_each(|(command, data)| send(&mut controller, command, data));
        controller.count();
        controller
    }

    #[test]
    fn a_window_is_filled_row_by_row_and_round_again() {
        let mut controller = ready(0, 0x55);
        let mut expected = controller.picture(Held::Upright, 5, 5);
        send(&mut controller, 0x2a, &[0, 1, 0, 2]);
        send(&mut controller, 0x2b, &[0, 2, 0, 3]);
        send(&mut controller, 0x2c, &[0, 1, 0, 2, 0, 3, 0xff, 4, 0x12, 0x34]);
        (expected[11], expected[12], expected[16], expected[17]) = (0x1234, 2, 3, 0xff04);
        assert_eq!((controller.picture(Held::Upright, 5, 5), controller.count()), (expected, (11 + 10, 1)));
        // 18 bits are the upper six of three bytes.
        let mut wide = ready(0, 0x66);
        send(&mut wide, 0x2c, &[0b1000_0111, 0b0000_0100, 0xff]);
        assert_eq!(wide.picture(Held::Upright, 1, 1), [0b10_0001_0000_0111_1111]);
        // Rows and columns exchanged, columns mirrored: the first pixel is the glass's upper right one.
        let mut landscape = ready(0x60, 0x55);
        send(&mut landscape, 0x2c, &[0, 1, 0, 2]);
        let upright = landscape.picture(Held::Upright, 240, 2);
        assert_eq!((landscape.picture(Held::Landscape, 1, 1), upright[239]), (vec![1], 1));
    }

    #[test]
    fn wrong_commands_are_recorded_and_cut_off_ones_have_no_effect() {
        for (command, data) in [
            (0x2a, &[0, 9, 0, 8][..]), // backwards
            (0x2a, &[0, 0, 0, 240]),   // beyond the glass
            (0x2b, &[0, 0, 1, 0x40]),  // 320
            (0x29, &[0]),              // takes no parameter
            (0x36, &[0x08]),           // blue and red exchanged
            (0x3a, &[0x53]),           // 12 bits
            (0x99, &[]),               // unknown
        ] {
            let mut controller = ready(0, 0x55);
            send(&mut controller, command, data);
            assert_eq!(controller.errors.len(), 1, "{command:#04x} {data:?}");
        }
        let mut asleep = Controller::new();
        send(&mut asleep, 0x2c, &[0, 0]);
        assert_eq!(asleep.errors.len(), 3, "{:?}", asleep.errors); // asleep, and a format for neither byte
        let mut controller = ready(0, 0x55);
        let before = controller.picture(Held::Upright, 240, 320);
        for (command, data) in [(0x2a, &[0, 9, 0][..]), (0x2c, &[0]), (0x13, &[])] {
            send(&mut controller, command, data);
        }
        assert!(controller.picture(Held::Upright, 240, 320) == before);
        assert_eq!((controller.cut_off, controller.errors.len()), (2, 0));
    }
}
