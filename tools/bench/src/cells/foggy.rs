//! G1 to G3: fog by pixel. G1: S3's torus, in fog from its nearest to its farthest point, so that all 32 levels are on it; G2: X3's
//! rolled floor, in one colour, whose two faces have all levels each; G3: X1's textured torus in the fog of G1.

use super::textured::{torus_uv, Floor, FLOOR_VIEW, X3};
use super::{count, draw_faces, drawn, Counted, Deep, Memory, Plain, TORUS};
use crate::lists::PICTURE;
use crate::scene::{self, Scene};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor, WebColors};
use pinhole::space::{Model, World};
use pinhole::{
    fog::{Fog, FogTable},
    prelude::*,
};

/// Fog between these distances.
#[inline(never)] // set-up: off the stack when it returns
pub(super) fn fog(range: [i32; 2], camera: &Camera) -> Option<FogTable<Rgb565>> {
    let [start, end] = black_box(range).map(Scalar::from_int);
    FogTable::new(&Fog::new(start, end).ok()?, camera, Rgb565::CSS_LIGHT_STEEL_BLUE).ok()
}

/// The torus lies between the distances 2.04 and 4.73.
const TORUS_FOG: [i32; 2] = [2, 5];
/// The floor lies between 0.5, where the near plane cuts it, and 9.5.
const FLOOR_FOG: [i32; 2] = [1, 9];

pub(super) fn g1<const DEPTH_ROWS: usize>(
    Memory { frame, depth, corners }: &mut Memory<TORUS, DEPTH_ROWS>,
) -> Option<Counted> {
    let scene = Scene::new(&scene::TORUS_BY_PLANES)?;
    let (light, instance, fog) = (scene.light()?, scene.place(), fog(TORUS_FOG, &scene.camera)?);
    count(frame, &mut |picture| {
        let (instance, light, fog) = black_box((&instance, &light, &fog));
        let shade = scene::flat_of_normals(instance.mesh().normals(), light);
        let shade = |face| Fogged::new(shade(face), fog);
        draw_faces(instance.faces(shade).culled_by_planes().cached(corners), depth, &mut picture.pixels())
    })
}

pub(super) fn g2(Plain { frame, corners, .. }: &mut Plain<4>) -> Option<Counted> {
    let (camera, floor): (_, &Floor) = (FLOOR_VIEW.camera()?, black_box(&X3));
    let (instance, fog) =
        (camera.place(&floor.mesh, &Affine::<Model, World>::identity()), fog(FLOOR_FOG, &camera)?);
    count(frame, &mut |picture| {
        let (instance, fog) = black_box((&instance, &fog));
        let shade = |_| Fogged::new(Rgb565::RED, fog);
        drawn(instance.faces(shade).cached(corners).draw(&mut picture.pixels()))
    })
}

pub(super) fn g3_z(Deep { frame, depth, corners }: &mut Deep<TORUS>) -> Option<Counted> {
    let scene = Scene::new(&scene::TORUS_BY_PLANES)?;
    let (texture, instance, fog) = (Texture::new(&PICTURE), scene.place(), fog(TORUS_FOG, &scene.camera)?);
    count(frame, &mut |picture| {
        let (instance, texture, fog) = black_box((&instance, &texture, &fog));
        let shade = |face| Fogged::new(texture.at(torus_uv(face)), fog);
        draw_faces(instance.faces(shade).culled_by_planes().cached(corners), depth, &mut picture.pixels())
    })
}
