//! A frame drawn by two cores, independent of how they are run.

use bench::bands::{self, bytes, pixels, LitFrame};
use bench::scene::{area, Scene, BACKGROUND};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::prelude::*;

/// Rows of a band.
pub(crate) const ROWS: u32 = 16;

/// The sizes for S4, the larger scene: vertices; a bit for each face, for each cursor; faces with these bits and the bins.
pub(crate) const VERTICES: usize = 2892;
pub(crate) const CURSOR: usize = 5780_usize.div_ceil(16);
pub(crate) const BIN_STORAGE: usize = 5780 + CURSOR + 32;

/// A strip and a depth strip for each core, and what both share.
pub(crate) struct Memory {
    pub(crate) corners: [ScreenVertex; VERTICES],
    pub(crate) bin_storage: [u16; BIN_STORAGE],
    pub(crate) cursor: [u16; CURSOR],
    pub(crate) strips: [[u8; bytes(ROWS)]; 2],
    pub(crate) depths: [[u16; pixels(ROWS)]; 2],
}

/// Runs work for two cores.
pub(crate) trait Cores {
    /// Returns when both are done.
    fn both(&mut self, ours: impl FnOnce(), theirs: impl FnOnce() + Send);
}

/// A way to draw frames. `take` gets the number and the bytes of each band.
pub(crate) trait Way {
    const NAME: &'static str;
    /// A frame on one core, as the other images of the bench draw it.
    const ONE: LitFrame;

    fn frame(
        scene: &Scene,
        light: &Lambert,
        memory: &mut Memory,
        cores: &mut impl Cores,
        take: &(impl Fn(u32, &[u8]) + Sync),
    ) -> Option<()>;
}

/// A [`Way`] whose `$draw` draws the `$faces` of a band.
macro_rules! way {
    ($way:ident, $name:literal, $one:path, $transform:ident, $binned:ty, |$faces:ident, $shade:ident, $depth:ident, $band:ident| $draw:expr) => {
        pub(crate) struct $way;

        impl Way for $way {
            const NAME: &'static str = $name;
            const ONE: LitFrame = $one;

            fn frame(
                scene: &Scene,
                light: &Lambert,
                memory: &mut Memory,
                cores: &mut impl Cores,
                take: &(impl Fn(u32, &[u8]) + Sync),
            ) -> Option<()> {
                let Memory { corners, bin_storage, cursor, strips, depths } = memory;
                let ([strip, other_strip], [depth, other_depth]) = (strips, depths);
                let instance = scene.place();
                let transformed = instance.$transform(corners, |ours, theirs| cores.both(ours, theirs));
                let faces = transformed.split_bin_faces(bin_storage, |ours, theirs| cores.both(ours, theirs));
                let mut faces = faces.ok()?;
                let [ours, theirs] = faces.fork(cursor).ok()?;
                let draw = |core: u32, strip: &mut [u8], $depth: &mut [u16], mut $faces: $binned| {
                    each_band(core, strip, take, |$band| {
                        let $shade = scene.shade(light);
                        $draw
                    })
                };
                let (mut good, mut other_good) = (None, None);
                cores.both(
                    || good = draw(0, strip, depth, ours),
                    || other_good = draw(1, other_strip, other_depth, theirs),
                );
                black_box(faces.statistics());
                good.and(other_good)
            }
        }
    };
}

way!(
    Solid,
    "solid",
    bands::lit_solid,
    split_transform,
    BinnedFaces<'_, i16, false>,
    |faces, shade, _depth, band| faces.draw(shade, &mut band.pixels()).ok()
);
way!(
    WithDepth,
    "depth",
    bands::lit_depth,
    split_transform_depth,
    BinnedFaces<'_>,
    |faces, shade, depth, band| {
        let mut depth = DepthBuffer::new(band.area(), depth).ok()?;
        faces.draw(shade, &mut band.pixels().depth_tested(&mut depth)).ok()
    }
);

/// The bands of one core: every other one.
fn each_band(
    core: u32,
    strip: &mut [u8],
    take: &(impl Fn(u32, &[u8]) + Sync),
    mut draw: impl FnMut(&mut Band<'_, Rgb565>) -> Option<()>,
) -> Option<()> {
    let (frame, mut index) = (Frame::new(area(), BACKGROUND), core);
    while let Some(mut band) = frame.nth_band(index, strip).ok()? {
        draw(&mut band)?;
        take(index, band.bytes());
        index += 2;
    }
    Some(())
}
