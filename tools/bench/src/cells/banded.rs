//! Models in bands, as many pixels sent as a frame has, and in one piece. Both clear the picture and set the object's transform up in
//! each frame. The meshes have no planes.

use super::{
    count, count_screen, draw_faces, drawn, Counted, Frame, Memory, Plain, LIST, TORUS, TORUS_BINS,
    TORUS_EDGE_BINS, TORUS_SMOOTH,
};
use crate::bands::{self, EdgeStorage, Storage};
use crate::board::Clock;
use crate::growth::cases::WHEEL;
use crate::measure::Display;
use crate::scene::{self, area, Model, Scene, BACKGROUND, LINE};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::{BinaryColor, Rgb565};
use pinhole::draw::{ActiveFace, SmoothEdge};
use pinhole::prelude::*;

/// Memory of a strip, of its depth if there is any, of a mesh's vertices and its binned faces or edges.
pub struct Strip<const BYTES: usize, const DEPTHS: usize, const BINS: usize, const CORNERS: usize>(
    MeshBuffers<CORNERS, BINS>,
    StripBuffers<BYTES, DEPTHS>,
);

impl<const BYTES: usize, const DEPTHS: usize, const BINS: usize, const CORNERS: usize>
    Strip<BYTES, DEPTHS, BINS, CORNERS>
{
    pub const NEW: Self = Self(MeshBuffers::new(), StripBuffers::new());

    pub(super) fn storage(&mut self) -> Storage<'_> {
        let Self(MeshBuffers { cache, bins, .. }, StripBuffers { colors, depths, .. }) = self;
        Storage { corners: cache, bin_storage: bins, strip: colors, depth: depths }
    }

    /// A model's faces, with depth where the memory has depths.
    pub(super) fn faces(&mut self, model: &'static Model) -> Option<Counted> {
        let scene = Scene::new(model)?;
        let light = scene.light()?;
        count_bands(&mut |display| match const { DEPTHS == 0 } {
            true => bands::lit_solid(black_box(&scene), black_box(&light), self.storage(), display),
            false => bands::lit_depth(black_box(&scene), black_box(&light), self.storage(), display),
        })
    }

    /// A model's edges.
    pub(super) fn wire(&mut self, model: &'static Model) -> Option<Counted> {
        let scene = Scene::new(model)?;
        count_bands(&mut |display| {
            bands::wireframe(&black_box(&scene).place(), area().size, self.storage(), |edges, band| {
                let Ok(()) = edges.draw(LINE, &mut band.pixels());
                display.take_bytes(band.bytes());
            })
        })
    }
}

/// A strip of 8 rows and two that wait for the torus, whose edges are smoothed.
pub struct SmoothStrip<const LIST: usize>(
    Strip<{ bands::bytes(10) }, { bands::pixels(10) }, TORUS_BINS, TORUS>,
    [u8; bands::bytes(2)],
    [u16; TORUS_EDGE_BINS],
    [SmoothEdge; LIST],
);

impl<const LIST: usize> SmoothStrip<LIST> {
    pub const NEW: Self =
        Self(Strip::NEW, [0; bands::bytes(2)], [0; TORUS_EDGE_BINS], [SmoothEdge::EMPTY; LIST]);

    /// The torus's silhouettes, and its creases.
    pub(super) fn torus(&mut self, has_creases: bool) -> Option<Counted> {
        let (Self(strip, kept, bins, list), scene) = (self, Scene::new(&TORUS_SMOOTH)?);
        let light = scene.light()?;
        count_bands(&mut |to| {
            let (scene, light) = black_box((&scene, &light));
            bands::lit_smooth(
                scene,
                light,
                strip.storage(),
                EdgeStorage { kept, bins, list },
                has_creases,
                to,
            )
        })
    }
}

/// A strip of 8 rows for the torus with four samples a pixel, and their means.
pub struct Sampled(
    Strip<{ 4 * bands::bytes(8) }, { 4 * bands::pixels(8) }, TORUS_BINS, TORUS>,
    [u8; bands::bytes(8)],
);

impl Sampled {
    pub const NEW: Self = Self(Strip::NEW, [0; bands::bytes(8)]);

