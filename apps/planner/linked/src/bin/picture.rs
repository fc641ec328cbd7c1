//! Faces into a whole picture in memory, with depth or without.
#![no_std]
#![no_main]

use linked::*;

const HAS_DEPTH: bool = matches!(SHADING.as_bytes(), b"depth");
const PIXELS: usize = (WIDTH * HEIGHT) as usize;
const DEPTHS: usize = if HAS_DEPTH { PIXELS } else { 0 };

firmware!(|camera, turn, display: Rgb565|
    cache: [ScreenVertex; MODEL.vertices().len()] = [ScreenVertex::EMPTY; MODEL.vertices().len()],
    pixels: [Rgb565; PIXELS] = [Rgb565::BLACK; PIXELS],
    depths: [u16; DEPTHS] = [0; DEPTHS],
    {
        let model = Affine::rotation_y(turn);
        let light = light(&model)?;
        let shade = |face| COLOR.dim(level(&MODEL, &light, face));
        let instance = camera.place(&MODEL, &model);
        let mut picture = Picture::new(pixels, display.size()).ok()?;
        let Ok(()) = picture.clear(Rgb565::BLACK);
        if HAS_DEPTH {
            let mut depth =
                DepthBuffer::new(area(display), depths).ok()?;
            let Ok(_) = instance.faces(shade).cached(cache).draw(&mut picture.pixels().depth_tested(&mut depth));
        } else {
            let Ok(_) = instance.faces(shade).cached(cache).draw(&mut picture.pixels());
        }
        black_box(picture.colors());
        Some(())
    }
);
