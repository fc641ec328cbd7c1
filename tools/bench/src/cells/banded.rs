//! Models in bands, as many pixels sent as a frame has, and S3's frame in one piece. Both clear the picture and set the object's
//! transform up in each frame. The meshes have no planes.

use super::{count, Counted, Deep, Plain, ICO, TORUS};
use crate::bands::{self, bytes, pixels, Storage};
use crate::board::Clock;
use crate::measure::Display;
use crate::scene::{self, area, Model, Scene, BACKGROUND, LINE};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use pinhole::{AntiAliased, DepthBuffer, ScreenVertex};

/// The torus's visible faces, with some to spare, and a bit for each of its 1000 faces.
const BIN_STORAGE: usize = 480 + 1000_usize.div_ceil(16);
/// The torus's edges, and a bit for each.
const EDGE_BINS: usize = 1500 + 1500_usize.div_ceil(16);

/// The icosphere's visible faces, with some to spare, and a bit for each of its 5780 faces.
const ICO_BINS: usize = 1750 + 5780_usize.div_ceil(16);

/// Memory of a strip, of its depth if there is any, of a mesh's vertices and its binned faces or edges.
pub struct Strip<const BYTES: usize, const DEPTHS: usize, const BINS: usize, const CORNERS: usize> {
    corners: [ScreenVertex; CORNERS],
    bin_storage: [u16; BINS],
    strip: [u8; BYTES],
    depth: [u16; DEPTHS],
}

/// For bands of 8 rows, without depth and with it, and for 16 rows.
pub type Strip8 = Strip<{ bytes(8) }, 0, BIN_STORAGE, TORUS>;
pub type Strip8Deep = Strip<{ bytes(8) }, { pixels(8) }, BIN_STORAGE, TORUS>;
pub type Strip16 = Strip<{ bytes(16) }, 0, BIN_STORAGE, TORUS>;
pub type Strip16Deep = Strip<{ bytes(16) }, { pixels(16) }, BIN_STORAGE, TORUS>;
pub type Strip8DeepIco = Strip<{ bytes(8) }, { pixels(8) }, ICO_BINS, ICO>;
/// For lines in bands of 8 rows.
pub type LineStrip8 = Strip<{ bytes(8) }, 0, EDGE_BINS, TORUS>;

impl<const BYTES: usize, const DEPTHS: usize, const BINS: usize, const CORNERS: usize>
    Strip<BYTES, DEPTHS, BINS, CORNERS>
{
    pub const NEW: Self = Self {
        corners: [ScreenVertex::EMPTY; CORNERS],
        bin_storage: [0; BINS],
        strip: [0; BYTES],
        depth: [0; DEPTHS],
    };

    fn storage(&mut self) -> Storage<'_> {
        let Self { corners, bin_storage, strip, depth } = self;
        Storage { corners, bin_storage, strip, depth }
    }
}

pub(super) fn plain<const BYTES: usize, const DEPTHS: usize, const BINS: usize, const CORNERS: usize>(
    model: &'static Model,
    memory: &mut Strip<BYTES, DEPTHS, BINS, CORNERS>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let light = scene.light()?;
    count_bands(&mut |display| bands::solid(black_box(&scene), black_box(&light), memory.storage(), display))
}

pub(super) fn deep<const BYTES: usize, const DEPTHS: usize, const BINS: usize, const CORNERS: usize>(
    model: &'static Model,
    memory: &mut Strip<BYTES, DEPTHS, BINS, CORNERS>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let light = scene.light()?;
    count_bands(&mut |display| bands::depth(black_box(&scene), black_box(&light), memory.storage(), display))
}

/// A model's edges, anti-aliased.
pub(super) fn smooth<const BYTES: usize, const DEPTHS: usize, const BINS: usize, const CORNERS: usize>(
    model: &'static Model,
    memory: &mut Strip<BYTES, DEPTHS, BINS, CORNERS>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    count_bands(&mut |display| {
        bands::wireframe(black_box(&scene), AntiAliased(LINE), memory.storage(), display)
    })
}

/// Draws three frames, counts the second, and takes the checksum of the third.
fn count_bands(frame: &mut dyn FnMut(&mut Display) -> Option<()>) -> Option<Counted> {
    let (mut clock, mut display, mut good) = (Clock::new()?, Display::default(), true);
    let mut once = |display: &mut Display| good &= frame(display).is_some();
    once(&mut display);
    let instructions = clock.count(&mut || once(&mut display))?;
    let crc = display.look(&mut once);
    // Pixels leave with each band: nobody counts those that are drawn.
    good.then_some(Counted { instructions, crc, drawn: 0 })
}

pub(super) fn full(Plain { frame, corners }: &mut Plain<TORUS>) -> Option<Counted> {
    let scene = Scene::new(&scene::TORUS)?;
    let light = scene.light()?;
    count(frame, &mut |picture| {
        let (scene, light) = black_box((&scene, &light));
        let Ok(()) = picture.clear(BACKGROUND);
        let Ok(statistics) = scene.place().solid(scene.shade(light), corners, &mut picture.pixels());
        black_box(statistics);
        Some(())
    })
}

pub(super) fn full_z(Deep { frame, depth, corners }: &mut Deep<TORUS>) -> Option<Counted> {
    let scene = Scene::new(&scene::TORUS)?;
    let light = scene.light()?;
    count(frame, &mut |picture| {
        let (scene, light) = black_box((&scene, &light));
        let Ok(()) = picture.clear(BACKGROUND);
        let mut depth = DepthBuffer::new(black_box(area()), &mut depth.0).ok()?;
        let (shade, mut pixels) = (scene.shade(light), picture.pixels());
        let Ok(statistics) = scene.place().depth_tested(shade, corners, &mut depth, &mut pixels);
        black_box(statistics);
        Some(())
    })
}
