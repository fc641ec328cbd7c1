//! Faces in painter's order: in bands, or into a whole picture if a band has all rows.
#![no_std]
#![no_main]

use linked::*;

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
        camera.place(&MODEL, &model).faces(|face| COLOR.dim(level(&MODEL, &light, face))).sorted(painter).ok()?;
        if IS_WHOLE {
            let mut picture = Picture::new(pixels, display.size()).ok()?;
            let Ok(()) = picture.clear(Rgb565::BLACK);
            let Ok(_) = painter.draw(&mut picture.pixels());
            black_box(picture.colors());
            return Some(());
        }
        let order = painter.order();
        let mut frame = Frame::new(area(display), Rgb565::BLACK);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let Ok(()) = order.draw(&mut band.pixels());
            band.send(display).ok()?;
        }
        Some(())
    }
);
