//! S1 to S4 and S8: models seen by a camera. Camera, light, colours and the model's transform are set up before the frame.
//! The torus and the icosphere are culled by face planes; the cube has too few faces for it. Both are also drawn
//! without planes, to show their gain.

use super::{count, Counted, Deep, Plain, Smooth, CUBE, ICO, TORUS};
use crate::lists::{TORUS_EDGES, TORUS_NORMALS};
use crate::scene::{self, area, Model, Scene, LINE};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
#[cfg(not(target_os = "none"))]
use pinhole::ScreenVertex;
use pinhole::{AntiAliased, DepthBuffer, FacePlanes, Mesh, ShadeTable};

/// The torus with its edges alone, for wireframes.
pub(super) static TORUS_EDGED: Model = edged(&scene::TORUS, &TORUS_EDGES);

/// At compile time: without normals.
const fn edged(model: &Model, edges: &'static [[u16; 2]]) -> Model {
    let Model { mesh, axes, distance, reference } = model;
    let Ok(mesh) = Mesh::new(mesh.vertices(), mesh.exponent(), mesh.faces()) else { panic!("faces") };
    let Ok(mesh) = mesh.with_edges(edges) else { panic!("edges") };
    Model { mesh, axes: *axes, distance: *distance, reference: *reference }
}

pub fn s1(memory: &mut Plain<CUBE>) -> Option<Counted> {
    wire(&scene::CUBE, memory)
}

pub fn s3_wire(memory: &mut Plain<TORUS>) -> Option<Counted> {
    wire(&TORUS_EDGED, memory)
}

/// All edges of a model.
#[inline(always)]
pub(super) fn wire<const N: usize>(model: &'static Model, memory: &mut Plain<N>) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let Plain { frame, corners } = memory;
    let instance = scene.place();
    count(frame, &mut |picture| {
        let Ok(statistics) = black_box(&instance).wireframe(black_box(LINE), corners, &mut picture.pixels());
        black_box(statistics);
        Some(())
    })
}

pub fn s1_smooth(memory: &mut Plain<CUBE>) -> Option<Counted> {
    smooth_wire(&scene::CUBE, memory)
}

pub fn s3_smooth(memory: &mut Plain<TORUS>) -> Option<Counted> {
    smooth_wire(&TORUS_EDGED, memory)
}

/// All edges of a model, anti-aliased.
#[inline(always)]
fn smooth_wire<const N: usize>(model: &'static Model, memory: &mut Plain<N>) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let Plain { frame, corners } = memory;
    let instance = scene.place();
    count(frame, &mut |picture| {
        let (stroke, mut pixels) = (AntiAliased(black_box(LINE)), picture.pixels());
        let Ok(statistics) = black_box(&instance).wireframe(stroke, corners, &mut pixels);
        black_box(statistics);
        Some(())
    })
}

/// S3's edges, anti-aliased and depth-tested, on a depth buffer that is clear.
pub fn s3_smooth_z(Deep { frame, depth, corners }: &mut Deep<TORUS>) -> Option<Counted> {
    let scene = Scene::new(&TORUS_EDGED)?;
    let instance = scene.place();
    count(frame, &mut |picture| {
        let mut depth = DepthBuffer::new(black_box(area()), &mut depth.0).ok()?;
        let (stroke, mut pixels) = (AntiAliased(black_box(LINE)), picture.pixels());
        let Ok(statistics) =
            black_box(&instance).wireframe_depth_tested(stroke, corners, &mut depth, &mut pixels);
        black_box(statistics);
        Some(())
    })
}

pub fn s2(memory: &mut Plain<CUBE>) -> Option<Counted> {
    flat(&scene::CUBE, memory)
}

pub fn s3(memory: &mut Plain<TORUS>) -> Option<Counted> {
    flat(&scene::TORUS_BY_PLANES, memory)
}

pub fn s4(memory: &mut Plain<ICO>) -> Option<Counted> {
    flat(&scene::ICO_BY_PLANES, memory)
}

pub fn s2_z(memory: &mut Deep<CUBE>) -> Option<Counted> {
    flat_z(&scene::CUBE, memory)
}

pub fn s3_z(memory: &mut Deep<TORUS>) -> Option<Counted> {
    flat_z(&scene::TORUS_BY_PLANES, memory)
}

pub fn s4_z(memory: &mut Deep<ICO>) -> Option<Counted> {
    flat_z(&scene::ICO_BY_PLANES, memory)
}

pub fn s3_no_planes(memory: &mut Plain<TORUS>) -> Option<Counted> {
    flat(&scene::TORUS, memory)
}

pub fn s4_no_planes(memory: &mut Plain<ICO>) -> Option<Counted> {
    flat(&scene::ICO, memory)
}

