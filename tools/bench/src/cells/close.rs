//! C1 and C2: S3's torus from so near that parts of it lie behind the camera, and others beyond the borders of the picture.
//! Pose, lens and direction of view are S3's. The mesh has no planes, but for the variants that are culled by them.

use super::three::{flat, flat_z, wire, TORUS_EDGED};
use super::{Counted, Deep, Plain, TORUS};
use crate::scene::{self, Model};
use pinhole::WithPlanes;

/// Distances of the eye from the torus's centre, in 2⁻¹⁶: 0.8, where the near plane at 0.5 cuts the torus, and 1.2. The
/// torus reaches 1.42 from its centre.
const NEAR: i32 = 52_429;
const FARTHER: i32 = 78_643;

const fn at<P>(model: &Model<P>, distance: i32) -> Model<P> {
    let Model { mesh, axes, reference, .. } = model;
    Model { mesh: *mesh, axes: *axes, distance, reference: *reference }
}

static C1: Model = at(&scene::TORUS, NEAR);
static C2: Model = at(&scene::TORUS, FARTHER);
static C1_PLANES: Model<WithPlanes> = at(&scene::TORUS_BY_PLANES, NEAR);
static C2_PLANES: Model<WithPlanes> = at(&scene::TORUS_BY_PLANES, FARTHER);
static C1_EDGED: Model = at(&TORUS_EDGED, NEAR);
static C2_EDGED: Model = at(&TORUS_EDGED, FARTHER);

pub fn c1(memory: &mut Plain<TORUS>) -> Option<Counted> {
    flat(&C1, memory)
}

pub fn c1_z(memory: &mut Deep<TORUS>) -> Option<Counted> {
    flat_z(&C1, memory)
}

pub fn c1_wire(memory: &mut Plain<TORUS>) -> Option<Counted> {
    wire(&C1_EDGED, memory)
}

pub fn c1_planes(memory: &mut Plain<TORUS>) -> Option<Counted> {
    flat(&C1_PLANES, memory)
}

pub fn c1_planes_z(memory: &mut Deep<TORUS>) -> Option<Counted> {
    flat_z(&C1_PLANES, memory)
}

pub fn c2(memory: &mut Plain<TORUS>) -> Option<Counted> {
    flat(&C2, memory)
}

pub fn c2_z(memory: &mut Deep<TORUS>) -> Option<Counted> {
    flat_z(&C2, memory)
}

pub fn c2_wire(memory: &mut Plain<TORUS>) -> Option<Counted> {
    wire(&C2_EDGED, memory)
}

pub fn c2_planes(memory: &mut Plain<TORUS>) -> Option<Counted> {
    flat(&C2_PLANES, memory)
}

pub fn c2_planes_z(memory: &mut Deep<TORUS>) -> Option<Counted> {
    flat_z(&C2_PLANES, memory)
}
