//! All edges as lines: in bands, or into a whole picture if a band has all rows.
#![no_std]
#![no_main]

use linked::*;

const IS_WHOLE: bool = ROWS == HEIGHT;
const STRIP: usize = if IS_WHOLE { 0 } else { Frame::<Rgb565>::strip_bytes(WIDTH, ROWS) };
const PIXELS: usize = if IS_WHOLE { (WIDTH * HEIGHT) as usize } else { 0 };
const BINS: usize = if IS_WHOLE { 0 } else { MODEL.edge_bins_len() };
type Buffers = MeshBuffers<{ MODEL.vertices().len() }, 0, BINS>;

firmware!(|camera, turn, display: Rgb565|
    mesh: Buffers = Buffers::new(),
    strip: [u8; STRIP] = [0; STRIP],
    pixels: [Rgb565; PIXELS] = [Rgb565::BLACK; PIXELS],
    {
        let instance = camera.place(&MODEL, &Affine::rotation_y(turn));
        if IS_WHOLE {
            let mut picture = Picture::new(pixels, display.size()).ok()?;
            let Ok(()) = picture.clear(Rgb565::BLACK);
            let Ok(_) = instance.edges(|_| COLOR).cached(&mut mesh.cache).draw(&mut picture.pixels());
            black_box(picture.colors());
            return Some(());
        }
        let mut edges = instance.transform(&mut mesh.cache).bin_edges(&mut mesh.edge_bins).ok()?;
        let mut frame = Frame::new(area(display), Rgb565::BLACK);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let Ok(()) = edges.draw(COLOR, &mut band);
            band.send(display).ok()?;
        }
        Some(())
    }
);
