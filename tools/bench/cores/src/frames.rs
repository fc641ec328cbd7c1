//! A frame drawn by two cores, independent of how they are run.

use bench::bands::{bytes, pixels};
use bench::scene::{area, Scene, BACKGROUND};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{Band, BinnedFaces, DepthBuffer, Frame, Lambert, ScreenVertex};

/// Rows of a band.
pub(crate) const ROWS: u32 = 16;

/// The sizes for S4, the larger scene: vertices; visible faces with a bit for each face of the mesh; and these bits once more for
/// the second cursor.
pub(crate) const VERTICES: usize = 2892;
pub(crate) const CURSOR: usize = 5780_usize.div_ceil(16);
pub(crate) const BIN_STORAGE: usize = 1800 + CURSOR;

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

/// Chooses the band that a core draws after another one: `core` is 0 or 1.
pub(crate) trait Deal: Sync {
    fn next(&self, core: u32, before: Option<u32>) -> u32;
}

/// Every other band.
pub(crate) struct Alternating;

impl Deal for Alternating {
    fn next(&self, core: u32, before: Option<u32>) -> u32 {
        before.map_or(core, |before| before + 2)
    }
}

/// A way to draw frames. `take` gets the number and the bytes of each band.
pub(crate) trait Way {
    const NAME: &'static str;

    fn frame(
        scene: &Scene,
        light: &Lambert,
        memory: &mut Memory,
        cores: &mut impl Cores,
        deal: &impl Deal,
        take: &(impl Fn(u32, &[u8]) + Sync),
    ) -> Option<()>;
}

pub(crate) struct Solid;
pub(crate) struct WithDepth;

impl Way for Solid {
    const NAME: &'static str = "solid";

    fn frame(
        scene: &Scene,
        light: &Lambert,
        memory: &mut Memory,
        cores: &mut impl Cores,
        deal: &impl Deal,
        take: &(impl Fn(u32, &[u8]) + Sync),
    ) -> Option<()> {
        let Memory { corners, bin_storage, cursor, strips: [strip, other_strip], .. } = memory;
        let instance = scene.place();
        let mut split = instance.split_transform(corners);
        let [ours, theirs] = split.halves();
        cores.both(|| ours.transform(), || theirs.transform());
        let mut split = split.finish().split_bin_faces(bin_storage);
        let [ours, theirs] = split.halves();
        cores.both(|| ours.count(), || theirs.count());
        let mut faces = split.finish().ok()?;
        let [ours, theirs] = faces.fork(cursor).ok()?;
        let draw = |core: u32, strip: &mut [u8], mut faces: BinnedFaces<'_>| {
            bands(deal, core, strip, take, |band| {
                let Ok(()) = faces.solid(scene.shade(light), &mut band.pixels());
                Some(())
            })
        };
        let (mut good, mut other_good) = (None, None);
        cores.both(|| good = draw(0, strip, ours), || other_good = draw(1, other_strip, theirs));
        black_box(faces.statistics());
        good.and(other_good)
    }
}

impl Way for WithDepth {
    const NAME: &'static str = "depth";

    fn frame(
        scene: &Scene,
        light: &Lambert,
        memory: &mut Memory,
        cores: &mut impl Cores,
        deal: &impl Deal,
        take: &(impl Fn(u32, &[u8]) + Sync),
    ) -> Option<()> {
        let Memory { corners, bin_storage, cursor, strips, depths } = memory;
        let ([strip, other_strip], [depth, other_depth]) = (strips, depths);
        let instance = scene.place();
        let mut split = instance.split_transform_depth(corners);
        let [ours, theirs] = split.halves();
        cores.both(|| ours.transform(), || theirs.transform());
        let mut split = split.finish().split_bin_faces(bin_storage);
        let [ours, theirs] = split.halves();
        cores.both(|| ours.count(), || theirs.count());
        let mut faces = split.finish().ok()?;
        let [ours, theirs] = faces.fork(cursor).ok()?;
        let draw = |core: u32, strip: &mut [u8], depth: &mut [u16], mut faces: BinnedFaces<'_, i16, true>| {
            bands(deal, core, strip, take, |band| {
                let mut depth = DepthBuffer::new(band.area(), depth).ok()?;
                let Ok(()) = faces.depth_tested(scene.shade(light), &mut depth, &mut band.pixels());
                Some(())
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

/// The bands of one core.
fn bands(
    deal: &impl Deal,
    core: u32,
    strip: &mut [u8],
    take: &(impl Fn(u32, &[u8]) + Sync),
    mut draw: impl FnMut(&mut Band<'_, Rgb565>) -> Option<()>,
) -> Option<()> {
    let (frame, mut index) = (Frame::new(area(), BACKGROUND), deal.next(core, None));
    while let Some(mut band) = frame.nth_band(index, strip).ok()? {
        draw(&mut band)?;
        take(index, band.bytes());
        index = deal.next(core, Some(index));
    }
    Some(())
}
