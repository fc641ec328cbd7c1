//! Scenes drawn into a DrawTarget that is not this library's: [`Screen`].

use super::three::TORUS_EDGED;
use super::two::corners;
use super::{count_screen, Counted, Deep, Frame, Plain, Smooth, CUBE, TORUS};
use crate::lists::{COLOURS, LINES, SCREEN, TORUS_NORMALS, TRIANGLES};
use crate::scene::{self, area, Model, Scene, LINE};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{raw::RawU16, Rgb565, Rgb888, RgbColor};
use pinhole::raster::Pixel;
use pinhole::{draw_line, fill_triangle, DepthBuffer, FacePlanes, ShadeTable};

pub fn s1_dt(memory: &mut Plain<CUBE>) -> Option<Counted> {
    wire(&scene::CUBE, memory)
}

pub fn s3_dt_wire(memory: &mut Plain<TORUS>) -> Option<Counted> {
    wire(&TORUS_EDGED, memory)
}

#[inline(always)]
fn wire<const N: usize>(model: &'static Model, memory: &mut Plain<N>) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let Plain { frame, corners } = memory;
    let instance = scene.place();
    count_screen(frame, &mut |screen| {
        let Ok(statistics) = black_box(&instance).wireframe(black_box(LINE), corners, screen);
        black_box(statistics);
        Some(())
    })
}

pub fn s2_dt(memory: &mut Plain<CUBE>) -> Option<Counted> {
    flat(&scene::CUBE, memory)
}

pub fn s3_dt(memory: &mut Plain<TORUS>) -> Option<Counted> {
    flat(&scene::TORUS_BY_PLANES, memory)
}

pub fn s2_dt_z(memory: &mut Deep<CUBE>) -> Option<Counted> {
    flat_z(&scene::CUBE, memory)
}

pub fn s3_dt_z(memory: &mut Deep<TORUS>) -> Option<Counted> {
    flat_z(&scene::TORUS_BY_PLANES, memory)
}

#[inline(always)]
fn flat<P: FacePlanes, const N: usize>(
    model: &'static Model<P>,
    Plain { frame, corners }: &mut Plain<N>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let (light, instance) = (scene.light()?, scene.place());
    count_screen(frame, &mut |screen| {
        let (instance, light) = black_box((&instance, &light));
        let shade = scene::flat_of_normals(instance.mesh().normals(), light);
        let Ok(statistics) = instance.solid(shade, corners, screen);
        black_box(statistics);
        Some(())
    })
}

#[inline(always)]
fn flat_z<P: FacePlanes, const N: usize>(
    model: &'static Model<P>,
    Deep { frame, depth, corners }: &mut Deep<N>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let (light, instance) = (scene.light()?, scene.place());
    count_screen(frame, &mut |screen| {
        let (instance, light) = black_box((&instance, &light));
        let mut depth = DepthBuffer::new(black_box(area()), &mut depth.0).ok()?;
        let shade = scene::flat_of_normals(instance.mesh().normals(), light);
        let Ok(statistics) = instance.depth_tested(shade, corners, &mut depth, screen);
        black_box(statistics);
        Some(())
    })
}

pub fn s8_dt_z(Smooth { deep, levels }: &mut Smooth<TORUS>) -> Option<Counted> {
    let Deep { frame, depth, corners } = deep;
    let scene = Scene::new(&scene::TORUS_BY_PLANES)?;
    let (light, instance) = (scene.light()?, scene.place());
    let white = ShadeTable::new(Rgb888::WHITE);
    count_screen(frame, &mut |screen| {
        let (instance, light, white) = black_box((&instance, &light, &white));
        light.levels(black_box(&TORUS_NORMALS), levels);
        let mut depth = DepthBuffer::new(black_box(area()), &mut depth.0).ok()?;
        let shade = |face| white.lit(instance.mesh().corners_of(face, levels));
        let Ok(statistics) = instance.depth_tested(shade, corners, &mut depth, screen);
        black_box(statistics);
        Some(())
    })
}

pub fn s5_dt(frame: &mut Frame) -> Option<Counted> {
    count_screen(frame, &mut |screen| {
        let Ok(()) = fill_triangle(corners(black_box(&SCREEN))?, black_box(LINE), screen);
        Some(())
    })
}

pub fn s6_dt(frame: &mut Frame) -> Option<Counted> {
    count_screen(frame, &mut |screen| {
        let colour = black_box(LINE);
        for &[x0, y0, x1, y1] in black_box(&LINES) {
            let Ok(()) = draw_line(Pixel { x: x0, y: y0 }, Pixel { x: x1, y: y1 }, colour, screen);
        }
        Some(())
    })
}

pub fn s7_dt(frame: &mut Frame) -> Option<Counted> {
    count_screen(frame, &mut |screen| {
        for (triangle, &colour) in black_box(&TRIANGLES).iter().zip(black_box(&COLOURS)) {
            let colour = Rgb565::from(RawU16::new(colour));
            let Ok(()) = fill_triangle(corners(triangle)?, colour, screen);
        }
        Some(())
    })
}
