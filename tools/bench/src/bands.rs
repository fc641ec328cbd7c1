//! Whole frames in bands: faces are binned once, then drawn band by band.

use crate::measure::Display;
use crate::scene::{area, Scene, BACKGROUND, SIZE};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::draw::ActiveFace;
use pinhole::{prelude::*, shading::Stroke};

/// Bytes of the colour strip, for bands of `rows` rows.
pub const fn bytes(rows: u32) -> usize {
    Frame::<Rgb565>::strip_bytes(SIZE, rows)
}
/// Pixels of the depth strip, for bands of `rows` rows.
pub const fn pixels(rows: u32) -> usize {
    (SIZE * rows) as usize
}

/// Buffers that the caller provides for a frame in bands. The strips' lengths determine the rows of a band.
pub struct Storage<'s> {
    pub corners: &'s mut [ScreenVertex],
    pub bin_storage: &'s mut [u16],
    pub strip: &'s mut [u8],
    pub depth: &'s mut [u16],
}

pub fn wireframe(
    scene: &Scene,
    stroke: impl Stroke<Rgb565>,
    Storage { corners, bin_storage, strip, .. }: Storage<'_>,
    display: &mut Display,
) -> Option<()> {
    let instance = scene.place();
    let mut edges = instance.transform(corners).bin_edges(bin_storage).ok()?;
    let mut frame = Frame::new(area(), BACKGROUND);
    while let Some(mut band) = frame.next_band(strip).ok()? {
        let Ok(()) = edges.draw(stroke, &mut band.pixels());
        display.take_bytes(band.bytes());
    }
    black_box(edges.statistics());
    Some(())
}

/// Defines a function that draws faces in bands, of a list of active faces or without one.
macro_rules! faces {
    ($name:ident($($list:ident: $entry:ty)?), $transform:ident, $bin:ident, |$band:ident $(, $depth:ident)?| $target:expr) => {
        pub fn $name(
            scene: &Scene,
            light: &Lambert,
            Storage { corners, bin_storage, strip, depth: _depths }: Storage<'_>,
            $($list: &mut [$entry],)?
            display: &mut Display,
        ) -> Option<()> {
            let instance = scene.place();
            let mut faces = instance.$transform(corners).$bin(bin_storage $(, $list)?).ok()?;
            let mut frame = Frame::new(area(), BACKGROUND);
            while let Some(mut $band) = frame.next_band(strip).ok()? {
                $(let mut $depth = DepthBuffer::new($band.area(), _depths).ok()?;)?
                let Ok(()) = faces.draw(scene.shade(light), $target);
                display.take_bytes($band.bytes());
            }
            black_box(faces.statistics());
            Some(())
        }
    };
}

faces!(solid(), transform, bin_faces, |band| &mut band.pixels());
faces!(depth(), transform_depth, bin_faces, |band, depth| &mut band.pixels().depth_tested(&mut depth));
faces!(active(list: ActiveFace<Rgb565>), transform, bin_active_faces, |band| &mut band.pixels());
faces!(active_depth(list: ActiveFace<Rgb565, 3>), transform_depth, bin_active_faces, |band, depth| {
    &mut band.pixels().depth_tested(&mut depth)
});
