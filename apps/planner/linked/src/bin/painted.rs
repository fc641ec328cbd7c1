//! Faces in painter's order: in bands, or into a whole picture if a band has all rows.
#![no_std]
#![no_main]

use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::OriginDimensions;
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use linked::{firmware, level, light, COLOR};
use pinhole::{Affine, Color as _, Frame, Painter, Picture};

include!(concat!(env!("PLANNER_MODELS"), "/", env!("CARGO_BIN_NAME"), ".rs"));

const IS_WHOLE: bool = ROWS == HEIGHT;
const STRIP: usize = if IS_WHOLE { 0 } else { Frame::<Rgb565>::strip_bytes(WIDTH, ROWS) };
const PIXELS: usize = if IS_WHOLE { (WIDTH * HEIGHT) as usize } else { 0 };
type Order = Painter<Rgb565, { MODEL.vertices().len() }, { MODEL.faces().len() }>;

firmware!(|camera, turn, display: Rgb565|
    painter: Order = Order::new(),
    strip: [u8; STRIP] = [0; STRIP],
    pixels: [Rgb565; PIXELS] = [Rgb565::BLACK; PIXELS],
    {
        let model = Affine::rotation_y(turn);
        let light = light(&model)?;
        painter.clear();
        painter.add(&camera.place(&MODEL, &model), |face| COLOR.dim(level(&MODEL, &light, face))).ok()?;
        if IS_WHOLE {
            let mut picture = Picture::new(pixels, display.size()).ok()?;
            let Ok(()) = picture.clear(Rgb565::BLACK);
            let Ok(_) = painter.draw(&mut picture.pixels());
            black_box(picture.colors());
            return Some(());
        }
        let order = painter.order();
        let mut frame = Frame::new(Rectangle::new(Default::default(), display.size()), Rgb565::BLACK);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let Ok(()) = order.draw(&mut band.pixels());
            band.send(display).ok()?;
        }
        Some(())
    }
);
