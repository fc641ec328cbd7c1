//! S1 to S4 and S8: models before a camera. Camera, light and colours are set up before the frame, and the model is placed.
//! The torus and the icosphere have planes, and their faces are asked by these; the cube's are too few.

use super::{count, Counted, Deep, Plain, Smooth, CUBE, ICO, TORUS};
use crate::lists::TORUS_NORMALS;
use crate::scene::{self, area, Model, Scene, LINE};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::{DepthBuffer, ShadeTable};

pub fn s1(memory: &mut Plain<CUBE>) -> Option<Counted> {
    let scene = Scene::new(&scene::CUBE)?;
    let Plain { frame, corners } = memory;
    let placed = scene.place();
    count(frame, &mut |picture| {
        let Ok(statistics) = black_box(&placed).wireframe(black_box(LINE), corners, &mut picture.pixels());
        black_box(statistics);
        Some(())
    })
}

pub fn s2(memory: &mut Plain<CUBE>) -> Option<Counted> {
    flat::<false, _>(&scene::CUBE, memory)
}

pub fn s3(memory: &mut Plain<TORUS>) -> Option<Counted> {
    flat::<true, _>(&scene::TORUS, memory)
}

pub fn s4(memory: &mut Plain<ICO>) -> Option<Counted> {
    flat::<true, _>(&scene::ICO, memory)
}

pub fn s2_z(memory: &mut Deep<CUBE>) -> Option<Counted> {
    flat_z::<false, _>(&scene::CUBE, memory)
}

pub fn s3_z(memory: &mut Deep<TORUS>) -> Option<Counted> {
    flat_z::<true, _>(&scene::TORUS, memory)
}

pub fn s4_z(memory: &mut Deep<ICO>) -> Option<Counted> {
    flat_z::<true, _>(&scene::ICO, memory)
}

/// A level of light for each face, asked by its plane or not.
#[inline(always)]
fn flat<const PLANES: bool, const N: usize>(
    model: &'static Model,
    Plain { frame, corners }: &mut Plain<N>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let (light, placed) = (scene.light()?, scene.place());
    count(frame, &mut |picture| {
        let (placed, light) = black_box((&placed, &light));
        let (shade, mut pixels) = (scene::flat(placed.mesh(), light), picture.pixels());
        let Ok(statistics) = match PLANES {
            true => placed.facing().solid(shade, corners, &mut pixels),
            false => placed.solid(shade, corners, &mut pixels),
        };
        black_box(statistics);
        Some(())
    })
}

#[inline(always)]
fn flat_z<const PLANES: bool, const N: usize>(
    model: &'static Model,
    Deep { frame, depth, corners }: &mut Deep<N>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let (light, placed) = (scene.light()?, scene.place());
    count(frame, &mut |picture| {
        let (placed, light) = black_box((&placed, &light));
        let mut depth = DepthBuffer::new(black_box(area()), &mut depth.0).ok()?;
        let (shade, mut pixels) = (scene::flat(placed.mesh(), light), picture.pixels());
        let Ok(statistics) = match PLANES {
            true => placed.facing().depth_tested(shade, corners, &mut depth, &mut pixels),
            false => placed.depth_tested(shade, corners, &mut depth, &mut pixels),
        };
        black_box(statistics);
        Some(())
    })
}

/// The light at each vertex, and between them smoothly.
pub fn s8_z(Smooth { deep, levels }: &mut Smooth<TORUS>) -> Option<Counted> {
    let Deep { frame, depth, corners } = deep;
    let scene = Scene::new(&scene::TORUS)?;
    let (light, placed) = (scene.light()?, scene.place());
    let white = ShadeTable::new(Rgb888::WHITE);
    count(frame, &mut |picture| {
        let (placed, light, white) = black_box((&placed, &light, &white));
        light.levels(black_box(&TORUS_NORMALS), levels);
        let mut depth = DepthBuffer::new(black_box(area()), &mut depth.0).ok()?;
        let shade = |face| white.lit(placed.mesh().corners_of(face, levels));
        let Ok(statistics) = placed.facing().depth_tested(shade, corners, &mut depth, &mut picture.pixels());
        black_box(statistics);
        Some(())
    })
}