pub fn s3_z_no_planes(memory: &mut Deep<TORUS>) -> Option<Counted> {
    flat_z(&scene::TORUS, memory)
}

pub fn s4_z_no_planes(memory: &mut Deep<ICO>) -> Option<Counted> {
    flat_z(&scene::ICO, memory)
}

/// A light level for each face.
#[inline(always)]
pub(super) fn flat<P: FacePlanes, const N: usize>(
    model: &'static Model<P>,
    Plain { frame, corners }: &mut Plain<N>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let (light, instance) = (scene.light()?, scene.place());
    count(frame, &mut |picture| {
        let (instance, light) = black_box((&instance, &light));
        let (shade, mut pixels) =
            (scene::flat_of_normals(instance.mesh().normals(), light), picture.pixels());
        let Ok(statistics) = instance.solid(shade, corners, &mut pixels);
        black_box(statistics);
        Some(())
    })
}

#[inline(always)]
pub(super) fn flat_z<P: FacePlanes, const N: usize>(
    model: &'static Model<P>,
    Deep { frame, depth, corners }: &mut Deep<N>,
) -> Option<Counted> {
    let scene = Scene::new(model)?;
    let (light, instance) = (scene.light()?, scene.place());
    count(frame, &mut |picture| {
        let (instance, light) = black_box((&instance, &light));
        let mut depth = DepthBuffer::new(black_box(area()), &mut depth.0).ok()?;
        let (shade, mut pixels) =
            (scene::flat_of_normals(instance.mesh().normals(), light), picture.pixels());
        let Ok(statistics) = instance.depth_tested(shade, corners, &mut depth, &mut pixels);
        black_box(statistics);
        Some(())
    })
}

pub fn s8_z(memory: &mut Smooth<TORUS>) -> Option<Counted> {
    smooth_z(&scene::TORUS_BY_PLANES, memory)
}

pub fn s8_z_no_planes(memory: &mut Smooth<TORUS>) -> Option<Counted> {
    smooth_z(&scene::TORUS, memory)
}

/// The light at each vertex, and between them smoothly.
#[inline(always)]
fn smooth_z<P: FacePlanes>(
    model: &'static Model<P>,
    Smooth { deep, levels }: &mut Smooth<TORUS>,
) -> Option<Counted> {
    let Deep { frame, depth, corners } = deep;
    let scene = Scene::new(model)?;
    let (light, instance) = (scene.light()?, scene.place());
    let white = ShadeTable::new(Rgb888::WHITE);
    count(frame, &mut |picture| {
        let (instance, light, white) = black_box((&instance, &light, &white));
        light.levels(black_box(&TORUS_NORMALS), levels);
        let mut depth = DepthBuffer::new(black_box(area()), &mut depth.0).ok()?;
        let (shade, mut pixels) =
            (|face| white.lit(instance.mesh().corners_of(face, levels)), picture.pixels());
        let Ok(statistics) = instance.depth_tested(shade, corners, &mut depth, &mut pixels);
        black_box(statistics);
        Some(())
    })
}

/// Vertices that the frame of a cell places: those that have a place on the screen when it is drawn. All of these scenes
/// lie before the camera.
#[cfg(not(target_os = "none"))]
pub fn placed(scene: &str, variant: &str) -> Option<usize> {
    fn plain<const N: usize>(draw: fn(&mut Plain<N>) -> Option<Counted>) -> Option<usize> {
        let mut memory = super::boxed(Plain::NEW);
        draw(&mut memory)?;
        Some(with_a_place(&memory.corners))
    }
    fn deep<const N: usize>(draw: fn(&mut Deep<N>) -> Option<Counted>) -> Option<usize> {
        let mut memory = super::boxed(Deep::NEW);
        draw(&mut memory)?;
        Some(with_a_place(&memory.corners))
    }
    fn with_a_place(corners: &[ScreenVertex]) -> usize {
        corners.iter().filter(|&&corner| corner != ScreenVertex::EMPTY).count()
    }
    match (scene, variant) {
        ("S1", "plain") => plain(s1),
        ("S2", "plain") => plain(s2),
        ("S2", "z") => deep(s2_z),
        ("S3", "plain") => plain(s3),
        ("S3", "z") => deep(s3_z),
        ("S4", "plain") => plain(s4),
        ("S4", "z") => deep(s4_z),
        ("S8", "z") => {
            let mut memory = super::boxed(Smooth::NEW);
            s8_z(&mut memory)?;
            Some(with_a_place(&memory.deep.corners))
        }
        ("S5" | "S6" | "S7", _) => Some(0),
        _ => None,
    }
}
