//! Models in bands, as many pixels sent as a frame has, and in one piece. Both clear the picture and set the object's transform up in
//! each frame. The meshes have no planes.

use super::{count, draw_faces, drawn, Counted, Memory, Plain, LIST, TORUS, TORUS_LINKS};
use crate::bands::{self, Storage};
use crate::board::Clock;
use crate::measure::Display;
use crate::scene::{self, Model, Scene, BACKGROUND, LINE};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::draw::ActiveFace;
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

    fn storage(&mut self) -> Storage<'_> {
        let Self(MeshBuffers { cache, bins, .. }, StripBuffers { colors, depths }) = self;
        Storage { corners: cache, bin_storage: bins, strip: colors, depth: depths }
    }

    /// A model's faces, with depth where the memory has depths.
    pub(super) fn faces(&mut self, model: &'static Model) -> Option<Counted> {
        let scene = Scene::new(model)?;
        let light = scene.light()?;
        count_bands(&mut |display| match const { DEPTHS == 0 } {
            true => bands::solid(black_box(&scene), black_box(&light), self.storage(), display),
            false => bands::depth(black_box(&scene), black_box(&light), self.storage(), display),
        })
    }

    /// A model's edges.
    pub(super) fn wire(&mut self, model: &'static Model) -> Option<Counted> {
        let scene = Scene::new(model)?;
        count_bands(&mut |display| bands::wireframe(black_box(&scene), LINE, self.storage(), display))
    }
}

/// A strip for the torus with a list of active faces.
pub struct Listed<E, const BYTES: usize, const DEPTHS: usize>(
    Strip<BYTES, DEPTHS, TORUS_LINKS, TORUS>,
    [E; LIST],
);

impl<const BYTES: usize> Listed<ActiveFace<Rgb565>, BYTES, 0> {
    pub const NEW: Self = Self(Strip::NEW, [ActiveFace::EMPTY; LIST]);
}
impl<const BYTES: usize, const DEPTHS: usize> Listed<ActiveFace<Rgb565, 3>, BYTES, DEPTHS> {
    pub const NEW: Self = Self(Strip::NEW, [ActiveFace::EMPTY; LIST]);
}

impl<E, const BYTES: usize, const DEPTHS: usize> Listed<E, BYTES, DEPTHS> {
    pub(super) fn torus(
        &mut self,
        draw: fn(&Scene, &Lambert, Storage<'_>, &mut [E], &mut Display) -> Option<()>,
    ) -> Option<Counted> {
        let (Self(strip, list), scene) = (self, Scene::new(&scene::TORUS)?);
        let light = scene.light()?;
        count_bands(&mut |to| draw(black_box(&scene), black_box(&light), strip.storage(), list, to))
    }
}

/// Draws three frames, counts the second, and takes the checksum of the third.
fn count_bands(frame: &mut dyn FnMut(&mut Display) -> Option<()>) -> Option<Counted> {
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

pub(super) fn full<const N: usize, const DEPTHS: usize>(
    model: &'static Model,
    Memory { frame, depth, corners }: &mut Memory<N, DEPTHS>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let light = scene.light()?;
    count(frame, &mut |picture| {
        let (scene, light) = black_box((&scene, &light));
        let Ok(()) = picture.clear(BACKGROUND);
        draw_faces(scene.place().faces(scene.shade(light)).cached(corners), depth, &mut picture.pixels())
    })
}