    pub(super) fn torus(&mut self) -> Option<Counted> {
        let (Self(strip, means), torus) = (self, black_box(&scene::TORUS));
        let scene = Scene::viewed(torus.mesh, torus.axes, [0, 0, torus.distance], area().size * 2)?;
        let light = scene.light()?;
        count_bands(&mut |to| {
            bands::sampled(black_box(&scene), black_box(&light), strip.storage(), means, to)
        })
    }
}

/// A strip for the torus with a list of active faces.
pub struct Listed<const WORDS: usize, const BYTES: usize, const DEPTHS: usize>(
    Strip<BYTES, DEPTHS, TORUS_BINS, TORUS>,
    [ActiveFace<Rgb565, WORDS>; LIST],
);

impl<const WORDS: usize, const BYTES: usize, const DEPTHS: usize> Listed<WORDS, BYTES, DEPTHS> {
    pub const NEW: Self = Self(Strip::NEW, [ActiveFace::EMPTY; LIST]);

    pub(super) fn torus(&mut self, draw: bands::ActiveFrame<WORDS>) -> Option<Counted> {
        let (Self(strip, list), scene) = (self, Scene::new(&scene::TORUS)?);
        let light = scene.light()?;
        count_bands(&mut |to| draw(black_box(&scene), black_box(&light), strip.storage(), list, to))
    }
}

/// A strip for the torus with depth, and the picture of a DrawTarget that copies bands.
pub struct Sent(Strip<{ bands::bytes(8) }, { bands::pixels(8) }, TORUS_BINS, TORUS>, Frame);

impl Sent {
    pub const NEW: Self = Self(Strip::NEW, Frame::NEW);

    pub(super) fn torus(&mut self) -> Option<Counted> {
        let (Self(strip, frame), scene) = (self, Scene::new(&scene::TORUS)?);
        let light = scene.light()?;
        count_screen(frame, &mut |screen| {
            let (scene, light) = black_box((&scene, &light));
            bands::depth(&scene.place(), scene.shade(light), area().size, strip.storage(), |band| {
                let Ok(()) = band.send(screen);
            })
        })
    }
}

/// What two cores need to draw a model in bands of 16 rows: a mesh's vertices and bins, a strip for each core, and the second cursor over
/// binned faces.
pub struct TwoCores<const BINS: usize, const CORNERS: usize>(
    MeshBuffers<CORNERS, BINS>,
    [StripBuffers<{ bands::bytes(16) }, { bands::pixels(16) }>; 2],
    [u16; BINS],
);

/// Runs the first and the second core's part of a stage: 0 transforms, 1 bins, 2 draws.
pub type Both<'b> = &'b mut dyn FnMut(usize, &mut (dyn FnMut() + Send), &mut (dyn FnMut() + Send));

impl<const BINS: usize, const CORNERS: usize> TwoCores<BINS, CORNERS> {
    pub const NEW: Self = Self(MeshBuffers::new(), [const { StripBuffers::new() }; 2], [0; BINS]);

    /// A frame with depth, until both cores have drawn their bands. One core does the parts of both, one after the other; of a stage that
    /// both would do at once, all bands together, the longer part counts.
    pub(super) fn faces(&mut self, model: &'static Model) -> Option<Counted> {
        let scene = Scene::new(model)?;
        let light = scene.light()?;
        let (mut clock, mut display, mut parts) = (Clock::new()?, Display::default(), [[0; 2]; 3]);
        self.frame(&scene, &light, &mut display, &mut |stage, first, second| {
            let [of_first, of_second] = &mut parts[stage];
            *of_first += clock.count(first).unwrap_or(u32::MAX / 64);
            *of_second += clock.count(second).unwrap_or(u32::MAX / 64);
        })?;
        let mut good = true;
        let mut once = |display: &mut Display| {
            good &= self
                .frame(&scene, &light, display, &mut |_, first, second| {
                    first();
                    second();
                })
                .is_some();
        };
        let all = clock.count(&mut || once(&mut display))?;
        let crc = display.look(&mut once);
        let at_once: u32 = parts.iter().map(|[first, second]| first.min(second)).sum();
        good.then_some(Counted { instructions: all.checked_sub(at_once)?, crc })
    }

