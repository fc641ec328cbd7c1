//! Lit faces in painter's order, one firmware each: into a picture in memory, and in bands.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// The firmware that is built.
const IN_BANDS: bool = is_equal(env!("CARGO_BIN_NAME"), "flash_painter_bands");

/// The faces of the cube. A clipped one is stored as the triangles of its fan, each with three vertices.
const FACES: usize = 12;
type Order = Painter<Rgb565, { 4 * CORNERS }, { 2 * FACES }>;

/// The bytes of the strip of a band; none for a picture.
const STRIP: usize = if IN_BANDS { bytes(ROWS) } else { 0 };
const PIXELS: usize = if IN_BANDS { 0 } else { pixels(ROWS) };

image!(
    cube,
    painter: Order = Order::new(),
    strip: [u8; STRIP] = [0; STRIP],
    memory: [Rgb565; PIXELS] = [scene::BACKGROUND; PIXELS],
    {
        let scene = Turntable::turned();
        let light = scene.light();
        let light = light.as_ref()?;
        let shade = scene::flat(&cube.mesh, |normal| light.level(normal));
        painter.clear();
        scene.place(cube).faces(shade).sorted(painter).ok()?;
        if IN_BANDS {
            let order = painter.order();
            let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
            while let Some(mut band) = frame.next_band(strip).ok()? {
                let Ok(()) = order.draw(&mut band.pixels());
                band.send(&mut Sink).ok()?;
            }
        } else {
            let mut picture = Picture::new(memory, black_box(Size::new(scene::SIZE, ROWS))).ok()?;
            let Ok(_) = painter.draw(&mut picture.pixels());
            black_box(picture.colors());
        }
        Some(())
    }
);