    /// Draws a frame, of which `both` runs the parts.
    #[inline(never)]
    pub fn frame(&mut self, scene: &Scene, light: &Lambert, to: &mut Display, both: Both<'_>) -> Option<()> {
        let (scene, light) = black_box((scene, light));
        let Self(MeshBuffers { cache, bins, .. }, [even, odd], cursor) = self;
        let instance = scene.place();
        let transformed = instance.split_transform_depth(cache, |first, second| both(0, first, second));
        let mut faces = transformed.split_bin_faces(bins, |first, second| both(1, first, second)).ok()?;
        let [mut first, mut second] = faces.fork(cursor).ok()?;
        let (frame, shade) = (pinhole::bands::Frame::new(area(), BACKGROUND), scene.shade(light));
        let draw = |faces: &mut BinnedFaces<'_>, index, strip: &mut StripBuffers<_, _>| {
            let Some(mut band) = frame.nth_band(index, &mut strip.colors).ok()? else { return Some(()) };
            let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).ok()?;
            faces.draw(&shade, &mut band.pixels().depth_tested(&mut depth)).ok()
        };
        let bands = area().size.height.div_ceil(16);
        for index in (0..bands).step_by(2) {
            let mut drawn = [None; 2];
            let [on_even, on_odd] = &mut drawn;
            both(2, &mut || *on_even = draw(&mut first, index, even), &mut || {
                *on_odd = draw(&mut second, index + 1, odd)
            });
            drawn.iter().try_for_each(|drawn| *drawn)?;
            to.take_bytes(&even.colors);
            if index + 1 < bands {
                to.take_bytes(&odd.colors);
            }
        }
        black_box(faces.statistics());
        Some(())
    }
}

/// Memory of a wheel of 144 vertices, 288 faces and 432 edges, and of a strip of 16 rows of one bit.
pub struct Wheel(
    MeshBuffers<144, { 288 + 18 + 32 }, { 432 + 27 + 32 }>,
    StripBuffers<{ 16 * 16 }, { 128 * 16 }>,
);

impl Wheel {
    pub const NEW: Self = Self(MeshBuffers::new(), StripBuffers::new());

    /// The edges that no face hides, on a display of 128 × 64 pixels of one bit, turned as S3.
    pub(super) fn hidden(&mut self) -> Option<Counted> {
        let (mesh, size) = (WHEEL.with_edge_faces(1)?, Size::new(128, 64));
        let scene = Scene::viewed(mesh, black_box(&scene::TORUS).axes, [0, 0, 222_822], size)?;
        count_bands(&mut |display| {
            let Self(MeshBuffers { cache, bins, edge_bins }, StripBuffers { colors, depths, .. }) = self;
            let storage = Storage { corners: cache, bin_storage: bins, strip: colors, depth: depths };
            let colors = [BinaryColor::On, BinaryColor::Off];
            bands::hidden(&black_box(&scene).place(), colors, size, edge_bins, storage, |band| {
                display.take_bytes(band.bytes());
            })
        })
    }
}

/// Draws three frames, counts the second, and takes the checksum of the third.
pub(super) fn count_bands(frame: &mut dyn FnMut(&mut Display) -> Option<()>) -> Option<Counted> {
    let (mut clock, mut display, mut good) = (Clock::new()?, Display::default(), true);
    let mut once = |display: &mut Display| good &= frame(display).is_some();
    once(&mut display);
    let instructions = clock.count(&mut || once(&mut display))?;
    let crc = display.look(&mut once);
    good.then_some(Counted { instructions, crc })
}

pub(super) fn full_wire<const N: usize>(
    model: &'static Model,
    Plain { frame, corners, .. }: &mut Plain<N>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    count(frame, &mut |picture| {
        let Ok(()) = picture.clear(BACKGROUND);
        drawn(black_box(&scene).place().edges(|_| LINE).cached(corners).draw(&mut picture.pixels()))
    })
}

pub(super) fn full<const N: usize, const DEPTH_ROWS: usize>(
    model: &'static Model,
    Memory { frame, depth, corners }: &mut Memory<N, DEPTH_ROWS>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let light = scene.light()?;
    count(frame, &mut |picture| {
        let (scene, light) = black_box((&scene, &light));
        let Ok(()) = picture.clear(BACKGROUND);
        draw_faces(scene.place().faces(scene.shade(light)).cached(corners), depth, &mut picture.pixels())
    })
}
